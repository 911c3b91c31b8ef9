//! The point of an outline nearest to a point, and on which side of the outline that lies.
//!
//! Frame: the plane's. Exact for every outline that does not cross itself, concave ones too: the nearest point is
//! the least of the closest points of the edges (closest point of a segment: Ericson, *Real-Time Collision
//! Detection*, 5.1.2).

use farseer_core::math::{Vector2, vector2};

use super::{contains, doubled_area, edges};

/// Where an outline is nearest to a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Nearest {
    /// How far the point is from the outline; negative inside it.
    pub(crate) distance: f32,
    /// In which direction the distance grows most: outward, of length 1.
    pub(crate) normal: Vector2,
    /// The point of the outline.
    pub(crate) point: Vector2,
}

/// The closest point of one edge.
struct Candidate {
    squared: f32,
    edge: (Vector2, Vector2),
    /// 0 to 1 along the edge.
    along: f32,
}

fn closest_of_edge(edge: (Vector2, Vector2), point: Vector2) -> Candidate {
    let (a, b) = edge;
    let direction = b - a;
    let from_a = point - a;
    let squared_length = vector2::length_squared(direction);
    let projection = vector2::dot(from_a, direction);
    if squared_length > 0.0 && projection > 0.0 && projection < squared_length {
        let cross = vector2::cross(direction, from_a);
        return Candidate {
            squared: cross / squared_length * cross,
            edge,
            along: projection / squared_length,
        };
    }
    if projection > 0.0 && squared_length > 0.0 {
        Candidate { squared: vector2::length_squared(point - b), edge, along: 1.0 }
    } else {
        Candidate { squared: vector2::length_squared(from_a), edge, along: 0.0 }
    }
}

/// The normal of an edge, outward if `area` is the signed area of its outline, else to the left or right as it is.
fn edge_normal((a, b): (Vector2, Vector2), area: f32) -> Option<Vector2> {
    let direction = b - a;
    let length = vector2::length(direction);
    let normal = Vector2::new(-direction.y / length, direction.x / length);
    let is_unit = length > 0.0 && normal.x.is_finite() && normal.y.is_finite();
    is_unit.then_some(if area > 0.0 { -normal } else { normal })
}

/// The nearest point of an outline.
///
/// Beside an edge the normal is that of the edge; beside a vertex it is the direction from the vertex to the point,
/// or back if the point is inside. On the outline it is the normal of an edge. Outlines of one or two vertices have
/// no inside. `None` without vertices, for coordinates that are not finite, and on a vertex that has no edges.
pub(crate) fn nearest(outline: &[Vector2], point: Vector2) -> Option<Nearest> {
    let mut best: Option<Candidate> = None;
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

fn beside_edge(best: &Candidate, area: f32, point: Vector2) -> Option<Nearest> {
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

fn beside_vertex(best: &Candidate, area: f32, outline: &[Vector2], point: Vector2) -> Option<Nearest> {
    let vertex = if best.along > 0.0 { best.edge.1 } else { best.edge.0 };
    let from_vertex = point - vertex;
    let distance = vector2::length(from_vertex);
    // What is closer than the digits of the coordinates has no direction of its own.
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
