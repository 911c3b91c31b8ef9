//! The functions of the module, by subject.

pub mod add;
pub mod body;
#[cfg(feature = "depth")]
pub mod depth;
pub mod geom;
pub mod joint;
pub mod mover;
pub mod query;
pub mod recording;
pub mod simulator;
pub mod spring;
