//! An island in an update: what its rows say, and what goes back to them.
//!
//! Mostly all is as it is to be. That is seen row by row; contacts are only made of the rows of what is to be solved.

use super::Wear;
use super::block::Triple;
use super::constraint::{Ends, FIXED, Jacobian};
use super::contact::{Contact, FRICTION, approach, impulses, is_pressed_out};
use super::depth::Rub;
use super::island::{Effort, Goal, Island, Member, greater};
use crate::math::plane::Pose;
use crate::methods::IslandChoice;
use crate::precise::Precise;
use crate::precise::bodies::Bodies;
use crate::precise::joints::hold::Hold;
use crate::precise::joints::weight_of;
use crate::precise::parameters::direct::{
    BEARABLE_VELOCITY_ERROR, BUSY_ISLAND_PAUSE, CYCLIC_PENETRATION_PART, CYCLIC_PENETRATION_SPEED,
    CYCLIC_VELOCITY_ERROR, DEPTH_NEWTON_LIMIT, EXACT_VELOCITY_ERROR, LATERAL_STICTION_SPEED,
    MOVING_VELOCITY_ERROR, NEWTON_AVERAGE_UPDATES, NEWTON_LIMIT, NEWTON_LIMIT_PER_BODY, PENETRATION_FLOOR,
    PENETRATION_FLOOR_PER_COORDINATE, RESTING_VELOCITY_ERROR, SOLVED_VELOCITY_ERROR,
};
use crate::precise::rows::{Aside, Home, PointLane, Rows};
use crate::precise::tuning::Step;
use crate::storage::reusing_clone::reusing_clone;

/// An island, and where its contacts' rows are.
#[derive(Debug, Default)]
pub(super) struct Whole {
    pub(super) island: Island,
    pub(super) homes: Vec<Home>,
    pub(super) ends: Vec<Ends>,
    pub(super) ways: Vec<Triple>,
    /// How far points were apart before the last look.
    pub(super) separations: Vec<[f32; 2]>,
    /// The island still [has](Island::obey_pushes) what its rows do to members: no row has changed since that was asked, and the
    /// island has not been solved, which takes the place where it is.
    pub(super) has_pushes: bool,
    /// Steps of Newton's method in the last update.
    pub(super) steps: usize,
    /// It could not be solved, and goes to the iterative solver. Contact cycles with a budget stay: each such update costs them more.
    pub(super) is_left: bool,
    /// It was solved as a free articulation in parts of the step.
    pub(super) has_swung: bool,
    /// With joints: its members, if it stood still in the last update.
    pub(super) stood: Vec<Standing>,
    /// Its joints, by their places in the list of joints, and their bodies.
    pub(super) joints: Vec<u32>,
    pub(super) joint_ends: Vec<Ends>,
    /// Its springs that are rows, by their places among these, and their bodies.
    pub(super) springs: Vec<u32>,
    pub(super) spring_ends: Vec<Ends>,
    /// Of a step in parts: its joints where they are now, their impulses of the step so far (on the second body, along x and y, and
    /// turning), and displacements of the members so far.
    pub(super) holds: Vec<Hold>,
    pub(super) totals: Vec<Triple>,
    pub(super) path: Vec<Triple>,
}

reusing_clone! {
    Whole {
        island, homes, ends, ways, separations, has_pushes, steps, is_left, has_swung, stood, joints, joint_ends, springs,
        spring_ends, holds, totals, path
    }
}

/// A member that stands still: pose, change of velocity by forces in a substep, inverse mass and inertia.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Standing {
    pose: Pose,
    push: [f32; 4],
    inverses: [f32; 2],
}

impl Standing {
    pub(super) fn of(bodies: &Bodies, number: usize) -> Self {
        Standing { pose: bodies.poses[number], push: bodies.push[number], inverses: bodies.inverses[number] }
    }
}

/// What rows are read with.
pub(super) struct Reading<'a> {
    pub(super) bodies: &'a Bodies,
    pub(super) step: &'a Step,
    /// Seconds of the step, its reciprocal, and its substeps.
    pub(super) dt: f64,
    pub(super) rate: f64,
    pub(super) parts: f64,
    /// The overlap that is left, and the error of a velocity that is.
    pub(super) left: f64,
    pub(super) quiet: f64,
}

