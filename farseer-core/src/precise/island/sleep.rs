//! Sleeping: islands at rest are skipped until they wake.
//!
//! **Falling asleep.** A body is at rest while it moves slower than [`sleep_speed`](Precise::sleep_speed). An
//! [island](super::union_find) sleeps when all of its bodies have been at rest for [`TIME_TO_SLEEP`] seconds, the load
//! adaptation of its contacts has ended, and no body that it touches is about to move. The rest time of an island is the
//! smallest rest time of its bodies. So the island is tested again only when that time can have reached the limit. Bodies that
//! a [drive](super::driven) moves do not sleep.
//!
//! **Asleep.** The contact constraints and pairs of sleeping bodies are parked. Loops over bodies and proxies use
//! [runs](SleepState::awake_body_runs), which skip sleeping ones. Indices do not change, so that other modules are not
//! concerned.
//!
//! **Waking.** An island wakes with the impulses that it fell asleep with. Events that wake it:
//!
//! - one of its bodies is edited, gets other forces than before, or is touched by an awake body;
//! - its support moves, is removed or edited;
//! - a joint of it is edited;
//! - gravity changes.

use crate::precise::parameters::sleep::{
    SLEEP_RETEST_FRACTION, SLEEP_SPEED_PER_FALL, SLEEP_SPEED_WEIGHTLESS, TIME_TO_SLEEP,
};
use std::ops::Range;

use serde::{Deserialize, Serialize};

use crate::body::BodyId;
use crate::body::entry::Bodies;
use crate::joints::constraint_spec::ConstraintSpec;
use crate::joints::{Joint, JointId};
use crate::math::Vector2;
use crate::math::plane::{Vector, dot};
use crate::objects::Objects;
use crate::precise::broad_phase::proxies::{BodyType, Proxies};
use crate::precise::island::union_find::UnionFind;
use crate::precise::scaled_parameters::LoadAdaptation;
use crate::precise::{Precise, StepContext};
use crate::storage::reusing_clone::reusing_clone;

/// Reason why a body is awake: see [`PhysicsSimulator::why_awake`](crate::PhysicsSimulator::why_awake).
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum AwakeReason {
    /// Sleeping is [switched off](crate::PhysicsSimulator::set_sleep_enabled), or the simulator uses the faithful set.
    SleepDisabled,
    /// The body is static or kinematic, or is not simulated (disabled or removed): it never sleeps.
    NeverSleeps,
    /// The body, or a hinged platform that leans on it, moves too fast.
    Moves {
        /// Speed below which the body counts as at rest, length units/s.
        limit: f32,
    },
    /// The body is at rest, but contacts, joints or springs connect it with a body that is not at rest.
    HangsTogether {
        /// The body of the island that is not at rest.
        with: BodyId,
    },
    /// All bodies of the island are at rest, but not for long enough, or the load adaptation of its contacts has not ended.
    ///
    /// Bodies that a motor, belt or kinematic body moves slowly have their rest time reset in each update.
    RestsSince {
        /// Time for which the body has been at rest, seconds.
        seconds: f32,
        /// Rest time after which the island sleeps, seconds.
        needed: f32,
    },
}

/// Index in [`SleepState::next_in_ring`] that marks an awake body. It is no index of a body.
const AWAKE: u32 = u32::MAX;
/// Index in [`SleepState::next_in_ring`] that marks a list position without a body. It is no index of a body.
const ABSENT: u32 = u32::MAX - 1;

