//! Intersections of lines and segments (behaviour chapter 09, sections 1 to 3). Points are in length units, screen y
//! down.

use crate::math::Vector2;
use crate::shape::{Aabb, Vertices};

/// Maximum absolute cross product of the direction vectors of parallel lines, in length units². Absolute: short
/// segments that cross may count as parallel. Farseer's value.
const PARALLEL_TOLERANCE: f32 = 0.00001;

/// Whether two values differ by at most `delta`.
#[doc(alias = "RayHelper.FloatEquals")]
pub fn float_equals(value1: f32, value2: f32, delta: f32) -> bool {
    float_in_range(value1, value2 - delta, value2 + delta)
}

/// Whether a value lies in a range, its ends included. NaN does not.
#[doc(alias = "RayHelper.FloatInRange")]
pub fn float_in_range(value: f32, min: f32, max: f32) -> bool {
    value >= min && value <= max
}

/// Intersection of the segments from `point1` to `point2` and from `point3` to `point4`; see [`line_intersect_with`].
///
/// ```
/// use farseer_core::math::Vector2;
/// use farseer_core::ray_helper::line_intersect;
/// let p = Vector2::new;
/// let crossing = line_intersect(p(0.0, 0.0), p(10.0, 10.0), p(0.0, 10.0), p(10.0, 0.0));
/// assert_eq!(crossing, Some(p(5.0, 5.0)));
/// // The start point of a segment is not part of it.
/// assert_eq!(line_intersect(p(0.0, 0.0), p(10.0, 0.0), p(0.0, -5.0), p(0.0, 5.0)), None);
/// ```
#[doc(alias = "RayHelper.LineIntersect")]
pub fn line_intersect(point1: Vector2, point2: Vector2, point3: Vector2, point4: Vector2) -> Option<Vector2> {
    line_intersect_with(point1, point2, point3, point4, true, true)
}

/// Intersection of the line through `point1` and `point2` with the line through `point3` and `point4`; each may be
/// limited to the segment between its points. `None` for parallel lines, and for crossings exactly at the first point
/// of either line, even if it is no segment; crossings at a second point count.
///
/// The crossing is computed along the first line, so that the last digits depend on the order. The original's
/// tolerance argument has no effect there and is left out.
#[doc(alias = "RayHelper.LineIntersect")]
pub fn line_intersect_with(
    point1: Vector2,
    point2: Vector2,
    point3: Vector2,
    point4: Vector2,
    first_is_segment: bool,
    second_is_segment: bool,
) -> Option<Vector2> {
    let a = point4.y - point3.y;
    let b = point2.x - point1.x;
    let c = point4.x - point3.x;
    let d = point2.y - point1.y;
    let denominator = a * b - c * d;
    if float_in_range(denominator, -PARALLEL_TOLERANCE, PARALLEL_TOLERANCE) {
        return None;
    }
    let e = point1.y - point3.y;
    let f = point1.x - point3.x;
    let reciprocal = 1.0 / denominator;

    let along_first = (c * e - a * f) * reciprocal;
    if first_is_segment && !float_in_range(along_first, 0.0, 1.0) {
        return None;
    }
    let along_second = (b * e - d * f) * reciprocal;
    if second_is_segment && !float_in_range(along_second, 0.0, 1.0) {
        return None;
    }
    if along_first == 0.0 || along_second == 0.0 {
        return None;
    }
    Some(Vector2::new(point1.x + along_first * b, point1.y + along_first * d))
}

/// Appends the points where the segment from `point1` to `point2` crosses the edges of an outline, in the order of the
/// edges. A segment through a vertex crosses the edge that ends there, not the one that starts; a crossing at `point1`
/// is not reported.
#[doc(alias = "RayHelper.LineSegmentVerticesIntersect")]
pub fn line_segment_vertices_intersect(
    point1: Vector2,
    point2: Vector2,
    vertices: &Vertices,
    intersection_points: &mut Vec<Vector2>,
) {
    let crossing = |i: usize| line_intersect(vertices[i], vertices[vertices.next_index(i)], point1, point2);
    intersection_points.extend((0..vertices.len()).filter_map(crossing));
}

/// Appends the points where the segment from `point1` to `point2` crosses the sides of a box, in the order left,
/// greatest y, right, smallest y; see [`line_segment_vertices_intersect`].
#[doc(alias = "RayHelper.LineSegmentAABBIntersect")]
pub fn line_segment_aabb_intersect(
    point1: Vector2,
    point2: Vector2,
    aabb: &Aabb,
    intersection_points: &mut Vec<Vector2>,
) {
    line_segment_vertices_intersect(point1, point2, &aabb.get_vertices(), intersection_points);
}
