//! Sorting by integer keys, and cloning into existing lists.

pub mod order;
pub mod reusing_clone;
