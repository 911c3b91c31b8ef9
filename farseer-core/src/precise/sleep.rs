//! What has come to rest sleeps, and costs nothing until something wakes it.
//!
//! **When.** A body is at rest while it moves by less than a [speed](Sleep::slow) that follows gravity and the size of
//! things. [Islands](super::islands) of bodies that have all been at rest for [`TIME_TO_SLEEP`] seconds fall asleep together, if their
//! contacts have learnt their load and nothing that they touch is on its way. Where one of an island is not at rest yet, all
//! of it has rested no longer than that one: so an island is asked again only when it may be ready. What a motor, a
//! belt or a kinematic body [drives](super::driven) does not sleep, however slowly it moves.
//!
//! **How.** Their rows and pairs are put aside, and the lists of bodies and proxies are gone through by [runs](Sleep::bodies)
//! that leave out what sleeps. Nothing changes its number, so nothing else knows.
//!
//! **Until when.** One of them is edited, pushed by other forces than those it fell asleep under, or touched by what is awake;
//! what it rests on moves, goes or is edited; a joint of it is edited; gravity changes. Then the whole island wakes, with the
//! impulses it fell asleep with.

use crate::precise::parameters::sleep::{
    SLEEP_RETEST_PART, SLEEP_SPEED_PER_FALL, SLEEP_SPEED_WEIGHTLESS, TIME_TO_SLEEP,
};
use std::ops::Range;

use serde::{Deserialize, Serialize};

use super::islands::Islands;
use super::proxies::{Mobility, Proxies};
use super::tuning::Learning;
use super::{Precise, Step};
use crate::body::BodyId;
use crate::body::entry::Bodies;
use crate::joints::held::Held;
use crate::joints::{Joint, JointId};
use crate::math::Vector2;
use crate::math::plane::{Vector, dot};
use crate::objects::Objects;
use crate::storage::reusing_clone::reusing_clone;

/// Why a body does not sleep: see [`PhysicsSimulator::why_awake`](crate::PhysicsSimulator::why_awake).
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum WhyAwake {
    /// Nothing sleeps: it is [switched off](crate::PhysicsSimulator::set_sleep_enabled), or the methods are the faithful set.
    NothingSleeps,
    /// The body is static or kinematic, or takes no part.
    NeverSleeps,
    /// The body moves too fast, or what swings about a hinge and leans on it does.
    Moves {
        /// Length per second below which it would be at rest.
        limit: f32,
    },
    /// The body is at rest, but hangs together, by contacts, joints or springs, with one that is not.
    HangsTogether {
        /// The one that is not at rest.
        with: BodyId,
    },
    /// All that hangs together with the body is at rest, but not for long enough, or its contacts still settle. For what a
    /// motor, a belt or a kinematic body moves slowly the count begins again and again.
    RestsSince {
        /// Seconds that count.
        seconds: f32,
        /// Seconds after which it sleeps.
        needed: f32,
    },
}

/// In place of another number: the body is awake; or there is none.
const AWAKE: u32 = u32::MAX;
const ABSENT: u32 = u32::MAX - 1;

/// Who sleeps, by number.
#[derive(Debug, Default)]
pub(super) struct Sleep {
    /// Whether things fall asleep, and the gravity that they do it under.
    is_enabled: bool,
    pub(super) gravity: Vector,
    /// Seconds for which a body has been at rest; what sleeps is never ready for it.
    pub(super) rest: Vec<f32>,
    /// The next one of those that fell asleep together, in a ring; or [`AWAKE`], or [`ABSENT`].
    next: Vec<u32>,
    /// Accelerations by forces and torque that a body fell asleep under.
    pub(super) borne: Vec<[f32; 4]>,
    /// Those of which it is something; and of these those that have just fallen asleep.
    pub(super) leaning: Vec<u32>,
    pub(super) fresh: Vec<u32>,
    /// How many sleep.
    pub(super) count: usize,
    /// Places of the lists in multiples of four, without those where all four sleep: of bodies that can be pushed, and of
    /// proxies of these.
    pub(super) bodies: Vec<Range<usize>>,
    pub(super) proxies: Vec<Range<usize>>,
    /// Bodies that are to wake, pairs of which one side is, and bodies that forces were applied to: empty between stages.
    pub(super) waking: Vec<u32>,
    pub(super) touched: Vec<u32>,
    pub(super) pushed: Vec<u32>,
    /// Joints of what sleeps, in the order of their list.
    pub(super) joints: Vec<KnownJoint>,
    /// Of no use between steps: who hangs together, how long each island has rested at least, and who falls asleep.
    islands: Islands,
    least: Vec<f32>,
    falling: Vec<u32>,
}

