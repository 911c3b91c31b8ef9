//! Islands that are solved [as a whole](island), by their graph: those of few bodies on which the factors fill in little.
//! Columns, houses and walls stand exactly then. Contact cycles that come together by motion are hard to solve: they are the iterative
//! solver's, unless [heavy bodies press on them](loads), and so is whatever bounces. Small islands with contact cycles that were built in
//! place begin with the iterative solver, too, which makes pyramids and arches stand; where friction that ought to hold
//! [slips](Census::slips), they are solved directly. Islands with joints are solved [together with these](joined), whatever moves. All that
//! lasts as long as it [pays](price).
//!
//! A row has one home: those of such islands are taken out of their colours, and go back to them with the impulses that were
//! found.

pub(in crate::precise) mod block;
pub(in crate::precise) mod constraint;
mod constraint_list;
mod contact;
mod depth;
mod factor;
mod island;
pub(in crate::precise) mod joined;
pub(in crate::precise) mod joint;
mod listing;
mod loads;
mod price;
mod swing;
mod unsolved;
mod whole;

use crate::precise::parameters::direct::{
    ACCEPTED_JOINT_ERROR, BUSY_ISLAND_PAUSE, CALM_SPEED, CYCLIC_DEPTH_ISLAND_BODIES, CYCLIC_ISLAND_BODIES,
    DIRECT_ISLAND_BODIES, FACTOR_PRODUCTS_PER_BODY, HIGH_STACK_BODIES, IMMEDIATE_RESELECTION_BODIES,
    JOINTED_FACTOR_PRODUCTS_PER_BODY, LONGEST_FRICTION_WATCH, RESELECTION_PERIOD, SLIP_SPEED,
    STICKING_FRICTION_PART,
};
use serde::{Deserialize, Serialize};

use super::Precise;
use super::islands::Islands;
use super::proxies::Mobility;
use super::rows::{Lane, PointLane};
use super::telling::WhyMethod;
use super::tuning::Learning;
use crate::methods::IslandChoice;
use crate::storage::order::{joined, sort_within};
use crate::storage::reusing_clone::reusing_clone;
use constraint::Jacobian;
use depth::is_in_plane;
pub(super) use depth::{is_burden, is_upright};
use island::Member;
use listing::{add_edges_of_joints, list_edges, list_joined};
use loads::differ;
use whole::Whole;

/// How an island has fared so far, at each of its bodies.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Wear {
    /// It is solved as a whole.
    pub(super) is_direct: bool,
    /// Steps of Newton's method per update, on the average.
    pub(super) effort: f32,
    /// It was solved in the last update.
    pub(super) is_hot: bool,
    /// Updates for which it is left to the passes.
    pub(super) rest: u8,
    /// It has come with what moved.
    pub(super) is_loose: bool,
    /// With joints: a solution was accepted since it is solved as a whole.
    pub(super) was_solved: bool,
    /// With a budget: part of its overdraft that is overdrawn, as a negative number.
    pub(super) budget: f32,
    /// With a budget: updates for which it was left to the iterative solver the last time, less one for each quiet one since.
    pub(super) back_off: u8,
    /// Updates until friction of the iterative solver is [looked at](Precise::look_at_friction), and how often it has been, plus one; 0 if it is
    /// not watched.
    pub(super) look_in: u8,
    pub(super) watch: u8,
}

impl Wear {
    /// Contacts of this body have come, or have come to the iterative solver.
    fn begin_watch(&mut self) {
        (self.look_in, self.watch) = (1, 1);
    }

    /// An update passes. Answers whether friction is looked at in it; after that twice as many updates pass as before.
    fn is_looked_at(&mut self) -> bool {
        self.look_in = self.look_in.saturating_sub(1);
        let is_due = self.watch > 0 && self.look_in == 0;
        if is_due {
            self.look_in = 1 << self.watch.min(LONGEST_FRICTION_WATCH);
            self.watch = self.watch.saturating_add(1);
        }
        is_due
    }
}