/// Sleep state of all bodies, in lists by body index: rest times, rings of sleeping bodies, and requests to wake.
#[derive(Debug, Default)]
pub(in crate::precise) struct SleepState {
    /// Whether the game lets bodies sleep.
    is_enabled: bool,
    /// Gravity under which the sleeping bodies fell asleep, length units/s^2.
    pub(in crate::precise) gravity: Vector,
    /// Time for which each body has been at rest, seconds, 0..=[`TIME_TO_SLEEP`]; negative infinity for sleeping bodies.
    pub(in crate::precise) rest_time: Vec<f32>,
    /// For each sleeping body, the index of the next body of its ring, the circle of bodies that fell asleep together. Else
    /// [`AWAKE`] or [`ABSENT`].
    next_in_ring: Vec<u32>,
    /// For each sleeping body, the accelerations by forces and torque under which it fell asleep: x, y (length units/s^2),
    /// angular (radians/s^2), z (length units/s^2).
    pub(in crate::precise) supported_acceleration: Vec<[f32; 4]>,
    /// Indices of sleeping bodies whose supported acceleration is not 0.
    pub(in crate::precise) loaded_bodies: Vec<u32>,
    /// Indices of the bodies in `loaded_bodies` that fell asleep in the last step. Their forces are measured once more.
    pub(in crate::precise) newly_asleep: Vec<u32>,
    /// Number of sleeping bodies.
    pub(in crate::precise) count: usize,
    /// Ranges of body indices with awake movable bodies. Their ends are multiples of four; blocks of four bodies that all sleep
    /// are left out.
    pub(in crate::precise) awake_body_runs: Vec<Range<usize>>,
    /// Ranges of proxy indices with proxies of awake movable bodies. Their ends are multiples of four; blocks of four proxies
    /// whose bodies all sleep are left out.
    pub(in crate::precise) awake_proxy_runs: Vec<Range<usize>>,
    /// Indices of sleeping bodies that are to wake in this update. Empty between the stages of a step.
    pub(in crate::precise) wake_requests: Vec<u32>,
    /// Indices of pairs that got a contact constraint with a sleeping body. Empty between the stages of a step.
    pub(in crate::precise) touched_pairs: Vec<u32>,
    /// Indices of sleeping bodies to which forces may have been applied in this update. Empty between the stages of a step.
    pub(in crate::precise) forced_bodies: Vec<u32>,
    /// Joints of sleeping bodies as they were when the bodies fell asleep, in the order of the simulator's list.
    pub(in crate::precise) joints: Vec<SleepingJoint>,
    /// Workspace: the islands of awake bodies in this step.
    islands: UnionFind,
    /// Workspace: smallest rest time of the bodies of each island, seconds, at the index of the island's representative.
    min_rest_time: Vec<f32>,
    /// Workspace: indices of the bodies that fall asleep in this step.
    falling_asleep: Vec<u32>,
}

reusing_clone! {
    SleepState {
        is_enabled, gravity, rest_time, next_in_ring, supported_acceleration, loaded_bodies, newly_asleep, count, awake_body_runs, awake_proxy_runs, wake_requests, touched_pairs, forced_bodies, joints,
        islands, min_rest_time, falling_asleep
    }
}

/// State of a joint when its bodies fell asleep. The bodies wake when the state of the joint changes.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(in crate::precise) struct SleepingJoint {
    pub(in crate::precise) joint: JointId,
    /// Bodies, anchors and kind of the joint when its bodies fell asleep.
    pub(in crate::precise) held: ConstraintSpec,
    /// Softness, bias factor (dimensionless) and breakpoint of the joint. The meaning of softness depends on the kind of joint.
    /// Breakpoint of a distance: length units; of an angle: radians.
    #[serde(rename = "numbers")]
    pub(in crate::precise) parameters: [f32; 3],
    /// Poses of those bodies of the joint that are outside of the solver (disabled, or not in the simulator): x, y (length
    /// units), rotation (radians), z (length units); zeros for other bodies. They reveal that such a body has moved.
    pub(in crate::precise) unlisted: [[f32; 4]; 2],
}

impl SleepingJoint {
    /// Returns the ids of the one or two bodies of the joint.
    pub(in crate::precise) fn bodies(&self) -> impl Iterator<Item = BodyId> {
        self.held.bodies.0.into_iter().chain([self.held.bodies.1])
    }
}

impl SleepState {
    /// Returns whether the body sleeps.
    #[inline(always)]
    pub(in crate::precise) fn is_asleep(&self, body: usize) -> bool {
        self.next_in_ring.get(body).is_some_and(|&next| next < ABSENT)
    }

