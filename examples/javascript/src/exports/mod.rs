//! The functions of the module, by subject.

pub mod body;
#[cfg(feature = "depth")]
pub mod depth;
pub mod geom;
pub mod joint;
pub mod query;
pub mod simulator;
pub mod spring;
