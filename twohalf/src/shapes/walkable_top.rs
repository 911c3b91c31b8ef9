//! Walkable tops of prisms.

use farseer_core::GeomId;
use farseer_core::depth::VerticalShape;
use farseer_core::math::Vector2;

/// An edge of a prism whose normal points up, or the top of an upright shape.
#[derive(Debug, Clone, Copy)]
pub(crate) struct WalkableTop {
    pub(crate) geom: GeomId,
    /// Least Z of the top, px.
    pub(crate) front: f32,
    /// Greatest Z of the top, px.
    pub(crate) back: f32,
    /// Ends of the edge, y down, from right to left.
    pub(crate) edge: [Vector2; 2],
    /// The upright shape and its place (X, Z in px); `None` for the edge of a prism.
    pub(crate) upright: Option<(VerticalShape, [f32; 2])>,
}
