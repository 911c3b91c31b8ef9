//! What the precise set tells of islands: how each was solved in the last update, why so, what it took, and what is left of
//! its error. Found when somebody asks, from what the update has left behind.

use super::Precise;
use super::islands::Islands;
use super::manifold::{Manifold, collide};
use crate::body::BodyId;
use crate::joints::Joint;
use crate::joints::held::Keeps;
use crate::math::plane::{Vector, difference, dot};
use crate::methods::IslandChoice;
use crate::objects::Objects;
use crate::storage::order::{joined, sort_by_number};

/// Bodies that hang together by contacts, joints or springs: see
/// [`PhysicsSimulator::islands`](crate::PhysicsSimulator::islands).
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct Island {
    /// In the order of the list of bodies.
    pub bodies: Vec<BodyId>,
    /// Whether they sleep.
    pub is_asleep: bool,
    /// Whether they were solved as a whole in the last update, and not by passes over all contacts: see
    /// [`Methods::Precise`](crate::Methods::Precise).
    pub is_solved_whole: bool,
    /// How they were solved in the last update.
    pub method: IslandMethod,
    /// Why so.
    pub why: WhyMethod,
    /// What that took.
    pub cost: IslandCost,
}

/// How the precise set has solved an island in the last update. Springs of bodies that nothing touches or holds tie bodies together but are not solved:
/// where they tie what is solved in different ways, it is the one that comes last in this list.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum IslandMethod {
    /// Not at all: it sleeps now.
    Asleep,
    /// By the law of flight: nothing touches or holds it.
    Flight,
    /// All joints at once, since nothing touches what they hold; the step is divided as far as the swing asks for.
    Swing,
    /// All contacts and joints at once, as rigid bodies.
    Whole,
    /// By passes over all contacts, in substeps; joints at once, in turns with these passes.
    Passes,
}

/// Why an island was solved by its [method](IslandMethod) in the last update.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum WhyMethod {
    /// It has been at rest for long enough to sleep.
    AtRest,
    /// Nothing touches it: it flies, or swings.
    NothingTouches,
    /// Solving it as a whole pays.
    Pays,
    /// The game has [chosen](crate::PhysicsSimulator::set_island_choice) so.
    Chosen,
    /// Passes: it is one body on what does not give way.
    OneBody,
    /// Passes: joints hold some of it, and one of them is soft, or is a point with a greatest impulse;
    /// or there is a depth axis.
    Joints,
    /// Passes: two came together so fast that they bounced.
    Bounces,
    /// Passes: something in it moved faster than a quarter of a length unit per second when its contacts were asked for, or has
    /// come into place so. With joints: it was given up lately, and has a joint that gapes.
    Moves,
    /// Passes: it has contact cycles and fewer than 40 bodies. The iterative solver makes it stand, unless friction within its limit slips
    /// between calm bodies that were built in place.
    TooSmall,
    /// Passes: it has more than 400 bodies, which contacts tie more than joints; or, where there is a depth axis, more than 24 and rings of contacts.
    TooLarge,
    /// Passes: it has bounced, or was too busy, too wide or, with joints, too hard to be solved as a whole; or it has spent its budget.
    Rests {
        /// Updates after which that may be tried again.
        updates: u8,
    },
    /// Passes: there is a depth axis, and nothing in it lies on what weighs less than two thirds of it; or something rolls in it,
    /// or presses along that axis.
    HasDepth,
    /// Passes: nothing speaks against solving it as a whole, but in large scenes that is asked only in every 16th update; or it could
    /// not be solved so this time.
    NotAskedYet,
}

/// What solving an island took in the last update.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
pub struct IslandCost {
    /// Pairs of convex pieces with contacts that were solved, those that are only near among them.
    pub rows: usize,
    /// Joints that held.
    pub joints: usize,
    /// Parts that the step was divided into: substeps, if it was solved by passes.
    pub parts: u32,
    /// Steps of Newton's method, if it was solved as a whole: none while it goes on to bear what it bore.
    pub newton_steps: usize,
}

