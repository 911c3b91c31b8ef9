//! The functions of the module, by what they are about.

pub mod body;
#[cfg(feature = "depth")]
pub mod depth;
pub mod geom;
pub mod joint;
pub mod query;
pub mod simulator;
pub mod spring;
