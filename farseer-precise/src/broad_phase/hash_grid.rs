//! Broad phase: a hierarchical hash grid that finds the AABBs which overlap a query AABB.
//!
//! Each AABB has one entry: in the cell of its centre, on the level whose cells are more than twice as large as the AABB. So
//! an AABB reaches at most a quarter of a cell beyond its cell. Each level keeps the bounds of its AABBs and their largest
//! half extents; a query visits the cells of its AABB, enlarged by these half extents. Large floors and other rare large
//! shapes are on levels with few entries, so they cost small shapes little. The long fat AABB of a fast body is on a coarser
//! level while the body is fast.
//!
//! Source: hierarchical hash grids, C. Ericson, "Real-Time Collision Detection" (2005), section 7.2. The multipliers of the
//! hash are primes of xxHash32 (Y. Collet).

mod segment;

pub use segment::GridSegment;

use crate::index::{DenseIndex, IndexedVec, ProxyIndex, index_type};
use crate::parameters::broad_phase::{
    GRID_ENTRIES_PER_CELL, GRID_FEW_ENTRIES, GRID_FEW_STOPPERS, GRID_LEVELS, GRID_MAX_CELL_INDEX,
    GRID_MIN_CELL_EXPONENT,
};
use wide::f32x4;

use crate::math::lanes::select;
use crate::reusing_clone;

/// AABB as [min x, min y, max x, max y], in length units, world axes.
pub(crate) type PackedAabb = [f32; 4];

/// Index that stands for no entry of the grid: it ends the list of a bucket.
const NO_ENTRY: ProxyIndex = ProxyIndex(u32::MAX);

/// Returns whether two AABBs overlap or touch.
#[inline(always)]
pub fn overlap(a: &PackedAabb, b: &PackedAabb) -> bool {
    a[0] <= b[2] && b[0] <= a[2] && a[1] <= b[3] && b[1] <= a[3]
}

/// AABB with negated maxima: [min x, min y, -max x, -max y], in length units. One SIMD comparison with the limits of a query
/// then tests the overlap without branches, which the processor could not predict.
type NegatedAabb = [f32; 4];

/// Returns an AABB with negated maxima: the form of [`NegatedAabb`].
fn negate_max([low_x, low_y, high_x, high_y]: &PackedAabb) -> NegatedAabb {
    [*low_x, *low_y, -high_x, -high_y]
}

/// Returns the upper limits of the four components of a [`NegatedAabb`], in length units: an AABB overlaps the given query AABB
/// if no component exceeds its limit.
fn query_limits([low_x, low_y, high_x, high_y]: &PackedAabb) -> f32x4 {
    f32x4::new([*high_x, *high_y, -low_x, -low_y])
}

/// Returns whether an AABB overlaps the query AABB that `limits` were computed from by [`query_limits`].
#[inline(always)]
fn overlaps_query(level_bounds: &NegatedAabb, limits: f32x4) -> bool {
    f32x4::new(*level_bounds).simd_le(limits).all()
}

/// Cell of the grid: index of its level, and integer coordinates in cells of that level.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct GridCell {
    level: u8,
    x: i32,
    y: i32,
}

/// Entry of the grid: an AABB, and the index of the next entry in the same bucket or [`NO_ENTRY`]. A query reads both and
/// nothing else of an entry, so both are adjacent in memory.
#[derive(Debug, Clone, Copy)]
struct GridEntry {
    aabb: NegatedAabb,
    next: ProxyIndex,
}

impl Default for GridEntry {
    fn default() -> Self {
        GridEntry { aabb: [0.0; 4], next: NO_ENTRY }
    }
}

index_type! {
    /// Position of an entry in the list of its level, or in [`HashGrid::stoppers`].
    struct MemberPosition;
}