/// What is left of an island's error: see
/// [`PhysicsSimulator::island_residual`](crate::PhysicsSimulator::island_residual). Lengths are the user's.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct IslandResidual {
    /// Greatest depth to which two of its outlines overlap.
    pub overlap: f32,
    /// Greatest speed, in length per second, with which two of them come nearer than the next update may let them.
    pub approach: f32,
    /// Greatest distance of a joint from the point, distance or line that it keeps.
    pub gap: f32,
    /// Greatest angle in radians by which a joint that keeps an angle alone is off.
    pub angle: f32,
}

/// What is told of one body.
#[derive(Debug, Clone, Copy)]
struct Told {
    method: IslandMethod,
    why: WhyMethod,
    /// Of the island, shared out to its bodies; parts are those of each.
    cost: IslandCost,
}

impl Told {
    fn new(method: IslandMethod, why: WhyMethod, parts: u32) -> Self {
        Told { method, why, cost: IslandCost { parts, ..IslandCost::default() } }
    }

    /// Of both: the one that comes last says how.
    fn and(self, other: Self) -> Self {
        let last = if other.method > self.method { other } else { self };
        let cost = IslandCost {
            rows: self.cost.rows + other.cost.rows,
            joints: self.cost.joints + other.cost.joints,
            parts: self.cost.parts.max(other.cost.parts),
            newton_steps: self.cost.newton_steps + other.cost.newton_steps,
        };
        Told { cost, ..last }
    }
}

