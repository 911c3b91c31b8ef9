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

/// For the `impl` of a joint with a range: getters and setters of its two ends. With the precise set they refuse a range that
/// ends before it begins; the original takes it.
macro_rules! range_properties {
    (
        $(#[$lower_doc:meta])* $lower:ident, $set_lower:ident;
        $(#[$upper_doc:meta])* $upper:ident, $set_upper:ident;
        $set_both:ident
    ) => {
        $(#[$lower_doc])*
        #[inline]
        pub fn $lower(&self) -> f32 {
            self.$lower
        }

        $(#[$upper_doc])*
        #[inline]
        pub fn $upper(&self) -> f32 {
            self.$upper
        }

        #[doc = concat!("Sets [`", stringify!($lower), "`](Self::", stringify!($lower), ").")]
        ///
        /// # Errors
        #[doc = concat!("A value that is not finite; with the precise set one above [`", stringify!($upper), "`](Self::", stringify!($upper), ").")]
        #[doc = concat!("The range stays then; [`", stringify!($set_both), "`](Self::", stringify!($set_both), ") sets both ends at once.")]
        pub fn $set_lower(&mut self, value: f32) -> crate::error::Result<()> {
            finite(stringify!($lower), value)?;
            if self.refuses_reversed && value > self.$upper {
                let expected = concat!("at most ", stringify!($upper));
                return Err(crate::Error::invalid(stringify!($lower), value, expected));
            }
            self.$lower = value;
            Ok(())
        }

        #[doc = concat!("Sets [`", stringify!($upper), "`](Self::", stringify!($upper), ").")]
        ///
        /// # Errors
        #[doc = concat!("A value that is not finite; with the precise set one below [`", stringify!($lower), "`](Self::", stringify!($lower), ").")]
        #[doc = concat!("The range stays then; [`", stringify!($set_both), "`](Self::", stringify!($set_both), ") sets both ends at once.")]
        pub fn $set_upper(&mut self, value: f32) -> crate::error::Result<()> {
            finite(stringify!($upper), value)?;
            if self.refuses_reversed && value < self.$lower {
                let expected = concat!("at least ", stringify!($lower));
                return Err(crate::Error::invalid(stringify!($upper), value, expected));
            }
            self.$upper = value;
            Ok(())
        }

        /// Sets both ends of the range.
        ///
        /// # Errors
        /// A value that is not finite; with the precise set a range that ends before it begins. The range stays then.
        pub fn $set_both(&mut self, $lower: f32, $upper: f32) -> crate::error::Result<()> {
            finite(stringify!($lower), $lower)?;
            finite(stringify!($upper), $upper)?;
            if self.refuses_reversed && $lower > $upper {
                let expected = concat!("at most ", stringify!($upper));
                return Err(crate::Error::invalid(stringify!($lower), $lower, expected));
            }
            (self.$lower, self.$upper) = ($lower, $upper);
            Ok(())
        }

        /// Sets whether the setters refuse a range that ends before it begins.
        pub(crate) fn set_refuses_reversed(&mut self, refuses: bool) {
            self.refuses_reversed = refuses;
        }
    };
}
pub(super) use range_properties;
