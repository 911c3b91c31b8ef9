//! Four numbers side by side.

use wide::f32x4;

/// For each lane one of two numbers, its bits as they are; the mask is what a comparison answers. That of `wide` is a
/// call where nothing is optimised over the bounds of crates.
#[inline(always)]
pub(crate) fn select(mask: f32x4, if_true: f32x4, if_false: f32x4) -> f32x4 {
    if_false ^ ((if_true ^ if_false) & mask)
}
