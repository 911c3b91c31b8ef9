//! An island of bodies that touch, solved as a whole.
//!
//! The velocities v after a step are those of least 1/2 (v - v0) M (v - v0) under which nothing comes nearer than it may:
//! with impulses l on rows J, M (v - v0) = J' l, where points press or part and friction sticks or slides within its bound.
//! **Augmented Lagrangian**: rows are stiff springs, l = l0 - k J v, within their bounds; what springs yield is taken over
//! into l0 from round to round until nothing is left of it, so that the result is that of rigid rows. **Semismooth Newton**:
//! each round is a minimum of a function whose slope is piecewise linear; where the set of rows at their bounds does not
//! change, one step with H = M + sum k j j' over the others is exact. H has a block per body, and a block per two that touch:
//! on a column, an arch or a small pile its [factors](super::factor) cost little more than a pass over all rows. Friction's
//! bounds follow what presses from step to step of Newton's method.
//!
//! J. C. Simo and T. A. Laursen, "An augmented Lagrangian treatment of contact problems involving friction" (1992), for
//! springs with multipliers; P. Alart and A. Curnier, "A mixed formulation for frictional contact problems prone to Newton like
//! solution methods" (1991), for Newton's method on them; K. Erleben, "Rigid body contact problems using proximal operators"
//! (2017), for the same as proximal points.

use super::block::{Block, Triple};
use super::contact::{Arms, Contact, Ends, FIXED, FRICTION, Set};
use super::depth::Rub;
use super::factor::Factor;
use crate::storage::reusing_clone::reusing_clone;

/// Softness of springs, as part of what one row's own weight would make of it: at first, by how much less from round to
/// round while the set stays the same, and at least. Stiff ones yield less, and are harder to find the set with.
const SOFTNESS: f64 = 1e-3;
const STIFFER: f64 = 0.25;
const STIFFEST: f64 = 6e-5;
/// Softness at first where the set hardly changes: of what is still, with rings and without, and of what has none and is new. In
/// rings rows can press each other however hard, and stiff springs of a wrong set do; without rings they bear what comes and no
/// more. It is what a tall column yields to: its slow swaying weighs little beside a row's own weight.
const STIFF: f64 = 1e-5;
const RIGID: f64 = 1e-8;
/// A round of such springs that takes more steps than this, and leaves more than this part of what was off, has had a wrong set:
/// all begins again with softer ones.
const FEW: usize = 4;
const LESS: f64 = 0.5;
/// Most steps of Newton's method in a round, most rounds, one of them with stiff springs, and most steps of all.
const NEWTON: usize = 25;
const ROUNDS: usize = 7;
const MOST: usize = 100;
/// Most steps where there are rings and nothing has pressed yet: as many again find little more then, since the rest is found by the
/// updates after it, and no update is to take much longer than others.
const MOST_OF_FRESH: usize = 10;
/// Over all rows, where rounds find nothing.
const SWEEPS: usize = 8;
/// Halvings and secants on a line; it ends where this part of the first slope is left.
const LINE: usize = 20;
const LEVEL: f64 = 0.1;
/// How far friction's bounds follow what presses in a step of Newton's method, and from round to round: in rings what presses
/// may follow friction as much.
const FOLLOW: f64 = 0.5;

/// A body of the island.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Member {
    pub(super) number: u32,
    pub(super) mass: f64,
    pub(super) inertia: f64,
    pub(super) velocity: Triple,
    /// What this step has changed of it, beside the impulses that were there before.
    pub(super) change: Triple,
    /// The change that leaves the least error.
    pub(super) best: Triple,
    /// Velocity along the depth axis.
    pub(super) depth: f64,
}

impl Member {
    /// What an impulse does to the velocity.
    #[inline(always)]
    fn yields(&self, [x, y, turn]: Triple) -> Triple {
        [x / self.mass, y / self.mass, turn / self.inertia]
    }

    #[inline(always)]
    fn weighed(&self, [x, y, turn]: Triple) -> Triple {
        [self.mass * x, self.mass * y, self.inertia * turn]
    }
}

