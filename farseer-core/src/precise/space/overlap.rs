//! Where the outlines of two things cover each other, as seen along the depth axis: where fronts and backs press.
//!
//! One outline is cut by the edges of the other, one after the other (I. Sutherland and G. Hodgman, "Reentrant Polygon
//! Clipping", 1974). What is round counts as the box about it.

use crate::math::plane::{Pose, Vector, cross, difference, dot, place, rotation, scaled, sum, turn};
use crate::precise::outline::Outline;
use crate::precise::parameters::depth::CONTACT_PATCH_CORNERS;

/// The middle of an area, and how far from it its pressure is: the root of the mean square of distances.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Covered {
    pub(super) middle: Vector,
    pub(super) spread: f32,
}

/// Corners in order, in a list that needs no memory of its own.
struct Corners {
    points: [Vector; CONTACT_PATCH_CORNERS],
    count: usize,
}

impl Corners {
    fn new() -> Self {
        Corners { points: [[0.0; 2]; CONTACT_PATCH_CORNERS], count: 0 }
    }

    fn push(&mut self, point: Vector) {
        if self.count < CONTACT_PATCH_CORNERS {
            self.points[self.count] = point;
            self.count += 1;
        }
    }

    fn all(&self) -> &[Vector] {
        &self.points[..self.count]
    }

    /// Of an outline at a pose.
    fn of(outline: Outline<'_>, pose: Pose) -> Self {
        let mut corners = Corners::new();
        let mut push = |point| corners.push(sum(place(pose), turn(rotation(pose), point)));
        if outline.shape.radius > 0.0 || outline.points.len() < 3 {
            let ([x, y], [hx, hy]) = (outline.shape.centre, outline.shape.half);
            let (hx, hy) = (hx + outline.shape.radius, hy + outline.shape.radius);
            [[-hx, -hy], [hx, -hy], [hx, hy], [-hx, hy]]
                .into_iter()
                .for_each(|[dx, dy]| push([x + dx, y + dy]));
        } else {
            outline.points.iter().for_each(|&point| push(point));
        }
        corners
    }

    /// Twice the area, with the sign of the order of the corners.
    fn doubled_area(&self) -> f32 {
        let (all, first) = (self.all(), self.points[0]);
        let fan = all.windows(2).map(|pair| cross(difference(pair[0], first), difference(pair[1], first)));
        fan.sum()
    }

    /// What of it is on one side of the line through two points: on the side to which `sign` times the normal to the left
    /// points.
    fn cut(&self, from: Vector, to: Vector, sign: f32) -> Self {
        let mut kept = Corners::new();
        let height = |point: Vector| sign * cross(difference(to, from), difference(point, from));
        let all = self.all();
        for (at, &point) in all.iter().enumerate() {
            let next = all[(at + 1) % all.len()];
            let (here, there) = (height(point), height(next));
            if here >= 0.0 {
                kept.push(point);
            }
            if (here >= 0.0) != (there >= 0.0) {
                let part = here / (here - there);
                kept.push(sum(point, scaled(difference(next, point), part)));
            }
        }
        kept
    }
}

/// What two outlines have in common; `None` if that is no area.
pub(super) fn covered(a: Outline<'_>, pose_a: Pose, b: Outline<'_>, pose_b: Pose) -> Option<Covered> {
    let frame = Corners::of(a, pose_a);
    let mut common = Corners::of(b, pose_b);
    let sign = if frame.doubled_area() < 0.0 { -1.0 } else { 1.0 };
    for at in 0..frame.count {
        common = common.cut(frame.points[at], frame.points[(at + 1) % frame.count], sign);
    }
    middle_of(&common)
}

/// Centroid of a polygon, and the radius of gyration of its area about it, from the triangles of a fan; `None` where it has no area,
/// or one too large for numbers.
fn middle_of(corners: &Corners) -> Option<Covered> {
    let (first, doubled) = (corners.points[0], corners.doubled_area());
    if corners.count < 3 || doubled == 0.0 || !doubled.is_finite() {
        return None;
    }
    let (mut moment, mut square) = ([0.0; 2], 0.0);
    for pair in corners.all().windows(2) {
        let (u, v) = (difference(pair[0], first), difference(pair[1], first));
        let area = cross(u, v);
        moment = sum(moment, scaled(sum(u, v), area / 3.0));
        square += area * (dot(u, u) + dot(u, v) + dot(v, v)) / 6.0;
    }
    let middle = scaled(moment, 1.0 / doubled);
    let squared = square / doubled - dot(middle, middle);
    if !(squared + middle[0] + middle[1]).is_finite() {
        return None;
    }
    Some(Covered { middle: sum(first, middle), spread: if squared > 0.0 { squared.sqrt() } else { 0.0 } })
}

#[cfg(test)]
mod tests {
    use super::{Corners, middle_of};

    fn polygon(points: &[[f32; 2]]) -> Corners {
        let mut corners = Corners::new();
        points.iter().for_each(|&point| corners.push(point));
        corners
    }

    #[test]
    fn a_rectangle_presses_about_its_middle() {
        let covered = middle_of(&polygon(&[[2.0, 1.0], [8.0, 1.0], [8.0, 5.0], [2.0, 5.0]])).unwrap();
        assert_eq!(covered.middle, [5.0, 3.0]);
        // Of a rectangle the square of the radius of gyration is (w^2 + h^2) / 12.
        assert!((covered.spread * covered.spread - (36.0 + 16.0) / 12.0).abs() < 1e-5);
    }

    #[test]
    fn what_is_too_large_for_numbers_has_no_middle() {
        // Fourth powers of 1e10 are not finite, while areas are.
        assert!(middle_of(&polygon(&[[0.0, 0.0], [1e10, 0.0], [1e10, 1e10], [0.0, 1e10]])).is_none());
    }

    #[test]
    fn crossed_bars_have_their_crossing_in_common() {
        let bar = polygon(&[[-10.0, -1.0], [10.0, -1.0], [10.0, 1.0], [-10.0, 1.0]]);
        let cut = bar.cut([3.0, -9.0], [3.0, 9.0], -1.0).cut([1.0, -9.0], [1.0, 9.0], 1.0);
        assert!(middle_of(&cut).is_none());
        let cut = bar.cut([1.0, -9.0], [1.0, 9.0], -1.0).cut([3.0, -9.0], [3.0, 9.0], 1.0);
        assert_eq!(middle_of(&cut).unwrap().middle, [2.0, 0.0]);
    }

    #[test]
    fn what_is_apart_has_nothing_in_common() {
        let square = polygon(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
        assert!(middle_of(&square.cut([5.0, 0.0], [5.0, 1.0], -1.0)).is_none());
    }
}
