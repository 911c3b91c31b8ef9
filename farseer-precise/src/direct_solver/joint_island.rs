//! Islands with joints in the direct solver: contacts, joints and springs are one system, solved for velocities and then for
//! positions.
//!
//! A solution is stored only after its check. A solution that is not accepted is used nevertheless, but it costs so much of the
//! budget that the island soon goes to the iterative solver. During an impact that solver does worse than any direct result,
//! because it starts from impulses that it cannot sustain.
//!
//! In five cases nothing is stored, and the island goes to the iterative solver at once:
//!
//! - the solution gains energy;
//! - it diverges: a body rotates by more than `ACCEPTED_ROTATION`, a joint error exceeds `ACCEPTED_JOINT_ERROR`, and the
//!   island has had no stored solution since the direct solver took it;
//! - the island has no contacts, and the position solve hardly closes such an error (`JOINT_ERROR_PROGRESS`);
//! - it returns from a pause in the iterative solver and has no accepted solution: a rough one would set a pile in motion that
//!   has come to rest there;
//! - a static or kinematic body stands in the way of joints, and a kinematic body drives them against it.
//!
//! With [`SolverChoice::Direct`] every solution is stored, even one that gains energy.

use super::constraint::{Constraint, FIXED};
use super::constraint_list::add_constraint_impulses;
use super::cost_model::max_newton_steps;
use super::island_body::{IslandBody, MemberIndex, MemberVectors, dot, max_or_nan};
use super::island_history::IslandHistory;
use super::island_io::{DirectIsland, RestingBody, RowReader};
use super::island_newton::{Correction, IslandSystem, SolveStats, Tolerances};
use super::island_solver::IslandSolver;
use super::joint::JointRows;
use super::lateral_friction::clear_impulses;
use super::mat3::Vec3;
use crate::bodies::BodySet;
use crate::constraint_graph::{ConstraintGraph, ContactConstraint};
use crate::index::BodyIndex;
use crate::joints::JointSystem;
use crate::joints::island_rows::StepInterval;
use crate::joints::springs::SpringRows;
use crate::mass::INFINITE_MASS;
use crate::parameters::contacts::HELD_DEPTH_PER_EXTENT;
use crate::parameters::direct::{
    ACCEPTED_ENERGY_GAIN, ACCEPTED_JOINT_ERROR, ACCEPTED_RESIDUAL, ACCEPTED_RESIDUAL_FRACTION,
    ACCEPTED_ROTATION, ACCEPTED_VELOCITY_ERROR, CORRECTION_ERROR_RATIO, CORRECTION_HALVINGS,
    CYCLIC_VELOCITY_ERROR, ERROR_ARM, EXACT_VELOCITY_ERROR, JACOBIAN_ROTATION, JOINT_ERROR_PROGRESS,
    JOINTED_PENETRATION_RATE, JOINTED_PENETRATION_SPEED, LATERAL_SLIP_MIN_SPEED, MOVING_VELOCITY_ERROR,
    POSITION_CORRECTIONS, RESTING_VELOCITY_ERROR, SOLVED_VELOCITY_ERROR,
};
use crate::parameters::joints::JOINT_CORRECTION_SPEED;
use crate::solver_choice::SolverChoice;

/// Result of the position solve of an island with joints.
#[derive(Debug, Clone, Copy)]
pub(super) struct PositionSolution {
    /// The greatest joint error that remains, length units.
    pub(super) error: f64,
    /// Whether a static or kinematic body stood in the way of joints, so that they keep errors.
    is_blocked: bool,
    /// Whether joints keep errors because they were larger than the greatest correction of a step.
    keeps_errors: bool,
}

impl PositionSolution {
    /// Stands for no solution: the error is infinite.
    const NONE: Self = PositionSolution { error: f64::INFINITY, is_blocked: false, keeps_errors: false };
}

