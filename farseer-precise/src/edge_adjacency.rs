//! Adjacency of edges that continue in other pieces: edges of chains, and of the convex parts of a concave outline.
//!
//! Shapes that slide over several pieces must not catch on the seams, where pieces meet (ghost collisions). So an edge
//! inside of an outline makes no contact, and every other edge stores the normals of the edges before and after it
//! along the outline.

use crate::math::plane::{Rot, Vector, rotate};

/// The place of a piece's edge in the whole outline.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Seam {
    /// Whether the edge lies inside of the outline.
    pub(crate) is_internal: bool,
    /// The normals of the outline's edges before and after it.
    pub(crate) neighbours: [Vector; 2],
}

impl Seam {
    /// An edge inside of the outline, which makes no contact.
    pub(crate) const INTERNAL: Self = Seam { is_internal: true, neighbours: [[0.0; 2]; 2] };

    /// Adjacency of the same edge, rotated by `q`.
    pub fn rotated(self, q: Rot) -> Self {
        Seam { neighbours: self.neighbours.map(|normal| rotate(q, normal)), ..self }
    }
}

/// Outward unit normal of the edge from a to b. An outline of positive area has its corners clockwise on a screen with
/// y down. In `f64` the squared length of no edge of `f32` numbers overflows or underflows.
pub(crate) fn normal([ax, ay]: Vector, [bx, by]: Vector) -> Vector {
    let (x, y) = (f64::from(bx) - f64::from(ax), f64::from(by) - f64::from(ay));
    let length = (x * x + y * y).sqrt();
    [(y / length) as f32, (-x / length) as f32]
}

/// Adjacency of the edges of a convex part. The part is given by corner indices, in the order of the outline.
pub(crate) fn seams_of_part(part: &[usize], outline: &[Vector]) -> Vec<Seam> {
    let count = outline.len();
    let next = |at: usize| part[(at + 1) % part.len()];
    let is_of_outline = |at: usize| (part[at] + 1) % count == next(at);
    (0..part.len())
        .map(|at| if is_of_outline(at) { seam(part[at], outline) } else { Seam::INTERNAL })
        .collect()
}

/// Adjacency of an edge of the outline.
fn seam(edge: usize, outline: &[Vector]) -> Seam {
    let count = outline.len();
    let [start, end] = [outline[edge], outline[(edge + 1) % count]];
    if is_bridge([start, end], outline) {
        return Seam::INTERNAL;
    }
    let own = normal(start, end);
    let before = neighbour_normal(start, outline, edge + count - 1, |[_, end]| end);
    let after = neighbour_normal(end, outline, edge + 1, |[start, _]| start);
    Seam { is_internal: false, neighbours: [before, after].map(|normal| normal.unwrap_or(own)) }
}

/// Normal of the edge that continues at a corner: of edge `first`, or if that is a bridge, of another one that ends
/// there.
fn neighbour_normal(
    corner: Vector,
    outline: &[Vector],
    first: usize,
    end_of: fn([Vector; 2]) -> Vector,
) -> Option<Vector> {
    let count = outline.len();
    (0..count)
        .map(|step| [outline[(first + step) % count], outline[(first + step + 1) % count]])
        .find(|&edge| end_of(edge) == corner && !is_bridge(edge, outline))
        .map(|[a, b]| normal(a, b))
}

/// Whether an edge is half of a bridge to a hole: the outline has the same edge in both directions.
fn is_bridge([start, end]: [Vector; 2], outline: &[Vector]) -> bool {
    let count = outline.len();
    (0..count).any(|at| outline[at] == end && outline[(at + 1) % count] == start)
}
