//! Comparison of joint scenes with other engines: gaps of joints, whether scenes come to rest, and the time of an update.
//!
//! An [`assembly`] describes bodies, joints and springs for any 2D engine. [`family`] lists the scenes with fixed
//! dimensions. [`run`] runs a scene in several [`engines`] by turns, [`gauge`] measures errors, and [`judge`] finds errors
//! that are greater than those of other engines. [`table`] writes the figures. [`random`] creates random scenes, and
//! [`counts`] counts the failures in these.

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
