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
pub(super) mod swept_motion;
pub(super) mod time_of_impact;

use super::Precise;
use super::bodies::BodySet;
use super::depth::FeatureGate;
use super::island::sleep::SleepState;
use super::scaled_parameters::{Parameters, StepContext};
use crate::geom::GeomId;
use crate::math::plane::length;
use crate::objects::Objects;
use crate::precise::broad_phase::hash_grid::PackedAabb;
use crate::precise::broad_phase::proxies::{BodyType, Proxy};
use crate::precise::ids::geom_of;
use crate::precise::parameters::narrow_phase::{CCD_MAX_COORDINATE, TOI_PENETRATION_RATIO};
use crate::storage::order::{packed_key, sort_by_number};
use joined_impacts::{clamp_joined_bodies, scale_joined_velocity};
use swept_motion::SweptMotion;

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
    if proxy.body_type != BodyType::Kinematic || proxy.is_world {
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
                self.ids.bodies[number].and_then(|id| Some((id, objects.bodies.get(id)?)))
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
    /// Stores the fast bodies of the step in `fast_bodies`. Returns whether there are any.
    pub(crate) fn find_fast_bodies(&mut self) -> bool {
        self.sensor_passthroughs.clear();
        // With a depth axis, the contact normal follows from the last displacement, so that no body may penetrate another
        // deeply.
        let max_threshold =
            if self.depth.is_some() { self.parameters.speculative_distance } else { f32::MAX };
        list_fast_bodies(&self.bodies, &self.sleep, max_threshold, &mut self.fast_bodies);
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
        self.swept_motion().query_sweeps(&self.fast_bodies, (&mut is_known, &mut found));
        (self.proxy_flags, self.new_pairs) = (is_known, found);
        self.new_pairs.len()
    }

    /// Returns the motion of all bodies in this step, between the solver and the write to the poses.
    pub(in crate::precise) fn swept_motion(&self) -> SweptMotion<'_> {
        let Precise { bodies, proxies, pairs, grid, sleep, depth, parameters, dt, .. } = self;
        let depth = depth.as_ref().map(FeatureGate::by_ref);
        SweptMotion { bodies, proxies, pairs, grid, sleep, depth, parameters, dt: *dt }
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
        let (motion, dz) = (self.swept_motion(), displacement[3]);
        let swept = motion.swept_aabb(proxy, displacement);
        if motion.contains_sweep(proxy, &swept, dz) {
            return false;
        }
        self.fat_aabbs().enlarge(proxy);
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

    /// Ends the paths of fast bodies at their times of impact. Returns whether a body then moves on with the body that it hit.
    ///
    /// If so, the caller finds the new pairs on that path and calls [`clamp_carried_motion`](Self::clamp_carried_motion).
    pub(crate) fn clamp_to_toi(&mut self, step: &StepContext) -> bool {
        let mut fast = std::mem::take(&mut self.fast_bodies);
        let motion = self.swept_motion();
        find_first_impacts(motion, &mut fast);
        if self.depth.is_none() {
            clamp_joined_bodies(&self.joints, &mut fast);
            let mut passthroughs = std::mem::take(&mut self.sensor_passthroughs);
            record_sensor_passthroughs(self.swept_motion(), &fast, &mut passthroughs);
            self.sensor_passthroughs = passthroughs;
        }
        find_carried_motion(self.swept_motion(), &mut fast);
        fast.retain(|flight| flight.toi < 1.0);
        end_paths(&mut self.bodies, &fast, step.substeps as f32);
        fast.retain(|flight| flight.carried_motion != [0.0; 4]);
        self.fast_bodies = fast;
        !self.fast_bodies.is_empty()
    }

    /// Ends the path of each carried body, one that moves on with the body that it hit, at the first static body on the path.
    pub(crate) fn clamp_carried_motion(&mut self) {
        let mut fast = std::mem::take(&mut self.fast_bodies);
        for &FastBody { body, pair, .. } in &fast {
            let motion = self.swept_motion();
            let is_static = |pair_index: usize| {
                let [(_, body_type), _] = motion.pairs.bodies_of(motion.proxies, pair_index);
                body_type == BodyType::Fixed && pair != Some(pair_index as u32)
            };
            if let Some((time, _)) = motion.first_toi(body as usize, is_static) {
                self.bodies.delta_pose[body as usize] =
                    self.bodies.delta_pose[body as usize].map(|way| way * time);
            }
        }
        fast.clear();
        self.fast_bodies = fast;
    }

    /// Returns the two geoms of a passage through a sensor, the one with the smaller creation number first. `at` is an index
    /// into the passages of the step, which are sorted by creation numbers; `None` beyond the last one.
    pub(crate) fn sensor_passthrough(&self, at: usize) -> Option<(GeomId, GeomId)> {
        self.sensor_passthroughs.get(at).map(|&[(_, a), (_, b)]| (a, b))
    }
}

