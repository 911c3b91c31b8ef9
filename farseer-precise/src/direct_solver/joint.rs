//! Joint rows of the direct solver: bilateral rows, motors, limits and springs, each with bounds on its impulse.
//!
//! A bilateral row has infinite bounds, a motor the bounds of its greatest impulse, and a limit pushes in one direction only.
//!
//! **Motor and limits on one row.** Let u be the relative velocity of the row and l its impulse. Let s be the motor's speed, E
//! its greatest impulse, and lo <= s <= hi the velocities with which the joint reaches its limits at the end of the step. The
//! motor allows -E <= l <= E at u = s, and l = E below, -E above. The limits add l >= 0 at u = lo and l <= 0 at u = hi. The sum
//! is one maximal monotone graph with three vertical pieces. Its proximal map from the multiplier c with stiffness k is
//!
//! ```text
//! l(u) = min(c - k (u - hi), max(c - k (u - lo), clamp(c - k (u - s), -E, E)))
//! ```
//!
//! So one row is the motor and both limits for any direction of the load: no limit has to be chosen beforehand. Without a motor
//! E is 0. Proximal maps of monotone graphs: R. T. Rockafellar, "Monotone operators and the proximal point algorithm" (1976).

use crate::parameters::direct::STABLE_STIFFNESS;
use std::ops::{Deref, DerefMut};

use super::constraint::{BodyIndices, Constraint, ConstraintRows, FIXED, Jacobian, RowMask};
use super::island_body::{MemberIndex, Members, max_or_nan, positive_part};
use super::mat3::Vec3;

/// Index of the joint row for translation along the direction n, the normal of the Jacobian.
pub(crate) const ALONG: usize = 0;
/// Index of the joint row for the angle between the bodies.
pub(crate) const ANGLE: usize = 1;
/// Index of the joint row for translation along the direction t = (n.y, -n.x), perpendicular to n.
pub(crate) const ACROSS: usize = 2;

/// Row index that stands for no row.
const NONE: usize = usize::MAX;

/// Speed and greatest impulse of a motor row.
#[derive(Debug, Clone, Copy)]
pub(crate) struct MotorTarget {
    /// Target speed of the row. Unit of a row for translation: length units/s; for the angle: radians/s.
    pub(crate) speed: f64,
    /// Greatest impulse of the motor in a step, >= 0. Unit for translation: mass units * length units/s; angle: mass units *
    /// length units^2/s.
    pub(crate) max_impulse: f64,
}

impl MotorTarget {
    /// The target without a motor: no speed and no impulse.
    pub(crate) const NONE: Self = MotorTarget { speed: 0.0, max_impulse: 0.0 };
}

/// A spring with a damper, linear or angular.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct SpringDamper {
    /// Stiffness, >= 0. Linear spring: force per stretch, mass units/s^2; angular spring: torque per radian, mass units *
    /// length units^2/s^2.
    pub(crate) stiffness: f64,
    /// Damping, >= 0. Linear spring: force per velocity, mass units/s; angular spring: torque per angular velocity, mass units
    /// * length units^2/s.
    pub(crate) damping: f64,
    /// Stretch beyond the rest length or rest angle at the beginning of the step. Linear spring: length units; angular spring:
    /// radians.
    pub(crate) stretch: f64,
}