#[inline(always)]
fn dot(a: Triple, b: Triple) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
fn add(to: &mut Triple, part: Triple) {
    to.iter_mut().zip(part).for_each(|(to, part)| *to += part);
}

/// What solving an island has taken.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Effort {
    /// Steps of Newton's method.
    pub(super) steps: usize,
    /// Greatest velocity that is not as it is to be.
    pub(super) residual: f64,
    /// That is bearable, and no sweeps were needed.
    pub(super) is_solved: bool,
}

/// What a solution is to leave, as velocities.
#[derive(Debug, Clone, Copy)]
pub(super) struct Goal {
    /// What was off in the beginning.
    pub(super) begun: f64,
    /// At most: what leaves more is no solution.
    pub(super) bearable: f64,
    /// What is enough, and what is gone on to if that is easily had.
    pub(super) enough: f64,
    pub(super) exact: f64,
    /// What began with less than the first is still; of what has rings and is not, the second is enough.
    pub(super) still: f64,
    pub(super) near: f64,
}

/// Bodies that hang together by contacts.
#[derive(Debug, Default)]
pub(super) struct Island {
    pub(super) members: Vec<Member>,
    pub(super) contacts: Vec<Contact>,
    /// What contacts do along the depth axis; none if there is none.
    pub(super) rubs: Vec<Rub>,
    pub(super) factor: Factor,
    /// Whether the factors are those of what is active now.
    is_factored: bool,
    softness: f64,
    pub(super) gradient: Vec<Triple>,
    pub(super) direction: Vec<Triple>,
}

reusing_clone! { Island { members, contacts, rubs, factor, is_factored, softness, gradient, direction } }

impl Island {
    /// No impulses act so far.
    pub(super) fn begin_pushes(&mut self) {
        self.direction.clear();
        self.direction.resize(self.members.len(), [0.0; 3]);
    }

    /// Impulses of a contact act.
    #[inline(always)]
    pub(super) fn push(&mut self, arms: &Arms, ends: Ends, impulses: Triple) {
        add_push(arms, ends.bodies, impulses, &mut self.direction);
    }

    /// Members move by what acts.
    pub(super) fn obey_pushes(&mut self) {
        let Island { members, direction, .. } = self;
        for (member, &push) in members.iter_mut().zip(direction.iter()) {
            let change = member.yields(push);
            add(&mut member.velocity, change);
        }
    }

    /// Impulses so far act. Answers how far rows are from what they are to be. What slips along the depth axis slips faster
    /// than that.
    pub(super) fn begin(&mut self, dt: f64, [reach, slips]: [f64; 2]) -> f64 {
        (self.is_factored, self.softness) = (false, 0.0);
        let Island { members, contacts, .. } = self;
        contacts.iter_mut().for_each(|contact| contact.meet(members, dt.recip(), reach));
        self.begin_across(slips);
        self.residual()
    }

    /// Finds the impulses with which nothing is further from what it is to be than the goal says. The best of all rounds
    /// counts: near the end friction's bounds may go back and forth, and in rings they do so for long: there the first round
    /// that does not leave a quarter is the last one. Where what presses and what rubs raise each other (a wedge), no round may
    /// leave what is bearable: then sweeps do.
    pub(super) fn solve(&mut self, goal: &Goal) -> Effort {
        let mut effort = Effort { steps: 0, residual: f64::INFINITY, is_solved: false };
        let has_rings = self.has_rings();
        let (is_still, is_fresh) = (goal.begun < goal.still, self.is_fresh());
        let limit = if has_rings && is_fresh { MOST_OF_FRESH } else { MOST };
        self.stiffen(match has_rings {
            false if is_still || is_fresh => RIGID,
            true if is_still => STIFF,
            _ => SOFTNESS,
        });
        let mut is_first = true;
        for round in 0..ROUNDS {
            let is_stiff = self.softness < STIFFEST;
            let left = limit - effort.steps;
            let most = if is_stiff { FEW.min(left) } else { left };
            let (steps, is_found) = self.round(is_first, goal.exact, most);
            effort.steps += steps;
            let is_over = effort.steps >= limit;
            if is_stiff && !(is_found || is_over) && self.residual() >= LESS * goal.begun {
                self.begin_again();
                self.stiffen(SOFTNESS);
                is_first = true;
                continue;
            }
            is_first = false;
            if !has_rings {
                self.obey_impulses();
            }
            let goes_on = self.note_best(&mut effort);
            let is_near = has_rings && !is_still && effort.residual <= goal.near;
            let is_stuck = !goes_on && (effort.residual <= goal.enough || (has_rings && round > 0));
            if effort.residual <= goal.exact || is_near || is_stuck || is_over {
                break;
            }
            // In rings, bounds of friction are those of a guess in the first round: what was easily found there was not the set.
            if self.softness > STIFFEST && steps == 1 && !(has_rings && round == 0) {
                self.stiffen(STIFFER * self.softness);
            }
        }
        let is_solved = effort.residual <= goal.bearable;
        if is_solved {
            self.contacts.iter_mut().for_each(|contact| contact.impulses = contact.best);
        } else {
            self.sweep();
        }
        for member in &mut self.members {
            add(&mut member.velocity, member.best);
        }
        Effort { is_solved, ..effort }
    }

