//! Inequality constraint: an accumulated impulse that keeps a value in a range.

use serde::{Deserialize, Serialize};

use crate::math::scalar;

/// The violated limit and its accumulated impulse.
#[derive(Debug, Clone, Copy, Default, Serialize, Deserialize)]
pub(crate) struct Limit {
    pub(crate) accumulated: f32,
    above: bool,
    below: bool,
}

impl Limit {
    /// Determines the violated limit and returns the error: 0 within the slop, else measured from the limit itself. The
    /// accumulated impulse is kept only while the same limit is violated.
    pub(crate) fn update(&mut self, value: f32, lower: f32, upper: f32, slop: f32) -> f32 {
        if value > upper {
            if self.below {
                self.accumulated = 0.0;
            }
            (self.above, self.below) = (true, false);
            if value < upper + slop { 0.0 } else { value - upper }
        } else if value < lower {
            if self.above {
                self.accumulated = 0.0;
            }
            (self.above, self.below) = (false, true);
            if value > lower - slop { 0.0 } else { value - lower }
        } else {
            *self = Limit::default();
            0.0
        }
    }

    #[inline]
    pub(crate) fn is_violated(&self) -> bool {
        self.above || self.below
    }

    /// Accumulates an impulse, clamped so that the sum acts toward the range, and returns the change of the sum.
    #[inline]
    pub(crate) fn accumulate(&mut self, impulse: f32) -> f32 {
        let old = self.accumulated;
        let sum = old + impulse;
        self.accumulated = if self.above { scalar::min(sum, 0.0) } else { scalar::max(sum, 0.0) };
        self.accumulated - old
    }
}