/// The rows of a joint or spring between two bodies of an island, or between a body of the island and a fixed body. Vectors
/// have one component per row: [`ALONG`], [`ANGLE`], [`ACROSS`].
#[derive(Debug, Clone, Copy)]
pub(crate) struct JointRows {
    /// Jacobian, impulses and velocity errors of the rows.
    rows: ConstraintRows,
    /// Lower bound of the impulse of each row in a step; negative infinity for a bilateral row. Unit for translation: mass
    /// units * length units/s; angle: mass units * length units^2/s.
    low: Vec3,
    /// Upper bound of the impulse of each row in a step; infinity for a bilateral row. Unit for translation: mass units *
    /// length units/s; angle: mass units * length units^2/s.
    high: Vec3,
    /// Index of the row with limits, or [`NONE`] for a joint without limits.
    limited_row: usize,
    /// Velocity errors at which the row with limits reaches its lower limit (first, <= 0) and its upper limit (second, >= 0) at
    /// the end of the step. Unit for translation: length units/s; angle: radians/s.
    limit_errors: [f64; 2],
    /// Greatest impulse that motor and limits together exert on the row with limits. Unit for translation: mass units * length
    /// units/s; angle: mass units * length units^2/s.
    max_limit_impulse: f64,
    /// Compliance of each row: velocity error per impulse, 0 for a rigid row. Unit for translation: 1/mass units; angle:
    /// 1/(mass units * length units^2).
    compliance: Vec3,
    /// Fraction of the impulse of each row that becomes its multiplier in the next round, 0..=1. It is 1 for a rigid row, and 0
    /// for a row whose compliance exceeds that of the round.
    multiplier_share: Vec3,
    /// Spring of the constraint; without effect if `spring_row` is [`NONE`], and without stiffness for a rod.
    spring_damper: SpringDamper,
    /// Index of the row of the spring or of the transverse row of a rod that carries momentum, or [`NONE`].
    spring_row: usize,
    /// Velocity error that stands for the stretch of the spring. Unit for translation: length units/s; angle: radians/s.
    stretch_bias: f64,
    /// Geometric stiffness of a spring or rod under tension times dt^2: impulse per transverse velocity, mass units.
    transverse_stiffness: f64,
    /// Second-order term in the velocity error of each row: its linearisation error divided by dt. Unit for translation: length
    /// units/s; angle: radians/s.
    linearisation_rate: Vec3,
    /// Position error of each row at the end of the step. Unit for translation: length units; angle: radians.
    pub(crate) errors: Vec3,
    /// Part of the position error of each row at the start of the step that exceeds the greatest correction of a step. The
    /// position correction leaves it. Unit for translation: length units; angle: radians.
    kept_errors: Vec3,
    /// Length that one radian counts as where errors of rows are compared, in length units per radian.
    error_arm: f64,
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
    /// Returns a joint without rows; rows are added later and get the initial `impulses` (unit for translation: mass units *
    /// length units/s; angle: mass units * length units^2/s). `prescribed` are the velocities of A and B if they are kinematic,
    /// else 0: length units/s, length units/s, radians/s. `error_arm` is in length units per radian.
    pub(crate) fn new(
        bodies: BodyIndices,
        jacobian: Jacobian,
        impulses: Vec3,
        prescribed: [Vec3; 2],
        error_arm: f64,
    ) -> Self {
        let mut rows = ConstraintRows::new(bodies, jacobian, 0, impulses);
        rows.velocity_error = jacobian.relative_velocities(prescribed[0], prescribed[1]);
        rows.driven_velocity_error = rows.velocity_error;
        JointRows {
            rows,
            low: [0.0; 3],
            high: [0.0; 3],
            limited_row: NONE,
            limit_errors: [0.0; 2],
            max_limit_impulse: f64::INFINITY,
            compliance: [0.0; 3],
            multiplier_share: [1.0; 3],
            spring_damper: SpringDamper::default(),
            spring_row: NONE,
            stretch_bias: 0.0,
            transverse_stiffness: 0.0,
            linearisation_rate: [0.0; 3],
            errors: [0.0; 3],
            kept_errors: [0.0; 3],
            error_arm,
        }
    }

    /// Adds a bilateral row with impulses from -`max_impulse` to `max_impulse`. Unit for translation: mass units * length
    /// units/s; angle: mass units * length units^2/s.
    pub(crate) fn add_bilateral_row(&mut self, row: usize, max_impulse: f64) {
        self.add_row(row, [-max_impulse, max_impulse]);
    }

    /// Adds a row whose impulse over the step is at most `max_impulse` (unit for translation: mass units * length units/s;
    /// angle: mass units * length units^2/s). The row seeks the speed that removes the position `error` (unit for translation:
    /// length units; angle: radians) at `rate` (1/s).
    pub(crate) fn add_bounded_row(&mut self, row: usize, max_impulse: f64, error: f64, rate: f64) {
        self.add_motor_row(row, MotorTarget { speed: -error * rate, max_impulse });
    }

    /// Adds the row with index `row` that a motor drives.
    pub(crate) fn add_motor_row(&mut self, row: usize, motor: MotorTarget) {
        self.add_row(row, [-motor.max_impulse, motor.max_impulse]);
        self.velocity_error[row] -= motor.speed;
        self.driven_velocity_error[row] -= motor.speed;
    }

