//! Recording of a run: states, inputs and hashes of all updates in one file, to be replayed and compared.

use serde::{Deserialize, Serialize};

use super::snapshot::SnapshotFormat;
use crate::simulator::PhysicsSimulator;
use crate::{Error, Result};

const FORMAT: SnapshotFormat = SnapshotFormat { magic: Recording::MAGIC, version: 2 };

/// Recording of a run, as one file: the state at the beginning and after every so many updates, and of each update its length,
/// the game's input and a [hash](PhysicsSimulator::state_hash) of the state. A bug report of a user, a replay of a match, or two
/// runs that should be equal and are not. Not in the original.
///
/// Each update is recorded by [`record`](Self::record). `input` is whatever the game needs to make the same calls again: keys,
/// commands, random numbers. With a keyframe after every update no input is needed to look at any state. Replays run within the
/// default [`Limits`](crate::Limits), which are no part of a snapshot, and without a
/// [largest speed](PhysicsSimulator::set_largest_speed): `play` sets it if the run had one.
///
/// ```
/// use farseer_core::{BodyBuilder, GeomBuilder, PhysicsSimulator, Recording, math::Vector2};
/// let mut simulator = PhysicsSimulator::precise([0.0, 300.0])?;
/// let (ball, _) = simulator.add_body(BodyBuilder::dynamic(), [GeomBuilder::circle(10.0)])?;
/// // One call for the game and for its replay: the input here is a push.
/// let play = |simulator: &mut PhysicsSimulator, input: &[u8], dt: f32| {
///     simulator[ball].apply_impulse(Vector2::new(f32::from(input[0]), 0.0));
///     simulator.update(dt);
/// };
/// let mut recording = Recording::new(&simulator, 60)?;
/// for push in 0..100 {
///     play(&mut simulator, &[push], 1.0 / 60.0);
///     recording.record(&simulator, 1.0 / 60.0, &[push]);
/// }
/// let file = recording.to_bytes();
///
/// let recording = Recording::from_bytes(&file)?;
/// assert_eq!(recording.first_divergence(play)?, None, "the replay has the same bits");
/// let then = recording.state_after(75, play)?;
/// assert!(then[ball].position().x < simulator[ball].position().x);
/// # Ok::<(), farseer_core::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[doc(alias("Replay", "b2Recording"))]
pub struct Recording {
    /// Number of updates from one keyframe to the next, greater than 0.
    keyframe_interval: u32,
    /// Snapshots after 0, `keyframe_interval`, 2 * `keyframe_interval`... updates.
    keyframes: Vec<Vec<u8>>,
    updates: Vec<RecordedUpdate>,
}

/// Recorded update.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct RecordedUpdate {
    /// Length of the update, in seconds.
    dt: f32,
    /// Hash of the state after the update.
    hash: u64,
    /// The game's input to the update.
    input: Vec<u8>,
}

impl Recording {
    /// First bytes of the file of a recording.
    pub const MAGIC: [u8; 8] = *b"FarsRecd";

    /// A recording that begins with the present state of a simulator, and keeps a snapshot after every `keyframe_interval`
    /// updates.
    ///
    /// # Errors
    /// A `keyframe_interval` of 0.
    pub fn new(simulator: &PhysicsSimulator, keyframe_interval: u32) -> Result<Self> {
        if keyframe_interval == 0 {
            return Err(Error::invalid("keyframe_interval", keyframe_interval, "greater than 0"));
        }
        Ok(Recording { keyframe_interval, keyframes: vec![simulator.snapshot()], updates: Vec::new() })
    }

    /// Records an update, after it: its length `dt` in seconds and its input.
    pub fn record(&mut self, simulator: &PhysicsSimulator, dt: f32, input: &[u8]) {
        self.updates.push(RecordedUpdate { dt, hash: simulator.state_hash(), input: input.to_vec() });
        if self.updates.len().is_multiple_of(self.keyframe_interval as usize) {
            self.keyframes.push(simulator.snapshot());
        }
    }

    /// Number of recorded updates.
    pub fn len(&self) -> usize {
        self.updates.len()
    }

    /// Whether no update was recorded.
    pub fn is_empty(&self) -> bool {
        self.updates.is_empty()
    }

