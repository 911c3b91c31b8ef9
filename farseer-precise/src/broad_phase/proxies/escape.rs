//! Broad phase: finds the proxies that have left their fat AABBs, four at a time.

use std::ops::Range;

use wide::f32x4;

use super::Proxies;
use crate::bodies::BodySet;
use crate::index::{BodyIndex, DenseIndex, ProxyIndex};
use crate::math::lanes::{columns, gather, select};
use crate::scaled_parameters::Parameters;

impl Proxies {
    /// Adds the motion in the step to `Proxies::travel`, and adds each proxy whose tight AABB has left its fat AABB to
    /// `Proxies::refitted`.
    ///
    /// The motion of a proxy is |dx| + |dy| + |dz| + extent * |rotation|, for the displacement of its body in the step. The extent
    /// is the greatest distance of the surface from the body's origin. The motion is an upper bound for the path of each point of
    /// the proxy, rounded up to a multiple of 2^-26 length units. The tight AABB includes the speculative distance.
    #[inline(always)]
    pub(crate) fn find_escaped(&mut self, bodies: &BodySet, runs: &[Range<usize>], parameters: &Parameters) {
        let scale = f32x4::splat(parameters.travel_scale());
        let speculative_distance = f32x4::splat(parameters.speculative_distance);
        let Proxies {
            summaries,
            local_aabbs: boxes,
            fat_aabbs: bounds,
            travel: motion,
            refitted: escaped,
            movable_end: movable,
            ..
        } = self;
        for four in runs.iter().flat_map(|run| run.clone().step_by(4)) {
            let of = summaries.slice(four..four + 4);
            let places: [BodyIndex; 4] = std::array::from_fn(|lane| of[lane].body);
            let [x, y, c, s] = gather(&bodies.poses, &places);
            let [dx, dy, turned, dz] = gather(&bodies.delta_pose, &places);
            let [Some(boxes), Some(bounds)] =
                [&*boxes, &*bounds].map(|of| of.slice(four..).first_chunk::<4>())
            else {
                continue;
            };
            let [cx, cy, hx, hy] = columns(boxes);
            let radius = f32x4::new(std::array::from_fn(|lane| of[lane].radius));
            let reach = f32x4::new(std::array::from_fn(|lane| of[lane].max_extent));
            let (x, y) = (x + (c * cx - s * cy), y + (s * cx + c * cy));
            let (ac, as_) = (c.abs(), s.abs());
            let (ex, ey) = (
                ac * hx + as_ * hy + radius + speculative_distance,
                as_ * hx + ac * hy + radius + speculative_distance,
            );
            let [low_x, low_y, high_x, high_y] = columns(bounds);
            let has_left = (x - ex).simd_lt(low_x)
                | (y - ey).simd_lt(low_y)
                | (x + ex).simd_gt(high_x)
                | (y + ey).simd_gt(high_y);
            let travel =
                (dx.abs() + dy.abs() + dz.abs() + reach * turned.abs()) * scale + f32x4::splat(0.999);
            add_travel(motion.slice_mut(four..four + 4), travel);
            let left = has_left.to_bitmask();
            for lane in (0..4).filter(|lane| left >> lane & 1 == 1 && ProxyIndex::new(four + lane) < *movable)
            {
                escaped.push(ProxyIndex::new(four + lane));
            }
        }
    }
}

/// Adds the motions `travel` of four proxies, at most 1e9 each, to their counters, wrapping. Unit: 2^-26 length units.
#[inline(always)]
fn add_travel(counters: &mut [u32], travel: f32x4) {
    let most = f32x4::splat(1e9);
    let way = select(travel.simd_lt(most), travel, most).to_array();
    for (counter, way) in counters.iter_mut().zip(way) {
        *counter = counter.wrapping_add(way as u32);
    }
}
