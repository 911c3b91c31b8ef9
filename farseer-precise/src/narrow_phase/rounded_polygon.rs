//! Narrow phase: manifolds of rounded polygons, which are all points within a radius of a convex polygon, the core. The separation of
//! two shapes is that of the cores minus both radii (as in Box2D 3, E. Catto, `b2CollidePolygons`).
//!
//! With capsules and polygons of all kinds the routines of [`capsule`](super::capsule) apply, whose core is any convex polygon.

use crate::math::plane::{Pose, scaled, sum};
use crate::narrow_phase::manifold::{Manifold, polygon_and_circle};
use crate::shape::ShapeRef;

/// Returns the manifold of a rounded polygon A and a circle B: at most one point. `margin`: contact margin in length units.
pub(super) fn and_circle(
    a: ShapeRef<'_>,
    b: ShapeRef<'_>,
    pose_a: Pose,
    pose_b: Pose,
    margin: f32,
) -> Manifold {
    let radius = a.shape.radius;
    let mut manifold = polygon_and_circle(a, b, pose_a, pose_b, margin + radius);
    // Midway between the surfaces instead of midway between the core and the circle.
    manifold.points[0] = sum(manifold.points[0], scaled(manifold.normal, 0.5 * radius));
    manifold.separations[0] -= radius;
    manifold.gap -= radius;
    manifold
}
