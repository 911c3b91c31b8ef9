//! The shape of a mover, and its distance to obstacles.

use super::super::convex::{Closest, Convex, Placement, Point, aabb_of, closest, plus};
use crate::builders::GeomBuilder;
use crate::math::Vector2;
use crate::shape::Aabb;
use crate::{Error, Result};
use farseer_precise::pieces::Piece;

/// Gap that a mover keeps, as a fraction of its size. Value chosen: a fortieth of a pixel for a figure of 24 px, invisible, and
/// far more than the rounding of `f64`.
const SKIN_RATIO: f64 = 1e-3;
/// Smallest gap that a mover keeps, in steps of rounding of its position: a count. Rounding moves it by half a step.
const SKIN_MIN_ULPS: f64 = 8.0;

/// The convex shape of a mover.
#[derive(Debug, Clone)]
pub(super) struct MoverShape {
    /// About the origin, in length units.
    local: Convex,
    /// The shape at its last place, to reuse its memory.
    placed: Convex,
    /// Box about the origin, in length units.
    aabb: Aabb,
}

impl MoverShape {
    pub(super) fn new(shape: &GeomBuilder) -> Result<Self> {
        let at = Placement::new(shape.offset_and_rotation()?);
        let pieces = shape.pieces()?;
        let [piece] = &pieces[..] else {
            return Err(Error::invalid(
                "shape",
                format_args!("{} convex pieces", pieces.len()),
                "one convex shape",
            ));
        };
        let local = Convex::of_piece(piece, |point| at.apply(point));
        if matches!(piece, Piece::Edge { .. }) {
            return Err(Error::invalid("shape", "a chain", "one convex shape"));
        }
        let aabb = aabb_of(std::slice::from_ref(&local));
        Ok(MoverShape { placed: local.clone(), local, aabb })
    }

    /// Gap that is kept to obstacles at a position, in length units.
    pub(super) fn skin(&self, at: Vector2) -> f64 {
        let size = f64::from(self.aabb.width().min(self.aabb.height()));
        let ulp = f64::from(at.x.abs().max(at.y.abs())) * f64::from(f32::EPSILON);
        (SKIN_RATIO * size).max(SKIN_MIN_ULPS * ulp)
    }

    /// Box about the shape at a position, in length units: left, top, right, bottom.
    pub(super) fn bounds(&self, [x, y]: Point) -> [f64; 4] {
        let Aabb { min, max } = self.aabb;
        [x + f64::from(min.x), y + f64::from(min.y), x + f64::from(max.x), y + f64::from(max.y)]
    }

    /// The middle of the core at a position, in length units.
    pub(super) fn middle(&self, at: Point) -> Point {
        plus(self.local.middle(), at)
    }

    /// Closest points of the shape at a position, as A, and an obstacle, as B.
    pub(super) fn gap(&mut self, at: Point, obstacle: &Convex) -> Closest {
        self.placed.set_to_moved(&self.local, at);
        closest(&self.placed, obstacle)
    }
}
