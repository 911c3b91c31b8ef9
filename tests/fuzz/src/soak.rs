//! Long runs in which things come and go.

use farseer_core::Methods;

use crate::scenes::Churn;

/// A thing is replaced after every so many updates.
const LIFE: usize = 5;
/// Every so many of them are tied to another.
const TIES: usize = 3;
/// Parts of a run that are compared.
const PARTS: usize = 5;

/// The longest snapshot in the last fifth of a run is at most a twelfth longer than that of the second fifth: contacts
/// come and go, too. In runs of 50,000 and of 1,000,000 updates ids and creation numbers take as many bytes in both.
///
/// # Errors
/// The lengths, if they grow.
pub fn snapshots_stay_as_long(methods: Methods, updates: usize) -> Result<(), String> {
    let lengths = snapshot_lengths(methods, updates / PARTS).map_err(|error| error.to_string())?;
    let (early, late) = (lengths[1], lengths[PARTS - 1]);
    if late * 12 <= early * 13 { Ok(()) } else { Err(format!("longest snapshots: {lengths:?}")) }
}

/// Length of the longest snapshot in each part.
fn snapshot_lengths(methods: Methods, updates: usize) -> Result<[usize; PARTS], Box<dyn std::error::Error>> {
    let mut churn = Churn::new(methods)?;
    let mut longest = [0; PARTS];
    for update in 0..PARTS * updates {
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
