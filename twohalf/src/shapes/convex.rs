//! Convex decomposition of outlines, for the separating axis test.
//!
//! Frame: that of the geom for new pieces, that of the plane after the transformation. Pieces have the core's winding (negative
//! shoelace area), without repeated vertices and without vertices inside a straight edge.
//!
//! Ear clipping cuts a concave outline into triangles, which are joined as long as they stay convex (Hertel
//! and Mehlhorn, *Fast Triangulation of Simple Polygons*, 1983). The core's decomposition is not used.
//! Faithful to the original, it removes corners of up to a degree, and refuses outlines of more than 177
//! vertices.

use farseer_core::Vertices;
use farseer_core::math::{Matrix, Vector2, vector2};
use farseer_precise::storage::order::{
    packed_key as joined_bits, sort_by_number, sort_numbered, total_order_key,
};

use super::{cross64, doubled_area, edges};

/// Sine of the greatest turn of a straight vertex, dimensionless.
const MAX_STRAIGHT_SINE: f64 = 1e-6;

/// Convex pieces of an outline.
#[derive(Debug, Clone, Default)]
pub(crate) struct ConvexPieces {
    vertices: Vec<Vector2>,
    /// End of each piece, as an index into the vertices.
    ends: Vec<usize>,
}

impl ConvexPieces {
    /// Returns the pieces of an outline: the outline itself if it is convex, else a convex decomposition. An outline that
    /// crosses itself has no decomposition and becomes its convex hull.
    pub(crate) fn new(outline: &Vertices) -> ConvexPieces {
        let mut pieces = ConvexPieces::default();
        if is_convex(outline) {
            pieces.push(outline);
        } else if let Some(parts) = decompose(outline) {
            parts.iter().for_each(|part| pieces.push(part));
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

    /// Replaces `out` by the vertices of all pieces, transformed into the plane by a matrix.
    pub(crate) fn transform_into(&self, matrix: &Matrix, out: &mut Vec<Vector2>) {
        out.clear();
        out.extend(self.vertices.iter().map(|vertex| vector2::transform(*vertex, matrix)));
    }

    /// Iterates over the pieces in the vertex list that [`ConvexPieces::transform_into`] has filled.
    pub(crate) fn pieces<'a>(
        &'a self,
        transformed: &'a [Vector2],
    ) -> impl Iterator<Item = &'a [Vector2]> + Clone {
        let starts = std::iter::once(0).chain(self.ends.iter().copied());
        starts.zip(&self.ends).filter_map(|(start, end)| transformed.get(start..*end))
    }
}

/// Returns whether an outline is convex: all its vertices turn the same way, once around. Straight and repeated vertices and
/// either winding are allowed. Fewer than three vertices are convex.
pub(crate) fn is_convex(outline: &[Vector2]) -> bool {
    let (mut left, mut right, mut halves) = (false, false, 0);
    let steps = || edges(outline).filter(|(a, b)| a != b);
    let Some(last) = steps().last() else { return true };
    let mut before = last;
    for edge in steps() {
        let turn = turn(before.0, before.1, edge.1);
        left |= turn < -MAX_STRAIGHT_SINE;
        right |= turn > MAX_STRAIGHT_SINE;
        halves += i32::from(points_down(before) != points_down(edge));
        before = edge;
    }
    !(left && right) && halves <= 2
}

/// Returns whether the edge from `a` to `b` points down on the screen, or level to the right: one of two half planes of
/// directions.
fn points_down((a, b): (Vector2, Vector2)) -> bool {
    b.y > a.y || (b.y == a.y && b.x > a.x)
}

/// Sine of the turn at `b` on the path from `a` to `c`, dimensionless; 0 if two points are equal.
fn turn(a: Vector2, b: Vector2, c: Vector2) -> f64 {
    let scale = f64::from(vector2::distance(a, b)) * f64::from(vector2::distance(b, c));
    if scale > 0.0 { cross64(a, b, c) / scale } else { 0.0 }
}