impl<'a> IslandSolver<'a> {
    /// Solves an island with joints and this history. Returns the number of Newton steps, the velocity residual and whether the
    /// solution is accepted.
    pub(super) fn solve_jointed_island(
        &mut self,
        island: &mut DirectIsland,
        history: IslandHistory,
    ) -> SolveStats {
        let was_solved = history.has_accepted_solution;
        let unit = self.length_unit();
        if island.is_unchanged_at_rest(self.bodies, self.joints, self.constraints) {
            self.joints.mark_all_solved(&island.joints);
            return SolveStats { newton_steps: 0, residual: 0.0, is_solved: true };
        }
        let reader = self.begin_jointed_island(island, unit);
        let (stats, gains_energy) = island.solve_jointed_velocities(&reader, unit);
        let slop = reader.penetration_slop;
        island.find_displacements(reader.dt, false);
        let deepest = island.system.advance_separations(reader.dt, slop);
        let error_before = island.compute_position_errors(self.joints, (0.0, false));
        let may_rest = stats.newton_steps == 0 && island.is_slow(&reader, unit) && error_before <= slop;
        if may_rest && deepest <= slop {
            return self.rest(island, &reader, stats);
        }
        let rotation = island.system.max_angular_speed() * reader.dt;
        let PositionSolution { error: error_after, is_blocked, keeps_errors } =
            match gains_energy && self.is_release_allowed() {
                true => PositionSolution::NONE,
                false => self.solve_jointed_positions(island, &reader, [deepest, error_before]),
            };
        // All penetration is held, and so nothing was corrected.
        let is_overlap_held =
            deepest > slop && error_after == error_before && island.system.greatest_correction() <= slop;
        if may_rest && is_overlap_held {
            return self.rest(island, &reader, stats);
        }
        let has_gap = error_after > ACCEPTED_JOINT_ERROR * unit;
        let has_diverged = !was_solved && rotation > ACCEPTED_ROTATION && has_gap;
        let is_stuck = island.contact_handles.is_empty() && self.is_joint_stuck([error_before, error_after]);
        let is_contradiction = is_blocked && !stats.is_solved && self.is_pulled(island);
        let returns_unsolved = history.was_paused() && !was_solved && !stats.is_solved;
        island.is_released = self.is_release_allowed()
            && (gains_energy || has_diverged || is_stuck || is_contradiction || returns_unsolved);
        self.store_or_forget(island, is_contradiction);
        let is_closing = keeps_errors && !self.is_joint_stuck([error_before, error_after]);
        let has_failed = gains_energy || rotation > ACCEPTED_ROTATION;
        let is_accepted = !has_failed && (!has_gap || is_blocked || is_closing);
        SolveStats { is_solved: stats.is_solved && is_accepted, ..stats }
    }

    /// Returns whether an island may go to the iterative solver within this update: the user has not chosen the direct solver
    /// for all islands.
    pub(super) fn is_release_allowed(&self) -> bool {
        self.choice != SolverChoice::Direct
    }