    /// Adds a row with a motor and limits. `[below, above]` are the distances to the lower and the upper limit. Unit for
    /// translation: length units; angle: radians.
    ///
    /// The row may move by the distance to a limit in `dt` seconds, and no faster. Motor and limits together exert at most
    /// `max_limit_impulse`. Unit for translation: mass units * length units/s; angle: mass units * length units^2/s.
    pub(crate) fn add_limited_row(
        &mut self,
        row: usize,
        [below, above]: [f64; 2],
        motor: MotorTarget,
        [dt, max_limit_impulse]: [f64; 2],
    ) {
        let [lowest, highest] = [-positive_part(below) / dt, positive_part(above) / dt];
        let speed = motor.speed.clamp(lowest, highest);
        self.add_motor_row(row, MotorTarget { speed, ..motor });
        (self.limited_row, self.max_limit_impulse) = (row, max_limit_impulse);
        self.limit_errors = [lowest - speed, highest - speed];
    }

    /// Adds a spring with a damper as a row, by implicit Euler over `dt` seconds. Its impulse is at most `max_impulse` (unit
    /// for translation: mass units * length units/s; angle: mass units * length units^2/s). The initial impulse of the row is
    /// that of the stretch.
    pub(crate) fn add_spring_row(&mut self, row: usize, spring: SpringDamper, [dt, max_impulse]: [f64; 2]) {
        let SpringDamper { stiffness, damping, stretch } = spring;
        let slope = dt * (damping + dt * stiffness);
        if slope > 0.0 {
            self.add_row(row, [-max_impulse, max_impulse]);
            (self.spring_damper, self.spring_row) = (spring, row);
            self.stretch_bias = dt * stiffness * stretch / slope;
            self.velocity_error[row] += self.stretch_bias;
            self.driven_velocity_error[row] += self.stretch_bias;
            self.compliance[row] = slope.recip();
            self.impulses[row] = -dt * stiffness * stretch;
        }
    }

    /// Adds a transverse row for the geometric stiffness of a spring or rod under tension. `slope` is impulse per transverse velocity,
    /// mass units. The step integrates stiffness up to the stable limit explicitly; the row takes the excess.
    pub(crate) fn add_transverse_stiffness(&mut self, slope: f64) {
        if slope > 0.0 && slope < f64::INFINITY {
            self.add_row(ACROSS, [f64::NEG_INFINITY, f64::INFINITY]);
            self.transverse_stiffness = slope;
        }
    }

    /// Adds the row with index `row` and the bounds `[low, high]` of its impulse in a step. Unit for translation: mass units *
    /// length units/s; angle: mass units * length units^2/s.
    fn add_row(&mut self, row: usize, [low, high]: [f64; 2]) {
        self.present_rows |= 1 << row;
        (self.low[row], self.high[row]) = (low, high);
    }

    /// Computes the effective masses of the rows from the island's members, and removes rows that no impulse can change. Clamps
    /// the initial impulses to the bounds.
    pub(super) fn set_effective_masses(&mut self, members: &Members) {
        let inverses = self.bodies.map(|at| match at {
            FIXED => [0.0; 2],
            at => members[at].inverse_mass_and_inertia(),
        });
        let [[mass_a, inertia_a], [mass_b, inertia_b]] = inverses;
        let Jacobian { angular_a: a, angular_b: b, .. } = self.jacobian;
        for row in 0..3 {
            let linear = if row == ANGLE { 0.0 } else { mass_a + mass_b };
            let inverse = linear + inertia_a * a[row] * a[row] + inertia_b * b[row] * b[row];
            if !(self.has_row(row) && inverse > 0.0) {
                self.present_rows &= !(1 << row);
            }
            self.effective_masses[row] = if self.has_row(row) { inverse.recip() } else { 0.0 };
            if row == ACROSS && self.transverse_stiffness > 0.0 && self.has_row(row) {
                self.set_transverse_compliance();
            }
            self.impulses[row] =
                if self.has_row(row) { self.clamp_to_range(row, self.impulses[row]) } else { 0.0 };
        }
        let impulses = self.impulses;
        self.set_initial_impulses(impulses);
    }