/// The vertices of an outline that are not straight, and at least one.
fn without_straight_vertices(outline: &[Vector2]) -> Vec<Vector2> {
    let mut kept: Vec<Vector2> = Vec::with_capacity(outline.len());
    for (i, &vertex) in outline.iter().enumerate() {
        let Some(&before) = kept.last().or(outline.last()) else { continue };
        let after = outline[i + 1..].iter().chain(&kept).find(|other| **other != vertex);
        let Some(&after) = after else { continue };
        let goes_on = vector2::dot(vertex - before, after - vertex) >= 0.0;
        if !(goes_on && turn(before, vertex, after).abs() <= MAX_STRAIGHT_SINE) {
            kept.push(vertex);
        }
    }
    if kept.is_empty() {
        kept.extend(outline.first());
    }
    kept
}

/// Convex decomposition of an outline; `None` if there is no ear at some point, or no area.
fn decompose(outline: &[Vector2]) -> Option<Vec<Vec<Vector2>>> {
    let mut rest = without_straight_vertices(outline);
    if doubled_area(&rest) > 0.0 {
        rest.reverse();
    }
    let mut pieces: Vec<Vec<Vector2>> = Vec::with_capacity(rest.len());
    let mut ears = Ears::new(rest);
    while ears.rest.len() >= 3 {
        let [before, tip, after] = ears.cut()?;
        // A vertex that has become straight is removed without a triangle.
        if cross64(before, tip, after) < 0.0 {
            pieces.push(vec![before, tip, after]);
        }
    }
    join(&mut pieces);
    (!pieces.is_empty()).then_some(pieces)
}

/// Ear clipping: the rest of an outline in the core's winding.
struct Ears {
    vertices: Vec<Vector2>,
    /// Indices of the remaining vertices, in order.
    rest: Vec<usize>,
    is_left: Vec<bool>,
    /// By vertex: another vertex inside of its triangle at the last ear test. While that vertex remains and the neighbours are
    /// the same, the test is not repeated.
    blocking_vertex: Vec<Option<usize>>,
    /// Index in the rest from which the next ear is searched.
    start: usize,
}

impl Ears {
    fn new(vertices: Vec<Vector2>) -> Self {
        let count = vertices.len();
        Ears {
            vertices,
            rest: (0..count).collect(),
            is_left: vec![true; count],
            blocking_vertex: vec![None; count],
            start: 0,
        }
    }

    /// Cuts the next ear off and returns its corners, the tip in the middle; `None` if there is no ear.
    fn cut(&mut self) -> Option<[Vector2; 3]> {
        let count = self.rest.len();
        let start = self.start;
        let ear = (0..count).map(|i| (start + i) % count).find(|&place| self.is_ear(place))?;
        let [before, tip, after] = self.corners(ear);
        self.is_left[tip] = false;
        self.blocking_vertex[before] = None;
        self.blocking_vertex[after] = None;
        self.rest.remove(ear);
        // The next but one, so that the triangles do not all meet in one corner.
        self.start = ear + 1;
        Some([before, tip, after].map(|i| self.vertices[i]))
    }

    /// Returns the indices of a remaining vertex and its two remaining neighbours, the vertex in the middle.
    fn corners(&self, place: usize) -> [usize; 3] {
        let last = self.rest.len() - 1;
        let before = if place == 0 { last } else { place - 1 };
        let after = if place == last { 0 } else { place + 1 };
        [before, place, after].map(|place| self.rest[place])
    }

    /// Returns whether a vertex is an ear: it is not reflex, and its triangle contains no other vertex.
    fn is_ear(&mut self, place: usize) -> bool {
        let corners = self.corners(place);
        if self.blocking_vertex[corners[1]].is_some_and(|i| self.is_left[i]) {
            return false;
        }
        let [before, tip, after] = corners.map(|i| self.vertices[i]);
        let side = cross64(before, tip, after);
        if side >= 0.0 {
            return side == 0.0;
        }
        let is_corner = |point: Vector2| point == before || point == tip || point == after;
        let is_in_triangle = |point: Vector2| {
            cross64(before, tip, point) <= 0.0
                && cross64(tip, after, point) <= 0.0
                && cross64(after, before, point) <= 0.0
        };
        let blocks = |&i: &usize| is_in_triangle(self.vertices[i]) && !is_corner(self.vertices[i]);
        let blocking_vertex = self.rest.iter().copied().find(blocks);
        self.blocking_vertex[corners[1]] = blocking_vertex;
        blocking_vertex.is_none()
    }
}

