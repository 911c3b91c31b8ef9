//! A joint as the direct solver sees it: rows with bounds on their impulses. A bilateral row has none, a limit pushes one way, a motor
//! has its greatest effort.

use std::ops::{Deref, DerefMut};

use super::block::Triple;
use super::constraint::{Constraint, ConstraintRows, Ends, FIXED, Jacobian, Set};
use super::island::{Member, greater};

/// The row of the angle.
pub(in crate::precise) const ANGLE: usize = 1;

/// The rows of a joint between two bodies of an island, or of one and the world.
#[derive(Debug, Clone, Copy)]
pub(in crate::precise) struct JointRows {
    rows: ConstraintRows,
    /// Bounds of the impulses of a step; infinite where a row is kept whatever that takes.
    low: Triple,
    high: Triple,
    /// Position errors of the rows at the end of the step: length units, and radians in the row of the angle.
    pub(in crate::precise) errors: Triple,
    /// Length that a turn by one radian counts as where errors of rows are compared, in length units per radian.
    lever: f64,
}

impl Deref for JointRows {
    type Target = ConstraintRows;

    #[inline(always)]
    fn deref(&self) -> &ConstraintRows {
        &self.rows
    }
}

impl DerefMut for JointRows {
    #[inline(always)]
    fn deref_mut(&mut self) -> &mut ConstraintRows {
        &mut self.rows
    }
}

impl JointRows {
    /// A joint without rows, with impulses of a step that take effect as its rows are added. `prescribed` are the velocities of A and
    /// B where these are fixed: of kinematic bodies.
    pub(in crate::precise) fn new(
        ends: Ends,
        jacobian: Jacobian,
        impulses: Triple,
        prescribed: [Triple; 2],
        lever: f64,
    ) -> Self {
        let mut rows = ConstraintRows::new(ends, jacobian, 0, impulses);
        rows.excess = jacobian.relative(prescribed[0], prescribed[1]);
        rows.supplied = rows.excess;
        JointRows { rows, low: [0.0; 3], high: [0.0; 3], errors: [0.0; 3], lever }
    }

    /// A row that is kept by at most this impulse, 0 and more, either way.
    pub(in crate::precise) fn keep(&mut self, row: usize, most: f64) {
        self.add(row, [-most, most]);
    }

    /// A row that is to have this speed, in length units or radians per second, for which it exerts at most this impulse.
    pub(in crate::precise) fn drive(&mut self, row: usize, speed: f64, most: f64) {
        self.add(row, [-most, most]);
        self.excess[row] -= speed;
        self.supplied[row] -= speed;
    }

    /// A row whose value is to stay between two limits, of which the one that is nearer after `dt` seconds at this speed counts: it may
    /// be approached as far as there is room, and pushes back by at most this impulse.
    pub(in crate::precise) fn limit(
        &mut self,
        row: usize,
        [below, above]: [f64; 2],
        speed: f64,
        [dt, most]: [f64; 2],
    ) {
        let way = speed * dt;
        if below + way <= above - way {
            self.add(row, [0.0, most]);
            self.excess[row] += below.max(0.0) / dt;
        } else {
            self.add(row, [-most, 0.0]);
            self.excess[row] -= above.max(0.0) / dt;
        }
    }

    fn add(&mut self, row: usize, [low, high]: [f64; 2]) {
        self.present |= 1 << row;
        (self.low[row], self.high[row]) = (low, high);
    }

    /// Effective masses are those of these members, and impulses those of the rows that there are.
    pub(super) fn weigh(&mut self, members: &[Member]) {
        let inverses = self.bodies.map(|at| match at {
            FIXED => [0.0; 2],
            at => members[at as usize].inverses(),
        });
        let [[mass_a, inertia_a], [mass_b, inertia_b]] = inverses;
        let Jacobian { a, b, .. } = self.jacobian;
        for row in 0..3 {
            let linear = if row == ANGLE { 0.0 } else { mass_a + mass_b };
            let inverse = linear + inertia_a * a[row] * a[row] + inertia_b * b[row] * b[row];
            if !(self.has(row) && inverse > 0.0) {
                self.present &= !(1 << row);
            }
            self.masses[row] = if self.has(row) { inverse.recip() } else { 0.0 };
            self.impulses[row] = if self.has(row) { self.within(row, self.impulses[row]) } else { 0.0 };
        }
        let impulses = self.impulses;
        self.start_from(impulses);
    }