/// Cell in which an entry of the grid lies, and the index of the previous entry of the same bucket, or [`NO_ENTRY`].
///
/// The other fields are the positions of the entry in the list of its level and in [`HashGrid::stoppers`]; `None` if it may not stop
/// fast bodies.
#[derive(Debug, Clone, Copy)]
struct BucketLink {
    cell: GridCell,
    previous: ProxyIndex,
    in_level: MemberPosition,
    in_stoppers: Option<MemberPosition>,
}

/// One level of the grid: number of its AABBs, their bounds and largest sizes. A query reads it to skip the level or to choose
/// cells.
#[derive(Debug, Clone, Copy, Default)]
struct GridLevel {
    count: u32,
    /// Number of entries that may stop fast bodies: see [`HashGrid::stopper_levels`].
    stopper_count: u32,
    /// Bounds of all AABBs that were added to the level since it was last empty. The bounds grow only, until the level is empty
    /// again.
    bounds: NegatedAabb,
    /// Largest half extents along x and y of all AABBs that were added to the level since it was last empty, in length units,
    /// >= 0.
    max_half_extents: [f32; 2],
}

/// Bit masks with the sign bit in the first two SIMD lanes. An exclusive or with it turns enlargements [x, y, x, y] of an AABB
/// into offsets [-x, -y, +x, +y] of its corners.
const MIN_CORNER_SIGN_BITS: f32x4 = f32x4::new([-0.0, -0.0, 0.0, 0.0]);

/// Hierarchical hash grid: the AABBs of proxies in hashed cells. An entry has the index of its proxy.
#[derive(Debug, Default)]
pub struct HashGrid {
    entries: IndexedVec<ProxyIndex, GridEntry>,
    links: IndexedVec<ProxyIndex, Option<BucketLink>>,
    /// Index of the first entry of each bucket, or [`NO_ENTRY`].
    bucket_heads: Vec<ProxyIndex>,
    levels: Vec<GridLevel>,
    /// Bit mask of the levels that have entries: bit i for level i.
    used_levels: u64,
    /// Bit mask of the levels that have entries which may stop fast bodies: bit i for level i.
    stopper_levels: u64,
    /// Indices of the entries of each level, in no particular order. Levels that no entry has been in yet may be missing at the end.
    members: Vec<Vec<ProxyIndex>>,
    /// Indices of all entries that may stop fast bodies, in no particular order.
    stoppers: Vec<ProxyIndex>,
}

reusing_clone! {
    HashGrid { entries, links, bucket_heads, levels, used_levels, stopper_levels, members, stoppers }
}

/// Returns the index of the level for an AABB. The cell size of the level, 2^(level + `GRID_MIN_CELL_EXPONENT`), is more than
/// twice the larger side of the AABB.
fn grid_level_of(bounds: &PackedAabb) -> u8 {
    let width = (bounds[2] - bounds[0]).max(bounds[3] - bounds[1]);
    // Exponent of twice the width, rounded up to the next power of two.
    let exponent = ((2.0 * width).to_bits() >> 23) as i32 - 127 + 1;
    (exponent - GRID_MIN_CELL_EXPONENT).clamp(0, GRID_LEVELS - 1) as u8
}

/// Returns the reciprocal of the cell size of a level, in 1 / length units. It is exact, a power of two.
fn inverse_cell_size(level: u8) -> f32 {
    f32::from_bits(((127 - i32::from(level) - GRID_MIN_CELL_EXPONENT) as u32) << 23)
}

/// Returns the cell indices of four coordinates, clamped to +-`GRID_MAX_CELL_INDEX`. `coordinates` are in length units, and
/// `inverse_size` is the reciprocal of the cell size, in 1 / length units.
#[inline(always)]
fn cell_indices(coordinates: f32x4, inverse_size: f32) -> [i32; 4] {
    let (scaled, last) = (coordinates * f32x4::splat(inverse_size), f32x4::splat(GRID_MAX_CELL_INDEX));
    let scaled = select(scaled.simd_lt(last), scaled, last);
    let scaled = select(scaled.simd_gt(-last), scaled, -last);
    // The conversion truncates toward zero, so negative numbers need a correction to the floor.
    let whole = f32x4::from_i32x4(scaled.fast_trunc_int());
    (whole - (whole.simd_gt(scaled) & f32x4::ONE)).fast_trunc_int().to_array()
}

