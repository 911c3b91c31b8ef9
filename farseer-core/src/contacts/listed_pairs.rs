//! Index of the pairs in the arbiter list, for the brute force broad phase (behaviour chapter 08, section 5).

use crate::contacts::pair_id::PairId;
use crate::geom::GeomId;
use crate::storage::stamped_set::StampedSet;
use farseer_precise::reusing_clone;

/// Both geoms of an arbiter, A first.
type GeomPair = (GeomId, GeomId);

/// Number of list entries of each pair, and of each arbiter. The list may hold an arbiter twice, and the pool may hold
/// one that is in the list: when that one is set up for another pair, all of its entries change.
#[derive(Debug, Default)]
pub(crate) struct ListedPairs {
    /// Number of entries by pair, keyed by the slots of the geoms: all listed geoms exist.
    pairs: StampedSet,
    /// Number of entries, by handle of the arbiter.
    entries: Vec<u32>,
}

reusing_clone! { ListedPairs { pairs, entries } }

fn key((a, b): GeomPair) -> i64 {
    PairId::get_hash(a.slot() as i32, b.slot() as i32)
}

impl ListedPairs {
    pub(crate) fn clear(&mut self, arbiter_count: usize) {
        self.pairs.clear();
        self.entries.clear();
        self.entries.resize(arbiter_count, 0);
    }

    /// Counts a new entry of the list.
    pub(crate) fn add(&mut self, handle: u32, pair: GeomPair) {
        *self.pairs.count_mut(key(pair)) += 1;
        if handle as usize >= self.entries.len() {
            self.entries.resize(handle as usize + 1, 0);
        }
        self.entries[handle as usize] += 1;
    }

    /// Moves the entries of an arbiter that is set up for another pair.
    pub(crate) fn reassign(&mut self, handle: u32, before: Option<GeomPair>, pair: GeomPair) {
        let entries = self.entries.get(handle as usize).copied().unwrap_or(0);
        if let Some(before) = before
            && entries > 0
        {
            *self.pairs.count_mut(key(before)) -= entries;
            *self.pairs.count_mut(key(pair)) += entries;
        }
    }

    /// Whether the list has an arbiter of these geoms, as A and B.
    pub(crate) fn contains(&self, pair: GeomPair) -> bool {
        self.pairs.count(key(pair)) > 0
    }
}
