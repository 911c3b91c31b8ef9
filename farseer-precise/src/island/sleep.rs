//! Sleeping: islands at rest are skipped until they wake.
//!
//! **[Falling asleep](super::falling_asleep).** A body is at rest while it moves slower than [`sleep_speed`](SleepState::sleep_speed). An
//! [island](super::union_find) sleeps when all of its bodies have been at rest for [`TIME_TO_SLEEP`](crate::parameters::sleep::TIME_TO_SLEEP) seconds, the load
//! adaptation of its contacts has ended, and no body that it touches is about to move. The rest time of an island is the
//! smallest rest time of its bodies. So the island is tested again only when that time can have reached the limit. Bodies that
//! a [drive](super::driven) moves do not sleep.
//!
//! **Asleep.** The contact constraints and pairs of sleeping bodies are parked. Loops over bodies and proxies use
//! [runs](SleepState::awake_body_runs), which skip sleeping ones. Indices do not change, so that other modules are not
//! concerned.
//!
//! **[Waking](super::wake).** An island wakes with the impulses that it fell asleep with. Events that wake it:
//!
//! - one of its bodies is edited, gets other forces than before, or is touched by an awake body;
//! - its support moves, is removed or edited;
//! - a joint of it is edited;
//! - gravity changes.

use crate::index::{BodyIndex, DenseIndex, IndexedVec, PairIndex, ProxyIndex};
use std::ops::Range;

use crate::broad_phase::pairs::Pairs;
use crate::broad_phase::proxies::{BodyType, Proxies};
use crate::island::union_find::UnionFind;
use crate::math::plane::{Vector, dot};
use crate::parameters::sleep::{SLEEP_SPEED_PER_FALL, SLEEP_SPEED_WEIGHTLESS};
use crate::reusing_clone;

/// Index in [`SleepState::next_in_ring`] that marks an awake body. It is no index of a body.
const AWAKE: BodyIndex = BodyIndex(u32::MAX);
/// Index in [`SleepState::next_in_ring`] that marks a list position without a body. It is no index of a body.
const ABSENT: BodyIndex = BodyIndex(u32::MAX - 1);

/// Number of bodies for each changed body or proxy from which on the ranges of awake bodies are updated one by one, instead of
/// computed anew. Value chosen.
const BODIES_PER_RUN_UPDATE: usize = 64;

/// Sleep state of all bodies, in lists by body index: rest times, rings of sleeping bodies, and requests to wake.
#[derive(Debug, Default)]
pub struct SleepState {
    /// Whether the game lets bodies sleep.
    is_enabled: bool,
    /// Gravity under which the sleeping bodies fell asleep, length units/s^2.
    pub gravity: Vector,
    /// Time for which each body has been at rest, seconds, 0..=[`TIME_TO_SLEEP`](crate::parameters::sleep::TIME_TO_SLEEP); negative infinity for sleeping bodies.
    pub rest_time: IndexedVec<BodyIndex, f32>,
    /// For each sleeping body, the index of the next body of its ring, the circle of bodies that fell asleep together. Else
    /// [`AWAKE`] or [`ABSENT`].
    next_in_ring: IndexedVec<BodyIndex, BodyIndex>,
    /// For each sleeping body, the accelerations by forces and torque under which it fell asleep: x, y (length units/s^2),
    /// angular (radians/s^2), z (length units/s^2).
    pub supported_acceleration: IndexedVec<BodyIndex, [f32; 4]>,
    /// Indices of sleeping bodies whose supported acceleration is not 0.
    pub loaded_bodies: Vec<BodyIndex>,
    /// Indices of the bodies in `loaded_bodies` that fell asleep in the last step. Their forces are measured once more.
    pub newly_asleep: Vec<BodyIndex>,
    /// Number of sleeping bodies.
    pub count: usize,
    /// Ranges of body indices with awake movable bodies. Their ends are multiples of four; blocks of four bodies that all sleep
    /// are left out.
    pub awake_body_runs: Vec<Range<usize>>,
    /// Ranges of proxy indices with proxies of awake movable bodies. Their ends are multiples of four; blocks of four proxies
    /// whose bodies all sleep are left out.
    pub(crate) awake_proxy_runs: Vec<Range<usize>>,
    /// Indices of sleeping bodies that are to wake in this update. Empty between the stages of a step.
    pub wake_requests: Vec<BodyIndex>,
    /// Indices of pairs that got a contact constraint with a sleeping body. Empty between the stages of a step.
    pub touched_pairs: Vec<PairIndex>,
    /// Indices of sleeping bodies to which forces may have been applied in this update. Empty between the stages of a step.
    pub forced_bodies: Vec<BodyIndex>,
    /// Workspace: the islands of awake bodies in this step.
    pub(super) islands: UnionFind<BodyIndex>,
    /// Workspace: smallest rest time of the bodies of each island, seconds, at the index of the island's representative.
    pub(super) min_rest_time: IndexedVec<BodyIndex, f32>,
    /// Workspace: indices of the bodies that fall asleep in this step.
    pub falling_asleep: Vec<BodyIndex>,
}

