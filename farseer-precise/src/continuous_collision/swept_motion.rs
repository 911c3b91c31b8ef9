//! Motion of all bodies through the step, as continuous collision reads it: swept AABBs, times of impact (TOI), obstacles.

use crate::bodies::BodySet;
use crate::broad_phase::fat_aabbs::aabb_contains;
use crate::broad_phase::hash_grid::{HashGrid, overlap};
use crate::broad_phase::pair_finder::order_pair;
use crate::broad_phase::pairs::{OneWayState, Pairs};
use crate::broad_phase::proxies::{BodyType, Proxies, Proxy};
use crate::continuous_collision::fast_body::FastBody;
use crate::continuous_collision::time_of_impact::{SweptPair, SweptShape, conservative_advancement};
use crate::depth::feature_gate::FeatureGate;
use crate::depth::state::DepthState;
use crate::index::{BodyIndex, IndexedVec, PairIndex, ProxyIndex};
use crate::island::sleep::SleepState;
use crate::math::plane::{difference, rotate, sum, translation};
use crate::math::scalar;
use crate::narrow_phase::flush_geoms::FlushFilter;
use crate::narrow_phase::one_way::PairMotion;
use crate::parameters::narrow_phase::{TOI_PENETRATION_RATIO, TOI_TOLERANCE_RATIO};
use crate::scaled_parameters::Parameters;
use crate::storage::order::sort_by_number;

/// The parts of the engine that continuous collision reads. The poses of `bodies` are those at the start of the step, and their
/// `delta_pose` is the displacement of the step.
#[derive(Clone, Copy)]
pub(crate) struct SweptMotion<'a> {
    pub(crate) bodies: &'a BodySet,
    pub(crate) proxies: &'a Proxies,
    pub(crate) pairs: &'a Pairs,
    pub(crate) grid: &'a HashGrid,
    pub(crate) sleep: &'a SleepState,
    pub(crate) depth: Option<FeatureGate<&'a DepthState>>,
    pub(crate) parameters: &'a Parameters,
    /// Length of the step, seconds, > 0.
    pub(crate) dt: f32,
}

impl<'a> SweptMotion<'a> {
    /// Returns the displacement of a body in the step: x, y (length units), rotation (radians), z (length units). Zeros for a
    /// static body.
    fn displacement(&self, body: BodyIndex) -> [f32; 4] {
        self.bodies.delta_pose.at(body).copied().unwrap_or_default()
    }

