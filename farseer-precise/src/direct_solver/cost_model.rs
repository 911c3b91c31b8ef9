//! Cost model of the direct solver: decides how long an island with joints or contact cycles stays with it.
//!
//! Each such island has a budget, at most 0. An update subtracts its modelled cost from the budget and adds a fixed income.
//! Both are multiples of the modelled cost of one update of the iterative solver for the island. An island that overdraws its
//! budget by more than the greatest overdraft goes to the iterative solver for a pause.
//!
//! The terms of the model were measured over islands of 2 to 1,200 rows, in microseconds on one machine. Only their ratios
//! matter, and they are constants, so that the selection is the same on every machine. A budget bears short peaks, unlike a
//! limit of the average: houses, figures and bridges need ten Newton steps per update for a second, and none afterwards.

use super::block_ldlt::BlockLdlt;
use super::island_body::MemberIndex;
use super::island_history::{Histories, ReselectionTimer};
use super::island_io::DirectIsland;
use super::island_newton::SolveStats;
use crate::parameters::direct::{
    BUDGET_AFTER_OVERDRAFT, BUDGET_OVERDRAFT, CYCLIC_BUDGET, CYCLIC_BUDGET_OVERDRAFT, FACTOR_BLOCK_COST,
    FACTOR_PRODUCT_COST, FAILED_SOLUTION_COST, FIRST_BUDGET_PAUSE, FREE_UPDATE_NEWTON_STEPS,
    ITERATIVE_CONTACT_COST, ITERATIVE_ISLAND_COST, ITERATIVE_JOINT_COST, JOINTED_BUDGET, MASS_RATIO_BUDGET,
    MOVING_BUDGET_OVERDRAFT, NEWTON_BODY_COST, NEWTON_CONSTRAINT_COST, NEWTON_STEP_COST,
    RESTING_CONSTRAINT_COST, UPDATE_COST_LIMIT, UPDATE_NEWTON_STEPS, WORLD_COST_LIMIT,
};
use crate::solver_choice::SolverChoice;

/// Charges the modelled cost of an update to the budget of an island, and stores its new island history for all members.
/// `histories` are indexed by body.
///
/// An island that overdraws its budget, or that is released because its joints have no solution, gets a pause: it goes to the
/// iterative solver.
pub(super) fn update_budget(
    histories: &mut Histories,
    timer: &mut ReselectionTimer,
    island: &DirectIsland,
    SolveStats { newton_steps: steps, is_solved, .. }: SolveStats,
) {
    let mut history = histories[island.system.members[MemberIndex(0)].body];
    history.was_iterated = steps > 0;
    history.has_accepted_solution |= island.has_joints() && !island.is_released;
    let cost = match is_solved {
        // The motion demands the intervals of an articulation: the iterative solver is not cheaper at equal accuracy.
        true if island.was_articulation => 0.0,
        true => relative_cost(island, steps),
        false => relative_cost(island, steps) + FAILED_SOLUTION_COST,
    };
    let (income, overdraft) = match island.has_joints() {
        true if island.has_large_mass_ratio() => (MASS_RATIO_BUDGET, BUDGET_OVERDRAFT),
        true => (JOINTED_BUDGET, BUDGET_OVERDRAFT),
        false if history.formed_by_motion => {
            (CYCLIC_BUDGET, MOVING_BUDGET_OVERDRAFT / iterative_update_cost(island))
        }
        false => (CYCLIC_BUDGET, CYCLIC_BUDGET_OVERDRAFT / iterative_update_cost(island)),
    };
    // The budget is a fraction, since islands with different overdrafts may merge.
    let budget = f64::from(history.budget) + (income - cost) / overdraft;
    let is_overdrawn = budget < -1.0;
    // Adding 0 keeps a negative zero out of snapshots.
    history.budget = if is_overdrawn { BUDGET_AFTER_OVERDRAFT } else { budget.min(0.0) + 0.0 } as f32;
    let is_optional = timer.choice != SolverChoice::Direct;
    if (is_overdrawn || island.is_released) && is_optional {
        history.back_off = history.back_off.saturating_mul(2).max(FIRST_BUDGET_PAUSE);
        history.pause = history.back_off;
        timer.has_paused = true;
        timer.is_due |= !island.is_released;
    } else if steps == 0 {
        history.back_off = history.back_off.saturating_sub(1);
    }
    for member in island.system.members.iter() {
        histories[member.body] = history;
    }
}

