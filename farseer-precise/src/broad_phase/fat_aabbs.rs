//! Broad phase: computes fat AABBs and moves their proxies in the hash grid.

use std::ops::Range;

use wide::f32x4;

use super::hash_grid::{HashGrid, PackedAabb};
use super::pairs::Pairs;
use super::proxies::{BodyType, Proxies, Proxy};
use crate::bodies::BodySet;
use crate::depth::feature_gate::FeatureGate;
use crate::depth::interface::DepthInterval;
use crate::depth::state::DepthState;
use crate::island::sleep::SleepState;
use crate::math::lanes::{columns, gather, select};
use crate::math::plane::length;
use crate::math::scalar::nearest_finite;
use crate::parameters::narrow_phase::CCD_MAX_COORDINATE;
use crate::scaled_parameters::{AabbMargin, Parameters};

/// AABB of the ground of `twohalf` (low x, low y, high x, high y, length units): all points with y >= 0, since y points down.
const GROUND_BOUNDS: [f32; 4] = [f32::MIN, 0.0, f32::MAX, f32::MAX];
/// Increase of [`Proxies::travel`] of a proxy whose body was moved at once, in 2^-26 length units: all of its pairs are due.
const TELEPORT_TRAVEL: u32 = 1 << 30;

/// Returns whether the AABB `outer` contains the AABB `inner`.
pub(crate) fn aabb_contains(outer: &PackedAabb, inner: &PackedAabb) -> bool {
    outer[0] <= inner[0] && outer[1] <= inner[1] && outer[2] >= inner[2] && outer[3] >= inner[3]
}

/// Returns the smallest AABB that contains two AABBs.
fn aabb_union(one: &PackedAabb, other: &PackedAabb) -> PackedAabb {
    let least = |axis: usize| if one[axis] < other[axis] { one[axis] } else { other[axis] };
    let most = |axis: usize| if one[axis] > other[axis] { one[axis] } else { other[axis] };
    [least(0), least(1), most(2), most(3)]
}

impl Proxies {
    /// Returns the swept AABB of a proxy in world axes, length units: the AABB of its whole path through the step. The array is
    /// the displacement of its body: x, y (length units), rotation (radians), z (length units).
    ///
    /// A rotation moves a point by at most its chord, which is no longer than twice the distance of the point from the origin
    /// of the body.
    pub(crate) fn swept_aabb(
        &self,
        proxy: u32,
        [dx, dy, turned, _]: [f32; 4],
        bodies: &BodySet,
        parameters: &Parameters,
    ) -> PackedAabb {
        let turning = self.all[proxy as usize].shape.max_extent * turned.abs().min(2.0);
        let [x, y, to_x, to_y] = self.tight_aabb(proxy as usize, bodies, parameters);
        let low = |from: f32, way: f32| from - turning + if way < 0.0 { way } else { 0.0 };
        let high = |from: f32, way: f32| from + turning + if way < 0.0 { 0.0 } else { way };
        [low(x, dx), low(y, dy), high(to_x, dx), high(to_y, dy)].map(nearest_finite)
    }
}

/// Returns whether a proxy belongs to a kinematic body and moves in the step by more than the speculative distance. `dt` is the
/// step in seconds. False for displacements from [`CCD_MAX_COORDINATE`] on.
pub(crate) fn is_fast_kinematic(proxy: &Proxy, bodies: &BodySet, parameters: &Parameters, dt: f32) -> bool {
    if proxy.body_type != BodyType::Kinematic || proxy.is_world {
        return false;
    }
    let [x, y, spin, z] = bodies.states[proxy.body as usize].velocity;
    let distance = (length([length([x, y]), z]) + spin.abs() * proxy.shape.max_extent) * dt;
    distance > parameters.speculative_distance && distance < CCD_MAX_COORDINATE
}