    /// Returns the convex shape of a proxy on its path through the step, with `fraction` of its displacement.
    fn swept_shape(&self, proxy: ProxyIndex, fraction: f32) -> SweptShape<'a> {
        let Proxy { body, shape, .. } = *self.proxies.proxy(proxy);
        let outline = self.proxies.vertices.shape_ref(shape);
        SweptShape {
            shape: outline,
            pose: self.bodies.poses[body],
            displacement: self.displacement(body).map(|way| way * fraction),
        }
    }

    /// Returns whether dynamic bodies may be obstacles of fast bodies: some body sleeps or is a bullet.
    fn are_dynamic_obstacles(&self) -> bool {
        self.sleep.count > 0 || self.bodies.are_bullets.contains(&true)
    }

    /// Returns whether fast bodies may have obstacles.
    pub(crate) fn has_obstacles(&self) -> bool {
        self.grid.stopper_levels() != 0 || self.are_dynamic_obstacles()
    }

    /// Stores in `pairs` the new pairs that fast bodies have along their paths, sorted by creation numbers. `is_known` is a
    /// workspace, with an entry for each proxy.
    pub(crate) fn query_sweeps(
        &self,
        fast_bodies: &[FastBody],
        (is_known, pairs): (&mut IndexedVec<ProxyIndex, bool>, &mut Vec<[ProxyIndex; 2]>),
    ) {
        let (are_dynamic_obstacles, has_obstacles) = (self.are_dynamic_obstacles(), self.has_obstacles());
        for &FastBody { body, .. } in fast_bodies {
            for proxy in self.proxies.proxies_of(body) {
                let finds_all = are_dynamic_obstacles || !self.proxies.proxy(proxy).responds;
                if finds_all || has_obstacles {
                    self.query_sweep(proxy, self.displacement(body), finds_all, (is_known, pairs));
                }
            }
        }
        sort_by_number(pairs, |&pair| self.proxies.creation_numbers(pair));
        pairs.dedup();
    }

    /// Appends to `pairs` the new pairs of a proxy that collide on its path in this step. `is_known` is a workspace, with an
    /// entry for each proxy. `displacement`: x, y (length units), rotation (radians), z (length units). `finds_all`: whether
    /// any proxy may be an obstacle, not only those that [may stop](Proxy::may_stop) bodies.
    ///
    /// A proxy whose fat AABB contains the path has all its pairs already.
    fn query_sweep(
        &self,
        proxy: ProxyIndex,
        displacement: [f32; 4],
        finds_all: bool,
        (is_known, pairs): (&mut IndexedVec<ProxyIndex, bool>, &mut Vec<[ProxyIndex; 2]>),
    ) {
        let swept = self.proxies.swept_aabb(proxy, displacement, self.bodies, self.parameters);
        if aabb_contains(self.proxies.fat_aabb_of(proxy), &swept) {
            return;
        }
        let mut are_marked = false;
        let visit = |other: ProxyIndex| {
            if !self.is_ccd_candidate(proxy, other) {
                return;
            }
            if !std::mem::replace(&mut are_marked, true) {
                self.pairs.partners(proxy).for_each(|partner| is_known[partner] = true);
            }
            if is_known[other] {
                return;
            }
            let pair = order_pair(self.proxies, self.depth, [proxy, other]);
            pairs.extend(pair.filter(|&pair| self.time_of_impact(pair, 0.0).is_some()));
        };
        match finds_all {
            true => self.grid.for_each_overlap(&swept, visit),
            false => self.grid.for_each_stopper(&swept, visit),
        }
        if are_marked {
            self.pairs.partners(proxy).for_each(|partner| is_known[partner] = false);
        }
    }

    /// Returns whether `other` may stop the fast body of `proxy`, or is a sensor that reports it. Both are indices of proxies.
    fn is_ccd_candidate(&self, proxy: ProxyIndex, other: ProxyIndex) -> bool {
        let [one, other] = [proxy, other].map(|proxy| self.proxies.proxy(proxy));
        let is_bullet = |proxy: &Proxy| self.bodies.are_bullets.at(proxy.body) == Some(&true);
        let may_stop = other.may_stop()
            || self.sleep.is_asleep(other.body)
            || is_bullet(one)
            || is_bullet(other)
            || !one.responds;
        may_stop && one.may_meet(other)
    }

    /// Returns the first time of impact of a body, as a fraction of the step, and the index of its pair. Pairs for which
    /// `accepts` returns false are ignored. `None` without an impact.
    pub(crate) fn first_toi(
        &self,
        body: BodyIndex,
        accepts: impl Fn(PairIndex) -> bool,
    ) -> Option<(f32, PairIndex)> {
        let mut first: Option<(f32, PairIndex)> = None;
        let creation_numbers = |pair: PairIndex| self.proxies.creation_numbers(self.pairs.proxies_of(pair));
        let pairs = self.pairs.pairs_of_body(self.proxies, body);
        for pair in pairs.filter(|&pair| accepts(pair) && self.is_ccd_pair(pair, body)) {
            let Some(time) = self.toi_of_pair(pair) else { continue };
            // Among equal times the pair that was created first wins, so that the order of the list does not matter.
            let is_first = first.is_none_or(|(earliest, other)| {
                time < earliest || (time == earliest && creation_numbers(pair) < creation_numbers(other))
            });
            if is_first {
                first = Some((time, pair));
            }
        }
        first
    }

    /// Returns whether continuous collision stops `body` at the other body of the pair.
    fn is_ccd_pair(&self, pair: PairIndex, body: BodyIndex) -> bool {
        let [(a, body_type), (b, _)] = self.pairs.bodies_of(self.proxies, pair);
        let other = if a == body { b } else { a };
        // A body that moves towards a bullet would pass it where the bullet stops.
        let is_bullet = || [body, other].iter().any(|&side| self.bodies.are_bullets.at(side) == Some(&true));
        let is_immovable = body_type != BodyType::Dynamic || self.sleep.is_asleep(other);
        // Most pairs end here, before their states are read.
        if !is_immovable && !is_bullet() {
            return false;
        }
        let state = self.pairs.state(pair);
        // With a depth axis, the solver keeps bodies apart that are already in contact.
        let is_in_contact = self.depth.is_some() && self.pairs.manifold(pair).count > 0;
        let passes_in_depth = || {
            self.depth.as_ref().is_some_and(|space| {
                let proxies = self.pairs.proxies_of(pair);
                space.passes_one_way_box(
                    proxies,
                    self.proxies,
                    self.bodies,
                    self.parameters.speculative_distance,
                )
            })
        };
        let is_open = || match state.one_way_state {
            OneWayState::Closed | OneWayState::Landed => false,
            OneWayState::Passes => true,
            OneWayState::Apart => !self.pair_motion().will_land(pair),
        };
        state.responds && !state.is_vetoed && !is_in_contact && !passes_in_depth() && !is_open()
    }

    /// Returns the motion of all bodies in this step, for the decisions of one-way geoms. The poses are still those at the
    /// start of the step.
    pub(crate) fn pair_motion(&self) -> PairMotion<'a> {
        let SweptMotion { bodies, proxies, pairs, parameters, .. } = *self;
        PairMotion {
            bodies,
            proxies,
            pairs,
            speculative_distance: parameters.speculative_distance,
            is_after_step: false,
        }
    }

    /// Returns the time of impact of a pair as a fraction of the step; `None` without an impact. Flush neighbours of a tile
    /// [hide](FlushFilter) the side faces of the tile.
    fn toi_of_pair(&self, pair: PairIndex) -> Option<f32> {
        let proxies = self.pairs.proxies_of(pair);
        if self.depth.is_some() {
            return self.time_of_impact(proxies, TOI_PENETRATION_RATIO);
        }
        if !self.may_meet_in_step(proxies) {
            return None;
        }
        self.time_of_impact_2d(proxies, TOI_PENETRATION_RATIO, |part, two| {
            self.flush_filter(part).separation_and_closing(pair, two)
        })
    }

    /// Returns whether the swept AABBs of two proxies overlap. They exceed the shapes by the speculative distance, so that rounding
    /// excludes no impact.
    fn may_meet_in_step(&self, proxies: [ProxyIndex; 2]) -> bool {
        let [a, b] = proxies.map(|proxy| {
            let displacement = self.displacement(self.proxies.body_of(proxy));
            self.proxies.swept_aabb(proxy, displacement, self.bodies, self.parameters)
        });
        overlap(&a, &b)
    }

    /// Returns the time of impact of two proxies as a fraction of the step; `None` without an impact.
    ///
    /// It is the time at which the shapes have the target penetration. If they overlap at the start of the step, the target is
    /// that overlap plus the target penetration. `penetration` is the target as a fraction of the speculative distance,
    /// dimensionless.
    pub(crate) fn time_of_impact(&self, proxies: [ProxyIndex; 2], penetration: f32) -> Option<f32> {
        let Some(space) = &self.depth else {
            return self.time_of_impact_2d(proxies, penetration, |fraction, two| {
                two.separation_and_closing_speed(fraction)
            });
        };
        let reach = self.parameters.speculative_distance;
        let paths = proxies.map(|proxy| self.displacement(self.proxies.proxy(proxy).body));
        conservative_advancement(penetration * reach, TOI_TOLERANCE_RATIO * reach, |part| {
            space.distance_and_closing_speed(proxies, self.proxies, self.bodies, paths, part)
        })
    }

    /// Returns the time of impact of two proxies in 2D as a fraction of the step; `None` without an impact, and for the back of
    /// a chain edge.
    ///
    /// `penetration` is the penetration at that time as a fraction of the speculative distance, dimensionless.
    /// `separation_and_closing_speed` returns the separation of the pair (length units) and its closing speed (length units per
    /// step) at a fraction of the step.
    fn time_of_impact_2d(
        &self,
        proxies: [ProxyIndex; 2],
        penetration: f32,
        separation_and_closing_speed: impl Fn(f32, &SweptPair<'_>) -> (f32, f32),
    ) -> Option<f32> {
        let reach = self.parameters.speculative_distance;
        let [a, b] = proxies.map(|proxy| self.swept_shape(proxy, 1.0));
        let pair = SweptPair { a, b };
        if pair.is_behind_edge() {
            None
        } else {
            conservative_advancement(penetration * reach, TOI_TOLERANCE_RATIO * reach, |fraction| {
                separation_and_closing_speed(fraction, &pair)
            })
        }
    }

    /// Returns the ghost filter between flush geoms, for the poses at `fraction` of the step.
    fn flush_filter(&self, fraction: f32) -> FlushFilter<'a> {
        let SweptMotion { bodies, proxies, pairs, parameters, dt, .. } = *self;
        FlushFilter { bodies, proxies, pairs, parameters, dt, time: fraction }
    }

    /// Returns the displacement of a body from its impact to the end of the step, as if it were fixed to the body that it hit:
    /// x, y (length units), rotation (radians), z (length units). Zeros without an impact.
    pub(crate) fn carried_motion(&self, fast: &[FastBody], fast_body: &FastBody) -> [f32; 4] {
        let &FastBody { body, toi, pair: Some(pair), hit_body, .. } = fast_body else { return [0.0; 4] };
        let proxies = self.pairs.proxies_of(pair).map(|proxy| self.proxies.proxy(proxy));
        let other = if proxies[0].body == hit_body { proxies[1] } else { proxies[0] };
        let pose = self.bodies.poses[body];
        let displacement = self.bodies.delta_pose[body];
        if let Some(space) = self.depth.as_ref().filter(|_| other.is_world) {
            let at = [pose[0] + toi * displacement[0], space.z_positions[body] + toi * displacement[3]];
            return space.velocity_at(other, at, self.bodies).map(|way| way * (1.0 - toi) * self.dt);
        }
        let displacement_of_other = self.displacement(other.body);
        // The other body may be fast too and stop at its own time of impact.
        let other_toi =
            fast.binary_search_by_key(&other.body, |flight| flight.body).map_or(1.0, |at| fast[at].toi);
        let remaining_time = if other_toi > toi { other_toi - toi } else { 0.0 };
        let [dx, dy, turned, dz] = displacement_of_other.map(|way| way * remaining_time);
        let at =
            |pose: [f32; 4], path: [f32; 4]| sum(translation(pose), translation(path.map(|way| way * toi)));
        let arm =
            difference(at(pose, displacement), at(self.bodies.poses[other.body], displacement_of_other));
        let (sine, cosine) = if turned == 0.0 { (0.0, 1.0) } else { scalar::sin_cos(turned) };
        let [x, y] = difference(rotate([cosine, sine], arm), arm);
        [dx + x, dy + y, turned, dz]
    }

    /// Returns whether the shapes of a pair are separated at the end of the step, if the path of `body` ends at `fraction` of
    /// its displacement.
    pub(crate) fn is_separated_after(&self, pair: PairIndex, body: BodyIndex, fraction: f32) -> bool {
        let [a, b] = self.pairs.proxies_of(pair).map(|proxy| {
            let is_stopped = self.proxies.body_of(proxy) == body;
            self.swept_shape(proxy, if is_stopped { fraction } else { 1.0 })
        });
        SweptPair { a, b }.separation(1.0).0 > 0.0
    }
}
