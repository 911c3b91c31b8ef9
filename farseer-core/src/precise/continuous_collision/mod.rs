//! Continuous collision: fast bodies stop at their time of impact (TOI).
//!
//! The solver moves bodies along straight paths through the step. A dynamic body whose displacement exceeds its smallest extent
//! (least distance from its middle to its surface) could end behind a wall without a contact. Its path ends at the first TOI
//! with a geom that stops it. That is a geom of a static, kinematic or sleeping body, or of any body if one of the two is a
//! bullet. The body keeps the velocity of that time, and the next step finds the contact.
//!
//! The TOI is that of the relative motion, by [conservative advancement](time_of_impact). Between the TOI and the end of the
//! step the body moves with the body that it hit, as if fixed to it. Otherwise a descending lift would separate from the body
//! after every impact, and the body would never land.
//!
//! The broad phase is queried along the path only for geoms that can stop the body, and pairs are made only for actual impacts.
//! The cost does not depend on the number of other bodies along the path (E. Catto, Box2D 3, `solver.c`: continuous collision
//! queries the static tree and keeps no pairs).

pub(super) mod joined_impacts;
pub(super) mod time_of_impact;

use super::Precise;
use super::bodies::BodySet;
use super::depth::interface::is_geom;
use super::scaled_parameters::{Parameters, StepContext};
use crate::geom::GeomId;
use crate::math::plane::{difference, length, rotate, sum, translation};
use crate::math::scalar::{self, nearest_finite};
use crate::objects::Objects;
use crate::precise::broad_phase::hash_grid::PackedAabb;
use crate::precise::broad_phase::proxies::{BodyType, Proxy};
use crate::precise::continuous_collision::time_of_impact::{SweptPair, SweptShape, conservative_advancement};
use crate::precise::narrow_phase::flush_geoms::FlushFilter;
use crate::precise::narrow_phase::one_way::{OneWayState, PairMotion};
use crate::precise::parameters::narrow_phase::{
    CCD_MAX_COORDINATE, TOI_PENETRATION_RATIO, TOI_TOLERANCE_RATIO,
};
use crate::storage::order::{packed_key, sort_by_number};

/// A dynamic body that is fast in this step (it moves by more than the least distance from its middle to its surface), with its
/// first impact.
#[derive(Debug, Clone, Copy)]
pub(super) struct FastBody {
    /// Index of the body in [`BodySet`]; the body is movable.
    pub(super) body: u32,
    /// Time of impact of the body as a fraction of the step, dimensionless, 0..=1; 1 without an impact.
    pub(super) toi: f32,
    /// Index of the pair of proxies that collide at the time of impact; `None` without an impact.
    pub(super) pair: Option<u32>,
    /// Index of the body that collides at the time of impact: this body, or one that is [joined](joined_impacts) to it.
    pub(super) hit_body: u32,
    /// Whether the body stops because a body of its articulation has an impact.
    pub(super) is_joined: bool,
    /// Displacement of the body from its impact to the end of the step, while it moves with the body that it hit: x, y (length
    /// units), rotation (radians), z (length units).
    pub(super) carried_motion: [f32; 4],
}

impl FastBody {
    /// Returns a fast body without an impact: time of impact 1. `body` is the index of the body.
    pub(super) fn of(body: u32) -> Self {
        FastBody { body, toi: 1.0, pair: None, hit_body: body, is_joined: false, carried_motion: [0.0; 4] }
    }
}

/// Returns whether a body moves in the step by more than `min_extent`, the least distance from its middle to its surface, and
/// by less than [`CCD_MAX_COORDINATE`].
///
/// The array is the displacement of the body: x, y (length units), rotation (radians), z (length units). `max_extent` is the
/// largest distance of its surface from its origin. Both extents are in length units.
fn is_fast([x, y, turned, z]: [f32; 4], max_extent: f32, min_extent: f32) -> bool {
    let distance = x.abs() + y.abs() + z.abs() + max_extent * turned.abs();
    distance > min_extent && distance < CCD_MAX_COORDINATE
}

