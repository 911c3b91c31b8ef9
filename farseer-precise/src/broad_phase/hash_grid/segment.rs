//! Segment queries of the hash grid: the cells along a segment in their order, until a hit lies before the next cell.
//!
//! On each level the columns of cells across the larger component of the segment are visited in order, and in each column the
//! rows that the segment reaches. The segment is enlarged by the largest half extents of the level, as an AABB query is. Each hit
//! shortens the segment for the rest of the query.
//!
//! Sources: J. Amanatides and A. Woo, "A Fast Voxel Traversal Algorithm for Ray Tracing" (1987); the separating axis of a segment
//! and an AABB as in C. Ericson, "Real-Time Collision Detection" (2005), 5.3.3.

use super::{
    GridCell, GridLevel, HashGrid, NO_ENTRY, NegatedAabb, inverse_cell_size, overlaps_query, query_limits,
};
use crate::index::ProxyIndex;
use crate::parameters::broad_phase::{GRID_LEVELS, GRID_MAX_CELL_INDEX};
use wide::f32x4;

/// Segment of a query, or the path of an AABB along it.
#[derive(Debug, Clone, Copy)]
pub struct GridSegment {
    /// Start, in length units.
    pub start: [f32; 2],
    /// End, in length units.
    pub end: [f32; 2],
    /// Half extents of the AABB that moves along the segment, in length units, >= 0; for a ray the rounding tolerance.
    pub half_extents: [f32; 2],
    /// Fraction of the segment beyond which no entry is of interest, 0..=1.
    pub max_fraction: f64,
}

/// Segment while the query runs.
struct Walk {
    /// Start, in length units.
    start: [f64; 2],
    /// Vector from the start to the end, in length units.
    delta: [f64; 2],
    /// Half extents of the moved AABB, in length units.
    half_extents: [f64; 2],
    /// Fraction of the segment beyond which no entry is of interest, 0..=1.
    max_fraction: f64,
    /// Limits of the AABB around the segment up to `max_fraction`: see [`query_limits`].
    limits: f32x4,
}

impl Walk {
    fn new(segment: &GridSegment) -> Self {
        let [start, end, half_extents] =
            [segment.start, segment.end, segment.half_extents].map(|point| point.map(f64::from));
        let mut walk = Walk {
            start,
            delta: [end[0] - start[0], end[1] - start[1]],
            half_extents,
            max_fraction: segment.max_fraction,
            limits: f32x4::ZERO,
        };
        walk.set_limits();
        walk
    }

    /// Returns a coordinate of the point at a fraction of the segment, in length units.
    fn at(&self, axis: usize, fraction: f64) -> f64 {
        self.start[axis] + self.delta[axis] * fraction
    }

    fn set_limits(&mut self) {
        let [x, y] = [0, 1].map(|axis| (self.start[axis], self.at(axis, self.max_fraction)));
        let low = |(from, to): (f64, f64), half: f64| (from.min(to) - half) as f32;
        let high = |(from, to): (f64, f64), half: f64| (from.max(to) + half) as f32;
        let [half_x, half_y] = self.half_extents;
        self.limits = query_limits(&[low(x, half_x), low(y, half_y), high(x, half_x), high(y, half_y)]);
    }

    /// Shortens the segment to a fraction of its first length, unless it is shorter already.
    fn shorten(&mut self, fraction: f64) {
        if fraction < self.max_fraction {
            self.max_fraction = fraction;
            self.set_limits();
        }
    }

    /// Returns whether the AABB on the segment may touch another AABB: their projections on the axes and on the normal of the
    /// segment overlap.
    #[inline(always)]
    fn may_touch(&self, aabb: &NegatedAabb) -> bool {
        if !overlaps_query(aabb, self.limits) {
            return false;
        }
        let [low_x, low_y, high_x, high_y] = aabb.map(f64::from);
        let (x, y) = (0.5 * (low_x - high_x) - self.start[0], 0.5 * (low_y - high_y) - self.start[1]);
        let half_x = 0.5 * (-high_x - low_x) + self.half_extents[0];
        let half_y = 0.5 * (-high_y - low_y) + self.half_extents[1];
        let [dx, dy] = self.delta;
        (dx * y - dy * x).abs() <= dx.abs() * half_y + dy.abs() * half_x
    }
}

/// Cells of a level that a segment visits: columns across the axis `major`.
struct Columns {
    level: u8,
    /// Reciprocal of the cell size, in 1 / length units.
    inverse_size: f64,
    /// Axis of the larger component of the segment: 0 for x, 1 for y; dimensionless.
    major: usize,
    /// Distances along x and y within which an entry of a cell may touch the segment, in length units.
    reach: [f64; 2],
    /// Index of the first column in the order of the coordinate, in cells.
    first: i32,
    /// Index of the last column, in cells.
    last: i32,
    /// Indices of the first and the last row that any column reaches, in cells.
    rows: [i32; 2],
}

