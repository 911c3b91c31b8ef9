//! Free articulations with motors, limits or bounded impulses: islands of joints without contacts, solved in intervals of the
//! step.
//!
//! The method is RATTLE (H. Andersen, 1983) with bounds on the impulses. Each interval begins with the impulse of the applied
//! forces. A SHAKE solve then finds the joint impulses with which the joints hold at the end of the interval. It uses the
//! Jacobian from the beginning of the interval and a second-order correction for the rotation of the bodies. Forces act by half
//! an interval at both ends of the step. The last solve makes the velocities consistent with the joints at the end of the step.
//!
//! Impulses on the two bodies of a joint are equal and opposite, so that momentum is conserved. They act at the present anchor
//! positions of both bodies: where the anchors have a gap, angular momentum changes by gap x impulse. Geometric stiffness added
//! to the inertia changes it, too: the added inertia takes up spin in the solve, and is dropped after it. Energy is accurate to
//! second order in the length of an interval. Steady motors and forces move bodies as far as in continuous time.

use super::cost_model::{max_newton_steps, newton_steps_cost};
use super::island_body::max_or_nan;
use super::island_io::{DirectIsland, RowReader};
use super::island_newton::{IslandSystem, SolveStats};
use super::island_solver::IslandSolver;
use crate::joints::JointSystem;
use crate::joints::island_rows::StepInterval;
use crate::joints::substep_plan::{ArticulationSize, SubstepPlan, momentum_carrying_stiffness};
use crate::mass::mass_of_inverse;
use crate::parameters::direct::{
    ACCEPTED_JOINT_ERROR, ACCEPTED_RESIDUAL, ACCEPTED_ROTATION, ARTICULATION_SOLUTIONS, ERROR_ARM,
    INTERVAL_ENERGY_GAIN, MAX_INTERVAL_FACTOR, MOVING_VELOCITY_ERROR,
};
use crate::parameters::joints::{IMPLICIT_STIFFNESS_RATIO, MIN_DIRECT_SUBSTEPS};
use crate::scaled_parameters::StepContext;

impl DirectIsland {
    /// Returns whether the island is a free articulation: it has no contacts, no springs and no closed loops.
    ///
    /// Closed loops are excluded: if a loop is stretched to a line, no impulse at the beginning of an interval closes the loop
    /// at the end.
    pub(super) fn is_free_articulation(&self, joints: &JointSystem) -> bool {
        self.contact_handles.is_empty()
            && self.springs.is_empty()
            && !self.joints.iter().any(|&at| joints.has_loop(at))
    }

    /// Applies the forces of the fraction `share` of the step (0..=1) to the velocities of the island's members, and loads
    /// their masses and moments of inertia. Forces of the game and of springs may depend on positions: they act for the whole
    /// step in the first interval (`is_first`), as on unconstrained bodies.
    fn apply_forces(&mut self, share: f64, is_first: bool, reader: &RowReader<'_>) {
        let RowReader { bodies, step, .. } = reader;
        let (substeps, at_once) = (f64::from(step.substeps), 2.0 / f64::from(step.dt));
        let at_beginning = if is_first { 1.0 - share } else { -share };
        for member in self.system.members.iter_mut() {
            let (push, forced) = (bodies.force_delta[member.body], bodies.force_position_delta[member.body]);
            for axis in 0..3 {
                let kick = share * substeps * f64::from(push[axis]);
                member.velocity[axis] += kick + at_beginning * at_once * f64::from(forced[axis]);
            }
            member.velocity_change = [0.0; 3];
            [member.mass, member.inertia] = bodies.inverse_mass_inertia[member.body].map(mass_of_inverse);
        }
    }

