//! Broad phase: a hashed grid with levels by size. An AABB is entered at its centre, in the level whose cells are more than
//! twice as wide as the AABB; so it reaches at most a quarter of a cell beyond its cell, and a level of large cells holds few
//! AABBs. Each level keeps the bounds of its AABBs and the farthest reach from their centres: flat floors and few large shapes
//! cost little to shapes of other sizes. The AABBs of fast bodies are long, and are in a level of their own as long as the
//! bodies are fast.
//!
//! Hierarchical hash grids: C. Ericson, "Real-Time Collision Detection" (2005), section 7.2. The multipliers of the hash are
//! primes of xxHash32 (Y. Collet).

use crate::precise::parameters::broad_phase::{GRID_FARTHEST_CELL, GRID_LEVELS, GRID_LOWEST_LEVEL};
use wide::f32x4;

use crate::math::lanes::select;
use crate::storage::reusing_clone::reusing_clone;

/// Low and high corner.
pub(super) type Box2 = [f32; 4];

const NONE: u32 = u32::MAX;

#[inline(always)]
pub(super) fn overlap(a: &Box2, b: &Box2) -> bool {
    a[0] <= b[2] && b[0] <= a[2] && a[1] <= b[3] && b[1] <= a[3]
}

/// A box as it is entered: its low corner, and its high corner with the signs changed. So one comparison says whether it
/// overlaps another: in what order the sides of boxes lie nobody foresees, and none of them is worth a branch.
type Sides = [f32; 4];

fn sides([low_x, low_y, high_x, high_y]: &Box2) -> Sides {
    [*low_x, *low_y, -high_x, -high_y]
}

/// What the sides of another box must not exceed, if that is to overlap this one.
fn limits([low_x, low_y, high_x, high_y]: &Box2) -> f32x4 {
    f32x4::new([*high_x, *high_y, -low_x, -low_y])
}

#[inline(always)]
fn is_within(sides: &Sides, limits: f32x4) -> bool {
    f32x4::new(*sides).simd_le(limits).all()
}

/// A cell of a level.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Cell {
    level: u8,
    x: i32,
    y: i32,
}

/// All that a search looks at of a box, side by side: the box, and the next one in its bucket.
#[derive(Debug, Clone, Copy)]
struct Entry {
    sides: Sides,
    next: u32,
}

impl Default for Entry {
    fn default() -> Self {
        Entry { sides: [0.0; 4], next: NONE }
    }
}

/// Where a box is entered, and which is the one before it in its bucket.
#[derive(Debug, Clone, Copy)]
struct Place {
    cell: Cell,
    previous: u32,
}

/// What is known of the boxes of a level.
#[derive(Debug, Clone, Copy, Default)]
struct Level {
    count: u32,
    /// What they lie in, and how far they reach from their centres at most: these grow until the level is empty.
    sides: Sides,
    reach: [f32; 2],
}

/// Changes the signs of what goes to a low corner.
const OUTWARD: f32x4 = f32x4::new([-0.0, -0.0, 0.0, 0.0]);

/// Boxes by number.
#[derive(Debug, Default)]
pub(super) struct Grid {
    entries: Vec<Entry>,
    places: Vec<Option<Place>>,
    /// First entry of each bucket.
    heads: Vec<u32>,
    levels: Vec<Level>,
    /// Levels that have boxes, by bits.
    used: u64,
}

reusing_clone! { Grid { entries, places, heads, levels, used } }

/// Cells of a level are 2^(level + GRID_LOWEST_LEVEL) wide.
fn level_of(bounds: &Box2) -> u8 {
    let width = (bounds[2] - bounds[0]).max(bounds[3] - bounds[1]);
    // The exponent of twice the width, rounded up: cells are more than twice as wide as the box.
    let exponent = ((2.0 * width).to_bits() >> 23) as i32 - 127 + 1;
    (exponent - GRID_LOWEST_LEVEL).clamp(0, GRID_LEVELS - 1) as u8
}

/// The reciprocal of the size of a level's cells, exactly.
fn inverse_size(level: u8) -> f32 {
    f32::from_bits(((127 - i32::from(level) - GRID_LOWEST_LEVEL) as u32) << 23)
}

