//! Broad phase: computes fat AABBs and moves their proxies in the hash grid.

use super::hash_grid::{HashGrid, PackedAabb};
use super::pairs::Pairs;
use super::proxies::Proxies;
use crate::precise::bodies::BodySet;
use crate::precise::depth::interface::DepthInterval;
use crate::precise::depth::{DepthState, FeatureGate};
use crate::precise::integration::find_escaped_proxies;
use crate::precise::island::sleep::SleepState;
use crate::precise::scaled_parameters::{AabbMargin, Parameters};

/// AABB of the ground of `twohalf` (low x, low y, high x, high y, length units): all points with y >= 0, since y points down.
const GROUND_BOUNDS: [f32; 4] = [f32::MIN, 0.0, f32::MAX, f32::MAX];
/// Increase of [`Proxies::travel`] of a proxy whose body was moved at once, in 2^-26 length units: all of its pairs are due.
const TELEPORT_TRAVEL: u32 = 1 << 30;

/// Parts that the fat AABBs of proxies depend on, and those that store them.
pub(in crate::precise) struct FatAabbs<'a> {
    pub(in crate::precise) bodies: &'a BodySet,
    pub(in crate::precise) proxies: &'a mut Proxies,
    pub(in crate::precise) grid: &'a mut HashGrid,
    pub(in crate::precise) depth: Option<FeatureGate<&'a mut DepthState>>,
    pub(in crate::precise) parameters: &'a Parameters,
    /// Length of the step, seconds, >= 0.
    pub(in crate::precise) dt: f32,
}

impl FatAabbs<'_> {
    /// Computes a new fat AABB for each proxy whose tight AABB has left its fat AABB. The broad phase of the next step searches
    /// the pairs of these proxies.
    pub(in crate::precise) fn refit(&mut self, sleep: &SleepState, pairs: &Pairs) {
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
    pub(in crate::precise) fn enlarge(&mut self, proxy: u32) {
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
    pub(in crate::precise) fn teleport(&mut self, proxy: u32) {
        let travel = &mut self.proxies.travel[proxy as usize];
        *travel = travel.wrapping_add(TELEPORT_TRAVEL);
        self.enlarge(proxy);
    }

    /// Inserts a new proxy into the broad phase: computes its fat AABB and lists the proxy for the next search of pairs.
    pub(in crate::precise) fn insert(&mut self, proxy: u32) {
        self.proxies.refitted.push(proxy);
        self.enlarge(proxy);
    }

    /// Inserts a proxy into the broad phase with a saved fat AABB (`bounds`) and fat interval along z (`depths`), length units.
    pub(in crate::precise) fn insert_saved(&mut self, proxy: u32, bounds: PackedAabb, depths: DepthInterval) {
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
}