impl GridLevel {
    /// Enlarges the bounds and largest half extents of the level so that they include an AABB.
    #[inline(always)]
    fn include(&mut self, bounds: &PackedAabb) {
        if self.count == 0 {
            (self.bounds, self.max_half_extents) = (negate_max(bounds), [0.0; 2]);
        }
        for (all, side) in self.bounds.iter_mut().zip(negate_max(bounds)) {
            *all = if side < *all { side } else { *all };
        }
        for (axis, max_half_extents) in self.max_half_extents.iter_mut().enumerate() {
            let half = 0.5 * bounds[axis + 2] - 0.5 * bounds[axis];
            *max_half_extents = if half > *max_half_extents { half } else { *max_half_extents };
        }
    }
}

impl HashGrid {
    /// Removes all entries and makes the grid ready for the indices below `capacity`, with at least twice as many buckets.
    pub(crate) fn reset(&mut self, capacity: usize) {
        self.entries.clear();
        self.entries.resize(capacity, GridEntry::default());
        self.links.clear();
        self.links.resize(capacity, None);
        self.bucket_heads.clear();
        self.bucket_heads.resize((2 * capacity).next_power_of_two().max(16), NO_ENTRY);
        self.levels.clear();
        self.levels.resize(GRID_LEVELS as usize, GridLevel::default());
        (self.used_levels, self.stopper_levels) = (0, 0);
        self.members.iter_mut().for_each(Vec::clear);
        self.stoppers.clear();
    }

    /// Returns whether the grid has at least one bucket for each of `capacity` entries.
    pub fn has_capacity(&self, capacity: usize) -> bool {
        capacity <= self.bucket_heads.len()
    }

    /// Enlarges the grid to the indices below `capacity`. The present entries and the number of buckets stay.
    pub fn grow(&mut self, capacity: usize) {
        self.entries.resize(capacity, GridEntry::default());
        self.links.resize(capacity, None);
    }

    /// Returns the index of the bucket of a cell: a hash of the cell's level and coordinates.
    #[inline(always)]
    fn bucket(&self, cell: GridCell) -> usize {
        let mixed = (cell.x as u32)
            .wrapping_mul(0x9E37_79B1)
            .wrapping_add((cell.y as u32).wrapping_mul(0x85EB_CA77))
            .wrapping_add(u32::from(cell.level).wrapping_mul(0xC2B2_AE3D))
            .rotate_right(16)
            .wrapping_mul(0x9E37_79B1);
        (mixed >> 7) as usize & (self.bucket_heads.len() - 1)
    }

    /// Adds the entry `index` with the AABB `bounds`, or moves it to the cell of this AABB if it is in the grid already.
    /// `may_stop`: whether the entry may stop fast bodies, see [`stopper_levels`](Self::stopper_levels); it must not change while
    /// the entry is in the grid.
    pub(crate) fn insert_or_move(&mut self, index: ProxyIndex, bounds: &PackedAabb, may_stop: bool) {
        let level = grid_level_of(bounds);
        let middle = |axis: usize| 0.5 * bounds[axis] + 0.5 * bounds[axis + 2];
        let [x, y, ..] = cell_indices(f32x4::new([middle(0), middle(1), 0.0, 0.0]), inverse_cell_size(level));
        let cell = GridCell { level, x, y };
        self.entries[index].aabb = negate_max(bounds);
        self.levels[usize::from(level)].include(bounds);
        if self.links[index].is_some_and(|link| link.cell == cell) {
            return;
        }
        self.remove(index);
        let bucket = self.bucket(cell);
        let next = std::mem::replace(&mut self.bucket_heads[bucket], index);
        self.entries[index].next = next;
        let in_level = self.push_member(level, index);
        let in_stoppers = may_stop.then(|| push_to(&mut self.stoppers, index));
        self.links[index] = Some(BucketLink { cell, previous: NO_ENTRY, in_level, in_stoppers });
        self.set_previous(next, index);
        self.levels[usize::from(level)].count += 1;
        self.levels[usize::from(level)].stopper_count += u32::from(may_stop);
        self.used_levels |= 1 << level;
        self.stopper_levels |= u64::from(may_stop) << level;
    }

