//! Tests long runs in which objects are added and removed.

use crate::churn::{Churn, is_before_a_replacement};
use crate::engine::Engine;

/// Number of parts of a run whose measurements are compared.
const PARTS: usize = 5;

/// Measurements of one part of a run.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct RunPart {
    /// Length of the longest snapshot, bytes.
    pub longest: usize,
    /// Number of tested pairs plus number of contacts in all updates. They cause the cost, and are the same on every machine.
    pub work: usize,
}

/// Checks in a long run that the size and work of a simulator do not grow.
///
/// The longest snapshot in the last fifth of the run may be a twelfth longer than any before. The work of the last fifth may be
/// a quarter greater than that of the second fifth. A leak would be greatest at the end.
///
/// Reasons for these limits: the number of contacts varies. In runs of 25,000 updates the work of two fifths differs by up to
/// an eighth. In 2.5D the longest snapshot of a fifth has 29 to 42 KB, depending on the bodies that rest and touch at that
/// moment. In runs of 20,000, 50,000 and 1,000,000 updates ids and creation numbers take as many bytes in both fifths.
///
/// # Errors
/// The measurements of all parts, if size or work grow by more.
pub fn does_not_grow(churn: &mut impl Churn, updates: usize) -> Result<(), String> {
    let parts = parts(churn, updates / PARTS).map_err(|error| error.to_string())?;
    let (early, late) = (parts[1], parts[PARTS - 1]);
    let longest = parts[..PARTS - 1].iter().map(|part| part.longest).max().unwrap_or(0);
    let holds = late.longest * 12 <= longest * 13 && late.work * 4 <= early.work * 5;
    if holds { Ok(()) } else { Err(format!("{parts:?}")) }
}

/// Makes a run in parts of `updates` updates each, and returns the measurements of each part.
fn parts(churn: &mut impl Churn, updates: usize) -> Result<[RunPart; PARTS], Box<dyn std::error::Error>> {
    let mut parts = [RunPart::default(); PARTS];
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
