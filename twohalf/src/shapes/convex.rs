//! An outline as convex pieces, which is what the separating axes work on.
//!
//! Frame: the geom's own while they are made, the plane's once they are laid out. Pieces are in the engine's winding
//! (negative shoelace area), without repeated vertices and without vertices within a straight edge.

use farseer_core::Vertices;
use farseer_core::math::{Matrix, Vector2, vector2};

use super::{cross64, doubled_area, edges};

/// The sine of a turn that counts as none.
const STRAIGHT: f64 = 1e-6;

/// The most pieces the core's decomposition gives.
const MAX_PIECES: i32 = 50;

/// How much of the area of the outline a decomposition may lose or count twice.
const AREA_TOLERANCE: f32 = 1e-3;

/// The convex pieces of an outline.
#[derive(Debug, Clone, Default)]
pub(crate) struct ConvexPieces {
    vertices: Vec<Vector2>,
    /// Where each piece ends among the vertices.
    ends: Vec<usize>,
}

impl ConvexPieces {
    /// The outline itself if it is convex, else its convex decomposition, else, if that fails, its convex hull.
    pub(crate) fn new(outline: &Vertices) -> ConvexPieces {
        let mut pieces = ConvexPieces::default();
        if is_convex(outline) {
            pieces.push(outline);
            return pieces;
        }
        let decomposed = outline.decompose(MAX_PIECES).unwrap_or_default();
        if covers(&decomposed, outline) {
            decomposed.iter().for_each(|piece| pieces.push(piece));
        } else {
            pieces.push(&convex_hull(outline));
        }
        pieces
    }

    fn push(&mut self, piece: &[Vector2]) {
        let start = self.vertices.len();
        self.vertices.extend(without_straight_vertices(piece));
        if doubled_area(piece) > 0.0 {
            self.vertices[start..].reverse();
        }
        self.ends.push(self.vertices.len());
    }

    /// Replaces `out` by the vertices of all pieces, put into the plane by a matrix.
    pub(crate) fn lay_out(&self, matrix: &Matrix, out: &mut Vec<Vector2>) {
        out.clear();
        out.extend(self.vertices.iter().map(|vertex| vector2::transform(*vertex, matrix)));
    }

    /// The pieces among the vertices that [`ConvexPieces::lay_out`] has given.
    pub(crate) fn pieces<'a>(
        &'a self,
        laid_out: &'a [Vector2],
    ) -> impl Iterator<Item = &'a [Vector2]> + Clone {
        let starts = std::iter::once(0).chain(self.ends.iter().copied());
        starts.zip(&self.ends).filter_map(|(start, end)| laid_out.get(start..*end))
    }
}

/// Whether an outline is convex: all its corners turn the same way, once around. Corners that hardly turn, repeated
/// vertices and either winding are allowed; fewer than three vertices are convex.
pub(crate) fn is_convex(outline: &[Vector2]) -> bool {
    let (mut left, mut right, mut halves) = (false, false, 0);
    let steps = || edges(outline).filter(|(a, b)| a != b);
    let Some(last) = steps().last() else { return true };
    let mut before = last;
    for edge in steps() {
        let turn = turn(before.0, before.1, edge.1);
        left |= turn < -STRAIGHT;
        right |= turn > STRAIGHT;
        halves += i32::from(points_down(before) != points_down(edge));
        before = edge;
    }
    !(left && right) && halves <= 2
}

/// Which half of all directions an edge has.
fn points_down((a, b): (Vector2, Vector2)) -> bool {
    b.y > a.y || (b.y == a.y && b.x > a.x)
}

/// The sine of the turn at `b` on the way from `a` to `c`; 0 if two are the same.
fn turn(a: Vector2, b: Vector2, c: Vector2) -> f64 {
    let scale = f64::from(vector2::distance(a, b)) * f64::from(vector2::distance(b, c));
    if scale > 0.0 { cross64(a, b, c) / scale } else { 0.0 }
}

/// The vertices of a convex outline at which it turns, and at least one.
fn without_straight_vertices(outline: &[Vector2]) -> Vec<Vector2> {
    let mut kept: Vec<Vector2> = Vec::with_capacity(outline.len());
    for (i, &vertex) in outline.iter().enumerate() {
        let Some(&before) = kept.last().or(outline.last()) else { continue };
        let after = outline[i + 1..].iter().chain(&kept).find(|other| **other != vertex);
        let Some(&after) = after else { continue };
        let goes_on = vector2::dot(vertex - before, after - vertex) >= 0.0;
        if !(goes_on && turn(before, vertex, after).abs() <= STRAIGHT) {
            kept.push(vertex);
        }
    }
    if kept.is_empty() {
        kept.extend(outline.first());
    }
    kept
}

/// Whether pieces are convex and have as much area as the outline.
fn covers(pieces: &[Vertices], outline: &[Vector2]) -> bool {
    let area = doubled_area(outline).abs();
    let sum: f32 = pieces.iter().map(|piece| doubled_area(piece).abs()).sum();
    (sum - area).abs() <= AREA_TOLERANCE * area && pieces.iter().all(|piece| is_convex(piece))
}

/// The convex hull of any points, by Andrew's monotone chain.
fn convex_hull(points: &[Vector2]) -> Vec<Vector2> {
    let mut sorted: Vec<Vector2> = points.to_vec();
    sorted.sort_unstable_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    let mut hull: Vec<Vector2> = Vec::with_capacity(sorted.len() + 1);
    add_chain(&mut hull, sorted.iter());
    add_chain(&mut hull, sorted.iter().rev());
    hull
}

/// Adds the side of a hull that a walk over sorted points turns around, without its last point.
fn add_chain<'a>(hull: &mut Vec<Vector2>, walk: impl Iterator<Item = &'a Vector2>) {
    let start = hull.len();
    for &point in walk {
        while let [.., a, b] = hull[start..]
            && cross64(a, b, point) <= 0.0
        {
            hull.pop();
        }
        hull.push(point);
    }
    hull.pop();
}