    /// Loads the bodies of an island with joints and builds its rows. `unit` is the length unit. The result has the velocity
    /// tolerance at rest, or a smaller one if something drives the island.
    fn begin_jointed_island(&mut self, island: &mut DirectIsland, unit: f64) -> RowReader<'a> {
        let IslandSolver { bodies, constraints: rows, joints, springs, step, .. } = self;
        island.begin_resting_lists();
        let slop = island.load_bodies(bodies, f64::from(step.substeps), unit);
        let mut reader = RowReader::new(bodies, step, slop, unit * RESTING_VELOCITY_ERROR);
        island.make_all_rows(rows, (joints, springs), &reader, unit);
        let min_correction = JOINTED_PENETRATION_SPEED * unit * reader.dt;
        island.set_least_separations(bodies, self.parameters.speculative_distance.into(), min_correction);
        if island.system.is_driven() {
            reader.velocity_tolerance = unit * MOVING_VELOCITY_ERROR;
        }
        reader
    }

    /// Ends an update in which an island with joints [stays at rest](DirectIsland::keep_at_rest). Returns `stats`.
    fn rest(&mut self, island: &mut DirectIsland, reader: &RowReader<'_>, stats: SolveStats) -> SolveStats {
        island.keep_at_rest(self.constraints, reader);
        self.joints.mark_all_solved(&island.joints);
        stats
    }

    /// Closes the joints of an island and resolves its penetration, after the solution of the velocities. `deepest` is the
    /// greatest penetration before and `error_before` the greatest joint error before, both in length units.
    fn solve_jointed_positions(
        &self,
        island: &mut DirectIsland,
        reader: &RowReader<'_>,
        [deepest, error_before]: [f64; 2],
    ) -> PositionSolution {
        let (joints, dt) = (&*self.joints, reader.dt);
        let is_pulled = self.is_pulled(island);
        let min_correction = JOINTED_PENETRATION_SPEED * self.length_unit() * dt;
        island.solve_positions(
            joints,
            (dt, deepest),
            [reader.penetration_slop, self.max_correction(), min_correction],
            (JOINTED_PENETRATION_RATE * dt).min(1.0),
            (!is_pulled).then_some(error_before),
        )
    }

    /// Returns whether a moving kinematic body pulls at a joint of the island.
    fn is_pulled(&self, island: &DirectIsland) -> bool {
        let mut of_joints = island.joints.iter().zip(&island.joint_bodies);
        of_joints.any(|(&at, &ends)| self.joints.constraint(at).is_moved_by_kinematic_body(ends))
    }

    /// Returns the greatest position correction of a step, in length units.
    pub(super) fn max_correction(&self) -> f64 {
        f64::from(self.parameters.recovery_speed) * f64::from(self.step.dt)
    }

    /// Returns whether a joint has a gap that the position solve hardly closes. The greatest joint errors before and after it
    /// are in length units.
    fn is_joint_stuck(&self, [error_before, error_after]: [f64; 2]) -> bool {
        let accepted = ACCEPTED_JOINT_ERROR * self.length_unit();
        error_before > accepted
            && error_after > accepted
            && error_after > error_before - JOINT_ERROR_PROGRESS * self.max_correction()
    }

    /// Stores the solution of an island that is not released. A released island keeps the impulses of the last update, unless its
    /// driven joints contradict contacts.
    fn store_or_forget(&mut self, island: &DirectIsland, is_contradiction: bool) {
        if !island.is_released {
            self.store_jointed_solution(island);
        } else if is_contradiction {
            self.forget_impulses(island);
        }
    }

    /// Removes the stored impulses of an island in which driven joints contradict contacts. They may contain a self-stress of any size,
    /// which the iterative solver could not sustain.
    fn forget_impulses(&mut self, island: &DirectIsland) {
        island.joints.iter().for_each(|&at| self.joints.forget_force(at));
        for &handle in &island.contact_handles {
            clear_impulses(&mut self.constraints.direct_constraint_mut(handle).constraint);
        }
    }

    /// Stores the solution of an island with joints: forces of joints and impulses of contacts. Its joints and springs are
    /// solved then.
    fn store_jointed_solution(&mut self, island: &DirectIsland) {
        let IslandSolver { constraints: rows, joints, springs, step, .. } = self;
        for (&at, rows) in island.joints.iter().zip(&island.system.joints) {
            joints.store_solution(at, rows, f64::from(step.dt));
        }
        let of_springs = island.system.joints.iter().skip(island.joints.len());
        for (&at, rows) in island.springs.iter().zip(of_springs) {
            if let Some(joint) = springs.mark_solved(at) {
                joints.add_servo_force(joint, rows.force_and_torque(f64::from(step.dt)));
            }
        }
        island.store_solution(rows, (f64::from(step.substeps), step.h), f32::INFINITY);
    }
}

impl DirectIsland {
    /// Returns whether the island was at rest in the last update, and no body, joint, motor or contact of the island has
    /// changed since.
    fn is_unchanged_at_rest(&self, bodies: &BodySet, joints: &JointSystem, rows: &ConstraintGraph) -> bool {
        let of_members = self.system.members.iter().zip(&self.resting_bodies);
        !self.resting_bodies.is_empty()
            && self.has_impulse_sum
            && self.joints.iter().all(|&at| !joints.constraint(at).has_moved())
            && of_members.map(|(member, stood)| (member.body, stood)).all(|(body, stood)| {
                *stood == RestingBody::of(bodies, body) && bodies.states[body].velocity == [0.0; 4]
            })
            && self.contact_handles.iter().zip(&self.separations).all(|(&handle, separations)| {
                let ContactConstraint { a, points: [one, other], .. } =
                    &rows.direct_constraint(handle).constraint;
                let is_at_rest = |body: BodyIndex| bodies.states[body].velocity == [0.0; 4];
                [one.separation, other.separation] == *separations
                    && (!bodies.is_kinematic(*a) || is_at_rest(*a))
            })
    }