reusing_clone! {
    Sleep {
        is_enabled, gravity, rest, next, borne, leaning, fresh, count, bodies, proxies, waking, touched, pushed, joints,
        islands, least, falling
    }
}

/// A joint as it was when what it holds fell asleep: should it be another one, that wakes.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct KnownJoint {
    pub(super) joint: JointId,
    pub(super) held: Held,
    /// Softness, bias factor and breakpoint.
    pub(super) numbers: [f32; 3],
    /// Where those of its bodies are that are not listed, as nobody else would notice that they were moved: place, rotation,
    /// and where along the depth axis.
    pub(super) unlisted: [[f32; 4]; 2],
}

impl KnownJoint {
    pub(super) fn bodies(&self) -> impl Iterator<Item = BodyId> {
        self.held.bodies.0.into_iter().chain([self.held.bodies.1])
    }
}

impl Sleep {
    #[inline(always)]
    pub(super) fn is_asleep(&self, body: usize) -> bool {
        self.next.get(body).is_some_and(|&next| next < ABSENT)
    }

    /// Those of these numbers, from 1 on, that are awake.
    #[inline(always)]
    pub(super) fn awake(&self, count: usize) -> impl Iterator<Item = usize> + '_ {
        let numbers = self.bodies.iter().cloned().flatten();
        numbers.filter(move |&number| number <= count && self.next[number] == AWAKE)
    }

    /// A row between what is awake and what sleeps has come.
    pub(super) fn note_touch(&mut self, pair: usize) {
        self.touched.push(pair as u32);
    }

    /// A body that may sleep is to wake.
    pub(super) fn note_waking(&mut self, body: usize) {
        if self.is_asleep(body) {
            self.waking.push(body as u32);
        }
    }

    /// What a body rested on may have gone: it is to wake, and one that was about to fall asleep has to rest anew.
    pub(super) fn note_loss(&mut self, body: usize) {
        self.note_waking(body);
        if let Some(rest) = self.rest.get_mut(body) {
            *rest = 0.0;
        }
    }

    /// Forces may have been applied to a body that may sleep.
    pub(super) fn note_push(&mut self, body: usize) {
        if self.is_asleep(body) {
            self.pushed.push(body as u32);
        }
    }

    /// Whether all sleeps under this gravity, and nothing is to wake or bears anything that may have become otherwise.
    pub(super) fn is_undisturbed(&self, gravity: Vector) -> bool {
        let Sleep { bodies, waking, touched, pushed, leaning, fresh, .. } = self;
        self.is_enabled
            && self.gravity == gravity
            && bodies.is_empty()
            && [waking, touched, pushed, leaning, fresh].iter().all(|list| list.is_empty())
    }

    /// All bodies are listed anew, and awake.
    pub(super) fn reset(&mut self, ids: &[Option<BodyId>]) {
        let bodies = ids.len();
        self.rest.clear();
        self.rest.resize(bodies, 0.0);
        self.next.clear();
        self.next.extend(ids.iter().map(|id| if id.is_some() { AWAKE } else { ABSENT }));
        self.borne.clear();
        self.borne.resize(bodies, [0.0; 4]);
        self.count = 0;
        self.leaning.clear();
        self.fresh.clear();
        self.waking.clear();
        self.touched.clear();
        self.pushed.clear();
    }

    /// A body has come, awake.
    pub(super) fn add(&mut self, body: usize) {
        (self.next[body], self.rest[body]) = (AWAKE, 0.0);
    }

    /// A body has gone: those that fell asleep with it go on sleeping.
    pub(super) fn forget(&mut self, body: usize) {
        if self.is_asleep(body) {
            let mut before = body;
            while self.next[before] as usize != body {
                before = self.next[before] as usize;
            }
            self.next[before] = self.next[body];
            self.count -= 1;
        }
        (self.next[body], self.rest[body], self.borne[body]) = (ABSENT, 0.0, [0.0; 4]);
        self.leaning.retain(|&other| other as usize != body);
        self.fresh.retain(|&other| other as usize != body);
    }

    /// The runs follow who sleeps.
    pub(super) fn renew_runs(&mut self, proxies: &Proxies) {
        let Sleep { next, bodies, proxies: of_proxies, .. } = self;
        let is_awake = |body: u32| next.get(body as usize) == Some(&AWAKE);
        runs(next.len(), |number| is_awake(number as u32), bodies);
        runs(proxies.first_fixed, |at| is_awake(proxies.all[at].body), of_proxies);
    }

    /// A body falls asleep, with the others of a ring if there is one.
    pub(super) fn lay_down(&mut self, body: usize, with: Option<usize>, borne: [f32; 4]) {
        self.rest[body] = f32::NEG_INFINITY;
        self.borne[body] = borne;
        self.leaning.extend((borne != [0.0; 4]).then_some(body as u32));
        let other = with.unwrap_or(body);
        self.next[body] = body as u32;
        self.next.swap(body, other);
        self.count += 1;
    }

    /// All of a ring wake, and are handed over.
    pub(super) fn take_up(&mut self, body: usize, mut woken: impl FnMut(u32)) {
        let mut at = body;
        while self.is_asleep(at) {
            let next = std::mem::replace(&mut self.next[at], AWAKE) as usize;
            self.rest[at] = 0.0;
            self.count -= 1;
            woken(at as u32);
            at = next;
        }
    }

    /// The least number of those that sleep together.
    pub(super) fn first_with(&self, body: usize) -> usize {
        let (mut first, mut at) = (body, self.next[body] as usize);
        while at != body {
            first = first.min(at);
            at = self.next[at] as usize;
        }
        first
    }
}

