//! Input and output of an island of the direct solver: builds its rows from contact constraints, and stores impulses and
//! separations in them.

use super::constraint::{BodyIndices, FIXED, Jacobian};
use super::contact::{
    ContactRows, FRICTION, allowed_approach_speed, is_penetration_corrected, step_impulses,
};
use super::island_body::{MemberVectors, Members, finite_or_zero, max_magnitude, max_or_nan};
use super::island_newton::IslandSystem;
use super::lateral_friction::LateralFriction;
use super::mat3::Vec3;
use crate::bodies::BodySet;
use crate::constraint_graph::{ConstraintGraph, ConstraintHandle, ContactPoint, ParkedConstraint};
use crate::index::{BodyIndex, DenseIndex};
use crate::joints::indices::{JointIndex, SpringIndex};
use crate::joints::joint_constraint::JointConstraint;
use crate::mass::mass_of_inverse;
use crate::math::plane::Pose;
use crate::parameters::direct::{PENETRATION_SLOP, PENETRATION_SLOP_PER_COORDINATE};
use crate::reusing_clone;
use crate::scaled_parameters::StepContext;

/// One island of the direct solver: its system of equations, and its contact constraints, joints and springs. Lists stay
/// allocated from update to update.
#[derive(Debug, Default)]
pub(super) struct DirectIsland {
    /// Bodies, constraint rows and matrix of the island.
    pub(super) system: IslandSystem,
    /// Handles of the contact constraints of the island, in ascending order of the creation numbers of their geoms.
    pub(super) contact_handles: Vec<ConstraintHandle>,
    /// Bodies of each contact of `contact_handles`, as indices into the island's members.
    pub(super) contact_bodies: Vec<BodyIndices>,
    /// Displacement of each member of the island in the step: length units, length units, radians.
    pub(super) displacements: MemberVectors,
    /// Separations of the two points of each contact before the last residual was computed, or when the island came to rest.
    /// Unit: length units; negative = penetration.
    pub(super) separations: Vec<[f32; 2]>,
    /// Whether the stored sums of impulses of the members are valid: since they were computed no constraint has changed and the
    /// island was not solved. A solution uses the memory of the sums. In an island with joints at rest it tells only that no
    /// contact constraint has changed.
    pub(super) has_impulse_sum: bool,
    /// Whether the island is [on trial](super::island_stats::IslandStats::is_on_trial) in this update.
    pub(super) is_on_trial: bool,
    /// Number of Newton steps for the island in the last update.
    pub(super) newton_steps: usize,
    /// Modelled cost in microseconds that the islands before this one have left in the present update.
    pub(super) cost_limit: f64,
    /// Whether the island has no acceptable solution and goes to the iterative solver in this update. Contact cycles with a
    /// budget are not released: each failed solution costs more of the budget.
    pub(super) is_released: bool,
    /// Whether the last update solved the island as a free articulation, in intervals of the step.
    pub(super) was_articulation: bool,
    /// For an island with joints that was at rest in the last update: pose, force effect and masses of each member at that
    /// time. Empty for all other islands.
    pub(super) resting_bodies: Vec<RestingBody>,
    /// Joints of the island, as indices into the list of joint constraints.
    pub(super) joints: Vec<JointIndex>,
    /// Bodies of each joint of `joints`, as indices into the island's members.
    pub(super) joint_bodies: Vec<BodyIndices>,
    /// Springs of the island that are constraint rows, as indices into the list of such springs.
    pub(super) springs: Vec<SpringIndex>,
    /// Bodies of each spring of `springs`, as indices into the island's members.
    pub(super) spring_bodies: Vec<BodyIndices>,
    /// Scratch of a step in intervals: copies of the joints at their positions in the present interval.
    pub(super) interval_joints: Vec<JointConstraint>,
    /// Scratch of a step in intervals: impulse of each joint on body B in the step so far. Unit: mass units * length units/s
    /// for x and y, mass units * length units^2/s for the angle.
    pub(super) joint_impulses: Vec<Vec3>,
    /// Scratch of a step in intervals: displacement of each member of the island in the step so far: length units, length
    /// units, radians.
    pub(super) total_displacements: MemberVectors,
}

reusing_clone! {
    DirectIsland {
        system, contact_handles, contact_bodies, displacements, separations, has_impulse_sum, is_on_trial, newton_steps, cost_limit, is_released, was_articulation, resting_bodies, joints, joint_bodies, springs,
        spring_bodies, interval_joints, joint_impulses, total_displacements
    }
}

