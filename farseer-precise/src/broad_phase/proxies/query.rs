//! Quick tests of queries against shapes: by the AABB of a shape in the frame of its body, at the present pose.

use super::{Proxies, ProxySummary};
use crate::bodies::BodySet;
use crate::broad_phase::hash_grid::PackedAabb;
use crate::index::ProxyIndex;
use crate::math::plane::{Vector, rotate, rotate_inverse, rotation};
use crate::parameters::broad_phase::PIECE_MAX_SHORTFALL_RATIO;
use crate::scaled_parameters::Parameters;
use crate::shape::Shape;

/// Least distance of the sides of a polygon that stands for a circle from the centre, as a fraction of the radius, dimensionless:
/// that of a triangle.
const INSCRIBED_RADIUS_RATIO: f32 = 0.5;

impl Proxies {
    /// Returns whether the AABB of a shape's outline overlaps a query AABB (length units, world axes), or `None` if only an exact
    /// test can tell. `tolerance` is a bound on the rounding of coordinates, length units, >= 0.
    ///
    /// A convex outline touches all four sides of its AABB in the frame of the body, so the AABB of the outline in the world contains
    /// the centre of the former.
    #[inline]
    pub fn outline_overlaps(
        &self,
        proxy: ProxyIndex,
        query: &PackedAabb,
        tolerance: f32,
        bodies: &BodySet,
        parameters: &Parameters,
    ) -> Option<bool> {
        let ProxySummary { body, radius, .. } = self.summaries[proxy];
        let [cx, cy, hx, hy] = self.local_aabbs[proxy];
        let pose = bodies.poses[body];
        let q = rotation(pose);
        let centre = rotate(q, [cx, cy]);
        let centre = [pose[0] + centre[0], pose[1] + centre[1]];
        let (c, s) = (q[0].abs(), q[1].abs());
        let turned = [c * hx + s * hy, s * hx + c * hy];
        let overlaps = |half: Vector| {
            (0..2).all(|axis| {
                centre[axis] - half[axis] <= query[axis + 2] && centre[axis] + half[axis] >= query[axis]
            })
        };
        let beyond = radius + parameters.speculative_distance + tolerance;
        if !overlaps(turned.map(|half| half + beyond)) {
            return Some(false);
        }
        let within = tolerance + PIECE_MAX_SHORTFALL_RATIO * parameters.speculative_distance;
        let Shape { is_box, vertex_count, .. } = self.all[proxy].shape;
        let inner = match (is_box, vertex_count) {
            (true, _) => turned,
            (false, 0) => [INSCRIBED_RADIUS_RATIO * radius; 2],
            // The outline of a capsule contains the core, here along an axis of the body.
            (false, 2) if hx == 0.0 || hy == 0.0 => turned,
            _ => [0.0; 2],
        };
        overlaps(inner.map(|half| half - within)).then_some(true)
    }

    /// Returns whether a shape may touch a square that moves from `start` by `displacement`, length units, world axes. The test uses
    /// the separating axes of the segment and of the shape's AABB in the frame of its body. `reach`: distance of the farthest corner of
    /// the square from its centre with the rounding of coordinates, length units, >= 0.
    #[inline]
    pub fn may_meet_path(
        &self,
        proxy: ProxyIndex,
        [start, displacement]: [Vector; 2],
        reach: f32,
        bodies: &BodySet,
        parameters: &Parameters,
    ) -> bool {
        let ProxySummary { body, radius, .. } = self.summaries[proxy];
        let [cx, cy, hx, hy] = self.local_aabbs[proxy];
        let pose = bodies.poses[body];
        let q = rotation(pose);
        let half = rotate_inverse(q, displacement.map(|part| 0.5 * part));
        let from = rotate_inverse(q, [start[0] - pose[0], start[1] - pose[1]]);
        let (x, y) = (from[0] + half[0] - cx, from[1] + half[1] - cy);
        let beyond = radius + parameters.speculative_distance + reach;
        let (hx, hy) = (hx + beyond, hy + beyond);
        let (along_x, along_y) = (half[0].abs(), half[1].abs());
        x.abs() <= hx + along_x
            && y.abs() <= hy + along_y
            && (half[0] * y - half[1] * x).abs() <= along_x * hy + along_y * hx
    }
}