/// The runs of blocks of four in which something is.
fn runs(count: usize, is_there: impl Fn(usize) -> bool, runs: &mut Vec<Range<usize>>) {
    runs.clear();
    for four in (0..count).step_by(4).filter(|&four| (four..four + 4).any(&is_there)) {
        match runs.last_mut() {
            Some(run) if run.end == four => run.end = four + 4,
            _ => runs.push(four..four + 4),
        }
    }
}

/// Falling asleep.
impl Precise {
    /// Speed below which things are at rest.
    pub(super) fn slow(&self) -> f32 {
        let (gravity, unit) = (self.sleep.gravity, self.tuning.unit);
        let fall = (2.0 * dot(gravity, gravity).sqrt() * unit).sqrt();
        let (slow, slowest) = (SLEEP_SPEED_PER_FALL * fall, SLEEP_SPEED_WEIGHTLESS * unit);
        // Also if a square is not finite.
        if slow > slowest && slow.is_finite() { slow } else { slowest }
    }

    /// Whether things may fall asleep, and under which gravity: all wake if that has changed.
    pub(super) fn set_sleep(&mut self, is_enabled: bool, gravity: Vector2) {
        let gravity = [gravity.x, gravity.y];
        if !is_enabled || gravity != self.sleep.gravity {
            self.wake_all();
        }
        (self.sleep.is_enabled, self.sleep.gravity) = (is_enabled, gravity);
    }

    /// Last stage: what has been at rest for long enough sleeps.
    pub(crate) fn fall_asleep(&mut self, objects: &mut Objects, step: &Step) {
        if !self.sleep.is_enabled || !self.note_rest() {
            return;
        }
        let mut islands = std::mem::take(&mut self.sleep.islands);
        self.join_islands(objects, &mut islands);
        self.sleep.islands = islands;
        self.find_least_rest(objects, &step.learning);
        let mut falling = std::mem::take(&mut self.sleep.falling);
        falling.clear();
        falling.extend(
            self.sleep
                .awake(self.bodies.count)
                .filter(|&body| !self.bodies.is_kinematic(body))
                .map(|body| body as u32),
        );
        falling.retain(|&body| {
            let island = self.sleep.islands.find(body);
            let rest = self.sleep.least[island as usize];
            self.sleep.rest[body as usize] = rest;
            rest >= TIME_TO_SLEEP
        });
        if !falling.is_empty() {
            self.lay_down(&falling, objects);
        }
        self.sleep.falling = falling;
    }

    /// Counts how long bodies have been at rest. Answers whether it has been long enough for one of them.
    fn note_rest(&mut self) -> bool {
        if self.sleep.bodies.is_empty() {
            return false;
        }
        let slow = self.slow() * self.dt;
        let mut is_ripe = false;
        let Precise { bodies, sleep: Sleep { bodies: runs, rest, .. }, dt, .. } = self;
        for run in runs.iter().cloned() {
            let ways = bodies.path[run.clone()].iter().zip(&bodies.reaches[run.clone()]);
            for (([x, y, turned, z], reach), rest) in ways.zip(&mut rest[run]) {
                let is_slow = x.abs() + y.abs() + z.abs() + reach * turned.abs() < slow;
                // Blocks of four hold sleepers too: theirs stays what it is.
                *rest = if is_slow { (*rest + *dt).min(TIME_TO_SLEEP) } else { rest.min(0.0) };
                is_ripe |= *rest >= TIME_TO_SLEEP;
            }
        }
        is_ripe
    }

