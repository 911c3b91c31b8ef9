//! The geoms that a query has to test: those near its path in the hash grid of the precise set, or all.

use super::PhysicsSimulator;
use crate::geom::GeomId;
use crate::math::Vector2;
use crate::shape::Aabb;

/// A geom that a query tests.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Candidate {
    /// Number by which geoms are sorted as in the list of geoms.
    pub(crate) list_key: u32,
    pub(crate) geom: GeomId,
    /// Whether the box of the geom is known to overlap the AABB of the query.
    pub(crate) is_inside: bool,
}

/// A straight path of an AABB.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Segment {
    /// Centre of the AABB at the start, in length units.
    pub(crate) start: Vector2,
    /// Centre of the AABB at the end, in length units.
    pub(crate) end: Vector2,
    /// Half extents of the AABB, in length units, >= 0; 0 for a ray.
    pub(crate) half_extents: Vector2,
}

/// The candidate that comes first by a number, and by the order of the list of geoms at equal numbers.
#[derive(Debug)]
pub(crate) struct First<T> {
    best: Option<(f64, u32, T)>,
}

impl<T> First<T> {
    pub(crate) fn new() -> Self {
        First { best: None }
    }

    /// Takes an item with its number, unless the present one comes first.
    pub(crate) fn offer(&mut self, list_key: u32, number: f64, item: T) {
        let is_first = self
            .best
            .as_ref()
            .is_none_or(|&(best, key, _)| number < best || number == best && list_key < key);
        if is_first {
            self.best = Some((number, list_key, item));
        }
    }

    /// Returns the number of the first item; 1 without one.
    pub(crate) fn number(&self) -> f64 {
        self.best.as_ref().map_or(1.0, |&(number, ..)| number)
    }

    pub(crate) fn into_item(self) -> Option<T> {
        self.best.map(|(_, _, item)| item)
    }
}

/// Sorts items by number and by the order of the list of geoms, each geom once, and returns the items without their keys.
pub(crate) fn in_order<T>(mut items: Vec<(u64, u32, T)>) -> Vec<T> {
    items.sort_unstable_by_key(|&(number, key, _)| (number, key));
    items.dedup_by_key(|&mut (_, key, _)| key);
    items.into_iter().map(|(.., item)| item).collect()
}

/// Returns an integer that is ordered as a fraction of 0 or more is; the sum makes -0 and +0 equal.
pub(crate) fn fraction_key(fraction: f64) -> u64 {
    (fraction + 0.0).to_bits()
}

impl PhysicsSimulator {
    /// Calls `visit` with the geoms that may overlap an AABB, and perhaps others: in no particular order, and perhaps twice with
    /// one of them. All geoms come if there is no grid.
    #[inline(always)]
    pub(crate) fn for_each_near(&self, aabb: &Aabb, mut visit: impl FnMut(Candidate)) {
        let grid = self.pipeline.precise.as_ref().and_then(|precise| precise.grid_query(&self.objects));
        let is_done = grid.is_some_and(|grid| grid.for_each_near(aabb, &mut visit));
        if !is_done {
            self.for_each_listed(visit);
        }
    }

    /// Calls `visit` with the geoms that an AABB may touch on a straight path, as [`for_each_near`](Self::for_each_near) does.
    /// `visit` returns the fraction of the path beyond which geoms are of no interest, 0..=1.
    #[inline(always)]
    pub(crate) fn for_each_along(&self, segment: &Segment, mut visit: impl FnMut(Candidate) -> f64) {
        let grid = self.pipeline.precise.as_ref().and_then(|precise| precise.grid_query(&self.objects));
        let is_done = grid.is_some_and(|grid| grid.for_each_along(segment, &mut visit));
        if !is_done {
            self.for_each_listed(|candidate| {
                visit(candidate);
            });
        }
    }

    fn for_each_listed(&self, mut visit: impl FnMut(Candidate)) {
        for (list_key, &geom) in (0..).zip(self.objects.geom_list()) {
            visit(Candidate { list_key, geom, is_inside: false });
        }
    }
}
