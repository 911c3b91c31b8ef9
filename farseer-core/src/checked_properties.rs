//! Getters and setters of numbers; the setters refuse values that are not finite.

/// A getter and a checked setter for each field.
macro_rules! checked_properties {
    ($($(#[$doc:meta])* $field:ident, $setter:ident;)*) => {$(
        $(#[$doc])*
        #[inline]
        pub fn $field(&self) -> f32 {
            self.$field
        }

        #[doc = concat!("Sets [`", stringify!($field), "`](Self::", stringify!($field), ").")]
        ///
        /// # Errors
        /// A value that is not finite.
        pub fn $setter(&mut self, value: f32) -> $crate::error::Result<()> {
            self.$field = $crate::math::finite::finite(stringify!($field), value)?;
            Ok(())
        }
    )*};
}
pub(crate) use checked_properties;