    /// Whether nothing has pressed yet.
    fn is_fresh(&self) -> bool {
        self.contacts.iter().all(|contact| contact.impulses == [0.0; 3])
    }

    /// Whether rows can press each other: what is fixed counts as one body, and two pieces of one body that touch another make
    /// a ring as well.
    pub(super) fn has_rings(&self) -> bool {
        let is_fixed = |contact: &Contact| contact.bodies.contains(&FIXED);
        self.contacts.len() + usize::from(!self.contacts.iter().any(is_fixed)) > self.members.len()
    }

    /// Changes are those that the impulses make, whatever was found of them: so momentum is kept by what stiff springs leave
    /// to roundings, and by what no round has solved.
    fn obey_impulses(&mut self) {
        let Island { members, contacts, direction, .. } = self;
        direction.fill([0.0; 3]);
        add_changes(contacts, direction);
        for (member, way) in members.iter_mut().zip(direction.iter_mut()) {
            let change = member.yields(*way);
            *way = std::array::from_fn(|axis| change[axis] - member.change[axis]);
            member.change = change;
        }
        for contact in contacts {
            let change = contact.relative_in(direction);
            add(&mut contact.excess, change);
        }
    }

    /// Keeps what a round has found, if it is the best so far. Answers whether that is less than a quarter of the best before.
    fn note_best(&mut self, effort: &mut Effort) -> bool {
        let residual = self.residual();
        let goes_on = residual < 0.25 * effort.residual;
        if residual < effort.residual || effort.residual == f64::INFINITY {
            effort.residual = residual;
            self.members.iter_mut().for_each(|member| member.best = member.change);
            self.contacts.iter_mut().for_each(|contact| contact.best = contact.impulses);
        }
        goes_on
    }

    /// Solves one row after the other, a few times, from what there was in the beginning: no more is added to energy than the
    /// impulses of before add.
    fn sweep(&mut self) {
        self.begin_again();
        let Island { members, contacts, .. } = self;
        members.iter_mut().for_each(|member| member.best = [0.0; 3]);
        for _ in 0..SWEEPS {
            for contact in contacts.iter_mut() {
                stop(contact, FRICTION, members);
                stop(contact, 0, members);
                stop(contact, 1, members);
            }
        }
    }

    /// All is as it was in the beginning, but for the best so far.
    fn begin_again(&mut self) {
        self.contacts.iter_mut().for_each(|contact| contact.impulses = contact.begun);
        self.obey_impulses();
    }

    fn stiffen(&mut self, softness: f64) {
        if self.softness == softness {
            return;
        }
        self.softness = softness;
        self.is_factored = false;
        for contact in &mut self.contacts {
            contact.stiffness = contact.masses.map(|mass| mass / softness);
        }
    }

    fn residual(&self) -> f64 {
        self.contacts.iter().fold(0.0, |worst, contact| greater(contact.residual(), worst))
    }

