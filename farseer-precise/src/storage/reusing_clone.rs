//! Cloning into existing values.

/// Implements [`Clone`] field by field, with a `clone_from` that keeps the capacity of the overwritten lists. The
/// derived `clone_from` frees and allocates them anew.
#[doc(hidden)]
#[macro_export]
macro_rules! reusing_clone {
    ($type:ident { $($field:ident),* $(,)? }) => {
        $crate::reusing_clone! { [] $type { $($field),* } }
    };
    ([$($generics:tt)*] $type:ty { $($field:ident),* $(,)? }) => {
        impl<$($generics)*> Clone for $type {
            fn clone(&self) -> Self {
                Self { $($field: Clone::clone(&self.$field)),* }
            }

            fn clone_from(&mut self, source: &Self) {
                $(Clone::clone_from(&mut self.$field, &source.$field);)*
            }
        }
    };
}
