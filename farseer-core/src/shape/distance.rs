//! Distance of a point to an outline (behaviour chapter 05, section 3.9).

use wide::f32x4;

use super::Vertices;
use crate::math::Vector2;
use crate::math::lanes::select;
use crate::math::vector2::{distance, dot, length};
use crate::shape::Feature;

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
    signed_distance(vertices, point, best_index)
}

/// The distance of a point to its nearest edge, negative inside.
fn signed_distance(vertices: &Vertices, point: Vector2, nearest: usize) -> f32 {
    let feature = nearest_feature(vertices, point, nearest);
    if dot(point - feature.position, feature.normal) < 0.0 { -feature.distance } else { feature.distance }
}

/// [`nearest_distance`] of four points in SIMD lanes, with the same bits.
pub(crate) fn nearest_distances(vertices: &Vertices, points: [Vector2; 4]) -> [f32; 4] {
    let (x, y) = (f32x4::new(points.map(|v| v.x)), f32x4::new(points.map(|v| v.y)));
    let mut best = f32x4::splat(f32::MAX);
    // Edge indices as bit patterns, which are only moved.
    let mut best_index = f32x4::ZERO;
    for index in 0..vertices.len() {
        let d = distances_to_edge(vertices, x, y, index);
        let is_nearer = d.simd_lt(best);
        best = select(is_nearer, d, best);
        best_index = select(is_nearer, f32x4::splat(f32::from_bits(index as u32)), best_index);
    }
    let nearest = best_index.to_array().map(|bits| bits.to_bits() as usize);
    std::array::from_fn(|i| signed_distance(vertices, points[i], nearest[i]))
}

/// [`distance_to_edge`] of four points: all three cases are computed, and one is selected for each point.
#[inline(always)]
fn distances_to_edge(vertices: &Vertices, x: f32x4, y: f32x4, index: usize) -> f32x4 {
    let (start, edge) = (vertices[index], vertices.get_edge(index));
    let end = vertices[vertices.next_index(index)];
    let c1 = (x - start.x) * edge.x + (y - start.y) * edge.y;
    let c2 = f32x4::splat(dot(edge, edge));
    let fraction = c1 / c2;
    let (is_before, is_behind) = (c1.simd_lt(f32x4::ZERO), c2.simd_le(c1));
    let nearest = |start: f32, edge: f32, end: f32| {
        let within = f32x4::splat(start) + fraction * edge;
        select(is_before, f32x4::splat(start), select(is_behind, f32x4::splat(end), within))
    };
    let dx = x - nearest(start.x, edge.x, end.x);
    let dy = y - nearest(start.y, edge.y, end.y);
    (dx * dx + dy * dy).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers of many magnitudes, zeros of both signs and numbers whose squares are infinite.
    fn number(seed: &mut u32) -> f32 {
        *seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        let fraction = (*seed >> 8) as f32 / (1 << 23) as f32 - 1.0;
        match *seed >> 28 {
            0 => 0.0,
            1 => -0.0,
            2 => fraction * 1e30,
            3 => fraction * 1e-30,
            4..8 => (fraction * 4.0).round(),
            _ => fraction * 100.0,
        }
    }

    #[test]
    fn simd_distances_equal_scalar_ones_bit_for_bit() {
        let mut seed = 1;
        let mut point = || Vector2::new(number(&mut seed), number(&mut seed));
        for round in 0..20_000 {
            let outline: Vertices = (0..1 + round % 9).map(|_| point()).collect();
            let points = [point(), point(), point(), point()];
            let expected = points.map(|point| nearest_distance(&outline, point));
            let bits = |numbers: [f32; 4]| {
                numbers.map(|number| if number.is_nan() { f32::NAN.to_bits() } else { number.to_bits() })
            };
            assert_eq!(bits(nearest_distances(&outline, points)), bits(expected), "round {round}");
        }
    }
}
