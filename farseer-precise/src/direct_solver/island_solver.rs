//! Solution of the islands of the direct solver, and what it costs them.
//!
//! Most islands are at rest: their stored impulses still satisfy all constraints. The residual of the stored constraints shows
//! it, and no rows are built for them. An island with a larger residual is solved by [`island_newton`](super::island_newton).

use super::DirectSolver;
use super::cost_model::{direct_update_cost, update_budget, world_cost_limit};
use super::island_body::MemberIndex;
use super::island_history::{Histories, IslandHistory, ReselectionTimer};
use super::island_io::{DirectIsland, RowReader, free_velocity};
use super::island_newton::{SolveStats, Tolerances};
use crate::bodies::BodySet;
use crate::constraint_graph::ConstraintGraph;
use crate::index::BodyIndex;
use crate::joints::JointSystem;
use crate::joints::springs::SpringRows;
use crate::parameters::direct::{
    ACCEPTED_VELOCITY_ERROR, BUSY_ISLAND_PAUSE, CORRECTED_SLOP_FRACTION, CYCLIC_PENETRATION_FRACTION,
    CYCLIC_PENETRATION_SPEED, CYCLIC_VELOCITY_ERROR, DEPTH_NEWTON_LIMIT, EXACT_VELOCITY_ERROR,
    FRICTIONLESS_SPEED_GAIN, LATERAL_SLIP_MIN_SPEED, MOVING_SOLUTION_NEWTON_STEPS, MOVING_VELOCITY_ERROR,
    NEWTON_AVERAGE_UPDATES, NEWTON_LIMIT, NEWTON_LIMIT_PER_BODY, RESTING_VELOCITY_ERROR,
    SOLUTION_NEWTON_STEPS, SOLVED_VELOCITY_ERROR,
};
use crate::scaled_parameters::{Parameters, StepContext};
use crate::solver_choice::SolverChoice;
/// The parts of the engine that the direct solver reads and writes for its islands.
pub(crate) struct IslandSolver<'a> {
    pub(crate) bodies: &'a BodySet,
    pub(crate) constraints: &'a mut ConstraintGraph,
    pub(crate) joints: &'a mut JointSystem,
    pub(crate) springs: &'a mut SpringRows,
    pub(crate) parameters: &'a Parameters,
    pub(crate) step: &'a StepContext,
    /// The user's choice of solvers for all islands.
    pub(crate) choice: SolverChoice,
    /// Whether the simulator has a depth axis (2.5D).
    pub(crate) has_depth: bool,
}

impl DirectSolver {
    /// Solves all islands of the direct solver. [`store`](Self::store) later writes the solved velocities to the bodies. Islands
    /// without an acceptable solution, and those [on trial](super::island_stats::IslandStats::is_on_trial) that need no friction,
    /// go to the iterative solver. Returns whether there was one, so that contact constraints must
    /// [move](Self::move_constraints).
    pub(crate) fn solve(&mut self, mut solver: IslandSolver<'_>) -> bool {
        let seconds = [solver.step.dt, solver.step.h];
        let has_changed = solver.constraints.take_direct_change()
            | (std::mem::replace(&mut self.step_lengths, seconds) != seconds);
        let DirectSolver { islands, count, history, timer, scratch, .. } = self;
        let mut cost_left = world_cost_limit(islands.slice(..*count).iter());
        for island in islands.slice_mut(..*count) {
            island.cost_limit = cost_left;
            island.has_impulse_sum &= !has_changed;
            island.system.swap_scratch(scratch);
            solver.try_and_solve(island, history, timer);
            cost_left -= direct_update_cost(island);
            island.system.swap_scratch(scratch);
        }
        self.release_unsolved()
    }

    /// Writes the velocities and displacements of the members of all islands to `bodies`, after a step of `dt` seconds.
    pub(crate) fn store(&self, bodies: &mut BodySet, dt: f32) {
        for DirectIsland { system, displacements, .. } in self.islands.slice(..self.count) {
            for (member, displacement) in system.members.iter().zip(displacements) {
                // Adding 0 removes negative zeros, which a body that cannot rotate may get here and a loaded snapshot never
                // has.
                let [x, y, spin] = member.velocity.map(|velocity| velocity as f32 + 0.0);
                let depth = member.depth_velocity as f32 + 0.0;
                bodies.states[member.body].velocity = [x, y, spin, depth];
                let [x, y, turned] = displacement.map(|component| component as f32);
                bodies.delta_pose[member.body] = [x, y, turned, depth * dt];
            }
        }
    }
}

