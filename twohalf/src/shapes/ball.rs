//! Balls against balls and prisms.
//!
//! Frame: the plane's, with z into the picture. A prism is an outline of the plane, convex or not, extended by
//! `half_depth` to both sides of its `z`; its front faces -z.

use farseer_core::math::{Vector2, Vector3, vector2};

use super::{contains, doubled_area, edges, nearest};

/// The contact of a ball with something.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Touch {
    /// From the other thing to the ball, of length 1.
    pub(crate) normal: Vector3,
    /// How far the ball is away: negative, since it overlaps.
    pub(crate) separation: f32,
    /// The ball's deepest point.
    pub(crate) point: Vector3,
}

/// The contact of a ball with a prism.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct BallTouch {
    pub(crate) touch: Touch,
    /// Whether the ball's centre is inside the prism.
    pub(crate) is_inside: bool,
}

impl Touch {
    /// The contact of a ball whose centre is at a distance from something; `None` if the ball does not reach it.
    fn at(centre: Vector3, radius: f32, distance: f32, normal: Vector3) -> Option<Touch> {
        let separation = distance - radius;
        let point = centre - normal * radius;
        let is_finite = separation.is_finite() && point.iter().all(|coordinate| coordinate.is_finite());
        (is_finite && separation < 0.0).then_some(Touch { normal, separation, point })
    }
}

/// The contact of two balls, as the second one's. Balls with the same centre are pushed apart upward.
pub(crate) fn ball_ball(centre_a: Vector3, radius_a: f32, centre_b: Vector3, radius_b: f32) -> Option<Touch> {
    let between = centre_b - centre_a;
    let distance = between.dot(&between).sqrt();
    // Squares of less than this are not exact any more.
    let normal = if distance < 1e-15 { Vector3::new(0.0, -1.0, 0.0) } else { between / distance };
    Touch::at(centre_b, radius_b, distance - radius_a, normal)
}

/// The signed distance of a ball's centre from the nearer end of a prism along z, and the sign of that end.
fn beyond_end(centre_z: f32, z: f32, half_depth: f32) -> (f32, f32) {
    let from_middle = centre_z - z;
    let sign = if from_middle < 0.0 { -1.0 } else { 1.0 };
    (from_middle * sign - half_depth, sign)
}

/// The contact of a ball with a prism. Its normal is that of the nearest face, or points from the nearest edge or
/// corner.
pub(crate) fn ball_prism(
    centre: Vector3,
    radius: f32,
    outline: &[Vector2],
    z: f32,
    half_depth: f32,
) -> Option<BallTouch> {
    let (beyond, sign) = beyond_end(centre.z, z, half_depth);
    if beyond >= radius {
        return None;
    }
    let nearest = nearest(outline, centre.xy())?;
    let beside = nearest.distance;
    let diagonal = (beside * beside + beyond * beyond).sqrt();
    let (distance, normal) = if beside > 0.0 && beyond > 0.0 && diagonal > 1e-15 {
        let in_plane = nearest.normal * (beside / diagonal);
        (diagonal, Vector3::new(in_plane.x, in_plane.y, sign * beyond / diagonal))
    } else if beside >= beyond {
        (beside, Vector3::new(nearest.normal.x, nearest.normal.y, 0.0))
    } else {
        (beyond, Vector3::new(0.0, 0.0, sign))
    };
    let touch = Touch::at(centre, radius, distance, normal)?;
    Some(BallTouch { touch, is_inside: beside < 0.0 && beyond < 0.0 })
}

