//! Spatial hash broad phase: square cells of adjustable size (behaviour chapter 08, section 4).

use serde::{Deserialize, Serialize};

use super::PairCallback;
use super::dotnet_dictionary::DotnetDictionary;
use crate::contacts::pair_id::PairId;
use crate::geom::GeomId;
use crate::geom::entry::Geoms;
use crate::math::scalar::{max, to_int};
use crate::shape::Aabb;
use crate::storage::stamped_set::StampedSet;

/// Maximum number of cell entries per update, one for every cell that a geom covers. Each geom adds
/// [`MORE_CELL_ENTRIES_PER_GEOM`]. A geom whose entries exceed it is tested against every other geom instead. The
/// original fills cells until memory is exhausted. Chosen; no range measured.
const MAX_CELL_ENTRIES: u64 = 1 << 16;
const MORE_CELL_ENTRIES_PER_GEOM: u64 = 64;

#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub(crate) struct SpatialHash {
    /// Geoms by cell. Lists are emptied in every update; a cell that stays empty is removed in the next.
    cells: DotnetDictionary<(i32, i32), Vec<GeomId>>,
    #[serde(skip)]
    dead: Vec<(i32, i32)>,
    #[serde(skip)]
    oversized: Vec<GeomId>,
    #[serde(skip)]
    handled: StampedSet,
}

impl SpatialHash {
    pub(super) fn update(
        &mut self,
        cell_size: &mut f32,
        auto_adjust_cell_size: bool,
        sink: &mut impl PairCallback,
    ) {
        if sink.geom_list().is_empty() {
            return;
        }
        let sum_of_sides = self.fill(*cell_size, sink.geom_list(), sink.filter().geoms);
        if auto_adjust_cell_size {
            // The cell size of an update follows from the boxes of the update before.
            *cell_size = 2.0 * sum_of_sides / sink.geom_list().len() as f32;
        }
        self.handled.clear();
        self.dead.clear();
        for slot in 0..self.cells.slot_count() {
            self.offer_pairs_of_cell(slot, sink);
        }
        for i in 0..self.oversized.len() {
            for j in 0..sink.geom_list().len() {
                let other = sink.geom_list()[j];
                if other != self.oversized[i] {
                    offer_pair(self.oversized[i], other, &mut self.handled, sink);
                }
            }
        }
        for &key in &self.dead {
            self.cells.remove(key);
        }
    }

    /// Puts every geom into the cells its box covers, and returns the sum of the longer sides of the boxes.
    fn fill(&mut self, cell_size: f32, geom_list: &[GeomId], geoms: &Geoms) -> f32 {
        let inverse = 1.0 / cell_size;
        let mut free_entries = MAX_CELL_ENTRIES + MORE_CELL_ENTRIES_PER_GEOM * geom_list.len() as u64;
        let mut sum_of_sides = 0.0f32;
        self.oversized.clear();
        for &id in geom_list {
            let aabb = &geoms[id].aabb;
            sum_of_sides += max(aabb.max.x - aabb.min.x, aabb.max.y - aabb.min.y);
            let (x0, x1) = (to_int(aabb.min.x * inverse), to_int(aabb.max.x * inverse).wrapping_add(1));
            let (y0, y1) = (to_int(aabb.min.y * inverse), to_int(aabb.max.y * inverse).wrapping_add(1));
            let span = |from: i32, to: i32| (i64::from(to) - i64::from(from)).max(0) as u64;
            let covered = span(x0, x1).saturating_mul(span(y0, y1));
            // Billions of columns without a row, if a box reaches beyond the greatest cell.
            if covered == 0 {
                continue;
            }
            if covered > free_entries {
                self.oversized.push(id);
                continue;
            }
            free_entries -= covered;
            for x in x0..x1 {
                for y in y0..y1 {
                    self.cells.get_or_insert_with((x, y), Vec::new).push(id);
                }
            }
        }
        sum_of_sides
    }

    fn offer_pairs_of_cell(&mut self, slot: usize, sink: &mut impl PairCallback) {
        let Some((key, list)) = self.cells.slot_mut(slot) else { return };
        if list.is_empty() {
            self.dead.push(*key);
            return;
        }
        for (i, &a) in list.iter().enumerate() {
            for &b in &list[i + 1..] {
                offer_pair(a, b, &mut self.handled, sink);
            }
        }
        list.clear();
    }

    pub(super) fn is_valid(&self) -> bool {
        self.cells.is_consistent()
            && (0..self.cells.slot_count())
                .filter_map(|slot| self.cells.slot(slot))
                .all(|(_, list)| list.is_empty())
    }
}

/// Offers a pair that shares a cell. With a handler its answer replaces the box test, as in the original.
fn offer_pair(a: GeomId, b: GeomId, handled: &mut StampedSet, sink: &mut impl PairCallback) {
    let filter = sink.filter();
    let (geom_a, geom_b) = (&filter.geoms[a], &filter.geoms[b]);
    // The cheapest test comes first where no handler can observe the order.
    let overlap = Aabb::intersect(&geom_a.aabb, &geom_b.aabb);
    if !overlap && !sink.has_approval() {
        return;
    }
    if !filter.may_collide(geom_a, geom_b) {
        return;
    }
    if !handled.insert(PairId::get_id(geom_a.number as i32, geom_b.number as i32)) {
        return;
    }
    let accepted = if sink.has_approval() { sink.approve(a, b) } else { overlap };
    if accepted {
        sink.register(a, b);
    }
}
