//! Shapes that move on a straight way, by conservative advancement (B. Mirtich, "Impulse-based Dynamic Simulation of Rigid Body
//! Systems", 1996): without rotation the distance divided by the closing speed is a time without a touch.

use super::convex::{Convex, Point, aabb_of, closest, dot, minus, point, scaled, vector};
use super::{finite, world_shape};
use crate::Result;
use crate::geom::GeomId;
use crate::math::Vector2;
use crate::objects::{Objects, RayCastHit};
use crate::shape::Aabb;
use crate::simulator::candidates::Segment;

/// Maximum number of steps of a cast, a count. Between polygons two or three are needed; a graze of two circles takes most.
const MAX_STEPS: usize = 60;
/// Distance at which two shapes touch, as a fraction of the shape's size and its way. Far below the rounding of `f32`.
const TOUCH_RATIO: f64 = 1e-9;

/// A shape on its way.
pub(super) struct Cast<'a> {
    pieces: &'a [Convex],
    /// The way, in length units.
    motion: Point,
    /// Distance of a touch, in length units.
    touch: f64,
}

impl<'a> Cast<'a> {
    pub(super) fn new(pieces: &'a [Convex], motion: Vector2) -> Result<Self> {
        let motion = point(finite("motion", motion)?);
        let size = aabb_of(pieces);
        let extent = f64::from(size.width()) + f64::from(size.height()) + motion[0].abs() + motion[1].abs();
        Ok(Cast { pieces, motion, touch: TOUCH_RATIO * extent })
    }

    /// The path of the box around the shape.
    pub(super) fn segment(&self) -> Segment {
        let Aabb { min, max } = aabb_of(self.pieces);
        let start = (min + max) * 0.5;
        // A touch may be that far from the obstacle.
        let touch = Vector2::new(self.touch as f32, self.touch as f32);
        Segment { start, end: start + vector(self.motion), half_extents: (max - min) * 0.5 + touch }
    }

    /// The first touch of a geom, with its fraction of the way, if that is at most `max_fraction`.
    pub(super) fn hit(
        &self,
        objects: &Objects,
        geom: GeomId,
        max_fraction: f64,
    ) -> Option<(f64, RayCastHit)> {
        let mut first: Option<(f64, Point, Point)> = None;
        for obstacle in world_shape::pieces_of(objects, geom) {
            for piece in self.pieces {
                let Some(touch) = self.first_touch(piece, &obstacle, max_fraction) else { continue };
                if first.is_none_or(|first| touch.0 < first.0) {
                    first = Some(touch);
                }
            }
        }
        let (fraction, normal, at) = first?;
        let hit = RayCastHit { geom, point: vector(at), normal: vector(normal), fraction: fraction as f32 };
        Some((fraction, hit))
    }

    /// The first touch of two convex shapes: fraction of the way, normal from the obstacle to the shape, and point on the
    /// obstacle.
    fn first_touch(
        &self,
        shape: &Convex,
        obstacle: &Convex,
        max_fraction: f64,
    ) -> Option<(f64, Point, Point)> {
        if let Some(free_side) = obstacle.free_side {
            let is_behind = dot(minus(shape.middle(), obstacle.core[0]), free_side) < 0.0;
            if is_behind || dot(self.motion, free_side) >= 0.0 {
                return None;
            }
        }
        let mut fraction = 0.0;
        for _ in 0..MAX_STEPS {
            let gap = closest(&shape.moved(scaled(self.motion, fraction)), obstacle);
            let closing = dot(self.motion, gap.normal);
            if closing <= 0.0 {
                return None;
            }
            if gap.distance <= self.touch {
                return Some((fraction, gap.normal.map(|part| -part), gap.point_b));
            }
            fraction += gap.distance / closing;
            if fraction > max_fraction {
                return None;
            }
        }
        let gap = closest(&shape.moved(scaled(self.motion, fraction)), obstacle);
        Some((fraction, gap.normal.map(|part| -part), gap.point_b))
    }
}