impl IslandSolver<'_> {
    /// Solves one island and stores the result in the histories of its members, or releases it if it is on trial and needs no
    /// friction. `history` is indexed by body.
    fn try_and_solve(
        &mut self,
        island: &mut DirectIsland,
        history: &mut Histories,
        timer: &mut ReselectionTimer,
    ) {
        if std::mem::take(&mut island.is_on_trial) {
            if !self.stands_by_friction(island) {
                (island.is_released, island.newton_steps) = (true, 0);
                return;
            }
            let members = &island.system.members;
            members.iter().for_each(|member| history[member.body].friction_checks = 0);
        }
        let stats = self.solve_island(island, history[island.system.members[MemberIndex(0)].body]);
        record_stats(history, timer, island, stats, self.has_depth);
        island.newton_steps = stats.newton_steps;
    }

    /// Returns the length unit, in the user's unit of length, > 0.
    pub(super) fn length_unit(&self) -> f64 {
        f64::from(self.parameters.length_unit)
    }

    /// Solves one island: as a free articulation, as an island with joints, or as an island of contacts. `history` is that of
    /// its members. Returns Newton steps, residual and acceptance of the solution.
    fn solve_island(&mut self, island: &mut DirectIsland, history: IslandHistory) -> SolveStats {
        island.was_articulation = false;
        if !island.has_joints() {
            return self.solve_contact_island(island, history);
        }
        let steps = match island.is_free_articulation(self.joints) {
            true => match self.solve_articulation(island) {
                stats if stats.is_solved => return stats,
                stats => stats.newton_steps,
            },
            false => 0,
        };
        let stats = self.solve_jointed_island(island, history);
        SolveStats { newton_steps: steps + stats.newton_steps, ..stats }
    }

    /// Returns whether an island of contacts stands by friction: with all friction coefficients 0 a body would gain speed in this
    /// step.
    fn stands_by_friction(&self, island: &mut DirectIsland) -> bool {
        let (bodies, unit) = (self.bodies, self.length_unit());
        let slop = island.load_bodies(bodies, f64::from(self.step.substeps), unit);
        let reader = RowReader::new(bodies, self.step, slop, unit * RESTING_VELOCITY_ERROR);
        island.make_contacts(self.constraints, &reader, false);
        let system = &mut island.system;
        system.contacts.iter_mut().for_each(|contact| contact.friction = 0.0);
        let residual = system.begin_solve(reader.dt, [slop, LATERAL_SLIP_MIN_SPEED * unit]);
        system.solve(&contact_tolerances(residual, unit, SOLUTION_NEWTON_STEPS));
        let speed = |[x, y]: [f64; 2]| (x * x + y * y).sqrt();
        system.members.iter().any(|member| {
            let [x0, y0, ..] = bodies.states[member.body].velocity.map(f64::from);
            let [x, y, ..] = free_velocity(bodies, member.body, reader.substeps);
            let most = speed([x0, y0]) + FRICTIONLESS_SPEED_GAIN * speed([x - x0, y - y0]);
            speed([member.velocity[0], member.velocity[1]]) > most + reader.velocity_tolerance
        })
    }

    /// Solves an island of contacts, without joints and springs. `history` is that of its members. Returns Newton steps,
    /// residual and acceptance of the solution.
    fn solve_contact_island(&mut self, island: &mut DirectIsland, history: IslandHistory) -> SolveStats {
        let unit = self.length_unit();
        let slop = island.load_bodies(self.bodies, f64::from(self.step.substeps), unit);
        let error = if history.was_iterated { MOVING_VELOCITY_ERROR } else { RESTING_VELOCITY_ERROR };
        island.is_released = false;
        let reader = RowReader::new(self.bodies, self.step, slop, unit * error);
        island.apply_warm_start(self.constraints, &reader);
        if let Some(residual) = self.keep_contact_solution(island, &reader, history.was_iterated) {
            return SolveStats { newton_steps: 0, residual, is_solved: true };
        }
        island.make_contacts(self.constraints, &reader, self.has_depth);
        let residual = island.system.begin_solve(reader.dt, [slop, LATERAL_SLIP_MIN_SPEED * unit]);
        let has_budget = island.has_cyclic_budget(self.has_depth);
        let max_newton_steps = match history.formed_by_motion && has_budget {
            true => MOVING_SOLUTION_NEWTON_STEPS,
            false => SOLUTION_NEWTON_STEPS,
        };
        let free = |body: BodyIndex| {
            let [x, y, spin, _] = free_velocity(self.bodies, body, reader.substeps);
            [x, y, spin]
        };
        let mut is_unsound = false;
        let stats = if residual > reader.velocity_tolerance {
            let stats = island.system.solve(&contact_tolerances(residual, unit, max_newton_steps));
            is_unsound = island.system.exceeds_free_motion(free, reader.dt, unit);
            SolveStats { is_solved: stats.is_solved && !is_unsound, ..stats }
        } else {
            SolveStats { newton_steps: 0, residual, is_solved: true }
        };
        island.is_released = self.is_release_allowed() && !stats.is_solved && (is_unsound || !has_budget);
        if island.is_released {
            island.system.scale_down_impulses(free, unit);
        } else {
            self.correct_contact_positions(island, &reader, has_budget, history);
        }
        let impact_speed = self.parameters.load_adaptation_speed;
        island.store_solution(self.constraints, (reader.substeps, self.step.h), impact_speed);
        stats
    }

    /// In 2D: keeps the stored impulses of an island of contacts if they still satisfy all constraints. Returns the velocity
    /// residual then, in length units/s; `None` if the island needs a solution. `was_iterated` is that of its history.
    fn keep_contact_solution(
        &mut self,
        island: &mut DirectIsland,
        reader: &RowReader<'_>,
        was_iterated: bool,
    ) -> Option<f64> {
        if self.has_depth {
            return None;
        }
        let [residual, deepest] = island.residual(self.constraints, reader);
        let is_correcting = was_iterated && island.has_cyclic_budget(self.has_depth);
        if residual <= reader.velocity_tolerance && deepest <= uncorrected_penetration(reader, is_correcting)
        {
            island.keep_solution(self.constraints, reader.step, reader.substeps);
            island.find_displacements(reader.dt, false);
            return Some(residual);
        }
        island.undo_residual(self.constraints);
        None
    }

    /// Resolves the penetration of an island of contacts and its friction along the depth axis, after the solution of the
    /// velocities. An island with a budget or with contact cycles built in place gets a fraction of the correction only.
    fn correct_contact_positions(
        &self,
        island: &mut DirectIsland,
        reader: &RowReader<'_>,
        has_budget: bool,
        history: IslandHistory,
    ) {
        let (unit, dt) = (self.length_unit(), reader.dt);
        let has_built_cycles = island.system.has_contact_cycles() && !history.formed_by_motion;
        let resolved_fraction =
            if has_budget || has_built_cycles { CYCLIC_PENETRATION_FRACTION } else { 1.0 };
        let max_correction =
            if has_budget { CYCLIC_PENETRATION_SPEED * unit * dt } else { self.max_correction() };
        let limits = [uncorrected_penetration(reader, has_budget), reader.penetration_slop, max_correction];
        let has_corrections = island.system.resolve_penetration(dt, limits, resolved_fraction);
        island.system.solve_lateral_friction(unit);
        island.find_displacements(dt, has_corrections);
    }
}

