//! A point of an outline.

use serde::{Deserialize, Serialize};

use crate::math::Vector2;

/// A point of an outline: the result of point-to-shape queries (behaviour chapters 05 and 06).
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Feature {
    /// Position on the outline, or the queried point itself for grid queries.
    pub position: Vector2,
    /// Outward unit normal there.
    pub normal: Vector2,
    /// Distance in length units, negative inside.
    pub distance: f32,
}
