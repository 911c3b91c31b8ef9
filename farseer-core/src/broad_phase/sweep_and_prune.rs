//! Sweep and prune: incrementally sorted extents on both axes (behaviour chapter 08, section 3).

use serde::{Deserialize, Serialize};

use super::PairCallback;
use super::dotnet_dictionary::DotnetDictionary;
use super::sap_overlaps::Overlaps;
use crate::geom::GeomId;
use crate::geom::entry::Geoms;
use crate::math::Vector2;
use crate::shape::Aabb;

/// Margin of the boxes on all sides, in length units. Farseer's value.
const TOLERANCE: f32 = 0.01;

/// One bound of a geom on one axis.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
struct Extent {
    #[serde(with = "crate::storage::bits")]
    value: f32,
    info: u32,
    is_min: bool,
}

/// The overlaps of a geom on one axis.
#[derive(Debug, Clone, Serialize, Deserialize)]
struct ExtentInfo {
    geom: GeomId,
    overlaps: Overlaps,
    /// Geoms whose overlap began in this update.
    under_consideration: Vec<GeomId>,
}

/// Key of the pair dictionary: creation numbers, the smaller one first.
type PairKey = (u32, u32);
type PairTable = DotnetDictionary<PairKey, (GeomId, GeomId)>;

#[derive(Debug, Clone, Default, Serialize, Deserialize)]
struct SortedExtents {
    infos: Vec<ExtentInfo>,
    /// Ascending by value after every update.
    extents: Vec<Extent>,
}

fn remove_first(list: &mut Vec<GeomId>, geom: GeomId) -> bool {
    match list.iter().position(|&other| other == geom) {
        Some(position) => {
            list.remove(position);
            true
        }
        None => false,
    }
}

fn pair_of(geom1: GeomId, geom2: GeomId, geoms: &Geoms) -> Option<(PairKey, (GeomId, GeomId))> {
    let (number1, number2) = (geoms.get(geom1)?.number, geoms.get(geom2)?.number);
    if number1 < number2 {
        Some(((number1, number2), (geom1, geom2)))
    } else {
        Some(((number2, number1), (geom2, geom1)))
    }
}

impl SortedExtents {
    /// Inserts the extents of a new geom where their values belong, with the overlaps that are open there.
    fn insert(&mut self, geom: GeomId, min: f32, max: f32) {
        let info = self.infos.len() as u32;
        let min_position = self.insert_extent(Extent { value: min, info, is_min: true });
        let max_position = self.insert_extent(Extent { value: max, info, is_min: false });
        for position in min_position + 1..max_position {
            let extent = self.extents[position];
            if extent.is_min {
                self.infos[extent.info as usize].under_consideration.push(geom);
            }
        }
        let under_consideration = self.open_at(min_position, geom);
        self.infos.push(ExtentInfo { geom, overlaps: Overlaps::default(), under_consideration });
    }

    fn insert_extent(&mut self, new: Extent) -> usize {
        let goes_behind =
            |e: &Extent| e.value < new.value || (e.value == new.value && e.is_min && !new.is_min);
        let position = self.extents.iter().position(|e| !goes_behind(e)).unwrap_or(self.extents.len());
        self.extents.insert(position, new);
        position
    }

    /// The geoms open just before a position, as far as the nearest open one records them. Overlaps that existed before
    /// this update are missing, as in the original.
    fn open_at(&self, min_position: usize, geom: GeomId) -> Vec<GeomId> {
        let Some(nearest) = (0..min_position).rev().find(|&c| self.extents[c].is_min) else {
            return Vec::new();
        };
        let neighbour = &self.infos[self.extents[nearest].info as usize];
        let mut open = vec![neighbour.geom];
        open.extend_from_slice(&neighbour.under_consideration);
        remove_first(&mut open, geom);
        for extent in self.extents[nearest..min_position].iter().filter(|extent| !extent.is_min) {
            remove_first(&mut open, self.infos[extent.info as usize].geom);
        }
        open
    }

    fn refresh(&mut self, geoms: &Geoms, component: impl Fn(&Vector2) -> f32) {
        for extent in &mut self.extents {
            let aabb = &geoms[self.infos[extent.info as usize].geom].aabb;
            extent.value = if extent.is_min {
                component(&aabb.min) - TOLERANCE
            } else {
                component(&aabb.max) + TOLERANCE
            };
        }
    }

    /// Insertion sort; every exchange of neighbours begins or ends an overlap.
    fn sort(&mut self, pairs: &mut PairTable, geoms: &Geoms) {
        for i in 1..self.extents.len() {
            let moved = self.extents[i];
            let mut position = i;
            while position > 0 && self.extents[position - 1].value > moved.value {
                let passed = self.extents[position - 1];
                self.exchange(moved, passed, pairs, geoms);
                self.extents[position] = passed;
                position -= 1;
            }
            self.extents[position] = moved;
        }
    }

    /// Updates the overlaps as `moved` goes to the left of `passed`.
    fn exchange(&mut self, moved: Extent, passed: Extent, pairs: &mut PairTable, geoms: &Geoms) {
        let (moved_info, passed_info) = (moved.info as usize, passed.info as usize);
        let (moved_geom, passed_geom) = (self.infos[moved_info].geom, self.infos[passed_info].geom);
        match (moved.is_min, passed.is_min) {
            (true, true) => {
                self.end_overlap(moved_info, passed_geom, pairs, geoms);
                self.infos[passed_info].under_consideration.push(moved_geom);
            }
            (true, false) => self.infos[moved_info].under_consideration.push(passed_geom),
            (false, true) => self.end_overlap(passed_info, moved_geom, pairs, geoms),
            (false, false) => {}
        }
    }

