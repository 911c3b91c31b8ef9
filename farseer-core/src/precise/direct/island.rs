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

use super::block::Triple;
use super::constraint::{Constraint, Ends, FIXED, Jacobian};
use super::constraint_list::{add_changes, add_push, add_velocities, follow, slope, try_whole};
use super::contact::{Contact, FRICTION};
use super::depth::Rub;
use super::factor::Factor;
use super::joint::JointRows;
use crate::precise::joints::IMMOVABLE;
use crate::precise::parameters::direct::{
    ACYCLIC_COMPLIANCE, COMPLIANCE_FACTOR, FIRST_COMPLIANCE, FRESH_SOLUTION_NEWTON_STEPS,
    FRICTION_LIMIT_CONVERGED, FRICTION_LIMIT_RELAXATION, FRICTION_LIMIT_ROUNDS, FRICTION_RESIDUAL_WEIGHT,
    ISLAND_SWEEPS, JOINT_ROW_COMPLIANCE, LEAST_COMPLIANCE, LINE_SEARCH_SLOPE, LINE_SEARCH_STEPS,
    RESTING_COMPLIANCE, ROUND_NEWTON_STEPS, SOLUTION_NEWTON_STEPS, SOLUTION_ROUNDS, STABLE_STIFFNESS,
    STIFF_ROUND_RESIDUAL, STIFF_ROUND_STEPS,
};
use crate::storage::reusing_clone::reusing_clone;

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
    pub(super) fn yields(&self, [x, y, turn]: Triple) -> Triple {
        [x / self.mass, y / self.mass, turn / self.inertia]
    }

    /// Inertia is added, of which a part turns as the member does, and the rest begins at rest: the angular momentum stays.
    pub(super) fn add_inertia(&mut self, more: f64, turning: f64) {
        self.velocity[2] *= (self.inertia + turning) / (self.inertia + more);
        self.inertia += more;
    }

    /// Geometric stiffness that the inertia bears in a step of an explicit force, with arms up to this square of a length.
    pub(super) fn borne_stiffness(&self, reach: f64) -> f64 {
        STABLE_STIFFNESS * (self.inertia + self.mass * reach)
    }

    /// Inverse mass and inertia; 0 of what cannot be moved or turned.
    pub(super) fn inverses(&self) -> [f64; 2] {
        [self.mass, self.inertia].map(|weight| if weight < IMMOVABLE { weight.recip() } else { 0.0 })
    }

    #[inline(always)]
    pub(super) fn weighed(&self, [x, y, turn]: Triple) -> Triple {
        [self.mass * x, self.mass * y, self.inertia * turn]
    }
}

#[inline(always)]
pub(super) fn dot(a: Triple, b: Triple) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
pub(super) fn add(to: &mut Triple, part: Triple) {
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
    /// With joints: most Newton steps.
    pub(super) most_steps: usize,
}

/// Bodies that hang together by contacts.
#[derive(Debug, Default)]
pub(super) struct Island {
    pub(super) members: Vec<Member>,
    pub(super) contacts: Vec<Contact>,
    pub(super) joints: Vec<JointRows>,
    /// What contacts do along the depth axis; none if there is none.
    pub(super) rubs: Vec<Rub>,
    pub(super) factor: Factor,
    /// Whether the factors are those of what is active now.
    is_factored: bool,
    softness: f64,
    pub(super) gradient: Vec<Triple>,
    pub(super) direction: Vec<Triple>,
}

reusing_clone! { Island { members, contacts, joints, rubs, factor, is_factored, softness, gradient, direction } }

impl Island {
    /// No impulses act so far.
    pub(super) fn begin_pushes(&mut self) {
        self.direction.clear();
        self.direction.resize(self.members.len(), [0.0; 3]);
    }