/// What is solved as a whole.
#[derive(Debug, Default)]
pub(super) struct Direct {
    /// By body number.
    pub(super) wear: Vec<Wear>,
    pub(super) timing: Timing,
    /// Whether the islands below are those that are to be solved as a whole.
    is_listed: bool,
    /// The first so many are in use.
    islands: Vec<Whole>,
    count: usize,
    /// Seconds of the last step, and of its substeps.
    seconds: [f32; 2],
    /// Empty between updates, but for the room they have.
    unions: Islands,
    census: Vec<Census>,
    found: Vec<(u32, u32)>,
    edges: Vec<[u32; 2]>,
    joined_bodies: Vec<(u32, [u32; 2])>,
    order: Vec<(u128, u32)>,
}

reusing_clone! {
    Direct { wear, timing, is_listed, islands, count, seconds, unions, census, found, edges, joined_bodies, order }
}

/// When islands are asked for.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Timing {
    /// Rows of islands that are solved as a whole have come or gone; or others have.
    pub(super) is_due: bool,
    pub(super) may_be_due: bool,
    /// Updates for which the second has been so, and whether some body rests.
    age: u8,
    has_resting: bool,
    /// The [signature](super::joints::Joints::signature) of the joints that there were.
    joints: u64,
    /// What the game wants of islands.
    choice: IslandChoice,
}

impl Timing {
    /// Islands are asked for.
    fn begin_again(&mut self) {
        (self.is_due, self.may_be_due, self.age) = (false, false, 0);
    }
}

/// What is counted of an island.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Census {
    bodies: u32,
    contacts: u32,
    /// Bodies that are solved as a whole so far.
    direct: u32,
    /// Updates for which it is left to the passes.
    rest: u8,
    /// Its joints, beside those of free articulations.
    joints: u32,
    /// A joint or a hinge that is not for this holds something in it, or something bounces, or moves, or has come with what moved.
    is_held: bool,
    bounces: bool,
    moves: bool,
    is_loose: bool,
    /// Without a depth axis: a contact slides, though its friction is within its limit. The iterative solver has not converged there, and
    /// what is held by friction alone, such as a card house, creeps until it topples.
    slips: bool,
    /// With joints: it was given up lately; and a joint gapes.
    has_failed: bool,
    is_torn: bool,
    /// There is a depth axis; and a contact is not in the plane.
    has_depth: bool,
    is_deep: bool,
    /// Something bears more than one and a half times what it weighs; or is jammed by what is far heavier.
    is_burdened: bool,
    is_jammed: bool,
    /// Its place among those that are solved as a whole.
    place: Option<u32>,
}

impl Census {
    /// Why it is not for this; `None` if it is.
    pub(super) fn refusal(&self, choice: IslandChoice) -> Option<WhyMethod> {
        let refusals = [
            (self.bodies < 2 && self.joints == 0, WhyMethod::OneBody),
            (self.is_held, WhyMethod::Joints),
            (choice == IslandChoice::Passes, WhyMethod::Chosen),
            (self.bodies > DIRECT_ISLAND_BODIES && self.contacts > self.joints, WhyMethod::TooLarge),
            (self.bounces, WhyMethod::Bounces),
        ];
        first(&refusals).or_else(|| if choice == IslandChoice::Whole { None } else { self.price() })
    }

    /// Whether it is left to the passes for a while.
    fn waits(&self) -> bool {
        (self.bounces || self.is_deep) && (self.is_burdened || !self.has_depth)
    }

    /// Whether there are more contacts than bodies: two of them at least are in rings, or all are held from two sides.
    fn has_rings(&self) -> bool {
        self.contacts > self.bodies
    }

    pub(super) fn has_contacts(&self) -> bool {
        self.contacts > 0
    }

    /// Whether it has contact cycles in the plane, no joints, and so few bodies that the iterative solver makes it stand unless it
    /// [slips](Self::slips).
    fn is_small_cycle(&self) -> bool {
        self.has_rings() && self.bodies < CYCLIC_ISLAND_BODIES && self.joints == 0 && !self.has_depth
    }

