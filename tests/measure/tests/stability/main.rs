//! Tests the limits of our methods, and the judges of the stability map.

#[path = "../common/mod.rs"]
mod common;

#[macro_use]
mod written;

mod arena;
mod arena_joints;
mod arena_random;
mod depth;
mod facts;
mod joints;
mod judges;
mod plane;
mod sleep;