/// Returns whether a proxy belongs to a kinematic body and moves in the step by more than the speculative distance. `dt` is the
/// step in seconds. False for displacements from [`CCD_MAX_COORDINATE`] on.
pub(super) fn is_fast_kinematic(proxy: &Proxy, bodies: &BodySet, parameters: &Parameters, dt: f32) -> bool {
    if proxy.body_type != BodyType::Kinematic || !is_geom(proxy.geom) {
        return false;
    }
    let [x, y, spin, z] = bodies.states[proxy.body as usize].velocity;
    let distance = (length([length([x, y]), z]) + spin.abs() * proxy.shape.max_extent) * dt;
    distance > parameters.speculative_distance && distance < CCD_MAX_COORDINATE
}

/// Returns whether the AABB `outer` contains the AABB `inner`.
fn aabb_contains(outer: &PackedAabb, inner: &PackedAabb) -> bool {
    outer[0] <= inner[0] && outer[1] <= inner[1] && outer[2] >= inner[2] && outer[3] >= inner[3]
}

/// Returns the smallest AABB that contains two AABBs.
fn aabb_union(one: &PackedAabb, other: &PackedAabb) -> PackedAabb {
    let least = |axis: usize| if one[axis] < other[axis] { one[axis] } else { other[axis] };
    let most = |axis: usize| if one[axis] > other[axis] { one[axis] } else { other[axis] };
    [least(0), least(1), most(2), most(3)]
}

/// Stages before the solver.
impl Precise {
    /// Sets the velocities of kinematic bodies for the step, and enlarges the fat AABBs of their fast proxies to the swept
    /// AABBs.
    ///
    /// The broad phase then pairs these proxies with the geoms along their paths.
    pub(crate) fn begin_kinematic(&mut self, objects: &Objects) {
        for at in 0..self.bodies.kinematic.len() {
            let number = self.bodies.kinematic[at] as usize;
            let Some((id, entry)) =
                self.bodies.ids[number].and_then(|id| Some((id, objects.bodies.get(id)?)))
            else {
                continue;
            };
            let (velocity, spin) = entry.body.kinematic_velocity(self.dt);
            let along_depth = self.depth.as_ref().map_or(0.0, |space| space.kinematic_velocity(id, self.dt));
            let velocity = [velocity.x, velocity.y, spin, along_depth];
            if velocity.iter().all(|velocity| velocity.is_finite()) {
                self.bodies.states[number].velocity = velocity;
                self.enlarge_body_to_sweep(number, velocity.map(|velocity| velocity * self.dt));
            }
        }
    }

    /// Enlarges the fat AABBs of the fast proxies of a kinematic body to their swept AABBs. `displacement` is that of the body
    /// in the step: x, y (length units), rotation (radians), z (length units).
    fn enlarge_body_to_sweep(&mut self, body: usize, displacement: [f32; 4]) {
        let mut proxies = std::mem::take(&mut self.pair_scratch);
        proxies.extend(self.proxies.proxies_of(body));
        for proxy in proxies.drain(..) {
            let Precise { bodies, parameters, dt, .. } = self;
            if is_fast_kinematic(&self.proxies.all[proxy as usize], bodies, parameters, *dt)
                && self.enlarge_to_sweep(proxy, displacement)
            {
                self.proxies.refitted.push(proxy);
            }
        }
        self.pair_scratch = proxies;
    }

    /// Adds contacts of fast kinematic bodies with the dynamic bodies that they will hit in this step.
    pub(super) fn find_contacts_ahead_of_kinematic(&mut self) {
        let mut pairs = std::mem::take(&mut self.pair_scratch);
        let Precise { bodies, proxies, parameters, dt, .. } = self;
        for proxy in bodies.kinematic.iter().flat_map(|&number| proxies.proxies_of(number as usize)) {
            if is_fast_kinematic(&proxies.all[proxy as usize], bodies, parameters, *dt) {
                pairs.extend(self.pairs.pairs_of(proxy).map(|pair| pair as u32));
            }
        }
        // In the order of pair indices, which snapshots preserve: the order of contact constraints depends on it.
        pairs.sort_unstable();
        pairs.drain(..).for_each(|pair| self.narrow_phase().add_swept_contact(pair as usize));
        self.pair_scratch = pairs;
    }
}