    /// Impulses of a contact act.
    #[inline(always)]
    pub(super) fn push(&mut self, jacobian: &Jacobian, ends: Ends, impulses: Triple) {
        add_push(jacobian, ends.bodies, impulses, &mut self.direction);
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
        let Island { members, contacts, joints, .. } = self;
        contacts.iter_mut().for_each(|contact| contact.meet(members, dt.recip(), reach));
        joints.iter_mut().for_each(|joint| joint.meet(members));
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
        let limit = match self.has_joints() {
            true => goal.most_steps,
            false if has_rings && is_fresh => FRESH_SOLUTION_NEWTON_STEPS,
            false => SOLUTION_NEWTON_STEPS,
        };
        self.stiffen(match has_rings {
            false if is_still || is_fresh => ACYCLIC_COMPLIANCE,
            true if is_still => RESTING_COMPLIANCE,
            _ => FIRST_COMPLIANCE,
        });
        let mut is_first = true;
        for round in 0..SOLUTION_ROUNDS {
            let is_stiff = self.softness < LEAST_COMPLIANCE;
            let left = limit - effort.steps;
            let most = if is_stiff { STIFF_ROUND_STEPS.min(left) } else { left };
            let (steps, is_found) = self.round(is_first, goal.exact, most);
            effort.steps += steps;
            let is_over = effort.steps >= limit;
            if is_stiff && !(is_found || is_over) && self.residual() >= STIFF_ROUND_RESIDUAL * goal.begun {
                self.begin_again();
                self.stiffen(FIRST_COMPLIANCE);
                is_first = true;
                continue;
            }
            is_first = false;
            if !has_rings {
                self.obey_impulses();
            }
            let goes_on = self.note_best(&mut effort);
            let is_near = has_rings && !is_still && effort.residual <= goal.near;
            let is_stuck = !goes_on
                && self.has_settled(is_found, round)
                && (effort.residual <= goal.enough || (has_rings && round > 0));
            if effort.residual <= goal.exact || is_near || is_stuck || is_over {
                break;
            }
            // In rings, bounds of friction are those of a guess in the first round: what was easily found there was not the set.
            if self.softness > LEAST_COMPLIANCE && steps == 1 && !(has_rings && round == 0) {
                self.stiffen(COMPLIANCE_FACTOR * self.softness);
            }
        }
        let is_solved = effort.residual <= goal.bearable;
        if is_solved {
            self.contacts.iter_mut().for_each(|contact| contact.impulses = contact.best);
            self.joints.iter_mut().for_each(|joint| joint.impulses = joint.best);
        } else {
            self.sweep();
        }
        for member in &mut self.members {
            add(&mut member.velocity, member.best);
        }
        Effort { is_solved, ..effort }
    }

    /// Whether no contact has pressed yet; without contacts an island is never fresh.
    fn is_fresh(&self) -> bool {
        !self.contacts.is_empty() && self.contacts.iter().all(|contact| contact.impulses == [0.0; 3])
    }

    pub(super) fn has_joints(&self) -> bool {
        !self.joints.is_empty()
    }

    /// Whether rounds that find little have found all: with joints, bounds of friction move long after the residual has become
    /// small, and the contacts that they let go are what an island falls by.
    fn has_settled(&self, is_found: bool, round: usize) -> bool {
        let is_bounded = |contact: &Contact| {
            (contact.bound - contact.bounded()).abs() <= FRICTION_LIMIT_CONVERGED * contact.bound
        };
        !self.has_joints()
            || round > FRICTION_LIMIT_ROUNDS
            || (is_found && self.contacts.iter().all(is_bounded))
    }

    /// Whether rows can press each other: what is fixed counts as one body, and two pieces of one body that touch another make
    /// a ring as well. Joints do not count: bilateral rows are in the active set from the first guess on, whatever they close.
    pub(super) fn has_rings(&self) -> bool {
        let is_fixed = |contact: &Contact| contact.bodies.contains(&FIXED);
        self.contacts.len() + usize::from(!self.contacts.iter().any(is_fixed)) > self.members.len()
    }

    /// Changes are those that the impulses make, whatever was found of them: so momentum is kept by what stiff springs leave
    /// to roundings, and by what no round has solved.
    fn obey_impulses(&mut self) {
        let Island { members, contacts, joints, direction, .. } = self;
        direction.fill([0.0; 3]);
        add_changes(contacts, direction);
        add_changes(joints, direction);
        for (member, way) in members.iter_mut().zip(direction.iter_mut()) {
            let change = member.yields(*way);
            *way = std::array::from_fn(|axis| change[axis] - member.change[axis]);
            member.change = change;
        }
        add_velocities(contacts, direction);
        add_velocities(joints, direction);
    }

    /// Keeps what a round has found, if it is the best so far. Answers whether that is less than a quarter of the best before.
    fn note_best(&mut self, effort: &mut Effort) -> bool {
        let residual = self.graded_residual();
        let goes_on = residual < 0.25 * effort.residual;
        if residual < effort.residual || effort.residual == f64::INFINITY {
            effort.residual = residual;
            self.members.iter_mut().for_each(|member| member.best = member.change);
            self.contacts.iter_mut().for_each(|contact| contact.best = contact.impulses);
            self.joints.iter_mut().for_each(|joint| joint.best = joint.impulses);
        }
        goes_on
    }