reusing_clone! {
    SleepState {
        is_enabled, gravity, rest_time, next_in_ring, supported_acceleration, loaded_bodies, newly_asleep, count, awake_body_runs, awake_proxy_runs, wake_requests, touched_pairs, forced_bodies,
        islands, min_rest_time, falling_asleep
    }
}

/// Returns whether the body sleeps, by [`SleepState::next_in_ring`].
#[inline(always)]
fn is_asleep(next_in_ring: &IndexedVec<BodyIndex, BodyIndex>, body: BodyIndex) -> bool {
    next_in_ring.at(body).is_some_and(|&next| next < ABSENT)
}

/// Returns whether the body is there and awake, by [`SleepState::next_in_ring`].
#[inline(always)]
fn is_awake(next_in_ring: &IndexedVec<BodyIndex, BodyIndex>, body: BodyIndex) -> bool {
    next_in_ring.at(body) == Some(&AWAKE)
}

impl SleepState {
    /// Returns whether the body sleeps.
    #[inline(always)]
    pub fn is_asleep(&self, body: BodyIndex) -> bool {
        is_asleep(&self.next_in_ring, body)
    }

    /// Returns whether `body` is the index of an awake body.
    #[inline(always)]
    pub(crate) fn is_awake(&self, body: BodyIndex) -> bool {
        self.next_in_ring.at(body) == Some(&AWAKE)
    }

    /// Returns the states of the bodies in a range of indices, for [`is_asleep_state`](Self::is_asleep_state).
    #[inline(always)]
    pub fn states(&self, run: Range<usize>) -> &[BodyIndex] {
        self.next_in_ring.slice(run)
    }

    /// Returns whether a body with this state is asleep. An absent body is not.
    #[inline(always)]
    pub fn is_asleep_state(state: BodyIndex) -> bool {
        state < ABSENT
    }

