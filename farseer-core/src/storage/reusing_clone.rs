//! Clones into what is there already.

/// [`Clone`] field by field, `clone_from` too: what is overwritten keeps the room that its lists have. The derived one throws
/// it away, and asks for as much again.
macro_rules! reusing_clone {
    ($type:ident { $($field:ident),* $(,)? }) => {
        $crate::storage::reusing_clone::reusing_clone! { [] $type { $($field),* } }
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
pub(crate) use reusing_clone;
