//! Endpoints of the intervals that geoms cover on an axis.

use serde::{Deserialize, Serialize};

/// One end of a geom's interval on one axis.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Endpoint {
    #[serde(with = "crate::storage::bits")]
    pub(super) value: f32,
    /// Twice the index of the geom's entry, plus one for the upper end.
    pub(super) key: u32,
}

impl Endpoint {
    #[inline(always)]
    pub(super) fn begin(entry: usize) -> Self {
        Endpoint { value: 0.0, key: entry as u32 * 2 }
    }

    #[inline(always)]
    pub(super) fn end(entry: usize) -> Self {
        Endpoint { value: 0.0, key: entry as u32 * 2 + 1 }
    }

    #[inline(always)]
    pub(super) fn is_begin(self) -> bool {
        self.key & 1 == 0
    }

    #[inline(always)]
    pub(super) fn entry(self) -> usize {
        (self.key >> 1) as usize
    }
}
