//! Snapshots: the whole simulator as bytes.

use farseer_core::snapshot::SnapshotFormat;

use crate::{Result, SavedTwoHalfSimulator, TwoHalfPhysicsSimulator};

const SIMULATOR: SnapshotFormat = SnapshotFormat { magic: *b"TwoHalf1", version: 22 };

impl TwoHalfPhysicsSimulator {
    /// The whole simulator as bytes, to [restore](Self::restore) later, in this program or another.
    ///
    /// A snapshot contains all state that can influence a later bit or event, at any moment between two
    /// updates. Pending reports of disposals, movements and refusals come with the next update after
    /// restoring. Handlers belong to the game and are not contained, nor are the [events](Self::events),
    /// counters and time of the last update. The format may change between versions of this crate; a snapshot
    /// of another version is refused.
    #[inline]
    pub fn snapshot(&self) -> Vec<u8> {
        SIMULATOR.write(self)
    }

    /// Restores a [snapshot](Self::snapshot): the simulator goes on with the same bits, and old ids name the
    /// same objects. The [limits](Self::limits) stay those of this simulator.
    ///
    /// # Errors
    /// Bytes that are no snapshot, were cut short or altered, or come from another version of the format;
    /// [`farseer_core::Error::LimitExceeded`] for more than the limits allow. A failed call changes nothing.
    #[inline]
    pub fn restore(&mut self, snapshot: &[u8]) -> Result<()> {
        *self = SIMULATOR.read::<SavedTwoHalfSimulator>(snapshot)?.load(self.limits())?;
        Ok(())
    }
}