    /// Returns the indices of the awake bodies with indices up to `count`.
    #[inline(always)]
    pub(in crate::precise) fn awake_bodies(&self, count: usize) -> impl Iterator<Item = usize> + '_ {
        let numbers = self.awake_body_runs.iter().cloned().flatten();
        numbers.filter(move |&number| number <= count && self.next_in_ring[number] == AWAKE)
    }

    /// Appends a pair that has a new contact constraint with a sleeping body to `touched_pairs`.
    /// [`wake_disturbed`](Precise::wake_disturbed) wakes the body.
    pub(in crate::precise) fn record_touch(&mut self, pair: usize) {
        self.touched_pairs.push(pair as u32);
    }

    /// Appends a body to `wake_requests`, if it sleeps. The next [`wake_up`](Precise::wake_up) wakes it.
    pub(in crate::precise) fn request_wake(&mut self, body: usize) {
        if self.is_asleep(body) {
            self.wake_requests.push(body as u32);
        }
    }

    /// Notes that the support of a body may have been removed: a sleeping body is asked to wake, and the rest time of an awake
    /// one is reset to 0.
    pub(in crate::precise) fn support_removed(&mut self, body: usize) {
        self.request_wake(body);
        if let Some(rest) = self.rest_time.get_mut(body) {
            *rest = 0.0;
        }
    }

    /// Appends a sleeping body to `forced_bodies`, because forces may have been applied to it. `check_forces` compares the
    /// forces.
    pub(in crate::precise) fn record_force(&mut self, body: usize) {
        if self.is_asleep(body) {
            self.forced_bodies.push(body as u32);
        }
    }

    /// Returns whether all bodies sleep, gravity is unchanged, and no wake request, new touch or force has to be examined.
    pub(in crate::precise) fn is_undisturbed(&self, gravity: Vector) -> bool {
        let SleepState {
            awake_body_runs,
            wake_requests,
            touched_pairs,
            forced_bodies,
            loaded_bodies,
            newly_asleep,
            ..
        } = self;
        self.is_enabled
            && self.gravity == gravity
            && awake_body_runs.is_empty()
            && [wake_requests, touched_pairs, forced_bodies, loaded_bodies, newly_asleep]
                .iter()
                .all(|list| list.is_empty())
    }

    /// Makes all bodies awake with rest time 0, after the list of bodies was rebuilt. `has_body`: [`BodySet::has_body`](crate::precise::bodies::BodySet::has_body).
    pub(in crate::precise) fn reset(&mut self, has_body: &[bool]) {
        let bodies = has_body.len();
        self.rest_time.clear();
        self.rest_time.resize(bodies, 0.0);
        self.next_in_ring.clear();
        self.next_in_ring.extend(has_body.iter().map(|&has_body| if has_body { AWAKE } else { ABSENT }));
        self.supported_acceleration.clear();
        self.supported_acceleration.resize(bodies, [0.0; 4]);
        self.count = 0;
        self.loaded_bodies.clear();
        self.newly_asleep.clear();
        self.wake_requests.clear();
        self.touched_pairs.clear();
        self.forced_bodies.clear();
    }

    /// Adds a body at the index `body`, awake.
    pub(in crate::precise) fn add_body(&mut self, body: usize) {
        (self.next_in_ring[body], self.rest_time[body]) = (AWAKE, 0.0);
    }

    /// Removes a body. The bodies that fell asleep with it continue to sleep.
    pub(in crate::precise) fn remove_body(&mut self, body: usize) {
        if self.is_asleep(body) {
            let mut before = body;
            while self.next_in_ring[before] as usize != body {
                before = self.next_in_ring[before] as usize;
            }
            self.next_in_ring[before] = self.next_in_ring[body];
            self.count -= 1;
        }
        (self.next_in_ring[body], self.rest_time[body], self.supported_acceleration[body]) =
            (ABSENT, 0.0, [0.0; 4]);
        self.loaded_bodies.retain(|&other| other as usize != body);
        self.newly_asleep.retain(|&other| other as usize != body);
    }

    /// Computes the index ranges of awake bodies and of their proxies. It is called after bodies have fallen asleep or woken.
    pub(in crate::precise) fn update_runs(&mut self, proxies: &Proxies) {
        let SleepState { next_in_ring, awake_body_runs, awake_proxy_runs, .. } = self;
        let is_awake = |body: u32| next_in_ring.get(body as usize) == Some(&AWAKE);
        runs(next_in_ring.len(), |number| is_awake(number as u32), awake_body_runs);
        runs(proxies.first_fixed, |at| is_awake(proxies.all[at].body), awake_proxy_runs);
    }

    /// Puts a body to sleep in the ring of the sleeping body `ring`, or in a new ring for `None`.
    ///
    /// `supported_acceleration`: accelerations by forces and torque under which the body sleeps: x, y (length units/s^2),
    /// angular (radians/s^2), z (length units/s^2).
    pub(in crate::precise) fn sleep_body(
        &mut self,
        body: usize,
        ring: Option<usize>,
        supported_acceleration: [f32; 4],
    ) {
        self.rest_time[body] = f32::NEG_INFINITY;
        self.supported_acceleration[body] = supported_acceleration;
        self.loaded_bodies.extend((supported_acceleration != [0.0; 4]).then_some(body as u32));
        let other = ring.unwrap_or(body);
        self.next_in_ring[body] = body as u32;
        self.next_in_ring.swap(body, other);
        self.count += 1;
    }

    /// Wakes a body and all bodies that fell asleep together with it. Calls `woken` with the index of each.
    pub(in crate::precise) fn wake_ring(&mut self, body: usize, mut woken: impl FnMut(u32)) {
        let mut member = body;
        while self.is_asleep(member) {
            let next = std::mem::replace(&mut self.next_in_ring[member], AWAKE) as usize;
            self.rest_time[member] = 0.0;
            self.count -= 1;
            woken(member as u32);
            member = next;
        }
    }

    /// Returns the smallest index among a sleeping body and the bodies that fell asleep together with it.
    pub(in crate::precise) fn first_of_ring(&self, body: usize) -> usize {
        let (mut first, mut member) = (body, self.next_in_ring[body] as usize);
        while member != body {
            first = first.min(member);
            member = self.next_in_ring[member] as usize;
        }
        first
    }
}

