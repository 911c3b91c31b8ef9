//! Narrow phase: chooses the routine that computes the manifold of two shapes. Circles and polygons are in [`manifold`], capsules
//! and rounded polygons in [`capsule`] and `rounded_polygon`, parts of concave outlines and chains in [`ghost_filter`].

use super::capsule;
use super::ghost_filter;
use super::manifold::{self, Manifold};
use super::rounded_polygon;
use super::shape_pair::ShapePair;
use crate::math::plane::Pose;
use crate::shape::{ShapeKind, ShapeRef};

/// Returns the manifold of A and B in world axes, with the points whose separation is below `margin`, in length units.
pub fn collide(a: ShapeRef<'_>, b: ShapeRef<'_>, pose_a: Pose, pose_b: Pose, margin: f32) -> Manifold {
    use ShapeKind::{Capsule, Circle, LinkedPolygon, Polygon, RoundedPolygon};
    match (a.shape.kind, b.shape.kind) {
        (Polygon, Polygon) => manifold::polygons(a, b, pose_a, pose_b, margin),
        (_, Circle) => collide_with_circle(a, b, pose_a, pose_b, margin),
        (Circle, _) => collide_with_circle(b, a, pose_b, pose_a, margin).flip(pose_b, pose_a),
        (LinkedPolygon, Capsule | RoundedPolygon) | (Capsule | RoundedPolygon, LinkedPolygon) => {
            ghost_filter::capsule(&ShapePair::new(a, b, pose_a, pose_b), margin)
        }
        (LinkedPolygon, _) | (_, LinkedPolygon) => {
            ghost_filter::polygons(&ShapePair::new(a, b, pose_a, pose_b), margin)
        }
        (Capsule | RoundedPolygon, _) | (_, Capsule | RoundedPolygon) => {
            capsule::capsule(&ShapePair::new(a, b, pose_a, pose_b), margin)
        }
    }
}

/// Returns the manifold of a shape A of any kind and a circle B. `margin` is as in [`collide`].
fn collide_with_circle(
    a: ShapeRef<'_>,
    circle: ShapeRef<'_>,
    pose_a: Pose,
    pose_b: Pose,
    margin: f32,
) -> Manifold {
    match a.shape.kind {
        ShapeKind::Circle => manifold::circles(a, circle, pose_a, pose_b, margin),
        ShapeKind::Polygon => manifold::polygon_and_circle(a, circle, pose_a, pose_b, margin),
        ShapeKind::Capsule => capsule::capsule_and_circle(a, circle, pose_a, pose_b, margin),
        ShapeKind::RoundedPolygon => rounded_polygon::and_circle(a, circle, pose_a, pose_b, margin),
        ShapeKind::LinkedPolygon => ghost_filter::circle(a, circle, pose_a, pose_b, margin),
    }
}
