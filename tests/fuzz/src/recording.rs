//! Hashes of the state of a simulator after each update.

use crate::engine::Engine;
use crate::hash::Hash;

/// Hashes of the state of a simulator after one update.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct StateHashes {
    /// Hash of positions and velocities of all bodies.
    pub motion: Hash,
    /// Hash of the events of the update.
    pub events: Hash,
    /// Hash of the snapshot of the complete simulator.
    pub snapshot: Hash,
}

impl StateHashes {
    /// Returns the hashes of the present state of a simulator.
    pub fn of(simulator: &impl Engine) -> Self {
        let motion: Vec<u8> = simulator.motion().iter().flat_map(|number| number.to_le_bytes()).collect();
        StateHashes {
            motion: Hash::of(&motion),
            events: Hash::of(simulator.events().as_bytes()),
            snapshot: Hash::of(&simulator.snapshot()),
        }
    }

    /// Combines the hashes of several updates, in order, into one set of hashes.
    pub fn all<'a>(moments: impl IntoIterator<Item = &'a StateHashes>) -> Self {
        moments.into_iter().fold(StateHashes::default(), |all, moment| StateHashes {
            motion: all.motion.with(&moment.motion.value().to_le_bytes()),
            events: all.events.with(&moment.events.value().to_le_bytes()),
            snapshot: all.snapshot.with(&moment.snapshot.value().to_le_bytes()),
        })
    }
}
