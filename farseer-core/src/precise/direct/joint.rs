//! A joint as the direct solver sees it: rows with bounds on their impulses. A bilateral row has none, a motor has its greatest effort,
//! and limits of travel push one way each.
//!
//! **Motor and limits on one row.** Let u be the velocity along the travel, s the motor's speed, E its greatest impulse, and lo <= s <= hi
//! the velocities that reach the limits at the end of the step. The motor allows -E <= l <= E at u = s, and l = E below, -E above. The
//! limits add l >= 0 at u = lo and l <= 0 at u = hi. The sum is one maximal monotone graph with three vertical pieces, and its proximal
//! map from the multiplier c with stiffness k is
//!
//! ```text
//! l(u) = min(c - k (u - hi), max(c - k (u - lo), clamp(c - k (u - s), -E, E)))
//! ```
//!
//! So one row is motor and both limits, whichever way the load drives it: no limit has to be chosen beforehand (proximal maps of
//! monotone graphs: R. T. Rockafellar, "Monotone operators and the proximal point algorithm", 1976). Without a motor E is 0.

use crate::precise::parameters::direct::STABLE_STIFFNESS;
use std::ops::{Deref, DerefMut};

use super::block::Triple;
use super::constraint::{Constraint, ConstraintRows, Ends, FIXED, Jacobian, Set};
use super::island::{Member, greater};

/// Indices of the rows of a joint: along the direction n, of the angle, and along t = (n.y, -n.x).
pub(in crate::precise) const ALONG: usize = 0;
pub(in crate::precise) const ANGLE: usize = 1;
pub(in crate::precise) const ACROSS: usize = 2;

/// No row.
const NONE: usize = usize::MAX;

/// A motor: the speed that it seeks, in length units or radians per second, and its greatest impulse of a step.
#[derive(Debug, Clone, Copy)]
pub(in crate::precise) struct Drive {
    pub(in crate::precise) speed: f64,
    pub(in crate::precise) most: f64,
}

impl Drive {
    /// No motor.
    pub(in crate::precise) const NONE: Self = Drive { speed: 0.0, most: 0.0 };
}

/// A spring with a damper: force per length unit or torque per radian, the same per second, and the stretch when the step begins.
#[derive(Debug, Clone, Copy, Default)]
pub(in crate::precise) struct Elastic {
    pub(in crate::precise) stiffness: f64,
    pub(in crate::precise) damping: f64,
    pub(in crate::precise) stretch: f64,
}