    /// Ends an update without a solution: all velocities are below the tolerance and become 0, and the impulses stay.
    ///
    /// If the velocities were exactly 0 before as well, the state of the members is stored in `resting_bodies`. The island is
    /// then skipped until a body, joint or contact changes, because a solution from rest would find rest again. A pendulum at
    /// its turning point is different: its velocity is 0, but the solution gives it one.
    fn keep_at_rest(&mut self, rows: &mut ConstraintGraph, reader: &RowReader<'_>) {
        self.keep_solution(rows, reader.step, reader.substeps);
        self.has_impulse_sum = true;
        let DirectIsland { system, displacements, resting_bodies, separations, contact_handles, .. } = self;
        separations.clear();
        separations.extend(contact_handles.iter().map(|&handle| {
            rows.direct_constraint(handle).constraint.points.each_ref().map(|point| point.separation)
        }));
        displacements.iter_mut().for_each(|displacement| *displacement = [0.0; 3]);
        let RowReader { bodies, .. } = reader;
        let is_at_rest = |member: &IslandBody| bodies.states[member.body].velocity == [0.0; 4];
        if system.members.iter().all(is_at_rest) {
            resting_bodies.extend(system.members.iter().map(|member| RestingBody::of(bodies, member.body)));
        }
        system.members.iter_mut().for_each(|member| member.velocity = [0.0; 3]);
    }

    /// Solves the velocities of an island with joints, whose rows are built. Returns Newton steps, residual and acceptance, and
    /// whether the solution gains energy. `unit` is the length unit.
    fn solve_jointed_velocities(&mut self, reader: &RowReader<'_>, unit: f64) -> (SolveStats, bool) {
        self.system.add_geometric_stiffness(reader.dt, |_, _| 0.0);
        let free_energy = self.system.doubled_kinetic_energy();
        self.system.warm_start();
        let max_steps = max_newton_steps(self);
        let stats = self.system.solve_velocities(reader, unit, max_steps);
        (stats, self.system.gains_energy(free_energy, reader.dt, unit, ACCEPTED_ENERGY_GAIN))
    }

    /// Returns whether nothing drives the island and no member is faster than the velocity tolerance. An island with springs is
    /// never slow: stiff springs without friction creep towards their rest length, so that velocities below the tolerance add
    /// up. `unit` is the length unit.
    fn is_slow(&self, reader: &RowReader<'_>, unit: f64) -> bool {
        self.springs.is_empty()
            && self.system.max_speed(ERROR_ARM * unit) <= reader.velocity_tolerance
            && !self.system.is_driven()
    }

    /// Clears the lists that tell of an island at rest, and reserves their memory for the update in which the island comes to
    /// rest: no allocation then.
    fn begin_resting_lists(&mut self) {
        self.resting_bodies.clear();
        self.resting_bodies.reserve(self.system.members.len());
        self.separations.reserve(self.contact_handles.len().saturating_sub(self.separations.len()));
    }

    /// Builds the rows of all contacts, joints and springs of the island for a whole step. `unit` is the length unit.
    fn make_all_rows(
        &mut self,
        rows: &ConstraintGraph,
        (joints, springs): (&JointSystem, &SpringRows),
        reader: &RowReader<'_>,
        unit: f64,
    ) {
        let (dt, force_substeps) = (reader.dt, reader.substeps);
        self.is_released = false;
        self.make_contacts(rows, reader, false);
        self.apply_angular_damping(springs, dt);
        let whole_step = StepInterval { dt, force_dt: dt, force_substeps, step_dt: dt };
        self.make_joint_rows(joints, whole_step, ERROR_ARM * unit);
        self.make_spring_rows(springs, dt, ERROR_ARM * unit);
    }

    /// Builds the rows of all joints of the island for an `interval` of the step. `error_arm` is the length that one radian
    /// counts as, in length units per radian.
    fn make_joint_rows(&mut self, joints: &JointSystem, interval: StepInterval, error_arm: f64) {
        let DirectIsland { system, joints: of_island, joint_bodies, .. } = self;
        let IslandSystem { members, joints: rows, .. } = system;
        rows.clear();
        rows.reserve(of_island.len());
        for (&at, &ends) in of_island.iter().zip(joint_bodies.iter()) {
            let mut made = joints.constraint(at).constraint_rows(ends, interval, error_arm);
            joints.constraint(at).add_rod_stiffness(&mut made, interval.dt);
            made.set_effective_masses(members);
            rows.push(made);
        }
    }

    /// Builds the rows of all springs of the island, in the list after the rows of the joints. `dt` is the length of the step
    /// in seconds, `error_arm` the length that one radian counts as, in length units per radian.
    fn make_spring_rows(&mut self, springs: &SpringRows, dt: f64, error_arm: f64) {
        let DirectIsland {
            system: IslandSystem { members, joints: rows, .. },
            springs: of_island,
            spring_bodies,
            ..
        } = self;
        for (&at, &ends) in of_island.iter().zip(spring_bodies.iter()) {
            let mut made = springs.constraint(at).constraint_rows(ends, dt, error_arm);
            made.set_effective_masses(members);
            rows.push(made);
        }
    }

