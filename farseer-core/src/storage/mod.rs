//! Ids that notice when they have gone stale, and lists of what they name.

pub(crate) mod arena;
pub(crate) mod bits;
pub(crate) mod collection;
pub(crate) mod ids;
pub mod order;
pub(crate) mod refusals;
pub(crate) mod reusing_clone;
pub(crate) mod stamped_set;