    /// Builds the rows of all joints at their present positions, for one `interval`. `error_arm` is the length that one radian
    /// counts as, in length units per radian. If the interval `moves` bodies, rods get their geometric stiffness.
    fn make_interval_rows(&mut self, interval: StepInterval, error_arm: f64, moves: bool) {
        let DirectIsland {
            system: IslandSystem { members, joints: rows, .. },
            interval_joints,
            joint_bodies,
            ..
        } = self;
        rows.clear();
        for (joint, &ends) in interval_joints.iter().zip(joint_bodies.iter()) {
            let mut made = joint.constraint_rows(ends, interval, error_arm);
            if moves {
                joint.add_rod_stiffness(&mut made, interval.dt);
            }
            made.set_effective_masses(members);
            made.carry_transverse_momentum(members, momentum_carrying_stiffness);
            rows.push(made);
        }
    }

    /// Solves the velocities of one interval. With `moves` the joints hold at the end of the interval; without, the velocities
    /// obey the joints at the present positions. Returns Newton steps, residual and acceptance; a solution that gains energy is
    /// not accepted.
    ///
    /// `limits` are the length unit and the maximum number of Newton steps per solution.
    fn solve_interval(&mut self, reader: &RowReader<'_>, limits: (f64, usize), moves: bool) -> SolveStats {
        let (unit, max_steps) = limits;
        let free_energy = self.system.doubled_kinetic_energy();
        self.system.warm_start();
        let mut stats = self.system.solve_velocities(reader, unit, max_steps);
        for _ in 1..if moves { ARTICULATION_SOLUTIONS } else { 1 } {
            if self.update_linearisation_errors(reader.dt) <= reader.penetration_slop {
                break;
            }
            let more = self.system.solve_velocities(reader, unit, max_steps);
            stats = SolveStats { newton_steps: stats.newton_steps + more.newton_steps, ..more };
        }
        let gains = self.system.gains_energy(free_energy, reader.dt, unit, INTERVAL_ENERGY_GAIN);
        SolveStats { is_solved: stats.is_solved && !gains, ..stats }
    }

    /// Adds the linearisation errors of the displacements in `dt` seconds to the velocity errors of the joint rows. Returns the
    /// greatest change of a linearisation error, in length units.
    fn update_linearisation_errors(&mut self, dt: f64) -> f64 {
        self.find_displacements(dt, false);
        let DirectIsland {
            system: IslandSystem { members, joints: rows, .. },
            interval_joints,
            joint_bodies,
            displacements,
            ..
        } = self;
        let mut worst = 0.0;
        for ((rows, joint), &ends) in rows.iter_mut().zip(interval_joints.iter()).zip(joint_bodies.iter()) {
            worst = max_or_nan(
                rows.set_linearisation_error(joint.linearisation_error(ends, displacements, dt), dt),
                worst,
            );
        }
        members.iter_mut().for_each(|member| member.velocity_change = [0.0; 3]);
        worst
    }

    /// Solves interval number `interval` of a step that has `intervals` of them, and moves the bodies through it. Forces act by
    /// halves at both ends of the step, so that one more solution follows the last interval. Returns Newton steps, residual and
    /// acceptance. `limits` are the length unit and the maximum number of Newton steps.
    fn step_interval(
        &mut self,
        reader: &RowReader<'_>,
        (interval, intervals): (u32, u32),
        limits: (f64, usize),
    ) -> SolveStats {
        let (h, unit) = (reader.dt, limits.0);
        let moves = interval < intervals;
        let share = if interval == 0 || !moves { 0.5 } else { 1.0 };
        let share_of_step = share / f64::from(intervals);
        self.apply_forces(share_of_step, interval == 0, reader);
        let span = StepInterval {
            dt: h,
            force_dt: share * h,
            force_substeps: share_of_step * reader.substeps,
            step_dt: f64::from(reader.step.dt),
        };
        self.make_interval_rows(span, ERROR_ARM * unit, moves);
        if moves {
            self.system.add_geometric_stiffness(h / share, momentum_carrying_stiffness);
        }
        let mut stats = self.solve_interval(reader, limits, moves);
        stats.is_solved &= self.system.max_angular_speed() * h <= ACCEPTED_ROTATION;
        if stats.is_solved {
            self.store_forces(span.force_dt);
            if moves {
                self.advance_bodies(h);
            }
        }
        stats
    }