    /// Ends the overlap of the geom of `info` with another one.
    fn end_overlap(&mut self, info: usize, other: GeomId, pairs: &mut PairTable, geoms: &Geoms) {
        let info = &mut self.infos[info];
        remove_first(&mut info.under_consideration, other);
        if info.overlaps.remove(other)
            && let Some((key, _)) = pair_of(info.geom, other, geoms)
        {
            pairs.remove(key);
        }
    }

    fn retain(&mut self, alive: impl Fn(GeomId) -> bool, geoms: &Geoms) {
        for info in &mut self.infos {
            info.under_consideration.retain(|&geom| geoms.contains(geom));
        }
        let mut next = 0;
        let renumbered: Vec<Option<u32>> = self
            .infos
            .iter()
            .map(|info| {
                alive(info.geom).then(|| {
                    next += 1;
                    next - 1
                })
            })
            .collect();
        if next as usize == self.infos.len() {
            return;
        }
        self.extents.retain_mut(|extent| match renumbered[extent.info as usize] {
            Some(info) => {
                extent.info = info;
                true
            }
            None => false,
        });
        self.infos.retain(|info| alive(info.geom));
    }

    fn is_valid(&self, geoms: &Geoms) -> bool {
        let mut missing = vec![true; self.infos.len() * 2];
        self.infos.iter().all(|info| geoms.contains(info.geom) && info.overlaps.is_valid())
            && self.extents.len() == missing.len()
            && self.extents.iter().all(|extent| {
                let place = extent.info as usize * 2 + usize::from(extent.is_min);
                missing.get_mut(place).is_some_and(|m| std::mem::replace(m, false))
            })
    }
}

#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub(crate) struct SweepAndPrune {
    x: SortedExtents,
    y: SortedExtents,
    pairs: PairTable,
    #[serde(skip)]
    moved: Vec<GeomId>,
}

impl SweepAndPrune {
    pub(super) fn add(&mut self, id: GeomId, geoms: &Geoms) {
        let aabb = &geoms[id].aabb;
        self.x.insert(id, aabb.min.x, aabb.max.x);
        self.y.insert(id, aabb.min.y, aabb.max.y);
    }

    /// Discards all pairs, even if no geom was removed: as in the original, resting contacts continue only through
    /// arbiters that exist already.
    pub(super) fn retain(&mut self, alive: impl Fn(GeomId) -> bool, geoms: &Geoms) {
        self.x.retain(&alive, geoms);
        self.y.retain(&alive, geoms);
        self.pairs.clear();
    }

    pub(super) fn update(&mut self, sink: &mut impl PairCallback) {
        let geoms = sink.filter().geoms;
        self.x.refresh(geoms, |corner| corner.x);
        self.y.refresh(geoms, |corner| corner.y);
        self.x.sort(&mut self.pairs, geoms);
        self.y.sort(&mut self.pairs, geoms);
        let SweepAndPrune { x, y, pairs, moved } = self;
        for axis in [x, y] {
            for info in &mut axis.infos {
                if !info.under_consideration.is_empty() {
                    offer_new_overlaps(info, pairs, moved, sink);
                }
            }
        }
        for slot in 0..self.pairs.slot_count() {
            if let Some(&(_, (geom1, geom2))) = self.pairs.slot(slot) {
                sink.register(geom1, geom2);
            }
        }
    }

    pub(super) fn is_valid(&self, geoms: &Geoms) -> bool {
        self.x.is_valid(geoms)
            && self.y.is_valid(geoms)
            // A pair may name a geom that has been removed; it is skipped.
            && self.pairs.is_consistent()
    }
}

/// Registers new overlaps of one geom on one axis as pairs, if they overlap on the other axis as well.
fn offer_new_overlaps(
    info: &mut ExtentInfo,
    pairs: &mut PairTable,
    moved: &mut Vec<GeomId>,
    sink: &mut impl PairCallback,
) {
    moved.clear();
    moved.append(&mut info.under_consideration);
    info.overlaps.extend(moved, sink.filter().geoms);
    let a = info.geom;
    for &b in moved.iter() {
        let filter = sink.filter();
        // Geoms disposed since then form no pair; the original fails there.
        let Some(geom_b) = filter.geoms.get(b) else { continue };
        let geom_a = &filter.geoms[a];
        if !filter.may_collide(geom_a, geom_b)
            || !Aabb::intersect(&enlarged(&geom_a.aabb), &enlarged(&geom_b.aabb))
        {
            continue;
        }
        let Some((key, pair)) = pair_of(a, b, filter.geoms) else { continue };
        if sink.has_approval() && !sink.approve(a, b) {
            continue;
        }
        pairs.get_or_insert_with(key, || pair);
    }
}

fn enlarged(aabb: &Aabb) -> Aabb {
    let tolerance = Vector2::new(TOLERANCE, TOLERANCE);
    Aabb { min: aabb.min - tolerance, max: aabb.max + tolerance }
}