    /// Solves one row after the other, a few times, from what there was in the beginning: no more is added to energy than the
    /// impulses of before add.
    fn sweep(&mut self) {
        self.begin_again();
        let Island { members, contacts, joints, .. } = self;
        members.iter_mut().for_each(|member| member.best = [0.0; 3]);
        for _ in 0..ISLAND_SWEEPS {
            for joint in joints.iter_mut() {
                (0..3).for_each(|row| stop(joint, row, members));
            }
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
        self.joints.iter_mut().for_each(|joint| joint.impulses = joint.begun);
        self.obey_impulses();
    }

    fn stiffen(&mut self, softness: f64) {
        if self.softness == softness {
            return;
        }
        let [before, of_joints] =
            [self.softness, softness].map(|softness| softness.min(JOINT_ROW_COMPLIANCE));
        self.softness = softness;
        // Joints are this stiff at once: without contacts the factors are those of before.
        self.is_factored &= self.contacts.is_empty() && before == of_joints;
        for contact in &mut self.contacts {
            contact.stiffness = contact.masses.map(|mass| mass / softness);
        }
        self.joints.iter_mut().for_each(|joint| joint.stiffen(of_joints));
    }

    fn residual(&self) -> f64 {
        let worst = self.contacts.iter().fold(0.0, |worst, contact| greater(contact.residual(), worst));
        self.joints.iter().fold(worst, |worst, joint| greater(joint.residual(), worst))
    }

    /// The residual by which rounds are compared: with joints, friction counts a tenth, for its bounds follow the normal impulses and
    /// need not be met to be held.
    fn graded_residual(&self) -> f64 {
        if !self.has_joints() {
            return self.residual();
        }
        let graded = |contact: &Contact| {
            greater(contact.normal_residual(), FRICTION_RESIDUAL_WEIGHT * contact.residual())
        };
        let worst = self.contacts.iter().fold(0.0, |worst, contact| greater(graded(contact), worst));
        self.joints.iter().fold(worst, |worst, joint| greater(joint.residual(), worst))
    }

    /// The least of the springs' function, with the impulses now as those that springs begin with.
    /// Answers how many steps it took, and whether it was found.
    fn round(&mut self, is_first: bool, tolerance: f64, most: usize) -> (usize, bool) {
        let is_fresh = is_first && self.is_fresh();
        let follow = if self.has_joints() { 1.0 } else { FRICTION_LIMIT_RELAXATION };
        for joint in &mut self.joints {
            joint.take_multipliers();
            joint.obey();
        }
        for contact in &mut self.contacts {
            contact.centre = contact.impulses;
            contact.bound = match is_first {
                true if is_fresh => contact.bound_of_fresh(),
                true => contact.first_bound(),
                false => contact.followed_bound(follow),
            };
            match is_first {
                true => (contact.impulses, contact.active) = contact.guess(is_fresh),
                false => contact.obey(),
            }
        }
        let mut is_guess = is_first;
        for step in 1..=ROUND_NEWTON_STEPS.min(most) {
            if self.newton(&mut is_guess, step < ROUND_NEWTON_STEPS, 0.1 * tolerance) {
                return (step, true);
            }
        }
        (ROUND_NEWTON_STEPS.min(most), false)
    }

    /// A step of Newton's method. Answers whether it is the last one.
    fn newton(&mut self, is_guess: &mut bool, follows: bool, least: f64) -> bool {
        if !self.has_factors() {
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
                contact.bound = contact.followed_bound(FRICTION_LIMIT_RELAXATION);
                contact.obey();
            }
        }
        is_exact || part * greatest < least
    }

    /// Goes along the last direction by this part.
    #[inline(never)]
    fn follow(&mut self, part: f64) {
        follow(&mut self.contacts, part);
        follow(&mut self.joints, part);
    }

    /// Whether the factors are those of the active set.
    fn has_factors(&self) -> bool {
        self.is_factored
            && self.contacts.iter().all(|contact| contact.active == contact.factored)
            && self.joints.iter().all(|joint| joint.active == joint.factored)
    }

    /// Makes the factors of what is active.
    pub(super) fn factorise(&mut self) {
        let Island { members, contacts, joints, factor, .. } = self;
        if !self.is_factored {
            factor.begin(members.iter().map(|member| [member.mass, member.inertia]));
            contacts.iter_mut().for_each(|contact| contact.factored = 0);
            joints.iter_mut().for_each(|joint| joint.factored = 0);
        }
        let contacts = contacts.iter_mut().filter(|contact| contact.active != contact.factored);
        contacts.for_each(|contact| contact.assemble(factor));
        let joints = joints.iter_mut().filter(|joint| joint.active != joint.factored);
        joints.for_each(|joint| joint.assemble(factor));
        factor.factorise();
        self.is_factored = true;
    }