/// Stages after the solver.
impl Precise {
    /// Stores the fast bodies of the step in `fast_bodies`: dynamic, awake, and moving by more than the least distance from
    /// their middle to their surface. With a depth axis a motion by more than the speculative distance suffices. Returns
    /// whether there are any.
    pub(crate) fn find_fast_bodies(&mut self) -> bool {
        self.fast_bodies.clear();
        self.sensor_passthroughs.clear();
        // With a depth axis, the contact normal follows from the last displacement, so that no body may penetrate another
        // deeply.
        let max_threshold =
            if self.depth.is_some() { self.parameters.speculative_distance } else { f32::MAX };
        let Precise { bodies, sleep, fast_bodies: fast, .. } = self;
        for run in &sleep.awake_body_runs {
            let (displacements, max_extents) =
                (&bodies.delta_pose[run.clone()], &bodies.max_extents[run.clone()]);
            let of = run.clone().zip(displacements).zip(max_extents).zip(&bodies.min_extents[run.clone()]);
            for (((number, &path), &reach), &core) in of {
                let core = if core < max_threshold { core } else { max_threshold };
                let is_body = || bodies.ids[number].is_some() && !bodies.is_kinematic(number);
                if is_fast(path, reach, core) && !sleep.is_asleep(number) && is_body() {
                    fast.push(FastBody::of(number as u32));
                }
            }
        }
        !self.fast_bodies.is_empty()
    }

    /// Finds the new pairs that fast bodies have along their paths, and stores them in `new_pairs`. Returns the number of these
    /// pairs. No pair is removed here.
    pub(crate) fn find_pairs_of_fast_bodies(&mut self) -> usize {
        if self.depth.is_some() {
            return self.enlarge_and_find_pairs();
        }
        let mut found = std::mem::take(&mut self.new_pairs);
        let mut is_known = std::mem::take(&mut self.proxy_flags);
        found.clear();
        let stoppers = self.stopper_levels();
        for fast_body in &self.fast_bodies {
            let displacement = self.bodies.delta_pose[fast_body.body as usize];
            for proxy in self.proxies.proxies_of(fast_body.body as usize) {
                let levels = if self.proxies.all[proxy as usize].responds { stoppers } else { !0 };
                if levels != 0 {
                    self.query_sweep(proxy, displacement, levels, (&mut is_known, &mut found));
                }
            }
        }
        self.proxy_flags = is_known;
        sort_by_number(&mut found, |&pair| self.proxies.creation_numbers(pair));
        found.dedup();
        self.new_pairs = found;
        self.new_pairs.len()
    }

    /// Returns the mask of the grid's levels that may contain obstacles of fast bodies: all levels if a body sleeps or is a
    /// bullet, since dynamic bodies then are obstacles, too.
    fn stopper_levels(&self) -> u64 {
        let are_dynamic_obstacles = self.sleep.count > 0 || self.bodies.are_bullets.contains(&true);
        if are_dynamic_obstacles { !0 } else { self.grid.stopper_levels() }
    }

    /// Appends to `pairs` the new pairs of a proxy that collide on its path in this step. `is_known` is a workspace, with an
    /// entry for each proxy. `displacement`: x, y (length units), rotation (radians), z (length units). `levels`: mask of the
    /// levels of the grid that may contain obstacles.
    ///
    /// A proxy whose fat AABB contains the path has all its pairs already.
    fn query_sweep(
        &self,
        proxy: u32,
        displacement: [f32; 4],
        levels: u64,
        (is_known, pairs): (&mut [bool], &mut Vec<[u32; 2]>),
    ) {
        let swept = self.swept_aabb(proxy, displacement);
        if aabb_contains(&self.proxies.fat_aabbs[proxy as usize], &swept) {
            return;
        }
        self.pairs.partners(proxy).for_each(|partner| is_known[partner as usize] = true);
        self.grid.for_each_overlap_in_levels(levels, &swept, |other| {
            if is_known[other as usize] || !self.is_ccd_candidate(proxy, other) {
                return;
            }
            let pair = self.order_pair([proxy, other]);
            pairs.extend(pair.filter(|&pair| self.time_of_impact(pair, 0.0).is_some()));
        });
        self.pairs.partners(proxy).for_each(|partner| is_known[partner as usize] = false);
    }

