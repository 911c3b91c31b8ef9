//! Outlines of lines as polygons, for clipping.

use crate::Point;

/// The outline of a line from point to point, `width` px wide, for non-zero winding: along one side and back
/// on the other, with flat joints. Empty without two different points.
pub(crate) fn outline_of_line(points: &[Point], closed: bool, width: f32) -> Vec<Point> {
    let ends = if closed { points.first() } else { None };
    let mut path: Vec<Point> = points.iter().chain(ends).copied().collect();
    path.dedup();
    let sides: Vec<[Point; 2]> = path.windows(2).map(|pair| [pair[0], pair[1]]).collect();
    let shifted = |[a, b]: [Point; 2]| {
        let [x, y] = across(a, b, width);
        [[a[0] + x, a[1] + y], [b[0] + x, b[1] + y]]
    };
    let there = sides.iter().copied().flat_map(shifted);
    let back = sides.iter().rev().map(|&[a, b]| [b, a]).flat_map(shifted);
    there.chain(back).collect()
}

/// Half of a width, px, at right angles to a line from a to b; zero for a line without length.
pub(crate) fn across(a: Point, b: Point, width: f32) -> Point {
    let [dx, dy] = [b[0] - a[0], b[1] - a[1]];
    let length = (dx * dx + dy * dy).sqrt();
    if length > 0.0 { [0.5 * width * dy / length, -0.5 * width * dx / length] } else { [0.0, 0.0] }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_level_line_becomes_a_rectangle_about_it() {
        let outline = outline_of_line(&[[0.0, 5.0], [10.0, 5.0]], false, 4.0);
        assert_eq!(outline, [[0.0, 3.0], [10.0, 3.0], [10.0, 7.0], [0.0, 7.0]]);
    }

    #[test]
    fn points_without_a_distance_have_no_outline() {
        assert!(outline_of_line(&[[3.0, 3.0], [3.0, 3.0]], true, 4.0).is_empty());
    }
}
