//! Decomposition of an outline into convex pieces (behaviour chapter 15, section 15.4): the outline is cut into
//! triangles, and these are merged as long as the pieces stay convex.

use super::Vertices;
use super::triangulate::{self, Triangle};
use crate::error::{Error, Result};
use crate::math::finite::finite_vertices;
use crate::math::{Vector2, calculator, vector2};

/// Maximum number of pieces of a decomposition, whatever the caller asks for.
const MAX_PIECES: usize = 50;

/// Maximum number of vertices of a piece.
const MAX_PIECE_VERTICES: usize = 32;

/// Angle in radians, one degree: corners that turn by less are removed from a piece.
const MIN_TURN_ANGLE: f32 = calculator::RADIANS_TO_DEGREES_RATIO;

impl Vertices {
    /// Convex pieces of an outline that does not cross itself, at most `max_polys_to_find` of them: the remainder of
    /// the outline is left out. Fewer than three vertices, and outlines of which no triangle can be cut, give no
    /// pieces. The pieces have positive shoelace area, opposite to engine winding.
    ///
    /// The time grows with the square of the number of vertices: [`simplify`](Self::simplify) long outlines first.
    ///
    /// # Errors
    /// Vertices that are not finite; an outline with more than 175 triangles (177 vertices, if it is simple); more than
    /// 50 pieces, if `max_polys_to_find` is more than 50.
    ///
    /// ```
    /// use farseer_core::math::Vector2;
    /// use farseer_core::shape::Vertices;
    /// let l_shape = [(0.0, 0.0), (0.0, 6.0), (2.0, 6.0), (2.0, 2.0), (6.0, 2.0), (6.0, 0.0)];
    /// let outline: Vertices = l_shape.into_iter().map(|(x, y)| Vector2::new(x, y)).collect();
    /// assert_eq!(outline.decompose(10)?.len(), 2);
    /// # Ok::<(), farseer_core::Error>(())
    /// ```
    #[doc(alias = "DecomposeGeom")]
    pub fn decompose(&self, max_polys_to_find: i32) -> Result<Vec<Vertices>> {
        finite_vertices("self", self)?;
        if self.len() < 3 {
            return Ok(Vec::new());
        }
        let mut outline = self.to_vec();
        if area(&outline) > 0.0 {
            outline.reverse();
        }
        match triangulate::triangulate(outline)? {
            Some(triangles) => polygonize(&triangles, max_polys_to_find),
            None => Ok(Vec::new()),
        }
    }
}

/// The shoelace area, summed up from the closing edge on.
fn area(outline: &[Vector2]) -> f32 {
    let last = outline[outline.len() - 1];
    let closing = last.x * outline[0].y - outline[0].x * last.y;
    let sum = outline.windows(2).fold(0.0 + closing, |sum, edge| {
        let (a, b) = (edge[0], edge[1]);
        sum + (a.x * b.y - b.x * a.y)
    });
    sum * 0.5
}

/// Merges triangles into convex pieces, each piece starting with the first triangle that is not used yet.
fn polygonize(triangles: &[Triangle], max_polys_to_find: i32) -> Result<Vec<Vertices>> {
    let max = usize::try_from(max_polys_to_find).unwrap_or(0);
    let mut covered: Vec<bool> = triangles.iter().map(has_equal_corners).collect();
    let mut pieces = Vec::new();
    while pieces.len() < max
        && let Some(first) = covered.iter().position(|&c| !c)
    {
        covered[first] = true;
        let piece = merge_parallel(grow(triangles[first], triangles, &mut covered));
        if piece.len() >= 3 {
            if pieces.len() == MAX_PIECES {
                return Err(Error::invalid(
                    "max_polys_to_find",
                    max_polys_to_find,
                    "50 or less for an outline of more than 50 convex pieces",
                ));
            }
            pieces.push(piece);
        }
    }
    Ok(pieces)
}

fn has_equal_corners(t: &Triangle) -> bool {
    t[0] == t[1] || t[0] == t[2] || t[1] == t[2]
}

/// Adds all triangles to a piece that leave it convex, in two runs, and marks them as used.
fn grow(first: Triangle, triangles: &[Triangle], covered: &mut [bool]) -> Vertices {
    let mut piece = Vertices::from(&first[..]);
    for _ in 0..2 {
        for (triangle, covered) in triangles.iter().zip(covered.iter_mut()) {
            if *covered {
                continue;
            }
            if let Some(larger) = attach(&piece, triangle)
                && larger.len() <= MAX_PIECE_VERTICES
                && larger.is_convex()
            {
                piece = larger;
                *covered = true;
            }
        }
    }
    piece
}

