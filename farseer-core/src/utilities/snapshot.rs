//! Container of saved simulators: bytes with type, version and checksum.
//!
//! | bytes | content |
//! |---|---|
//! | 8 | magic: what is saved |
//! | 4 | version of the format, least byte first |
//! | 4 | CRC-32 of everything else |
//! | 8 | length of the content, least byte first |
//! | rest | the content, in a format in which zeros take one bit (module `packed`) |
//!
//! [`PhysicsSimulator::snapshot`] makes one of a whole simulator. The module is public for engines built on the
//! simulator, which have more to save.

use serde::Serialize;
use serde::de::DeserializeOwned;

use super::checksum::crc32;
use super::packed;
use super::recording::Recording;
use crate::simulator::{LoadedMovingSimulator, PhysicsSimulator, SavedSimulator};
use crate::{Error, Result};

const MAGIC_LENGTH: usize = 8;
const VERSION: std::ops::Range<usize> = 8..12;
const CHECKSUM: std::ops::Range<usize> = 12..16;
const LENGTH: std::ops::Range<usize> = 16..24;
const HEADER_LENGTH: usize = LENGTH.end;

/// Type and version of a container's content.
///
/// The content does not describe itself: every change of the serialised types, or of their order, must raise the
/// version.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SnapshotFormat {
    /// Eight bytes that name the type of the content.
    pub magic: [u8; MAGIC_LENGTH],
    /// Version number of its layout.
    pub version: u32,
}

impl SnapshotFormat {
    /// Puts a value in a container.
    ///
    /// # Panics
    /// If the value cannot be serialised at all: a sequence of unknown length, an error of its own.
    pub fn write<T: Serialize + ?Sized>(&self, value: &T) -> Vec<u8> {
        let mut header = vec![0; HEADER_LENGTH];
        header[..MAGIC_LENGTH].copy_from_slice(&self.magic);
        header[VERSION].copy_from_slice(&self.version.to_le_bytes());
        let Ok(mut bytes) = packed::write(value, header) else {
            panic!("memory takes everything, and the type can be written without describing itself")
        };
        let length = (bytes.len() - HEADER_LENGTH) as u64;
        bytes[LENGTH].copy_from_slice(&length.to_le_bytes());
        let checksum = checksum(&bytes);
        bytes[CHECKSUM].copy_from_slice(&checksum.to_le_bytes());
        bytes
    }

    /// Reads a value from a container.
    ///
    /// # Errors
    /// [`Error::UnknownSaveVersion`] for another version; [`Error::DamagedSave`] for bytes with a
    /// wrong checksum or content that does not fit the type.
    pub fn read<T: DeserializeOwned>(&self, bytes: &[u8]) -> Result<T> {
        let damaged = |reason| Err(Error::DamagedSave { reason });
        if bytes.len() < MAGIC_LENGTH || bytes[..MAGIC_LENGTH] != self.magic {
            return damaged(reason_of_other_magic(bytes));
        }
        if bytes.len() < HEADER_LENGTH {
            return damaged("it is cut short");
        }
        let found = number(&bytes[VERSION]) as u32;
        if found != self.version {
            return Err(Error::UnknownSaveVersion { found, known: self.version });
        }
        let (length, present) = (number(&bytes[LENGTH]), (bytes.len() - HEADER_LENGTH) as u64);
        if length > present {
            return damaged("it is cut short");
        }
        if length < present {
            return damaged("it is longer than it says");
        }
        if number(&bytes[CHECKSUM]) != u64::from(checksum(bytes)) {
            return damaged("it was altered: its checksum is wrong");
        }
        match packed::read(&bytes[HEADER_LENGTH..]) {
            Ok((value, [])) => Ok(value),
            Ok(_) => damaged("its content is longer than it should be"),
            Err(_) => damaged("its content cannot be read or contradicts itself"),
        }
    }
}

/// Reason why bytes with the magic of another format are refused. It names the call that reads them, if there is one here.
fn reason_of_other_magic(bytes: &[u8]) -> &'static str {
    let others = [
        (SIMULATOR.magic, "it is a snapshot of a whole simulator, which `PhysicsSimulator::restore` reads"),
        (MOVING.magic, "it is a snapshot without geoms, which `PhysicsSimulator::restore_moving` reads"),
        (Recording::MAGIC, "it is a recording, which `Recording::from_bytes` reads"),
    ];
    let found = others.iter().find(|(magic, _)| bytes.starts_with(magic));
    found.map_or("it is not a snapshot of such a simulator", |&(_, reason)| reason)
}

/// A number of at most eight bytes, least significant first.
fn number(bytes: &[u8]) -> u64 {
    bytes.iter().rev().fold(0, |number, &byte| number << 8 | u64::from(byte))
}