impl Precise {
    /// The islands: those that are awake, then those that sleep, by their least numbers.
    pub(crate) fn islands(&self, objects: &Objects) -> Vec<Island> {
        let mut awake = Islands::default();
        self.join_islands(objects, &mut awake);
        let mut all: Vec<(bool, usize, usize)> = (1..=self.bodies.count)
            .filter(|&number| self.is_dynamic(number))
            .map(|number| match self.sleep.is_asleep(number) {
                true => (true, self.sleep.first_with(number), number),
                false => (false, awake.find(number as u32) as usize, number),
            })
            .collect();
        sort_by_number(&mut all, |&(sleeps, first, number)| {
            joined([sleeps.into(), first as u32, number as u32])
        });
        let told = self.told();
        let island = |bodies: &[(bool, usize, usize)]| {
            let of_bodies = bodies.iter().map(|&(.., number)| told[number]);
            let Told { method, why, cost } = of_bodies.reduce(Told::and)?;
            Some(Island {
                bodies: bodies.iter().filter_map(|&(.., number)| self.bodies.ids[number]).collect(),
                is_asleep: method == IslandMethod::Asleep,
                is_solved_whole: method == IslandMethod::Whole,
                method,
                why,
                cost,
            })
        };
        all.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)).filter_map(island).collect()
    }

    /// What is told of each body that can be pushed, by number.
    fn told(&self) -> Vec<Told> {
        let (mut unions, mut census) = (Islands::default(), Vec::new());
        self.count_islands(&mut unions, &mut census, &|body| self.bodies.before[body as usize]);
        let substeps = if self.h > 0.0 { (self.dt / self.h).round() as u32 } else { 0 };
        let rows = self.rows_by_body();
        let mut told: Vec<Told> = (0..self.bodies.hot.len())
            .map(|body| {
                let of = &census[unions.find(body as u32) as usize];
                if self.sleep.is_asleep(body) {
                    Told::new(IslandMethod::Asleep, WhyMethod::AtRest, 0)
                } else if self.direct.is_direct(body) {
                    let is_chosen = self.direct.choice() == IslandChoice::Whole;
                    let why = if is_chosen { WhyMethod::Chosen } else { WhyMethod::Pays };
                    Told::new(IslandMethod::Whole, why, 1)
                } else if of.has_contacts() || self.joints.holds(body) {
                    let why = of.why_passes(self.direct.choice());
                    Told::new(IslandMethod::Passes, why, substeps)
                } else {
                    Told::new(IslandMethod::Flight, WhyMethod::NothingTouches, 1)
                }
            })
            .collect();
        for (body, parts) in self.joints.swinging(substeps).filter(|&(body, _)| !self.sleep.is_asleep(body)) {
            told[body] = Told::new(IslandMethod::Swing, WhyMethod::NothingTouches, parts);
        }
        told.iter_mut().zip(rows).for_each(|(told, rows)| told.cost.rows = rows);
        for ties in self.joints.ties() {
            let holder = ties.into_iter().find(|&body| body > 0 && self.is_awake(body));
            holder.into_iter().for_each(|body| told[body].cost.joints += 1);
        }
        self.direct.solved().for_each(|(body, steps)| told[body].cost.newton_steps = steps);
        told
    }

    fn is_awake(&self, body: usize) -> bool {
        self.is_dynamic(body) && !self.sleep.is_asleep(body)
    }

    /// How many rows there are of bodies that are awake, each at one of its bodies.
    fn rows_by_body(&self) -> Vec<usize> {
        let mut rows = vec![0; self.bodies.hot.len()];
        for pair in (0..self.pairs.awake).filter(|&pair| self.pairs.all[pair].home.is_some()) {
            let body = self.sides(pair).map(|(body, _)| body).into_iter().rfind(|&body| self.is_awake(body));
            body.into_iter().for_each(|body| rows[body] += 1);
        }
        rows
    }

    /// What is left of the error of these bodies; stale ones, and those that nothing pushes, have none.
    pub(crate) fn residual(&self, bodies: &[BodyId], objects: &Objects) -> IslandResidual {
        let mut left = IslandResidual::default();
        let numbers = bodies.iter().filter_map(|&body| self.number_of(body));
        for body in numbers.filter(|&body| self.is_dynamic(body)) {
            let pairs = self.pairs.of_body(&self.proxies, body);
            for pair in pairs.filter(|&pair| self.pairs.all[pair].home.is_some()) {
                let [overlap, approach] = self.residual_of_pair(pair, objects);
                (left.overlap, left.approach) = (left.overlap.max(overlap), left.approach.max(approach));
            }
        }
        let all = (0..objects.joints.list().len()).filter_map(|at| objects.joints.at(at));
        for (id, joint) in all.filter(|(_, joint)| joint.enabled() && holds_one_of(joint, bodies)) {
            let gap = self.joint_gap((id, joint), &objects.bodies).unwrap_or(0.0).abs();
            let of = if joint.held().keeps == Keeps::Angle { &mut left.angle } else { &mut left.gap };
            *of = of.max(gap);
        }
        left
    }

    /// How deep the outlines of a pair overlap where they are now, and how much faster they approach than they may: a gap is
    /// closed in one update.
    fn residual_of_pair(&self, pair: usize, objects: &Objects) -> [f32; 2] {
        let [a, b] = self.pairs.watched[pair].proxies.map(|proxy| &self.proxies.all[proxy as usize]);
        let [pose_a, pose_b] = [a, b].map(|proxy| self.bodies.poses[proxy.body as usize]);
        let [outline_a, outline_b] = [a, b].map(|proxy| self.proxies.corners.outline(proxy.shape));
        let Manifold { normal, count, points, separations, .. } =
            collide(outline_a, outline_b, pose_a, pose_b, self.tuning.speculative);
        let apart = [pose_b[0] - pose_a[0], pose_b[1] - pose_a[1]];
        let mut left = [0.0_f32; 2];
        for (&point, &separation) in points.iter().zip(&separations).take(count) {
            let velocity_a = self.velocity_at(a.body as usize, point, objects);
            let velocity_b = self.velocity_at(b.body as usize, difference(point, apart), objects);
            let approach = -dot(difference(velocity_b, velocity_a), normal);
            let allowed = if self.dt > 0.0 { separation.max(0.0) / self.dt } else { 0.0 };
            left = [left[0].max(-separation), left[1].max(approach - allowed)];
        }
        left
    }

    /// The velocity of a body there, from its origin. What stands still has none.
    fn velocity_at(&self, body: usize, [x, y]: Vector, objects: &Objects) -> Vector {
        let id = self.bodies.ids.get(body).copied().flatten().filter(|_| body <= self.bodies.count);
        let Some(entry) = id.and_then(|id| objects.bodies.get(id)) else { return [0.0; 2] };
        let (velocity, spin) = (entry.body.linear_velocity(), entry.body.angular_velocity());
        [velocity.x - spin * y, velocity.y + spin * x]
    }
}

fn holds_one_of(joint: &Joint, bodies: &[BodyId]) -> bool {
    let (first, second) = joint.held().bodies;
    first.into_iter().chain([second]).any(|body| bodies.contains(&body))
}
