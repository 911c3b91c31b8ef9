//! Options of a body that are on or off, in one byte.

use farseer_precise::storage::words::Words;
use serde::{Deserialize, Serialize};

/// Options of a body that are on or off, as bit flags.
///
/// A snapshot has them at the place of the former flag for bullets: without other options its bytes are the same.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(transparent)]
pub(super) struct BodyOptions(u8);

impl BodyOptions {
    /// Writes or reads the flags of a saved body.
    #[inline(always)]
    pub(super) fn visit(&mut self, words: &mut impl Words) {
        let mut word = u32::from(self.0);
        words.word(&mut word);
        self.0 = word as u8;
    }

    /// Bit: continuous collision also counts against dynamic bodies.
    pub(super) const BULLET: u8 = 1;
    /// Bit: the body does not rotate.
    pub(super) const ROTATION_LOCKED: u8 = 1 << 1;
    /// Bit: the body never falls asleep.
    pub(super) const SLEEPLESS: u8 = 1 << 2;
    /// Bit: the next update puts the body to sleep.
    pub(super) const SLEEP_REQUESTED: u8 = 1 << 3;
    /// Bit: falling asleep and waking are events.
    pub(super) const SLEEP_EVENTS: u8 = 1 << 4;
    /// Bit: rotational drag is proportional to the angular velocity, instead of to its square.
    pub(super) const LINEAR_ROTATIONAL_DRAG: u8 = 1 << 5;
    /// Bit: the body keeps its x coordinate.
    pub(super) const X_LOCKED: u8 = 1 << 6;
    /// Bit: the body keeps its y coordinate.
    pub(super) const Y_LOCKED: u8 = 1 << 7;

    /// Whether an option is on.
    #[inline]
    pub(super) fn has(self, option: u8) -> bool {
        self.0 & option != 0
    }

    /// Switches an option on or off.
    #[inline]
    pub(super) fn set(&mut self, option: u8, value: bool) {
        self.0 = if value { self.0 | option } else { self.0 & !option };
    }

    /// The options that a copy of the body has: a pending request is none of them.
    pub(super) fn of_copy(mut self) -> Self {
        self.set(Self::SLEEP_REQUESTED, false);
        self
    }
}
