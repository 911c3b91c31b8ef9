//! Which boxes may overlap: a hashed grid with levels by size. A box is entered at its centre, in the level whose cells are
//! more than twice as wide as the box; so it reaches at most a quarter of a cell beyond the cell it is in, and a level of
//! large cells holds few boxes. Fast things have long boxes, and are in a level of their own for as long as they are fast.

use crate::storage::reusing_clone::reusing_clone;

/// Low and high corner.
pub(super) type Box2 = [f32; 4];

const NONE: u32 = u32::MAX;
/// Levels that are told apart: cell sizes from 2^-32 to 2^31. In the last one boxes may be of any size: it is looked through
/// from end to end.
const LEVELS: i32 = 64;
const LOWEST: i32 = -32;

#[inline(always)]
pub(super) fn overlap(a: &Box2, b: &Box2) -> bool {
    a[0] <= b[2] && b[0] <= a[2] && a[1] <= b[3] && b[1] <= a[3]
}

/// A cell of a level.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Cell {
    level: u8,
    x: i32,
    y: i32,
}

/// What is entered at a place in the grid: all that a search looks at, side by side.
#[derive(Debug, Clone, Copy)]
struct Entry {
    bounds: Box2,
    next: u32,
    previous: u32,
    cell: Option<Cell>,
}

impl Default for Entry {
    fn default() -> Self {
        Entry { bounds: [0.0; 4], next: NONE, previous: NONE, cell: None }
    }
}

/// Boxes by number.
#[derive(Debug, Default)]
pub(super) struct Grid {
    entries: Vec<Entry>,
    /// First entry of each bucket.
    heads: Vec<u32>,
    /// Number of boxes in each level.
    counts: Vec<u32>,
    /// Levels that have boxes, by bits.
    used: u64,
}

reusing_clone! { Grid { entries, heads, counts, used } }

/// Cells of a level are 2^(level + LOWEST) wide.
fn level_of(bounds: &Box2) -> u8 {
    let width = (bounds[2] - bounds[0]).max(bounds[3] - bounds[1]);
    // The exponent of twice the width, rounded up: cells are more than twice as wide as the box.
    let exponent = ((2.0 * width).to_bits() >> 23) as i32 - 127 + 1;
    (exponent - LOWEST).clamp(0, LEVELS - 1) as u8
}

fn cell_size(level: u8) -> f32 {
    f32::from_bits(((i32::from(level) + LOWEST + 127) as u32) << 23)
}

/// Number of the cell of a coordinate; far away there is one last cell.
#[inline(always)]
fn number(coordinate: f32, inverse_size: f32) -> i32 {
    let scaled = coordinate * inverse_size;
    // The conversion goes toward zero, and ends where numbers end.
    let whole = scaled as i32;
    if (whole as f32) > scaled { whole.saturating_sub(1) } else { whole }
}

impl Grid {
    /// Forgets all boxes, and expects so many.
    pub(super) fn reset(&mut self, boxes: usize) {
        self.entries.clear();
        self.entries.resize(boxes, Entry::default());
        self.heads.clear();
        self.heads.resize((2 * boxes).next_power_of_two().max(16), NONE);
        self.counts.clear();
        self.counts.resize(LEVELS as usize, 0);
        self.used = 0;
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
        let inverse = 1.0 / cell_size(level);
        let middle = |axis: usize| 0.5 * bounds[axis] + 0.5 * bounds[axis + 2];
        let cell = Cell { level, x: number(middle(0), inverse), y: number(middle(1), inverse) };
        let entry = &mut self.entries[number_of_box as usize];
        entry.bounds = *bounds;
        if entry.cell == Some(cell) {
            return;
        }
        self.take_out(number_of_box);
        let bucket = self.bucket(cell);
        let next = std::mem::replace(&mut self.heads[bucket], number_of_box);
        self.entries[number_of_box as usize] =
            Entry { bounds: *bounds, next, previous: NONE, cell: Some(cell) };
        if next != NONE {
            self.entries[next as usize].previous = number_of_box;
        }
        self.counts[level as usize] += 1;
        self.used |= 1 << level;
    }