    /// Returns the indices of the awake bodies with indices up to `last`.
    #[inline(always)]
    pub fn awake_bodies(&self, last: BodyIndex) -> impl Iterator<Item = BodyIndex> + '_ {
        let numbers = self.awake_body_runs.iter().cloned().flatten().map(BodyIndex::new);
        numbers.filter(move |&number| number <= last && self.next_in_ring[number] == AWAKE)
    }

    /// Returns whether bodies may sleep.
    pub fn is_enabled(&self) -> bool {
        self.is_enabled
    }

    /// Returns whether bodies may go on sleeping under this gravity, length units/s^2.
    pub fn may_go_on(&self, is_enabled: bool, gravity: Vector) -> bool {
        is_enabled && gravity == self.gravity
    }

    /// Stores whether bodies may sleep, and gravity, length units/s^2.
    pub fn set_conditions(&mut self, is_enabled: bool, gravity: Vector) {
        (self.is_enabled, self.gravity) = (is_enabled, gravity);
    }

    /// Returns the speed below which bodies are at rest, length units/s. `length_unit`: in the user's unit of length, > 0.
    ///
    /// It is `SLEEP_SPEED_PER_FALL` of the speed after a fall over one length unit, and `SLEEP_SPEED_WEIGHTLESS` at least.
    pub fn sleep_speed(&self, length_unit: f32) -> f32 {
        let fall = (2.0 * dot(self.gravity, self.gravity).sqrt() * length_unit).sqrt();
        let (speed, min_speed) = (SLEEP_SPEED_PER_FALL * fall, SLEEP_SPEED_WEIGHTLESS * length_unit);
        // The test also excludes an overflow of the square.
        if speed > min_speed && speed.is_finite() { speed } else { min_speed }
    }

    /// Appends a pair that has a new contact constraint with a sleeping body to `touched_pairs`.
    /// [`wake_touched`](super::wake::wake_touched) wakes the body.
    pub(crate) fn record_touch(&mut self, pair: PairIndex) {
        self.touched_pairs.push(pair);
    }

    /// Appends a body to `wake_requests`, if it sleeps. [`wake_requested`](super::wake::wake_requested) wakes it.
    pub fn request_wake(&mut self, body: BodyIndex) {
        if self.is_asleep(body) {
            self.wake_requests.push(body);
        }
    }

    /// Requests that the sleeping bodies of a pair wake. `bodies`: body index and body type of A and of B.
    pub(crate) fn request_wake_of_pair(&mut self, bodies: [(BodyIndex, BodyType); 2]) {
        for (body, body_type) in bodies {
            if body_type.takes_impulses() {
                self.request_wake(body);
            }
        }
    }

    /// Notes for both bodies of a pair that their support may have been removed: sleeping bodies are asked to wake, and rest
    /// times reset to 0.
    pub fn support_of_pair_removed(&mut self, bodies: [(BodyIndex, BodyType); 2]) {
        bodies.into_iter().for_each(|(body, _)| self.support_removed(body));
    }

    /// Requests that the bodies of a new pair wake if none of them may move. Such a pair arises when a geom is placed beside a
    /// sleeping body.
    pub fn wake_for_new_pair(&mut self, pairs: &Pairs, proxies: &Proxies, pair: PairIndex) {
        if !self.may_move(pairs, proxies, pair) {
            self.request_wake_of_pair(pairs.bodies_of(proxies, pair));
        }
    }

    /// Returns whether a body of the pair may move: it is kinematic, or awake and movable by impulses. Always false for a
    /// sensor pair without a body that impulses can move.
    pub(crate) fn may_move(&self, pairs: &Pairs, proxies: &Proxies, pair: PairIndex) -> bool {
        !pairs.state(pair).is_static_sensor
            && pairs.bodies_of(proxies, pair).iter().any(|&(body, body_type)| match body_type {
                BodyType::Fixed => false,
                BodyType::Kinematic => true,
                BodyType::Hinged | BodyType::Dynamic => !self.is_asleep(body),
            })
    }

    /// Notes that the support of a body may have been removed: a sleeping body is asked to wake, and the rest time of an awake
    /// one is reset to 0.
    pub fn support_removed(&mut self, body: BodyIndex) {
        self.request_wake(body);
        if let Some(rest) = self.rest_time.at_mut(body) {
            *rest = 0.0;
        }
    }

    /// Appends a sleeping body to `forced_bodies`, because forces may have been applied to it. The adapter
    /// compares the forces.
    pub fn record_force(&mut self, body: BodyIndex) {
        if self.is_asleep(body) {
            self.forced_bodies.push(body);
        }
    }

    /// Returns whether all bodies sleep, gravity is unchanged, and no wake request, new touch or force has to be examined.
    pub fn is_undisturbed(&self, gravity: Vector) -> bool {
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
            && touched_pairs.is_empty()
            && [wake_requests, forced_bodies, loaded_bodies, newly_asleep].iter().all(|list| list.is_empty())
    }

    /// Makes all bodies awake with rest time 0, after the list of bodies was rebuilt. `has_body`: [`BodySet::has_body`](crate::bodies::BodySet::has_body).
    pub fn reset(&mut self, has_body: &IndexedVec<BodyIndex, bool>) {
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
    pub fn add_body(&mut self, body: BodyIndex) {
        (self.next_in_ring[body], self.rest_time[body]) = (AWAKE, 0.0);
    }

    /// Removes a body. The bodies that fell asleep with it continue to sleep.
    pub fn remove_body(&mut self, body: BodyIndex) {
        if self.is_asleep(body) {
            let mut before = body;
            while self.next_in_ring[before] != body {
                before = self.next_in_ring[before];
            }
            self.next_in_ring[before] = self.next_in_ring[body];
            self.count -= 1;
        }
        (self.next_in_ring[body], self.rest_time[body], self.supported_acceleration[body]) =
            (ABSENT, 0.0, [0.0; 4]);
        self.loaded_bodies.retain(|&other| other != body);
        self.newly_asleep.retain(|&other| other != body);
    }

    /// Computes the index ranges of awake bodies and of their proxies. It is called after bodies have fallen asleep or woken.
    pub fn update_runs(&mut self, proxies: &Proxies) {
        let SleepState { next_in_ring, awake_body_runs, awake_proxy_runs, .. } = self;
        runs(next_in_ring.len(), |body: BodyIndex| is_awake(next_in_ring, body), awake_body_runs);
        runs(
            proxies.first_fixed.position(),
            |at| is_awake(next_in_ring, proxies.proxy(at).body),
            awake_proxy_runs,
        );
    }

    /// Updates the index ranges of awake bodies and of their proxies, where some of these `bodies` or `changed_proxies` were added
    /// or removed. Both are indices.
    pub fn update_runs_at(
        &mut self,
        bodies: &[BodyIndex],
        changed_proxies: &[ProxyIndex],
        proxies: &Proxies,
    ) {
        let SleepState { next_in_ring, awake_body_runs, awake_proxy_runs, .. } = self;
        if bodies.len() + changed_proxies.len() > next_in_ring.len() / BODIES_PER_RUN_UPDATE {
            return self.update_runs(proxies);
        }
        for &body in bodies {
            update_run(body, |body: BodyIndex| is_awake(next_in_ring, body), awake_body_runs);
        }
        for &proxy in changed_proxies.iter().filter(|&&proxy| proxy < proxies.first_fixed) {
            update_run(proxy, |at| is_awake(next_in_ring, proxies.proxy(at).body), awake_proxy_runs);
        }
    }

    /// Removes woken bodies from `loaded_bodies` and `newly_asleep`, and computes the index ranges of awake bodies anew.
    pub fn drop_woken(&mut self, proxies: &Proxies) {
        let SleepState { loaded_bodies, newly_asleep, next_in_ring, .. } = self;
        for list in [loaded_bodies, newly_asleep] {
            list.retain(|&body| is_asleep(next_in_ring, body));
        }
        self.update_runs(proxies);
    }

    /// Puts a body to sleep in the ring of the sleeping body `ring`, or in a new ring for `None`.
    ///
    /// `supported_acceleration`: accelerations by forces and torque under which the body sleeps: x, y (length units/s^2),
    /// angular (radians/s^2), z (length units/s^2).
    pub fn sleep_body(&mut self, body: BodyIndex, ring: Option<BodyIndex>, supported_acceleration: [f32; 4]) {
        self.rest_time[body] = f32::NEG_INFINITY;
        self.supported_acceleration[body] = supported_acceleration;
        self.loaded_bodies.extend((supported_acceleration != [0.0; 4]).then_some(body));
        let other = ring.unwrap_or(body);
        self.next_in_ring[body] = body;
        self.next_in_ring.swap(body, other);
        self.count += 1;
    }

    /// Wakes a body and all bodies that fell asleep together with it. Calls `woken` with the index of each.
    pub(crate) fn wake_ring(&mut self, body: BodyIndex, mut woken: impl FnMut(BodyIndex)) {
        let mut member = body;
        while self.is_asleep(member) {
            let next = std::mem::replace(&mut self.next_in_ring[member], AWAKE);
            self.rest_time[member] = 0.0;
            self.count -= 1;
            woken(member);
            member = next;
        }
    }

    /// Returns for each sleeping body the smallest index among it and the bodies that fell asleep together with it, and for all
    /// other bodies their own index.
    pub fn first_of_rings(&self) -> IndexedVec<BodyIndex, BodyIndex> {
        let mut firsts: IndexedVec<BodyIndex, BodyIndex> =
            (0..self.next_in_ring.len()).map(BodyIndex::new).collect();
        for body in (0..self.next_in_ring.len()).map(BodyIndex::new) {
            // Smaller members of the ring have marked it already.
            if !self.is_asleep(body) || firsts[body] != body {
                continue;
            }
            let mut member = self.next_in_ring[body];
            while member != body {
                firsts[member] = body;
                member = self.next_in_ring[member];
            }
        }
        firsts
    }
}