/// State of a body at rest. While it stays equal for all members, a solution of their island finds the same result, so it is
/// skipped.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct RestingBody {
    /// Pose of the body in the world: position in length units, and rotation.
    pose: Pose,
    /// Velocity change by forces per substep: x and y (length units/s), angular (radians/s), depth axis (length units/s).
    velocity_delta: [f32; 4],
    /// Inverse mass (1/mass units) and inverse moment of inertia (1/(mass units * length units^2)).
    inverse_masses: [f32; 2],
}

impl RestingBody {
    /// Returns the present state of a body.
    pub(super) fn of(bodies: &BodySet, body: BodyIndex) -> Self {
        let number = body.position();
        RestingBody {
            pose: bodies.poses[BodyIndex::new(number)],
            velocity_delta: bodies.force_delta[BodyIndex::new(number)],
            inverse_masses: bodies.inverse_mass_inertia[BodyIndex::new(number)],
        }
    }
}

/// Data of the step with which contact constraints of the iterative solver become rows of the direct solver.
pub(super) struct RowReader<'a> {
    /// Bodies of the simulator.
    pub(super) bodies: &'a BodySet,
    /// The step of the simulator, with its substeps.
    pub(super) step: &'a StepContext,
    /// Length in seconds of the step, or of one interval of a step in intervals.
    pub(super) dt: f64,
    /// Reciprocal of `dt`, in 1/s.
    pub(super) inverse_dt: f64,
    /// Number of substeps of the iterative solver in the whole step.
    pub(super) substeps: f64,
    /// Penetration slop: penetration and joint error that remain uncorrected, in length units.
    pub(super) penetration_slop: f64,
    /// Greatest velocity residual at which the stored impulses are kept without a solution, in length units/s.
    pub(super) velocity_tolerance: f64,
}

impl<'a> RowReader<'a> {
    /// Returns the reader for a `step`. `slop` is the penetration that remains, length units; `velocity_tolerance` the velocity
    /// residual at which stored impulses are kept, length units/s.
    pub(super) fn new(
        bodies: &'a BodySet,
        step: &'a StepContext,
        slop: f64,
        velocity_tolerance: f64,
    ) -> Self {
        let dt = f64::from(step.dt);
        RowReader {
            bodies,
            step,
            dt,
            inverse_dt: dt.recip(),
            substeps: f64::from(step.substeps),
            penetration_slop: slop,
            velocity_tolerance,
        }
    }

    /// Returns the reader for an interval of `dt` seconds of the step.
    pub(super) fn of_interval(self, dt: f64) -> Self {
        RowReader { dt, inverse_dt: dt.recip(), ..self }
    }

    /// Returns the factor from the stored impulses of the contact constraint `row` to impulses over the whole step,
    /// dimensionless: length of the step / length of the substep in which the impulses were stored.
    #[inline(always)]
    fn substeps_of(&self, row: &ParkedConstraint) -> f64 {
        if row.h == self.step.h { self.substeps } else { self.changed_substeps(row.h) }
    }

    /// Returns the factor of [`substeps_of`](Self::substeps_of) for impulses that were stored in a substep of another length
    /// `h` (seconds), dimensionless. This is rare: the step length has changed.
    #[cold]
    fn changed_substeps(&self, h: f32) -> f64 {
        f64::from(self.step.dt / h)
    }

    /// Returns the rows of a contact. Their velocity errors contain the velocity of a kinematic body A and of belts.
    #[inline(always)]
    fn contact_rows(&self, row: &ParkedConstraint, bodies: BodyIndices) -> ContactRows {
        let mut contact = ContactRows::new(row, self.substeps_of(row), bodies);
        if let Some([x, y, spin, _]) = self.kinematic_velocity(row, bodies) {
            contact.add_prescribed_velocity([x, y, spin]);
        }
        contact
    }

    /// Returns the friction row of a contact along the depth axis, with the velocity of a kinematic body A and of belts.
    fn lateral_friction(&self, row: &ParkedConstraint, bodies: BodyIndices) -> LateralFriction {
        let mut friction = LateralFriction::new(&row.constraint, self.substeps_of(row));
        if let Some(velocity) = self.kinematic_velocity(row, bodies) {
            friction.add_prescribed_velocity(velocity, f64::from(row.constraint.depth.across_arms[0]));
        }
        friction
    }

