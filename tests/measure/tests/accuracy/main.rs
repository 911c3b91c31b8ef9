//! What the scenes of the charts measure, and how far off our methods are in them.

#[path = "../common/mod.rs"]
mod common;

mod advise;
mod depth;
mod farseer;
mod measures;
mod overlaps;
mod rest;
mod rolling;
