//! Table of the pairs of geoms that have an arbiter (behaviour chapters 03, section 7.1, and 08, section 1.4).

use serde::{Deserialize, Serialize};

use crate::storage::stamped_set::StampedSet;
use farseer_precise::reusing_clone;

/// A set of unordered pairs of collision ids.
///
/// The original keeps a triangular bitmap; this keeps the indices of the bits that are set, so that its cost depends on
/// the number of pairs. The index is one-to-one for different ids below [`size`](Self::size). Other ids address the bit
/// of another pair, or none at all, exactly as in the original.
#[derive(Debug, Serialize, Deserialize)]
pub struct GeomPairBitmap {
    size: i64,
    #[serde(skip)]
    set_bits: StampedSet,
}

reusing_clone! { GeomPairBitmap { size, set_bits } }

impl Default for GeomPairBitmap {
    /// An empty table for no geom at all.
    fn default() -> Self {
        GeomPairBitmap { size: -1, set_bits: StampedSet::default() }
    }
}

impl GeomPairBitmap {
    /// An empty table for collision ids below `geom_count`.
    pub fn new(geom_count: usize) -> Self {
        let mut table = Self::default();
        table.clear(geom_count);
        table
    }

    /// The largest number of geoms seen so far; -1 before the first.
    pub fn size(&self) -> i64 {
        self.size
    }

    /// Whether the size is one that [`clear`](Self::clear) could have set. False only after loading corrupt data.
    pub(crate) fn is_valid(&self) -> bool {
        (-1..=i64::from(i32::MAX)).contains(&self.size)
    }

    /// Empties the table for collision ids below `geom_count`. It never shrinks.
    #[doc(alias = "Clear")]
    pub fn clear(&mut self, geom_count: usize) {
        self.size = self.size.max(geom_count as i64);
        self.set_bits.clear();
    }

    /// Index of the bit of a pair; `None` where the original indexes outside of its array.
    pub fn index(&self, collision_id1: i32, collision_id2: i32) -> Option<i64> {
        if self.size < 2 {
            return None;
        }
        let (x, y) =
            (i64::from(collision_id1.min(collision_id2)), i64::from(collision_id1.max(collision_id2)));
        let index = x * self.size - x * (x + 1) / 2 + (y - x - 1);
        (0..self.size * (self.size - 1) / 2).contains(&index).then_some(index)
    }

    /// Adds a pair and returns whether it was there. A pair outside of the table, for which the original fails, counts
    /// as being there.
    #[doc(alias = "TestAndSet")]
    pub fn test_and_set(&mut self, collision_id1: i32, collision_id2: i32) -> bool {
        match self.index(collision_id1, collision_id2) {
            Some(index) => !self.set_bits.insert(index),
            None => true,
        }
    }
}