/// Adds the motion in the step to `Proxies::travel`, and adds each proxy whose tight AABB has left its fat AABB to
/// `Proxies::refitted`.
///
/// The motion of a proxy is |dx| + |dy| + |dz| + extent * |rotation|, for the displacement of its body in the step. The extent
/// is the greatest distance of the surface from the body's origin. The motion is an upper bound for the path of each point of
/// the proxy, rounded up to a multiple of 2^-26 length units. The tight AABB includes the speculative distance.
#[inline(always)]
fn find_escaped_proxies(
    proxies: &mut Proxies,
    bodies: &BodySet,
    runs: &[Range<usize>],
    parameters: &Parameters,
) {
    let scale = f32x4::splat(parameters.travel_scale());
    let speculative_distance = f32x4::splat(parameters.speculative_distance);
    let Proxies {
        all,
        local_aabbs: boxes,
        fat_aabbs: bounds,
        travel: motion,
        refitted: escaped,
        movable_end: movable,
        ..
    } = proxies;
    for four in runs.iter().flat_map(|run| run.clone().step_by(4)) {
        let of = &all[four..four + 4];
        let places: [u32; 4] = std::array::from_fn(|lane| of[lane].body);
        let [x, y, c, s] = gather(&bodies.poses, &places);
        let [dx, dy, turned, dz] = gather(&bodies.delta_pose, &places);
        let [Some(boxes), Some(bounds)] = [&*boxes, &*bounds].map(|of| of[four..].first_chunk::<4>()) else {
            continue;
        };
        let [cx, cy, hx, hy] = columns(boxes);
        let radius = f32x4::new(std::array::from_fn(|lane| of[lane].shape.radius));
        let reach = f32x4::new(std::array::from_fn(|lane| of[lane].shape.max_extent));
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
        let travel = (dx.abs() + dy.abs() + dz.abs() + reach * turned.abs()) * scale + f32x4::splat(0.999);
        add_travel(&mut motion[four..four + 4], travel);
        let left = has_left.to_bitmask();
        for lane in (0..4).filter(|lane| left >> lane & 1 == 1 && four + lane < *movable) {
            escaped.push((four + lane) as u32);
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

/// Parts that the fat AABBs of proxies depend on, and those that store them.
pub struct FatAabbs<'a> {
    pub(crate) bodies: &'a BodySet,
    pub(crate) proxies: &'a mut Proxies,
    pub(crate) grid: &'a mut HashGrid,
    pub(crate) depth: Option<FeatureGate<&'a mut DepthState>>,
    pub(crate) parameters: &'a Parameters,
    /// Length of the step, seconds, >= 0.
    pub(crate) dt: f32,
}

impl FatAabbs<'_> {
    /// Computes a new fat AABB for each proxy whose tight AABB has left its fat AABB. The broad phase of the next step searches
    /// the pairs of these proxies.
    pub(crate) fn refit(&mut self, sleep: &SleepState, pairs: &Pairs) {
        let runs = &sleep.awake_proxy_runs;
        find_escaped_proxies(self.proxies, self.bodies, runs, self.parameters);
        if let Some(space) = &self.depth {
            space.collect_escaped(self.proxies, self.bodies, runs, self.parameters);
        }
        for at in 0..self.proxies.refitted.len() {
            let proxy = self.proxies.refitted[at];
            let extent = self.proxies.all[proxy as usize].shape.max_extent;
            let margin = match pairs.pairs_of(proxy).next() {
                None => self.parameters.margin_without_pairs(extent),
                Some(_) => self.parameters.margin_for_extent(extent),
            };
            self.enlarge_by(proxy, margin);
        }
    }

    /// Computes and stores the fat AABB of a proxy, and moves the proxy in the hash grid. The margin is always the one for
    /// proxies that are in pairs ([`Parameters::margin_for_extent`]).
    pub(crate) fn enlarge(&mut self, proxy: u32) {
        let extent = self.proxies.all[proxy as usize].shape.max_extent;
        self.enlarge_by(proxy, self.parameters.margin_for_extent(extent));
    }

    /// Computes and stores the fat AABB of a proxy with `margin`, and moves the proxy in the hash grid.
    fn enlarge_by(&mut self, proxy: u32, margin: AabbMargin) {
        let bounds = self.proxies.fat_aabb(proxy as usize, self.bodies, self.parameters, margin, self.dt);
        self.proxies.fat_aabbs[proxy as usize] = bounds;
        let may_stop = self.proxies.all[proxy as usize].may_stop();
        let Some(depth) = &mut self.depth else {
            return self.grid.insert_or_move(proxy, &bounds, may_stop);
        };
        if proxy == depth.ground_proxy {
            self.proxies.fat_aabbs[proxy as usize] = GROUND_BOUNDS;
        }
        let body = self.proxies.all[proxy as usize].body;
        let speed = self.bodies.states.get(body as usize).map_or(0.0, |hot| hot.velocity[3]);
        depth.set_fat_interval(proxy, body, speed * self.dt, margin, self.parameters.speculative_distance);
        if depth.is_in_grid(proxy) {
            self.grid.insert_or_move(proxy, &depth.grid_bounds(proxy, &bounds), may_stop);
        }
    }

    /// Moves a proxy to the new pose of its body at once: computes a new fat AABB, and raises the travel so that all pairs of
    /// the proxy become due for an update.
    pub fn teleport(&mut self, proxy: u32) {
        let travel = &mut self.proxies.travel[proxy as usize];
        *travel = travel.wrapping_add(TELEPORT_TRAVEL);
        self.enlarge(proxy);
    }

    /// Inserts a new proxy into the broad phase: computes its fat AABB and lists the proxy for the next search of pairs.
    pub fn insert(&mut self, proxy: u32) {
        self.proxies.refitted.push(proxy);
        self.enlarge(proxy);
    }

    /// Inserts a proxy into the broad phase with a saved fat AABB (`bounds`) and fat interval along z (`depths`), length units.
    pub fn insert_saved(&mut self, proxy: u32, bounds: PackedAabb, depths: DepthInterval) {
        self.proxies.fat_aabbs[proxy as usize] = bounds;
        let may_stop = self.proxies.all[proxy as usize].may_stop();
        let Some(space) = &mut self.depth else {
            return self.grid.insert_or_move(proxy, &bounds, may_stop);
        };
        space.set_interval(proxy, depths);
        if space.is_in_grid(proxy) {
            self.grid.insert_or_move(proxy, &space.grid_bounds(proxy, &bounds), may_stop);
        }
    }

    /// Enlarges the fat AABB of a proxy to its swept AABB, unless it contains the swept AABB already. Returns whether the fat
    /// AABB has changed. `displacement`: x, y (length units), rotation (radians), z (length units).
    pub(crate) fn enlarge_to_sweep(&mut self, proxy: u32, displacement: [f32; 4]) -> bool {
        let swept = self.proxies.swept_aabb(proxy, displacement, self.bodies, self.parameters);
        if self.contains(proxy, &swept, displacement[3]) {
            return false;
        }
        self.enlarge(proxy);
        let body = self.proxies.all[proxy as usize].body;
        let may_stop = self.proxies.all[proxy as usize].may_stop();
        let bounds = aabb_union(&self.proxies.fat_aabbs[proxy as usize], &swept);
        self.proxies.fat_aabbs[proxy as usize] = bounds;
        if let Some(space) = &mut self.depth {
            let margin = self.parameters.speculative_distance;
            let depths = space.swept_interval(proxy, body, displacement[3], margin);
            let depths = space.interval(proxy as usize).union(depths);
            space.set_interval(proxy, depths);
            self.grid.insert_or_move(proxy, &space.grid_bounds(proxy, &bounds), may_stop);
        } else {
            self.grid.insert_or_move(proxy, &bounds, may_stop);
        }
        true
    }

    /// Enlarges the fat AABBs of the fast proxies of a kinematic body to their swept AABBs, and lists these proxies for the
    /// next search of pairs. `displacement` is that of the body in the step: x, y (length units), rotation (radians), z (length
    /// units).
    pub fn enlarge_kinematic_to_sweep(&mut self, body: usize, displacement: [f32; 4]) {
        let mut next = self.proxies.first_of_body(body);
        while let Some(proxy) = next {
            next = self.proxies.next_of_body(proxy);
            if is_fast_kinematic(&self.proxies.all[proxy as usize], self.bodies, self.parameters, self.dt)
                && self.enlarge_to_sweep(proxy, displacement)
            {
                self.proxies.refitted.push(proxy);
            }
        }
    }

    /// Enlarges the fat AABBs of a body to the swept AABBs of its displacement in the step. Appends the proxies with a new fat
    /// AABB to `enlarged`.
    pub(crate) fn enlarge_body_to_sweep(&mut self, body: usize, enlarged: &mut Vec<u32>) {
        let mut next = self.proxies.first_of_body(body);
        while let Some(proxy) = next {
            next = self.proxies.next_of_body(proxy);
            if self.enlarge_to_sweep(proxy, self.bodies.delta_pose[body]) {
                enlarged.push(proxy);
            }
        }
    }

    /// Returns whether the fat AABB of a proxy contains its swept AABB and, with a depth axis, the fat interval contains its
    /// swept interval. The array is the displacement of its body: x, y (length units), rotation (radians), z (length units).
    pub(crate) fn contains_sweep(&self, proxy: u32, displacement: [f32; 4]) -> bool {
        let swept = self.proxies.swept_aabb(proxy, displacement, self.bodies, self.parameters);
        self.contains(proxy, &swept, displacement[3])
    }

    /// Returns whether the fat AABB of a proxy contains `swept_aabb` and, with a depth axis, the fat interval contains the
    /// swept interval of a displacement `dz` along z, length units.
    fn contains(&self, proxy: u32, swept_aabb: &PackedAabb, dz: f32) -> bool {
        let body = self.proxies.all[proxy as usize].body;
        aabb_contains(&self.proxies.fat_aabbs[proxy as usize], swept_aabb)
            && self.depth.as_ref().is_none_or(|space| {
                let depths = space.swept_interval(proxy, body, dz, self.parameters.speculative_distance);
                space.interval(proxy as usize).contains(depths)
            })
    }
}
