//! Numbers of one contact, or of four in SIMD lanes, behind one trait.

use std::ops::{Add, Div, Mul, Neg, Sub};

use wide::f32x4;

use crate::math::lanes::select;

/// Number of contacts that are solved in parallel.
pub(super) const LANES: usize = 4;

/// One number per lane. Every operation rounds each lane as the same operation on a single f32 does.
pub(super) trait Lanes:
    Copy
    + Default
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    fn splat(value: f32) -> Self;
    /// The greater of the two, `other` if they are equal or either is NaN.
    fn or_greater(self, other: Self) -> Self;
    /// The smaller of the two, `other` if they are equal or either is NaN.
    fn or_smaller(self, other: Self) -> Self;
}

impl Lanes for f32 {
    #[inline(always)]
    fn splat(value: f32) -> Self {
        value
    }
    #[inline(always)]
    fn or_greater(self, other: Self) -> Self {
        if self > other { self } else { other }
    }
    #[inline(always)]
    fn or_smaller(self, other: Self) -> Self {
        if self < other { self } else { other }
    }
}

impl Lanes for f32x4 {
    #[inline(always)]
    fn splat(value: f32) -> Self {
        f32x4::splat(value)
    }
    #[inline(always)]
    fn or_greater(self, other: Self) -> Self {
        select(self.simd_gt(other), self, other)
    }
    #[inline(always)]
    fn or_smaller(self, other: Self) -> Self {
        select(self.simd_lt(other), self, other)
    }
}