    /// Which bodies that are awake hang together: by rows, joints and springs.
    pub(super) fn join_islands(&self, objects: &Objects, islands: &mut Islands) {
        islands.part(self.bodies.hot.len());
        for pair in (0..self.pairs.awake).filter(|&pair| self.pairs.all[pair].home.is_some()) {
            let [(a, of_a), (b, of_b)] = self.sides(pair);
            if of_a.gives_way() && of_b.gives_way() {
                islands.join(a as u32, b as u32);
            }
        }
        for [a, b] in self.joints.ties().chain(self.spring_ties(objects)) {
            if self.is_dynamic(a) && self.is_dynamic(b) {
                islands.join(a as u32, b as u32);
            }
        }
    }

    /// The bodies at both ends of each spring; 0 for the world.
    pub(super) fn spring_ties<'a>(&'a self, objects: &'a Objects) -> impl Iterator<Item = [usize; 2]> + 'a {
        let springs = (0..objects.springs.list().len()).filter_map(|at| objects.springs.at(at));
        let number = |body: Option<BodyId>| body.and_then(|id| self.number_of(id)).unwrap_or(0);
        springs.filter(|(_, spring)| spring.enabled()).map(move |(_, spring)| spring.ends().map(number))
    }

    /// Why a body that may sleep is awake; `None` if it sleeps, or never does.
    pub(crate) fn why_awake(&self, body: BodyId, objects: &Objects) -> Option<WhyAwake> {
        let number = self.number_of(body).filter(|&number| self.is_dynamic(number))?;
        if self.sleep.is_asleep(number) {
            return None;
        }
        let mut islands = Islands::default();
        self.join_islands(objects, &mut islands);
        let island = islands.find(number as u32);
        let mut with =
            self.sleep.awake(self.bodies.count).filter(|&other| islands.find(other as u32) == island);
        let restless = with.find(|&other| self.sleep.rest[other] == 0.0);
        Some(match restless {
            _ if self.sleep.rest[number] == 0.0 => WhyAwake::Moves { limit: self.slow() },
            Some(other) => match self.bodies.ids[other] {
                Some(with) => WhyAwake::HangsTogether { with },
                // What swings is no body, and moves those that lean on it.
                None => WhyAwake::Moves { limit: self.slow() },
            },
            None => WhyAwake::RestsSince { seconds: self.sleep.rest[number], needed: TIME_TO_SLEEP },
        })
    }

    /// How long all of each island have rested; no longer than nearly long enough where one still waits for something.
    fn find_least_rest(&mut self, objects: &Objects, learning: &Learning) {
        let mut least = std::mem::take(&mut self.sleep.least);
        least.clear();
        least.resize(self.bodies.hot.len(), f32::INFINITY);
        let islands = &mut std::mem::take(&mut self.sleep.islands);
        let mut limit = |body: usize, rest: f32| {
            let least = &mut least[islands.find(body as u32) as usize];
            *least = if rest < *least { rest } else { *least };
        };
        self.sleep.awake(self.bodies.count).for_each(|body| limit(body, self.sleep.rest[body]));
        for &proxy in &self.proxies.escaped {
            let body = self.proxies.all[proxy as usize].body as usize;
            if self.is_dynamic(body) {
                limit(body, SLEEP_RETEST_PART * TIME_TO_SLEEP);
            }
        }
        for pair in 0..self.pairs.awake {
            let state = &self.pairs.all[pair];
            let Some(home) = state.home else { continue };
            let [(a, mobility), (b, _)] = self.sides(pair);
            let lane = self.rows.lane(state.kind, home);
            let is_carried = mobility == Mobility::Kinematic && self.bodies.moves(a);
            if is_carried || self.is_on_running_belt(b, &lane) {
                limit(b, 0.0);
            } else if lane.is_learning(learning) && !self.joints.is_soft(a) && !self.joints.is_soft(b) {
                // Contacts of bodies with joints in the iterative solver learn no load.
                limit(b, SLEEP_RETEST_PART * TIME_TO_SLEEP);
            }
        }
        self.for_each_driven(objects, |body| limit(body, 0.0));
        (self.sleep.least, self.sleep.islands) = (least, std::mem::take(islands));
    }