    /// Why it is left to the passes.
    pub(super) fn why_passes(&self, choice: IslandChoice) -> WhyMethod {
        let rests = (self.rest > 0).then_some(WhyMethod::Rests { updates: self.rest });
        let is_free = self.contacts == 0 && self.joints == 0;
        let joints = is_free.then_some(WhyMethod::Joints);
        joints.or(self.refusal(choice)).or(rests).unwrap_or(WhyMethod::NotAskedYet)
    }

    /// Why it does not pay; `None` if it does.
    fn price(&self) -> Option<WhyMethod> {
        let Census { bodies, direct, .. } = *self;
        let (has_rings, is_built) = (self.has_rings(), !(self.moves || self.is_loose));
        let was_whole = 2 * direct > bodies;
        let rests = (self.rest > 0, WhyMethod::Rests { updates: self.rest });
        first(&if self.joints > 0 {
            let fails = self.has_failed && !was_whole && self.is_torn;
            [rests, (fails, WhyMethod::Moves), rests, rests]
        } else if self.has_depth {
            [
                rests,
                (self.is_deep, WhyMethod::HasDepth),
                (!(self.is_burdened || was_whole), WhyMethod::HasDepth),
                (has_rings && bodies > CYCLIC_DEPTH_ISLAND_BODIES, WhyMethod::TooLarge),
            ]
        } else if self.is_loaded() {
            [rests; 4]
        } else {
            [
                rests,
                (self.is_small_cycle() && !(is_built && (self.slips || was_whole)), WhyMethod::TooSmall),
                (has_rings && !is_built && !was_whole, WhyMethod::Moves),
                (!has_rings && !is_built && bodies < HIGH_STACK_BODIES, WhyMethod::Moves),
            ]
        })
    }
}

/// The first reason that holds.
#[inline(never)]
fn first(refusals: &[(bool, WhyMethod)]) -> Option<WhyMethod> {
    refusals.iter().find(|(refuses, _)| *refuses).map(|&(_, why)| why)
}

impl Direct {
    /// All bodies are listed anew.
    pub(super) fn reset(&mut self, bodies: usize) {
        self.wear.clear();
        self.wear.resize(bodies, Wear::default());
        self.is_listed = false;
        self.count = 0;
    }

    /// A body has gone.
    pub(super) fn forget(&mut self, body: usize) {
        self.timing.is_due |= self.wear[body].is_direct;
        self.wear[body] = Wear::default();
    }

    #[inline(always)]
    pub(super) fn is_direct(&self, body: usize) -> bool {
        self.wear.get(body).is_some_and(|wear| wear.is_direct)
    }

    /// A row between these bodies comes or goes; where there is a depth axis, only some rows matter.
    #[inline(always)]
    pub(super) fn note(&mut self, bodies: [u32; 2], has_depth: bool) {
        self.timing.is_due |= bodies.iter().any(|&body| self.is_direct(body as usize));
        self.timing.may_be_due |= !has_depth;
    }

    /// A row has come whose second body, which is dynamic, is this one: its friction is watched.
    pub(super) fn watch_friction(&mut self, body: u32, has_depth: bool) {
        let wear = &mut self.wear[body as usize];
        if !(has_depth || wear.is_direct || wear.is_loose) {
            wear.begin_watch();
        }
    }

    /// The joints and springs of this update have this signature. Where that is another one islands are asked for at once: a soft chain
    /// stretches while it waits, and hardly any solution leads back from there.
    pub(super) fn note_joints(&mut self, signature: u64, are_places_new: bool) {
        self.is_listed &= !are_places_new;
        let Timing { joints, is_due, .. } = &mut self.timing;
        if std::mem::replace(joints, signature) != signature {
            self.is_listed = false;
            *is_due = true;
        }
    }

