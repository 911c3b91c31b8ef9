//! A contact as the direct solver sees it: rows of at most two points along the normal, and one of friction.

use crate::precise::parameters::direct::UNLOADED_POINT_DEPTH;
use std::ops::{Deref, DerefMut};

use super::block::Triple;
use super::constraint::{Constraint, ConstraintRows, Ends, Jacobian, Set};
use super::island::Member;
use crate::precise::rows::Aside;

/// The row of friction, after those of the points.
pub(super) const FRICTION: usize = 2;

/// A contact between two bodies of an island.
#[derive(Debug, Clone, Copy)]
pub(super) struct Contact {
    rows: ConstraintRows,
    pub(super) friction: f64,
    /// How great friction may be.
    pub(super) bound: f64,
    pub(super) separations: [f64; 2],
    /// Velocity of each row by what does not give way.
    pub(super) carried: Triple,
}

impl Deref for Contact {
    type Target = ConstraintRows;

    #[inline(always)]
    fn deref(&self) -> &ConstraintRows {
        &self.rows
    }
}

impl DerefMut for Contact {
    #[inline(always)]
    fn deref_mut(&mut self) -> &mut ConstraintRows {
        &mut self.rows
    }
}

impl Contact {
    /// Of a row whose impulses are of so many parts of a step, with velocities before impulses act.
    #[inline(always)]
    pub(super) fn new(row: &Aside, parts: f64, ends: Ends) -> Self {
        let lane = &row.lane;
        let [one, two] = &lane.points;
        let is_there = |at: usize| lane.points[at].mass > 0.0;
        let present = u8::from(is_there(0)) | u8::from(is_there(1)) << 1 | 1 << FRICTION;
        let mut rows = ConstraintRows::new(ends, Jacobian::of(lane), present, impulses(row, parts));
        rows.masses = [one.mass, two.mass, lane.tangent_mass].map(f64::from);
        rows.excess = [0.0, 0.0, -f64::from(lane.tangent_speed)];
        rows.supplied = rows.excess;
        Contact {
            rows,
            friction: f64::from(lane.friction),
            bound: 0.0,
            separations: [one.separation, two.separation].map(f64::from),
            carried: [0.0; 3],
        }
    }

    /// A moves by itself.
    #[inline(always)]
    pub(super) fn carry(&mut self, velocity: Triple) {
        self.carried = self.jacobian.relative(velocity, [0.0; 3]);
        (0..3).for_each(|row| self.excess[row] += self.carried[row]);
        self.supplied = self.excess;
    }

    /// Members move as they do now: they may come nearer by what points are apart, less `reach`, so many times in a unit of time.
    #[inline(never)]
    pub(super) fn meet(&mut self, members: &[Member], rate: f64, reach: f64) {
        let velocity = self.relative_of(|member| members[member].velocity);
        (0..3).for_each(|row| self.excess[row] += velocity[row]);
        for row in 0..2 {
            self.excess[row] += approach(self.separations[row], reach, rate);
        }
    }

    /// Separations are those after `dt` of velocities. Answers how deep the deepest point is that is to be taken out of what it
    /// is in, if that is deeper than `reach`.
    #[inline(never)]
    pub(super) fn advance(&mut self, members: &[Member], dt: f64, reach: f64) -> f64 {
        let velocity = self.relative_of(|member| members[member].velocity);
        let mut deepest = 0.0;
        for (row, velocity) in velocity.into_iter().enumerate().take(2) {
            self.separations[row] += dt * (velocity + self.carried[row]);
            if self.is_pressed_out(row, reach) && -self.separations[row] > deepest {
                deepest = -self.separations[row];
            }
        }
        deepest
    }

    /// Friction within its bound; what is no number stays none.
    pub(super) fn limited(&self, impulse: f64) -> f64 {
        within(self.bound, impulse)
    }

    /// How far the rows are from what they are to be, as velocities: those that press are to stand still, the others may not
    /// approach; friction stands still or is as great as it may be.
    #[inline(never)]
    pub(super) fn residual(&self) -> f64 {
        let mut worst = self.normal_residual();
        let mut note = |velocity: f64| worst = if velocity.abs() <= worst { worst } else { velocity.abs() };
        let (mass, impulse) = (self.masses[FRICTION], self.impulses[FRICTION]);
        if mass > 0.0 {
            let wanted = impulse - mass * self.excess[FRICTION];
            let limited = within(self.bounded(), wanted);
            note(if limited == wanted { self.excess[FRICTION] } else { (limited - impulse) / mass });
        }
        worst
    }

    /// The residual of the points alone, in length units per second.
    #[inline(always)]
    pub(super) fn normal_residual(&self) -> f64 {
        let mut worst = 0.0;
        let mut note = |velocity: f64| worst = if velocity.abs() <= worst { worst } else { velocity.abs() };
        for row in 0..2 {
            let (mass, impulse, excess) = (self.masses[row], self.impulses[row], self.excess[row]);
            if impulse > mass * excess {
                note(excess);
            } else if impulse > 0.0 {
                note(impulse / mass);
            }
        }
        worst
    }

