//! Whether solving an island with joints as a whole pays: what it costs beside the iterative solver, and a budget for that.
//!
//! Costs were measured over islands of 2 to 1,200 rows, in microseconds of one machine; only their ratios matter, and they are fixed so
//! that the choice is the same on every machine. A budget, which may be overdrawn, instead of an average: houses, figures and bridges
//! take ten Newton steps for a second, and none for ever after.

use super::factor::Factor;
use super::whole::Whole;
use crate::methods::IslandChoice;
use crate::precise::Precise;

/// Cost of a Newton step, in microseconds: of itself, and for each constraint, body, block of the factors and product of two blocks.
const STEP: f64 = 0.3;
const PER_CONSTRAINT: f64 = 0.029;
const PER_BODY: f64 = 0.074;
const PER_BLOCK: f64 = 0.025;
const PER_PRODUCT: f64 = 0.0025;
/// Cost of an update for each constraint, without Newton steps.
const PER_QUIET_CONSTRAINT: f64 = 0.08;
/// Cost of an update of the iterative solver, in microseconds: of an island, and for each joint and contact. The first one is an
/// estimate of the other stages for the smallest island: one that takes no longer than that is worth being exact.
///
/// They are those of joints that were solved one after the other. Four at a time they take a quarter of it: the budget is as large as it
/// was for the accuracy, which is that of before.
const ITERATIVE: f64 = 0.5;
const ITERATIVE_JOINT: f64 = 0.3;
const ITERATIVE_CONTACT: f64 = 0.1;

/// Updates of the iterative solver that an update of the direct solver may cost on the average, by these costs: with 3, twice as many of
/// random figures gape at the end.
const INCOME: f64 = 5.0;
/// The same where joints or contacts tie bodies of which one is far heavier: the iterative solver needs many times as many passes there.
const INCOME_OF_UNLIKE: f64 = 10.0;
/// Cost of an update without an accepted solution beside that of its Newton steps, in updates of the iterative solver.
const UNSOLVED: f64 = 20.0;
/// Updates of the iterative solver by which the budget may be overdrawn: figures, houses and bridges that fall into place take fewer.
const OVERDRAFT: f64 = 300.0;
/// Updates of the iterative solver that the Newton steps of one update may cost: large nets would take half a second for 20 steps.
const MOST_AT_ONCE: f64 = 30.0;
/// Least and most Newton steps of an update: fewer find no active set, and what more of them find the next update finds as well.
const STEPS_AT_ONCE: [f64; 2] = [4.0, 20.0];
/// Updates for which an island that was given up is left to the iterative solver: the first time; then twice as many, up to 255.
const FIRST_REST: u8 = 64;

impl Precise {
    /// The budget of an island pays for an update. An island without budget, or without a solution, is left to the iterative solver.
    pub(super) fn pay(&mut self, whole: &Whole, steps: usize, is_solved: bool) {
        let timing = &mut self.direct.timing;
        let mut wear = self.direct.wear[whole.island.members[0].number as usize];
        wear.is_hot = steps > 0;
        wear.was_solved |= !whole.is_left;
        let cost = match is_solved {
            // Parts of the step are asked for by the motion: the iterative solver has no cheaper way to be as exact.
            true if whole.has_swung => 0.0,
            true => cost_in_updates(whole, steps),
            false => cost_in_updates(whole, steps) + UNSOLVED,
        };
        let income = if whole.is_unlike() { INCOME_OF_UNLIKE } else { INCOME };
        let budget = f64::from(wear.budget) + income - cost;
        // No negative zero is saved.
        let budget = if budget < 0.0 { budget } else { 0.0 };
        let is_overdrawn = budget < -OVERDRAFT;
        wear.budget = if is_overdrawn { -0.5 * OVERDRAFT } else { budget } as f32;
        if (is_overdrawn || whole.is_left) && timing.choice != IslandChoice::Whole {
            wear.back_off = wear.back_off.saturating_mul(2).max(FIRST_REST);
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
    let [least, most] = STEPS_AT_ONCE;
    let step = newton_step(&whole.island.factor, (whole.homes.len() + whole.joint_count()) as f64);
    (MOST_AT_ONCE * iterative_update(whole) / step).clamp(least, most) as usize
}

/// Cost of an update of the iterative solver.
fn iterative_update(whole: &Whole) -> f64 {
    ITERATIVE + ITERATIVE_JOINT * whole.joint_count() as f64 + ITERATIVE_CONTACT * whole.homes.len() as f64
}

/// Cost of an update with so many Newton steps, in updates of the iterative solver.
fn cost_in_updates(whole: &Whole, steps: usize) -> f64 {
    let constraints = (whole.homes.len() + whole.joint_count()) as f64;
    (steps as f64 * newton_step(&whole.island.factor, constraints) + PER_QUIET_CONSTRAINT * constraints)
        / iterative_update(whole)
}

fn newton_step(factor: &Factor, constraints: f64) -> f64 {
    let [bodies, blocks, products] = factor.sizes().map(|count| count as f64);
    STEP + PER_CONSTRAINT * constraints + PER_BODY * bodies + PER_BLOCK * blocks + PER_PRODUCT * products
}
