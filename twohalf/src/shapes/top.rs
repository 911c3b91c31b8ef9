//! What of a prism can be stood on.

use farseer_core::math::Vector2;
use farseer_core::{GeomId, SpaceUpright};

/// An edge of a prism that looks up, or the top of something upright.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Top {
    pub(crate) geom: GeomId,
    pub(crate) front: f32,
    pub(crate) back: f32,
    /// Y down, from right to left.
    pub(crate) edge: [Vector2; 2],
    /// What of that it is if it is upright, and its place on the floor.
    pub(crate) upright: Option<(SpaceUpright, [f32; 2])>,
}