    /// The least of the springs' function, with the impulses now as those that springs begin with.
    /// Answers how many steps it took, and whether it was found.
    fn round(&mut self, is_first: bool, tolerance: f64, most: usize) -> (usize, bool) {
        let is_fresh = is_first && self.is_fresh();
        for contact in &mut self.contacts {
            contact.centre = contact.impulses;
            contact.bound = match is_first {
                true if is_fresh => contact.bound_of_fresh(),
                true => contact.first_bound(),
                false => contact.followed_bound(FOLLOW),
            };
            match is_first {
                true => (contact.impulses, contact.active) = contact.guess(is_fresh),
                false => contact.obey(),
            }
        }
        let mut is_guess = is_first;
        for step in 1..=NEWTON.min(most) {
            if self.newton(&mut is_guess, step < NEWTON, 0.1 * tolerance) {
                return (step, true);
            }
        }
        (NEWTON.min(most), false)
    }

    /// A step of Newton's method. Answers whether it is the last one.
    fn newton(&mut self, is_guess: &mut bool, follows: bool, least: f64) -> bool {
        if !self.is_factored || self.contacts.iter().any(|contact| contact.active != contact.factored) {
            self.factorise();
        }
        let slope = self.descend();
        let [by_change, by_direction] = self.weights();
        let (is_same, greatest, slope_there) = self.try_whole(by_change + by_direction);
        let mut part = 1.0;
        if !is_same {
            let mut slope = slope;
            if std::mem::take(is_guess) {
                // The slope of the guess is not that of the springs.
                slope = self.slope(0.0, by_change, by_direction).0;
                let descends = slope < 0.0;
                if !descends {
                    self.follow(-1.0);
                    return false;
                }
            }
            if slope_there > 0.25 * -slope {
                part = self.search([slope, slope_there], by_change, by_direction);
            }
            self.follow(part - 1.0);
        }
        *is_guess = false;
        for (member, direction) in self.members.iter_mut().zip(&self.direction) {
            add(&mut member.change, direction.map(|way| part * way));
        }
        let is_exact = is_same;
        if follows && !is_exact {
            for contact in &mut self.contacts {
                contact.bound = contact.followed_bound(FOLLOW);
                contact.obey();
            }
        }
        is_exact || part * greatest < least
    }

    /// Goes along the last direction by this part.
    #[inline(never)]
    fn follow(&mut self, part: f64) {
        for contact in &mut self.contacts {
            (0..3).for_each(|row| contact.excess[row] += part * contact.change[row]);
            contact.obey();
        }
    }

    /// Makes the factors of what is active.
    fn factorise(&mut self) {
        let Island { members, contacts, factor, .. } = self;
        if !self.is_factored {
            factor.begin(members.iter().map(|member| [member.mass, member.inertia]));
            contacts.iter_mut().for_each(|contact| contact.factored = 0);
        }
        for contact in contacts.iter_mut().filter(|contact| contact.active != contact.factored) {
            assemble(contact, factor);
            contact.factored = contact.active;
        }
        factor.factorise();
        self.is_factored = true;
    }

    /// The direction in which the function's least would be, were the set the same. Answers the slope along it.
    fn descend(&mut self) -> f64 {
        let Island { members, contacts, factor, gradient, direction, .. } = self;
        gradient.clear();
        gradient.extend(members.iter().map(|member| member.weighed(member.change).map(|momentum| -momentum)));
        add_changes(contacts, gradient);
        direction.clone_from(gradient);
        factor.solve(direction);
        -gradient.iter().zip(direction.iter()).map(|(&g, &way)| dot(g, way)).sum::<f64>()
    }

    /// The products of the direction with the change so far and with itself, by masses.
    fn weights(&self) -> [f64; 2] {
        let mut sums = [0.0; 2];
        for (member, &way) in self.members.iter().zip(&self.direction) {
            let weighed = member.weighed(way);
            sums[0] += dot(weighed, member.change);
            sums[1] += dot(weighed, way);
        }
        sums
    }

