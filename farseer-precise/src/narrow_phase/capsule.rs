//! Narrow phase: manifolds of capsules. A capsule is a segment, called its core, with a radius. The separation of two shapes is
//! that of the cores minus both radii; the core of a polygon is the polygon itself.
//!
//! Separated cores touch along the shortest segment between them, which has a vertex at one end at least (C. Ericson,
//! "Real-Time Collision Detection", 2005, section 5.1). Between a vertex and an edge the normal is that of the edge, and the
//! incident edge is clipped as between polygons. So a capsule rests on two points. Between two vertices there is one point.
//! Overlapping cores are clipped as polygons.

use crate::math::plane::{
    Pose, Vector, difference, dot, rotate, rotate_inverse, rotation, scaled, sum, translation,
};
use crate::narrow_phase::manifold::Manifold;
use crate::narrow_phase::shape_pair::{ClosestFeatures, ShapePair, WhichShape};
use crate::parameters::narrow_phase::{CAPSULE_EDGE_MIN_COS, REFERENCE_EDGE_HYSTERESIS};
use crate::shape::ShapeRef;

/// Returns the manifold of a capsule A and a circle B: at most one point, along the line from the closest point of the
/// capsule's segment to the circle's centre. `margin`: largest separation with a point, in length units.
pub(crate) fn capsule_and_circle(
    a: ShapeRef<'_>,
    b: ShapeRef<'_>,
    pose_a: Pose,
    pose_b: Pose,
    margin: f32,
) -> Manifold {
    let q = rotation(pose_a);
    let centre_b =
        sum(difference(translation(pose_b), translation(pose_a)), rotate(rotation(pose_b), b.shape.centre));
    let centre = rotate_inverse(q, centre_b);
    let along = difference(a.vertices[1], a.vertices[0]);
    let fraction = (dot(difference(centre, a.vertices[0]), along) / dot(along, along)).clamp(0.0, 1.0);
    let offset = difference(centre, sum(a.vertices[0], scaled(along, fraction)));
    let distance = dot(offset, offset).sqrt();
    // A centre on the core itself has no direction from it; the normal of the segment replaces it.
    let normal = if distance > 0.0 { scaled(offset, 1.0 / distance) } else { a.normals[0] };
    let separation = distance - a.shape.radius - b.shape.radius;
    let point = difference(centre, scaled(normal, b.shape.radius + 0.5 * separation));
    Manifold::single_point(normal, point, separation, 0, margin).to_world(q)
}

/// Returns the manifold of a capsule with a capsule or polygon: up to two points. `margin`: largest separation with a point, in
/// length units.
pub(crate) fn capsule(shapes: &ShapePair<'_>, margin: f32) -> Manifold {
    let radius = shapes.total_radius();
    let (separation_a, edge_a) = shapes.a.find_max_separation(&shapes.b);
    let (separation_b, edge_b) = shapes.b.find_max_separation(&shapes.a);
    let (separation, which, edge) = if separation_b > separation_a + REFERENCE_EDGE_HYSTERESIS * margin {
        (separation_b, WhichShape::B, edge_b)
    } else {
        (separation_a, WhichShape::A, edge_a)
    };
    if separation > margin + radius {
        return Manifold::separated(separation - radius);
    }
    match shapes
        .closest_features(margin)
        .filter(|&(distance, _)| are_cores_separated(shapes, separation, distance))
    {
        Some((_, ClosestFeatures::Edge(which, edge))) => shapes.clip_edge(which, edge, margin),
        Some((_, ClosestFeatures::Vertices { vertex_a, vertex_b, offset })) => {
            let edge_contact =
                is_along_normal(shapes, which, edge, offset).then(|| shapes.clip_edge(which, edge, margin));
            edge_contact
                .filter(|manifold| manifold.count > 0)
                .unwrap_or_else(|| shapes.vertex_vertex(vertex_a, vertex_b, offset, margin))
        }
        None => shapes.clip_edge(which, edge, margin),
    }
}

/// Returns whether two cores (polygons or segments without radii) are separated. `separation` is the largest separation along
/// edge normals and `distance` the distance of the closest features, both in length units.
///
/// A positive separation along an edge normal proves it. Two segments on one line have no separating normal. So two segments
/// are also separated if `distance` exceeds the overlap -`separation`, because the distance of crossing segments never does.
pub(crate) fn are_cores_separated(shapes: &ShapePair<'_>, separation: f32, distance: f32) -> bool {
    let has_area = shapes.a.shape_ref.vertices.len() > 2 || shapes.b.shape_ref.vertices.len() > 2;
    distance > 0.0 && (separation > 0.0 || (!has_area && distance > -1.001 * separation))
}

/// Returns whether `offset`, the vector from the closest vertex of A to that of B in the frame of A, is nearly parallel to the
/// normal of an edge. `edge` is an index into the edges of the shape `which`.
pub(crate) fn is_along_normal(
    shapes: &ShapePair<'_>,
    which: WhichShape,
    edge: usize,
    offset: Vector,
) -> bool {
    let normal = shapes.side(which).shape_ref.normals[edge];
    let from_a = match which {
        WhichShape::A => normal,
        WhichShape::B => scaled(shapes.b.to_other(normal), -1.0),
    };
    dot(from_a, offset) > CAPSULE_EDGE_MIN_COS * dot(offset, offset).sqrt()
}
