//! Contact rows of the direct solver: up to two contact points along the normal, and one friction row along the tangent.
//!
//! Signorini's law holds at each point: normal impulse >= 0, velocity error >= 0, and one of the two is 0. Friction obeys
//! Coulomb's law with a friction limit that is fixed during a Newton step and then relaxed
//! towards friction coefficient * normal impulses. The rows are built from the contact constraint of the iterative solver,
//! which gets the solved impulses.

use crate::parameters::direct::UNLOADED_POINT_DEPTH;
use std::ops::{Deref, DerefMut};

use super::constraint::{BodyIndices, Constraint, ConstraintRows, Jacobian, RowMask};
use super::island_body::{Members, positive_part};
use super::mat3::Vec3;
use crate::constraint_graph::ParkedConstraint;

/// Index of the friction row; rows 0 and 1 are the contact points.
pub(super) const FRICTION: usize = 2;

/// The rows of one contact between two bodies of an island, or between a body of the island and a fixed body.
#[derive(Debug, Clone, Copy)]
pub(super) struct ContactRows {
    /// The rows: 0 and 1 along the normal, 2 along the tangent.
    rows: ConstraintRows,
    /// Friction coefficient, dimensionless, >= 0.
    pub(super) friction: f64,
    /// Greatest friction impulse over the step, mass units * length units/s, 0..=infinity. Fixed during a Newton step.
    pub(super) friction_limit: f64,
    /// Separations of the two contact points along the normal, length units; negative = penetration.
    pub(super) separations: [f64; 2],
    /// Separations that the present position correction demands of the two contact points, length units; 0 without one. It is
    /// negative for a point that joints may press as far as its least separation.
    pub(super) corrections: [f64; 2],
    /// Relative velocity that a kinematic body A alone gives each row, length units/s; 0 without one.
    pub(super) prescribed_velocity: Vec3,
    /// Separations below which joints must not press the two points in this step, length units, < 0; negative infinity for
    /// contacts of two dynamic bodies.
    least_separations: [f64; 2],
}

impl Deref for ContactRows {
    type Target = ConstraintRows;

    #[inline(always)]
    fn deref(&self) -> &ConstraintRows {
        &self.rows
    }
}

impl DerefMut for ContactRows {
    #[inline(always)]
    fn deref_mut(&mut self) -> &mut ConstraintRows {
        &mut self.rows
    }
}

impl ContactRows {
    /// Returns the rows of a contact constraint of the iterative solver. `substeps` is the number of substeps per step: the
    /// stored impulses are those of one substep. The velocity errors contain the surface velocity of belts only.
    #[inline(always)]
    pub(super) fn new(row: &ParkedConstraint, substeps: f64, bodies: BodyIndices) -> Self {
        let constraint = &row.constraint;
        let [one, two] = &constraint.points;
        let is_there = |at: usize| constraint.points[at].normal_mass > 0.0;
        let present = u8::from(is_there(0)) | u8::from(is_there(1)) << 1 | 1 << FRICTION;
        let mut rows = ConstraintRows::new(
            bodies,
            Jacobian::of_contact(constraint),
            present,
            step_impulses(row, substeps),
        );
        rows.effective_masses = [one.normal_mass, two.normal_mass, constraint.tangent_mass].map(f64::from);
        rows.velocity_error = [0.0, 0.0, -f64::from(constraint.tangent_speed)];
        rows.driven_velocity_error = rows.velocity_error;
        ContactRows {
            rows,
            friction: f64::from(constraint.friction),
            friction_limit: 0.0,
            separations: [one.separation, two.separation].map(f64::from),
            corrections: [0.0; 2],
            prescribed_velocity: [0.0; 3],
            least_separations: [f64::NEG_INFINITY; 2],
        }
    }

    /// Adds the velocity of a kinematic body A (length units/s, length units/s, radians/s) to the velocity errors.
    #[inline(always)]
    pub(super) fn add_prescribed_velocity(&mut self, velocity: Vec3) {
        self.prescribed_velocity = self.jacobian.relative_velocities(velocity, [0.0; 3]);
        (0..3).for_each(|row| self.velocity_error[row] += self.prescribed_velocity[row]);
        self.driven_velocity_error = self.velocity_error;
    }

