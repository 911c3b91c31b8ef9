//! Broad phase: computes fat AABBs and moves their proxies in the hash grid.

use super::hash_grid::{HashGrid, PackedAabb};
use super::pairs::Pairs;
use super::proxies::{BodyType, Proxies, Proxy};
use crate::bodies::BodySet;
use crate::depth::feature_gate::FeatureGate;
use crate::depth::interface::DepthInterval;
use crate::depth::state::DepthState;
use crate::index::{BodyIndex, ProxyIndex};
use crate::island::sleep::SleepState;
use crate::math::plane::length;
use crate::math::scalar::nearest_finite;
use crate::parameters::narrow_phase::CCD_MAX_COORDINATE;
use crate::scaled_parameters::{AabbMargin, Parameters};
use wide::f32x4;

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
        proxy: ProxyIndex,
        displacement: [f32; 4],
        bodies: &BodySet,
        parameters: &Parameters,
    ) -> PackedAabb {
        self.unbounded_swept_aabb(proxy, displacement, bodies, parameters).map(nearest_finite)
    }

    /// Returns the [swept AABB](Self::swept_aabb) of a proxy with coordinates that may be infinite or NaN.
    #[inline(always)]
    fn unbounded_swept_aabb(
        &self,
        proxy: ProxyIndex,
        [dx, dy, turned, _]: [f32; 4],
        bodies: &BodySet,
        parameters: &Parameters,
    ) -> PackedAabb {
        let turning = self.max_extent_of(proxy) * turned.abs().min(2.0);
        let tight = f32x4::new(self.tight_aabb(proxy, bodies, parameters));
        let least = |way: f32| if way < 0.0 { way } else { 0.0 };
        let most = |way: f32| if way < 0.0 { 0.0 } else { way };
        let ways = f32x4::new([least(dx), least(dy), most(dx), most(dy)]);
        (tight + f32x4::new([-turning, -turning, turning, turning]) + ways).to_array()
    }
}