impl DirectIsland {
    /// Returns whether a joint or contact of the island connects bodies of so large a mass ratio that the iterative solver may
    /// jam them.
    fn has_large_mass_ratio(&self) -> bool {
        self.system.may_jam(&self.joint_bodies) || self.system.may_jam(&self.contact_bodies)
    }
}

/// Returns the modelled cost that the Newton steps of all `islands` together may have in one update, in microseconds:
/// [`WORLD_COST_LIMIT`]. Islands that come when it is spent get the fewest steps.
pub(super) fn world_cost_limit<'a>(islands: impl Iterator<Item = &'a DirectIsland>) -> f64 {
    let [at_least, ratio] = WORLD_COST_LIMIT;
    at_least + ratio * islands.map(iterative_update_cost).sum::<f64>()
}

/// Returns the modelled cost of the last update of `island` in the direct solver, in microseconds.
pub(super) fn direct_update_cost(island: &DirectIsland) -> f64 {
    relative_cost(island, island.newton_steps) * iterative_update_cost(island)
}

/// Returns the maximum number of Newton steps in one update of `island`: so many that their modelled cost is at most
/// [`UPDATE_COST_LIMIT`] and what the other islands leave of [`WORLD_COST_LIMIT`]. It is in the range [`UPDATE_NEWTON_STEPS`],
/// without contacts up to [`FREE_UPDATE_NEWTON_STEPS`].
pub(super) fn max_newton_steps(island: &DirectIsland) -> usize {
    let [min_steps, max_steps] = UPDATE_NEWTON_STEPS;
    let step =
        newton_step_cost(&island.system.factor, (island.contact_handles.len() + island.joint_count()) as f64);
    let limit = (UPDATE_COST_LIMIT * iterative_update_cost(island)).min(island.cost_limit);
    let max_steps = if island.contact_handles.is_empty() { FREE_UPDATE_NEWTON_STEPS } else { max_steps };
    (limit / step).clamp(min_steps, max_steps) as usize
}

/// Returns the modelled cost of `steps` Newton steps of `island`, in microseconds.
pub(super) fn newton_steps_cost(island: &DirectIsland, steps: usize) -> f64 {
    let constraints = island.contact_handles.len() + island.joint_count();
    steps as f64 * newton_step_cost(&island.system.factor, constraints as f64)
}

/// Returns the modelled cost of one update of the iterative solver for `island`, in microseconds.
fn iterative_update_cost(island: &DirectIsland) -> f64 {
    ITERATIVE_ISLAND_COST
        + ITERATIVE_JOINT_COST * island.joint_count() as f64
        + ITERATIVE_CONTACT_COST * island.contact_handles.len() as f64
}

/// Returns the modelled cost of an update of the direct solver with `steps` Newton steps, as a multiple of the modelled cost of
/// one update of the iterative solver. Dimensionless.
fn relative_cost(island: &DirectIsland, steps: usize) -> f64 {
    let constraints = (island.contact_handles.len() + island.joint_count()) as f64;
    (steps as f64 * newton_step_cost(&island.system.factor, constraints)
        + RESTING_CONSTRAINT_COST * constraints)
        / iterative_update_cost(island)
}

/// Returns the modelled cost of one Newton step, in microseconds, from the sizes of the factors and the number of constraints.
fn newton_step_cost(factor: &BlockLdlt, constraints: f64) -> f64 {
    let [bodies, blocks, products] = factor.sizes().map(|count| count as f64);
    NEWTON_STEP_COST
        + NEWTON_CONSTRAINT_COST * constraints
        + NEWTON_BODY_COST * bodies
        + FACTOR_BLOCK_COST * blocks
        + FACTOR_PRODUCT_COST * products
}