/// Fractions of a segment at which the AABBs of the cells of its first column begin and end, and their change from column to column,
/// all dimensionless.
struct ColumnFractions {
    enter: f64,
    leave: f64,
    step: f64,
}

impl Columns {
    fn fractions(&self, walk: &Walk) -> ColumnFractions {
        let Columns { inverse_size, major, reach, .. } = *self;
        let (size, is_forward) = (1.0 / inverse_size, walk.delta[major] >= 0.0);
        let inverse_delta = if walk.delta[major] == 0.0 { 0.0 } else { 1.0 / walk.delta[major] };
        let column = if is_forward { self.first } else { self.last };
        let outward = if is_forward { reach[major] } else { -reach[major] };
        let near = f64::from(column + i32::from(!is_forward)) * size - outward;
        let far = f64::from(column + i32::from(is_forward)) * size + outward;
        let fraction = |coordinate: f64| (coordinate - walk.start[major]) * inverse_delta;
        let leave = if inverse_delta == 0.0 { f64::INFINITY } else { fraction(far) };
        ColumnFractions { enter: fraction(near), leave, step: size * inverse_delta.abs() }
    }

    /// Returns the indices of the first and the last row that the segment reaches in a column, in cells; `None` if the segment ends
    /// before. Columns are numbered from 0 in the order along the segment.
    #[inline(always)]
    fn rows_at(&self, number: i64, fractions: &ColumnFractions, walk: &Walk) -> Option<[i32; 2]> {
        let minor = 1 - self.major;
        let passed = number as f64 * fractions.step;
        let enter = (fractions.enter + passed).max(0.0);
        if enter > walk.max_fraction {
            return None;
        }
        let leave = (fractions.leave + passed).clamp(enter, walk.max_fraction);
        let (from, to) = (walk.at(minor, enter), walk.at(minor, leave));
        let low = ((from.min(to) - self.reach[minor]) * self.inverse_size).floor() as i32;
        let high = ((from.max(to) + self.reach[minor]) * self.inverse_size).floor() as i32;
        Some([low.max(self.rows[0]), high.min(self.rows[1])])
    }

    /// Returns the cell of a row in a column: see [`Columns::rows_at`].
    #[inline(always)]
    fn cell(&self, number: i64, row: i32, walk: &Walk) -> GridCell {
        let is_forward = walk.delta[self.major] >= 0.0;
        let along = if is_forward { self.first + number as i32 } else { self.last - number as i32 };
        let (x, y) = if self.major == 0 { (along, row) } else { (row, along) };
        GridCell { level: self.level, x, y }
    }

    /// Number of columns.
    fn count(&self) -> i64 {
        i64::from(self.last) - i64::from(self.first) + 1
    }
}

impl HashGrid {
    /// Calls `visit` with the index of each entry whose AABB the AABB of a segment may touch on its path, nearly in the order along
    /// the segment on each level. An index may come twice. `visit` returns the fraction of the segment beyond which entries are
    /// of no interest, 0..=1, such as that of the first hit so far.
    pub fn for_each_along(&self, segment: &GridSegment, mut visit: impl FnMut(ProxyIndex) -> f64) {
        let mut walk = Walk::new(segment);
        let mut used = self.used_levels;
        while used != 0 {
            let level = used.trailing_zeros() as u8;
            used &= used - 1;
            if !walk.may_touch(&self.levels[usize::from(level)].bounds) {
                continue;
            }
            match self.columns(level, &walk) {
                Some(columns) => self.walk_columns(&columns, &mut walk, &mut visit),
                None => self.walk_level(level, &mut walk, &mut visit),
            }
        }
    }