    /// Returns the velocity of body A of a contact: x, y (length units/s), angular (radians/s), depth axis (length units/s).
    /// `None` if A is not kinematic. A kinematic body is always A.
    #[inline(always)]
    fn kinematic_velocity(&self, row: &ParkedConstraint, bodies: BodyIndices) -> Option<[f64; 4]> {
        has_kinematic_a(row, bodies)
            .then(|| self.bodies.states[BodyIndex(row.constraint.a.0)].velocity.map(f64::from))
    }

    /// Returns the result of [`residual`](Self::residual) without building contact rows; `None` if the contact needs the full
    /// computation. The velocity residual may be too large if a point is about to separate or to slide.
    #[inline(always)]
    fn quick_residual(
        &self,
        row: &mut ParkedConstraint,
        bodies: BodyIndices,
        members: &Members,
    ) -> Option<[f64; 2]> {
        if row.h != self.step.h || has_kinematic_a(row, bodies) {
            return None;
        }
        let [a, b] = bodies.bodies.map(|at| if at == FIXED { [0.0; 3] } else { members[at].velocity });
        let [one, two, along] = Jacobian::of_contact(&row.constraint).relative_velocities(a, b);
        let constraint = &mut row.constraint;
        let (mut residual, mut deepest) = ((along - f64::from(constraint.tangent_speed)).abs(), 0.0);
        let mut separations = [0.0; 2];
        for (at, velocity) in [one, two].into_iter().enumerate() {
            let ContactPoint { separation, normal_mass: mass, normal_impulse: impulse, .. } =
                constraint.points[at];
            let (separation, is_there, presses) = (f64::from(separation), mass > 0.0, impulse > 0.0);
            let error = velocity + allowed_approach_speed(separation, self.penetration_slop, self.inverse_dt);
            let is_off = is_there & (presses | (error < 0.0));
            residual = max_magnitude(if is_off { error.abs() } else { 0.0 }, residual);
            separations[at] = separation + self.dt * velocity;
            let is_deep =
                is_there & is_penetration_corrected(presses, separations[at], self.penetration_slop);
            deepest = max_or_nan(if is_deep { -separations[at] } else { 0.0 }, deepest);
        }
        let friction_limit =
            constraint.friction * (constraint.points[0].normal_impulse + constraint.points[1].normal_impulse);
        if !(residual <= self.velocity_tolerance && constraint.tangent_impulse.abs() <= friction_limit) {
            return None;
        }
        for (point, separation) in constraint.points.iter_mut().zip(separations) {
            (point.rest_impulse, point.separation) =
                (point.normal_impulse, finite_or_zero(separation) as f32);
        }
        Some([residual, deepest])
    }

    /// Returns the velocity residual of a contact (length units/s) and the penetration of its deepest point that needs
    /// correction (length units). Advances the stored separations to the end of the step.
    #[inline(never)]
    fn residual(&self, row: &mut ParkedConstraint, bodies: BodyIndices, members: &Members) -> [f64; 2] {
        let mut contact = self.contact_rows(row, bodies);
        contact.add_relative_velocity(members, self.inverse_dt, self.penetration_slop);
        let residual = contact.residual();
        let deepest = contact.advance_separations(members, self.dt, self.penetration_slop);
        for (point, separation) in row.constraint.points.iter_mut().zip(contact.separations) {
            point.separation = finite_or_zero(separation) as f32;
        }
        [residual, deepest]
    }
}

/// Returns whether body A of a contact is kinematic.
#[inline(always)]
fn has_kinematic_a(row: &ParkedConstraint, bodies: BodyIndices) -> bool {
    bodies.bodies[0] == FIXED && row.constraint.a != BodyIndex::PLACEHOLDER
}

impl DirectIsland {
    /// Returns whether the island has joints or springs.
    pub(super) fn has_joints(&self) -> bool {
        self.joint_count() > 0
    }

    /// Returns the number of joints and springs of the island.
    pub(super) fn joint_count(&self) -> usize {
        self.joints.len() + self.springs.len()
    }