    /// Returns whether `other` may stop the fast body of `proxy`, or is a sensor that reports it. Both are indices of proxies.
    fn is_ccd_candidate(&self, proxy: u32, other: u32) -> bool {
        let [one, other] = [proxy, other].map(|proxy| &self.proxies.all[proxy as usize]);
        let is_bullet = |proxy: &Proxy| self.bodies.are_bullets.get(proxy.body as usize) == Some(&true);
        let may_stop = other.may_stop()
            || self.sleep.is_asleep(other.body as usize)
            || is_bullet(one)
            || is_bullet(other)
            || !one.responds;
        may_stop && one.may_meet(other)
    }

    /// Enlarges the fat AABBs of all fast bodies to their swept AABBs and finds their new pairs, in worlds with a depth axis.
    /// Returns the number of new pairs.
    ///
    /// With a depth axis many bodies are a little fast. Larger AABBs last for several steps.
    fn enlarge_and_find_pairs(&mut self) -> usize {
        for at in 0..self.fast_bodies.len() {
            let body = self.fast_bodies[at].body as usize;
            let mut proxies = std::mem::take(&mut self.pair_scratch);
            proxies.extend(self.proxies.proxies_of(body));
            for proxy in proxies.drain(..) {
                if self.enlarge_to_sweep(proxy, self.bodies.delta_pose[body]) {
                    self.enlarged_proxies.push(proxy);
                }
            }
            self.pair_scratch = proxies;
        }
        let mut widened = std::mem::take(&mut self.enlarged_proxies);
        let found = self.find_new_pairs(&widened);
        widened.clear();
        self.enlarged_proxies = widened;
        found
    }

    /// Enlarges the fat AABB of a proxy to its swept AABB, unless it contains the swept AABB already. Returns whether the fat
    /// AABB has changed. `displacement`: x, y (length units), rotation (radians), z (length units).
    fn enlarge_to_sweep(&mut self, proxy: u32, displacement: [f32; 4]) -> bool {
        let (swept, dz) = (self.swept_aabb(proxy, displacement), displacement[3]);
        if self.contains_sweep(proxy, &swept, dz) {
            return false;
        }
        self.enlarge_aabb(proxy);
        let body = self.proxies.all[proxy as usize].body;
        let may_stop = self.proxies.all[proxy as usize].may_stop();
        let bounds = aabb_union(&self.proxies.fat_aabbs[proxy as usize], &swept);
        self.proxies.fat_aabbs[proxy as usize] = bounds;
        if let Some(space) = self.depth.as_deref_mut() {
            let depths = space.swept_interval(proxy, body, dz, self.parameters.speculative_distance);
            space.set_interval(proxy, space.interval(proxy as usize).union(depths));
            self.grid.insert_or_move(proxy, &space.grid_bounds(proxy, &bounds), may_stop);
        } else {
            self.grid.insert_or_move(proxy, &bounds, may_stop);
        }
        true
    }

    /// Returns whether the fat AABB of a proxy contains its swept AABB and, with a depth axis, the fat interval contains its
    /// swept interval. `dz` is the displacement of its body along z in the step, length units.
    pub(super) fn contains_sweep(&self, proxy: u32, swept_aabb: &PackedAabb, dz: f32) -> bool {
        let body = self.proxies.all[proxy as usize].body;
        aabb_contains(&self.proxies.fat_aabbs[proxy as usize], swept_aabb)
            && self.depth.as_ref().is_none_or(|space| {
                let depths = space.swept_interval(proxy, body, dz, self.parameters.speculative_distance);
                space.interval(proxy as usize).contains(depths)
            })
    }