/// Joins pieces along common edges as long as the result is convex. Each piece in turn is joined with the
/// first possible one behind it.
fn join(pieces: &mut Vec<Vec<Vector2>>) {
    let owners = EdgeOwners::of(pieces);
    let mut i = 0;
    while i < pieces.len() {
        let mut neighbours: Vec<u32> = owners.across(&pieces[i]).filter(|&j| j as usize > i).collect();
        neighbours.sort_unstable();
        let mut neighbours = neighbours.into_iter().map(|j| j as usize);
        let other = neighbours.find_map(|j| Some((j, joined(&pieces[i], &pieces[j])?)));
        if let Some((j, joined)) = other {
            pieces[i] = joined;
            pieces[j].clear();
        } else {
            i += 1;
        }
    }
    pieces.retain(|piece| !piece.is_empty());
}

/// Edges with their pieces, sorted by edge. Edges that a piece takes over from a later piece have no entry, since no earlier
/// piece is joined with it any more.
struct EdgeOwners(Vec<(u128, u32)>);

impl EdgeOwners {
    fn of(pieces: &[Vec<Vector2>]) -> Self {
        let mut owners = Vec::new();
        for (piece, owner) in pieces.iter().zip(0..) {
            owners.extend(edges(piece).map(|(start, end)| (edge_key(start, end), owner)));
        }
        sort_numbered(&mut owners);
        EdgeOwners(owners)
    }

    /// Iterates over the pieces on the other side of the edges of a piece.
    fn across(&self, piece: &[Vector2]) -> impl Iterator<Item = u32> {
        edges(piece).flat_map(|(start, end)| {
            let key = edge_key(end, start);
            let first = self.0.partition_point(|&(other, _)| other < key);
            let of_edge = self.0[first..].iter().take_while(move |(other, _)| *other == key);
            of_edge.map(|&(_, owner)| owner)
        })
    }
}

/// Key that is equal for equal edges; adding zero makes both zeros one.
fn edge_key(start: Vector2, end: Vector2) -> u128 {
    joined_bits([start.x, start.y, end.x, end.y].map(|number| (number + 0.0).to_bits()))
}

/// Returns the union of two pieces; `None` if they have no common edge or the union is not convex.
fn joined(a: &[Vector2], b: &[Vector2]) -> Option<Vec<Vector2>> {
    let (i, j) = edges(a).enumerate().find_map(|(i, (start, end))| {
        let j = edges(b).position(|edge| edge == (end, start))?;
        Some((i, j))
    })?;
    // From the end of the common edge around a, then from its other end around b.
    let around_a = a.iter().cycle().skip(i + 1).take(a.len());
    let around_b = b.iter().cycle().skip(j + 2).take(b.len() - 2);
    let joined: Vec<Vector2> = around_a.chain(around_b).copied().collect();
    is_convex(&joined).then_some(joined)
}

/// Convex hull of points by the monotone chain (A. Andrew, "Another efficient algorithm for convex hulls in
/// two dimensions", 1979).
fn convex_hull(points: &[Vector2]) -> Vec<Vector2> {
    let mut sorted: Vec<Vector2> = points.to_vec();
    sort_by_number(&mut sorted, |point| joined_bits([point.x, point.y].map(total_order_key)));
    let mut hull: Vec<Vector2> = Vec::with_capacity(sorted.len() + 1);
    add_chain(&mut hull, sorted.iter());
    add_chain(&mut hull, sorted.iter().rev());
    hull
}

/// Adds one chain of a hull from sorted points, without its last point.
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

#[cfg(test)]
mod tests {
    use super::super::samples::{Random, points, rectangle, winds_around};
    use super::*;
    use farseer_core::math::matrix;