/// Writes to `runs` the ranges of indices below `count` for which `is_there` holds, in blocks of four: a block counts if
/// `is_there` holds for at least one of its indices.
fn runs(count: usize, is_there: impl Fn(usize) -> bool, runs: &mut Vec<Range<usize>>) {
    runs.clear();
    for block in (0..count).step_by(4).filter(|&four| (four..four + 4).any(&is_there)) {
        match runs.last_mut() {
            Some(run) if run.end == block => run.end = block + 4,
            _ => runs.push(block..block + 4),
        }
    }
}

/// Falling asleep.
impl Precise {
    /// Returns the speed below which bodies are at rest, length units/s.
    ///
    /// It is [`SLEEP_SPEED_PER_FALL`] of the speed after a fall over one length unit, and [`SLEEP_SPEED_WEIGHTLESS`] at least.
    pub(in crate::precise) fn sleep_speed(&self) -> f32 {
        let (gravity, unit) = (self.sleep.gravity, self.parameters.length_unit);
        let fall = (2.0 * dot(gravity, gravity).sqrt() * unit).sqrt();
        let (speed, min_speed) = (SLEEP_SPEED_PER_FALL * fall, SLEEP_SPEED_WEIGHTLESS * unit);
        // The test also excludes an overflow of the square.
        if speed > min_speed && speed.is_finite() { speed } else { min_speed }
    }

    /// Stores whether bodies may sleep, and gravity. All bodies wake if gravity has changed or sleeping is switched off.
    pub(in crate::precise) fn set_sleep(&mut self, is_enabled: bool, gravity: Vector2) {
        let gravity = [gravity.x, gravity.y];
        if !is_enabled || gravity != self.sleep.gravity {
            self.wake_all();
        }
        (self.sleep.is_enabled, self.sleep.gravity) = (is_enabled, gravity);
    }