    /// Returns the swept AABB of a proxy in world axes, length units: the AABB of its whole path through the step. The array is
    /// the displacement of its body: x, y (length units), rotation (radians), z (length units).
    ///
    /// A rotation moves a point by at most its chord, which is no longer than twice the distance of the point from the origin
    /// of the body.
    pub(super) fn swept_aabb(&self, proxy: u32, [dx, dy, turned, _]: [f32; 4]) -> PackedAabb {
        let turning = self.proxies.all[proxy as usize].shape.max_extent * turned.abs().min(2.0);
        let [x, y, to_x, to_y] = self.proxies.tight_aabb(proxy as usize, &self.bodies, &self.parameters);
        let low = |from: f32, way: f32| from - turning + if way < 0.0 { way } else { 0.0 };
        let high = |from: f32, way: f32| from + turning + if way < 0.0 { 0.0 } else { way };
        [low(x, dx), low(y, dy), high(to_x, dx), high(to_y, dy)].map(nearest_finite)
    }

    /// Ends the paths of fast bodies at their times of impact. Returns whether a body then moves on with the body that it hit.
    ///
    /// If so, the caller finds the new pairs on that path and calls [`clamp_carried_motion`](Self::clamp_carried_motion).
    pub(crate) fn clamp_to_toi(&mut self, step: &StepContext) -> bool {
        let mut fast = std::mem::take(&mut self.fast_bodies);
        for flight in &mut fast {
            let first = self.first_toi(flight.body as usize, |_| true);
            (flight.toi, flight.pair) = first.map_or((1.0, None), |(time, pair)| (time, Some(pair as u32)));
        }
        self.clamp_joined_bodies(&mut fast);
        self.record_sensor_passthroughs(&fast);
        for at in 0..fast.len() {
            fast[at].carried_motion = self.carried_motion(&fast, &fast[at]);
        }
        fast.retain(|flight| flight.toi < 1.0);
        for &FastBody { body, toi: time, carried_motion: carried, is_joined, .. } in &fast {
            let body = body as usize;
            for (component, carried) in self.bodies.delta_pose[body].iter_mut().zip(carried) {
                *component = *component * time + carried;
            }
            if is_joined {
                self.scale_joined_velocity(body, time);
                continue;
            }
            // Forces act until the time of impact only.
            let unused_substeps = (1.0 - time) * step.substeps as f32;
            for (velocity, push) in
                self.bodies.states[body].velocity.iter_mut().zip(self.bodies.force_delta[body])
            {
                *velocity -= unused_substeps * push;
            }
        }
        fast.retain(|flight| flight.carried_motion != [0.0; 4]);
        self.fast_bodies = fast;
        !self.fast_bodies.is_empty()
    }

    /// Ends the path of each carried body, one that moves on with the body that it hit, at the first static body on the path.
    pub(crate) fn clamp_carried_motion(&mut self) {
        let mut fast = std::mem::take(&mut self.fast_bodies);
        for &FastBody { body, pair, .. } in &fast {
            let is_static = |pair_index: usize| {
                let [(_, body_type), _] = self.bodies_of_pair(pair_index);
                body_type == BodyType::Fixed && pair != Some(pair_index as u32)
            };
            if let Some((time, _)) = self.first_toi(body as usize, is_static) {
                self.bodies.delta_pose[body as usize] =
                    self.bodies.delta_pose[body as usize].map(|way| way * time);
            }
        }
        fast.clear();
        self.fast_bodies = fast;
    }

    /// Returns the displacement of a body from its impact to the end of the step, as if it were fixed to the body that it hit:
    /// x, y (length units), rotation (radians), z (length units). Zeros without an impact.
    fn carried_motion(&self, fast: &[FastBody], fast_body: &FastBody) -> [f32; 4] {
        let &FastBody { body, toi, pair: Some(pair), hit_body, .. } = fast_body else { return [0.0; 4] };
        let proxies =
            self.pairs.triggers[pair as usize].proxies.map(|proxy| &self.proxies.all[proxy as usize]);
        let other = if proxies[0].body == hit_body { proxies[1] } else { proxies[0] };
        let pose = self.bodies.poses[body as usize];
        let displacement = self.bodies.delta_pose[body as usize];
        if let Some(space) = self.depth.as_ref().filter(|_| !is_geom(other.geom)) {
            let at =
                [pose[0] + toi * displacement[0], space.z_positions[body as usize] + toi * displacement[3]];
            return space.velocity_at(other, at, &self.bodies).map(|way| way * (1.0 - toi) * self.dt);
        }
        let displacement_of_other = self.displacement(other.body);
        // The other body may be fast too and stop at its own time of impact.
        let other_toi =
            fast.binary_search_by_key(&other.body, |flight| flight.body).map_or(1.0, |at| fast[at].toi);
        let remaining_time = if other_toi > toi { other_toi - toi } else { 0.0 };
        let [dx, dy, turned, dz] = displacement_of_other.map(|way| way * remaining_time);
        let at =
            |pose: [f32; 4], path: [f32; 4]| sum(translation(pose), translation(path.map(|way| way * toi)));
        let arm = difference(
            at(pose, displacement),
            at(self.bodies.poses[other.body as usize], displacement_of_other),
        );
        let (sine, cosine) = if turned == 0.0 { (0.0, 1.0) } else { scalar::sin_cos(turned) };
        let [x, y] = difference(rotate([cosine, sine], arm), arm);
        [dx + x, dy + y, turned, dz]
    }

