//! Corners of the footprint of a prism along y.

use crate::math::Vector2;

/// Maximum number of corners of a footprint.
pub const MAX_FOOTPRINT_CORNERS: usize = 8;

/// Corners of a convex polygon of three to eight corners in the plane of x and z, relative to the body, in length units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FootprintCorners {
    corners: [Vector2; MAX_FOOTPRINT_CORNERS],
    count: usize,
}

impl FootprintCorners {
    /// Returns the polygon of the first `count` corners, 3..=8. They are x and z in length units, counterclockwise as seen from
    /// above with z up, and finite.
    pub fn new(corners: [Vector2; MAX_FOOTPRINT_CORNERS], count: usize) -> Self {
        FootprintCorners { corners, count }
    }

    /// Returns the corners, x and z in length units, counterclockwise as seen from above with z up.
    pub fn corners(&self) -> &[Vector2] {
        &self.corners[..self.count]
    }

    /// Returns the corners with the smallest and the greatest x and z, in length units.
    pub fn bounds(&self) -> (Vector2, Vector2) {
        let first = (self.corners[0], self.corners[0]);
        self.corners().iter().fold(first, |(low, high), corner| (low.inf(corner), high.sup(corner)))
    }
}