    /// Applies the angular damping of springs on single bodies implicitly over `dt` seconds: I w' = I w - dt c w'. Here I is
    /// the moment of inertia, c the damping, w the angular velocity before and w' that after.
    fn apply_angular_damping(&mut self, springs: &SpringRows, dt: f64) {
        let DirectIsland { system: IslandSystem { members, .. }, springs: of_island, spring_bodies, .. } =
            self;
        for (&at, ends) in of_island.iter().zip(spring_bodies.iter()) {
            let damping = dt * springs.constraint(at).spin_damping();
            for member in ends.bodies.into_iter().filter(|&member| member != FIXED && damping > 0.0) {
                members[member].add_inertia(damping, 0.0);
            }
        }
    }

    /// Position solve of the island: closes joints and resolves penetration by changing `displacements`, which start as those
    /// by the velocities.
    ///
    /// `dt` is the length of the step in seconds, `deepest` the greatest penetration. `limits` are the penetration slop, the
    /// greatest correction and the least correction, in length units. `resolved_fraction` (0..=1) is the fraction of a
    /// penetration to resolve. `known_error` is the greatest joint error before the corrections, length units; `None` if the
    /// rows do not have the errors of these displacements yet.
    pub(super) fn solve_positions(
        &mut self,
        joints: &JointSystem,
        (dt, mut deepest): (f64, f64),
        limits: [f64; 3],
        resolved_fraction: f64,
        known_error: Option<f64>,
    ) -> PositionSolution {
        let (rotates_much, slop) = (self.system.max_angular_speed() * dt > JACOBIAN_ROTATION, limits[0]);
        let mut error = match known_error.filter(|_| !rotates_much) {
            Some(error) => error,
            None => self.compute_position_errors(joints, (dt, rotates_much)),
        };
        let keeps_errors = self.keep_large_errors(joints, limits[1], JOINT_CORRECTION_SPEED * dt);
        let mut is_blocked = false;
        for correction in 0..POSITION_CORRECTIONS {
            let is_jacobian_new = correction > 0 || rotates_much;
            let tolerance = if correction == 0 { slop } else { CORRECTION_ERROR_RATIO * slop };
            let open_error = if keeps_errors { self.max_open_error() } else { error };
            if open_error <= tolerance && deepest <= slop {
                break;
            }
            let how = [is_jacobian_new, open_error > tolerance];
            match self.system.correct_positions(limits, resolved_fraction, how) {
                Correction::None => break,
                Correction::Free => error = self.apply_correction(joints, dt, error),
                Correction::Blocked => {
                    self.step_along_correction(1.0);
                    error = self.compute_position_errors(joints, (dt, true));
                    is_blocked = true;
                    break;
                }
            }
            // Penetration is resolved once per step.
            deepest = 0.0;
        }
        PositionSolution { error, is_blocked, keeps_errors }
    }

    /// Leaves the part of the joint errors at the start of the step that exceeds `max_correction` length units or `max_rotation`
    /// radians: joints close little by little. Returns whether there is such an error.
    fn keep_large_errors(&mut self, joints: &JointSystem, max_correction: f64, max_rotation: f64) -> bool {
        let mut is_any_large = false;
        for (rows, &at) in self.system.joints.iter_mut().zip(&self.joints) {
            is_any_large |=
                rows.set_kept_errors(joints.constraint(at).initial_errors(), max_correction, max_rotation);
        }
        is_any_large
    }

    /// Returns the greatest joint error that this step is to correct, in length units.
    fn max_open_error(&self) -> f64 {
        self.system.joints.iter().fold(0.0, |worst, rows| max_or_nan(rows.max_open_error(), worst))
    }

    /// Sets the separations below which joints must not press each contact with a static or kinematic body in this step.
    /// `max_depth` is the penetration for large bodies, and deeper points separate by `min_correction`, both in length units.
    fn set_least_separations(&mut self, bodies: &BodySet, max_depth: f64, min_correction: f64) {
        let IslandSystem { members, contacts, .. } = &mut self.system;
        for contact in contacts {
            if let [FIXED, member] = contact.bodies {
                let extent = f64::from(bodies.min_extents[members[member].body]);
                let depth = max_depth.min(f64::from(HELD_DEPTH_PER_EXTENT) * extent);
                contact.set_least_separations(depth, min_correction);
            }
        }
    }

