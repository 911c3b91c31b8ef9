//! Corners of outlines.

use crate::Point;

/// Sine of the greatest turn of a straight point of an outline, dimensionless.
const MAX_STRAIGHT_SINE: f32 = 1e-3;

/// The points of an outline at which it turns.
pub(crate) fn corners_of(outline: impl Iterator<Item = Point>) -> Vec<Point> {
    let outline: Vec<Point> = outline.collect();
    (0..outline.len())
        .filter(|&at| bend(&outline, at).abs() > MAX_STRAIGHT_SINE)
        .map(|at| outline[at])
        .collect()
}

/// Sine of the angle by which an outline turns at a corner, positive clockwise; dimensionless.
pub(crate) fn bend(outline: &[Point], at: usize) -> f32 {
    let [a, b, c] = [outline.len() - 1, 0, 1].map(|step| outline[(at + step) % outline.len()]);
    cross(a, b, c) / (distance(a, b) * distance(b, c)).max(f32::MIN_POSITIVE)
}

/// Twice the area of a triangle, px², positive if it is clockwise on the screen.
pub(crate) fn cross(a: Point, b: Point, c: Point) -> f32 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

pub(crate) fn distance(a: Point, b: Point) -> f32 {
    let [x, y] = [b[0] - a[0], b[1] - a[1]];
    (x * x + y * y).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_on_an_edge_are_no_corners() {
        let square = [[0.0, 0.0], [5.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0], [0.0, 5.0]];
        assert_eq!(corners_of(square.into_iter()), [[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0]]);
    }
}
