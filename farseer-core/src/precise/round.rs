//! Where capsules touch. A capsule is a segment, its core, and all that is within a radius of it: what touches it is that far
//! from the core, so contacts are those of the cores, moved by the radii.
//!
//! Cores that are apart touch along the shortest way between them, which begins or ends at a corner (C. Ericson, "Real-Time
//! Collision Detection", 2005, section 5.1). Between a corner and an edge its direction is the normal of the edge, and the
//! edge of the other one that faces it is clipped as between polygons: so a capsule lies on two points. Between two corners
//! there is one point. Cores that overlap, which are deep in each other, are clipped as polygons are.

use super::manifold::Manifold;
use super::meeting::{Meeting, Nearest, Which};
use super::outline::Outline;
use crate::math::plane::{Pose, Vector, difference, dot, place, rotation, scaled, sum, turn, turn_back};
use crate::precise::parameters::narrow_phase::{CAPSULE_EDGE_COSINE, REFERENCE_EDGE_HYSTERESIS};

/// The contact of a capsule and a circle: the core's point that is nearest to the centre.
pub(super) fn capsule_and_circle(
    a: Outline<'_>,
    b: Outline<'_>,
    pose_a: Pose,
    pose_b: Pose,
    reach: f32,
) -> Manifold {
    let q = rotation(pose_a);
    let centre_b = sum(difference(place(pose_b), place(pose_a)), turn(rotation(pose_b), b.shape.centre));
    let centre = turn_back(q, centre_b);
    let along = difference(a.points[1], a.points[0]);
    let part = (dot(difference(centre, a.points[0]), along) / dot(along, along)).clamp(0.0, 1.0);
    let way = difference(centre, sum(a.points[0], scaled(along, part)));
    let distance = dot(way, way).sqrt();
    // A centre on the core itself is pushed to one side.
    let normal = if distance > 0.0 { scaled(way, 1.0 / distance) } else { a.normals[0] };
    let separation = distance - a.shape.radius - b.shape.radius;
    let point = difference(centre, scaled(normal, b.shape.radius + 0.5 * separation));
    Manifold::of_point(normal, point, separation, 0, reach).turned(q)
}

/// The contacts of a capsule with a capsule or polygon.
pub(super) fn capsule(meeting: &Meeting<'_>, reach: f32) -> Manifold {
    let radius = meeting.radius();
    let (separation_a, edge_a) = meeting.a.greatest_separation(&meeting.b);
    let (separation_b, edge_b) = meeting.b.greatest_separation(&meeting.a);
    let (separation, which, edge) = if separation_b > separation_a + REFERENCE_EDGE_HYSTERESIS * reach {
        (separation_b, Which::B, edge_b)
    } else {
        (separation_a, Which::A, edge_a)
    };
    if separation > reach + radius {
        return Manifold::apart(separation - radius);
    }
    match meeting.nearest(reach).filter(|&(distance, _)| are_apart(meeting, separation, distance)) {
        Some((_, Nearest::Edge(which, edge))) => meeting.on_edge(which, edge, reach),
        Some((_, Nearest::Corners { corner_a, corner_b, way })) => {
            let lies = along_normal(meeting, which, edge, way).then(|| meeting.on_edge(which, edge, reach));
            lies.filter(|found| found.count > 0)
                .unwrap_or_else(|| meeting.on_corners(corner_a, corner_b, way, reach))
        }
        None => meeting.on_edge(which, edge, reach),
    }
}

/// Whether cores do not overlap. Normals of edges tell, but not of two segments on one line. Those are apart if they are
/// further from each other than normals say that they overlap: where segments cross, the end that is least behind the other
/// one is no further from it than that.
pub(super) fn are_apart(meeting: &Meeting<'_>, separation: f32, distance: f32) -> bool {
    let has_area = meeting.a.outline.points.len() > 2 || meeting.b.outline.points.len() > 2;
    distance > 0.0 && (separation > 0.0 || (!has_area && distance > -1.001 * separation))
}

/// Whether a way from A to B goes along the normal of an edge.
pub(super) fn along_normal(meeting: &Meeting<'_>, which: Which, edge: usize, way: Vector) -> bool {
    let normal = meeting.side(which).outline.normals[edge];
    let from_a = match which {
        Which::A => normal,
        Which::B => scaled(meeting.b.for_other(normal), -1.0),
    };
    dot(from_a, way) > CAPSULE_EDGE_COSINE * dot(way, way).sqrt()
}