impl Reading<'_> {
    /// In how many parts of a step the impulses of a row are told.
    #[inline(always)]
    fn parts_of(&self, row: &Aside) -> f64 {
        if row.h == self.step.h { self.parts } else { self.other_parts(row.h) }
    }

    /// The step has changed; this hardly ever is.
    #[cold]
    fn other_parts(&self, h: f32) -> f64 {
        f64::from(self.step.dt / h)
    }

    #[inline(always)]
    fn contact(&self, row: &Aside, ends: Ends) -> Contact {
        let mut contact = Contact::new(row, self.parts_of(row), ends);
        if let Some([x, y, spin, _]) = self.carried(row, ends) {
            contact.carry([x, y, spin]);
        }
        contact
    }

    /// What it does along the depth axis.
    fn rub(&self, row: &Aside, ends: Ends) -> Rub {
        let mut rub = Rub::new(&row.lane, self.parts_of(row));
        if let Some(velocity) = self.carried(row, ends) {
            rub.carry(velocity, f64::from(row.lane.space.across_arms[0]));
        }
        rub
    }

    /// Velocity of what is moved by the game, which is always the first one.
    #[inline(always)]
    fn carried(&self, row: &Aside, ends: Ends) -> Option<[f64; 4]> {
        is_moved(row, ends).then(|| self.bodies.hot[row.lane.a as usize].velocity.map(f64::from))
    }

    /// As [`look`](Self::look), without making a contact of a row: how far it is from what it is to be is told as more than it is
    /// where a point is about to part or to slide. `None` if it is to be looked at.
    #[inline(always)]
    fn glance(&self, row: &mut Aside, ends: Ends, members: &[Member]) -> Option<[f64; 2]> {
        if row.h != self.step.h || is_moved(row, ends) {
            return None;
        }
        let [a, b] = ends.bodies.map(|at| if at == FIXED { [0.0; 3] } else { members[at as usize].velocity });
        let [one, two, along] = Jacobian::of(&row.lane).relative(a, b);
        let lane = &mut row.lane;
        let (mut off, mut deepest) = ((along - f64::from(lane.tangent_speed)).abs(), 0.0);
        let mut separations = [0.0; 2];
        for (at, velocity) in [one, two].into_iter().enumerate() {
            let PointLane { separation, mass, impulse, .. } = lane.points[at];
            let (separation, is_there, presses) = (f64::from(separation), mass > 0.0, impulse > 0.0);
            let excess = velocity + approach(separation, self.left, self.rate);
            let is_off = is_there & (presses | (excess < 0.0));
            off = greater(if is_off { excess.abs() } else { 0.0 }, off);
            separations[at] = separation + self.dt * velocity;
            let is_deep = is_there & is_pressed_out(presses, separations[at], self.left);
            deepest = greater(if is_deep { -separations[at] } else { 0.0 }, deepest);
        }
        let most = lane.friction * (lane.points[0].impulse + lane.points[1].impulse);
        if !(off <= self.quiet && lane.tangent_impulse.abs() <= most) {
            return None;
        }
        for (point, separation) in lane.points.iter_mut().zip(separations) {
            (point.held, point.separation) = (point.impulse, finite(separation) as f32);
        }
        Some([off, deepest])
    }

    /// How far a row is from what it is to be, and how deep points are in what they are in, if that is to change. Separations are
    /// those after the step.
    #[inline(never)]
    fn look(&self, row: &mut Aside, ends: Ends, members: &[Member]) -> [f64; 2] {
        let mut contact = self.contact(row, ends);
        contact.meet(members, self.rate, self.left);
        let residual = contact.residual();
        let deepest = contact.advance(members, self.dt, self.left);
        for (point, separation) in row.lane.points.iter_mut().zip(contact.separations) {
            point.separation = finite(separation) as f32;
        }
        [residual, deepest]
    }
}

/// Whether the first one is moved by the game.
#[inline(always)]
fn is_moved(row: &Aside, ends: Ends) -> bool {
    ends.bodies[0] == FIXED && row.lane.a != 0
}

impl Whole {
    /// Whether it has joints or springs.
    pub(super) fn is_joined(&self) -> bool {
        self.joint_count() > 0
    }

    /// How many joints and springs it has.
    pub(super) fn joint_count(&self) -> usize {
        self.joints.len() + self.springs.len()
    }

