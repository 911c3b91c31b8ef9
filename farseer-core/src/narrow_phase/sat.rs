//! Narrow phase by separating axes (behaviour chapter 07). It works on world vertices and is meaningful for convex
//! outlines only.

use wide::f32x4;

use crate::contacts::contact::{Contact, ContactId};
use crate::geom::entry::GeomEntry;
use crate::math::lanes::select;
use crate::math::vector2::{dot, length, normalize};
use crate::math::{Vector2, scalar};
use crate::shape::Vertices;

/// Minimum penetration of a contact, in length units: shallower overlaps make none. Farseer's value.
const MIN_DEPTH: f32 = 0.001;

/// Minimum translation that separates two outlines: unit axis from the second outline toward the first, times the
/// depth.
struct Overlap {
    translation: Vector2,
    /// Index of the edge with that axis; the edges of the first outline come first.
    edge: usize,
}

#[inline(always)]
fn edge_axis(vertices: &Vertices, index: usize) -> Vector2 {
    let edge = vertices.get_edge(index);
    normalize(Vector2::new(-edge.y, edge.x))
}

/// Minimum and maximum of an outline's projections on each of four axes.
#[inline(always)]
fn project(vertices: &[Vector2], x: f32x4, y: f32x4) -> (f32x4, f32x4) {
    let along = |v: Vector2| x * v.x + y * v.y;
    let first = along(vertices[0]);
    let (mut min, mut max) = (first, first);
    for &vertex in vertices {
        let d = along(vertex);
        min = select(d.simd_lt(min), d, min);
        max = select(d.simd_gt(max), d, max);
    }
    (min, max)
}

/// Separation of two outlines along each of four axes, in length units; negative if they overlap.
#[inline(always)]
fn separations(a: &Vertices, b: &Vertices, axes: [Vector2; 4]) -> f32x4 {
    let (x, y) = (f32x4::new(axes.map(|v| v.x)), f32x4::new(axes.map(|v| v.y)));
    let (min_a, max_a) = project(a, x, y);
    let (min_b, max_b) = project(b, x, y);
    select(min_a.simd_lt(min_b), min_b - max_a, min_a - max_b)
}

/// The axis of least overlap, or `None` if some axis separates the outlines. It tests four axes at a time: the result
/// does not depend on which of them separates.
fn find_overlap(a: &Vertices, b: &Vertices) -> Option<Overlap> {
    let mut best = f32::INFINITY;
    let mut separation_axis = Vector2::zeros();
    let mut edge = 0;
    let mut centroid_offset = None;
    let count = a.len() + b.len();
    for first in (0..count).step_by(4) {
        // Lanes beyond the last edge repeat it, and are never better than it.
        let edges: [usize; 4] = std::array::from_fn(|i| (first + i).min(count - 1));
        let axes = edges.map(|k| if k < a.len() { edge_axis(a, k) } else { edge_axis(b, k - a.len()) });
        let gaps = separations(a, b, axes);
        if gaps.simd_gt(f32x4::ZERO).any() {
            return None;
        }
        for (k, depth) in edges.into_iter().zip(gaps.abs().to_array()) {
            if depth < best {
                best = depth;
                let axis = axes[k - first];
                let d = *centroid_offset.get_or_insert_with(|| a.get_centroid() - b.get_centroid());
                separation_axis = if dot(d, axis) < 0.0 { -axis } else { axis };
                edge = k;
            }
        }
    }
    Some(Overlap { translation: separation_axis * best, edge })
}

/// Appends the contacts of two geoms.
pub(crate) fn collide(a: &GeomEntry, b: &GeomEntry, max_contacts: i32, contacts: &mut Vec<Contact>) {
    let (vertices_a, vertices_b) = (&a.world_vertices, &b.world_vertices);
    let Some(overlap) = find_overlap(vertices_a, vertices_b) else { return };
    let depth = length(overlap.translation);
    let normal = normalize(-overlap.translation);
    // An overlap that is not finite makes no contact either.
    if !depth.is_finite() || depth <= MIN_DEPTH {
        return;
    }
    let before = contacts.len();
    collide_vertices(a, b, normal, depth, max_contacts, contacts);
    collide_vertices(b, a, normal, depth, max_contacts, contacts);
    if contacts.len() == before {
        contacts.push(crossing_contact(a, b, overlap.edge, normal, depth));
    }
}

/// Contacts of the vertices of one geom that lie in the other. As in the original, one contact more than the limit
/// passes.
fn collide_vertices(
    owner: &GeomEntry,
    other: &GeomEntry,
    normal: Vector2,
    depth: f32,
    max_contacts: i32,
    contacts: &mut Vec<Contact>,
) {
    let mut count = 0;
    for (i, &vertex) in owner.world_vertices.iter().enumerate() {
        if count > max_contacts {
            return;
        }
        if contains(&other.world_vertices, vertex) {
            let id = ContactId { geom1: owner.number, vertex: i as i32, geom2: other.number };
            contacts.push(Contact::new(vertex, normal, -depth, id));
            count += 1;
        }
    }
}

/// The contact of outlines that cross without a vertex in the other: the vertex deepest behind the best edge.
fn crossing_contact(a: &GeomEntry, b: &GeomEntry, edge: usize, normal: Vector2, depth: f32) -> Contact {
    let count_a = a.world_vertices.len();
    let (owner, other, index) = if edge < count_a { (a, b, edge) } else { (b, a, edge - count_a) };
    let axis = edge_axis(&owner.world_vertices, index);
    let mut lowest = dot(axis, other.world_vertices[0]);
    let mut vertex = 0;
    for (i, &position) in other.world_vertices.iter().enumerate().skip(1) {
        let d = dot(axis, position);
        if d < lowest {
            lowest = d;
            vertex = i;
        }
    }
    let id = ContactId { geom1: other.number, vertex: vertex as i32, geom2: owner.number };
    Contact::new(other.world_vertices[vertex], normal, -depth, id)
}

/// Whether a point lies in an outline, both in the same coordinates. Points on a right or lower (larger y) edge count
/// as inside, points on a left or upper edge do not.
pub(crate) fn contains(vertices: &Vertices, point: Vector2) -> bool {
    let Some(&first) = vertices.first() else { return false };
    let mut inside = false;
    let mut p1 = first;
    for i in 1..=vertices.len() {
        let p2 = if i == vertices.len() { first } else { vertices[i] };
        if point.y > scalar::min(p1.y, p2.y)
            && point.y <= scalar::max(p1.y, p2.y)
            && point.x <= scalar::max(p1.x, p2.x)
            && p1.y != p2.y
        {
            let x = (point.y - p1.y) * (p2.x - p1.x) / (p2.y - p1.y) + p1.x;
            if p1.x == p2.x || point.x <= x {
                inside = !inside;
            }
        }
        p1 = p2;
    }
    inside
}
