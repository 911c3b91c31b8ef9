//! Clipping of a polygon by a convex one.

use crate::Point;

/// The part of `polygon` (any) inside of `convex` (either winding), clipped edge by edge: Sutherland and
/// Hodgman, Reentrant Polygon Clipping, 1974. Pieces of a concave polygon stay joined by edges without area,
/// which fill no pixels. Empty if `convex` has no area.
///
/// ```
/// # use twohalf_render::clip_to_convex;
/// let square = [[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0]];
/// let beside = square.map(|[x, y]| [x + 6.0, y]);
/// let common = clip_to_convex(&beside, &square);
/// assert!(common.iter().all(|[x, _]| (6.0..=10.0).contains(x)));
/// ```
pub fn clip_to_convex(polygon: &[Point], convex: &[Point]) -> Vec<Point> {
    let area: f64 = edges(convex).map(|[a, b]| cross([0.0; 2], a, b)).sum();
    if polygon.len() < 3 || !(area != 0.0 && area.is_finite()) {
        return Vec::new();
    }
    let mut inside = polygon.to_vec();
    let mut uncut = Vec::new();
    for [a, b] in edges(convex) {
        std::mem::swap(&mut inside, &mut uncut);
        inside.clear();
        for [start, end] in edges(&uncut) {
            // Positive inside.
            let [from, to] = [start, end].map(|point| cross(a, b, point) * area.signum());
            if (from < 0.0) != (to < 0.0) {
                let t = from / (from - to);
                let at = |axis: usize| {
                    let [start, end] = [f64::from(start[axis]), f64::from(end[axis])];
                    (start + (end - start) * t) as f32
                };
                inside.push([at(0), at(1)]);
            }
            if to >= 0.0 {
                inside.push(end);
            }
        }
    }
    inside
}

/// Edges from every corner to the next, beginning with the one from the last to the first.
fn edges(corners: &[Point]) -> impl Iterator<Item = [Point; 2]> {
    let before = corners.iter().cycle().skip(corners.len().saturating_sub(1));
    before.zip(corners).map(|(&a, &b)| [a, b])
}

/// Twice the area of a triangle, px², positive if it is clockwise on the screen.
fn cross(a: Point, b: Point, c: Point) -> f64 {
    // Differences and products of f32 numbers are exact enough in f64 for the sign.
    let [ax, ay] = a.map(f64::from);
    (f64::from(b[0]) - ax) * (f64::from(c[1]) - ay) - (f64::from(b[1]) - ay) * (f64::from(c[0]) - ax)
}

#[cfg(test)]
mod tests {
    use super::*;

    const SQUARE: [Point; 4] = [[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0]];

    /// Twice the area, positive whatever the winding.
    fn area(polygon: &[Point]) -> f64 {
        edges(polygon).map(|[a, b]| cross([0.0; 2], a, b)).sum::<f64>().abs()
    }

    #[test]
    fn clipping_a_square_by_a_square_leaves_the_common_rectangle() {
        let other = SQUARE.map(|[x, y]| [x + 6.0, y - 3.0]);
        let common = clip_to_convex(&other, &SQUARE);
        assert_eq!(area(&common), 2.0 * 4.0 * 7.0);
        assert!(common.iter().all(|&[x, y]| (6.0..=10.0).contains(&x) && (0.0..=7.0).contains(&y)));
    }

    #[test]
    fn the_winding_of_neither_matters() {
        let triangle = [[5.0, -5.0], [15.0, 5.0], [5.0, 5.0]];
        let reversed = |polygon: &[Point]| polygon.iter().rev().copied().collect::<Vec<_>>();
        let expected = area(&clip_to_convex(&triangle, &SQUARE));
        // The diagonal meets the right side in the upper corner, so 5 x 5 remain.
        assert_eq!(expected, 50.0);
        assert_eq!(area(&clip_to_convex(&reversed(&triangle), &SQUARE)), expected);
        assert_eq!(area(&clip_to_convex(&triangle, &reversed(&SQUARE))), expected);
    }

    #[test]
    fn a_polygon_around_everything_leaves_everything() {
        let around = SQUARE.map(|[x, y]| [3.0 * x - 10.0, 3.0 * y - 10.0]);
        assert_eq!(area(&clip_to_convex(&around, &SQUARE)), 200.0);
    }

    #[test]
    fn a_concave_polygon_keeps_its_area_when_it_falls_apart() {
        // A U, open above, of which the bottom lies below the square.
        let u = [
            [1.0, 2.0],
            [3.0, 2.0],
            [3.0, 12.0],
            [7.0, 12.0],
            [7.0, 2.0],
            [9.0, 2.0],
            [9.0, 14.0],
            [1.0, 14.0],
        ];
        assert_eq!(area(&clip_to_convex(&u, &SQUARE)), 2.0 * (2.0 * 8.0 + 2.0 * 8.0));
    }

    #[test]
    fn clipping_separate_or_degenerate_polygons_leaves_nothing() {
        assert!(clip_to_convex(&SQUARE.map(|[x, y]| [x + 20.0, y]), &SQUARE).is_empty());
        assert!(clip_to_convex(&SQUARE, &[[0.0, 0.0], [5.0, 5.0], [10.0, 10.0]]).is_empty());
        assert!(clip_to_convex(&[[1.0, 1.0], [2.0, 2.0]], &SQUARE).is_empty());
        assert!(clip_to_convex(&[], &SQUARE).is_empty());
        assert!(clip_to_convex(&SQUARE, &[]).is_empty());
    }
}