    /// Puts islands to sleep that have been at rest for long enough. It is the last stage of a step.
    pub(crate) fn fall_asleep(&mut self, objects: &mut Objects, step: &StepContext) {
        if !self.sleep.is_enabled || !self.accumulate_rest_time() {
            return;
        }
        let mut islands = std::mem::take(&mut self.sleep.islands);
        self.unite_islands(objects, &mut islands);
        self.sleep.islands = islands;
        self.find_min_rest_time(objects, &step.load_adaptation);
        let mut falling_asleep = std::mem::take(&mut self.sleep.falling_asleep);
        falling_asleep.clear();
        falling_asleep.extend(
            self.sleep
                .awake_bodies(self.bodies.last_movable)
                .filter(|&body| !self.bodies.is_kinematic(body))
                .map(|body| body as u32),
        );
        falling_asleep.retain(|&body| {
            let island = self.sleep.islands.find(body);
            let rest = self.sleep.min_rest_time[island as usize];
            self.sleep.rest_time[body as usize] = rest;
            rest >= TIME_TO_SLEEP
        });
        if !falling_asleep.is_empty() {
            self.sleep_bodies(&falling_asleep, objects);
        }
        self.sleep.falling_asleep = falling_asleep;
    }

    /// Adds the step to the rest times of awake bodies that move slower than the sleep speed, and resets those of faster bodies
    /// to 0. Returns whether a rest time has reached [`TIME_TO_SLEEP`].
    fn accumulate_rest_time(&mut self) -> bool {
        if self.sleep.awake_body_runs.is_empty() {
            return false;
        }
        let max_distance = self.sleep_speed() * self.dt;
        let mut is_due = false;
        let Precise { bodies, sleep: SleepState { awake_body_runs: runs, rest_time: rest, .. }, dt, .. } =
            self;
        for run in runs.iter().cloned() {
            let motions = bodies.delta_pose[run.clone()].iter().zip(&bodies.max_extents[run.clone()]);
            for (([x, y, rotation, z], reach), rest) in motions.zip(&mut rest[run]) {
                let is_slow = x.abs() + y.abs() + z.abs() + reach * rotation.abs() < max_distance;
                // Blocks of four may contain sleeping bodies, which keep their rest time of negative infinity.
                *rest = if is_slow { (*rest + *dt).min(TIME_TO_SLEEP) } else { rest.min(0.0) };
                is_due |= *rest >= TIME_TO_SLEEP;
            }
        }
        is_due
    }

    /// Unites in `islands` the awake bodies that contact constraints, joints or springs connect.
    pub(in crate::precise) fn unite_islands(&self, objects: &Objects, islands: &mut UnionFind) {
        islands.reset(self.bodies.states.len());
        for pair in (0..self.pairs.awake_count).filter(|&pair| self.pairs.all[pair].constraint.is_some()) {
            let [(a, of_a), (b, of_b)] = self.bodies_of_pair(pair);
            if of_a.takes_impulses() && of_b.takes_impulses() {
                islands.unite(a as u32, b as u32);
            }
        }
        for [a, b] in self.joints.body_pairs().chain(self.spring_body_pairs(objects)) {
            if self.bodies.is_dynamic(a) && self.bodies.is_dynamic(b) {
                islands.unite(a as u32, b as u32);
            }
        }
    }