/// Returns the greatest penetration that an island of contacts leaves uncorrected, in length units. `is_correcting`: whether the
/// island has contact cycles with a budget, and corrects its penetration little by little.
fn uncorrected_penetration(reader: &RowReader<'_>, is_correcting: bool) -> f64 {
    if is_correcting { CORRECTED_SLOP_FRACTION * reader.penetration_slop } else { reader.penetration_slop }
}

/// Returns the tolerances of an island of contacts. `residual` is its velocity residual before the solution, length units/s,
/// `unit` the length unit, and `max_newton_steps` the limit of Newton steps with contact cycles.
fn contact_tolerances(residual: f64, unit: f64, max_newton_steps: usize) -> Tolerances {
    let acceptable = unit * ACCEPTED_VELOCITY_ERROR;
    Tolerances {
        initial_residual: residual,
        acceptable: if residual > acceptable { residual } else { acceptable },
        sufficient: unit * SOLVED_VELOCITY_ERROR,
        exact: unit * EXACT_VELOCITY_ERROR,
        resting: unit * RESTING_VELOCITY_ERROR,
        moving_cycles: unit * CYCLIC_VELOCITY_ERROR,
        max_newton_steps,
    }
}

/// Stores the Newton steps or the modelled cost of an update in the island history of each member. An island with too many
/// Newton steps, an overdrawn budget or no accepted solution goes to the iterative solver for a pause. `histories` are indexed by
/// body.
///
/// Islands that may jam get no pause below [`DEPTH_NEWTON_LIMIT`]: a direct solution in every other update is better than the
/// iterative solver.
fn record_stats(
    histories: &mut Histories,
    timer: &mut ReselectionTimer,
    island: &DirectIsland,
    stats: SolveStats,
    has_depth: bool,
) {
    if island.has_joints() || island.has_cyclic_budget(has_depth) {
        return update_budget(histories, timer, island, stats);
    }
    let SolveStats { newton_steps: steps, is_solved, .. } = stats;
    let (system, contacts) = (&island.system, island.contact_handles.len());
    let bodies = system.members.len();
    let mut history = histories[system.members[MemberIndex(0)].body];
    history.average_newton_steps += (steps as f32 - history.average_newton_steps) / NEWTON_AVERAGE_UPDATES;
    history.was_iterated = steps > 0;
    let has_cycles = usize::from(contacts > bodies);
    let by_size = NEWTON_LIMIT[has_cycles] + NEWTON_LIMIT_PER_BODY[has_cycles] * bodies as f32;
    let max_steps = if has_depth { DEPTH_NEWTON_LIMIT } else { by_size };
    if (history.average_newton_steps > max_steps || !is_solved) && timer.choice != SolverChoice::Direct {
        let stays =
            history.average_newton_steps <= DEPTH_NEWTON_LIMIT && system.may_jam(&island.contact_bodies);
        timer.is_due |= !(is_solved && stays);
        if !stays {
            (history.average_newton_steps, history.pause) = (0.0, BUSY_ISLAND_PAUSE);
            timer.has_paused = true;
        }
    }
    for member in system.members.iter() {
        histories[member.body] = history;
    }
}