    /// Returns the columns of a level that a segment visits; `None` if the walk would visit more cells than there are entries, or
    /// coordinates are beyond the cells of the level.
    fn columns(&self, level: u8, walk: &Walk) -> Option<Columns> {
        let GridLevel { bounds, max_half_extents, .. } = &self.levels[usize::from(level)];
        let inverse_size = f64::from(inverse_cell_size(level));
        // A centre is rounded by half a unit in the last place of it, and so is a half extent.
        let half = |axis: usize| f64::from(max_half_extents[axis]) * (1.0 + 4.0 * f64::from(f32::EPSILON));
        let reach = [0, 1].map(|axis| half(axis) + walk.half_extents[axis]);
        let major = usize::from(walk.delta[1].abs() > walk.delta[0].abs());
        let cell = |axis: usize| {
            // The bounds are of the AABBs; the centres, which choose the cells, are inside.
            let (low, high) = (f64::from(bounds[axis]), -f64::from(bounds[axis + 2]));
            let (from, to) = (walk.start[axis], walk.at(axis, walk.max_fraction));
            let low = low.max(from.min(to) - reach[axis]) * inverse_size;
            let high = high.min(from.max(to) + reach[axis]) * inverse_size;
            let most = f64::from(GRID_MAX_CELL_INDEX);
            (low > -most && high < most).then_some([low.floor() as i32, high.floor() as i32])
        };
        let ([first, last], rows) = (cell(major)?, cell(1 - major)?);
        let is_last = i32::from(level) == GRID_LEVELS - 1;
        let count = |[low, high]: [i32; 2]| (f64::from(high) - f64::from(low) + 1.0).max(0.0);
        // A column reaches the rows by which the segment rises across it and its reach, and those of the reach to both sides.
        let slope =
            if walk.delta[major] == 0.0 { 0.0 } else { (walk.delta[1 - major] / walk.delta[major]).abs() };
        let [reach_along, reach_across] = [major, 1 - major].map(|axis| 2.0 * reach[axis] * inverse_size);
        let rows_of_column = (slope * (1.0 + reach_along) + reach_across + 2.0).min(count(rows));
        let max_cells = count([first, last]) * rows_of_column;
        let columns = Columns { level, inverse_size, major, reach, first, last, rows };
        (!is_last && max_cells <= self.entries.len() as f64 + 16.0).then_some(columns)
    }

    /// Visits the entries in columns of cells, in the order along the segment.
    fn walk_columns(&self, columns: &Columns, walk: &mut Walk, visit: &mut impl FnMut(ProxyIndex) -> f64) {
        let fractions = columns.fractions(walk);
        for number in 0..columns.count() {
            let Some([low, high]) = columns.rows_at(number, &fractions, walk) else { return };
            for row in low..=high {
                self.walk_cell(columns.cell(number, row, walk), walk, visit);
            }
        }
    }

    /// Visits the entries in the bucket of a cell.
    #[inline(always)]
    fn walk_cell(&self, cell: GridCell, walk: &mut Walk, visit: &mut impl FnMut(ProxyIndex) -> f64) {
        let mut at = self.bucket_heads[self.bucket(cell)];
        while at != NO_ENTRY {
            let entry = &self.entries[at];
            if walk.may_touch(&entry.aabb) {
                walk.shorten(visit(at));
            }
            at = entry.next;
        }
    }

    /// Visits all entries of a level.
    #[cold]
    fn walk_level(&self, level: u8, walk: &mut Walk, visit: &mut impl FnMut(ProxyIndex) -> f64) {
        for ((at, entry), link) in self.entries.enumerated().zip(self.links.iter()) {
            if link.is_some_and(|link| link.cell.level == level) && walk.may_touch(&entry.aabb) {
                walk.shorten(visit(at));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{GridSegment, HashGrid, ProxyIndex, Walk};

    /// Returns a grid of `count` squares with a side of 1 length unit at random places of a square world.
    fn grid_of_squares(count: u32, world: f32, next: &mut impl FnMut() -> f32) -> HashGrid {
        let mut grid = HashGrid::default();
        grid.reset(count as usize);
        for index in 0..count {
            let [x, y] = [next(), next()].map(|place| world * place);
            grid.insert_or_move(ProxyIndex(index), &[x, y, x + 1.0, y + 1.0], false);
        }
        grid
    }

    /// A walk visits at most 16 cells more than there are entries, whatever the segment and its AABB.
    #[test]
    fn walked_cells_are_at_most_as_many_as_entries() {
        let mut state = 7_u32;
        let mut next = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 8) as f32 / 16_777_216.0
        };
        let mut walks = 0;
        for trial in 0..4000 {
            let world = [10.0, 100.0, 1e4, 1e6][trial % 4];
            let grid = grid_of_squares(40, world, &mut next);
            let mut place = || (next() * 1.4 - 0.2) * world;
            let (start, mut end) = ([place(), place()], [place(), place()]);
            if trial % 5 == 0 {
                end[trial % 2] = start[trial % 2];
            }
            let half_extents = [0.0, 0.3, 0.01 * world, world][trial / 4 % 4];
            let segment = GridSegment {
                start,
                end,
                half_extents: [half_extents, next() * half_extents],
                max_fraction: 1.0,
            };
            let walk = Walk::new(&segment);
            let level = grid.used_levels.trailing_zeros() as u8;
            let Some(columns) = grid.columns(level, &walk) else { continue };
            let fractions = columns.fractions(&walk);
            let cells: i64 = (0..columns.count())
                .map_while(|number| columns.rows_at(number, &fractions, &walk))
                .map(|[low, high]| i64::from(high - low + 1).max(0))
                .sum();
            assert!(cells <= 40 + 16, "{cells} cells in trial {trial}");
            walks += 1;
        }
        assert!(walks > 400, "only {walks} segments walked cells");
    }
}