    /// Stores the solved forces and torques in `interval_joints`, and adds their impulses to `joint_impulses`, the sums over
    /// the step. `force_time` is the time for which the forces act, in seconds.
    fn store_forces(&mut self, force_time: f64) {
        let DirectIsland { system, interval_joints, joint_impulses, .. } = self;
        for ((joint, rows), total) in
            interval_joints.iter_mut().zip(&system.joints).zip(joint_impulses.iter_mut())
        {
            joint.set_force_from_impulses(rows, force_time);
            let force = joint.force_and_torque();
            (0..3).for_each(|axis| total[axis] += force[axis] * force_time);
        }
    }

    /// Moves the joint anchors by the velocities of the island's members for `dt` seconds, and adds the displacements of the
    /// members to `total_displacements`.
    fn advance_bodies(&mut self, dt: f64) {
        self.find_displacements(dt, false);
        let DirectIsland { interval_joints, joint_bodies, displacements, total_displacements, .. } = self;
        interval_joints
            .iter_mut()
            .zip(joint_bodies.iter())
            .for_each(|(joint, &ends)| joint.displace(ends, displacements, dt));
        for (path, displacement) in total_displacements.iter_mut().zip(displacements.iter()) {
            (0..3).for_each(|axis| path[axis] += displacement[axis]);
        }
    }

    /// Fills the scratch lists of a step in intervals: joints, impulses and displacements. Returns the number of intervals,
    /// which grows with the geometric stiffness and the greatest angular speed.
    fn begin_articulation(&mut self, joints: &JointSystem, step: &StepContext) -> u32 {
        let dt = f64::from(step.dt);
        let DirectIsland {
            system,
            interval_joints,
            joint_impulses,
            total_displacements,
            joints: of_island,
            ..
        } = self;
        interval_joints.clear();
        interval_joints.extend(of_island.iter().map(|&at| *joints.constraint(at)));
        joint_impulses.clear();
        joint_impulses.resize(interval_joints.len(), [0.0; 3]);
        total_displacements.clear();
        total_displacements.resize(system.members.len(), [0.0; 3]);
        system.contacts.clear();
        system.joints.clear();
        system.lateral_frictions.clear();
        let [rod_stiffness, rod_spin] = self.make_first_rows(step);
        let system = &mut self.system;
        let stiffness = max_or_nan(system.max_geometric_stiffness(dt), rod_stiffness);
        let bodies = system.members.len() as u32;
        let spin = max_or_nan(system.max_angular_speed(), rod_spin);
        let is_balanced = SubstepPlan::is_energy_balanced(bodies);
        let size = ArticulationSize { bodies, is_balanced };
        let division =
            SubstepPlan::of(size, step, [spin; 2], |bears| stiffness > IMPLICIT_STIFFNESS_RATIO * bears);
        division.substeps.max(if is_balanced { MIN_DIRECT_SUBSTEPS } else { 1 })
    }

    /// Builds the rows of all joints for the whole step. Returns the greatest ratio of the geometric stiffness of a distance joint to
    /// its stable limit, dimensionless, and the greatest angular speed of one, in radians/s.
    fn make_first_rows(&mut self, step: &StepContext) -> [f64; 2] {
        let DirectIsland { system, interval_joints, joint_bodies, .. } = self;
        let dt = f64::from(step.dt);
        let whole_step = StepInterval { dt, force_dt: dt, force_substeps: step.substeps.into(), step_dt: dt };
        let (mut stiffness, mut spin) = (0.0, 0.0);
        for (joint, &ends) in interval_joints.iter().zip(joint_bodies.iter()) {
            let mut rows = joint.constraint_rows(ends, whole_step, 1.0);
            joint.add_rod_stiffness(&mut rows, dt);
            rows.set_effective_masses(&system.members);
            stiffness = max_or_nan(rows.transverse_stiffness_ratio(), stiffness);
            let length = joint.rod_length().filter(|&length| length > 0.0);
            let of_rod = length.map_or(0.0, |length| rows.speed_across(&system.members) / length);
            spin = max_or_nan(of_rod, spin);
            system.joints.push(rows);
        }
        [stiffness, spin]
    }
}