    /// Members move as they will without impulses. Answers the overlap that is left as it is, in length units.
    pub(super) fn take_bodies(&mut self, bodies: &Bodies, parts: f64, unit: f64) -> f64 {
        let mut far = 0.0;
        for member in &mut self.island.members {
            let at = member.number as usize;
            let [x, y, ..] = bodies.poses[at];
            far = [x, y].iter().fold(far, |far: f32, x| if x.abs() > far { x.abs() } else { far });
            let [x, y, spin, depth] = free(bodies, at, parts);
            (member.velocity, member.depth) = ([x, y, spin], depth);
            member.change = [0.0; 3];
            [member.mass, member.inertia] = bodies.inverses[at].map(weight_of);
        }
        let far = PENETRATION_FLOOR_PER_COORDINATE * f64::from(far);
        if far > PENETRATION_FLOOR * unit { far } else { PENETRATION_FLOOR * unit }
    }

    /// Impulses so far act in the plane.
    fn press(&mut self, rows: &Rows, reading: &Reading<'_>) {
        let Whole { island, homes, ends, has_pushes, .. } = self;
        if !std::mem::replace(has_pushes, true) {
            island.begin_pushes();
            for (&home, &ends) in homes.iter().zip(ends.iter()) {
                let row = rows.direct(home);
                island.push(&Jacobian::of(&row.lane), ends, impulses(row, reading.parts_of(row)));
            }
        }
        island.obey_pushes();
    }

    /// How far rows are from what they are to be, and how deep points are in what they are in, if that is to change. Rows say how far
    /// points are apart after the step if nothing is.
    fn look(&mut self, rows: &mut Rows, reading: &Reading<'_>) -> [f64; 2] {
        let Whole { island, homes, ends, separations, has_pushes, .. } = self;
        let (mut residual, mut deepest) = (0.0, 0.0);
        separations.clear();
        for (&home, &ends) in homes.iter().zip(ends.iter()) {
            let row = rows.direct_mut(home);
            separations.push(row.lane.points.each_ref().map(|point| point.separation));
            let [off, deep] = reading.glance(row, ends, &island.members).unwrap_or_else(|| {
                *has_pushes = false;
                reading.look(row, ends, &island.members)
            });
            residual = greater(off, residual);
            deepest = greater(deep, deepest);
        }
        [residual, deepest]
    }

    /// Nothing is to change: rows that were looked at closely are of the substeps of this step now, as all others are.
    pub(super) fn keep(&self, rows: &mut Rows, step: &Step, parts: f64) {
        if self.has_pushes {
            return;
        }
        for &home in &self.homes {
            let row = rows.direct_mut(home);
            let scale = if row.h == step.h { 1.0 } else { f64::from(step.h / row.h) };
            let separations = row.lane.points.each_ref().map(|point| f64::from(point.separation));
            write(row, row.impulses().map(|impulse| impulse * scale), separations, parts, step.h);
        }
    }

    /// Something is to change: points are as far apart as they were before the look.
    fn unlook(&self, rows: &mut Rows) {
        for (&home, separations) in self.homes.iter().zip(&self.separations) {
            let points = &mut rows.direct_mut(home).lane.points;
            points.iter_mut().zip(separations).for_each(|(point, &separation)| point.separation = separation);
        }
    }

    /// Makes contacts of the rows, and of what they do along the depth axis, if there is one.
    pub(super) fn make_contacts(&mut self, rows: &Rows, reading: &Reading<'_>, has_depth: bool) {
        let Whole { island, homes, ends, has_pushes, .. } = self;
        *has_pushes = false;
        island.contacts.clear();
        island.joints.clear();
        island.rubs.clear();
        for (&home, &ends) in homes.iter().zip(ends.iter()) {
            let row = rows.direct(home);
            island.contacts.push(reading.contact(row, ends));
            island.rubs.extend(has_depth.then(|| reading.rub(row, ends)));
        }
    }

    /// Contacts alone, in the plane: whether a budget decides how long it is solved as a whole. Without contact cycles, and where bodies may
    /// jam, the number of Newton steps decides.
    fn has_cyclic_budget(&self, has_depth: bool) -> bool {
        !has_depth && self.homes.len() > self.island.members.len() && !self.island.may_jam(&self.ends)
    }

