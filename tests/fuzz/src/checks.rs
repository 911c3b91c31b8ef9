//! Checks of invariants that hold after every call of a game.

use std::cell::RefCell;

use crate::engine::Engine;
use crate::game::{Game, Outcome, play};
use crate::random::Random;

/// Probability that a call is checked, in percent. A snapshot takes longer than most calls.
const CHECK_PERCENT: u64 = 30;

/// Plays the game of a seed and checks: a call that failed or only queried leaves the snapshot unchanged.
///
/// # Errors
/// Names the first failed call or query that changed the snapshot.
pub fn failed_calls_change_nothing<G: Game>(seed: u64) -> Result<(), String> {
    let mut random = Random::new(seed ^ 0x7777);
    let snapshot = RefCell::new(None);
    let before =
        |game: &G| *snapshot.borrow_mut() = random.chance(CHECK_PERCENT).then(|| game.simulator().snapshot());
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

/// Plays the game of a seed and checks that every readable number of the simulator is finite, after every update and some other
/// calls.
///
/// # Errors
/// Names the first number that is not finite.
pub fn numbers_are_finite<G: Game>(seed: u64) -> Result<(), String> {
    let mut random = Random::new(seed ^ 0x7777);
    play(
        seed,
        |_: &G| (),
        |game, outcome| {
            if outcome == Outcome::Updated || random.chance(CHECK_PERCENT) {
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

    /// A game for a test of the check. Its only call reports a failure, but makes a body.
    struct FaultyGame {
        simulator: PhysicsSimulator,
        random: Random,
    }

    impl Game for FaultyGame {
        type Simulator = PhysicsSimulator;
        const SCENES: usize = 1;

        fn new(random: Random) -> Self {
            FaultyGame::of(PhysicsSimulator::default(), random)
        }
        fn of(simulator: PhysicsSimulator, random: Random) -> Self {
            FaultyGame { simulator, random }
        }
        fn scene(_: usize) -> PhysicsSimulator {
            PhysicsSimulator::default()
        }
        fn calls() -> &'static [Call<Self>] {
            const MAKE: fn(&mut FaultyGame) -> Outcome = |liar| {
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
    fn a_failed_call_that_changed_the_simulator_is_detected() {
        let error = failed_calls_change_nothing::<FaultyGame>(1).unwrap_err();
        assert!(error.contains("create a body: it answered Failed and changed something"), "{error}");
    }
}