    /// Returns the indices of the bodies at both ends of each enabled spring. Index 0 stands for the world.
    pub(in crate::precise) fn spring_body_pairs<'a>(
        &'a self,
        objects: &'a Objects,
    ) -> impl Iterator<Item = [usize; 2]> + 'a {
        let springs = (0..objects.springs.list().len()).filter_map(|at| objects.springs.at(at));
        let number = |body: Option<BodyId>| body.and_then(|id| self.body_index(id)).unwrap_or(0);
        springs.filter(|(_, spring)| spring.enabled()).map(move |(_, spring)| spring.ends().map(number))
    }

    /// Returns the reason why a dynamic body is awake; `None` if it sleeps, or is not dynamic.
    pub(crate) fn why_awake(&self, body: BodyId, objects: &Objects) -> Option<AwakeReason> {
        let number = self.body_index(body).filter(|&number| self.bodies.is_dynamic(number))?;
        if self.sleep.is_asleep(number) {
            return None;
        }
        let mut islands = UnionFind::default();
        self.unite_islands(objects, &mut islands);
        let island = islands.find(number as u32);
        let mut members = self
            .sleep
            .awake_bodies(self.bodies.last_movable)
            .filter(|&other| islands.find(other as u32) == island);
        let restless = members.find(|&other| self.sleep.rest_time[other] == 0.0);
        Some(match restless {
            _ if self.sleep.rest_time[number] == 0.0 => AwakeReason::Moves { limit: self.sleep_speed() },
            Some(other) => match self.ids.bodies[other] {
                Some(with) => AwakeReason::HangsTogether { with },
                // A hinged platform has no body id. It moves the bodies that it leans on.
                None => AwakeReason::Moves { limit: self.sleep_speed() },
            },
            None => AwakeReason::RestsSince { seconds: self.sleep.rest_time[number], needed: TIME_TO_SLEEP },
        })
    }

    /// Computes the rest time of each island: the smallest rest time of its bodies, and 0 if a drive moves one of them.
    ///
    /// Islands whose contacts still adapt their load, or whose proxies have moved, get [`SLEEP_RETEST_FRACTION`] of the time to
    /// sleep at most.
    fn find_min_rest_time(&mut self, objects: &Objects, load_adaptation: &LoadAdaptation) {
        let mut min_rest_time = std::mem::take(&mut self.sleep.min_rest_time);
        min_rest_time.clear();
        min_rest_time.resize(self.bodies.states.len(), f32::INFINITY);
        let islands = &mut std::mem::take(&mut self.sleep.islands);
        let mut limit = |body: usize, rest: f32| {
            let least = &mut min_rest_time[islands.find(body as u32) as usize];
            *least = if rest < *least { rest } else { *least };
        };
        self.sleep
            .awake_bodies(self.bodies.last_movable)
            .for_each(|body| limit(body, self.sleep.rest_time[body]));
        for &proxy in &self.proxies.refitted {
            let body = self.proxies.all[proxy as usize].body as usize;
            if self.bodies.is_dynamic(body) {
                limit(body, SLEEP_RETEST_FRACTION * TIME_TO_SLEEP);
            }
        }
        for pair in 0..self.pairs.awake_count {
            let state = &self.pairs.all[pair];
            let Some(constraint) = state.constraint else { continue };
            let [(a, body_type), (b, _)] = self.bodies_of_pair(pair);
            let contact = self.constraints.get(state.kind, constraint);
            let is_carried = body_type == BodyType::Kinematic && self.bodies.has_velocity(a);
            if is_carried || self.is_on_running_belt(b, &contact) {
                limit(b, 0.0);
            } else if contact.is_adapting_load(load_adaptation)
                && !self.joints.has_iterative_joint(a)
                && !self.joints.has_iterative_joint(b)
            {
                // Contacts of bodies with joints in the iterative solver have no load adaptation.
                limit(b, SLEEP_RETEST_FRACTION * TIME_TO_SLEEP);
            }
        }
        self.for_each_driven(objects, |body| limit(body, 0.0));
        (self.sleep.min_rest_time, self.sleep.islands) = (min_rest_time, std::mem::take(islands));
    }

    /// Puts these bodies to sleep, with velocity 0. Bodies of one island get one ring, so that they wake together.
    fn sleep_bodies(&mut self, falling_asleep: &[u32], objects: &mut Objects) {
        for &number in falling_asleep {
            let body = number as usize;
            let island = self.sleep.islands.find(number) as usize;
            let supported_acceleration = self.bodies.put_to_rest(body, self.dt);
            // Indices are ascending, so that the first body of an island is its representative.
            self.sleep.sleep_body(body, (island != body).then_some(island), supported_acceleration);
            self.sleep.newly_asleep.extend((supported_acceleration != [0.0; 4]).then_some(number));
            if let Some(entry) = self.ids.bodies[body].and_then(|id| objects.bodies.get_mut(id)) {
                entry.body.stop();
            }
            if let (Some(space), Some(id)) = (&mut self.depth, self.ids.bodies[body]) {
                space.put_to_rest(body, id);
            }
            self.put_hinge_to_rest(body);
        }
        self.sleep_pairs();
        self.sleep_joints(objects);
        self.sleep.update_runs(&self.proxies);
    }

    /// Parks the contact constraints of pairs without an awake body that impulses can move. Pairs without a body that may move
    /// leave the awake pairs.
    pub(in crate::precise) fn sleep_pairs(&mut self) {
        let h = self.impulse_substep;
        // Backwards: a pair that moves into a free position has been handled already.
        for pair in (0..self.pairs.awake_count).rev() {
            let is_awake = |&(body, body_type): &(usize, BodyType)| {
                body_type.takes_impulses() && !self.sleep.is_asleep(body)
            };
            if self.bodies_of_pair(pair).iter().any(is_awake) {
                continue;
            }
            self.narrow_phase().set_constraint_asleep(pair, true, h);
            if !self.may_move(pair) {
                self.narrow_phase().sleep_pair(pair);
            }
        }
    }

    /// Returns whether a body of the pair may move: it is kinematic, or awake and movable by impulses. Always false for a
    /// sensor pair without a body that impulses can move.
    pub(in crate::precise) fn may_move(&self, pair: usize) -> bool {
        !self.pairs.all[pair].is_static_sensor
            && self.bodies_of_pair(pair).iter().any(|&(body, body_type)| match body_type {
                BodyType::Fixed => false,
                BodyType::Kinematic => true,
                BodyType::Hinged | BodyType::Dynamic => !self.sleep.is_asleep(body),
            })
    }

    /// Stores the joints of sleeping bodies in `sleep.joints`, and makes the solvers import the other joints anew.
    fn sleep_joints(&mut self, objects: &Objects) {
        if self.joints.body_pairs().any(|ties| ties.iter().any(|&body| self.sleep.is_asleep(body))) {
            self.invalidate_joints();
        }
        let all = (0..objects.joints.list().len()).filter_map(|at| objects.joints.at(at));
        let mut joints = std::mem::take(&mut self.sleep.joints);
        joints.clear();
        let known = all.filter_map(|joint| self.sleeping_joint(joint, &objects.bodies));
        joints.extend(known.filter(|joint| self.holds_sleeping_body(joint)));
        self.sleep.joints = joints;
    }

    /// Returns the present state of a joint, for comparison with that at which its bodies fell asleep; `None` if the joint is
    /// disabled.
    pub(in crate::precise) fn sleeping_joint(
        &self,
        (id, joint): (JointId, &Joint),
        bodies: &Bodies,
    ) -> Option<SleepingJoint> {
        if !joint.enabled() {
            return None;
        }
        let held = joint.constraint_spec();
        let unlisted = [held.bodies.0, Some(held.bodies.1)];
        let unlisted = unlisted.map(|id| id.map_or([0.0; 4], |id| self.pose_of_unlisted(id, bodies)));
        let parameters = [joint.softness(), joint.bias_factor(), joint.breakpoint()];
        Some(SleepingJoint { joint: id, held, parameters, unlisted })
    }

    /// Returns the pose of a body outside of the solver (disabled, or not in the simulator): x, y (length units), rotation
    /// (radians), z (length units). Zeros for bodies in the solver.
    fn pose_of_unlisted(&self, id: BodyId, bodies: &Bodies) -> [f32; 4] {
        let entry = bodies.get(id).filter(|_| self.body_index(id).is_none());
        entry.map_or([0.0; 4], |entry| {
            let (position, rotation) = (entry.body.position(), entry.body.rotation());
            let z = self.depth.as_ref().map_or(0.0, |space| space.z_and_velocity(id)[0]);
            [position.x, position.y, rotation, z]
        })
    }

    /// Returns whether the joint connects a sleeping body.
    pub(in crate::precise) fn holds_sleeping_body(&self, joint: &SleepingJoint) -> bool {
        joint.bodies().any(|body| self.body_index(body).is_some_and(|number| self.sleep.is_asleep(number)))
    }

    /// Returns body index and body type of A and of B of a pair.
    pub(in crate::precise) fn bodies_of_pair(&self, pair: usize) -> [(usize, BodyType); 2] {
        self.pairs.bodies_of(&self.proxies, pair)
    }
}