    /// Adds the relative velocities by the velocities of the island's members to the velocity errors. A point with a positive
    /// separation is a speculative contact: it may approach at (separation - `slop`) * `inverse_dt`, and no faster.
    /// `inverse_dt` in 1/s, `slop` in length units.
    #[inline(never)]
    pub(super) fn add_relative_velocity(&mut self, members: &Members, inverse_dt: f64, slop: f64) {
        let velocity = self.relative_velocities_of(|member| members[member].velocity);
        (0..3).for_each(|row| self.velocity_error[row] += velocity[row]);
        for row in 0..2 {
            self.velocity_error[row] += allowed_approach_speed(self.separations[row], slop, inverse_dt);
        }
    }

    /// Advances the separations by `dt` seconds of the present velocities of `members`. Returns the penetration of the deepest
    /// point that takes part in position correction, in length units; 0 if there is none. [`is_corrected`](Self::is_corrected)
    /// has the meaning of `slop`.
    #[inline(never)]
    pub(super) fn advance_separations(&mut self, members: &Members, dt: f64, slop: f64) -> f64 {
        let velocity = self.relative_velocities_of(|member| members[member].velocity);
        let mut deepest = 0.0;
        for (row, velocity) in velocity.into_iter().enumerate().take(2) {
            self.separations[row] += dt * (velocity + self.prescribed_velocity[row]);
            if self.is_corrected(row, slop) && -self.separations[row] > deepest {
                deepest = -self.separations[row];
            }
        }
        deepest
    }

    /// Returns `impulse` clamped to -`friction_limit`..=`friction_limit`, mass units * length units/s; NaN stays NaN.
    pub(super) fn clamp_friction(&self, impulse: f64) -> f64 {
        clamp_magnitude(self.friction_limit, impulse)
    }

    /// Returns the velocity residual: the greatest velocity by which a row violates Signorini's or Coulomb's law, length
    /// units/s. For a point with an impulse it is the velocity error, else the approach velocity. For friction it is the slip
    /// that the friction limit does not explain.
    #[inline(never)]
    pub(super) fn residual(&self) -> f64 {
        let mut worst = self.normal_residual();
        let mut note = |velocity: f64| worst = if velocity.abs() <= worst { worst } else { velocity.abs() };
        let (mass, impulse) = (self.effective_masses[FRICTION], self.impulses[FRICTION]);
        if mass > 0.0 {
            let unbounded = impulse - mass * self.velocity_error[FRICTION];
            let limited = clamp_magnitude(self.coulomb_limit(), unbounded);
            note(if limited == unbounded {
                self.velocity_error[FRICTION]
            } else {
                (limited - impulse) / mass
            });
        }
        worst
    }

    /// Returns the velocity residual of the two contact points without friction: the greatest velocity by which one violates
    /// Signorini's law, length units/s.
    #[inline(always)]
    pub(super) fn normal_residual(&self) -> f64 {
        let mut worst = 0.0;
        let mut note = |velocity: f64| worst = if velocity.abs() <= worst { worst } else { velocity.abs() };
        for row in 0..2 {
            let (mass, impulse, error) =
                (self.effective_masses[row], self.impulses[row], self.velocity_error[row]);
            if impulse > mass * error {
                note(error);
            } else if impulse > 0.0 {
                note(impulse / mass);
            }
        }
        worst
    }

    /// Returns initial impulses (mass units * length units/s) and active set of the first Newton step. With a warm start each
    /// point with an impulse is active, and friction below its limit sticks.
    ///
    /// On a cold start each point that will touch is active and sticks. Otherwise one contact after the other would enter the
    /// set, and a column would need a Newton step per body.
    pub(super) fn initial_active_set(&self, is_cold_start: bool) -> (Vec3, RowMask) {
        let is_pressed =
            |row: usize| if is_cold_start { self.will_touch(row) } else { self.multipliers[row] > 0.0 };
        let free: Vec3 =
            std::array::from_fn(|row| self.multipliers[row] - self.stiffness[row] * self.velocity_error[row]);
        let (mut impulses, mut active) = ([0.0; 3], 0);
        for row in (0..2).filter(|&row| is_pressed(row)) {
            impulses[row] = free[row];
            active |= 1 << row;
        }
        let sticks = self.friction_limit > 0.0 && self.multipliers[FRICTION].abs() < self.friction_limit;
        impulses[FRICTION] =
            if sticks { free[FRICTION] } else { self.clamp_friction(self.multipliers[FRICTION]) };
        (impulses, active | u8::from(sticks) << FRICTION)
    }

