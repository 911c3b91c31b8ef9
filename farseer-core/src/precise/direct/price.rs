//! Whether solving an island with joints or contact cycles as a whole pays: its cost beside the iterative solver's, and a budget for that.
//!
//! Costs were measured over islands of 2 to 1,200 rows, in microseconds of one machine; only their ratios matter, and they are fixed so
//! that the choice is the same on every machine. A budget, which may be overdrawn, instead of an average: houses, figures and bridges
//! take ten Newton steps for a second, and none for ever after.

use super::factor::Factor;
use super::whole::Whole;
use crate::methods::IslandChoice;
use crate::precise::Precise;
use crate::precise::parameters::direct::{
    BUDGET_OVERDRAFT, CYCLIC_BUDGET, CYCLIC_BUDGET_OVERDRAFT, DIRECT_BUDGET, FACTOR_BLOCK_COST,
    FACTOR_PRODUCT_COST, FAILED_SOLUTION_COST, FIRST_BUDGET_PAUSE, ITERATIVE_CONTACT_COST,
    ITERATIVE_ISLAND_COST, ITERATIVE_JOINT_COST, NEWTON_BODY_COST, NEWTON_CONSTRAINT_COST, NEWTON_STEP_COST,
    RESTING_CONSTRAINT_COST, UNLIKE_MASS_BUDGET, UPDATE_COST_LIMIT, UPDATE_NEWTON_STEPS,
};

impl Precise {
    /// The budget of an island pays for an update. An island without budget, or one with joints that could not be
    /// solved, is left to the iterative solver.
    pub(super) fn pay(&mut self, whole: &Whole, steps: usize, is_solved: bool) {
        let timing = &mut self.direct.timing;
        let mut wear = self.direct.wear[whole.island.members[0].number as usize];
        wear.is_hot = steps > 0;
        wear.was_solved |= whole.is_joined() && !whole.is_left;
        let cost = match is_solved {
            // Parts of the step are asked for by the motion: the iterative solver has no cheaper way to be as exact.
            true if whole.has_swung => 0.0,
            true => cost_in_updates(whole, steps),
            false => cost_in_updates(whole, steps) + FAILED_SOLUTION_COST,
        };
        let (income, overdraft) = match whole.is_joined() {
            true if whole.is_unlike() => (UNLIKE_MASS_BUDGET, BUDGET_OVERDRAFT),
            true => (DIRECT_BUDGET, BUDGET_OVERDRAFT),
            false => (CYCLIC_BUDGET, CYCLIC_BUDGET_OVERDRAFT / iterative_update(whole)),
        };
        // A part, as islands with different overdrafts may become one.
        let budget = f64::from(wear.budget) + (income - cost) / overdraft;
        let is_overdrawn = budget < -1.0;
        // No negative zero is saved.
        wear.budget = if is_overdrawn { -0.5 } else { budget.min(0.0) + 0.0 } as f32;
        let is_optional = timing.choice != IslandChoice::Whole;
        if (is_overdrawn || whole.is_left) && is_optional {
            wear.back_off = wear.back_off.saturating_mul(2).max(FIRST_BUDGET_PAUSE);
            wear.rest = wear.back_off;
            timing.has_resting = true;
            timing.is_due |= !whole.is_left;
        } else if steps == 0 {
            wear.back_off = wear.back_off.saturating_sub(1);
        }
        for member in &whole.island.members {
            self.direct.wear[member.number as usize] = wear;
        }
    }
}

impl Whole {
    /// Whether joints or contacts tie bodies of such different masses that the iterative solver may jam them.
    fn is_unlike(&self) -> bool {
        self.island.may_jam(&self.joint_ends) || self.island.may_jam(&self.ends)
    }
}

/// Most Newton steps of an update.
pub(super) fn most_steps(whole: &Whole) -> usize {
    let [least, most] = UPDATE_NEWTON_STEPS;
    let step = newton_step(&whole.island.factor, (whole.homes.len() + whole.joint_count()) as f64);
    (UPDATE_COST_LIMIT * iterative_update(whole) / step).clamp(least, most) as usize
}

/// Cost of an update of the iterative solver.
fn iterative_update(whole: &Whole) -> f64 {
    ITERATIVE_ISLAND_COST
        + ITERATIVE_JOINT_COST * whole.joint_count() as f64
        + ITERATIVE_CONTACT_COST * whole.homes.len() as f64
}

/// Cost of an update with so many Newton steps, in updates of the iterative solver.
fn cost_in_updates(whole: &Whole, steps: usize) -> f64 {
    let constraints = (whole.homes.len() + whole.joint_count()) as f64;
    (steps as f64 * newton_step(&whole.island.factor, constraints) + RESTING_CONSTRAINT_COST * constraints)
        / iterative_update(whole)
}

fn newton_step(factor: &Factor, constraints: f64) -> f64 {
    let [bodies, blocks, products] = factor.sizes().map(|count| count as f64);
    NEWTON_STEP_COST
        + NEWTON_CONSTRAINT_COST * constraints
        + NEWTON_BODY_COST * bodies
        + FACTOR_BLOCK_COST * blocks
        + FACTOR_PRODUCT_COST * products
}