    /// These fall asleep, each with the others of its island.
    fn lay_down(&mut self, falling: &[u32], objects: &mut Objects) {
        for &number in falling {
            let body = number as usize;
            let island = self.sleep.islands.find(number) as usize;
            let borne = self.bodies.rest(body, self.dt);
            // The least number of an island is the first of it here.
            self.sleep.lay_down(body, (island != body).then_some(island), borne);
            self.sleep.fresh.extend((borne != [0.0; 4]).then_some(number));
            if let Some(entry) = self.bodies.ids[body].and_then(|id| objects.bodies.get_mut(id)) {
                entry.body.come_to_rest();
            }
            if let (Some(space), Some(id)) = (&mut self.space, self.bodies.ids[body]) {
                space.rest(body, id);
            }
            self.rest_swing(body);
        }
        self.lay_pairs_down();
        self.lay_joints_down(objects);
        self.sleep.renew_runs(&self.proxies);
    }

    /// Rows of bodies that sleep are put aside, and pairs of which no side can move.
    pub(super) fn lay_pairs_down(&mut self) {
        let h = self.h;
        // From the last one on: what takes the place of another one has been looked at.
        for pair in (0..self.pairs.awake).rev() {
            let is_awake =
                |&(body, mobility): &(usize, Mobility)| mobility.gives_way() && !self.sleep.is_asleep(body);
            if self.sides(pair).iter().any(is_awake) {
                continue;
            }
            self.touch().move_row(pair, true, h);
            if !self.may_change(pair) {
                self.touch().lay_down(pair);
            }
        }
    }

    /// Whether one side of a pair may move.
    pub(super) fn may_change(&self, pair: usize) -> bool {
        !self.pairs.all[pair].is_unpushed
            && self.sides(pair).iter().any(|&(body, mobility)| match mobility {
                Mobility::Fixed => false,
                Mobility::Kinematic => true,
                Mobility::Hinged | Mobility::Dynamic => !self.sleep.is_asleep(body),
            })
    }

    /// Joints of what sleeps are remembered, and not solved.
    fn lay_joints_down(&mut self, objects: &Objects) {
        if self.joints.ties().any(|ties| ties.iter().any(|&body| self.sleep.is_asleep(body))) {
            self.note_joints();
        }
        let all = (0..objects.joints.list().len()).filter_map(|at| objects.joints.at(at));
        let mut joints = std::mem::take(&mut self.sleep.joints);
        joints.clear();
        let known = all.filter_map(|joint| self.known_joint(joint, &objects.bodies));
        joints.extend(known.filter(|joint| self.lies(joint)));
        self.sleep.joints = joints;
    }

    /// A joint as it is now; `None` if it is not enabled.
    pub(super) fn known_joint(&self, (id, joint): (JointId, &Joint), bodies: &Bodies) -> Option<KnownJoint> {
        if !joint.enabled() {
            return None;
        }
        let held = joint.held();
        let unlisted = [held.bodies.0, Some(held.bodies.1)];
        let unlisted = unlisted.map(|id| id.map_or([0.0; 4], |id| self.place_of_unlisted(id, bodies)));
        let numbers = [joint.softness(), joint.bias_factor(), joint.breakpoint()];
        Some(KnownJoint { joint: id, held, numbers, unlisted })
    }

    fn place_of_unlisted(&self, id: BodyId, bodies: &Bodies) -> [f32; 4] {
        let entry = bodies.get(id).filter(|_| self.number_of(id).is_none());
        entry.map_or([0.0; 4], |entry| {
            let (position, rotation) = (entry.body.position(), entry.body.rotation());
            let z = self.space.as_ref().map_or(0.0, |space| space.place_and_velocity(id)[0]);
            [position.x, position.y, rotation, z]
        })
    }

    /// Whether a joint holds a body that sleeps.
    pub(super) fn lies(&self, joint: &KnownJoint) -> bool {
        joint.bodies().any(|body| self.number_of(body).is_some_and(|number| self.sleep.is_asleep(number)))
    }

    /// The bodies of a pair.
    pub(super) fn sides(&self, pair: usize) -> [(usize, Mobility); 2] {
        self.pairs.watched[pair].proxies.map(|proxy| {
            let proxy = &self.proxies.all[proxy as usize];
            (proxy.body as usize, proxy.mobility)
        })
    }

    pub(super) fn is_dynamic(&self, body: usize) -> bool {
        body <= self.bodies.count && self.bodies.ids[body].is_some() && !self.bodies.is_kinematic(body)
    }
}