    /// Applies the last position correction, or a fraction of it that does not increase the greatest joint error, `before`.
    /// Returns the error after it. Both are in length units; `dt` is the length of the step in seconds.
    ///
    /// A long chain that is nearly straight may get corrections that turn its links by a radian, far beyond the range of the
    /// linear model.
    fn apply_correction(&mut self, joints: &JointSystem, dt: f64, before: f64) -> f64 {
        self.step_along_correction(1.0);
        let mut error = self.compute_position_errors(joints, (dt, true));
        for halving in 1..=CORRECTION_HALVINGS {
            if error <= before {
                break;
            }
            self.step_along_correction(-(0.5_f64.powi(halving)));
            error = self.compute_position_errors(joints, (dt, true));
        }
        error
    }

    /// Adds `fraction` (dimensionless) of the last position correction to the displacements of the island's members; a negative
    /// fraction undoes a correction.
    fn step_along_correction(&mut self, fraction: f64) {
        let DirectIsland { system, displacements, .. } = self;
        for (displacement, correction) in displacements.iter_mut().zip(system.corrections()) {
            (0..3).for_each(|axis| displacement[axis] += fraction * correction[axis]);
        }
    }

    /// Computes the position errors of all joint rows after the present displacements. Returns the greatest error, in length
    /// units. `how` is the length of the step in seconds, and whether the rows get new Jacobians.
    fn compute_position_errors(&mut self, joints: &JointSystem, how: (f64, bool)) -> f64 {
        let DirectIsland { system, joints: of_island, joint_bodies, displacements, .. } = self;
        let mut worst = 0.0;
        for ((rows, &at), &ends) in system.joints.iter_mut().zip(of_island.iter()).zip(joint_bodies.iter()) {
            joints.constraint(at).update_errors(rows, ends, displacements, how);
            worst = max_or_nan(rows.max_position_error(), worst);
        }
        worst
    }
}

impl IslandSystem {
    /// Solves for the velocities of the island's members if the velocity residual exceeds the tolerance of `reader`. Returns
    /// Newton steps, residual and acceptance. `unit` is the length unit.
    pub(super) fn solve_velocities(
        &mut self,
        reader: &RowReader<'_>,
        unit: f64,
        max_newton_steps: usize,
    ) -> SolveStats {
        let residual = self.begin_solve(reader.dt, [reader.penetration_slop, LATERAL_SLIP_MIN_SPEED * unit]);
        if residual <= reader.velocity_tolerance {
            // The position solve keeps sticking contacts from sliding, so it needs the limits of the impulses that stay.
            self.contacts.iter_mut().for_each(|contact| contact.friction_limit = contact.coulomb_limit());
            return SolveStats { newton_steps: 0, residual, is_solved: true };
        }
        self.solve(&Tolerances {
            initial_residual: residual,
            acceptable: (ACCEPTED_RESIDUAL * unit + ACCEPTED_RESIDUAL_FRACTION * residual)
                .min(ACCEPTED_VELOCITY_ERROR * unit),
            sufficient: unit * SOLVED_VELOCITY_ERROR,
            exact: unit * EXACT_VELOCITY_ERROR,
            resting: unit * RESTING_VELOCITY_ERROR,
            moving_cycles: unit * CYCLIC_VELOCITY_ERROR,
            max_newton_steps,
        })
    }

    /// Adds the geometric stiffness of the joints to the moments of inertia of the island's members, as far as it exceeds the
    /// stable limit of an explicit step of `dt` seconds.
    ///
    /// Geometric stiffness (M. Tournier and others, "Stable constrained dynamics", 2015): joint forces that pull at a body
    /// resist its rotation. `with_momentum(added, stable)` returns the part of the added inertia that rotates with the body,
    /// from the added inertia and the stable limit. All are in mass units * length units^2.
    pub(super) fn add_geometric_stiffness(&mut self, dt: f64, with_momentum: impl Fn(f64, f64) -> f64) {
        self.accumulate_joint_stiffness();
        for (member, &[stiffness, squared_arm, _]) in self.members.iter_mut().zip(&self.negative_gradient) {
            let stable = member.stable_stiffness(squared_arm);
            let added = dt * stiffness - stable;
            if added > 0.0 {
                member.add_inertia(added, with_momentum(added, stable));
            }
        }
    }

