//! Operations of a Newton step and its line search on a list of constraints, either contacts or joints.
//!
//! The line search goes along the Newton direction d from the present velocity change x. The functions here sum up derivatives
//! of the augmented Lagrangian along that line; [`island_newton`](super::island_newton) adds the terms of the masses.

use super::constraint::{Constraint, FIXED, Jacobian};
use super::island_body::{MemberIndex, MemberVectors, add, max_magnitude};
use super::mat3::Vec3;

/// Adds the `impulses` of the rows of one constraint, as impulses on its two bodies, to `impulse_sums`. There is one sum per
/// member of the island: x, y (mass units * length units/s) and angular (mass units * length units^2/s).
#[inline(always)]
pub(super) fn add_constraint_impulses(
    jacobian: &Jacobian,
    bodies: [MemberIndex; 2],
    impulses: Vec3,
    impulse_sums: &mut MemberVectors,
) {
    for (member, impulse) in bodies.into_iter().zip(jacobian.body_impulses(impulses)) {
        if member != FIXED {
            add(&mut impulse_sums[member], impulse);
        }
    }
}

/// Adds the changes of all row impulses since the beginning of the solution, as impulses on bodies, to `impulse_sums`. There is
/// one sum per member of the island: x, y (mass units * length units/s) and angular (mass units * length units^2/s).
#[inline(never)]
pub(super) fn add_impulse_changes<C: Constraint>(constraints: &[C], impulse_sums: &mut MemberVectors) {
    for rows in constraints {
        let impulses = std::array::from_fn(|row| rows.impulses[row] - rows.initial_impulses[row]);
        add_constraint_impulses(&rows.jacobian, rows.bodies, impulses, impulse_sums);
    }
}

/// Adds to the velocity errors of all rows the relative velocities that `changes` make: velocity changes of the island's
/// members in length units/s, length units/s, radians/s.
pub(super) fn add_velocity_changes<C: Constraint>(constraints: &mut [C], changes: &MemberVectors) {
    for rows in constraints {
        let change = rows.relative_velocities_in(changes);
        add(&mut rows.velocity_error, change);
    }
}

/// Moves the velocity errors of all rows by `fraction` of the last Newton direction (dimensionless, may be negative), and
/// projects the impulses onto their bounds again.
#[inline(always)]
pub(super) fn step_all_along<C: Constraint>(constraints: &mut [C], fraction: f64) {
    for rows in constraints {
        (0..3).for_each(|row| rows.velocity_error[row] += fraction * rows.error_change[row]);
        rows.apply_projection();
    }
}

/// Takes the full Newton step along `direction` (velocity changes of the island's members) on all constraints, and continues
/// three results. The first tells whether the active set stays the same. The second is the greatest change of a velocity error,
/// with radians/s counted as length units/s. The third is the derivative of the augmented Lagrangian along the direction at the
/// end of the step, mass units * length units^2/s^2.
#[inline(always)]
pub(super) fn evaluate_all_full_step<C: Constraint>(
    constraints: &mut [C],
    direction: &MemberVectors,
    (mut is_same, mut greatest, mut slope): (bool, f64, f64),
) -> (bool, f64, f64) {
    for rows in constraints {
        rows.error_change = rows.relative_velocities_in(direction);
        (0..3).for_each(|row| rows.velocity_error[row] += rows.error_change[row]);
        let (impulses, active) = rows.project_impulses(rows.velocity_error);
        is_same &= active == rows.active_rows && rows.keeps_bounds(impulses, active);
        rows.impulses = impulses;
        greatest = rows.error_change.iter().fold(greatest, |max, change| max_magnitude(change.abs(), max));
        slope -= (0..3)
            .map(|row| rows.error_change[row] * (impulses[row] - rows.initial_impulses[row]))
            .sum::<f64>();
    }
    (is_same, greatest, slope)
}

/// Adds the terms of `constraints` to the first and second derivative of the augmented Lagrangian along the Newton direction,
/// both in mass units * length units^2/s^2. The derivatives are those at `fraction` of the Newton step (0 = start, 1 = full
/// step). The velocity errors of the rows must be those after the full step.
#[inline(always)]
pub(super) fn add_derivatives<C: Constraint>(
    constraints: &[C],
    fraction: f64,
    (mut slope, mut curvature): (f64, f64),
) -> (f64, f64) {
    for rows in constraints {
        let excess =
            std::array::from_fn(|row| rows.velocity_error[row] + (fraction - 1.0) * rows.error_change[row]);
        let (impulses, active) = rows.project_impulses(excess);
        for (row, change) in rows.error_change.into_iter().enumerate() {
            slope -= change * (impulses[row] - rows.initial_impulses[row]);
            let stiffness = if active >> row & 1 == 1 { rows.stiffness[row] } else { 0.0 };
            curvature += stiffness * change * change;
        }
    }
    (slope, curvature)
}