    /// A first guess: what has pressed goes on to, whatever it takes, and what has stuck sticks. Where nothing has pressed yet
    /// all that is not apart presses, and sticks: from one that meets to the next, as the bodies come upon each other, the set
    /// would take a step for each body of a column.
    pub(super) fn guess(&self, is_fresh: bool) -> (Triple, Set) {
        let presses = |row: usize| if is_fresh { self.is_near(row) } else { self.centre[row] > 0.0 };
        let free: Triple =
            std::array::from_fn(|row| self.centre[row] - self.stiffness[row] * self.excess[row]);
        let (mut impulses, mut active) = ([0.0; 3], 0);
        for row in (0..2).filter(|&row| presses(row)) {
            impulses[row] = free[row];
            active |= 1 << row;
        }
        let sticks = self.bound > 0.0 && self.centre[FRICTION].abs() < self.bound;
        impulses[FRICTION] = if sticks { free[FRICTION] } else { self.limited(self.centre[FRICTION]) };
        (impulses, active | u8::from(sticks) << FRICTION)
    }

    /// Friction's bound in the guess where nothing has pressed yet: none.
    pub(super) fn bound_of_fresh(&self) -> f64 {
        let is_near = self.is_near(0) || self.is_near(1);
        if is_near && self.friction > 0.0 { f64::INFINITY } else { 0.0 }
    }

    /// Whether a point would touch.
    fn is_near(&self, row: usize) -> bool {
        self.has(row) && self.excess[row] <= 0.0
    }

    /// Friction's bound, gone this part of the way to that of what presses now; the whole way from none.
    pub(super) fn followed_bound(&self, part: f64) -> f64 {
        let bounded = self.bounded();
        if self.bound.is_finite() { self.bound + part * (bounded - self.bound) } else { bounded }
    }

    /// Friction's bound at first, of what presses, or of what begins to.
    pub(super) fn first_bound(&self) -> f64 {
        let meets = (0..2).map(|row| (-self.excess[row] * self.masses[row]).max(0.0)).sum::<f64>();
        let presses = self.impulses[0] + self.impulses[1];
        self.friction * if presses == 0.0 { meets } else { presses }
    }

    /// Whether a point is to be taken out of what it is in, if that is deeper than `reach`.
    #[inline(always)]
    pub(super) fn is_pressed_out(&self, row: usize, reach: f64) -> bool {
        self.has(row) && is_pressed_out(self.impulses[row] > 0.0, self.separations[row], reach)
    }

    /// Friction is bounded by what presses.
    #[inline(always)]
    pub(super) fn bounded(&self) -> f64 {
        self.friction * (self.impulses[0] + self.impulses[1])
    }
}

impl Constraint for Contact {
    #[inline(always)]
    fn law(&self, excess: Triple) -> (Triple, Set) {
        let [one, two, along]: Triple =
            std::array::from_fn(|row| self.centre[row] - self.stiffness[row] * excess[row]);
        let (first, second, sticks) = (one > 0.0, two > 0.0, along.abs() <= self.bound);
        let impulses = [
            if first { one } else { 0.0 },
            if second { two } else { 0.0 },
            if sticks { along } else { self.bound.copysign(along) },
        ];
        let is_bounded = sticks & (self.bound > 0.0);
        (impulses, u8::from(first) | u8::from(second) << 1 | u8::from(is_bounded) << FRICTION)
    }

    /// Sliding friction may change its direction.
    #[inline(always)]
    fn keeps_bounds(&self, impulses: Triple, active: Set) -> bool {
        active >> FRICTION & 1 == 1 || impulses[FRICTION] == self.impulses[FRICTION]
    }

    fn stop(&mut self, row: usize, excess: f64) -> Triple {
        let wanted = self.impulses[row] - self.masses[row] * excess;
        self.bound = self.bounded();
        let impulse = if row == FRICTION { self.limited(wanted) } else { wanted.max(0.0) };
        let mut change = [0.0; 3];
        change[row] = impulse - self.impulses[row];
        self.impulses[row] = impulse;
        change
    }
}

/// Impulses of the whole step, of a row whose impulses are of so many parts of it.
#[inline(always)]
pub(super) fn impulses(row: &Aside, parts: f64) -> Triple {
    let [one, two, along] = row.impulses().map(|impulse| impulse * parts);
    let of_point = |at: usize, impulse: f64| if row.lane.points[at].mass > 0.0 { impulse } else { 0.0 };
    [of_point(0, one), of_point(1, two), along]
}

/// How fast a point so far apart may come nearer: by what it is apart, less `reach`, so many times in a unit of time.
#[inline(always)]
pub(super) fn approach(separation: f64, reach: f64, rate: f64) -> f64 {
    let gap = separation - reach;
    if gap > 0.0 { gap * rate } else { 0.0 }
}

/// Whether a point is to be taken out of what it is in, if that is deeper than `reach`: one that presses, or is far deeper.
#[inline(always)]
pub(super) fn is_pressed_out(presses: bool, separation: f64, reach: f64) -> bool {
    presses | (separation < -UNLOADED_POINT_DEPTH * reach)
}

/// At most so much, either way; what is no number stays none.
#[inline(always)]
fn within(bound: f64, impulse: f64) -> f64 {
    if impulse.abs() <= bound { impulse } else { bound.copysign(impulse) }
}