    /// The direction in which the function's least would be, were the set the same. Answers the slope along it.
    fn descend(&mut self) -> f64 {
        let Island { members, contacts, joints, factor, gradient, direction, .. } = self;
        gradient.clear();
        gradient.extend(members.iter().map(|member| member.weighed(member.change).map(|momentum| -momentum)));
        add_changes(contacts, gradient);
        add_changes(joints, gradient);
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
        let Island { contacts, joints, direction, .. } = self;
        let so_far = try_whole(contacts, direction, (true, 0.0, weight));
        try_whole(joints, direction, so_far)
    }

    /// Slope and curvature at a part of the way, from its end on.
    fn slope(&self, part: f64, by_change: f64, by_direction: f64) -> (f64, f64) {
        let so_far = (by_change + part * by_direction, by_direction);
        slope(&self.joints, part, slope(&self.contacts, part, so_far))
    }

    /// The part of the way at which the slope ends, which is below zero in the beginning and above in the end.
    fn search(&self, [first, last]: [f64; 2], by_change: f64, by_direction: f64) -> f64 {
        let (mut low, mut high, mut part) = (0.0, 1.0, first / (first - last));
        for _ in 0..LINE_SEARCH_STEPS {
            let (slope, curvature) = self.slope(part, by_change, by_direction);
            if slope.abs() < LINE_SEARCH_SLOPE * -first {
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
        let is_deep = self.advance_separations(dt, reach) > reach;
        if is_deep {
            self.correct_positions([reach, most, 0.0], undone, false);
        }
        is_deep
    }

    /// Position correction of all constraints at once, with the Jacobians now: [`ways`](Self::ways) is what it adds to the displacement of
    /// each member. Errors of joints are undone as a whole, overlaps beyond the first limit in length units by this part; either by the second
    /// one at most, overlaps by the third one at least.
    pub(super) fn correct_positions(&mut self, limits: [f64; 3], undone: f64, are_jacobians_new: bool) {
        self.is_factored &= !are_jacobians_new;
        self.stiffen(FIRST_COMPLIANCE);
        self.press_out(limits, undone);
    }

    /// Separations are those after `dt` seconds of the velocities. Answers the depth of the deepest point that is to be corrected,
    /// in length units.
    pub(super) fn advance_separations(&mut self, dt: f64, reach: f64) -> f64 {
        let Island { members, contacts, .. } = self;
        contacts
            .iter_mut()
            .fold(0.0, |deepest, contact| greater(contact.advance(members, dt, reach), deepest))
    }

    fn press_out(&mut self, [reach, most, least]: [f64; 3], undone: f64) {
        self.joints.iter_mut().for_each(JointRows::select_errors);
        for contact in &mut self.contacts {
            let deep = [0, 1].map(|row| contact.is_pressed_out(row, reach));
            contact.active = u8::from(deep[0]) | u8::from(deep[1]) << 1;
            let sticks = contact.active != 0 && contact.impulses[FRICTION].abs() < contact.bound;
            contact.active |= u8::from(sticks) << FRICTION;
        }
        if !self.has_factors() {
            self.factorise();
        }
        self.direction.fill([0.0; 3]);
        for contact in &self.contacts {
            let mut impulses = [0.0; 3];
            for row in (0..2).filter(|&row| contact.active >> row & 1 == 1) {
                let depth = (-contact.separations[row]).max(0.0);
                let way = least + undone * if depth < most { depth } else { most };
                impulses[row] = contact.stiffness[row] * if way < depth { way } else { depth };
            }
            add_push(&contact.jacobian, contact.bodies, impulses, &mut self.direction);
        }
        for joint in &self.joints {
            add_push(&joint.jacobian, joint.bodies, joint.correction(most), &mut self.direction);
        }
        self.factor.solve(&mut self.direction);
        if self.contacts.iter().any(|contact| contact.active != 0) {
            self.slow_down(most);
        }
        for contact in &mut self.contacts {
            let way = contact.relative_in(&self.direction);
            for (row, way) in way.into_iter().enumerate().take(2) {
                if contact.has(row) {
                    contact.separations[row] += way;
                }
            }
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

/// Stops a row by itself, within its bounds.
#[inline(never)]
fn stop<C: Constraint>(rows: &mut C, row: usize, members: &mut [Member]) {
    if rows.masses[row] <= 0.0 {
        return;
    }
    let change = rows.relative_of(|member| members[member].best);
    let excess = rows.excess[row] + change[row];
    let impulse = rows.stop(row, excess);
    for (&member, push) in rows.bodies.iter().zip(rows.jacobian.push(impulse)) {
        if member != FIXED {
            let member = &mut members[member as usize];
            let change = member.yields(push);
            add(&mut member.best, change);
        }
    }
}

/// The greater one; the one that is not a number, if there is one.
#[inline(always)]
pub(super) fn greater(one: f64, other: f64) -> f64 {
    if one <= other || other.is_nan() { other } else { one }
}