/// Numbers of the cells of four coordinates.
#[inline(always)]
fn numbers(coordinates: f32x4, inverse_size: f32) -> [i32; 4] {
    let (scaled, last) = (coordinates * f32x4::splat(inverse_size), f32x4::splat(GRID_FARTHEST_CELL));
    let scaled = select(scaled.simd_lt(last), scaled, last);
    let scaled = select(scaled.simd_gt(-last), scaled, -last);
    // The conversion goes toward zero.
    let whole = f32x4::from_i32x4(scaled.fast_trunc_int());
    (whole - (whole.simd_gt(scaled) & f32x4::ONE)).fast_trunc_int().to_array()
}

impl Level {
    /// There is this box in it.
    #[inline(always)]
    fn take(&mut self, bounds: &Box2) {
        if self.count == 0 {
            (self.sides, self.reach) = (sides(bounds), [0.0; 2]);
        }
        for (all, side) in self.sides.iter_mut().zip(sides(bounds)) {
            *all = if side < *all { side } else { *all };
        }
        for (axis, reach) in self.reach.iter_mut().enumerate() {
            let half = 0.5 * bounds[axis + 2] - 0.5 * bounds[axis];
            *reach = if half > *reach { half } else { *reach };
        }
    }
}

impl Grid {
    /// Forgets all boxes, and expects so many.
    pub(super) fn reset(&mut self, boxes: usize) {
        self.entries.clear();
        self.entries.resize(boxes, Entry::default());
        self.places.clear();
        self.places.resize(boxes, None);
        self.heads.clear();
        self.heads.resize((2 * boxes).next_power_of_two().max(16), NONE);
        self.levels.clear();
        self.levels.resize(GRID_LEVELS as usize, Level::default());
        self.used = 0;
    }

    /// Whether so many boxes are not too many for the buckets.
    pub(super) fn has_room(&self, boxes: usize) -> bool {
        boxes <= self.heads.len()
    }

    /// Expects so many boxes, with those that it has.
    pub(super) fn grow(&mut self, boxes: usize) {
        self.entries.resize(boxes, Entry::default());
        self.places.resize(boxes, None);
    }

    #[inline(always)]
    fn bucket(&self, cell: Cell) -> usize {
        let mixed = (cell.x as u32)
            .wrapping_mul(0x9E37_79B1)
            .wrapping_add((cell.y as u32).wrapping_mul(0x85EB_CA77))
            .wrapping_add(u32::from(cell.level).wrapping_mul(0xC2B2_AE3D))
            .rotate_right(16)
            .wrapping_mul(0x9E37_79B1);
        (mixed >> 7) as usize & (self.heads.len() - 1)
    }

    /// Enters a box, or moves it.
    pub(super) fn set(&mut self, number_of_box: u32, bounds: &Box2) {
        let level = level_of(bounds);
        let middle = |axis: usize| 0.5 * bounds[axis] + 0.5 * bounds[axis + 2];
        let [x, y, ..] = numbers(f32x4::new([middle(0), middle(1), 0.0, 0.0]), inverse_size(level));
        let cell = Cell { level, x, y };
        self.entries[number_of_box as usize].sides = sides(bounds);
        self.levels[level as usize].take(bounds);
        if self.places[number_of_box as usize].is_some_and(|place| place.cell == cell) {
            return;
        }
        self.take_out(number_of_box);
        let bucket = self.bucket(cell);
        let next = std::mem::replace(&mut self.heads[bucket], number_of_box);
        self.entries[number_of_box as usize].next = next;
        self.places[number_of_box as usize] = Some(Place { cell, previous: NONE });
        self.set_previous(next, number_of_box);
        self.levels[level as usize].count += 1;
        self.used |= 1 << level;
    }

    fn set_previous(&mut self, number_of_box: u32, previous: u32) {
        if let Some(Some(place)) = self.places.get_mut(number_of_box as usize) {
            place.previous = previous;
        }
    }

    pub(super) fn take_out(&mut self, number_of_box: u32) {
        let Some(Place { cell, previous }) = self.places[number_of_box as usize].take() else { return };
        let next = self.entries[number_of_box as usize].next;
        if previous == NONE {
            let bucket = self.bucket(cell);
            self.heads[bucket] = next;
        } else {
            self.entries[previous as usize].next = next;
        }
        self.set_previous(next, previous);
        let level = &mut self.levels[cell.level as usize];
        level.count -= 1;
        if level.count == 0 {
            self.used &= !(1 << cell.level);
        }
    }

