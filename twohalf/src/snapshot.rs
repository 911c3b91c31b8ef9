//! The whole simulator as bytes, and back.

use farseer_core::snapshot::SnapshotFormat;

use crate::{Result, TwoHalfPhysicsSimulator};

const SIMULATOR: SnapshotFormat = SnapshotFormat { magic: *b"TwoHalf1", version: 1 };

impl TwoHalfPhysicsSimulator {
    /// The whole simulator as bytes, to [restore](Self::restore) later, in this program or another.
    ///
    /// Everything that can influence a later bit is in it, in the middle of a run too. Callbacks belong to the game
    /// and events are notices: both are not. Between versions of this crate the format may change.
    pub fn snapshot(&self) -> Vec<u8> {
        SIMULATOR.write(self)
    }

    /// Becomes the simulator of a [snapshot](Self::snapshot): it goes on with the same bits, and the ids of then name
    /// the same objects.
    ///
    /// # Errors
    /// Bytes that are no snapshot, were cut short or altered, or come from another version of the format. The
    /// simulator is what it was, then.
    pub fn restore(&mut self, snapshot: &[u8]) -> Result<()> {
        *self = SIMULATOR.read(snapshot)?;
        Ok(())
    }
}