    /// Appends an entry to the list of its level, and returns its position there.
    fn push_member(&mut self, level: u8, index: ProxyIndex) -> MemberPosition {
        let level = usize::from(level);
        if self.members.len() <= level {
            self.members.resize(level + 1, Vec::new());
        }
        push_to(&mut self.members[level], index)
    }

    /// Removes an entry from the list of its level and from the stoppers. `link` was its link.
    fn remove_member(&mut self, link: &BucketLink) {
        let of_level = &mut self.members[usize::from(link.cell.level)];
        of_level.swap_remove(link.in_level.position());
        let moved = of_level.get(link.in_level.position()).and_then(|&other| self.links[other].as_mut());
        moved.into_iter().for_each(|other| other.in_level = link.in_level);
        if let Some(at) = link.in_stoppers {
            self.stoppers.swap_remove(at.position());
            let moved = self.stoppers.get(at.position()).and_then(|&other| self.links[other].as_mut());
            moved.into_iter().for_each(|other| other.in_stoppers = Some(at));
        }
    }

    /// Stores `previous` as the previous entry in the bucket list of entry `index`, if there is such an entry.
    fn set_previous(&mut self, index: ProxyIndex, previous: ProxyIndex) {
        if let Some(Some(link)) = self.links.at_mut(index) {
            link.previous = previous;
        }
    }

    /// Removes the entry `index` from the grid, if it is in the grid.
    pub fn remove(&mut self, index: ProxyIndex) {
        let Some(link) = self.links[index].take() else { return };
        self.remove_member(&link);
        let BucketLink { cell, previous, in_stoppers, .. } = link;
        let next = self.entries[index].next;
        if previous == NO_ENTRY {
            let bucket = self.bucket(cell);
            self.bucket_heads[bucket] = next;
        } else {
            self.entries[previous].next = next;
        }
        self.set_previous(next, previous);
        let level = &mut self.levels[usize::from(cell.level)];
        level.count -= 1;
        level.stopper_count -= u32::from(in_stoppers.is_some());
        if level.count == 0 {
            self.used_levels &= !(1 << cell.level);
        }
        if level.stopper_count == 0 {
            self.stopper_levels &= !(1 << cell.level);
        }
    }

    /// Returns the mask of the levels that have entries which may stop fast bodies: bit i for level i. Continuous collision
    /// queries these levels alone where no dynamic body is an obstacle (Box2D 3 queries its static tree alone).
    pub(crate) fn stopper_levels(&self) -> u64 {
        self.stopper_levels
    }

    /// Calls `found` with the index of each entry whose AABB overlaps the query AABB `bounds`, in no particular order. An index
    /// may come twice, since two cells may have one bucket. An entry with the AABB `bounds` itself is found, too.
    #[inline(always)]
    pub fn for_each_overlap(&self, bounds: &PackedAabb, found: impl FnMut(ProxyIndex)) {
        self.for_each_overlap_in_levels(!0, bounds, found);
    }