    /// Returns the greatest ratio of the geometric stiffness of a member of the island to its stable limit for a step of `dt`
    /// seconds, dimensionless.
    pub(super) fn max_geometric_stiffness(&mut self, dt: f64) -> f64 {
        self.accumulate_joint_stiffness();
        let all = self.members.iter().zip(&self.negative_gradient);
        all.fold(0.0, |max, (member, &[stiffness, squared_arm, _])| {
            max_or_nan(dt * stiffness / member.stable_stiffness(squared_arm), max)
        })
    }

    /// Computes two values per member of the island into the first two components of `negative_gradient`. The first is the sum
    /// of (arm . impulse) over all its joints, mass units * length units^2/s. The second is the square of its longest arm,
    /// length units^2. The arm is the vector from the centre of mass to the anchor.
    fn accumulate_joint_stiffness(&mut self) {
        let IslandSystem { members, joints, negative_gradient, .. } = self;
        negative_gradient.clear();
        negative_gradient.resize(members.len(), [0.0; 3]);
        for joint in joints.iter() {
            let [on_a, on_b] = joint.jacobian.body_impulses(joint.impulses);
            let arms = [joint.jacobian.angular_a, joint.jacobian.angular_b];
            let [nx, ny] = joint.jacobian.normal;
            for (side, impulse) in [on_a, on_b].into_iter().enumerate() {
                let member = joint.bodies[side];
                if member == FIXED {
                    continue;
                }
                // The arm, from arm x n and arm x t.
                let [across_n, _, across_t] = arms[side];
                let arm = [across_n * ny - across_t * nx, -across_n * nx - across_t * ny];
                let of_member = &mut negative_gradient[member];
                of_member[0] += arm[0] * impulse[0] + arm[1] * impulse[1];
                of_member[1] = of_member[1].max(arm[0] * arm[0] + arm[1] * arm[1]);
            }
        }
    }

    /// Warm start: applies the joint and contact impulses of the last step to the velocities, multiplied by the one factor in
    /// 0..=1 with which the kinetic energy is least.
    ///
    /// With impulses l and velocity errors u the factor is p with l . (u + p J M^-1 J^T l) = 0. In closed loops the old
    /// impulses may contain a self-stress of any size. After a change of the geometry the self-stress would throw the bodies
    /// apart.
    pub(super) fn warm_start(&mut self) {
        let IslandSystem { members, contacts, joints, direction, .. } = self;
        direction.clear();
        direction.resize(members.len(), [0.0; 3]);
        add_all_impulses(contacts, direction);
        add_all_impulses(joints, direction);
        for (change, member) in direction.iter_mut().zip(members.iter()) {
            *change = member.velocity_from_impulse(*change);
        }
        let velocities = |at: MemberIndex| members[at].velocity;
        let [work, doubled_energy] = add_warm_start_work(
            joints,
            velocities,
            direction,
            add_warm_start_work(contacts, velocities, direction, [0.0; 2]),
        );
        // NaN gives 0.
        let factor = if work > 0.0 && doubled_energy > 0.0 { (work / doubled_energy).min(1.0) } else { 0.0 };
        scale_impulses(contacts, factor);
        scale_impulses(joints, factor);
        for (member, change) in members.iter_mut().zip(direction.iter()) {
            (0..3).for_each(|axis| member.velocity[axis] += factor * change[axis]);
        }
    }

    /// Returns whether the kinetic energy of the island is greater than it would be without constraints, by more than motors
    /// and springs supply in `dt` seconds.
    ///
    /// `free` is twice the kinetic energy without constraints, mass units * length units^2/s^2. `unit` is the length unit. The
    /// tolerances are `ratio`, as a multiple of `free`, and `slack`, as twice the energy divided by the mass of the island in length
    /// units^2/s^2 at a length unit of 1.
    pub(super) fn gains_energy(&self, free: f64, dt: f64, unit: f64, [ratio, slack]: [f64; 2]) -> bool {
        let supplied = self.supplied_energy() + 0.5 * self.doubled_released_energy(dt);
        let slack = slack * unit * unit * self.mass();
        // An energy of NaN counts as a gain.
        let keeps = self.doubled_kinetic_energy() <= ratio * free + 2.0 * supplied + slack;
        !keeps
    }

