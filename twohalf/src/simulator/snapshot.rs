//! The whole simulator as bytes, and back.

use farseer_core::snapshot::SnapshotFormat;

use crate::{Result, SavedTwoHalfSimulator, TwoHalfPhysicsSimulator};

const SIMULATOR: SnapshotFormat = SnapshotFormat { magic: *b"TwoHalf1", version: 17 };

impl TwoHalfPhysicsSimulator {
    /// The whole simulator as bytes, to [restore](Self::restore) later, in this program or another.
    ///
    /// Everything that can influence a later bit or event is in it, at any moment between two updates: what was
    /// disposed, moved or refused since the last one is told by the next one after restoring, too. Handlers belong to
    /// the game, and are not in it; nor are the [events](Self::events), counters and time of the last update. Between
    /// versions of this crate the format may change; a snapshot of another one is refused.
    #[inline]
    pub fn snapshot(&self) -> Vec<u8> {
        SIMULATOR.write(self)
    }

    /// Becomes the simulator of a [snapshot](Self::snapshot): it goes on with the same bits, and the ids of then name
    /// the same objects. The [limits](Self::limits) stay those of this simulator.
    ///
    /// # Errors
    /// Bytes that are no snapshot, were cut short or altered, or come from another version of the format;
    /// [`farseer_core::Error::LimitExceeded`] for more than the limits allow. The simulator is what it was, then.
    #[inline]
    pub fn restore(&mut self, snapshot: &[u8]) -> Result<()> {
        *self = SIMULATOR.read::<SavedTwoHalfSimulator>(snapshot)?.load(self.limits())?;
        Ok(())
    }
}
