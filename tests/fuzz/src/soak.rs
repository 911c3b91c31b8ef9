//! Long runs in which things come and go.

use farseer_core::BroadPhaseCollider;

use crate::scenes::Churn;

/// A thing is replaced after every so many updates.
const LIFE: usize = 5;
/// Every so many of them are tied to another.
const TIES: usize = 3;

/// Length of the snapshot, the longest in each of `parts` equal parts of a run.
///
/// # Errors
/// If the simulator refuses what it should take.
pub fn snapshot_lengths(
    method: BroadPhaseCollider,
    parts: usize,
    updates: usize,
) -> Result<Vec<usize>, Box<dyn std::error::Error>> {
    let mut churn = Churn::new(method)?;
    let mut longest = vec![0; parts];
    for update in 0..parts * updates {
        if update % LIFE == 0 {
            churn.replace_one(update % (LIFE * TIES) == 0)?;
        }
        churn.update();
        if update % LIFE == LIFE - 1 {
            let part = &mut longest[update / updates];
            *part = churn.simulator().snapshot().len().max(*part);
        }
    }
    Ok(longest)
}