    fn pieces_of(outline: &[Vector2]) -> Vec<Vec<Vector2>> {
        let pieces = ConvexPieces::new(&Vertices::from(outline));
        let mut transformed = vec![Vector2::new(9.0, 9.0)];
        pieces.transform_into(&Matrix::identity(), &mut transformed);
        pieces.pieces(&transformed).map(<[Vector2]>::to_vec).collect()
    }

    #[test]
    fn rectangles_and_circles_are_convex_in_either_winding() {
        let circle = Vertices::create_circle(30.0, 500).expect("a circle");
        let mut outline = rectangle((300.0, 20.0), 30.0, 4.0, 0.3);
        assert!(is_convex(&circle) && is_convex(&outline));
        outline.reverse();
        assert!(is_convex(&outline));
    }

    #[test]
    fn a_rectangle_with_vertices_within_its_edges_is_convex() {
        let outline = Vertices::create_rectangle(30.0, 7.1).expect("a rectangle");
        assert!(outline.len() > 4 && is_convex(&outline));
    }

    #[test]
    fn a_dent_is_not_convex() {
        assert!(!is_convex(&points(&[(0.0, 0.0), (0.0, 4.0), (2.0, 3.9), (4.0, 4.0), (4.0, 0.0)])));
    }

    #[test]
    fn a_star_of_one_line_is_not_convex() {
        let corner = |i: u32| {
            let angle = f64::from(i * 2) * std::f64::consts::TAU / 5.0;
            Vector2::new(libm::cos(angle) as f32, libm::sin(angle) as f32)
        };
        assert!(!is_convex(&(0..5).map(corner).collect::<Vec<_>>()));
    }