    /// Returns the first time of impact of a body, as a fraction of the step, and the index of its pair. Pairs for which
    /// `accepts` returns false are ignored. `None` without an impact.
    fn first_toi(&self, body: usize, accepts: impl Fn(usize) -> bool) -> Option<(f32, usize)> {
        let mut first: Option<(f32, usize)> = None;
        let creation_numbers = |pair: usize| self.proxies.creation_numbers(self.pairs.triggers[pair].proxies);
        let pairs = self.pairs.pairs_of_body(&self.proxies, body);
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
    fn is_ccd_pair(&self, pair: usize, body: usize) -> bool {
        let state = &self.pairs.all[pair];
        let [(a, body_type), (b, _)] = self.bodies_of_pair(pair);
        let other = if a == body { b } else { a };
        // A body that moves towards a bullet would pass it where the bullet stops.
        let is_bullet = [body, other].iter().any(|&side| self.bodies.are_bullets.get(side) == Some(&true));
        let is_immovable = body_type != BodyType::Dynamic || self.sleep.is_asleep(other);
        // With a depth axis, the solver keeps bodies apart that are already in contact.
        let is_in_contact = self.depth.is_some() && self.pairs.manifolds[pair].count > 0;
        let passes_in_depth = || {
            self.depth.as_ref().is_some_and(|space| {
                let proxies = self.pairs.triggers[pair].proxies;
                space.passes_one_way_box(
                    proxies,
                    &self.proxies,
                    &self.bodies,
                    self.parameters.speculative_distance,
                )
            })
        };
        let is_open = || match state.one_way_state {
            OneWayState::Closed | OneWayState::Landed => false,
            OneWayState::Passes => true,
            OneWayState::Apart => !self.pair_motion().will_land(pair),
        };
        state.responds
            && !state.is_vetoed
            && (is_immovable || is_bullet)
            && !is_in_contact
            && !passes_in_depth()
            && !is_open()
    }

    /// Returns the motion of all bodies in this step, for the decisions of one-way geoms. The poses are still those at the
    /// start of the step.
    pub(super) fn pair_motion(&self) -> PairMotion<'_> {
        let Precise { bodies, proxies, pairs, parameters, .. } = self;
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
    fn toi_of_pair(&self, pair: usize) -> Option<f32> {
        let proxies = self.pairs.triggers[pair].proxies;
        if self.depth.is_some() {
            return self.time_of_impact(proxies, TOI_PENETRATION_RATIO);
        }
        self.time_of_impact_2d(proxies, TOI_PENETRATION_RATIO, |part, two| {
            self.flush_filter(part).separation_and_closing(pair, two)
        })
    }

    /// Returns the time of impact of two proxies as a fraction of the step; `None` without an impact.
    ///
    /// It is the time at which the shapes have the target penetration. If they overlap at the start of the step, the target is
    /// that overlap plus the target penetration. `penetration` is the target as a fraction of the speculative distance,
    /// dimensionless.
    fn time_of_impact(&self, proxies: [u32; 2], penetration: f32) -> Option<f32> {
        let Some(space) = &self.depth else {
            return self.time_of_impact_2d(proxies, penetration, |fraction, two| {
                two.separation_and_closing_speed(fraction)
            });
        };
        let reach = self.parameters.speculative_distance;
        let paths = proxies.map(|proxy| self.displacement(self.proxies.all[proxy as usize].body));
        conservative_advancement(penetration * reach, TOI_TOLERANCE_RATIO * reach, |part| {
            space.distance_and_closing_speed(proxies, &self.proxies, &self.bodies, paths, part)
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
        proxies: [u32; 2],
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
    fn flush_filter(&self, fraction: f32) -> FlushFilter<'_> {
        let Precise { bodies, proxies, pairs, parameters: tuning, dt, .. } = self;
        FlushFilter { bodies, proxies, pairs, parameters: tuning, dt: *dt, time: fraction }
    }

    /// Returns the convex shape of a proxy on its path through the step, with `fraction` of its displacement.
    fn swept_shape(&self, proxy: u32, fraction: f32) -> SweptShape<'_> {
        let Proxy { body, shape, .. } = self.proxies.all[proxy as usize];
        let outline = self.proxies.vertices.shape_ref(shape);
        SweptShape {
            shape: outline,
            pose: self.bodies.poses[body as usize],
            displacement: self.displacement(body).map(|way| way * fraction),
        }
    }

    /// Returns the displacement of a body in the step: x, y (length units), rotation (radians), z (length units). Zeros for a
    /// static body.
    fn displacement(&self, body: u32) -> [f32; 4] {
        self.bodies.delta_pose.get(body as usize).copied().unwrap_or_default()
    }

    /// Appends to `sensor_passthroughs` the pairs of geoms of which a fast body enters and leaves a sensor within the step. The
    /// game gets a collision and a separation event for each.
    fn record_sensor_passthroughs(&mut self, fast: &[FastBody]) {
        if self.depth.is_some() {
            return;
        }
        for &FastBody { body, toi: time, .. } in fast {
            for proxy in self.proxies.proxies_of(body as usize) {
                for pair in self.pairs.pairs_of(proxy) {
                    let state = &self.pairs.all[pair];
                    if state.responds || state.is_touching || state.is_vetoed {
                        continue;
                    }
                    let impact_time =
                        self.time_of_impact(self.pairs.triggers[pair].proxies, TOI_PENETRATION_RATIO);
                    if impact_time.is_some_and(|met| met < time)
                        && self.is_separated_after(pair, body as usize, time)
                    {
                        let [a, b] = self.pairs.triggers[pair].proxies.map(|proxy| {
                            let proxy = &self.proxies.all[proxy as usize];
                            (proxy.creation_number, proxy.geom)
                        });
                        self.sensor_passthroughs.push(if a.0 < b.0 { [a, b] } else { [b, a] });
                    }
                }
            }
        }
        sort_by_number(&mut self.sensor_passthroughs, |geoms| packed_key(geoms.map(|(number, _)| number)));
        self.sensor_passthroughs.dedup();
    }

    /// Returns whether the shapes of a pair are separated at the end of the step, if the path of `body` ends at `fraction` of
    /// its displacement.
    fn is_separated_after(&self, pair: usize, body: usize, fraction: f32) -> bool {
        let [a, b] = self.pairs.triggers[pair].proxies.map(|proxy| {
            let is_stopped = self.proxies.all[proxy as usize].body as usize == body;
            self.swept_shape(proxy, if is_stopped { fraction } else { 1.0 })
        });
        SweptPair { a, b }.separation(1.0).0 > 0.0
    }

    /// Returns the two geoms of a passage through a sensor, the one with the smaller creation number first. `at` is an index
    /// into the passages of the step, which are sorted by creation numbers; `None` beyond the last one.
    pub(crate) fn sensor_passthrough(&self, at: usize) -> Option<(GeomId, GeomId)> {
        self.sensor_passthroughs.get(at).map(|&[(_, a), (_, b)]| (a, b))
    }
}

#[cfg(test)]
impl Precise {
    /// Returns the number of proxies that got a new fat AABB at the end of the step.
    pub(crate) fn bounds_renewed(&self) -> usize {
        self.proxies.refitted.len()
    }
}