    /// What the game wants of islands.
    pub(super) fn choice(&self) -> IslandChoice {
        self.timing.choice
    }

    /// The first body of each island that was solved as a whole, and the steps of Newton's method that this took.
    pub(super) fn solved(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        let first = |whole: &Whole| Some((whole.island.members.first()?.number as usize, whole.steps));
        self.islands[..self.count].iter().filter_map(first)
    }

    /// Whether no island is solved as a whole, and none is to be asked for.
    pub(super) fn is_quiet(&self) -> bool {
        let Timing { is_due, may_be_due, age, has_resting, .. } = self.timing;
        self.is_listed && self.count == 0 && age == 0 && !(is_due || may_be_due || has_resting)
    }

    /// Whether it is time to ask for islands.
    fn tick(&mut self, is_quick: bool) -> bool {
        let Timing { is_due, may_be_due, age, has_resting, .. } = &mut self.timing;
        if std::mem::take(has_resting) {
            for wear in self.wear.iter_mut().filter(|wear| wear.rest > 0) {
                wear.rest -= 1;
                *may_be_due |= wear.rest == 0;
                *has_resting |= wear.rest > 0;
            }
        }
        *age = if *may_be_due { *age + 1 } else { 0 };
        *is_due || (*may_be_due && (*age >= RESELECTION_PERIOD || is_quick))
    }
}

impl Precise {
    /// Which islands are solved as a whole, if that may have changed.
    pub(super) fn choose_methods(&mut self, learning: &Learning) {
        if self.bounces || self.space.is_some() {
            let (hot, least) = (&self.bodies.hot, self.tuning.bounce);
            let velocity = |body: u32| hot[body as usize].velocity;
            let is_refused = |lane: &Lane| {
                let velocities = [lane.a, lane.b].map(velocity);
                bounces(lane, velocities, least) || self.presses_across(lane, velocities)
            };
            self.direct.timing.is_due |= self.rows.all_direct().iter().any(|row| is_refused(&row.lane));
        }
        if self.space.is_some() && self.direct.is_listed && !self.direct.timing.is_due {
            self.direct.is_listed = self.are_contacts_listed();
        }
        self.look_at_friction();
        let moves = |body: usize| self.moves(self.bodies.hot[body].velocity);
        let is_calm = || !self.sleep.awake(self.bodies.count).any(moves);
        let is_whole = self.direct.timing.choice == IslandChoice::Whole;
        let is_quick = self.direct.timing.may_be_due
            && (is_whole
                || (self.is_few()
                    && (!self.joints.are_none()
                        || !self.springs.are_none()
                        || is_calm()
                        || self.has_load())));
        let chooses = self.direct.tick(is_quick);
        if chooses {
            self.direct.timing.begin_again();
        }
        if chooses || !self.direct.is_listed {
            self.take_census();
            self.plan_islands(chooses);
            if chooses {
                self.move_rows(learning);
            }
            self.list_contacts();
            self.list_joints();
        }
        self.direct.is_listed = true;
    }

    /// Islands are asked for at once if friction that is due [slips](Census::slips) between bodies that are calm and were built in place.
    fn look_at_friction(&mut self) {
        if self.space.is_some() {
            return;
        }
        let mut is_due = false;
        for body in self.sleep.awake(self.bodies.count) {
            is_due |= self.direct.wear[body].is_looked_at();
        }
        if is_due {
            self.direct.timing.is_due |= (0..self.pairs.awake).any(|pair| self.slips_now(pair));
        }
    }

    fn slips_now(&self, pair: usize) -> bool {
        let state = self.pairs.all[pair];
        let body = self.sides(pair)[1].0;
        let Wear { watch, look_in, is_loose, .. } = self.direct.wear[body];
        let was_looked_at = watch > 1 && look_in == 1 << (watch - 1).min(LONGEST_FRICTION_WATCH);
        let velocity = |body: u32| self.bodies.hot[body as usize].velocity;
        let is_calm = || !self.moves(velocity(body as u32));
        let home = state.home.filter(|home| was_looked_at && !is_loose && !home.is_direct() && is_calm());
        let limit = SLIP_SPEED * self.tuning.unit;
        home.is_some_and(|home| slips(&self.rows.lane(state.kind, home), &velocity, limit))
    }