    /// Goes the whole way. Answers whether the set stays the same, the greatest change of a row, and the slope there.
    fn try_whole(&mut self, weight: f64) -> (bool, f64, f64) {
        let (mut is_same, mut greatest, mut slope) = (true, 0.0, weight);
        let Island { contacts, direction, .. } = self;
        for contact in contacts {
            contact.change = contact.relative_in(direction);
            (0..3).for_each(|row| contact.excess[row] += contact.change[row]);
            let (impulses, active) = contact.law(contact.excess);
            // What slides may slide the other way there.
            let slides_on = active >> FRICTION & 1 == 1 || impulses[FRICTION] == contact.impulses[FRICTION];
            is_same &= active == contact.active && slides_on;
            contact.impulses = impulses;
            greatest = contact.change.iter().fold(greatest, |most, change| greater(change.abs(), most));
            slope -=
                (0..3).map(|row| contact.change[row] * (impulses[row] - contact.begun[row])).sum::<f64>();
        }
        (is_same, greatest, slope)
    }

    /// Slope and curvature at a part of the way, from its end on.
    fn slope(&self, part: f64, by_change: f64, by_direction: f64) -> (f64, f64) {
        let (mut slope, mut curvature) = (by_change + part * by_direction, by_direction);
        for contact in &self.contacts {
            let excess = std::array::from_fn(|row| contact.excess[row] + (part - 1.0) * contact.change[row]);
            let (impulses, active) = contact.law(excess);
            for (row, change) in contact.change.into_iter().enumerate() {
                slope -= change * (impulses[row] - contact.begun[row]);
                let stiffness = if active >> row & 1 == 1 { contact.stiffness[row] } else { 0.0 };
                curvature += stiffness * change * change;
            }
        }
        (slope, curvature)
    }

    /// The part of the way at which the slope ends, which is below zero in the beginning and above in the end.
    fn search(&self, [first, last]: [f64; 2], by_change: f64, by_direction: f64) -> f64 {
        let (mut low, mut high, mut part) = (0.0, 1.0, first / (first - last));
        for _ in 0..LINE {
            let (slope, curvature) = self.slope(part, by_change, by_direction);
            if slope.abs() < LEVEL * -first {
                break;
            }
            if slope < 0.0 {
                low = part
            } else {
                high = part
            }
            part -= slope / curvature;
            if !(part > low && part < high) {
                part = 0.5 * (low + high);
            }
        }
        part
    }

    /// Ways that take points out of each other by this part of how deep they are, loaded ones that are deeper than `reach` and
    /// others that are far deeper, by no more than that part of `most`; no way if none is. Separations are those after `dt` of
    /// the velocities, and then of the ways too.
    pub(super) fn part(&mut self, dt: f64, [reach, most]: [f64; 2], undone: f64) -> bool {
        let Island { members, contacts, .. } = self;
        let deepest = contacts
            .iter_mut()
            .fold(0.0, |deepest, contact| greater(contact.advance(members, dt, reach), deepest));
        let is_deep = deepest > reach;
        if is_deep {
            self.stiffen(SOFTNESS);
            self.press_out([reach, most], undone);
        }
        is_deep
    }

    fn press_out(&mut self, [reach, most]: [f64; 2], undone: f64) {
        for contact in &mut self.contacts {
            let deep = [0, 1].map(|row| contact.is_pressed_out(row, reach));
            contact.active = u8::from(deep[0]) | u8::from(deep[1]) << 1;
            let sticks = contact.active != 0 && contact.impulses[FRICTION].abs() < contact.bound;
            contact.active |= u8::from(sticks) << FRICTION;
        }
        if !self.is_factored || self.contacts.iter().any(|contact| contact.active != contact.factored) {
            self.factorise();
        }
        self.direction.fill([0.0; 3]);
        for contact in &self.contacts {
            let mut impulses = [0.0; 3];
            for row in (0..2).filter(|&row| contact.active >> row & 1 == 1) {
                let depth = -contact.separations[row];
                impulses[row] =
                    undone * contact.stiffness[row] * if depth < most { depth.max(0.0) } else { most };
            }
            add_push(&contact.arms, contact.bodies, impulses, &mut self.direction);
        }
        self.factor.solve(&mut self.direction);
        self.slow_down(most);
        for contact in &mut self.contacts {
            let way = contact.relative_in(&self.direction);
            (0..2)
                .filter(|&row| contact.rows >> row & 1 == 1)
                .for_each(|row| contact.separations[row] += way[row]);
        }
    }