/// Updates the block of four that has the index `at` in `runs`, which hold ranges of blocks as [`runs`] computes them.
fn update_run<I: DenseIndex>(at: I, is_there: impl Fn(I) -> bool, runs: &mut Vec<Range<usize>>) {
    let block = at.position() - at.position() % 4;
    let counts = (block..block + 4).map(I::new).any(is_there);
    // The first run that ends after the block.
    let next = runs.partition_point(|run| run.end <= block);
    let was_counted = runs.get(next).is_some_and(|run| run.start <= block);
    match (was_counted, counts) {
        (false, true) => {
            let joins_last = next > 0 && runs[next - 1].end == block;
            let joins_next = runs.get(next).is_some_and(|run| run.start == block + 4);
            match (joins_last, joins_next) {
                (true, true) => runs[next - 1].end = runs.remove(next).end,
                (true, false) => runs[next - 1].end = block + 4,
                (false, true) => runs[next].start = block,
                (false, false) => runs.insert(next, block..block + 4),
            }
        }
        (true, false) => {
            let Range { start, end } = runs[next].clone();
            match (start == block, end == block + 4) {
                (true, true) => drop(runs.remove(next)),
                (true, false) => runs[next].start = block + 4,
                (false, true) => runs[next].end = block,
                (false, false) => {
                    runs[next].end = block;
                    runs.insert(next + 1, block + 4..end);
                }
            }
        }
        _ => {}
    }
}