    /// Whether the contacts of the islands are all those in the plane, and no others: the normal of a contact may turn towards
    /// the depth axis, or back, while its row stays.
    fn are_contacts_listed(&self) -> bool {
        let in_plane = self.rows.all_direct().iter().filter(|row| is_in_plane(&row.lane)).count();
        let islands = &self.direct.islands[..self.direct.count];
        let listed: usize = islands.iter().map(|whole| whole.homes.len()).sum();
        let mut homes = islands.iter().flat_map(|whole| &whole.homes);
        listed == in_plane && homes.all(|&home| is_in_plane(&self.rows.direct(home).lane))
    }

    /// Whether not many bodies are awake.
    fn is_few(&self) -> bool {
        self.bodies.live - self.asleep_count() <= IMMEDIATE_RESELECTION_BODIES
    }

    /// What the game wants of islands, from this update on.
    pub(crate) fn set_island_choice(&mut self, choice: IslandChoice) {
        let timing = &mut self.direct.timing;
        timing.is_due |= std::mem::replace(&mut timing.choice, choice) != choice;
    }

    /// Whether a body of this velocity is no longer calm.
    fn moves(&self, [x, y, ..]: [f32; 4]) -> bool {
        let calm = CALM_SPEED * self.tuning.unit;
        x * x + y * y > calm * calm
    }

    /// Islands of what is awake, how many bodies they have and which are not for this.
    fn take_census(&mut self) {
        let mut unions = std::mem::take(&mut self.direct.unions);
        let mut census = std::mem::take(&mut self.direct.census);
        self.count_islands(&mut unions, &mut census, &|body| self.bodies.hot[body as usize].velocity);
        (self.direct.unions, self.direct.census) = (unions, census);
    }

    /// Counts the islands of what is awake, with these velocities of bodies.
    pub(super) fn count_islands(
        &self,
        unions: &mut Islands,
        census: &mut Vec<Census>,
        velocity: &dyn Fn(u32) -> [f32; 4],
    ) {
        self.join_contacts(unions);
        let least = self.least_burden();
        census.clear();
        census.resize(self.bodies.hot.len(), Census::default());
        for body in self.sleep.awake(self.bodies.count).filter(|&body| !self.bodies.is_kinematic(body)) {
            let of = &mut census[unions.find(body as u32) as usize];
            of.bodies += 1;
            let wear = self.direct.wear[body];
            of.direct += u32::from(wear.is_direct);
            of.is_held |= self.space.is_some() && self.joints.holds(body);
            of.has_failed |= wear.back_off > 0;
            of.rest = of.rest.max(wear.rest);
            of.moves |= self.moves(velocity(body as u32));
            of.is_loose |= wear.is_loose;
        }
        self.count_joints(unions, census);
        for pair in 0..self.pairs.awake {
            let state = self.pairs.all[pair];
            let Some(home) = state.home else { continue };
            let [(one, mobility), (body, _)] = self.sides(pair);
            let sides = [one, body];
            let of = &mut census[unions.find(body as u32) as usize];
            of.contacts += 1;
            of.is_held |= mobility == Mobility::Hinged;
            of.has_depth = self.space.is_some();
            if !(of.slips || of.has_depth) {
                of.slips = slips(&self.rows.lane(state.kind, home), velocity, SLIP_SPEED * self.tuning.unit);
            }
            let inverse_masses = sides.map(|body| self.bodies.inverses[body][0]);
            if self.bounces || of.has_depth || differ(inverse_masses, least) {
                let lane = self.rows.lane(state.kind, home);
                let velocities = [lane.a, lane.b].map(velocity);
                of.bounces |= bounces(&lane, velocities, self.tuning.bounce);
                of.is_deep |= self.presses_across(&lane, velocities);
                let [bears, is_jammed] = self.load(&lane);
                of.is_burdened |= bears;
                of.is_jammed |= is_jammed;
            }
        }
    }

