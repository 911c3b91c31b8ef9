//! Distance of a point to an outline (behaviour chapter 05, section 3.9).

use super::Vertices;
use crate::contact::Feature;
use crate::math::Vector2;
use crate::math::vector2::{distance, dot, length};

/// Distance of a point to edge `index`.
fn distance_to_edge(vertices: &Vertices, point: Vector2, index: usize) -> f32 {
    let edge = vertices.get_edge(index);
    let d = point - vertices[index];
    let c1 = dot(d, edge);
    if c1 < 0.0 {
        return length(d);
    }
    let c2 = dot(edge, edge);
    if c2 <= c1 {
        return distance(point, vertices[vertices.next_index(index)]);
    }
    distance(point, vertices[index] + edge * (c1 / c2))
}

/// The nearest point of edge `index` to a point in the same coordinates.
pub(crate) fn nearest_feature(vertices: &Vertices, point: Vector2, index: usize) -> Feature {
    let edge = vertices.get_edge(index);
    let c1 = dot(point - vertices[index], edge);
    let (position, normal) = if c1 < 0.0 {
        (vertices[index], vertices.get_vertex_normal(index))
    } else {
        let c2 = dot(edge, edge);
        if c2 <= c1 {
            let next = vertices.next_index(index);
            (vertices[next], vertices.get_vertex_normal(next))
        } else {
            (vertices[index] + edge * (c1 / c2), vertices.get_edge_normal(index))
        }
    };
    Feature { position, normal, distance: length(point - position) }
}

/// Signed distance of a point to an outline of at least one vertex, both in the same coordinates.
pub(crate) fn nearest_distance(vertices: &Vertices, point: Vector2) -> f32 {
    let mut best = f32::MAX;
    let mut best_index = 0;
    for index in 0..vertices.len() {
        let d = distance_to_edge(vertices, point, index);
        if d < best {
            best = d;
            best_index = index;
        }
    }
    let feature = nearest_feature(vertices, point, best_index);
    if dot(point - feature.position, feature.normal) < 0.0 { -feature.distance } else { feature.distance }
}
