//! Tests that the measures of the chart's scenes are correct, and that the errors of our methods in these scenes do not change.

#[path = "../common/mod.rs"]
mod common;

mod advise;
mod depth;
mod farseer;
mod measures;
mod overlaps;
mod rest;
mod rolling;
