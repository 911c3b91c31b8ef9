//! Decomposition of a simple polygon into convex parts.
//!
//! Triangles are cut off at ears: convex corners whose triangle with both neighbours contains no other corner (G.
//! Meisters, "Polygons have ears", 1975). Triangles are then merged as long as the parts stay convex (S. Hertel and K.
//! Mehlhorn, "Fast triangulation of the plane with respect to simple polygons", 1985). The side of a line on which a
//! corner lies is computed in double precision, where differences of floats and their products are almost exact.
//!
//! The decomposition of the original, which merges corners of less than a degree, would leave gaps and steps where
//! parts meet.

use crate::math::plane::Vector;

/// Maximum number of corners of an outline that is cut.
/// The time grows with the square of the number of corners.
const MAX_CORNERS: usize = 1000;

type TriangleIndices = [usize; 3];

/// The parts as lists of corner indices, ordered as the outline, which must have a positive area. `None` if the outline
/// crosses itself, has no area, or has too many corners.
pub(crate) fn convex_parts(outline: &[Vector]) -> Option<Vec<Vec<usize>>> {
    if outline.len() > MAX_CORNERS {
        return None;
    }
    let mut triangles = triangles(outline)?;
    let mut parts = Vec::new();
    while let Some(triangle) = triangles.pop() {
        parts.push(grow_convex_part(triangle.to_vec(), &mut triangles, outline));
    }
    Some(parts).filter(|parts| !parts.is_empty())
}

/// Orientation of three points: positive if c is on the inner side of the line from a to b.
fn orientation([a, b, c]: [Vector; 3]) -> f64 {
    let difference = |to: Vector, axis: usize| f64::from(to[axis]) - f64::from(a[axis]);
    difference(b, 0) * difference(c, 1) - difference(b, 1) * difference(c, 0)
}

fn triangles(outline: &[Vector]) -> Option<Vec<TriangleIndices>> {
    let mut left: Vec<usize> = (0..outline.len()).collect();
    let mut triangles = Vec::with_capacity(outline.len());
    let mut at = 0;
    let mut refused = 0;
    while left.len() > 2 && refused < left.len() {
        let count = left.len();
        let [before, corner, after] = [at + count - 1, at, at + 1].map(|at| left[at % count]);
        if is_ear([before, corner, after], &left, outline) {
            triangles.push([before, corner, after]);
            left.remove(at % count);
            refused = 0;
        } else {
            at += 1;
            refused += 1;
        }
        at %= left.len();
    }
    let is_flat = (0..left.len())
        .all(|at| orientation([0, 1, 2].map(|step| outline[left[(at + step) % left.len()]])) == 0.0);
    is_flat.then_some(triangles)
}

/// Whether a corner is convex, and no other corner lies in the triangle with its neighbours or on the sides of it.
fn is_ear(triangle: TriangleIndices, left: &[usize], outline: &[Vector]) -> bool {
    let [a, b, c] = triangle.map(|corner| outline[corner]);
    let is_in = |&corner: &usize| {
        let point = outline[corner];
        // Where the outline touches itself, corners coincide.
        ![a, b, c].contains(&point)
            && orientation([a, b, point]) >= 0.0
            && orientation([b, c, point]) >= 0.0
            && orientation([c, a, point]) >= 0.0
    };
    orientation([a, b, c]) > 0.0 && !left.iter().any(is_in)
}

/// Merges a part with all triangles that leave it convex.
fn grow_convex_part(
    mut part: Vec<usize>,
    triangles: &mut Vec<TriangleIndices>,
    outline: &[Vector],
) -> Vec<usize> {
    let mut at = 0;
    while at < triangles.len() {
        if let Some(larger) = merged_with(&part, triangles[at], outline) {
            part = larger;
            triangles.remove(at);
            at = 0;
        } else {
            at += 1;
        }
    }
    part
}

/// The part merged with a triangle at their shared side, if that leaves it convex.
fn merged_with(part: &[usize], triangle: TriangleIndices, outline: &[Vector]) -> Option<Vec<usize>> {
    let count = part.len();
    let corner = |at: usize| part[at % count];
    let tip_at = |at: usize| {
        let is_shared =
            |&edge: &usize| triangle[(edge + 1) % 3] == part[at] && triangle[edge] == corner(at + 1);
        (0..3).find(is_shared).map(|edge| triangle[(edge + 2) % 3])
    };
    let (at, tip) = (0..count).find_map(|at| Some((at, tip_at(at)?)))?;
    let turns = |corners: [usize; 3]| orientation(corners.map(|corner| outline[corner])) >= 0.0;
    let stays_convex =
        turns([corner(at + count - 1), corner(at), tip]) && turns([tip, corner(at + 1), corner(at + 2)]);
    let mut larger = part.to_vec();
    larger.insert(at + 1, tip);
    stays_convex.then_some(larger)
}

#[cfg(test)]
mod tests {
    use super::{convex_parts, orientation};
    use crate::math::plane::Vector;

    fn area(corners: &[Vector]) -> f64 {
        (1..corners.len() - 1).map(|at| orientation([corners[0], corners[at], corners[at + 1]])).sum()
    }

    /// A star with reflex corners in between.
    fn star(corners: u16) -> Vec<Vector> {
        let corner = |i: u16| {
            let (sine, cosine) = (f32::from(i) * std::f32::consts::TAU / f32::from(corners)).sin_cos();
            let radius = if i.is_multiple_of(2) { 100.0 } else { 30.0 + f32::from(i % 7) };
            [radius * cosine, radius * sine]
        };
        (0..corners).map(corner).collect()
    }

    #[test]
    fn parts_are_convex_and_cover_their_outline() {
        for corners in [6, 10, 100, 400] {
            let outline = star(corners);
            let parts = convex_parts(&outline).unwrap();
            let mut covered = 0.0;
            for part in parts {
                let part: Vec<Vector> = part.into_iter().map(|corner| outline[corner]).collect();
                let count = part.len();
                let turns = |at: usize| {
                    orientation([part[at], part[(at + 1) % count], part[(at + 2) % count]]) >= 0.0
                };
                assert!((0..count).all(turns));
                covered += area(&part);
            }
            // Sums of doubles.
            assert!((covered - area(&outline)).abs() < 1e-9 * covered);
        }
    }

    #[test]
    fn self_crossing_outlines_have_no_parts() {
        let bow_tie = [[0.0, 0.0], [10.0, 10.0], [10.0, 0.0], [0.0, 12.0]];
        assert_eq!(convex_parts(&bow_tie), None);
        assert_eq!(convex_parts(&[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]]), None);
    }

    #[test]
    fn long_outlines_are_cut_quickly() {
        assert!(convex_parts(&star(1000)).is_some());
        assert_eq!(convex_parts(&star(1002)), None);
    }
}
