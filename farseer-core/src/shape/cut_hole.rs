//! Cutting a hole: an outline with a hole becomes one outline by a bridge (behaviour chapter 15, section 15.3.2).

use super::ear_clipping::{indexable, is_convex, is_inside};
use super::{Vertices, WindingOrder};
use crate::error::Result;
use crate::math::finite::finite_vertices;
use crate::math::{Vector2, math_helper, scalar, vector2};

/// A vertex with its 16-bit index; the original compares both.
#[derive(Debug, Clone, Copy, PartialEq)]
struct RingVertex {
    point: Vector2,
    index: u16,
}

fn ring_of(points: &[Vector2], first_index: usize) -> Vec<RingVertex> {
    let vertex = |(i, &point)| RingVertex { point, index: (i + first_index) as u16 };
    points.iter().enumerate().map(vertex).collect()
}

impl Vertices {
    /// This outline with a hole in it, joined to one outline by a bridge, an edge in both directions: two vertices more
    /// than both lists have. [`Vertices::triangulate`] accepts the result, and further holes can be cut into it. If no
    /// edge lies to the right of the hole, the shape is returned without it.
    ///
    /// The shape is counter-clockwise afterwards and the hole clockwise, as [`Vertices::determine_winding_order`] sees
    /// it. The original also writes to the standard output.
    ///
    /// # Errors
    /// When a list is empty or a vertex is not finite, or for more than 65,536 vertices in all.
    #[doc(alias = "CutHoleInShape")]
    pub fn cut_hole_in_shape(&self, hole: &Vertices) -> Result<Vertices> {
        indexable("hole", self.len() + hole.len())?;
        finite_vertices("self", self)?;
        finite_vertices("hole", hole)?;
        let shape = self.ensure_winding_order(WindingOrder::CounterClockwise)?;
        let hole = hole.ensure_winding_order(WindingOrder::Clockwise)?;
        let mut ring = ring_of(&shape, 0);
        let hole = ring_of(&hole, shape.len());

        let rightmost =
            (1..hole.len()).fold(0, |best, i| if hole[i].point.x > hole[best].point.x { i } else { best });
        let Some(anchor) = bridge_end(&ring, hole[rightmost]) else {
            return Ok(shape);
        };
        let around_hole = hole[rightmost..].iter().chain(&hole[..=rightmost]).copied();
        let bridge: Vec<RingVertex> = around_hole.chain([ring[anchor]]).collect();
        ring.splice(anchor + 1..anchor + 1, bridge);
        Ok(ring.into_iter().map(|vertex| vertex.point).collect())
    }
}

/// The vertex of the outer ring, to the right of a vertex of the hole, that is visible from it.
fn bridge_end(ring: &[RingVertex], from: RingVertex) -> Option<usize> {
    let (segment, distance) = nearest_edge_to_the_right(ring, from.point)?;
    let hit = RingVertex { point: from.point + vector2::UNIT_X * distance, index: 1 };
    let [a, b] = segment.map(|i| ring[i]);
    let mut end = if a.point.x > b.point.x { a } else { b };

    // A corner between the two is nearer; the one closest to the horizontal is visible.
    let triangle = [from, hit, end];
    let points = triangle.map(|corner| corner.point);
    let mut best = -1.0;
    for (i, &vertex) in ring.iter().enumerate() {
        let (before, after) = (ring[(i + ring.len() - 1) % ring.len()], ring[(i + 1) % ring.len()]);
        let reflex = !is_convex(before.point, vertex.point, after.point);
        if reflex && (triangle.contains(&vertex) || is_inside(points, vertex.point)) {
            let along = vector2::dot(vector2::UNIT_X, vector2::normalize(vertex.point - from.point));
            if along > best {
                best = along;
                end = vertex;
            }
        }
    }
    ring.iter().position(|vertex| *vertex == end)
}

/// The first edge that a ray to the right meets, as the indices of its ends, and its distance.
fn nearest_edge_to_the_right(ring: &[RingVertex], from: Vector2) -> Option<([usize; 2], f32)> {
    let mut nearest: Option<([usize; 2], f32)> = None;
    for i in 0..ring.len() {
        let next = if i + 1 == ring.len() { 0 } else { i + 1 };
        let (a, b) = (ring[i].point, ring[next].point);
        let to_the_right = a.x > from.x || b.x > from.x;
        let across = (a.y >= from.y && b.y <= from.y) || (a.y <= from.y && b.y >= from.y);
        if !to_the_right || !across {
            continue;
        }
        let reach = scalar::max(a.x - from.x, b.x - from.x) * 2.0;
        let Some(hit) = segment_intersection([a, b], [from, from + vector2::UNIT_X * reach]) else {
            continue;
        };
        let distance = vector2::distance(from, hit);
        if nearest.is_none_or(|(_, best)| best > distance) {
            nearest = Some(([i, next], distance));
        }
    }
    nearest
}

/// Intersection of two segments, computed along the first; their ends are included.
fn segment_intersection([a, b]: [Vector2; 2], [c, d]: [Vector2; 2]) -> Option<Vector2> {
    let denominator = (d.y - c.y) * (b.x - a.x) - (d.x - c.x) * (b.y - a.y);
    let along_first = ((d.x - c.x) * (a.y - c.y) - (d.y - c.y) * (a.x - c.x)) / denominator;
    let along_second = ((b.x - a.x) * (a.y - c.y) - (b.y - a.y) * (a.x - c.x)) / denominator;
    let on_segment = |t: f32| math_helper::clamp(t, 0.0, 1.0) == t;
    (on_segment(along_first) && on_segment(along_second)).then(|| a + (b - a) * along_first)
}
