//! Point of an outline nearest to a point, with signed distance.
//!
//! Frame: the plane's. Exact for every outline that does not cross itself, concave ones too. The nearest
//! point is the nearest of the closest points of the edges (closest point of a segment: Ericson, *Real-Time
//! Collision Detection*, 5.1.2).

use farseer_core::math::{Vector2, vector2};

use super::{contains, doubled_area, edges};

/// Nearest point of an outline.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Nearest {
    /// Signed distance, px; negative inside.
    pub(crate) distance: f32,
    /// Outward unit normal of the outline at the nearest point: the gradient of the distance.
    pub(crate) normal: Vector2,
    /// Nearest point on the outline, px.
    pub(crate) point: Vector2,
}

/// Closest point of one edge to the tested point.
struct EdgeCandidate {
    /// Squared distance of the closest point from the tested point, px².
    squared: f32,
    edge: (Vector2, Vector2),
    /// Position of the closest point as a fraction of the edge, 0..=1, dimensionless.
    along: f32,
}

fn closest_of_edge(edge: (Vector2, Vector2), point: Vector2) -> EdgeCandidate {
    let (a, b) = edge;
    let direction = b - a;
    let from_a = point - a;
    let squared_length = vector2::length_squared(direction);
    let projection = vector2::dot(from_a, direction);
    if squared_length > 0.0 && projection > 0.0 && projection < squared_length {
        let cross = vector2::cross(direction, from_a);
        return EdgeCandidate {
            squared: cross / squared_length * cross,
            edge,
            along: projection / squared_length,
        };
    }
    if projection > 0.0 && squared_length > 0.0 {
        EdgeCandidate { squared: vector2::length_squared(point - b), edge, along: 1.0 }
    } else {
        EdgeCandidate { squared: vector2::length_squared(from_a), edge, along: 0.0 }
    }
}

/// Unit normal of an edge; outward if `area` is the signed area of its outline.
fn edge_normal((a, b): (Vector2, Vector2), area: f32) -> Option<Vector2> {
    let direction = b - a;
    let length = vector2::length(direction);
    let normal = Vector2::new(-direction.y / length, direction.x / length);
    let is_unit = length > 0.0 && normal.x.is_finite() && normal.y.is_finite();
    is_unit.then_some(if area > 0.0 { -normal } else { normal })
}

/// Nearest point of an outline.
///
/// Beside an edge the normal is that of the edge. Beside a vertex it is the direction from the vertex to the
/// point, reversed if the point is inside. On the outline it is the normal of an edge. Outlines of one or two
/// vertices have no inside. `None` without vertices, for coordinates that are not finite, and on a vertex
/// without edges.
pub(crate) fn nearest(outline: &[Vector2], point: Vector2) -> Option<Nearest> {
    let mut best: Option<EdgeCandidate> = None;
    for edge in edges(outline) {
        let candidate = closest_of_edge(edge, point);
        if best.as_ref().is_none_or(|best| candidate.squared < best.squared) {
            best = Some(candidate);
        }
    }
    let best = best.filter(|best| best.squared.is_finite())?;
    let area = doubled_area(outline);
    if best.along > 0.0 && best.along < 1.0 {
        beside_edge(&best, area, point)
    } else {
        beside_vertex(&best, area, outline, point)
    }
}

fn beside_edge(best: &EdgeCandidate, area: f32, point: Vector2) -> Option<Nearest> {
    let (a, b) = best.edge;
    let normal = edge_normal(best.edge, area)?;
    let distance = vector2::dot(normal, point - a);
    let on_outline = a + (b - a) * best.along;
    // Without area both sides are outside.
    let is_back = area == 0.0 && distance < 0.0;
    Some(Nearest {
        distance: if is_back { -distance } else { distance },
        normal: if is_back { -normal } else { normal },
        point: on_outline,
    })
}

fn beside_vertex(best: &EdgeCandidate, area: f32, outline: &[Vector2], point: Vector2) -> Option<Nearest> {
    let vertex = if best.along > 0.0 { best.edge.1 } else { best.edge.0 };
    let from_vertex = point - vertex;
    let distance = vector2::length(from_vertex);
    // The direction of a point closer than the rounding of the coordinates is not defined.
    let rounding = 2.0 * f32::EPSILON * point.amax().max(vertex.amax()) + f32::MIN_POSITIVE;
    if distance <= rounding {
        let edge_at_vertex = edges(outline).filter(|(a, b)| *a == vertex || *b == vertex);
        let normal = edge_at_vertex.filter_map(|edge| edge_normal(edge, area)).next()?;
        return Some(Nearest { distance: 0.0, normal, point: vertex });
    }
    let outward = Vector2::new(from_vertex.x / distance, from_vertex.y / distance);
    if !(outward.x.is_finite() && outward.y.is_finite()) {
        return None;
    }
    Some(if area != 0.0 && contains(outline, point) {
        Nearest { distance: -distance, normal: -outward, point: vertex }
    } else {
        Nearest { distance, normal: outward, point: vertex }
    })
}

#[cfg(test)]
mod tests {
    use super::super::samples::{Random, points, rectangle, winds_around};
    use super::*;

    /// A tall bar and a low one to the right of it, along the bottom.
    fn l_shape() -> Vec<Vector2> {
        points(&[(0.0, 0.0), (0.0, 6.0), (6.0, 6.0), (6.0, 4.0), (2.0, 4.0), (2.0, 0.0)])
    }