    /// The Jacobian, and the impulses of the step that were found.
    pub(in crate::precise) fn found(&self) -> (Jacobian, Triple) {
        (self.jacobian, self.impulses)
    }

    /// Rows act along other directions, or with other arms, from now on.
    pub(in crate::precise) fn set_jacobian(&mut self, jacobian: Jacobian) {
        self.jacobian = jacobian;
    }

    /// The velocity errors take in how members move.
    pub(super) fn meet(&mut self, members: &[Member]) {
        let velocity = self.relative_of(|member| members[member].velocity);
        (0..3).for_each(|row| self.excess[row] += velocity[row]);
    }

    fn within(&self, row: usize, impulse: f64) -> f64 {
        if impulse < self.low[row] {
            self.low[row]
        } else if impulse > self.high[row] {
            self.high[row]
        } else {
            impulse
        }
    }

    /// Whether a row is kept whatever that takes.
    fn is_bilateral(&self, row: usize) -> bool {
        self.low[row] == f64::NEG_INFINITY && self.high[row] == f64::INFINITY
    }

    /// Length units that an error of a row counts as.
    fn scale(&self, row: usize) -> f64 {
        if row == ANGLE { self.lever } else { 1.0 }
    }

    /// The greatest velocity error of the rows, in length units per second: of a row inside of its bounds its velocity error, of one
    /// at a bound the velocity that the impulse beyond it makes.
    pub(super) fn residual(&self) -> f64 {
        (0..3).filter(|&row| self.has(row)).fold(0.0, |worst, row| {
            let (mass, impulse, excess) = (self.masses[row], self.impulses[row], self.excess[row]);
            let wanted = impulse - mass * excess;
            let limited = self.within(row, wanted);
            let error = if limited == wanted { excess } else { (limited - impulse) / mass };
            greater(self.scale(row) * error.abs(), worst)
        })
    }

    /// The greatest position error of the rows, in length units.
    pub(super) fn greatest_error(&self) -> f64 {
        (0..3).fold(0.0, |worst, row| greater(self.scale(row) * self.errors[row].abs(), worst))
    }

    /// The active set of a position correction: bilateral rows, and rows with bounds that are off.
    pub(super) fn select_errors(&mut self) {
        let is_corrected =
            |&row: &usize| self.has(row) && (self.is_bilateral(row) || self.errors[row] != 0.0);
        self.active = (0..3).filter(is_corrected).fold(0, |set, row| set | 1 << row);
    }

    /// Impulses that correct the position errors of the active rows, each by at most `most` length units.
    pub(super) fn correction(&self, most: f64) -> Triple {
        std::array::from_fn(|row| {
            let most = most / self.scale(row);
            let error = self.errors[row].clamp(-most, most);
            if self.is_active(row) { -self.stiffness[row] * error } else { 0.0 }
        })
    }
}

impl Constraint for JointRows {
    #[inline(always)]
    fn law(&self, excess: Triple) -> (Triple, Set) {
        let (mut impulses, mut active) = ([0.0; 3], 0);
        for row in (0..3).filter(|&row| self.has(row)) {
            let free = self.centre[row] - self.stiffness[row] * excess[row];
            impulses[row] = self.within(row, free);
            active |= u8::from(impulses[row] == free) << row;
        }
        (impulses, active)
    }

    /// A motor whose impulse changes from one bound to the other reverses.
    #[inline(always)]
    fn keeps_bounds(&self, impulses: Triple, active: Set) -> bool {
        (0..3).all(|row| active >> row & 1 == 1 || impulses[row] == self.impulses[row])
    }

    fn stop(&mut self, row: usize, excess: f64) -> Triple {
        let impulse = self.within(row, self.impulses[row] - self.masses[row] * excess);
        let mut change = [0.0; 3];
        change[row] = impulse - self.impulses[row];
        self.impulses[row] = impulse;
        change
    }
}
