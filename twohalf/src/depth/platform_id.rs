//! Ids of platforms.

use serde::{Deserialize, Serialize};

/// Greatest number of platforms that a simulator may create.
const MAX_PLATFORMS: u32 = (1 << 31) - 16;

/// Identifies a platform of a simulator. Ids are never reused.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default, Serialize, Deserialize)]
pub struct PlatformId(u32);

impl PlatformId {
    /// Returns the id after this one; `None` after the greatest id.
    pub(super) fn next(self) -> Option<Self> {
        self.0.checked_add(1).filter(|&next| next < MAX_PLATFORMS).map(PlatformId)
    }

    /// The number under which the core knows the platform.
    pub(crate) fn number(self) -> u32 {
        self.0
    }

    pub(crate) fn from_number(number: u32) -> Self {
        PlatformId(number)
    }

    /// The id as a number, for storage of numbers only. Platforms are counted, and no number is used twice.
    pub fn to_bits(self) -> u32 {
        self.0
    }

    /// The id with this [number](Self::to_bits). A number of no platform makes a stale id.
    pub fn from_bits(bits: u32) -> Self {
        PlatformId(bits)
    }
}
