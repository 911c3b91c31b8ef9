//! Falling asleep: rest times of bodies, and islands that have been at rest for long enough. See
//! [`sleep`](super::sleep).

use super::driven::{for_each_driven, is_on_running_belt};
use super::sleep::SleepState;
use super::union_find::UnionFind;
use crate::bodies::BodySet;
use crate::broad_phase::pairs::Pairs;
use crate::broad_phase::proxies::{BodyType, Proxies};
use crate::constraint_graph::ConstraintGraph;
use crate::index::{BodyIndex, IndexedVec};
use crate::joints::JointSystem;
use crate::parameters::sleep::{SLEEP_RETEST_FRACTION, TIME_TO_SLEEP};
use crate::scaled_parameters::LoadAdaptation;

/// Unites in `islands` the awake bodies that contact constraints or `links` connect. `links`: body indices at both ends of each
/// joint and each enabled spring, 0 for the world.
pub fn unite_islands(
    islands: &mut UnionFind<BodyIndex>,
    bodies: &BodySet,
    proxies: &Proxies,
    pairs: &Pairs,
    links: impl Iterator<Item = [BodyIndex; 2]>,
) {
    islands.reset(bodies.states.len());
    for pair in pairs.awake().filter(|&pair| pairs.has_constraint(pair)) {
        let [(a, of_a), (b, of_b)] = pairs.bodies_of(proxies, pair);
        if of_a.takes_impulses() && of_b.takes_impulses() {
            islands.unite(a, b);
        }
    }
    for [a, b] in links {
        if bodies.is_dynamic(a) && bodies.is_dynamic(b) {
            islands.unite(a, b);
        }
    }
}

impl SleepState {
    /// Adds the step of `dt` seconds to the rest times of awake bodies that move slower than the sleep speed, and resets those
    /// of faster bodies to 0. Returns whether a rest time has reached [`TIME_TO_SLEEP`].
    pub fn accumulate_rest_time(&mut self, bodies: &BodySet, dt: f32, length_unit: f32) -> bool {
        if self.awake_body_runs.is_empty() {
            return false;
        }
        let max_distance = self.sleep_speed(length_unit) * dt;
        let mut is_due = false;
        let SleepState { awake_body_runs: runs, rest_time: rest, .. } = self;
        for run in runs.iter().cloned() {
            let motions =
                bodies.delta_pose.slice(run.clone()).iter().zip(bodies.max_extents.slice(run.clone()));
            for (([x, y, rotation, z], reach), rest) in motions.zip(rest.slice_mut(run)) {
                let is_slow = x.abs() + y.abs() + z.abs() + reach * rotation.abs() < max_distance;
                // Blocks of four may contain sleeping bodies, which keep their rest time of negative infinity.
                *rest = if is_slow { (*rest + dt).min(TIME_TO_SLEEP) } else { rest.min(0.0) };
                is_due |= *rest >= TIME_TO_SLEEP;
            }
        }
        is_due
    }

    /// Puts the bodies in `falling_asleep` to sleep, with velocity 0. Bodies of one island get one ring, so that they wake
    /// together. `dt`: length of the step, seconds.
    pub fn sleep_bodies(&mut self, bodies: &mut BodySet, dt: f32) {
        let falling_asleep = std::mem::take(&mut self.falling_asleep);
        for &number in &falling_asleep {
            let body = number;
            let island = self.islands.find(number);
            let supported_acceleration = bodies.put_to_rest(body, dt);
            // Indices are ascending, so that the first body of an island is its representative.
            self.sleep_body(body, (island != body).then_some(island), supported_acceleration);
            self.newly_asleep.extend((supported_acceleration != [0.0; 4]).then_some(number));
        }
        self.falling_asleep = falling_asleep;
    }
}

/// Parts that decide which islands have been at rest for long enough.
pub struct RestDetector<'a> {
    /// Velocities and types of all bodies, by body index.
    pub bodies: &'a BodySet,
    /// Proxies of all geoms, by proxy index.
    pub proxies: &'a Proxies,
    /// All pairs, which connect bodies to islands.
    pub pairs: &'a Pairs,
    /// Contact constraints, by their handles.
    pub constraints: &'a ConstraintGraph,
    /// Joints, which connect bodies to islands.
    pub joints: &'a JointSystem,
    /// Load adaptation of the contact springs: while it lasts, no island falls asleep.
    pub load_adaptation: &'a LoadAdaptation,
    /// Length of the step, seconds, > 0.
    pub dt: f32,
}

