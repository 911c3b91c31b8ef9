//! Sorting by integer keys, cloning into existing lists, and records of snapshots.

pub mod order;
pub mod reusing_clone;
pub mod words;