    /// Returns twice the kinetic energy of all members of the island, mass units * length units^2/s^2.
    pub(super) fn doubled_kinetic_energy(&self) -> f64 {
        self.members.iter().map(|member| dot(member.momentum(member.velocity), member.velocity)).sum()
    }

    /// Returns the sum of the masses of all members of the island that can move, mass units.
    fn mass(&self) -> f64 {
        self.members.iter().map(|member| member.mass).filter(|&mass| mass < INFINITE_MASS).sum()
    }

    /// Returns whether a motor, belt or kinematic body drives a constraint of the island.
    fn is_driven(&self) -> bool {
        self.contacts.iter().any(|contact| contact.driven_velocity_error != [0.0; 3])
            || self.joints.iter().any(JointRows::is_driven)
    }

    /// Returns the greatest speed of a member of the island in length units/s: its speed along x or y, or its angular speed
    /// times `error_arm` (length units per radian).
    fn max_speed(&self, error_arm: f64) -> f64 {
        let of_member = |[x, y, spin]: Vec3| max_or_nan(max_or_nan(x.abs(), y.abs()), error_arm * spin.abs());
        self.members.iter().fold(0.0, |most, member| max_or_nan(of_member(member.velocity), most))
    }

    /// Returns the greatest angular speed of a member of the island, radians/s.
    pub(super) fn max_angular_speed(&self) -> f64 {
        self.members.iter().fold(0.0, |most, member| max_or_nan(member.velocity[2].abs(), most))
    }

    /// Returns twice the energy that the springs of the island release in `dt` seconds, mass units * length units^2/s^2;
    /// negative if they take up energy.
    fn doubled_released_energy(&self, dt: f64) -> f64 {
        let velocity = |member: MemberIndex| self.members[member].velocity;
        self.joints.iter().map(|joint| joint.doubled_released_energy(velocity, dt)).sum()
    }

    /// Returns an upper bound of the energy that motors, belts and kinematic bodies supply to the island in the step, mass
    /// units * length units^2/s^2.
    fn supplied_energy(&self) -> f64 {
        let of_contacts =
            self.contacts.iter().map(|contact| work(contact.impulses, contact.driven_velocity_error));
        let of_joints = self.joints.iter().map(|joint| work(joint.impulses, joint.driven_velocities()));
        of_contacts.chain(of_joints).sum()
    }
}

/// Returns the sum of the absolute work that the `impulses` of the rows of one constraint do at the prescribed `velocities` of
/// the rows, mass units * length units^2/s^2.
fn work(impulses: Vec3, velocities: Vec3) -> f64 {
    (0..3).map(|row| (impulses[row] * velocities[row]).abs()).sum()
}

/// Adds the row impulses of all constraints, as impulses on bodies, to `impulse_sums`. There is one sum per member of the
/// island: x, y (mass units * length units/s) and angular (mass units * length units^2/s).
fn add_all_impulses<C: Constraint>(constraints: &[C], impulse_sums: &mut MemberVectors) {
    for rows in constraints {
        add_constraint_impulses(&rows.jacobian, rows.bodies, rows.impulses, impulse_sums);
    }
}

/// Adds the terms of `constraints` to two sums of [`warm_start`](IslandSystem::warm_start), in mass units * length units^2/s^2.
/// The first is -l . u, the energy that the impulses l remove at the velocity errors u. The second is l . J M^-1 J^T l plus
/// twice the energy of compliant rows.
fn add_warm_start_work<C: Constraint>(
    constraints: &[C],
    velocities: impl Fn(MemberIndex) -> Vec3,
    changes: &MemberVectors,
    [mut work, mut doubled_energy]: [f64; 2],
) -> [f64; 2] {
    for rows in constraints {
        let (before, change) =
            (rows.relative_velocities_of(&velocities), rows.relative_velocities_in(changes));
        for row in 0..3 {
            work -= rows.impulses[row] * (before[row] + rows.driven_velocity_error[row]);
            doubled_energy += rows.impulses[row] * change[row];
        }
        doubled_energy += rows.compliance_energy();
    }
    [work, doubled_energy]
}

/// Multiplies the impulses of all constraints by `factor` (dimensionless). The products become the initial impulses of the
/// solution.
fn scale_impulses<C: Constraint>(constraints: &mut [C], factor: f64) {
    for rows in constraints {
        let impulses = rows.impulses.map(|impulse| factor * impulse);
        rows.set_initial_impulses(impulses);
    }
}
