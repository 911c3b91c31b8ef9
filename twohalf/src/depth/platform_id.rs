//! Names of platforms.

use serde::{Deserialize, Serialize};

/// So many platforms a simulator may have had.
const MOST: u32 = (1 << 31) - 16;

/// Names a platform of a simulator. Never reused.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default, Serialize, Deserialize)]
pub struct PlatformId(u32);

impl PlatformId {
    /// The one after it, unless there have been too many.
    pub(super) fn next(self) -> Option<Self> {
        self.0.checked_add(1).filter(|&next| next < MOST).map(PlatformId)
    }

    /// As the 2D engine below knows it.
    pub(crate) fn number(self) -> u32 {
        self.0
    }

    pub(crate) fn from_number(number: u32) -> Self {
        PlatformId(number)
    }

    /// The id as a number, for what can keep nothing but numbers: platforms are counted, and no number is used twice.
    pub fn to_bits(self) -> u32 {
        self.0
    }

    /// The id whose [number](Self::to_bits) this is. Any other number makes an id that names nothing.
    pub fn from_bits(bits: u32) -> Self {
        PlatformId(bits)
    }
}
