//! Footprints: the area of the floor that an upright object covers, as seen from above.

use serde::{Deserialize, Serialize};

use crate::error::{Error, Result};
use crate::math::Vector2;
use farseer_precise::footprint_corners::{FootprintCorners, MAX_FOOTPRINT_CORNERS};

/// Minimum sine of the angle by which a corner turns, dimensionless. Chosen; no range measured.
const MIN_CORNER_SINE: f32 = 1e-3;

/// A convex polygon of three to eight corners in the plane of X and Z, in length units, relative to the body.
///
/// ```
/// use farseer_core::math::Vector2;
/// use farseer_core::shape::Footprint;
/// let wedge = [[-20.0, -10.0], [20.0, -10.0], [0.0, 15.0]].map(Vector2::from);
/// assert_eq!(Footprint::new(&wedge)?.corners().len(), 3);
/// # Ok::<(), farseer_core::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Vec<Vector2>", into = "Vec<Vector2>")]
pub struct Footprint {
    polygon: FootprintCorners,
}

impl Footprint {
    /// A polygon of these corners, X and Z, in either order.
    ///
    /// # Errors
    /// Fewer than three corners or more than eight; one that is not finite. Corners that do not all turn to the same
    /// side, or hardly turn (by less than a thousandth of a radian). A polygon so large that its area is not finite.
    pub fn new(corners: &[Vector2]) -> Result<Self> {
        let refused = |requirement| Err(Error::invalid("corners", format!("{corners:?}"), requirement));
        let count = corners.len();
        if !(3..=MAX_FOOTPRINT_CORNERS).contains(&count) {
            return refused("three to eight corners");
        }
        if !corners.iter().all(|corner| corner.x.is_finite() && corner.y.is_finite()) {
            return refused("finite");
        }
        let mut kept = [Vector2::zeros(); MAX_FOOTPRINT_CORNERS];
        kept[..count].copy_from_slice(corners);
        let turn = |at: usize| {
            let [a, b, c] = [0, 1, 2].map(|on| kept[(at + on) % count]);
            let (one, next) = (b - a, c - b);
            one.perp(&next) / (one.norm() * next.norm())
        };
        let orientation = if turn(0) < 0.0 { -1.0 } else { 1.0 };
        // A polygon whose corners all turn to the same side may go around more than once: then a corner is beyond some
        // edge.
        let is_before = |at: usize| {
            let (a, b) = (kept[at], kept[(at + 1) % count]);
            kept[..count].iter().all(|&corner| orientation * (b - a).perp(&(corner - a)) >= 0.0)
        };
        if !(0..count).all(|at| orientation * turn(at) >= MIN_CORNER_SINE && is_before(at)) {
            return refused("convex");
        }
        if orientation < 0.0 {
            kept[..count].reverse();
        }
        let area: f32 =
            (1..count).map(|at| (kept[at] - kept[0]).perp(&(kept[(at + 1) % count] - kept[0]))).sum();
        if !(area.is_finite() && area > 0.0) {
            return refused("of a finite area that is not 0");
        }
        Ok(Footprint { polygon: FootprintCorners::new(kept, count) })
    }

    /// A rectangle about the middle, with these extents along X and Z, in length units.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn rectangle(width: f32, depth: f32) -> Result<Self> {
        let (x, z) = (0.5 * width, 0.5 * depth);
        Self::new(&[[-x, -z], [x, -z], [x, z], [-x, z]].map(Vector2::from))
    }

    /// The corners, X and Z, counterclockwise as seen from above with Z up.
    pub fn corners(&self) -> &[Vector2] {
        self.polygon.corners()
    }

    /// The corners with the smallest and the greatest X and Z.
    pub fn bounds(&self) -> (Vector2, Vector2) {
        self.polygon.bounds()
    }
}

impl TryFrom<Vec<Vector2>> for Footprint {
    type Error = Error;
    fn try_from(corners: Vec<Vector2>) -> Result<Self> {
        Footprint::new(&corners)
    }
}

impl From<Footprint> for FootprintCorners {
    fn from(footprint: Footprint) -> Self {
        footprint.polygon
    }
}

impl From<Footprint> for Vec<Vector2> {
    fn from(footprint: Footprint) -> Self {
        footprint.corners().to_vec()
    }
}

#[cfg(test)]
mod tests {
    use super::Footprint;
    use crate::math::Vector2;

    fn of(corners: &[[f32; 2]]) -> crate::Result<Footprint> {
        let corners: Vec<Vector2> = corners.iter().copied().map(Vector2::from).collect();
        Footprint::new(&corners)
    }

    #[test]
    fn either_order_of_corners_gives_one_order() {
        let one = of(&[[0.0, 0.0], [4.0, 0.0], [0.0, 3.0]]).unwrap();
        let other = of(&[[0.0, 3.0], [4.0, 0.0], [0.0, 0.0]]).unwrap();
        let area = |shape: &Footprint| {
            let [a, b, c] = [0, 1, 2].map(|at| shape.corners()[at]);
            (b - a).perp(&(c - a))
        };
        assert_eq!((area(&one), area(&other)), (12.0, 12.0));
    }

    #[test]
    fn polygons_that_are_not_convex_are_refused() {
        let pentagram = [[0.0, 10.0], [-5.9, -8.1], [9.5, 3.1], [-9.5, 3.1], [5.9, -8.1]];
        for wrong in [
            &[[0.0, 0.0], [1.0, 0.0]][..],
            &[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]],
            &[[0.0, 0.0], [2.0, 0.0], [0.5, 0.5], [0.0, 2.0]],
            &[[0.0, 0.0], [f32::NAN, 0.0], [0.0, 1.0]],
            &[[0.0, 0.0], [1e30, 0.0], [0.0, 1e30]],
            &pentagram,
            &[[1.0; 2]; 9],
        ] {
            assert!(of(wrong).is_err(), "{wrong:?}");
        }
    }
}
