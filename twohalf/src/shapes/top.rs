//! What of a prism can be stood on.

use farseer_core::GeomId;
use farseer_core::math::Vector2;

/// An edge of a prism that looks up.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Top {
    pub(crate) geom: GeomId,
    pub(crate) front: f32,
    pub(crate) back: f32,
    /// Y down, from right to left.
    pub(crate) edge: [Vector2; 2],
}