    fn at(outline: &[Vector2], x: f32, y: f32) -> (f32, (f32, f32), (f32, f32)) {
        let found = nearest(outline, Vector2::new(x, y)).expect("a nearest point");
        (found.distance, (found.normal.x, found.normal.y), (found.point.x, found.point.y))
    }

    #[test]
    fn beside_an_edge_the_normal_is_the_edges() {
        assert_eq!(at(&l_shape(), 4.0, 3.0), (1.0, (0.0, -1.0), (4.0, 4.0)));
    }

    #[test]
    fn inside_the_distance_is_negative_and_the_normal_still_outward() {
        assert_eq!(at(&l_shape(), 4.0, 4.5), (-0.5, (0.0, -1.0), (4.0, 4.0)));
    }

    #[test]
    fn beyond_a_corner_the_normal_points_from_the_corner() {
        assert_eq!(at(&l_shape(), 9.0, 10.0), (5.0, (0.6, 0.8), (6.0, 6.0)));
    }

    #[test]
    fn inside_beside_an_inner_corner_the_normal_points_to_the_corner() {
        assert_eq!(at(&l_shape(), 1.625, 4.5), (-0.625, (0.6, -0.8), (2.0, 4.0)));
    }

    #[test]
    fn on_the_outline_the_normal_is_that_of_an_edge() {
        assert_eq!(at(&l_shape(), 4.0, 4.0), (0.0, (0.0, -1.0), (4.0, 4.0)));
        let (distance, normal, _) = at(&l_shape(), 6.0, 6.0);
        assert_eq!(distance, 0.0);
        assert!(normal == (1.0, 0.0) || normal == (0.0, 1.0));
    }

    #[test]
    fn the_winding_does_not_matter() {
        let mut reversed = l_shape();
        reversed.reverse();
        for (x, y) in [(4.0, 3.0), (4.0, 4.5), (9.0, 10.0), (1.625, 4.5), (4.0, 4.0)] {
            assert_eq!(at(&reversed, x, y), at(&l_shape(), x, y));
        }
    }

    #[test]
    fn a_segment_has_two_outsides() {
        let segment = points(&[(0.0, 0.0), (4.0, 0.0)]);
        assert_eq!(at(&segment, 1.0, 2.0), (2.0, (0.0, 1.0), (1.0, 0.0)));
        assert_eq!(at(&segment, 1.0, -2.0), (2.0, (0.0, -1.0), (1.0, 0.0)));
        assert_eq!(at(&segment, 7.0, 4.0), (5.0, (0.6, 0.8), (4.0, 0.0)));
    }

    #[test]
    fn a_single_point_is_a_corner_without_edges() {
        let single = points(&[(1.0, 1.0), (1.0, 1.0)]);
        assert_eq!(at(&single, 4.0, 5.0), (5.0, (0.6, 0.8), (1.0, 1.0)));
        assert_eq!(nearest(&single, Vector2::new(1.0, 1.0)), None);
        assert_eq!(nearest(&[], Vector2::new(1.0, 1.0)), None);
    }

    #[test]
    fn edges_of_no_length_change_nothing() {
        let corners = l_shape();
        let doubled: Vec<_> = corners.iter().flat_map(|corner| [*corner, *corner]).collect();
        for (x, y) in [(4.0, 3.0), (4.0, 4.5), (9.0, 10.0), (1.625, 4.5), (6.0, 6.0)] {
            assert_eq!(at(&doubled, x, y), at(&corners, x, y));
        }
    }

    #[test]
    fn coordinates_that_are_not_finite_have_no_nearest_point() {
        assert_eq!(nearest(&l_shape(), Vector2::new(f32::NAN, 0.0)), None);
        assert_eq!(nearest(&l_shape(), Vector2::new(f32::INFINITY, 0.0)), None);
        assert_eq!(nearest(&l_shape(), Vector2::new(f32::MAX, f32::MAX)), None);
    }

    #[test]
    fn far_from_the_origin_a_point_by_an_edge_gets_the_edges_normal() {
        let turned = rectangle((20_000.0, -20_000.0), 100.0, 10.0, 0.3);
        let (a, b) = (turned[1], turned[2]);
        let edge = vector2::normalize(b - a);
        let outward = Vector2::new(-edge.y, edge.x);
        let found = nearest(&turned, a + (b - a) * 0.3 + outward * 0.01).expect("a nearest point");
        assert!(vector2::distance(found.normal, outward) < 1e-6);
    }

    #[test]
    fn no_point_of_the_outline_is_nearer_and_the_side_is_right() {
        let mut random = Random(1);
        for _ in 0..300 {
            let middle = random.point(500.0);
            let outline = random.star(middle, 9, 40.0, 1.0);
            let point = middle + random.point(50.0);
            let found = nearest(&outline, point).expect("a nearest point");
            let sampled = edges(&outline)
                .flat_map(|(a, b)| (0..1000).map(move |i| a + (b - a) * (i as f32 / 1000.0)))
                .map(|on_outline| vector2::distance(on_outline, point))
                .fold(f32::INFINITY, f32::min);
            // Edges are at most 80 long: samples are 0.08 apart, half of which is how much farther they can be.
            assert!(found.distance.abs() <= sampled + 1e-3 && found.distance.abs() >= sampled - 0.04 - 1e-3);
            assert!(found.distance.abs() < 0.01 || (found.distance < 0.0) == winds_around(&outline, point));
            assert!((vector2::length(found.normal) - 1.0).abs() < 1e-6);
            // Coordinates up to 600 are rounded to 3e-5.
            let reached = found.point + found.normal * found.distance;
            assert!(vector2::distance(reached, point) < 3e-4);
        }
    }
}
