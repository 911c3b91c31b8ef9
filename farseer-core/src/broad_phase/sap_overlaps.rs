//! Overlaps of one geom on one axis, for sweep and prune (behaviour chapter 08, section 3).

use serde::{Deserialize, Serialize};

use crate::geom::GeomId;
use crate::geom::entry::Geoms;
use crate::storage::arena::Id as _;
use crate::storage::order::sort_by_number;

/// Lists of at most this number of geoms are not compacted.
const MIN_SWEPT: usize = 32;

/// Overlaps that were offered as pairs already. A pair refused once is not offered again on this axis.
///
/// A multiset, as in the original: a geom that is removed and added again while it overlaps is contained once more each
/// time, and each end of an overlap removes one occurrence. Geoms that no longer exist are removed from time to time,
/// and repeated ones are replaced by a count.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub(super) struct Overlaps {
    list: Vec<GeomId>,
    /// Number of further occurrences of a geom beyond that in the list, at least 1.
    more: Vec<(GeomId, u32)>,
}

impl Overlaps {
    /// Adds geoms, and compacts the list when it outgrows a power of two. So the list stays within twice its necessary
    /// length.
    pub(super) fn extend(&mut self, begun: &[GeomId], geoms: &Geoms) {
        let limit = self.list.len().next_power_of_two().max(MIN_SWEPT);
        self.list.extend_from_slice(begun);
        if self.list.len() > limit {
            self.sweep(geoms);
        }
    }

    /// Removes one occurrence of a geom; returns whether there was one.
    pub(super) fn remove(&mut self, geom: GeomId) -> bool {
        if let Some(position) = self.list.iter().position(|&other| other == geom) {
            self.list.remove(position);
            return true;
        }
        let Some(position) = self.more.iter().position(|&(other, _)| other == geom) else { return false };
        self.more[position].1 -= 1;
        if self.more[position].1 == 0 {
            self.more.swap_remove(position);
        }
        true
    }

    /// Removes geoms that do not exist any more: their ids never come back. Each other geom stays in the list once,
    /// with a count of its repetitions.
    fn sweep(&mut self, geoms: &Geoms) {
        self.list.retain(|&geom| geoms.contains(geom));
        self.more.retain(|&(geom, _)| geoms.contains(geom));
        sort_by_number(&mut self.list, |geom| geom.rank());
        for same in self.list.chunk_by(|a, b| a == b).filter(|same| same.len() > 1) {
            let more = same.len() as u32 - 1;
            match self.more.iter_mut().find(|(geom, _)| *geom == same[0]) {
                Some((_, count)) => *count = count.saturating_add(more),
                None => self.more.push((same[0], more)),
            }
        }
        self.list.dedup();
    }

    /// Whether all counts are positive. False only after loading corrupt data.
    pub(super) fn is_valid(&self) -> bool {
        self.more.iter().all(|&(_, count)| count > 0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::BodyId;
    use crate::geom::entry::GeomEntry;
    use crate::math::Vector2;
    use crate::storage::arena::Id;

    fn geoms(count: u32) -> (Geoms, Vec<GeomId>) {
        let body = BodyId::new(0, 0);
        let mut geoms = Geoms::default();
        let ids = (0..count)
            .map(|number| geoms.create(GeomEntry::new(number, body, Vector2::zeros(), 0.0)))
            .collect();
        (geoms, ids)
    }

    /// Compares with a plain list of which the first equal element is removed, as the original has it.
    #[test]
    fn occurrences_are_insertions_minus_removals() {
        let (geoms, ids) = geoms(40);
        let (mut overlaps, mut plain) = (Overlaps::default(), Vec::new());
        let mut number = 1u32;
        for _ in 0..20_000 {
            number = number.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            let geom = ids[(number >> 16) as usize % ids.len()];
            if number >> 28 < 9 {
                overlaps.extend(&[geom], &geoms);
                plain.push(geom);
            } else {
                let position = plain.iter().position(|&other| other == geom);
                position.map(|position| plain.remove(position));
                assert_eq!(overlaps.remove(geom), position.is_some());
            }
        }
        assert!(plain.len() > 1000 && !overlaps.more.is_empty());
        for geom in plain {
            assert!(overlaps.remove(geom));
        }
        assert!(overlaps.list.is_empty() && overlaps.more.is_empty());
    }

    #[test]
    fn removed_geoms_do_not_accumulate() {
        let (mut geoms, ids) = geoms(1000);
        let mut overlaps = Overlaps::default();
        for geom in ids {
            overlaps.extend(&[geom], &geoms);
            geoms.discard(geom);
        }
        assert!(overlaps.list.len() <= MIN_SWEPT && overlaps.more.is_empty());
    }

    #[test]
    fn repeated_overlaps_are_counted() {
        let (geoms, ids) = geoms(1);
        let mut overlaps = Overlaps::default();
        for _ in 0..1000 {
            overlaps.extend(&ids, &geoms);
        }
        assert!(overlaps.list.len() <= MIN_SWEPT);
        assert_eq!(overlaps.list.len() + overlaps.more[0].1 as usize, 1000);
    }
}
