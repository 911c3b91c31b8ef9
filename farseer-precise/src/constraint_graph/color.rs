//! Graph colours, the masks that are sets of them, and slots in a colour.

use crate::index::{DenseIndex, index_type};

/// Number of graph colours, the overflow colour included. A set of colours is a mask of type `u32`.
pub const COLOR_COUNT: usize = 32;
/// The overflow colour: constraints for which no other colour is free (Box2D 3: `B2_OVERFLOW_INDEX`).
pub(super) const OVERFLOW_COLOR: Color = Color(COLOR_COUNT as u32 - 1);

index_type! {
    /// Index of a graph colour.
    pub struct Color;
}

impl Color {
    /// Returns whether the mask `set` contains the colour.
    #[inline(always)]
    pub(super) fn is_in(self, set: u32) -> bool {
        set >> self.0 & 1 == 1
    }
}

index_type! {
    /// Index of a constraint in its colour: 4 times the block plus the lane. In a list of parked constraints: index of the
    /// entry.
    pub struct SlotIndex;
}

impl SlotIndex {
    /// Returns the block and the lane of a constraint in a colour.
    #[inline(always)]
    pub(super) fn block_and_lane(self) -> (usize, usize) {
        (self.position() / 4, self.position() % 4)
    }
}

/// Returns the lowest colour of the mask `colors`; the overflow colour if the mask is empty.
pub(super) fn lowest_color(colors: u32) -> Color {
    Color(colors.trailing_zeros()).min(OVERFLOW_COLOR)
}

/// Returns the indices of the colours of the mask `set` in ascending order.
#[inline(always)]
pub(super) fn iter_colors(mut set: u32) -> impl Iterator<Item = Color> {
    std::iter::from_fn(move || {
        let colour = set.trailing_zeros();
        set &= set.wrapping_sub(1);
        (colour < u32::BITS).then_some(Color(colour))
    })
}