    /// Number of updates from one keyframe to the next.
    pub fn keyframe_interval(&self) -> u32 {
        self.keyframe_interval
    }

    /// Input of an update, counted from 0; `None` after the last one.
    pub fn input(&self, update: usize) -> Option<&[u8]> {
        self.updates.get(update).map(|update| update.input.as_slice())
    }

    /// Length of an update in seconds, counted from 0; `None` after the last one.
    pub fn dt(&self, update: usize) -> Option<f32> {
        self.updates.get(update).map(|update| update.dt)
    }

    /// [Hash](PhysicsSimulator::state_hash) of the state after an update, counted from 0; `None` after the last one.
    pub fn hash(&self, update: usize) -> Option<u64> {
        self.updates.get(update).map(|update| update.hash)
    }

    /// The [snapshot](PhysicsSimulator::snapshot) of the state after `index` times
    /// [`keyframe_interval`](Self::keyframe_interval) updates; `None` after the last one.
    pub fn keyframe(&self, index: usize) -> Option<&[u8]> {
        self.keyframes.get(index).map(Vec::as_slice)
    }

    /// The state after a number of updates: that of the last keyframe before, and the updates since. `play` makes the calls of
    /// the game for an update, given its input and its length in seconds; at a keyframe it is not called.
    ///
    /// # Errors
    /// More updates than were recorded; a keyframe that this version cannot restore; [`Error::DamagedSave`] if the replay has
    /// other bits than the recorded run: `play` does not do what the game did.
    pub fn state_after(
        &self,
        updates: usize,
        mut play: impl FnMut(&mut PhysicsSimulator, &[u8], f32),
    ) -> Result<PhysicsSimulator> {
        if updates > self.updates.len() {
            return Err(Error::invalid("updates", updates, "at most the number of recorded updates"));
        }
        let interval = self.keyframe_interval as usize;
        let keyframe = updates / interval;
        let mut simulator = self.restored(keyframe)?;
        for update in &self.updates[keyframe * interval..updates] {
            play(&mut simulator, &update.input, update.dt);
            if simulator.state_hash() != update.hash {
                return Err(Error::DamagedSave { reason: "the replay has other bits than the recorded run" });
            }
        }
        Ok(simulator)
    }

    /// Replays the run from its beginning. Returns the number of the first update, counted from 0, after which the replay has
    /// another [hash](PhysicsSimulator::state_hash) than the recorded run; `None` if there is none. `play` as in
    /// [`state_after`](Self::state_after).
    ///
    /// # Errors
    /// A beginning that this version cannot restore.
    pub fn first_divergence(
        &self,
        mut play: impl FnMut(&mut PhysicsSimulator, &[u8], f32),
    ) -> Result<Option<usize>> {
        let mut simulator = self.restored(0)?;
        Ok(self.updates.iter().position(|update| {
            play(&mut simulator, &update.input, update.dt);
            simulator.state_hash() != update.hash
        }))
    }

    /// Number of the first update, counted from 0, in which two recordings differ: in its length or input, or in the hash of the
    /// state after it. One that ends earlier differs after its end. `None` if they are equal to their ends.
    pub fn first_difference(&self, other: &Recording) -> Option<usize> {
        let length = self.updates.len().max(other.updates.len());
        (0..length).find(|&update| self.updates.get(update) != other.updates.get(update))
    }

    /// The recording as the bytes of a file, with version and checksum.
    pub fn to_bytes(&self) -> Vec<u8> {
        FORMAT.write(self)
    }

    /// Reads a recording from the bytes of a file.
    ///
    /// # Errors
    /// Bytes that are no recording, were cut short or altered, or come from another version of the format.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self> {
        let recording: Recording = FORMAT.read(bytes)?;
        let keyframes =
            recording.updates.len().checked_div(recording.keyframe_interval as usize).map(|count| count + 1);
        if keyframes != Some(recording.keyframes.len()) {
            return Err(Error::DamagedSave { reason: "a recording with another number of keyframes" });
        }
        Ok(recording)
    }

    /// Returns the simulator of a keyframe.
    fn restored(&self, keyframe: usize) -> Result<PhysicsSimulator> {
        let mut simulator = PhysicsSimulator::default();
        simulator.restore(&self.keyframes[keyframe])?;
        Ok(simulator)
    }
}