    /// Rows take over what was found.
    pub(super) fn write(&self, rows: &mut Rows, parts: f64, h: f32) {
        for (contact, &home) in self.island.contacts.iter().zip(&self.homes) {
            let impulses = contact.impulses.map(|impulse| impulse / parts);
            write(rows.direct_mut(home), impulses, contact.separations, parts, h);
        }
        for (rub, &home) in self.island.rubs.iter().zip(&self.homes) {
            rub.write(&mut rows.direct_mut(home).lane.space, parts);
        }
    }

    /// Ways are those of velocities, with those that take points out of each other.
    pub(super) fn find_ways(&mut self, dt: f64, has_more: bool) {
        let Whole { island, ways, .. } = self;
        ways.clear();
        ways.extend(island.members.iter().enumerate().map(|(at, member)| {
            let way = member.velocity.map(|velocity| velocity * dt);
            if has_more { std::array::from_fn(|i| way[i] + island.ways()[at][i]) } else { way }
        }));
    }
}

impl Precise {
    /// Solves the islands that are solved as a whole. What they do is written by [`finish_direct`](Self::finish_direct); those
    /// that could not be solved are left to the passes.
    pub(in crate::precise) fn solve_direct(&mut self, step: &Step) {
        let unit = f64::from(self.tuning.unit);
        let seconds = [step.dt, step.h];
        let has_changed =
            self.rows.take_change() | (std::mem::replace(&mut self.direct.seconds, seconds) != seconds);
        for at in 0..self.direct.count {
            let mut whole = std::mem::take(&mut self.direct.islands[at]);
            whole.has_pushes &= !has_changed;
            let effort = self.solve_whole(&mut whole, step, unit);
            self.note_effort(&whole, effort);
            whole.steps = effort.steps;
            self.direct.islands[at] = whole;
        }
        self.leave_unsolved(&step.learning);
    }

    /// Answers how many steps of Newton's method it has taken.
    fn solve_whole(&mut self, whole: &mut Whole, step: &Step, unit: f64) -> Effort {
        whole.has_swung = false;
        if whole.is_joined() {
            let steps = match whole.swings(&self.joints) {
                true => match self.solve_swing(whole, step, unit) {
                    effort if effort.is_solved => return effort,
                    effort => effort.steps,
                },
                false => 0,
            };
            let effort = self.solve_joined(whole, step, unit);
            return Effort { steps: steps + effort.steps, ..effort };
        }
        let Precise { bodies, rows, .. } = self;
        let (dt, parts, has_depth) = (f64::from(step.dt), f64::from(step.substeps), self.space.is_some());
        let left = whole.take_bodies(bodies, parts, unit);
        let Wear { is_hot, is_loose, .. } = self.direct.wear[whole.island.members[0].number as usize];
        let quiet = unit * if is_hot { MOVING_VELOCITY_ERROR } else { RESTING_VELOCITY_ERROR };
        whole.is_left = false;
        let reading = Reading { bodies, step, dt, rate: dt.recip(), parts, left, quiet };
        whole.press(rows, &reading);
        if !has_depth {
            let [residual, deepest] = whole.look(rows, &reading);
            if residual <= quiet && deepest <= left {
                whole.keep(rows, step, parts);
                whole.find_ways(dt, false);
                return Effort { steps: 0, residual, is_solved: true };
            }
            whole.unlook(rows);
        }
        whole.make_contacts(rows, &reading, has_depth);
        let residual = whole.island.begin(dt, [left, LATERAL_STICTION_SPEED * unit]);
        let effort = if residual > quiet {
            whole.island.solve(&Goal {
                begun: residual,
                bearable: if residual > unit * BEARABLE_VELOCITY_ERROR {
                    residual
                } else {
                    unit * BEARABLE_VELOCITY_ERROR
                },
                enough: unit * SOLVED_VELOCITY_ERROR,
                exact: unit * EXACT_VELOCITY_ERROR,
                still: unit * RESTING_VELOCITY_ERROR,
                near: unit * CYCLIC_VELOCITY_ERROR,
                most_steps: 0,
            })
        } else {
            Effort { steps: 0, residual, is_solved: true }
        };
        let has_budget = whole.has_cyclic_budget(has_depth);
        whole.is_left = self.direct.timing.choice != IslandChoice::Whole && !effort.is_solved && !has_budget;
        if whole.is_left {
            whole.island.cool(|at| {
                let [x, y, spin, _] = free(bodies, at as usize, parts);
                [x, y, spin]
            });
        } else {
            let undone = if has_budget || (whole.island.has_rings() && !is_loose) {
                CYCLIC_PENETRATION_PART
            } else {
                1.0
            };
            let most = if has_budget { CYCLIC_PENETRATION_SPEED * unit } else { f64::from(self.tuning.push) };
            let has_more = whole.island.part(dt, [left, most * dt], undone);
            whole.island.rub_across(unit);
            whole.find_ways(dt, has_more);
        }
        whole.write(rows, parts, step.h);
        effort
    }