    /// Sets the compliance of the transverse row so that the row takes the geometric stiffness beyond the stable limit of its
    /// effective mass. Without such an excess it removes the row.
    fn set_transverse_compliance(&mut self) {
        let slope = self.transverse_stiffness - STABLE_STIFFNESS * self.effective_masses[ACROSS];
        if slope > 0.0 {
            self.compliance[ACROSS] = slope.recip();
        } else {
            (self.present_rows, self.effective_masses[ACROSS]) = (self.present_rows & !(1 << ACROSS), 0.0);
        }
    }

    /// Returns the ratio of the geometric stiffness of a rod to its stable limit, dimensionless; 0 without an excess.
    pub(super) fn transverse_stiffness_ratio(&self) -> f64 {
        if self.has_row(ACROSS) && self.transverse_stiffness > 0.0 {
            self.transverse_stiffness / (STABLE_STIFFNESS * self.effective_masses[ACROSS])
        } else {
            0.0
        }
    }

    /// Returns the relative speed of the anchors across the normal at the velocities of the `members`, in length units/s, >= 0.
    pub(super) fn speed_across(&self, members: &Members) -> f64 {
        (self.relative_velocities_of(|member| members[member].velocity)[ACROSS]
            + self.driven_velocity_error[ACROSS])
            .abs()
    }

    /// Lets the transverse row of a rod carry momentum: of the geometric stiffness that it takes, the part
    /// `with_momentum(added, stable)` acts at the present velocities of the `members`. All are in mass units.
    pub(super) fn carry_transverse_momentum(
        &mut self,
        members: &Members,
        with_momentum: impl Fn(f64, f64) -> f64,
    ) {
        if self.has_row(ACROSS) && self.transverse_stiffness > 0.0 {
            let stable = STABLE_STIFFNESS * self.effective_masses[ACROSS];
            let share = self.compliance[ACROSS] * with_momentum(self.compliance[ACROSS].recip(), stable);
            let velocity = self.relative_velocities_of(|member| members[member].velocity)[ACROSS];
            let bias = -share * (velocity + self.velocity_error[ACROSS]);
            (self.spring_row, self.stretch_bias) = (ACROSS, bias);
            self.velocity_error[ACROSS] += bias;
            self.driven_velocity_error[ACROSS] += bias;
        }
    }

    /// Sets the stiffness of the rows for a round. A rigid row has the compliance of its kind, as a fraction of its inverse effective
    /// mass (dimensionless): `bilateral` rows, rows with a `limit` alone, or rows with a `motor`. A compliant row keeps its own
    /// compliance (velocity per impulse), unless that is smaller.
    pub(super) fn set_round_stiffness(&mut self, [bilateral, limit, motor]: [f64; 3]) {
        for row in 0..3 {
            let round_compliance = if self.has_motor(row) {
                motor
            } else if row == self.limited_row {
                limit
            } else {
                bilateral
            };
            let (rigid, row_compliance) =
                (self.effective_masses[row] / round_compliance, self.compliance[row]);
            let ratio = (1.0 + rigid * row_compliance).recip();
            let is_softer = rigid * row_compliance >= 1.0;
            self.stiffness[row] = if is_softer { row_compliance.recip() } else { rigid * ratio };
            self.multiplier_share[row] = if is_softer { 0.0 } else { ratio };
        }
    }

    /// Starts a round of the augmented Lagrangian method: the present impulse of each row, times its `multiplier_share`,
    /// becomes its multiplier.
    pub(super) fn begin_round(&mut self) {
        self.multipliers = std::array::from_fn(|row| self.multiplier_share[row] * self.impulses[row]);
    }

    /// Returns twice the energy that the spring releases in `dt` seconds at these `velocities` of the island's members (length
    /// units/s, length units/s, radians/s); negative if it takes up energy. Unit: mass units * length units^2/s^2.
    pub(super) fn doubled_released_energy(&self, velocities: impl Fn(MemberIndex) -> Vec3, dt: f64) -> f64 {
        if self.spring_row == NONE {
            return 0.0;
        }
        let rate =
            self.relative_velocities_of(velocities)[self.spring_row] + self.driven_velocity(self.spring_row);
        let SpringDamper { stiffness, stretch, .. } = self.spring_damper;
        let after = stretch + dt * rate;
        stiffness * (stretch * stretch - after * after)
    }

