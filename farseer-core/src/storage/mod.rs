//! Generational ids, and collections of the objects that they name.

pub(crate) mod arena;
pub(crate) mod bits;
pub(crate) mod collection;
pub(crate) mod ids;
pub(crate) mod rejected_arguments;
pub(crate) mod stamped_set;

#[doc(inline)]
pub(crate) use farseer_precise::storage::order;
