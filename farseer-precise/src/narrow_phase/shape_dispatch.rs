//! Narrow phase: chooses the routine that computes the manifold of two shapes. Circles and polygons are in [`manifold`], capsules
//! in [`capsule`], parts of concave outlines and chains in [`ghost_filter`].

use super::capsule;
use super::ghost_filter;
use super::manifold::{self, Manifold};
use super::shape_pair::ShapePair;
use crate::math::plane::Pose;
use crate::shape::{ShapeKind, ShapeRef};

/// Returns the manifold of A and B in world axes, with the points whose separation is below `margin`, in length units.
pub fn collide(a: ShapeRef<'_>, b: ShapeRef<'_>, pose_a: Pose, pose_b: Pose, margin: f32) -> Manifold {
    use ShapeKind::{Capsule, Circle, LinkedPolygon, Polygon};
    match (a.shape.kind, b.shape.kind) {
        (Circle, Circle) => manifold::circles(a, b, pose_a, pose_b, margin),
        (Circle, Polygon) => manifold::polygon_and_circle(b, a, pose_b, pose_a, margin).flip(pose_b, pose_a),
        (Polygon, Circle) => manifold::polygon_and_circle(a, b, pose_a, pose_b, margin),
        (Polygon, Polygon) => manifold::polygons(a, b, pose_a, pose_b, margin),
        (Circle, Capsule) => capsule::capsule_and_circle(b, a, pose_b, pose_a, margin).flip(pose_b, pose_a),
        (Capsule, Circle) => capsule::capsule_and_circle(a, b, pose_a, pose_b, margin),
        (Circle, LinkedPolygon) => ghost_filter::circle(b, a, pose_b, pose_a, margin).flip(pose_b, pose_a),
        (LinkedPolygon, Circle) => ghost_filter::circle(a, b, pose_a, pose_b, margin),
        (LinkedPolygon, Capsule) | (Capsule, LinkedPolygon) => {
            ghost_filter::capsule(&ShapePair::new(a, b, pose_a, pose_b), margin)
        }
        (LinkedPolygon, _) | (_, LinkedPolygon) => {
            ghost_filter::polygons(&ShapePair::new(a, b, pose_a, pose_b), margin)
        }
        (Capsule, _) | (_, Capsule) => capsule::capsule(&ShapePair::new(a, b, pose_a, pose_b), margin),
    }
}