    /// Returns the velocity error that motors and kinematic bodies give the row with index `row`, without the stretch of a
    /// spring. Unit for translation: length units/s; angle: radians/s.
    fn driven_velocity(&self, row: usize) -> f64 {
        if row == self.spring_row {
            self.driven_velocity_error[row] - self.stretch_bias
        } else {
            self.driven_velocity_error[row]
        }
    }

    /// Returns the velocity error that motors and kinematic bodies give each row, without the stretch of a spring. Unit for
    /// translation: length units/s; angle: radians/s.
    pub(super) fn driven_velocities(&self) -> Vec3 {
        std::array::from_fn(|row| self.driven_velocity(row))
    }

    /// Returns whether a motor or a kinematic body drives the joint.
    pub(super) fn is_driven(&self) -> bool {
        (0..3).any(|row| {
            self.driven_velocity_error[row] != if row == self.spring_row { self.stretch_bias } else { 0.0 }
        })
    }

    /// Returns the Jacobian of the joint, and the solved impulses of its rows over the step. Unit for translation: mass units *
    /// length units/s; angle: mass units * length units^2/s.
    pub(crate) fn solution(&self) -> (Jacobian, Vec3) {
        (self.jacobian, self.impulses)
    }

    /// Replaces the Jacobian, after the bodies have moved.
    pub(crate) fn set_jacobian(&mut self, jacobian: Jacobian) {
        self.jacobian = jacobian;
    }

    /// Adds to the velocity errors of the rows the relative velocities by the velocities of the island's members.
    pub(super) fn add_relative_velocity(&mut self, members: &Members) {
        let velocity = self.relative_velocities_of(|member| members[member].velocity);
        (0..3).for_each(|row| self.velocity_error[row] += velocity[row]);
    }

    /// Returns `impulse` clamped to the bounds of the row with index `row`, in its unit.
    fn clamp_to_bounds(&self, row: usize, impulse: f64) -> f64 {
        clamp_impulse([self.low[row], self.high[row]], impulse)
    }

    /// Returns `impulse` clamped to the range that the row with index `row` can have by motor and limits, in its unit. Limits
    /// may exceed the greatest impulse of the motor.
    fn clamp_to_range(&self, row: usize, impulse: f64) -> f64 {
        if row != self.limited_row {
            return self.clamp_to_bounds(row, impulse);
        }
        let low = if self.limit_errors[1] < f64::INFINITY { -self.max_limit_impulse } else { self.low[row] };
        let high =
            if self.limit_errors[0] > f64::NEG_INFINITY { self.max_limit_impulse } else { self.high[row] };
        clamp_impulse([low, high], impulse)
    }

    /// Proximal map of the row with index `row`. Returns its impulse (unit for translation: mass units * length units/s; angle:
    /// mass units * length units^2/s), and whether the row is active: its impulse follows the velocity error.
    ///
    /// `free` is the impulse of the motor or bilateral row without bounds. `stiffness` is impulse per velocity: mass units for
    /// translation, mass units * length units^2 for the angle.
    #[inline(always)]
    fn proximal_map(&self, row: usize, free: f64, stiffness: f64) -> (f64, bool) {
        let driven = self.clamp_to_bounds(row, free);
        if row != self.limited_row {
            return (driven, driven == free);
        }
        self.proximal_map_with_limits(driven, free, stiffness)
    }

    /// [`proximal_map`](Self::proximal_map) for the row with motor and limits. Returns its impulse, and whether the row is
    /// active. `driven` is the impulse of the motor within its bounds.
    #[inline(never)]
    fn proximal_map_with_limits(&self, driven: f64, free: f64, stiffness: f64) -> (f64, bool) {
        let [lower, upper] = self.limit_errors.map(|stop| free + stiffness * stop);
        let limited = if lower > driven { lower } else { driven };
        let pushed = if upper < limited { upper } else { limited };
        let impulse = clamp_impulse([-self.max_limit_impulse, self.max_limit_impulse], pushed);
        (impulse, [free, lower, upper].contains(&impulse))
    }