    /// Counts the joints and springs of islands in the plane.
    fn count_joints(&self, unions: &mut Islands, census: &mut [Census]) {
        let gap = ACCEPTED_JOINT_ERROR as f32 * self.tuning.unit;
        let all = self.joints.candidates().chain(self.springs.candidates());
        for joint in all.filter(|_| self.space.is_none()) {
            let Some(body) = joint.a_body() else { continue };
            let of = &mut census[unions.find(body) as usize];
            of.joints += 1;
            of.is_held |= joint.is_free || !joint.may_be_rows;
            of.is_torn |= joint.error > gap;
        }
    }

    /// The islands that are solved as a whole are planned, in the order of their first bodies: those that may be, or those
    /// that were.
    fn plan_islands(&mut self, chooses: bool) {
        let Precise { direct, bodies, pairs, proxies, sleep, joints, springs, .. } = self;
        let Direct { islands, unions, census, found, edges, joined_bodies, order, wear, timing, .. } = direct;
        found.clear();
        for body in sleep.awake(bodies.count) {
            let root = unions.find(body as u32);
            let of = &census[root as usize];
            let is_wanted = if chooses { of.refusal(timing.choice).is_none() } else { wear[body].is_direct };
            found.extend(is_wanted.then_some((root, body as u32)));
            wear[body].is_loose |= chooses && of.moves;
            let is_given_up = of.joints > 0 && of.has_failed && !is_wanted;
            if chooses && (of.waits() || is_given_up) && wear[body].rest == 0 {
                wear[body].rest = RESELECTION_PERIOD;
                timing.has_resting = true;
            }
            let is_watched = !is_wanted && of.is_small_cycle() && !(of.moves || of.is_loose);
            if chooses && !is_watched {
                wear[body].watch = 0;
            } else if chooses && wear[body].watch == 0 {
                wear[body].begin_watch();
            }
        }
        sort_within(order, found, |&(root, body)| joined([root, body]));
        if chooses {
            wear.iter_mut().for_each(|wear| wear.is_direct = false);
        }
        joined_bodies.clear();
        if census.iter().any(|of| of.joints > 0) {
            list_joined((&*joints, &*springs), unions, joined_bodies, order);
        }
        let mut count = 0;
        for members in found.chunk_by(|one, other| one.0 == other.0) {
            if islands.len() == count {
                islands.push(Whole::default());
            }
            let whole = &mut islands[count];
            whole.springs.clear();
            whole.spring_ends.clear();
            let Whole { island, homes, ends, has_pushes, stood, joints: of_island, joint_ends, .. } = whole;
            homes.clear();
            ends.clear();
            of_island.clear();
            joint_ends.clear();
            *has_pushes = false;
            stood.clear();
            island.members.clear();
            island.members.extend(members.iter().map(|&(_, number)| Member { number, ..Member::default() }));
            list_edges(members, pairs, proxies, edges, order);
            let has_joints = census[members[0].0 as usize].joints > 0;
            if has_joints {
                add_edges_of_joints(members, joined_bodies, edges, order);
            }
            let filled = if has_joints { JOINTED_FACTOR_PRODUCTS_PER_BODY } else { FACTOR_PRODUCTS_PER_BODY };
            let mut worn = worst(members, wear);
            if island.factor.plan(members.len(), edges, filled * members.len()) {
                census[members[0].0 as usize].place = Some(count as u32);
                count += 1;
            } else {
                (worn.is_direct, worn.rest) = (false, BUSY_ISLAND_PAUSE);
                timing.has_resting = true;
            }
            if chooses {
                members.iter().for_each(|&(_, body)| wear[body as usize] = worn);
            }
        }
        direct.count = count;
    }