    #[test]
    fn a_spike_is_not_convex() {
        let square = [(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
        assert!(!is_convex(&points(&square)));
    }

    #[test]
    fn degenerate_outlines_are_one_piece() {
        for list in [&[(1.0, 2.0)][..], &[(1.0, 2.0), (3.0, 4.0)], &[(1.0, 2.0), (1.0, 2.0), (3.0, 4.0)]] {
            let pieces = pieces_of(&points(list));
            assert_eq!(pieces.len(), 1);
            assert!(pieces[0].contains(&Vector2::new(1.0, 2.0)));
        }
        assert!(pieces_of(&[]).concat().is_empty());
        assert_eq!(pieces_of(&[Vector2::new(1.0, 2.0); 4]), [vec![Vector2::new(1.0, 2.0)]]);
    }

    #[test]
    fn a_convex_outline_is_its_own_piece_without_vertices_within_edges() {
        let outline = Vertices::create_rectangle(30.0, 7.1).expect("a rectangle");
        let pieces = pieces_of(&outline);
        assert_eq!(pieces.len(), 1);
        assert_eq!(pieces[0].len(), 4);
        assert!((doubled_area(&pieces[0]) + 2.0 * 30.0 * 7.1).abs() < 1e-3);
    }

    #[test]
    fn a_circle_keeps_its_vertices() {
        let outline = Vertices::create_circle(30.0, 500).expect("a circle");
        assert_eq!(pieces_of(&outline), [outline.to_vec()]);
    }

    #[test]
    fn transforming_replaces_the_content_of_the_buffer() {
        let outline = Vertices::from(rectangle((0.0, 0.0), 4.0, 2.0, 0.0));
        let matrix = matrix::create_translation(100.0, 50.0, 0.0);
        let mut transformed = vec![Vector2::new(9.0, 9.0)];
        ConvexPieces::new(&outline).transform_into(&matrix, &mut transformed);
        assert_eq!(transformed, rectangle((100.0, 50.0), 4.0, 2.0, 0.0));
    }

    #[test]
    fn too_few_vertices_laid_out_give_no_piece() {
        let pieces = ConvexPieces::new(&Vertices::from(rectangle((0.0, 0.0), 4.0, 2.0, 0.0)));
        assert_eq!(pieces.pieces(&[Vector2::new(1.0, 1.0)]).count(), 0);
    }

    #[test]
    fn the_pieces_of_a_concave_outline_are_convex_and_cover_it_once() {
        let mut random = Random(4);
        for _ in 0..200 {
            let middle = random.point(50.0);
            let outline = random.star(middle, 12, 40.0, 1.0);
            let pieces = pieces_of(&outline);
            assert!(pieces.iter().all(|piece| is_convex(piece) && doubled_area(piece) < 0.0));
            for _ in 0..50 {
                let point = middle + random.point(40.0);
                let covered = pieces.iter().filter(|piece| winds_around(piece, point)).count();
                assert_eq!(covered, usize::from(winds_around(&outline, point)));
            }
        }
    }

    #[test]
    fn an_l_shape_is_two_pieces() {
        let l_shape = [(0.0, 0.0), (0.0, 6.0), (6.0, 6.0), (6.0, 4.0), (2.0, 4.0), (2.0, 0.0)];
        assert_eq!(pieces_of(&points(&l_shape)).len(), 2);
    }

    #[test]
    fn an_outline_of_many_vertices_is_cut_without_loss() {
        let gear = Vertices::create_gear(50.0, 150, 0.3, 8.0).expect("a gear");
        let pieces = pieces_of(&gear);
        assert!(gear.len() > 500 && pieces.len() < gear.len() / 2);
        let area: f32 = pieces.iter().map(|piece| doubled_area(piece)).sum();
        // Hundreds of products of numbers up to 60, each rounded to 1e-4.
        assert!((area.abs() - doubled_area(&gear).abs()).abs() < 0.1);
    }

    #[test]
    fn an_outline_that_crosses_itself_is_cut_or_wrapped_in_convex_pieces() {
        let bow = points(&[(0.0, 0.0), (0.0, 4.0), (4.0, 0.0), (4.0, 4.0)]);
        let pieces = pieces_of(&bow);
        assert!(!pieces.is_empty() && pieces.iter().all(|piece| is_convex(piece)));
    }

    #[test]
    fn an_outline_that_goes_to_and_fro_on_a_line_is_a_segment() {
        let pieces = pieces_of(&points(&[(0.0, 0.0), (4.0, 0.0), (2.0, 0.0), (6.0, 0.0)]));
        assert_eq!(pieces, [points(&[(0.0, 0.0), (6.0, 0.0)])]);
    }

    #[test]
    fn an_outline_that_touches_itself_is_cut_without_loss() {
        // Two squares that meet in a corner.
        let list =
            [(0.0, 0.0), (0.0, 2.0), (2.0, 2.0), (2.0, 4.0), (4.0, 4.0), (4.0, 2.0), (2.0, 2.0), (2.0, 0.0)];
        let area: f32 = pieces_of(&points(&list)).iter().map(|piece| doubled_area(piece)).sum();
        assert_eq!(area, -16.0);
    }

    #[test]
    fn the_hull_of_random_points_is_convex_and_holds_them() {
        let mut random = Random(5);
        let cloud: Vec<_> = (0..100).map(|_| random.point(30.0)).collect();
        let hull = convex_hull(&cloud);
        assert!(is_convex(&hull) && hull.len() < 40);
        assert!(cloud.iter().all(|point| hull.contains(point) || winds_around(&hull, *point)));
    }

    /// Joining asks the index of edges, whose stale entries must not lose or double a piece.
    #[test]
    fn an_outline_of_thousands_of_vertices_is_cut_into_pieces_of_the_same_area() {
        let gear: Vec<Vector2> = (0..3000)
            .map(|i| {
                let (sin, cos) = (i as f32 * (std::f32::consts::TAU / 3000.0)).sin_cos();
                Vector2::new(cos, sin) * if i % 2 == 0 { 100.0 } else { 99.0 }
            })
            .collect();
        let area: f32 = pieces_of(&gear).iter().map(|piece| doubled_area(piece).abs()).sum();
        // Of some 3000 triangles, each rounded.
        assert!((area / doubled_area(&gear).abs() - 1.0).abs() < 3000.0 * f32::EPSILON, "{area}");
    }
}