    /// Calls for every box that overlaps this one, itself included: in no order, and for some of them twice.
    #[inline(always)]
    pub(super) fn for_each_overlap(&self, bounds: &Box2, mut found: impl FnMut(u32)) {
        let (mut used, limits) = (self.used, limits(bounds));
        let corners = f32x4::new(*bounds);
        // Far away, where the last digit is wide, rounding counts as well.
        let rounding = corners.abs() * f32x4::splat(4.0 * f32::EPSILON);
        while used != 0 {
            let level = used.trailing_zeros() as u8;
            used &= used - 1;
            let Level { sides, reach, .. } = &self.levels[level as usize];
            if !is_within(sides, limits) {
                continue;
            }
            let around = f32x4::new([reach[0], reach[1], reach[0], reach[1]]) + rounding;
            let [left, top, right, bottom] = numbers(corners + (around ^ OUTWARD), inverse_size(level));
            let span = |low: i32, high: i32| i64::from(high) - i64::from(low) + 1;
            let (width, height) = (span(left, right), span(top, bottom));
            // Queries may come with boxes that are the wrong way round, and some large box may overlap them.
            let is_reversed = width <= 0 || height <= 0;
            let is_last = i32::from(level) == GRID_LEVELS - 1;
            if is_last || is_reversed || width.saturating_mul(height) > self.entries.len() as i64 + 16 {
                self.for_each_of_level(level, limits, &mut found);
                continue;
            }
            for y in top..=bottom {
                for x in left..=right {
                    self.for_each_in(Cell { level, x, y }, limits, &mut found);
                }
            }
        }
    }

    /// What other cells have entered in the same bucket is looked at as well: that costs less than to tell them apart.
    #[inline(always)]
    fn for_each_in(&self, cell: Cell, limits: f32x4, found: &mut impl FnMut(u32)) {
        let mut at = self.heads[self.bucket(cell)];
        while at != NONE {
            let entry = &self.entries[at as usize];
            if is_within(&entry.sides, limits) {
                found(at);
            }
            at = entry.next;
        }
    }

    /// For a box that covers more cells than there are boxes.
    #[cold]
    fn for_each_of_level(&self, level: u8, limits: f32x4, found: &mut impl FnMut(u32)) {
        for (at, (entry, place)) in self.entries.iter().zip(&self.places).enumerate() {
            if place.is_some_and(|place| place.cell.level == level) && is_within(&entry.sides, limits) {
                found(at as u32);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Box2, Grid, inverse_size, level_of, overlap};

    /// Boxes from tiny to huge, near and far.
    fn boxes() -> Vec<Box2> {
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
        let mut all: Vec<Box2> = (0..300).map(|_| one()).collect();
        all.push([-1e30, -1.0, -1e29, 1.0]);
        all.push([-3e30, -2.0, 5e30, 0.0]);
        all
    }

    fn enter(grid: &mut Grid, boxes: &[Box2]) {
        boxes.iter().enumerate().for_each(|(i, bounds)| grid.set(i as u32, bounds));
    }

    fn check(grid: &Grid, boxes: &[Box2]) {
        for bounds in boxes {
            let mut found = Vec::new();
            grid.for_each_overlap(bounds, |other| found.push(other as usize));
            found.sort_unstable();
            found.dedup();
            let expected: Vec<usize> =
                (0..boxes.len()).filter(|&other| overlap(bounds, &boxes[other])).collect();
            assert_eq!(found, expected, "of {bounds:?}");
        }
    }

    #[test]
    fn every_overlapping_box_is_found_and_no_other() {
        let boxes = boxes();
        let mut grid = Grid::default();
        grid.reset(boxes.len());
        enter(&mut grid, &boxes);
        check(&grid, &boxes);
    }

    #[test]
    fn boxes_that_have_moved_are_found_where_they_are() {
        let mut boxes = boxes();
        let mut grid = Grid::default();
        grid.reset(boxes.len());
        for _ in 0..3 {
            enter(&mut grid, &boxes);
            boxes.rotate_right(7);
            boxes.iter_mut().take(150).for_each(|bounds| *bounds = bounds.map(|x| 0.9 * x + 40.0));
        }
        enter(&mut grid, &boxes);
        check(&grid, &boxes);
    }

    #[test]
    fn cells_are_more_than_twice_as_wide_as_their_boxes() {
        for width in [1e-6_f32, 0.3, 0.5, 1.0, 1.5, 31.0, 32.0, 1e6] {
            let size = 1.0 / inverse_size(level_of(&[0.0, 0.0, width, 0.5 * width]));
            assert!(size > 2.0 * width && size <= 8.0 * width, "{size} for {width}");
        }
    }
}