    /// Calls `found` with the index of each entry that may stop fast bodies and whose AABB overlaps the query AABB `bounds`, as
    /// [`for_each_overlap`](Self::for_each_overlap). It may find other entries of the same levels, too.
    #[inline(always)]
    pub(crate) fn for_each_stopper(&self, bounds: &PackedAabb, mut found: impl FnMut(ProxyIndex)) {
        if self.stoppers.len() <= GRID_FEW_STOPPERS {
            return self.for_each_of(&self.stoppers, query_limits(bounds), &mut found);
        }
        self.for_each_overlap_in_levels(self.stopper_levels, bounds, found);
    }

    /// Runs [`for_each_overlap`](Self::for_each_overlap) on the levels of the mask `levels`: bit i for level i.
    #[inline(always)]
    fn for_each_overlap_in_levels(
        &self,
        levels: u64,
        bounds: &PackedAabb,
        mut found: impl FnMut(ProxyIndex),
    ) {
        let (mut used, limits) = (self.used_levels & levels, query_limits(bounds));
        let corners = f32x4::new(*bounds);
        // Rounding of coordinates far from the origin may move an AABB to a neighbouring cell.
        let rounding = corners.abs() * f32x4::splat(4.0 * f32::EPSILON);
        while used != 0 {
            let level = used.trailing_zeros() as u8;
            used &= used - 1;
            let GridLevel { bounds: level_bounds, max_half_extents, count, .. } =
                &self.levels[usize::from(level)];
            if !overlaps_query(level_bounds, limits) {
                continue;
            }
            if *count <= GRID_FEW_ENTRIES {
                self.for_each_of(&self.members[usize::from(level)], limits, &mut found);
                continue;
            }
            let enlargement = f32x4::new([
                max_half_extents[0],
                max_half_extents[1],
                max_half_extents[0],
                max_half_extents[1],
            ]) + rounding;
            let [left, top, right, bottom] =
                cell_indices(corners + (enlargement ^ MIN_CORNER_SIGN_BITS), inverse_cell_size(level));
            let span = |low: i32, high: i32| i64::from(high) - i64::from(low) + 1;
            let (width, height) = (span(left, right), span(top, bottom));
            // Query AABBs may have a maximum below the minimum, and a large AABB may overlap them all the same.
            let is_reversed = width <= 0 || height <= 0;
            let is_last = i32::from(level) == GRID_LEVELS - 1;
            let are_few =
                || i64::from(*count) <= width.saturating_mul(height).saturating_mul(GRID_ENTRIES_PER_CELL);
            if is_last || is_reversed || are_few() {
                self.for_each_of(&self.members[usize::from(level)], limits, &mut found);
                continue;
            }
            for y in top..=bottom {
                for x in left..=right {
                    self.for_each_in_cell(GridCell { level, x, y }, limits, &mut found);
                }
            }
        }
    }

    /// Calls `found` for each entry in the bucket of a cell that overlaps the query. Entries of other cells in the bucket are
    /// tested too: that costs less than a comparison of cells. `limits`: see [`query_limits`].
    #[inline(always)]
    fn for_each_in_cell(&self, cell: GridCell, limits: f32x4, found: &mut impl FnMut(ProxyIndex)) {
        let mut at = self.bucket_heads[self.bucket(cell)];
        while at != NO_ENTRY {
            let entry = &self.entries[at];
            if overlaps_query(&entry.aabb, limits) {
                found(at);
            }
            at = entry.next;
        }
    }

    /// Calls `found` for each of these entries that overlaps the query. `limits`: see [`query_limits`].
    #[inline(always)]
    fn for_each_of(&self, entries: &[ProxyIndex], limits: f32x4, found: &mut impl FnMut(ProxyIndex)) {
        for &at in entries {
            if overlaps_query(&self.entries[at].aabb, limits) {
                found(at);
            }
        }
    }
}

/// Appends an entry to a list, and returns its position there.
fn push_to(list: &mut Vec<ProxyIndex>, index: ProxyIndex) -> MemberPosition {
    let position = MemberPosition::new(list.len());
    list.push(index);
    position
}

