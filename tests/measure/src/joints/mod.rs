//! Scenes of joints beside other engines: how exactly joints hold, whether scenes rest, and the time of an update.
//!
//! An [`assembly`] describes bodies, joints and springs for any 2D engine. [`family`] lists the scenes with fixed
//! dimensions. [`run`] plays a scene in several [`engines`] by turns, [`gauge`] measures errors, [`judge`] says where ours
//! is behind, and [`table`] writes the figures. [`random`] makes as many other scenes as one likes, and [`counts`] says how
//! many of them fail.

pub mod assembly;
pub mod build;
pub mod counts;
pub mod engines;
pub mod family;
pub mod gauge;
pub mod judge;
pub mod random;
pub mod run;
pub mod table;
