//! What a simulator was after each update, as hashes.

use crate::engine::Engine;
use crate::hash::Hash;

/// After one update.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Moment {
    /// Positions and velocities of all bodies.
    pub motion: Hash,
    /// What happened in the update.
    pub events: Hash,
    /// The whole simulator.
    pub snapshot: Hash,
}

impl Moment {
    /// What a simulator is now.
    pub fn of(simulator: &impl Engine) -> Self {
        let motion: Vec<u8> = simulator.motion().iter().flat_map(|number| number.to_le_bytes()).collect();
        Moment {
            motion: Hash::of(&motion),
            events: Hash::of(simulator.events().as_bytes()),
            snapshot: Hash::of(&simulator.snapshot()),
        }
    }

    /// One moment for several that follow each other.
    pub fn all<'a>(moments: impl IntoIterator<Item = &'a Moment>) -> Self {
        moments.into_iter().fold(Moment::default(), |all, moment| Moment {
            motion: all.motion.with(&moment.motion.value().to_le_bytes()),
            events: all.events.with(&moment.events.value().to_le_bytes()),
            snapshot: all.snapshot.with(&moment.snapshot.value().to_le_bytes()),
        })
    }
}