    /// An island that is busy for long, has no budget left, or is left unsolved, goes to the iterative solver for a while. What may jam is tried again
    /// at once: passes do worse than a solution every other update.
    fn note_effort(&mut self, whole: &Whole, Effort { steps, is_solved, .. }: Effort) {
        let has_depth = self.space.is_some();
        if whole.is_joined() || whole.has_cyclic_budget(has_depth) {
            return self.pay(whole, steps, is_solved);
        }
        let (island, contacts) = (&whole.island, whole.homes.len());
        let bodies = island.members.len();
        let mut wear = self.direct.wear[island.members[0].number as usize];
        wear.effort += (steps as f32 - wear.effort) / NEWTON_AVERAGE_UPDATES;
        wear.is_hot = steps > 0;
        let has_rings = usize::from(contacts > bodies);
        let by_size = NEWTON_LIMIT[has_rings] + NEWTON_LIMIT_PER_BODY[has_rings] * bodies as f32;
        let most = if has_depth { DEPTH_NEWTON_LIMIT } else { by_size };
        let timing = &mut self.direct.timing;
        if (wear.effort > most || !is_solved) && timing.choice != IslandChoice::Whole {
            let goes_on = wear.effort <= DEPTH_NEWTON_LIMIT && island.may_jam(&whole.ends);
            timing.is_due |= !(is_solved && goes_on);
            if !goes_on {
                (wear.effort, wear.rest) = (0.0, BUSY_ISLAND_PAUSE);
                timing.has_resting = true;
            }
        }
        for member in &island.members {
            self.direct.wear[member.number as usize] = wear;
        }
    }

    /// Bodies of islands that were solved as a whole move as was found.
    pub(in crate::precise) fn finish_direct(&mut self, step: &Step) {
        let Precise { direct, bodies, .. } = self;
        for Whole { island, ways, .. } in &direct.islands[..direct.count] {
            for (member, way) in island.members.iter().zip(ways) {
                // What is loaded has no negative zeros, as what cannot turn may get them here.
                let [x, y, spin] = member.velocity.map(|velocity| velocity as f32 + 0.0);
                let depth = member.depth as f32 + 0.0;
                bodies.hot[member.number as usize].velocity = [x, y, spin, depth];
                let [x, y, turned] = way.map(|way| way as f32);
                bodies.path[member.number as usize] = [x, y, turned, depth * step.dt];
            }
        }
    }
}

/// Velocity of a body with what forces do in so many substeps, without contacts.
#[inline(always)]
fn free(bodies: &Bodies, at: usize, parts: f64) -> [f64; 4] {
    let (velocity, push) = (bodies.hot[at].velocity, bodies.push[at]);
    std::array::from_fn(|axis| f64::from(velocity[axis]) + f64::from(push[axis]) * parts)
}

/// Nothing instead of what is not finite in a row.
#[inline(always)]
pub(super) fn finite(number: f64) -> f64 {
    if number.abs() <= f64::from(f32::MAX) { number } else { 0.0 }
}

/// A row takes over impulses of a substep. Its spring rests at what it carries, so that nothing sags if passes go on from here.
#[inline(never)]
fn write(row: &mut Aside, impulses: Triple, separations: [f64; 2], parts: f64, h: f32) {
    row.h = h;
    row.exact = impulses.map(finite);
    row.lane.tangent_impulse = row.exact[FRICTION] as f32;
    let totals = &mut row.lane.space.totals;
    totals.iter_mut().zip(impulses).for_each(|(total, impulse)| *total = finite(impulse * parts) as f32);
    for (at, point) in row.lane.points.iter_mut().enumerate() {
        point.impulse = row.exact[at] as f32;
        point.held = point.impulse;
        point.separation = finite(separations[at]) as f32;
    }
}
