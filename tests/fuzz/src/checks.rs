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