impl RestDetector<'_> {
    /// Lists in `falling_asleep` the bodies of islands that have been at rest for [`TIME_TO_SLEEP`], ascending, and gives each
    /// awake body the rest time of its island. `springs`: body indices at both ends of each enabled spring, 0 for the world.
    /// `requested`: awake bodies whose islands fall asleep at once, if all other bodies of the island are at rest.
    pub fn list_falling_asleep(
        &self,
        sleep: &mut SleepState,
        springs: impl Iterator<Item = [BodyIndex; 2]> + Clone,
        requested: &[BodyIndex],
    ) {
        let mut islands = std::mem::take(&mut sleep.islands);
        let links = self.joints.body_pairs().chain(springs.clone());
        unite_islands(&mut islands, self.bodies, self.proxies, self.pairs, links);
        let mut min_rest_time = std::mem::take(&mut sleep.min_rest_time);
        self.find_min_rest_time(sleep, springs.clone(), &mut islands, &mut min_rest_time);
        if !requested.is_empty() {
            self.complete_rest_time(sleep, (requested, springs), &mut islands, &mut min_rest_time);
        }
        let mut falling_asleep = std::mem::take(&mut sleep.falling_asleep);
        falling_asleep.clear();
        falling_asleep.extend(
            sleep.awake_bodies(self.bodies.last_movable).filter(|&body| !self.bodies.is_kinematic(body)),
        );
        falling_asleep.retain(|&body| {
            let rest = min_rest_time[islands.find(body)];
            sleep.rest_time[body] = rest;
            rest >= TIME_TO_SLEEP
        });
        (sleep.islands, sleep.min_rest_time, sleep.falling_asleep) = (islands, min_rest_time, falling_asleep);
    }

    /// Sets the rest times of the islands of the `requested` bodies to [`TIME_TO_SLEEP`], where all of their other bodies are at
    /// rest, and no drive, belt or moving kinematic body keeps them awake.
    fn complete_rest_time(
        &self,
        sleep: &SleepState,
        (requested, springs): (&[BodyIndex], impl Iterator<Item = [BodyIndex; 2]>),
        islands: &mut UnionFind<BodyIndex>,
        min_rest_time: &mut IndexedVec<BodyIndex, f32>,
    ) {
        let mut is_requested = IndexedVec::<BodyIndex, bool>::of_copies(false, self.bodies.states.len());
        requested.iter().for_each(|&body| is_requested[body] = true);
        let mut is_restless = IndexedVec::<BodyIndex, bool>::of_copies(false, self.bodies.states.len());
        for body in sleep.awake_bodies(self.bodies.last_movable) {
            if !is_requested[body] && sleep.rest_time[body] <= 0.0 && !self.bodies.is_kinematic(body) {
                is_restless[islands.find(body)] = true;
            }
        }
        let mut keep_awake = |body: BodyIndex, rest: f32| {
            if rest <= 0.0 {
                is_restless[islands.find(body)] = true;
            }
        };
        self.limit_by_contacts(&mut keep_awake);
        for_each_driven(self.bodies, self.joints, springs, self.dt, |body| keep_awake(body, 0.0));
        for &body in requested {
            let island = islands.find(body);
            if !is_restless[island] {
                min_rest_time[island] = TIME_TO_SLEEP;
            }
        }
    }

    /// Computes the rest time of each island: the smallest rest time of its bodies, and 0 if a drive moves one of them.
    ///
    /// Islands whose contacts still adapt their load, or whose proxies have moved, get [`SLEEP_RETEST_FRACTION`] of the time to
    /// sleep at most.
    fn find_min_rest_time(
        &self,
        sleep: &SleepState,
        springs: impl Iterator<Item = [BodyIndex; 2]>,
        islands: &mut UnionFind<BodyIndex>,
        min_rest_time: &mut IndexedVec<BodyIndex, f32>,
    ) {
        min_rest_time.clear();
        min_rest_time.resize(self.bodies.states.len(), f32::INFINITY);
        let mut limit = |body: BodyIndex, rest: f32| {
            let least = &mut min_rest_time[islands.find(body)];
            *least = if rest < *least { rest } else { *least };
        };
        sleep.awake_bodies(self.bodies.last_movable).for_each(|body| limit(body, sleep.rest_time[body]));
        for &proxy in self.proxies.refitted() {
            let body = self.proxies.body_of(proxy);
            if self.bodies.is_dynamic(body) {
                limit(body, SLEEP_RETEST_FRACTION * TIME_TO_SLEEP);
            }
        }
        self.limit_by_contacts(&mut limit);
        for_each_driven(self.bodies, self.joints, springs, self.dt, |body| limit(body, 0.0));
    }

    /// Calls `limit` with each body whose island a contact keeps awake, and the greatest rest time of that island, seconds.
    fn limit_by_contacts(&self, limit: &mut impl FnMut(BodyIndex, f32)) {
        for pair in self.pairs.awake() {
            let state = self.pairs.state(pair);
            let Some(constraint) = state.constraint else { continue };
            let [(a, body_type), (b, _)] = self.pairs.bodies_of(self.proxies, pair);
            let contact = self.constraints.get(state.kind, constraint);
            let is_carried = body_type == BodyType::Kinematic && self.bodies.has_velocity(a);
            if is_carried || is_on_running_belt(self.bodies, b, &contact, self.dt) {
                limit(b, 0.0);
            } else if contact.is_adapting_load(self.load_adaptation)
                && !self.joints.has_iterative_joint(a)
                && !self.joints.has_iterative_joint(b)
            {
                // Contacts of bodies with joints in the iterative solver have no load adaptation.
                limit(b, SLEEP_RETEST_FRACTION * TIME_TO_SLEEP);
            }
        }
    }
}