    /// Returns the velocity error that an active row with this `impulse` approaches: that of the limit that holds the row, else
    /// 0. Unit for translation: length units/s; angle: radians/s.
    fn target_error(&self, row: usize, impulse: f64) -> f64 {
        if row != self.limited_row {
            0.0
        } else if impulse > self.high[row] {
            self.limit_errors[0]
        } else if impulse < self.low[row] {
            self.limit_errors[1]
        } else {
            0.0
        }
    }

    /// Returns whether a limit holds the row with index `row`: the impulse of the row is beyond the bounds of the motor.
    fn is_at_limit(&self, row: usize) -> bool {
        row == self.limited_row && !(self.low[row]..=self.high[row]).contains(&self.impulses[row])
    }

    /// Returns whether the impulse of the row with index `row` has no bounds.
    fn is_bilateral(&self, row: usize) -> bool {
        self.low[row] == f64::NEG_INFINITY && self.high[row] == f64::INFINITY
    }

    /// Returns whether the row with index `row` has finite bounds on both sides: that of a motor or brake, or of a joint with a
    /// greatest impulse.
    fn has_motor(&self, row: usize) -> bool {
        self.high[row] > 0.0 && self.high[row] < f64::INFINITY
    }

    /// Returns the factor that converts an error of the row with index `row` to length units: 1 (dimensionless) for
    /// translation, `error_arm` (length units per radian) for the angle.
    fn length_per_unit(&self, row: usize) -> f64 {
        if row == ANGLE { self.error_arm } else { 1.0 }
    }

    /// Returns the velocity residual: the greatest velocity by which a row violates its law, in length units/s. For an active
    /// row it is the velocity error; for a row at a bound, the velocity that the impulse beyond the bound would make.
    pub(super) fn residual(&self) -> f64 {
        (0..3).filter(|&row| self.has_row(row)).fold(0.0, |worst, row| {
            let (mass, impulse, compliance) =
                (self.effective_masses[row], self.impulses[row], self.compliance[row]);
            // Ratio of the effective mass of the compliant row to that of a rigid one.
            let mass_ratio = (1.0 + mass * compliance).recip();
            let row_error = self.velocity_error[row] + compliance * impulse;
            let (limited, is_active) = self.proximal_map(row, impulse - mass * mass_ratio * row_error, mass);
            let error = if is_active {
                mass_ratio * (row_error - self.target_error(row, limited))
            } else {
                (limited - impulse) / mass
            };
            max_or_nan(self.length_per_unit(row) * error.abs(), worst)
        })
    }

    /// Sets the velocity errors of the rows to those by motors, kinematic bodies and springs, plus `error` / `dt`. `error` are
    /// the linearisation errors of the rows over `dt` seconds (unit for translation: length units; angle: radians). The present
    /// impulses become the initial ones. Returns the greatest change of a linearisation error, in length units.
    pub(super) fn set_linearisation_error(&mut self, error: Vec3, dt: f64) -> f64 {
        let rates = error.map(|error| error / dt);
        let worst = (0..3).filter(|&row| self.has_row(row)).fold(0.0, |worst, row| {
            max_or_nan(
                self.length_per_unit(row) * dt * (rates[row] - self.linearisation_rate[row]).abs(),
                worst,
            )
        });
        self.linearisation_rate = rates;
        self.velocity_error =
            std::array::from_fn(|row| self.driven_velocity_error[row] + self.linearisation_rate[row]);
        let impulses = self.impulses;
        self.set_initial_impulses(impulses);
        worst
    }

    /// Returns whether the row with index `row` has a finite bound and no limits, such as a motor. A position correction leaves
    /// such a row out, because it must not do more than the row can.
    fn may_slip(&self, row: usize) -> bool {
        row != self.limited_row && self.high[row] < f64::INFINITY
    }

    /// Returns the greatest position error of the rows that may not slip, in length units.
    pub(super) fn max_position_error(&self) -> f64 {
        let kept = (0..3).filter(|&row| !self.may_slip(row));
        kept.fold(0.0, |worst, row| max_or_nan(self.length_per_unit(row) * self.errors[row].abs(), worst))
    }

    /// Sets the part of the `initial` position errors of the rows that the step leaves: all beyond `max_correction` length units
    /// and `max_rotation` radians. Initial errors are those at the start of the step (unit for translation: length units; angle:
    /// radians). Returns whether any error stays.
    pub(super) fn set_kept_errors(&mut self, initial: Vec3, max_correction: f64, max_rotation: f64) -> bool {
        self.kept_errors = std::array::from_fn(|row| {
            let most = if row == ANGLE { max_rotation } else { max_correction };
            initial[row] - initial[row].clamp(-most, most)
        });
        self.kept_errors != [0.0; 3]
    }