/// Writes to `runs` the ranges of indices below `count` for which `is_there` holds, in blocks of four: a block counts if
/// `is_there` holds for at least one of its indices.
fn runs<I: DenseIndex>(count: usize, is_there: impl Fn(I) -> bool, runs: &mut Vec<Range<usize>>) {
    runs.clear();
    for block in (0..count).step_by(4).filter(|&four| (four..four + 4).map(I::new).any(&is_there)) {
        match runs.last_mut() {
            Some(run) if run.end == block => run.end = block + 4,
            _ => runs.push(block..block + 4),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{runs, update_run};
    use crate::index::{BodyIndex, IndexedVec};

    #[test]
    fn updated_runs_equal_those_that_are_computed_anew() {
        let mut is_there = IndexedVec::<BodyIndex, bool>::of_copies(false, 64);
        let (mut updated, mut expected) = (Vec::new(), Vec::new());
        let mut number = 1_u32;
        for _ in 0..4000 {
            number = number.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            let at = (number >> 16) % 64;
            let place = &mut is_there[BodyIndex(at)];
            *place = !*place && number >> 30 > 0;
            update_run(BodyIndex(at), |index| is_there[index], &mut updated);
            runs(is_there.len(), |index| is_there[index], &mut expected);
            assert_eq!(updated, expected);
        }
    }
}