impl IslandSolver<'_> {
    /// Solves an island that is a [free articulation](DirectIsland::is_free_articulation), in intervals of the step. Returns
    /// Newton steps, residual and acceptance. Joint forces are stored only if the solution is accepted.
    ///
    /// A chain that snaps taut may need shorter intervals: a step whose solution gains energy or turns a body too far is repeated with
    /// twice as many, up to [`MAX_INTERVAL_FACTOR`] times the planned number. There is no repetition if its modelled cost, twice that
    /// of the last trial, and the cost of all trials exceed what the islands before this one have left of the update's.
    pub(super) fn solve_articulation(&mut self, island: &mut DirectIsland) -> SolveStats {
        let (mut factor, mut newton_steps) = (1, 0);
        loop {
            let stats = self.solve_in_intervals(island, factor);
            newton_steps += stats.newton_steps;
            factor *= 2;
            let has_residual = stats.residual > ACCEPTED_RESIDUAL * self.length_unit();
            let is_dear =
                newton_steps_cost(island, newton_steps + 2 * stats.newton_steps) > island.cost_limit;
            if stats.is_solved || has_residual || is_dear || factor > MAX_INTERVAL_FACTOR {
                return SolveStats { newton_steps, ..stats };
            }
        }
    }

    /// As [`solve_articulation`](Self::solve_articulation), in `factor` times the planned number of intervals.
    fn solve_in_intervals(&mut self, island: &mut DirectIsland, factor: u32) -> SolveStats {
        let unit = self.length_unit();
        let slop = island.load_bodies(self.bodies, 0.0, unit);
        island.is_released = false;
        island.resting_bodies.clear();
        let intervals = factor * island.begin_articulation(self.joints, self.step);
        // The tolerance at rest would add up to a wrong angle of a slow motor.
        let reader = RowReader::new(self.bodies, self.step, slop, unit * MOVING_VELOCITY_ERROR)
            .of_interval(f64::from(self.step.dt) / f64::from(intervals));
        let max_steps = max_newton_steps(island);
        let mut total = SolveStats { newton_steps: 0, residual: 0.0, is_solved: true };
        for interval in 0..=intervals {
            let stats = island.step_interval(&reader, (interval, intervals), (unit, max_steps));
            total.newton_steps += stats.newton_steps;
            total.residual = max_or_nan(stats.residual, total.residual);
            total.is_solved = stats.is_solved;
            if !total.is_solved {
                return total;
            }
        }
        total.is_solved = self.finish_articulation(island, slop);
        total
    }

    /// Closes the joints after the last interval of a step, and stores their forces if the solution is accepted. Returns whether
    /// it is. `slop` is the joint error that remains uncorrected, in length units.
    fn finish_articulation(&mut self, island: &mut DirectIsland, slop: f64) -> bool {
        let (dt, limits) = (f64::from(self.step.dt), [slop, self.max_correction(), 0.0]);
        island.displacements.clone_from(&island.total_displacements);
        let gap = island.solve_positions(self.joints, (dt, 0.0), limits, 0.0, None).error;
        island.was_articulation = gap <= ACCEPTED_JOINT_ERROR * self.length_unit();
        if island.was_articulation {
            for (&at, total) in island.joints.iter().zip(&island.joint_impulses) {
                self.joints.set_force(at, total.map(|impulse| impulse / dt + 0.0));
            }
        }
        island.was_articulation
    }
}