    /// Returns the friction limit of the first active set on a cold start: infinite if a point of the contact will touch, else
    /// 0. Unit: mass units * length units/s.
    pub(super) fn unbounded_if_near(&self) -> f64 {
        let is_near = self.will_touch(0) || self.will_touch(1);
        if is_near && self.friction > 0.0 { f64::INFINITY } else { 0.0 }
    }

    /// Returns whether contact point `row` (0 or 1) exists and touches within the step: its velocity error is 0 or less.
    fn will_touch(&self, row: usize) -> bool {
        self.has_row(row) && self.velocity_error[row] <= 0.0
    }

    /// Returns the friction limit moved by `fraction` (0..=1) towards [`coulomb_limit`](Self::coulomb_limit). An infinite
    /// friction limit moves all the way. Unit: mass units * length units/s.
    ///
    /// Under-relaxation keeps the iteration from oscillating when friction and normal impulses raise each other.
    pub(super) fn relax_friction_limit(&self, fraction: f64) -> f64 {
        let bounded = self.coulomb_limit();
        if self.friction_limit.is_finite() {
            self.friction_limit + fraction * (bounded - self.friction_limit)
        } else {
            bounded
        }
    }

    /// Returns the friction limit of the first round with a warm start, mass units * length units/s: friction coefficient * sum
    /// of the normal impulses. If that sum is 0, it takes the impulses that would stop the approach at each point by itself.
    pub(super) fn initial_friction_limit(&self) -> f64 {
        let meets =
            (0..2).map(|row| (-self.velocity_error[row] * self.effective_masses[row]).max(0.0)).sum::<f64>();
        let presses = self.impulses[0] + self.impulses[1];
        self.friction * if presses == 0.0 { meets } else { presses }
    }

    /// Returns whether contact point `row` (0 or 1) takes part in position correction: it has an impulse, or its penetration
    /// exceeds [`UNLOADED_POINT_DEPTH`] times `slop`. `slop` is the penetration that remains uncorrected, length units.
    #[inline(always)]
    pub(super) fn is_corrected(&self, row: usize, slop: f64) -> bool {
        self.has_row(row) && is_penetration_corrected(self.impulses[row] > 0.0, self.separations[row], slop)
    }

    /// Selects the active set of a position correction, and the separation that it demands of each point in it.
    ///
    /// The separation is `min_correction` plus the fraction `resolved_fraction` (0..=1) of the penetration, or of
    /// `max_correction` if that is less. It is at most the penetration. Lengths in length units. `slop` is the penetration that
    /// remains uncorrected.
    pub(super) fn select_corrected_rows(
        &mut self,
        slop: f64,
        [max_correction, min_correction]: [f64; 2],
        resolved_fraction: f64,
    ) {
        let deep = [0, 1].map(|row| self.is_corrected(row, slop));
        self.active_rows = u8::from(deep[0]) | u8::from(deep[1]) << 1;
        let sticks = self.active_rows != 0 && self.impulses[FRICTION].abs() < self.friction_limit;
        self.active_rows |= u8::from(sticks) << FRICTION;
        self.corrections = std::array::from_fn(|row| {
            let depth = (-self.separations[row]).max(0.0);
            let correction = min_correction
                + resolved_fraction * if depth < max_correction { depth } else { max_correction };
            match deep[row] {
                true if correction < depth => correction,
                true => depth,
                false => 0.0,
            }
        });
    }

    /// Sets the separations below which joints must not press the points in this step: the penetration `depth`. Points that are
    /// deeper at its start separate by `min_correction`. Lengths in length units, >= 0.
    pub(super) fn set_least_separations(&mut self, depth: f64, min_correction: f64) {
        self.least_separations = self.separations.map(|separation| (separation + min_correction).min(-depth));
    }

    /// Adds the points that are pressed too deep to the active set of a position correction: after the `changes` of their
    /// separations they are below their least separations by more than `slop`. They are to end there, without friction. Lengths
    /// in length units. Returns whether there are any.
    pub(super) fn hold_pressed_points(&mut self, changes: Vec3, slop: f64) -> bool {
        let pressed = [0, 1].map(|row| self.is_pressed(row, changes[row], slop));
        for row in (0..2).filter(|&row| pressed[row]) {
            self.corrections[row] = self.least_separations[row] - self.separations[row];
            self.active_rows = (self.active_rows | 1 << row) & !(1 << FRICTION);
        }
        pressed != [false; 2]
    }