/// Checksum of all bytes except those that store it.
fn checksum(bytes: &[u8]) -> u32 {
    crc32([&bytes[..CHECKSUM.start], &bytes[CHECKSUM.end..]])
}

const SIMULATOR: SnapshotFormat = SnapshotFormat { magic: *b"Farseer2", version: 21 };

/// Content: all of a simulator but its geoms.
const MOVING: SnapshotFormat = SnapshotFormat { magic: *b"FarsMove", version: 2 };

impl PhysicsSimulator {
    /// The whole simulator as bytes, to be [restored](Self::restore) later, in this program or another.
    ///
    /// It contains all state that can influence a later bit or event, at any moment between two updates. Objects
    /// disposed or moved, and arguments rejected, since the last update are reported by the first update after
    /// restoring. Handlers belong to the game, and are not included; nor are the [events](Self::events), counters and
    /// times of the last update.
    ///
    /// The format may change between versions of this crate; a snapshot of another format version is refused. For a
    /// readable form, serialise the simulator with any other format of `serde`.
    ///
    /// ```
    /// use farseer_core::{BodyFactory, PhysicsSimulator, math::Vector2};
    ///
    /// let mut simulator = PhysicsSimulator::new(Vector2::new(0.0, 100.0))?;
    /// let body = BodyFactory::create_circle_body_in(&mut simulator, 10.0, 1.0)?;
    /// simulator.update(0.01);
    ///
    /// let snapshot = simulator.snapshot();
    /// let (velocity, position) = (simulator[body].linear_velocity(), simulator[body].position());
    /// simulator.update(0.01);
    /// simulator.restore(&snapshot)?;
    /// assert_eq!(simulator[body].linear_velocity(), velocity);
    /// assert_eq!(simulator[body].position(), position);
    /// # Ok::<(), farseer_core::Error>(())
    /// ```
    #[inline]
    pub fn snapshot(&self) -> Vec<u8> {
        SIMULATOR.write(self)
    }

    /// Replaces the simulator by that of a [snapshot](Self::snapshot). It continues with the same bits, and ids of that
    /// time name the same objects. Ids made since then are invalid and may name other objects: forget them. The
    /// [limits](Self::limits) stay those of this simulator.
    ///
    /// # Errors
    /// Bytes that are no snapshot, were cut short or altered, or come from another version of the format;
    /// [`Error::LimitExceeded`] for more than the limits allow. The simulator is unchanged then.
    #[inline]
    pub fn restore(&mut self, snapshot: &[u8]) -> Result<()> {
        let loaded = SIMULATOR.read::<SavedSimulator>(snapshot)?.load(self.limits())?;
        self.replace_by(loaded);
        Ok(())
    }

    /// The simulator without its geoms as bytes, to be put [back](Self::restore_moving) into this simulator or a clone: for
    /// rollback, and for states sent over a network. In a pile about three quarters of a
    /// [`snapshot`](Self::snapshot).
    ///
    /// All of a snapshot but shapes, materials, filters and other settings of geoms: bodies, joints, springs, contacts, sleep,
    /// edits since the last update. Another simulator takes it, too, if the same calls have made its geoms and it has had an
    /// update since: only then are they in its list.
    pub fn snapshot_moving(&self) -> Vec<u8> {
        MOVING.write(&self.moving())
    }

    /// Puts back the state of a [`snapshot_moving`](Self::snapshot_moving). Geoms keep the settings that they have now; if these
    /// are those of the snapshot, the simulator continues with the same bits. The [limits](Self::limits) stay.
    ///
    /// ```
    /// use farseer_core::{BodyBuilder, GeomBuilder, PhysicsSimulator};
    /// let mut simulator = PhysicsSimulator::precise([0.0, 300.0])?;
    /// let (ball, _) = simulator.add_body(BodyBuilder::dynamic(), [GeomBuilder::circle(10.0)])?;
    /// simulator.update(1.0 / 60.0);
    ///
    /// let moving = simulator.snapshot_moving();
    /// simulator.update(1.0 / 60.0);
    /// let hash = simulator.state_hash();
    /// simulator.restore_moving(&moving)?;
    /// simulator.update(1.0 / 60.0);
    /// assert_eq!(simulator.state_hash(), hash);
    /// # Ok::<(), farseer_core::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`restore`](Self::restore); [`Error::DamagedSave`] if geoms were made, added, removed, disposed or given to another body
    /// since, if the methods changed, or if a geom whose matrix the game has set has another number of vertices. The simulator is unchanged then.
    pub fn restore_moving(&mut self, moving: &[u8]) -> Result<()> {
        let loaded = MOVING.read::<LoadedMovingSimulator>(moving)?.load_with_geoms_of(self)?;
        self.replace_by(loaded);
        Ok(())
    }
}