/// The rows of a joint between two bodies of an island, or of one and the world.
#[derive(Debug, Clone, Copy)]
pub(in crate::precise) struct JointRows {
    rows: ConstraintRows,
    /// Bounds of the impulses of a step; infinite where a row is kept whatever that takes.
    low: Triple,
    high: Triple,
    /// The row with limits of its travel, or [`NONE`].
    travel: usize,
    /// Velocity errors of that row at which it reaches its limits at the end of the step, in length units (radians) per second: at most
    /// 0 for the lower, at least 0 for the upper one.
    stops: [f64; 2],
    /// Greatest impulse of that row, motor and limits together.
    strength: f64,
    /// Velocity error per impulse with which a row yields: 0 for a rigid one.
    compliance: Triple,
    /// Part of the impulses before a round that rows begin it with: 1 for rigid rows, 0 for springs that the system bears as they are.
    share: Triple,
    /// Its spring, the row of that, and the velocity error that stands for the stretch.
    elastic: Elastic,
    elastic_row: usize,
    offset: f64,
    /// Impulse per velocity across a spring with which its tension resists.
    across: f64,
    /// Linearisation errors as a part of the velocity errors, in length units (radians) per second.
    linearisation: Triple,
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
        JointRows {
            rows,
            low: [0.0; 3],
            high: [0.0; 3],
            travel: NONE,
            stops: [0.0; 2],
            strength: f64::INFINITY,
            compliance: [0.0; 3],
            share: [1.0; 3],
            elastic: Elastic::default(),
            elastic_row: NONE,
            offset: 0.0,
            across: 0.0,
            linearisation: [0.0; 3],
            errors: [0.0; 3],
            lever,
        }
    }

    /// A row that is kept by at most this impulse, 0 and more, either way.
    pub(in crate::precise) fn keep(&mut self, row: usize, most: f64) {
        self.add(row, [-most, most]);
    }

    /// The same for a finite impulse: the row seeks the speed that undoes its position error at this rate per second, within its bound.
    pub(in crate::precise) fn keep_within(&mut self, row: usize, most: f64, error: f64, rate: f64) {
        self.drive(row, Drive { speed: -error * rate, most });
    }

    /// A row that a motor drives.
    pub(in crate::precise) fn drive(&mut self, row: usize, drive: Drive) {
        self.add(row, [-drive.most, drive.most]);
        self.excess[row] -= drive.speed;
        self.supplied[row] -= drive.speed;
    }

    /// A row whose value is to stay between two limits, `room` length units or radians away: it may approach each of them as far as there
    /// is room in a step of `dt` seconds. A motor drives it as far as the limits allow. All push by at most the impulse `most`.
    pub(in crate::precise) fn limit(
        &mut self,
        row: usize,
        [below, above]: [f64; 2],
        drive: Drive,
        [dt, most]: [f64; 2],
    ) {
        let [lowest, highest] = [-below.max(0.0) / dt, above.max(0.0) / dt];
        let speed = drive.speed.clamp(lowest, highest);
        self.drive(row, Drive { speed, ..drive });
        (self.travel, self.strength) = (row, most);
        self.stops = [lowest - speed, highest - speed];
    }

    /// A row that is a spring with a damper in a step of `dt` seconds, which exerts at most the impulse `most`. It begins with the impulse
    /// of its stretch.
    pub(in crate::precise) fn spring(&mut self, row: usize, elastic: Elastic, [dt, most]: [f64; 2]) {
        let Elastic { stiffness, damping, stretch } = elastic;
        let slope = dt * (damping + dt * stiffness);
        if slope > 0.0 {
            self.add(row, [-most, most]);
            (self.elastic, self.elastic_row) = (elastic, row);
            self.offset = dt * stiffness * stretch / slope;
            self.excess[row] += self.offset;
            self.supplied[row] += self.offset;
            self.compliance[row] = slope.recip();
            self.impulses[row] = -dt * stiffness * stretch;
        }
    }

    /// Geometric stiffness of a spring under tension: `slope` is the impulse per velocity across its line. Mass bears a part of it as an
    /// explicit force; what is beyond is a row.
    pub(in crate::precise) fn resist_across(&mut self, slope: f64) {
        if slope > 0.0 && slope < f64::INFINITY {
            self.add(ACROSS, [f64::NEG_INFINITY, f64::INFINITY]);
            self.across = slope;
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
            if row == ACROSS && self.across > 0.0 && self.has(row) {
                self.bear_across();
            }
            self.impulses[row] = if self.has(row) { self.bounded(row, self.impulses[row]) } else { 0.0 };
        }
        let impulses = self.impulses;
        self.start_from(impulses);
    }

    /// The row across a spring is as stiff as the tension is beyond what its effective mass bears.
    fn bear_across(&mut self) {
        let slope = self.across - STABLE_STIFFNESS * self.masses[ACROSS];
        if slope > 0.0 {
            self.compliance[ACROSS] = slope.recip();
        } else {
            (self.present, self.masses[ACROSS]) = (self.present & !(1 << ACROSS), 0.0);
        }
    }

    /// Rows get the stiffness of a round: that of a rigid one is so many times softer than its effective mass; a spring keeps its own,
    /// unless that is even stiffer.
    pub(super) fn stiffen(&mut self, softness: f64) {
        for row in 0..3 {
            let (rigid, compliance) = (self.masses[row] / softness, self.compliance[row]);
            let part = (1.0 + rigid * compliance).recip();
            let is_borne = rigid * compliance >= 1.0;
            self.stiffness[row] = if is_borne { compliance.recip() } else { rigid * part };
            self.share[row] = if is_borne { 0.0 } else { part };
        }
    }

    /// A round begins with the impulses now.
    pub(super) fn take_multipliers(&mut self) {
        self.centre = std::array::from_fn(|row| self.share[row] * self.impulses[row]);
    }

    /// Energy that its spring holds when the step begins, less that at the end if members have these velocities: twice.
    pub(super) fn released(&self, velocities: impl Fn(usize) -> Triple, dt: f64) -> f64 {
        if self.elastic_row == NONE {
            return 0.0;
        }
        let rate = self.relative_of(velocities)[self.elastic_row] + self.carried(self.elastic_row);
        let Elastic { stiffness, stretch, .. } = self.elastic;
        let after = stretch + dt * rate;
        stiffness * (stretch * stretch - after * after)
    }

    /// The part of the velocity error of a row that motors and kinematic bodies make.
    fn carried(&self, row: usize) -> f64 {
        if row == self.elastic_row { self.supplied[row] - self.offset } else { self.supplied[row] }
    }

    /// Velocity errors by motors and kinematic bodies.
    pub(super) fn all_carried(&self) -> Triple {
        std::array::from_fn(|row| self.carried(row))
    }

    /// Whether a motor or a kinematic body moves it.
    pub(super) fn is_driven(&self) -> bool {
        (0..3).any(|row| self.supplied[row] != if row == self.elastic_row { self.offset } else { 0.0 })
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
        between([self.low[row], self.high[row]], impulse)
    }

    /// The impulses that a row may exert at all: limits push beyond a motor's greatest effort.
    fn bounded(&self, row: usize, impulse: f64) -> f64 {
        if row != self.travel {
            return self.within(row, impulse);
        }
        let low = if self.stops[1] < f64::INFINITY { -self.strength } else { self.low[row] };
        let high = if self.stops[0] > f64::NEG_INFINITY { self.strength } else { self.high[row] };
        between([low, high], impulse)
    }

    /// The proximal map of a row: its impulse if `free` is that of the motor, or of the bilateral row, without bounds, at this stiffness;
    /// and whether the impulse follows the velocity error there.
    #[inline(always)]
    fn bound(&self, row: usize, free: f64, stiffness: f64) -> (f64, bool) {
        let driven = self.within(row, free);
        if row != self.travel {
            return (driven, driven == free);
        }
        self.stop_travel(driven, free, stiffness)
    }

    #[inline(never)]
    fn stop_travel(&self, driven: f64, free: f64, stiffness: f64) -> (f64, bool) {
        let [lower, upper] = self.stops.map(|stop| free + stiffness * stop);
        let pushed = if lower > driven { lower } else { driven };
        let pushed = if upper < pushed { upper } else { pushed };
        let impulse = between([-self.strength, self.strength], pushed);
        (impulse, [free, lower, upper].contains(&impulse))
    }

    /// The velocity error that an active row with this impulse is to have: that of the limit that it is at, 0 elsewhere.
    fn goal(&self, row: usize, impulse: f64) -> f64 {
        if row != self.travel {
            0.0
        } else if impulse > self.high[row] {
            self.stops[0]
        } else if impulse < self.low[row] {
            self.stops[1]
        } else {
            0.0
        }
    }

    /// Whether a limit of its travel holds a row.
    fn is_at_limit(&self, row: usize) -> bool {
        row == self.travel && !(self.low[row]..=self.high[row]).contains(&self.impulses[row])
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
            let (mass, impulse, compliance) = (self.masses[row], self.impulses[row], self.compliance[row]);
            // The effective mass of a row that yields, as a part of that of a rigid one.
            let part = (1.0 + mass * compliance).recip();
            let excess = self.excess[row] + compliance * impulse;
            let (limited, is_active) = self.bound(row, impulse - mass * part * excess, mass);
            let error = if is_active {
                part * (excess - self.goal(row, limited))
            } else {
                (limited - impulse) / mass
            };
            greater(self.scale(row) * error.abs(), worst)
        })
    }

    /// Takes linearisation errors of `dt` seconds into the velocity errors, and lets a solution begin with the impulses now. Answers the
    /// greatest change of them, in length units.
    pub(super) fn take_linearisation_error(&mut self, error: Triple, dt: f64) -> f64 {
        let rates = error.map(|error| error / dt);
        let worst = (0..3).filter(|&row| self.has(row)).fold(0.0, |worst, row| {
            greater(self.scale(row) * dt * (rates[row] - self.linearisation[row]).abs(), worst)
        });
        self.linearisation = rates;
        self.excess = std::array::from_fn(|row| self.supplied[row] + self.linearisation[row]);
        let impulses = self.impulses;
        self.start_from(impulses);
        worst
    }

    /// Whether a row pushes with no more than its user allows: no correction of positions may do what it cannot.
    fn may_slip(&self, row: usize) -> bool {
        row != self.travel && self.high[row] < f64::INFINITY
    }

    /// The greatest position error of the rows that may not slip, in length units.
    pub(super) fn greatest_error(&self) -> f64 {
        let kept = (0..3).filter(|&row| !self.may_slip(row));
        kept.fold(0.0, |worst, row| greater(self.scale(row) * self.errors[row].abs(), worst))
    }

    /// The active set of a position correction: bilateral rows, rows at a limit, and others that are off.
    pub(super) fn select_errors(&mut self) {
        let is_corrected = |&row: &usize| {
            let is_off = || self.is_bilateral(row) || self.is_at_limit(row) || self.errors[row] != 0.0;
            self.has(row) && self.compliance[row] == 0.0 && !self.may_slip(row) && is_off()
        };
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
            let (impulse, is_active) = self.bound(row, free, self.stiffness[row]);
            impulses[row] = impulse;
            active |= u8::from(is_active) << row;
        }
        (impulses, active)
    }

    /// A motor whose impulse changes from one bound to the other reverses; a row that goes from the motor to a limit, or from one limit
    /// to the other, has another goal.
    #[inline(always)]
    fn keeps_bounds(&self, impulses: Triple, active: Set) -> bool {
        (0..3).all(|row| match active >> row & 1 {
            1 => row != self.travel || self.goal(row, impulses[row]) == self.goal(row, self.impulses[row]),
            _ => impulses[row] == self.impulses[row],
        })
    }

    fn stop(&mut self, row: usize, excess: f64) -> Triple {
        let (mass, compliance) = (self.masses[row], self.compliance[row]);
        let part = (1.0 + mass * compliance).recip();
        let excess = excess + compliance * self.impulses[row];
        let (impulse, _) = self.bound(row, self.impulses[row] - mass * part * excess, mass);
        let mut change = [0.0; 3];
        change[row] = impulse - self.impulses[row];
        self.impulses[row] = impulse;
        change
    }

    fn yielding(&self) -> f64 {
        (0..3).map(|row| self.compliance[row] * self.impulses[row] * self.impulses[row]).sum()
    }
}

/// An impulse within bounds.
#[inline(always)]
fn between([low, high]: [f64; 2], impulse: f64) -> f64 {
    if impulse < low {
        low
    } else if impulse > high {
        high
    } else {
        impulse
    }
}
