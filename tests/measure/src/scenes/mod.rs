//! Scenes made by code, for charts, families, tests and benchmarks.

pub mod depth;
pub(crate) mod stage;
