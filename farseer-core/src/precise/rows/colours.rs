//! The rows of one kind, in colours.

use super::lane::Lane;
use super::row::Block;
use crate::storage::reusing_clone::reusing_clone;

/// Number of colours; the last is for what finds no other.
pub(in crate::precise) const COLOURS: usize = 32;
pub(super) const LAST: u32 = COLOURS as u32 - 1;

/// The first of these colours, by bits, or the last of all.
pub(super) fn first_of(colours: u32) -> u32 {
    colours.trailing_zeros().min(LAST)
}

/// The colours of a set, by bits, in order.
#[inline(always)]
fn colours_of(mut set: u32) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let colour = set.trailing_zeros();
        set &= set.wrapping_sub(1);
        (colour < u32::BITS).then_some(colour as usize)
    })
}

/// The rows of one kind.
#[derive(Debug)]
pub(in crate::precise) struct Colours<R> {
    /// Which colours have rows, by bits.
    pub(in crate::precise) used: u32,
    pub(in crate::precise) blocks: [Vec<R>; COLOURS],
    pub(super) counts: [usize; COLOURS],
}

reusing_clone! { [R: Clone] Colours<R> { used, blocks, counts } }

impl<R> Default for Colours<R> {
    fn default() -> Self {
        Colours { used: 0, blocks: std::array::from_fn(|_| Vec::new()), counts: [0; COLOURS] }
    }
}

impl<R: Block> Colours<R> {
    pub(super) fn clear(&mut self) {
        self.used = 0;
        self.counts = [0; COLOURS];
        self.blocks.iter_mut().for_each(Vec::clear);
    }

    /// The first of these colours in whose last block there is room, else the first.
    pub(super) fn choose(&self, free: u32) -> u32 {
        let has_room =
            |&colour: &u32| free >> colour & 1 == 1 && !self.counts[colour as usize].is_multiple_of(4);
        (0..LAST).find(has_room).unwrap_or(first_of(free))
    }

    pub(super) fn push(&mut self, colour: u32, lane: &Lane) -> u32 {
        let blocks = &mut self.blocks[colour as usize];
        let count = &mut self.counts[colour as usize];
        let slot = if colour == LAST { blocks.len() * 4 } else { *count };
        if slot % 4 == 0 {
            blocks.push(R::default());
        }
        blocks[slot / 4].set_lane(slot % 4, lane);
        *count += 1;
        self.used |= 1 << colour;
        slot as u32
    }

    /// Takes a row out, and tells the pairs whose rows have another slot now.
    pub(super) fn remove(&mut self, colour: u32, slot: u32, mut moved: impl FnMut(u32, u32)) {
        let slot = slot as usize;
        if colour == LAST {
            self.remove_of_last(slot / 4, moved);
        } else if let Some(pair) = self.swap_out(colour, slot) {
            moved(pair, slot as u32);
        }
        self.counts[colour as usize] -= 1;
        if self.counts[colour as usize] == 0 {
            self.used &= !(1 << colour);
        }
    }

    /// Of the last colour: the others keep their order.
    fn remove_of_last(&mut self, block: usize, mut moved: impl FnMut(u32, u32)) {
        let blocks = &mut self.blocks[LAST as usize];
        blocks.remove(block);
        for (at, row) in blocks.iter_mut().enumerate().skip(block) {
            moved(row.pairs()[0], at as u32 * 4);
        }
    }

    /// The last row of a colour takes the place of another one. Answers its pair.
    fn swap_out(&mut self, colour: u32, slot: usize) -> Option<u32> {
        let blocks = &mut self.blocks[colour as usize];
        let last = self.counts[colour as usize] - 1;
        let moved = (slot != last).then(|| blocks[last / 4].lane(last % 4));
        if let Some(lane) = &moved {
            blocks[slot / 4].set_lane(slot % 4, lane);
        }
        if last.is_multiple_of(4) {
            blocks.pop();
        } else {
            blocks[last / 4].set_lane(last % 4, &Lane::default());
        }
        moved.map(|lane| lane.pair)
    }

    /// The blocks of the colours that are used, in order.
    #[inline(always)]
    pub(in crate::precise) fn for_each(&mut self, mut act: impl FnMut(&mut R)) {
        colours_of(self.used).for_each(|colour| self.blocks[colour].iter_mut().for_each(&mut act));
    }

    pub(super) fn count(&self) -> usize {
        colours_of(self.used).map(|colour| self.counts[colour]).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::{Colours, Lane};
    use crate::precise::rows::Row;

    #[test]
    fn a_new_row_fills_a_block_before_it_begins_another() {
        let mut colours = Colours::<Row<1>>::default();
        for colour in [0, 0, 0, 0, 1] {
            colours.push(colour, &Lane::default());
        }
        assert_eq!(colours.choose(!0), 1);
        assert_eq!(colours.choose(!2), 0);
    }
}