    fn take_out(&mut self, number_of_box: u32) {
        let Entry { cell: Some(cell), next, previous, .. } = self.entries[number_of_box as usize] else {
            return;
        };
        if previous == NONE {
            let bucket = self.bucket(cell);
            self.heads[bucket] = next;
        } else {
            self.entries[previous as usize].next = next;
        }
        if next != NONE {
            self.entries[next as usize].previous = previous;
        }
        let count = &mut self.counts[cell.level as usize];
        *count -= 1;
        if *count == 0 {
            self.used &= !(1 << cell.level);
        }
        self.entries[number_of_box as usize].cell = None;
    }

    /// Calls for every box that overlaps this one, itself included: in no order, and for some of them twice.
    #[inline(always)]
    pub(super) fn for_each_overlap(&self, bounds: &Box2, mut found: impl FnMut(u32)) {
        let mut used = self.used;
        while used != 0 {
            let level = used.trailing_zeros() as u8;
            used &= used - 1;
            let (size, inverse) = (cell_size(level), 1.0 / cell_size(level));
            // Far away, where the last digit is wide, rounding counts as well.
            let reach = |x: f32| 0.25 * size + 2.0 * f32::EPSILON * x.abs();
            let low = [bounds[0], bounds[1]].map(|x| number(x - reach(x), inverse));
            let high = [bounds[2], bounds[3]].map(|x| number(x + reach(x), inverse));
            let span = |axis: usize| i64::from(high[axis]) - i64::from(low[axis]) + 1;
            let (width, height) = (span(0), span(1));
            // Queries may come with boxes that are the wrong way round, and some large box may overlap them.
            let is_reversed = width <= 0 || height <= 0;
            let is_last = i32::from(level) == LEVELS - 1;
            if is_last || is_reversed || width.saturating_mul(height) > self.entries.len() as i64 + 16 {
                self.for_each_of_level(level, bounds, &mut found);
                continue;
            }
            for y in low[1]..=high[1] {
                for x in low[0]..=high[0] {
                    self.for_each_in(Cell { level, x, y }, bounds, &mut found);
                }
            }
        }
    }

    /// What other cells have entered in the same bucket is looked at as well: that costs less than to tell them apart.
    #[inline(always)]
    fn for_each_in(&self, cell: Cell, bounds: &Box2, found: &mut impl FnMut(u32)) {
        let mut at = self.heads[self.bucket(cell)];
        while at != NONE {
            let entry = &self.entries[at as usize];
            if overlap(&entry.bounds, bounds) {
                found(at);
            }
            at = entry.next;
        }
    }

    /// For a box that covers more cells than there are boxes.
    #[cold]
    fn for_each_of_level(&self, level: u8, bounds: &Box2, found: &mut impl FnMut(u32)) {
        for (at, entry) in self.entries.iter().enumerate() {
            if entry.cell.is_some_and(|cell| cell.level == level) && overlap(&entry.bounds, bounds) {
                found(at as u32);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Box2, Grid, cell_size, level_of, overlap};

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

    #[test]
    fn every_overlapping_box_is_found_and_no_other() {
        let boxes = boxes();
        let mut grid = Grid::default();
        grid.reset(boxes.len());
        boxes.iter().enumerate().for_each(|(i, bounds)| grid.set(i as u32, bounds));
        for bounds in &boxes {
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
    fn cells_are_more_than_twice_as_wide_as_their_boxes() {
        for width in [1e-6_f32, 0.3, 0.5, 1.0, 1.5, 31.0, 32.0, 1e6] {
            let size = cell_size(level_of(&[0.0, 0.0, width, 0.5 * width]));
            assert!(size > 2.0 * width && size <= 8.0 * width, "{size} for {width}");
        }
    }
}