    /// Returns whether a change of its separation presses the contact point `row` (0 or 1) below its least separation by more
    /// than `slop`, or leaves it there. Lengths in length units.
    #[inline(always)]
    pub(super) fn is_pressed(&self, row: usize, change: f64, slop: f64) -> bool {
        self.has_row(row) && self.separations[row] + change < self.least_separations[row] - slop
    }

    /// Returns the impulses of the rows that separate the points by their corrections. As the linear system is solved for
    /// displacements, the unit is mass units * length units.
    pub(super) fn correction_impulses(&self) -> Vec3 {
        let [one, other] = [0, 1].map(|row| self.stiffness[row] * self.corrections[row]);
        [one, other, 0.0]
    }

    /// Returns Coulomb's friction limit: friction coefficient * sum of the normal impulses, in mass units * length units/s.
    #[inline(always)]
    pub(super) fn coulomb_limit(&self) -> f64 {
        self.friction * (self.impulses[0] + self.impulses[1])
    }
}

impl Constraint for ContactRows {
    #[inline(always)]
    fn project_impulses(&self, velocity_error: Vec3) -> (Vec3, RowMask) {
        let [one, two, along]: Vec3 =
            std::array::from_fn(|row| self.multipliers[row] - self.stiffness[row] * velocity_error[row]);
        let (first, second, sticks) = (one > 0.0, two > 0.0, along.abs() <= self.friction_limit);
        let impulses = [
            if first { one } else { 0.0 },
            if second { two } else { 0.0 },
            clamp_magnitude(self.friction_limit, along),
        ];
        let is_bounded = sticks & (self.friction_limit > 0.0);
        (impulses, u8::from(first) | u8::from(second) << 1 | u8::from(is_bounded) << FRICTION)
    }

    /// Returns whether rows at a bound keep that bound. A contact point at its bound always has impulse 0, so only sliding
    /// friction can change its bound, when it reverses: the result is whether friction sticks or its impulse is unchanged.
    #[inline(always)]
    fn keeps_bounds(&self, impulses: Vec3, active: RowMask) -> bool {
        active >> FRICTION & 1 == 1 || impulses[FRICTION] == self.impulses[FRICTION]
    }

    fn solve_row(&mut self, row: usize, velocity_error: f64) -> Vec3 {
        let unbounded = self.impulses[row] - self.effective_masses[row] * velocity_error;
        self.friction_limit = self.coulomb_limit();
        let impulse = if row == FRICTION { self.clamp_friction(unbounded) } else { positive_part(unbounded) };
        let mut change = [0.0; 3];
        change[row] = impulse - self.impulses[row];
        self.impulses[row] = impulse;
        change
    }
}

/// Returns the impulses of a stored contact constraint over the whole step: of point 0, of point 1 and of friction, mass units
/// * length units/s. The stored impulses are those of one of `substeps` substeps. A point that does not exist has impulse 0.
#[inline(always)]
pub(super) fn step_impulses(row: &ParkedConstraint, substeps: f64) -> Vec3 {
    let [one, two, along] = row.impulses().map(|impulse| impulse * substeps);
    let of_point =
        |at: usize, impulse: f64| if row.constraint.points[at].normal_mass > 0.0 { impulse } else { 0.0 };
    [of_point(0, one), of_point(1, two), along]
}

/// Returns the greatest speed at which a speculative contact may approach, length units/s: (separation - slop) * `inverse_dt`,
/// at least 0. Lengths in length units, `inverse_dt` in 1/s.
#[inline(always)]
pub(super) fn allowed_approach_speed(separation: f64, slop: f64, inverse_dt: f64) -> f64 {
    let gap = separation - slop;
    if gap > 0.0 { gap * inverse_dt } else { 0.0 }
}

/// Returns whether a contact point takes part in position correction: it has an impulse (`is_loaded`), or its penetration
/// exceeds [`UNLOADED_POINT_DEPTH`] times `slop`. Lengths in length units.
#[inline(always)]
pub(super) fn is_penetration_corrected(is_loaded: bool, separation: f64, slop: f64) -> bool {
    is_loaded | (separation < -UNLOADED_POINT_DEPTH * slop)
}

/// Returns `impulse` clamped to -`bound`..=`bound`, in the unit of both. NaN stays NaN: its sign depends on the processor.
#[inline(always)]
fn clamp_magnitude(bound: f64, impulse: f64) -> f64 {
    if impulse.abs() <= bound || impulse.is_nan() { impulse } else { bound.copysign(impulse) }
}