    /// Returns the position error of the row with index `row` that this step is to correct. Unit for translation: length units;
    /// angle: radians.
    fn open_error(&self, row: usize) -> f64 {
        let (error, kept) = (self.errors[row], self.kept_errors[row]);
        if kept > 0.0 {
            positive_part(error - kept)
        } else if kept < 0.0 {
            -positive_part(kept - error)
        } else {
            error
        }
    }

    /// Returns the greatest position error of the rows that this step is to correct, in length units.
    pub(super) fn max_open_error(&self) -> f64 {
        let kept = (0..3).filter(|&row| !self.may_slip(row));
        kept.fold(0.0, |worst, row| max_or_nan(self.length_per_unit(row) * self.open_error(row).abs(), worst))
    }

    /// Selects the active set of a position correction: bilateral rows, rows at a limit, and other rows with a position error.
    pub(super) fn select_corrected_rows(&mut self) {
        let is_corrected = |&row: &usize| {
            let is_off = || self.is_bilateral(row) || self.is_at_limit(row) || self.errors[row] != 0.0;
            self.has_row(row) && self.compliance[row] == 0.0 && !self.may_slip(row) && is_off()
        };
        self.active_rows = (0..3).filter(is_corrected).fold(0, |set, row| set | 1 << row);
    }

    /// Returns the impulses of the rows that correct the position errors of the active rows, each by at most `max_correction`
    /// length units. As the linear system is solved for displacements, the unit is mass units * length units for translation,
    /// mass units * length units^2 for the angle.
    pub(super) fn correction_impulses(&self, max_correction: f64) -> Vec3 {
        std::array::from_fn(|row| {
            let max_error = max_correction / self.length_per_unit(row);
            let error = self.open_error(row).clamp(-max_error, max_error);
            if self.is_active(row) { -self.stiffness[row] * error } else { 0.0 }
        })
    }
}

impl Constraint for JointRows {
    #[inline(always)]
    fn project_impulses(&self, velocity_error: Vec3) -> (Vec3, RowMask) {
        let (mut impulses, mut active) = ([0.0; 3], 0);
        for row in (0..3).filter(|&row| self.has_row(row)) {
            let free = self.multipliers[row] - self.stiffness[row] * velocity_error[row];
            let (impulse, is_active) = self.proximal_map(row, free, self.stiffness[row]);
            impulses[row] = impulse;
            active |= u8::from(is_active) << row;
        }
        (impulses, active)
    }

    /// Returns whether every row at a bound keeps that bound. A bound changes if a motor reverses, or if the row with limits
    /// changes between motor, lower limit and upper limit.
    #[inline(always)]
    fn keeps_bounds(&self, impulses: Vec3, active: RowMask) -> bool {
        (0..3).all(|row| match active >> row & 1 {
            1 => {
                row != self.limited_row
                    || self.target_error(row, impulses[row]) == self.target_error(row, self.impulses[row])
            }
            _ => impulses[row] == self.impulses[row],
        })
    }

    fn solve_row(&mut self, row: usize, velocity_error: f64) -> Vec3 {
        let (mass, compliance) = (self.effective_masses[row], self.compliance[row]);
        let mass_ratio = (1.0 + mass * compliance).recip();
        let excess = velocity_error + compliance * self.impulses[row];
        let (impulse, _) = self.proximal_map(row, self.impulses[row] - mass * mass_ratio * excess, mass);
        let mut change = [0.0; 3];
        change[row] = impulse - self.impulses[row];
        self.impulses[row] = impulse;
        change
    }

    fn compliance_energy(&self) -> f64 {
        (0..3).map(|row| self.compliance[row] * self.impulses[row] * self.impulses[row]).sum()
    }
}

/// Returns `impulse` clamped to `low..=high`, all in one unit.
#[inline(always)]
fn clamp_impulse([low, high]: [f64; 2], impulse: f64) -> f64 {
    if impulse < low {
        low
    } else if impulse > high {
        high
    } else {
        impulse
    }
}