#[cfg(test)]
mod tests {
    use super::HashGrid;
    use super::PackedAabb;
    use super::grid_level_of;
    use super::inverse_cell_size;
    use super::overlap;
    use crate::index::{DenseIndex, ProxyIndex};

    /// Returns AABBs with sides from almost 0 to 8e30 length units, near the origin and far from it.
    fn boxes() -> Vec<PackedAabb> {
        let mut state = 1_u32;
        let mut next = |most: f32| {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 8) as f32 / 16_777_216.0 * most
        };
        let mut one = || {
            let size = [0.5, 3.0, 20.0, 900.0][next(4.0) as usize];
            let (x, y) = (next(1000.0) - 500.0, next(300.0) - 150.0);
            [x, y, x + next(size), y + next(size)]
        };
        let mut all: Vec<PackedAabb> = (0..300).map(|_| one()).collect();
        all.push([-1e30, -1.0, -1e29, 1.0]);
        all.push([-3e30, -2.0, 5e30, 0.0]);
        all
    }

    fn enter(grid: &mut HashGrid, aabbs: &[PackedAabb]) {
        aabbs
            .iter()
            .enumerate()
            .for_each(|(i, bounds)| grid.insert_or_move(ProxyIndex(i as u32), bounds, i % 7 == 0));
    }

    fn check(grid: &HashGrid, aabbs: &[PackedAabb]) {
        for bounds in aabbs {
            let mut found = Vec::new();
            grid.for_each_overlap(bounds, |other| found.push(other.position()));
            found.sort_unstable();
            found.dedup();
            let expected: Vec<usize> =
                (0..aabbs.len()).filter(|&other| overlap(bounds, &aabbs[other])).collect();
            assert_eq!(found, expected, "of {bounds:?}");
        }
    }

    #[test]
    fn query_finds_exactly_the_overlapping_aabbs() {
        let aabbs = boxes();
        let mut grid = HashGrid::default();
        grid.reset(aabbs.len());
        enter(&mut grid, &aabbs);
        check(&grid, &aabbs);
    }

    #[test]
    fn query_finds_moved_aabbs_at_their_new_cells() {
        let mut aabbs = boxes();
        let mut grid = HashGrid::default();
        grid.reset(aabbs.len());
        for _ in 0..3 {
            enter(&mut grid, &aabbs);
            aabbs.rotate_right(7);
            aabbs.iter_mut().take(150).for_each(|bounds| *bounds = bounds.map(|x| 0.9 * x + 40.0));
        }
        enter(&mut grid, &aabbs);
        check(&grid, &aabbs);
    }

    #[test]
    fn levels_of_stoppers_hold_all_stoppers_and_no_other_level() {
        let mut aabbs = boxes();
        let mut grid = HashGrid::default();
        grid.reset(aabbs.len());
        enter(&mut grid, &aabbs);
        aabbs.iter_mut().for_each(|bounds| *bounds = bounds.map(|x| 3.0 * x));
        enter(&mut grid, &aabbs);
        let levels = |step: usize| {
            aabbs.iter().step_by(step).fold(0, |mask, bounds| mask | 1_u64 << grid_level_of(bounds))
        };
        assert_eq!(grid.stopper_levels(), levels(7));
        assert_ne!(levels(7), levels(1), "some level has no stopper");
        (0..aabbs.len() as u32).for_each(|entry| grid.remove(ProxyIndex(entry)));
        assert_eq!(grid.stopper_levels(), 0);
    }

    #[test]
    fn cell_size_exceeds_twice_the_aabb_extent() {
        for width in [1e-6_f32, 0.3, 0.5, 1.0, 1.5, 31.0, 32.0, 1e6] {
            let size = 1.0 / inverse_cell_size(grid_level_of(&[0.0, 0.0, width, 0.5 * width]));
            assert!(size > 2.0 * width && size <= 8.0 * width, "{size} for {width}");
        }
    }
}
