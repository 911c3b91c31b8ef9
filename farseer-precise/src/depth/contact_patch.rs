//! Contact patch of two faces perpendicular to the z axis: the intersection of two outlines, its centroid and radius of
//! gyration.
//!
//! Polygon clipping by I. Sutherland and G. Hodgman, "Reentrant Polygon Clipping" (1974). Rounded outlines count as their
//! bounding box. Reads two outlines with poses. `prism_collision` places its contact point at the centroid of the patch. The
//! radius of gyration limits twist friction.

use crate::math::plane::{Pose, Vector, cross, difference, dot, rotate, rotation, scaled, sum, translation};
use crate::parameters::depth::CONTACT_PATCH_CORNERS;
use crate::shape::ShapeRef;

/// Centroid and radius of gyration of a contact patch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ContactPatch {
    /// Centroid of the patch in world coordinates x and y, length units.
    pub(super) centroid: Vector,
    /// Radius of gyration of the patch in length units, >= 0: root of the mean square distance of its points from the centroid.
    pub(super) gyration_radius: f32,
}

/// Convex polygon under clipping, stored inline. It holds at most `CONTACT_PATCH_CORNERS` vertices.
struct ClipPolygon {
    points: [Vector; CONTACT_PATCH_CORNERS],
    count: usize,
}

impl ClipPolygon {
    /// Returns a polygon without vertices.
    fn new() -> Self {
        ClipPolygon { points: [[0.0; 2]; CONTACT_PATCH_CORNERS], count: 0 }
    }

    /// Appends a vertex, if there is room.
    fn push(&mut self, point: Vector) {
        if self.count < CONTACT_PATCH_CORNERS {
            self.points[self.count] = point;
            self.count += 1;
        }
    }

    fn vertices(&self) -> &[Vector] {
        &self.points[..self.count]
    }

    /// Returns the world-space polygon of an outline at a pose; the bounding box if the outline is rounded.
    fn from_outline(outline: ShapeRef<'_>, pose: Pose) -> Self {
        let mut corners = ClipPolygon::new();
        let mut push = |point| corners.push(sum(translation(pose), rotate(rotation(pose), point)));
        if outline.shape.radius > 0.0 || outline.vertices.len() < 3 {
            let ([x, y], [hx, hy]) = (outline.shape.centre, outline.shape.half_extents);
            let (hx, hy) = (hx + outline.shape.radius, hy + outline.shape.radius);
            [[-hx, -hy], [hx, -hy], [hx, hy], [-hx, hy]]
                .into_iter()
                .for_each(|[dx, dy]| push([x + dx, y + dy]));
        } else {
            outline.vertices.iter().for_each(|&point| push(point));
        }
        corners
    }

    /// Returns twice the signed area, in length units^2. The sign is that of the winding.
    fn twice_signed_area(&self) -> f32 {
        let (all, first) = (self.vertices(), self.points[0]);
        let fan = all.windows(2).map(|pair| cross(difference(pair[0], first), difference(pair[1], first)));
        fan.sum()
    }

    /// Returns the polygon clipped by the line through `from` and `to`. It keeps the points p with sign * cross(to - from, p -
    /// from) >= 0.
    fn clip_half_plane(&self, from: Vector, to: Vector, sign: f32) -> Self {
        let mut kept = ClipPolygon::new();
        let height = |point: Vector| sign * cross(difference(to, from), difference(point, from));
        let all = self.vertices();
        for (at, &point) in all.iter().enumerate() {
            let next = all[(at + 1) % all.len()];
            let (here, there) = (height(point), height(next));
            if here >= 0.0 {
                kept.push(point);
            }
            if (here >= 0.0) != (there >= 0.0) {
                let fraction = here / (here - there);
                kept.push(sum(point, scaled(difference(next, point), fraction)));
            }
        }
        kept
    }
}

/// Returns the contact patch of outline A at `pose_a` and outline B at `pose_b` (world poses); `None` if their intersection has
/// no area.
pub(super) fn intersect_outlines(
    a: ShapeRef<'_>,
    pose_a: Pose,
    b: ShapeRef<'_>,
    pose_b: Pose,
) -> Option<ContactPatch> {
    let frame = ClipPolygon::from_outline(a, pose_a);
    let mut common = ClipPolygon::from_outline(b, pose_b);
    let sign = if frame.twice_signed_area() < 0.0 { -1.0 } else { 1.0 };
    for at in 0..frame.count {
        common = common.clip_half_plane(frame.points[at], frame.points[(at + 1) % frame.count], sign);
    }
    patch_of_polygon(&common)
}

/// Returns centroid and radius of gyration of a polygon in length units, summed over a fan of triangles. `None` if the polygon
/// has no area or a sum overflows.
fn patch_of_polygon(corners: &ClipPolygon) -> Option<ContactPatch> {
    let (first, doubled) = (corners.points[0], corners.twice_signed_area());
    if corners.count < 3 || doubled == 0.0 || !doubled.is_finite() {
        return None;
    }
    let (mut moment, mut square) = ([0.0; 2], 0.0);
    for pair in corners.vertices().windows(2) {
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
    Some(ContactPatch {
        centroid: sum(first, middle),
        gyration_radius: if squared > 0.0 { squared.sqrt() } else { 0.0 },
    })
}

#[cfg(test)]
mod tests {
    use super::{ClipPolygon, patch_of_polygon};

    fn polygon(points: &[[f32; 2]]) -> ClipPolygon {
        let mut corners = ClipPolygon::new();
        points.iter().for_each(|&point| corners.push(point));
        corners
    }

    #[test]
    fn patch_of_a_rectangle_has_its_centroid_and_gyration_radius() {
        let covered = patch_of_polygon(&polygon(&[[2.0, 1.0], [8.0, 1.0], [8.0, 5.0], [2.0, 5.0]])).unwrap();
        assert_eq!(covered.centroid, [5.0, 3.0]);
        // The squared radius of gyration of a rectangle is (w^2 + h^2) / 12.
        assert!((covered.gyration_radius * covered.gyration_radius - (36.0 + 16.0) / 12.0).abs() < 1e-5);
    }

    #[test]
    fn patch_whose_moments_overflow_is_rejected() {
        // Fourth powers of 1e10 overflow; areas do not.
        assert!(patch_of_polygon(&polygon(&[[0.0, 0.0], [1e10, 0.0], [1e10, 1e10], [0.0, 1e10]])).is_none());
    }

    #[test]
    fn clipping_crossed_bars_gives_their_intersection() {
        let bar = polygon(&[[-10.0, -1.0], [10.0, -1.0], [10.0, 1.0], [-10.0, 1.0]]);
        let cut =
            bar.clip_half_plane([3.0, -9.0], [3.0, 9.0], -1.0).clip_half_plane([1.0, -9.0], [1.0, 9.0], 1.0);
        assert!(patch_of_polygon(&cut).is_none());
        let cut =
            bar.clip_half_plane([1.0, -9.0], [1.0, 9.0], -1.0).clip_half_plane([3.0, -9.0], [3.0, 9.0], 1.0);
        assert_eq!(patch_of_polygon(&cut).unwrap().centroid, [2.0, 0.0]);
    }

    #[test]
    fn disjoint_polygons_have_no_patch() {
        let square = polygon(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
        assert!(patch_of_polygon(&square.clip_half_plane([5.0, 0.0], [5.0, 1.0], -1.0)).is_none());
    }
}