    /// Rows go where their islands are solved. What was solved as a whole carries what it did in the last step. Where things
    /// have moved that may be a blow, and springs of rings that rested at it would push against each other for a second: they
    /// rest at as much of it as the passes would let them learn. So do those of islands with joints, which are softer in the passes.
    fn move_rows(&mut self, learning: &Learning) {
        for pair in 0..self.pairs.awake {
            let Some(home) = self.pairs.all[pair].home else { continue };
            let body = self.sides(pair)[1].0;
            let (is_direct, was_direct) = (self.direct.is_direct(body), home.is_direct());
            if is_direct != was_direct {
                let root = self.direct.unions.find(body as u32) as usize;
                let Wear { is_loose, was_solved, .. } = self.direct.wear[body];
                let may_rock = was_solved || (is_loose && self.direct.census[root].has_rings());
                if was_direct && may_rock {
                    let points = &mut self.rows.direct_mut(home).lane.points;
                    points.iter_mut().for_each(|point| point.held *= learning.learnt);
                }
                let h = self.h;
                self.touch().hand_over(pair, is_direct, h);
            }
        }
        self.direct.wear.iter_mut().for_each(|wear| wear.was_solved &= wear.is_direct);
    }

    /// Bodies that contacts, and joints and springs in the plane, tie together.
    fn join_contacts(&self, unions: &mut Islands) {
        unions.part(self.bodies.hot.len());
        for pair in (0..self.pairs.awake).filter(|&pair| self.pairs.all[pair].home.is_some()) {
            if let [(a, Mobility::Dynamic), (b, Mobility::Dynamic)] = self.sides(pair) {
                unions.join(a as u32, b as u32);
            }
        }
        if self.space.is_none() {
            let of_joints = self.joints.candidates().chain(self.springs.candidates());
            of_joints
                .map(|joint| joint.bodies)
                .filter(|[a, b]| *a != 0 && *b != 0)
                .for_each(|[a, b]| unions.join(a, b));
        }
    }
}

/// Whether two with these velocities come together so fast that they bounce: that is for the passes.
fn bounces(lane: &Lane, [a, b]: [[f32; 4]; 2], least: f32) -> bool {
    let along = lane.normal[0] * (b[0] - a[0]) + lane.normal[1] * (b[1] - a[1]);
    let is_fast =
        |point: &PointLane| point.mass > 0.0 && along + b[2] * point.arm_b - a[2] * point.arm_a < -least;
    lane.restitution > 0.0 && lane.points.iter().any(is_fast)
}

/// Whether a contact slides faster than `limit` in length units/s, though friction is within its limit.
fn slips(lane: &Lane, velocity: &dyn Fn(u32) -> [f32; 4], limit: f32) -> bool {
    let [a, b] = [lane.a, lane.b].map(|body| velocity(body).map(f64::from));
    let [.., along] = Jacobian::of(lane).relative([a[0], a[1], a[2]], [b[0], b[1], b[2]]);
    let bound = lane.friction * (lane.points[0].impulse + lane.points[1].impulse);
    lane.tangent_impulse.abs() < STICKING_FRICTION_PART * bound
        && (along - f64::from(lane.tangent_speed)).abs() > f64::from(limit)
}

/// How bodies have fared that are an island now.
fn worst(members: &[(u32, u32)], wear: &[Wear]) -> Wear {
    let first = Wear { is_direct: true, was_solved: true, ..Wear::default() };
    members.iter().map(|&(_, body)| wear[body as usize]).fold(first, |worst, wear| Wear {
        effort: if wear.effort > worst.effort { wear.effort } else { worst.effort },
        is_hot: worst.is_hot || wear.is_hot,
        is_loose: worst.is_loose || wear.is_loose,
        was_solved: worst.was_solved && wear.was_solved,
        budget: if wear.budget < worst.budget { wear.budget } else { worst.budget },
        back_off: worst.back_off.max(wear.back_off),
        ..worst
    })
}