/// Lists the fast bodies of the step in `fast`: dynamic, awake, and moving by more than the least distance from their middle to
/// their surface, or by more than `max_threshold` (length units).
fn list_fast_bodies(bodies: &BodySet, sleep: &SleepState, max_threshold: f32, fast: &mut Vec<FastBody>) {
    fast.clear();
    for run in &sleep.awake_body_runs {
        let (displacements, max_extents) =
            (&bodies.delta_pose[run.clone()], &bodies.max_extents[run.clone()]);
        let of = run.clone().zip(displacements).zip(max_extents).zip(&bodies.min_extents[run.clone()]);
        for (((number, &path), &reach), &core) in of {
            let core = if core < max_threshold { core } else { max_threshold };
            let is_body = || bodies.has_body[number] && !bodies.is_kinematic(number);
            if is_fast(path, reach, core) && !sleep.is_asleep(number) && is_body() {
                fast.push(FastBody::of(number as u32));
            }
        }
    }
}

/// Finds the first time of impact of each fast body, and its pair.
fn find_first_impacts(motion: SweptMotion<'_>, fast: &mut [FastBody]) {
    for flight in fast {
        let first = motion.first_toi(flight.body as usize, |_| true);
        (flight.toi, flight.pair) = first.map_or((1.0, None), |(time, pair)| (time, Some(pair as u32)));
    }
}

/// Finds the displacement of each fast body from its impact to the end of the step.
fn find_carried_motion(motion: SweptMotion<'_>, fast: &mut [FastBody]) {
    for at in 0..fast.len() {
        fast[at].carried_motion = motion.carried_motion(fast, &fast[at]);
    }
}

/// Ends the displacements of the fast bodies at their times of impact, and sets their velocities to those of that time. Forces
/// act until the impact only. `substeps`: number of substeps of the step.
fn end_paths(bodies: &mut BodySet, fast: &[FastBody], substeps: f32) {
    for &FastBody { body, toi: time, carried_motion: carried, is_joined, .. } in fast {
        let body = body as usize;
        for (component, carried) in bodies.delta_pose[body].iter_mut().zip(carried) {
            *component = *component * time + carried;
        }
        if is_joined {
            scale_joined_velocity(bodies, body, time);
            continue;
        }
        let unused_substeps = (1.0 - time) * substeps;
        for (velocity, push) in bodies.states[body].velocity.iter_mut().zip(bodies.force_delta[body]) {
            *velocity -= unused_substeps * push;
        }
    }
}

/// Appends to `passthroughs` the pairs of geoms of which a fast body enters and leaves a sensor within the step, each with the
/// creation numbers of its geoms. The game gets a collision and a separation event for each.
fn record_sensor_passthroughs(
    motion: SweptMotion<'_>,
    fast: &[FastBody],
    passthroughs: &mut Vec<[(u32, GeomId); 2]>,
) {
    let SweptMotion { proxies, pairs, .. } = motion;
    for &FastBody { body, toi: time, .. } in fast {
        for pair in proxies.proxies_of(body as usize).flat_map(|proxy| pairs.pairs_of(proxy)) {
            let state = &pairs.all[pair];
            if state.responds || state.is_touching || state.is_vetoed {
                continue;
            }
            let two = pairs.triggers[pair].proxies;
            let impact_time = motion.time_of_impact(two, TOI_PENETRATION_RATIO);
            if impact_time.is_some_and(|met| met < time)
                && motion.is_separated_after(pair, body as usize, time)
            {
                let [a, b] = two.map(|proxy| {
                    let proxy = &proxies.all[proxy as usize];
                    (proxy.creation_number, geom_of(proxy))
                });
                passthroughs.push(if a.0 < b.0 { [a, b] } else { [b, a] });
            }
        }
    }
    sort_by_number(passthroughs, |geoms| packed_key(geoms.map(|(number, _)| number)));
    passthroughs.dedup();
}

#[cfg(test)]
impl Precise {
    /// Returns the number of proxies that got a new fat AABB at the end of the step.
    pub(crate) fn bounds_renewed(&self) -> usize {
        self.proxies.refitted.len()
    }
}
