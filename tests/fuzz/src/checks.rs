//! What must hold after every call of a game.

use std::cell::RefCell;

use crate::engine::Engine;
use crate::game::{Game, Outcome, play};
use crate::random::Random;

/// Of so many calls in a hundred it is checked, because a snapshot takes longer than most calls.
const OFTEN: u64 = 30;

/// A call that failed, or that only looked, leaves the snapshot as it was.
///
/// # Errors
/// The first call that changed something.
pub fn failed_calls_change_nothing<G: Game>(seed: u64) -> Result<(), String> {
    let mut random = Random::new(seed ^ 0x7777);
    let snapshot = RefCell::new(None);
    let before =
        |game: &G| *snapshot.borrow_mut() = random.chance(OFTEN).then(|| game.simulator().snapshot());
    play(seed, before, |game, outcome| {
        let may_change = matches!(outcome, Outcome::Changed | Outcome::Updated);
        match snapshot.take() {
            Some(before) if !may_change && game.simulator().snapshot() != before => {
                Err(format!("it answered {outcome:?} and changed something"))
            }
            _ => Ok(()),
        }
    })
}

/// Every number that a simulator shows is finite after every update and some other calls.
///
/// # Errors
/// The first number that is not.
pub fn numbers_are_finite<G: Game>(seed: u64) -> Result<(), String> {
    let mut random = Random::new(seed ^ 0x7777);
    play(
        seed,
        |_: &G| (),
        |game, outcome| {
            if outcome == Outcome::Updated || random.chance(OFTEN) {
                return game.simulator().check_numbers();
            }
            Ok(())
        },
    )
}

#[cfg(test)]
mod tests {
    use farseer_core::PhysicsSimulator;

    use super::failed_calls_change_nothing;
    use crate::game::{Call, Game, Outcome};
    use crate::random::Random;

    /// Says that its only call has failed, though it made a body.
    struct Liar {
        simulator: PhysicsSimulator,
        random: Random,
    }

    impl Game for Liar {
        type Simulator = PhysicsSimulator;
        const SCENES: usize = 1;

        fn new(random: Random) -> Self {
            Liar::of(PhysicsSimulator::default(), random)
        }
        fn of(simulator: PhysicsSimulator, random: Random) -> Self {
            Liar { simulator, random }
        }
        fn scene(_: usize) -> PhysicsSimulator {
            PhysicsSimulator::default()
        }
        fn calls() -> &'static [Call<Self>] {
            const MAKE: fn(&mut Liar) -> Outcome = |liar| {
                liar.simulator.create_body(farseer_core::Body::new());
                Outcome::Failed
            };
            &[Call { name: "create a body", weight: 1, make: MAKE }]
        }
        fn random(&mut self) -> &mut Random {
            &mut self.random
        }
        fn simulator(&self) -> &PhysicsSimulator {
            &self.simulator
        }
        fn simulator_mut(&mut self) -> &mut PhysicsSimulator {
            &mut self.simulator
        }
    }

    #[test]
    fn a_failed_call_that_changed_something_is_found() {
        let error = failed_calls_change_nothing::<Liar>(1).unwrap_err();
        assert!(error.contains("create a body: it answered Failed and changed something"), "{error}");
    }
}