/// The outward normal of the face of a prism through which the way from `before` to `now`, both relative to the
/// prism as it is now, first comes in. `None` if it starts inside or never comes in.
pub(crate) fn entry_face_of_prism(
    before: Vector3,
    now: Vector3,
    outline: &[Vector2],
    z: f32,
    half_depth: f32,
) -> Option<Vector3> {
    let way = now - before;
    let (beyond, sign) = beyond_end(before.z, z, half_depth);
    if beyond < 0.0 && nearest(outline, before.xy())?.distance < 0.0 {
        return None;
    }
    // The part of the way, 0 to 1, between the planes of the two ends.
    let start = if beyond < 0.0 { 0.0 } else { beyond / (-sign * way.z) };
    let leave = if way.z == 0.0 {
        1.0
    } else {
        (((z - before.z) * way.z.signum() + half_depth) / way.z.abs()).min(1.0)
    };
    if !(start >= 0.0 && start <= leave) {
        return None;
    }
    if beyond >= 0.0 && contains(outline, before.xy() + way.xy() * start) {
        return Some(Vector3::new(0.0, 0.0, sign));
    }
    let (entry, normal) = first_entry(outline, before.xy(), way.xy(), start)?;
    (entry <= leave).then(|| Vector3::new(normal.x, normal.y, 0.0))
}

/// The first edge that a way crosses inward after `start`: how far along the way, and the edge's outward normal.
fn first_entry(outline: &[Vector2], before: Vector2, way: Vector2, start: f32) -> Option<(f32, Vector2)> {
    let area = doubled_area(outline);
    let mut first: Option<(f32, Vector2)> = None;
    for (a, b) in edges(outline) {
        let edge = if area > 0.0 { a - b } else { b - a };
        let outward = Vector2::new(-edge.y, edge.x);
        let speed = vector2::dot(outward, way);
        // Each end belongs to one side, so that a way through a vertex crosses one of its edges.
        let (side_a, side_b) = (vector2::cross(way, a - before), vector2::cross(way, b - before));
        if speed >= 0.0 || (side_a > 0.0) == (side_b > 0.0) {
            continue;
        }
        let along = vector2::dot(outward, a - before) / speed;
        let length = vector2::length(outward);
        // A way that starts on the edge may seem to start a little behind it.
        let is_ahead = along >= start - 1e-4 && length > 0.0;
        if is_ahead && first.is_none_or(|(least, _)| along < least) {
            first = Some((along, Vector2::new(outward.x / length, outward.y / length)));
        }
    }
    first
}

/// The contact of a ball whose centre is inside a prism, as one with the face of a given outward normal, whatever
/// face is nearest: how far the ball has to go along that normal until it is outside.
///
/// For a centre beside the outline this is the distance from the outline's supporting line in that direction.
pub(crate) fn ball_prism_through_face(
    centre: Vector3,
    radius: f32,
    outline: &[Vector2],
    z: f32,
    half_depth: f32,
    face: Vector3,
) -> Option<Touch> {
    if face.z != 0.0 {
        let distance = (centre.z - z) * face.z - half_depth;
        return Touch::at(centre, radius, distance, face);
    }
    let direction = face.xy();
    let exit = contains(outline, centre.xy()).then(|| way_out(outline, centre.xy(), direction)).flatten();
    let distance = exit.map(|way| -way).or_else(|| {
        let support = outline.iter().map(|vertex| vector2::dot(direction, *vertex)).reduce(f32::max)?;
        Some(vector2::dot(direction, centre.xy()) - support)
    })?;
    Touch::at(centre, radius, distance, face)
}

/// How far it is from a point inside an outline to the outline in a direction.
fn way_out(outline: &[Vector2], point: Vector2, direction: Vector2) -> Option<f32> {
    let mut least: Option<f32> = None;
    for (a, b) in edges(outline) {
        let (side_a, side_b) = (vector2::cross(direction, a - point), vector2::cross(direction, b - point));
        if (side_a > 0.0) == (side_b > 0.0) {
            continue;
        }
        let (along_a, along_b) = (vector2::dot(direction, a - point), vector2::dot(direction, b - point));
        let along = along_a + (along_b - along_a) * (side_a / (side_a - side_b));
        if along >= 0.0 && least.is_none_or(|least| along < least) {
            least = Some(along);
        }
    }
    least
}