    /// Loads into the island's members their velocities without constraints, masses and moments of inertia. Returns the
    /// penetration slop, the penetration that remains uncorrected, in length units.
    ///
    /// `unit` is the length unit. The velocity changes by forces in `substeps` substeps are added to the velocities.
    pub(super) fn load_bodies(&mut self, bodies: &BodySet, substeps: f64, unit: f64) -> f64 {
        let mut max_coordinate = 0.0;
        for member in self.system.members.iter_mut() {
            let at = member.body.position();
            let [x, y, ..] = bodies.poses[BodyIndex::new(at)];
            max_coordinate =
                [x, y].iter().fold(max_coordinate, |far: f32, x| if x.abs() > far { x.abs() } else { far });
            let [x, y, spin, depth] = free_velocity(bodies, member.body, substeps);
            (member.velocity, member.depth_velocity) = ([x, y, spin], depth);
            member.velocity_change = [0.0; 3];
            [member.mass, member.inertia] =
                bodies.inverse_mass_inertia[BodyIndex::new(at)].map(mass_of_inverse);
        }
        let slop = PENETRATION_SLOP_PER_COORDINATE * f64::from(max_coordinate);
        if slop > PENETRATION_SLOP * unit { slop } else { PENETRATION_SLOP * unit }
    }

    /// Warm start: applies the stored contact impulses to the velocities of the island's members. Impulses along the depth axis
    /// are left out.
    pub(super) fn apply_warm_start(&mut self, rows: &ConstraintGraph, reader: &RowReader<'_>) {
        let DirectIsland { system, contact_handles, contact_bodies, has_impulse_sum, .. } = self;
        if !std::mem::replace(has_impulse_sum, true) {
            system.begin_impulse_sum();
            for (&handle, &ends) in contact_handles.iter().zip(contact_bodies.iter()) {
                let row = rows.direct_constraint(handle);
                system.add_to_impulse_sum(
                    &Jacobian::of_contact(&row.constraint),
                    ends,
                    step_impulses(row, reader.substeps_of(row)),
                );
            }
        }
        system.apply_impulse_sum();
    }

    /// Returns the velocity residual of the whole island (length units/s) and the penetration of its deepest point that needs
    /// correction (length units), from the stored constraints. Advances the stored separations to the end of the step.
    pub(super) fn residual(&mut self, rows: &mut ConstraintGraph, reader: &RowReader<'_>) -> [f64; 2] {
        let DirectIsland { system, contact_handles, contact_bodies, separations, has_impulse_sum, .. } = self;
        let (mut residual, mut deepest) = (0.0, 0.0);
        separations.clear();
        for (&handle, &ends) in contact_handles.iter().zip(contact_bodies.iter()) {
            let row = rows.direct_constraint_mut(handle);
            separations.push(row.constraint.points.each_ref().map(|point| point.separation));
            let [velocity, depth] = reader.quick_residual(row, ends, &system.members).unwrap_or_else(|| {
                *has_impulse_sum = false;
                reader.residual(row, ends, &system.members)
            });
            residual = max_or_nan(velocity, residual);
            deepest = max_or_nan(depth, deepest);
        }
        [residual, deepest]
    }

    /// Keeps the stored impulses of the contacts as the solution. Impulses that were stored in a substep of another length are
    /// scaled to the present substep.
    pub(super) fn keep_solution(&self, rows: &mut ConstraintGraph, step: &StepContext, substeps: f64) {
        if self.has_impulse_sum {
            return;
        }
        for &handle in &self.contact_handles {
            let row = rows.direct_constraint_mut(handle);
            let scale = if row.h == step.h { 1.0 } else { f64::from(step.h / row.h) };
            let separations = row.constraint.points.each_ref().map(|point| f64::from(point.separation));
            let impulses = row.impulses().map(|impulse| impulse * scale);
            store_row(row, impulses, separations, (substeps, step.h), true);
        }
    }

    /// Restores the stored separations of the contacts to their values before [`residual`](Self::residual), since the island
    /// will be solved.
    pub(super) fn undo_residual(&self, rows: &mut ConstraintGraph) {
        for (&handle, separations) in self.contact_handles.iter().zip(&self.separations) {
            let points = &mut rows.direct_constraint_mut(handle).constraint.points;
            points.iter_mut().zip(separations).for_each(|(point, &separation)| point.separation = separation);
        }
    }

    /// Builds the contact rows of the island from the stored constraints, and with `has_depth` the friction rows along the
    /// depth axis.
    pub(super) fn make_contacts(&mut self, rows: &ConstraintGraph, reader: &RowReader<'_>, has_depth: bool) {
        let DirectIsland { system, contact_handles, contact_bodies, has_impulse_sum, .. } = self;
        *has_impulse_sum = false;
        system.contacts.clear();
        system.joints.clear();
        system.lateral_frictions.clear();
        for (&handle, &ends) in contact_handles.iter().zip(contact_bodies.iter()) {
            let row = rows.direct_constraint(handle);
            system.contacts.push(reader.contact_rows(row, ends));
            system.lateral_frictions.extend(has_depth.then(|| reader.lateral_friction(row, ends)));
        }
    }

