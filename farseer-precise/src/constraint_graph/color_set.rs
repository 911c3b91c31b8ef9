//! One kind of contact constraint in graph colours: blocks of four SIMD lanes per colour, and the overflow colour.
//!
//! A colour has no gaps: the last constraint takes the place of a removed one. The overflow colour keeps its order instead,
//! since its constraints are solved one after the other.

use super::color::{COLOR_COUNT, Color, OVERFLOW_COLOR, SlotIndex, iter_colors, lowest_color};
use super::constraint_handle::ConstraintHandle;
use super::contact_constraint::ContactConstraint;
use super::contact_constraint_simd::SimdSlot;
use crate::index::{DenseIndex, PairIndex};
use crate::reusing_clone;

/// Number of blocks for which a colour keeps its memory in any case, a count: about 64 KiB.
const MAX_SPARE_BLOCKS: usize = 128;

/// Contact constraints of one kind in graph colours. `R`: a block of four SIMD lanes, one constraint per lane.
#[derive(Debug)]
pub struct ColorSet<R> {
    /// Mask of the colours that have constraints: bit i for colour i.
    pub(crate) used_colors: u32,
    /// Blocks of each colour; in the overflow colour a block has one constraint.
    pub(crate) blocks: [Vec<R>; COLOR_COUNT],
    /// Number of constraints of each colour.
    pub(super) constraint_counts: [usize; COLOR_COUNT],
}

reusing_clone! { [R: Clone] ColorSet<R> { used_colors, blocks, constraint_counts } }

impl<R> Default for ColorSet<R> {
    fn default() -> Self {
        ColorSet {
            used_colors: 0,
            blocks: std::array::from_fn(|_| Vec::new()),
            constraint_counts: [0; COLOR_COUNT],
        }
    }
}

impl<R: SimdSlot> ColorSet<R> {
    pub(super) fn clear(&mut self) {
        self.used_colors = 0;
        self.constraint_counts = [0; COLOR_COUNT];
        self.blocks.iter_mut().for_each(Vec::clear);
    }

    /// Returns the lowest colour of the mask `free` whose last block has an empty lane, else the lowest colour of the mask.
    pub(super) fn choose_color(&self, free: u32) -> Color {
        let has_room = |colour: &Color| colour.is_in(free) && !self.count_of(*colour).is_multiple_of(4);
        (0..OVERFLOW_COLOR.0).map(Color).find(has_room).unwrap_or(lowest_color(free))
    }

    /// Adds a constraint to a colour. Returns its slot.
    pub(super) fn add(&mut self, color: Color, constraint: &ContactConstraint) -> SlotIndex {
        let blocks = &mut self.blocks[color.position()];
        let count = &mut self.constraint_counts[color.position()];
        let slot = if color == OVERFLOW_COLOR { blocks.len() * 4 } else { *count };
        if slot % 4 == 0 {
            blocks.push(R::default());
        }
        blocks[slot / 4].insert(slot % 4, constraint);
        *count += 1;
        self.used_colors |= 1 << color.0;
        SlotIndex::new(slot)
    }

    /// Removes the constraint in `slot` of a colour. Calls `moved` with the pair index and new slot of each constraint that has
    /// moved to fill the gap.
    pub(super) fn remove(
        &mut self,
        color: Color,
        slot: SlotIndex,
        mut moved: impl FnMut(PairIndex, SlotIndex),
    ) {
        if color == OVERFLOW_COLOR {
            self.remove_overflow(slot.block_and_lane().0, moved);
        } else if let Some(pair) = self.swap_remove(color, slot) {
            moved(pair, slot);
        }
        let count = &mut self.constraint_counts[color.position()];
        *count -= 1;
        if *count == 0 {
            self.used_colors &= !(1 << color.0);
        }
    }

    /// Removes a block of the overflow colour. The other blocks keep their order; `moved` gets the pair index and new slot of
    /// each block behind the removed one.
    fn remove_overflow(&mut self, block: usize, mut moved: impl FnMut(PairIndex, SlotIndex)) {
        let blocks = &mut self.blocks[OVERFLOW_COLOR.position()];
        blocks.remove(block);
        for (at, row) in blocks.iter_mut().enumerate().skip(block) {
            moved(row.pair_indices()[0], SlotIndex::new(at * 4));
        }
    }

    /// Removes the constraint in `slot` of a colour and moves the last constraint of the colour there. Returns the pair index
    /// of the constraint that has moved; `None` if the removed one was the last.
    fn swap_remove(&mut self, color: Color, slot: SlotIndex) -> Option<PairIndex> {
        let last = self.count_of(color) - 1;
        let blocks = &mut self.blocks[color.position()];
        let moved = (slot.position() != last).then(|| blocks[last / 4].extract(last % 4));
        if let Some(row) = &moved {
            let (block, lane) = slot.block_and_lane();
            blocks[block].insert(lane, row);
        }
        if last.is_multiple_of(4) {
            blocks.pop();
        } else {
            blocks[last / 4].insert(last % 4, &ContactConstraint::default());
        }
        moved.map(|row| row.pair)
    }

    /// Calls `act` with each block of four constraints, by ascending colour.
    #[inline(always)]
    pub(crate) fn for_each(&mut self, mut act: impl FnMut(&mut R)) {
        // Plain loops, into which the compiler inlines `act`.
        for colour in iter_colors(self.used_colors) {
            for block in &mut self.blocks[colour.position()] {
                act(block);
            }
        }
    }

    /// Gives back the memory of colours that hold less than a quarter of the blocks for which they have memory.
    pub(super) fn release_memory(&mut self) {
        for blocks in &mut self.blocks {
            if blocks.capacity() > MAX_SPARE_BLOCKS.max(4 * blocks.len()) {
                blocks.shrink_to(2 * blocks.len());
            }
        }
    }

    /// Returns the number of constraints of a colour.
    #[inline(always)]
    pub(super) fn count_of(&self, color: Color) -> usize {
        self.constraint_counts[color.position()]
    }

    /// Returns the block of a constraint, and its lane there.
    #[inline(always)]
    pub(super) fn row(&self, handle: ConstraintHandle) -> (&R, usize) {
        let (block, lane) = handle.slot.block_and_lane();
        (&self.blocks[handle.color.position()][block], lane)
    }

    /// Returns the block of a constraint, to change, and its lane there.
    #[inline(always)]
    pub(super) fn row_mut(&mut self, handle: ConstraintHandle) -> (&mut R, usize) {
        let (block, lane) = handle.slot.block_and_lane();
        (&mut self.blocks[handle.color.position()][block], lane)
    }

    /// Returns the number of constraints of all colours.
    pub(super) fn constraint_count(&self) -> usize {
        iter_colors(self.used_colors).map(|colour| self.count_of(colour)).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::{Color, ColorSet, ContactConstraint};
    use crate::constraint_graph::ContactConstraintSimd;

    #[test]
    fn a_new_constraint_fills_a_block_before_a_new_block_begins() {
        let mut colours = ColorSet::<ContactConstraintSimd<1>>::default();
        for colour in [0, 0, 0, 0, 1].map(Color) {
            colours.add(colour, &ContactConstraint::default());
        }
        assert_eq!(colours.choose_color(!0), Color(1));
        assert_eq!(colours.choose_color(!2), Color(0));
    }
}