/// The piece with a triangle attached to the edge they share; `None` if they share none. As in the original a third
/// common vertex replaces the second.
fn attach(piece: &Vertices, triangle: &Triangle) -> Option<Vertices> {
    let (mut first, mut second) = (None, None);
    for (i, vertex) in piece.iter().enumerate() {
        if let Some(corner) = triangle.iter().position(|c| c == vertex) {
            if first.is_none() {
                first = Some((i, corner));
            } else {
                second = Some((i, corner));
            }
        }
    }
    let ((mut position, corner1), (position2, corner2)) = (first?, second?);
    if position == 0 && position2 == piece.len() - 1 {
        position = position2;
    }
    let tip = (0..2).find(|&c| c != corner1 && c != corner2).unwrap_or(2);
    let mut larger = piece.clone();
    larger.insert(position + 1, triangle[tip]);
    Some(larger)
}

/// The piece without the vertices where it hardly turns, as long as more than three remain.
///
/// As in the original an edge of length 0 reduces the number of vertices without removing one, so that the last
/// vertices are lost instead.
fn merge_parallel(piece: Vertices) -> Vertices {
    let n = piece.len();
    if n <= 3 {
        return piece;
    }
    let mut left = n;
    let mut keep = vec![true; n];
    for (i, keep) in keep.iter_mut().enumerate() {
        let incoming = piece[i] - piece[piece.previous_index(i)];
        let outgoing = piece[piece.next_index(i)] - piece[i];
        let (length_in, length_out) = (vector2::length(incoming), vector2::length(outgoing));
        if !(length_in > 0.0 && length_out > 0.0) && left > 3 {
            left -= 1;
        }
        let a = Vector2::new(incoming.x / length_in, incoming.y / length_in);
        let b = Vector2::new(outgoing.x / length_out, outgoing.y / length_out);
        let turns = vector2::cross(a, b).abs() < MIN_TURN_ANGLE;
        if turns && vector2::dot(a, b) > 0.0 && left > 3 {
            *keep = false;
            left -= 1;
        }
    }
    if left == n {
        return piece;
    }
    piece.iter().zip(keep).filter(|(_, keep)| *keep).map(|(v, _)| *v).take(left).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn outline(points: &[(f32, f32)]) -> Vertices {
        points.iter().map(|&(x, y)| Vector2::new(x, y)).collect()
    }

    fn corners(points: [(f32, f32); 3]) -> Triangle {
        points.map(|(x, y)| Vector2::new(x, y))
    }

    const PIECE: [(f32, f32); 3] = [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0)];

    #[test]
    fn a_triangle_at_the_closing_edge_is_attached_at_the_end() {
        let larger = attach(&outline(&PIECE), &corners([(0.0, 0.0), (4.0, 4.0), (0.0, 4.0)]));
        assert_eq!(larger, Some(outline(&[(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)])));
    }

    #[test]
    fn a_triangle_at_another_edge_is_attached_there() {
        let larger = attach(&outline(&PIECE), &corners([(4.0, 0.0), (9.0, 2.0), (4.0, 4.0)]));
        assert_eq!(larger, Some(outline(&[(0.0, 0.0), (4.0, 0.0), (9.0, 2.0), (4.0, 4.0)])));
    }

    #[test]
    fn a_triangle_with_one_common_corner_is_not_attached() {
        assert_eq!(attach(&outline(&PIECE), &corners([(4.0, 4.0), (9.0, 2.0), (9.0, 9.0)])), None);
    }

    #[test]
    fn of_three_common_corners_the_second_is_the_tip() {
        let doubled = attach(&outline(&PIECE), &corners(PIECE));
        assert_eq!(doubled, Some(outline(&[(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (4.0, 0.0)])));
    }

    #[test]
    fn a_doubled_vertex_removes_the_last_vertices() {
        let square = outline(&[(0.0, 0.0), (0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)]);
        assert_eq!(merge_parallel(square), outline(&[(0.0, 0.0), (0.0, 0.0), (4.0, 0.0)]));
    }

    #[test]
    fn a_vertex_that_turns_by_less_than_a_degree_is_merged() {
        let merged =
            |y: f32| merge_parallel(outline(&[(0.0, 0.0), (4.0, y), (8.0, 0.0), (8.0, 8.0), (0.0, 8.0)]));
        assert_eq!(merged(-0.03).len(), 4);
        assert_eq!(merged(-0.04).len(), 5);
    }
}