    /// In a column the ways of all contacts add up: nothing goes further in an update than two contacts may push it, each by
    /// `most`.
    fn slow_down(&mut self, most: f64) {
        let square = |&[x, y, _]: &Triple| x * x + y * y;
        let (furthest, most) = (self.direction.iter().map(square).fold(0.0, greater).sqrt(), 2.0 * most);
        if furthest > most {
            let part = most / furthest;
            self.direction.iter_mut().flatten().for_each(|way| *way *= part);
        }
    }

    /// The way of each member beside that of its velocity, after [`part`](Self::part) has found one.
    pub(super) fn ways(&self) -> &[Triple] {
        &self.direction
    }
}

/// Adds what the impulses of a contact do to members.
#[inline(always)]
fn add_push(arms: &Arms, bodies: [u32; 2], impulses: Triple, pushes: &mut [Triple]) {
    for (member, push) in bodies.into_iter().zip(arms.push(impulses)) {
        if member != FIXED {
            add(&mut pushes[member as usize], push);
        }
    }
}

/// Adds what impulses have changed for members since the step began.
#[inline(never)]
fn add_changes(contacts: &[Contact], pushes: &mut [Triple]) {
    for contact in contacts {
        let impulses = std::array::from_fn(|row| contact.impulses[row] - contact.begun[row]);
        add_push(&contact.arms, contact.bodies, impulses, pushes);
    }
}

/// Stops a row by itself, within its bounds.
#[inline(never)]
fn stop(contact: &mut Contact, row: usize, members: &mut [Member]) {
    if contact.masses[row] <= 0.0 {
        return;
    }
    let change = contact.relative_of(|member| members[member].best);
    let impulse = contact.stopped(row, contact.excess[row] + change[row]);
    for (&member, push) in contact.bodies.iter().zip(contact.arms.push(impulse)) {
        if member != FIXED {
            let member = &mut members[member as usize];
            let change = member.yields(push);
            add(&mut member.best, change);
        }
    }
}

/// The greater one; the first one if it is not a number.
#[inline(always)]
pub(super) fn greater(one: f64, other: f64) -> f64 {
    if one <= other { other } else { one }
}

/// Adds k j j' of the rows of a contact that have become active, and takes away that of those that no longer are: with n the
/// normal and t the tangent, of two bodies the same in x and y.
fn assemble(contact: &Contact, factor: &mut Factor) {
    let is_in = |set: Set, row: usize| f64::from(set >> row & 1);
    let stiffness: Triple = std::array::from_fn(|row| {
        (is_in(contact.active, row) - is_in(contact.factored, row)) * contact.stiffness[row]
    });
    let ([nx, ny], along, across) = (contact.arms.normal, stiffness[0] + stiffness[1], stiffness[2]);
    let xx = along * nx * nx + across * ny * ny;
    let xy = (along - across) * nx * ny;
    let yy = along * ny * ny + across * nx * nx;
    // What turning of one does to a push along x and y.
    let turned = |arms: &Triple| {
        let along = stiffness[0] * arms[0] + stiffness[1] * arms[1];
        let across = stiffness[2] * arms[2];
        [along * nx + across * ny, along * ny - across * nx]
    };
    let both =
        |one: &Triple, other: &Triple| (0..3).map(|row| stiffness[row] * one[row] * other[row]).sum::<f64>();
    let Arms { a: arms_a, b: arms_b, .. } = &contact.arms;
    let ([ax, ay], [bx, by]) = (turned(arms_a), turned(arms_b));
    let [a, b] = contact.bodies;
    if a != FIXED {
        factor.add(a, &Block::of_rows([[xx, xy, ax], [xy, yy, ay], [ax, ay, both(arms_a, arms_a)]]));
    }
    if b != FIXED {
        factor.add(b, &Block::of_rows([[xx, xy, bx], [xy, yy, by], [bx, by, both(arms_b, arms_b)]]));
    }
    if let Some(entry) = contact.entry {
        let rows = [[-xx, -xy, -ax], [-xy, -yy, -ay], [-bx, -by, -both(arms_a, arms_b)]];
        factor.add_between(entry, &Block::of_rows(rows));
    }
}
