//! Long runs in which things come and go.

use crate::churn::{Churn, is_before_a_replacement};
use crate::engine::Engine;

/// Parts of a run that are compared.
const PARTS: usize = 5;

/// What a part of a run has come to.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Part {
    /// Bytes of the longest snapshot.
    pub longest: usize,
    /// Pairs that were tested and contacts that were found, in all updates: what takes time, and is the same on every machine.
    pub work: usize,
}

/// What it holds and does stays as it was: the longest snapshot in the last fifth of a run is at most a twelfth longer than any
/// before, and the work at most a quarter more than in the second fifth: what grows is longest at the end. Contacts come and go,
/// too: in runs of 25,000 updates the work of a fifth differs by up to an eighth from that of another, and in 2.5D the longest
/// snapshot of a fifth has 29 to 42 KB, as much as rests or touches when it is made. In runs of 20,000, 50,000 and 1,000,000 updates ids and creation numbers take as many bytes
/// in both.
///
/// # Errors
/// All parts, if they grow.
pub fn stays_as_it_is(churn: &mut impl Churn, updates: usize) -> Result<(), String> {
    let parts = parts(churn, updates / PARTS).map_err(|error| error.to_string())?;
    let (early, late) = (parts[1], parts[PARTS - 1]);
    let longest = parts[..PARTS - 1].iter().map(|part| part.longest).max().unwrap_or(0);
    let holds = late.longest * 12 <= longest * 13 && late.work * 4 <= early.work * 5;
    if holds { Ok(()) } else { Err(format!("{parts:?}")) }
}

/// A run of so many updates each.
fn parts(churn: &mut impl Churn, updates: usize) -> Result<[Part; PARTS], Box<dyn std::error::Error>> {
    let mut parts = [Part::default(); PARTS];
    for update in 0..PARTS * updates {
        churn.go_on(update)?;
        let part = &mut parts[update / updates];
        part.work += churn.simulator().work();
        if is_before_a_replacement(update) {
            part.longest = churn.simulator().snapshot().len().max(part.longest);
        }
    }
    Ok(parts)
}