/// Returns whether a proxy belongs to a kinematic body and moves in the step by more than the speculative distance. `dt` is the
/// step in seconds. False for displacements from [`CCD_MAX_COORDINATE`] on.
pub(crate) fn is_fast_kinematic(proxy: &Proxy, bodies: &BodySet, parameters: &Parameters, dt: f32) -> bool {
    if proxy.body_type != BodyType::Kinematic || proxy.is_world {
        return false;
    }
    let [x, y, spin, z] = bodies.states[proxy.body].velocity;
    let distance = (length([length([x, y]), z]) + spin.abs() * proxy.shape.max_extent) * dt;
    distance > parameters.speculative_distance && distance < CCD_MAX_COORDINATE
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
        self.proxies.find_escaped(self.bodies, runs, self.parameters);
        if let Some(space) = &self.depth {
            space.collect_escaped(self.proxies, self.bodies, runs, self.parameters);
        }
        for at in 0..self.proxies.refitted().len() {
            let proxy = self.proxies.refitted()[at];
            let extent = self.proxies.max_extent_of(proxy);
            let margin = match pairs.pairs_of(proxy).next() {
                None => self.parameters.margin_without_pairs(extent),
                Some(_) => self.parameters.margin_for_extent(extent),
            };
            self.enlarge_by(proxy, margin);
        }
    }

    /// Computes and stores the fat AABB of a proxy, and moves the proxy in the hash grid. The margin is always the one for
    /// proxies that are in pairs ([`Parameters::margin_for_extent`]).
    pub(crate) fn enlarge(&mut self, proxy: ProxyIndex) {
        let extent = self.proxies.max_extent_of(proxy);
        self.enlarge_by(proxy, self.parameters.margin_for_extent(extent));
    }

    /// Computes and stores the fat AABB of a proxy with `margin`, and moves the proxy in the hash grid.
    fn enlarge_by(&mut self, proxy: ProxyIndex, margin: AabbMargin) {
        let bounds = self.proxies.fat_aabb(proxy, self.bodies, self.parameters, margin, self.dt);
        self.proxies.set_fat_aabb(proxy, bounds);
        let may_stop = self.proxies.proxy(proxy).may_stop();
        let Some(depth) = &mut self.depth else {
            return self.grid.insert_or_move(proxy, &bounds, may_stop);
        };
        if proxy == depth.ground_proxy {
            self.proxies.set_fat_aabb(proxy, GROUND_BOUNDS);
        }
        let body = self.proxies.proxy(proxy).body;
        let speed = self.bodies.states.at(body).map_or(0.0, |state| state.velocity[3]);
        depth.set_fat_interval(proxy, body, speed * self.dt, margin, self.parameters.speculative_distance);
        if depth.is_in_grid(proxy) {
            self.grid.insert_or_move(proxy, &depth.grid_bounds(proxy, &bounds), may_stop);
        }
    }

    /// Moves a proxy to the new pose of its body at once: computes a new fat AABB, and raises the travel so that all pairs of
    /// the proxy become due for an update.
    pub fn teleport(&mut self, proxy: ProxyIndex) {
        let travel = self.proxies.travel_of(proxy).wrapping_add(TELEPORT_TRAVEL);
        self.proxies.set_travel(proxy, travel);
        self.enlarge(proxy);
    }

    /// Inserts a new proxy into the broad phase: computes its fat AABB and lists the proxy for the next search of pairs.
    pub fn insert(&mut self, proxy: ProxyIndex) {
        self.proxies.search_pairs_of(proxy);
        self.enlarge(proxy);
    }

    /// Inserts a proxy into the broad phase with a saved fat AABB (`bounds`) and fat interval along z (`depths`), length units.
    pub fn insert_saved(&mut self, proxy: ProxyIndex, bounds: PackedAabb, depths: DepthInterval) {
        self.proxies.set_fat_aabb(proxy, bounds);
        let may_stop = self.proxies.proxy(proxy).may_stop();
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
    pub(crate) fn enlarge_to_sweep(&mut self, proxy: ProxyIndex, displacement: [f32; 4]) -> bool {
        // A coordinate that is not finite is in no fat AABB, unless it is replaced by a finite one.
        let unbounded = self.proxies.unbounded_swept_aabb(proxy, displacement, self.bodies, self.parameters);
        if self.contains(proxy, &unbounded, displacement[3]) {
            return false;
        }
        let swept = unbounded.map(nearest_finite);
        if self.contains(proxy, &swept, displacement[3]) {
            return false;
        }
        self.enlarge(proxy);
        let body = self.proxies.proxy(proxy).body;
        let may_stop = self.proxies.proxy(proxy).may_stop();
        let bounds = aabb_union(self.proxies.fat_aabb_of(proxy), &swept);
        self.proxies.set_fat_aabb(proxy, bounds);
        if let Some(space) = &mut self.depth {
            let margin = self.parameters.speculative_distance;
            let depths = space.swept_interval(proxy, body, displacement[3], margin);
            let depths = space.interval(proxy).union(depths);
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
    pub fn enlarge_kinematic_to_sweep(&mut self, body: BodyIndex, displacement: [f32; 4]) {
        let mut next = self.proxies.first_of_body(body);
        while let Some(proxy) = next {
            next = self.proxies.next_of_body(proxy);
            if is_fast_kinematic(self.proxies.proxy(proxy), self.bodies, self.parameters, self.dt)
                && self.enlarge_to_sweep(proxy, displacement)
            {
                self.proxies.search_pairs_of(proxy);
            }
        }
    }

    /// Enlarges the fat AABBs of a body to the swept AABBs of its displacement in the step. Appends the proxies with a new fat
    /// AABB to `enlarged`.
    pub(crate) fn enlarge_body_to_sweep(&mut self, body: BodyIndex, enlarged: &mut Vec<ProxyIndex>) {
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
    pub(crate) fn contains_sweep(&self, proxy: ProxyIndex, displacement: [f32; 4]) -> bool {
        let swept = self.proxies.swept_aabb(proxy, displacement, self.bodies, self.parameters);
        self.contains(proxy, &swept, displacement[3])
    }

    /// Returns whether the fat AABB of a proxy contains `swept_aabb` and, with a depth axis, the fat interval contains the
    /// swept interval of a displacement `dz` along z, length units.
    #[inline(always)]
    fn contains(&self, proxy: ProxyIndex, swept_aabb: &PackedAabb, dz: f32) -> bool {
        let body = self.proxies.proxy(proxy).body;
        aabb_contains(self.proxies.fat_aabb_of(proxy), swept_aabb)
            && self.depth.as_ref().is_none_or(|space| {
                let depths = space.swept_interval(proxy, body, dz, self.parameters.speculative_distance);
                space.interval(proxy).contains(depths)
            })
    }
}