    /// Returns whether a budget decides how long an island without joints stays with the direct solver: it is in 2D, has
    /// contact cycles and cannot jam. For other islands without joints the number of Newton steps decides.
    pub(super) fn has_cyclic_budget(&self, has_depth: bool) -> bool {
        !has_depth
            && self.contact_handles.len() > self.system.members.len()
            && !self.system.may_jam(&self.contact_bodies)
    }

    /// Stores the impulses of the solution, divided by `substeps`, and the separations in the contact constraints. `h` is the
    /// length of a substep in seconds.
    ///
    /// Rest impulses do not rise in an update that began with a residual above `impact_speed` (length units/s). There was an impact
    /// somewhere in the island, or a load has just come or gone: the impulses may be no lasting load. `impact_speed` is infinite for
    /// islands with joints: their rest impulses are reduced when they leave the direct solver.
    pub(super) fn store_solution(
        &self,
        rows: &mut ConstraintGraph,
        (substeps, h): (f64, f32),
        impact_speed: f32,
    ) {
        let is_steady = self.system.initial_residual <= f64::from(impact_speed);
        for (contact, &handle) in self.system.contacts.iter().zip(&self.contact_handles) {
            let impulses = contact.impulses.map(|impulse| impulse / substeps);
            let row = rows.direct_constraint_mut(handle);
            store_row(row, impulses, contact.separations, (substeps, h), is_steady);
        }
        for (friction, &handle) in self.system.lateral_frictions.iter().zip(&self.contact_handles) {
            friction.store(&mut rows.direct_constraint_mut(handle).constraint.depth, substeps);
        }
    }

    /// Computes the displacements of the island's members: velocity times `dt` seconds, and with `has_corrections` plus the
    /// position corrections.
    pub(super) fn find_displacements(&mut self, dt: f64, has_corrections: bool) {
        let DirectIsland { system, displacements, .. } = self;
        displacements.clear();
        displacements.extend(system.members.enumerated().map(|(at, member)| {
            let displacement = member.velocity.map(|velocity| velocity * dt);
            if has_corrections {
                std::array::from_fn(|i| displacement[i] + system.corrections()[at][i])
            } else {
                displacement
            }
        }));
    }
}

/// Returns the velocity of a body after the forces of `substeps` substeps, without contacts: x and y (length units/s), angular
/// (radians/s), depth axis (length units/s).
#[inline(always)]
pub(super) fn free_velocity(bodies: &BodySet, body: BodyIndex, substeps: f64) -> [f64; 4] {
    let at = body.position();
    let (velocity, velocity_delta) =
        (bodies.states[BodyIndex::new(at)].velocity, bodies.force_delta[BodyIndex::new(at)]);
    std::array::from_fn(|axis| f64::from(velocity[axis]) + f64::from(velocity_delta[axis]) * substeps)
}

/// Stores the `impulses` of one substep (mass units * length units/s) and the separations (length units) in a contact
/// constraint. The rest impulse of each point becomes its whole impulse, so that the contact does not sag if the iterative
/// solver takes over; unless the impulses are `is_steady` it does not rise. `h` is the length of the substep in seconds.
#[inline(never)]
fn store_row(
    row: &mut ParkedConstraint,
    impulses: Vec3,
    separations: [f64; 2],
    (substeps, h): (f64, f32),
    is_steady: bool,
) {
    row.h = h;
    row.exact_impulses = impulses.map(finite_or_zero);
    row.constraint.tangent_impulse = row.exact_impulses[FRICTION] as f32;
    let totals = &mut row.constraint.depth.totals;
    totals
        .iter_mut()
        .zip(impulses)
        .for_each(|(total, impulse)| *total = finite_or_zero(impulse * substeps) as f32);
    for (at, point) in row.constraint.points.iter_mut().enumerate() {
        point.normal_impulse = row.exact_impulses[at] as f32;
        let is_raised = is_steady || point.rest_impulse > point.normal_impulse;
        point.rest_impulse = if is_raised { point.normal_impulse } else { point.rest_impulse };
        point.separation = finite_or_zero(separations[at]) as f32;
    }
}
