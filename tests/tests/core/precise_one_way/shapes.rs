//! One-way geoms of all shapes.

use super::*;

#[test]
fn placeholder() {}
