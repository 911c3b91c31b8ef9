//! What a geom of the sweep and prune method overlaps on one axis (behaviour chapter 08, section 3).

use serde::{Deserialize, Serialize};

use crate::geom::GeomId;
use crate::geom::entry::Geoms;
use crate::storage::arena::Id as _;
use crate::storage::order::sort_by_number;

/// Shorter lists are not swept.
const MIN_SWEPT: usize = 32;

/// Overlaps that were offered as pairs already. A pair refused once is not offered again on this axis.
///
/// A bag: a geom that is removed and added again while it overlaps is in it once more every time, as in the original,
/// and each end of an overlap takes out one. What is gone for good is swept out, and what is in more than once is counted.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub(super) struct Overlaps {
    list: Vec<GeomId>,
    /// How often geoms are in besides the list.
    more: Vec<(GeomId, u32)>,
}

impl Overlaps {
    /// Puts geoms in, and sweeps whenever the list outgrows a power of two: so it stays within twice what can be in it.
    pub(super) fn extend(&mut self, begun: &[GeomId], geoms: &Geoms) {
        let room = self.list.len().next_power_of_two().max(MIN_SWEPT);
        self.list.extend_from_slice(begun);
        if self.list.len() > room {
            self.sweep(geoms);
        }
    }

    /// Takes a geom out once; answers whether it was in.
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

    /// Drops the geoms that are gone: their ids never come back. Of the others each stays in the list once.
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

    /// Whether everything that is counted is there: false only after loading garbage.
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

    /// Against a plain list of which the first equal one is removed, as the original has it.
    #[test]
    fn a_geom_is_in_as_often_as_it_was_put_in_and_not_taken_out() {
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
    fn what_is_gone_does_not_pile_up() {
        let (mut geoms, ids) = geoms(1000);
        let mut overlaps = Overlaps::default();
        for geom in ids {
            overlaps.extend(&[geom], &geoms);
            geoms.discard(geom);
        }
        assert!(overlaps.list.len() <= MIN_SWEPT && overlaps.more.is_empty());
    }

    #[test]
    fn what_comes_again_and_again_is_counted() {
        let (geoms, ids) = geoms(1);
        let mut overlaps = Overlaps::default();
        for _ in 0..1000 {
            overlaps.extend(&ids, &geoms);
        }
        assert!(overlaps.list.len() <= MIN_SWEPT);
        assert_eq!(overlaps.list.len() + overlaps.more[0].1 as usize, 1000);
    }
}
