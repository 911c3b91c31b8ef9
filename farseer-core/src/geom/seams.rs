//! Edges that other edges go on from: those of chains, and those of the convex parts of a concave outline.
//!
//! What slides along several pieces must not catch on where they meet. So an edge inside of an outline pushes nothing, and
//! every other one knows the normals of the edges before and after it along the outline.

use crate::geom::pieces::Piece;
use crate::math::Vector2;
use crate::math::plane::{Turn, Vector, turn};

/// What an edge of a piece is of the whole outline.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Seam {
    /// It lies inside of the outline.
    pub(crate) is_inner: bool,
    /// The normals of the edges of the outline before and after it.
    pub(crate) neighbours: [Vector; 2],
}

impl Seam {
    /// An edge that pushes nothing.
    pub(crate) const INNER: Self = Seam { is_inner: true, neighbours: [[0.0; 2]; 2] };

    pub(crate) fn turned(self, q: Turn) -> Self {
        Seam { neighbours: self.neighbours.map(|normal| turn(q, normal)), ..self }
    }
}

/// The unit normal of an edge on the side from which the corners of an outline of positive area go round clockwise on a
/// screen with y down: its outside. In `f64` the squared length of no edge of `f32` numbers overflows or underflows.
pub(crate) fn normal([ax, ay]: Vector, [bx, by]: Vector) -> Vector {
    let (x, y) = (f64::from(bx) - f64::from(ax), f64::from(by) - f64::from(ay));
    let length = (x * x + y * y).sqrt();
    [(y / length) as f32, (-x / length) as f32]
}

/// The edges of a chain. At its open ends it goes on as if it turned away from what is on its free side, by a right angle.
pub(crate) fn edges_of_chain(points: &[Vector2], is_closed: bool) -> impl Iterator<Item = Piece> {
    let points: Vec<Vector> = points.iter().map(|v| [v.x, v.y]).collect();
    let count = if is_closed { points.len() } else { points.len() - 1 };
    let ends = move |edge: usize| [points[edge], points[(edge + 1) % points.len()]];
    let normals: Vec<Vector> = (0..count).map(&ends).map(|[a, b]| normal(a, b)).collect();
    (0..count).map(move |edge| {
        let [x, y] = normals[edge];
        let (has_before, has_after) = (is_closed || edge > 0, is_closed || edge + 1 < count);
        let before = if has_before { normals[(edge + count - 1) % count] } else { [y, -x] };
        let after = if has_after { normals[(edge + 1) % count] } else { [-y, x] };
        let seam = Seam { is_inner: false, neighbours: [before, after] };
        Piece::Edge { ends: ends(edge), normal: [x, y], seam }
    })
}

/// What the edges of a convex part are of an outline; the part by numbers of corners, in the order in which the outline has
/// them.
pub(crate) fn seams_of_part(part: &[usize], outline: &[Vector]) -> Vec<Seam> {
    let count = outline.len();
    let next = |at: usize| part[(at + 1) % part.len()];
    let is_of_outline = |at: usize| (part[at] + 1) % count == next(at);
    (0..part.len()).map(|at| if is_of_outline(at) { seam(part[at], outline) } else { Seam::INNER }).collect()
}

/// Of an edge of the outline.
fn seam(edge: usize, outline: &[Vector]) -> Seam {
    let count = outline.len();
    let [start, end] = [outline[edge], outline[(edge + 1) % count]];
    if is_bridge([start, end], outline) {
        return Seam::INNER;
    }
    let own = normal(start, end);
    let before = neighbour(start, outline, edge + count - 1, |[_, end]| end);
    let after = neighbour(end, outline, edge + 1, |[start, _]| start);
    Seam { is_inner: false, neighbours: [before, after].map(|normal| normal.unwrap_or(own)) }
}

/// The normal of the edge that goes on at a corner: an edge of that number, or if it is a bridge another one that has its
/// end there.
fn neighbour(
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

/// A way to a hole and back again: the same edge in both directions.
fn is_bridge([start, end]: [Vector; 2], outline: &[Vector]) -> bool {
    let count = outline.len();
    (0..count).any(|at| outline[at] == end && outline[(at + 1) % count] == start)
}
