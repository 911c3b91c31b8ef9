//! Operations of a Newton step on a list of constraints, contacts or joints.

use super::block::Triple;
use super::constraint::{Constraint, FIXED, Jacobian};
use super::island::{add, greater};

/// Adds what the impulses of a constraint do to members.
#[inline(always)]
pub(super) fn add_push(jacobian: &Jacobian, bodies: [u32; 2], impulses: Triple, pushes: &mut [Triple]) {
    for (member, push) in bodies.into_iter().zip(jacobian.push(impulses)) {
        if member != FIXED {
            add(&mut pushes[member as usize], push);
        }
    }
}

/// Adds what impulses have changed for members since the step began.
#[inline(never)]
pub(super) fn add_changes<C: Constraint>(constraints: &[C], pushes: &mut [Triple]) {
    for rows in constraints {
        let impulses = std::array::from_fn(|row| rows.impulses[row] - rows.begun[row]);
        add_push(&rows.jacobian, rows.bodies, impulses, pushes);
    }
}

/// Velocity errors take in these changes of members' velocities.
pub(super) fn add_velocities<C: Constraint>(constraints: &mut [C], changes: &[Triple]) {
    for rows in constraints {
        let change = rows.relative_in(changes);
        add(&mut rows.excess, change);
    }
}

/// Goes along the last direction by this part.
#[inline(always)]
pub(super) fn follow<C: Constraint>(constraints: &mut [C], part: f64) {
    for rows in constraints {
        (0..3).for_each(|row| rows.excess[row] += part * rows.change[row]);
        rows.obey();
    }
}

/// Goes the whole way: adds to whether the active set stays the same, the greatest change of a row, and the slope there.
#[inline(always)]
pub(super) fn try_whole<C: Constraint>(
    constraints: &mut [C],
    direction: &[Triple],
    (mut is_same, mut greatest, mut slope): (bool, f64, f64),
) -> (bool, f64, f64) {
    for rows in constraints {
        rows.change = rows.relative_in(direction);
        (0..3).for_each(|row| rows.excess[row] += rows.change[row]);
        let (impulses, active) = rows.law(rows.excess);
        is_same &= active == rows.active && rows.keeps_bounds(impulses, active);
        rows.impulses = impulses;
        greatest = rows.change.iter().fold(greatest, |most, change| greater(change.abs(), most));
        slope -= (0..3).map(|row| rows.change[row] * (impulses[row] - rows.begun[row])).sum::<f64>();
    }
    (is_same, greatest, slope)
}

/// Adds to slope and curvature at a part of the way, from its end on.
#[inline(always)]
pub(super) fn slope<C: Constraint>(
    constraints: &[C],
    part: f64,
    (mut slope, mut curvature): (f64, f64),
) -> (f64, f64) {
    for rows in constraints {
        let excess = std::array::from_fn(|row| rows.excess[row] + (part - 1.0) * rows.change[row]);
        let (impulses, active) = rows.law(excess);
        for (row, change) in rows.change.into_iter().enumerate() {
            slope -= change * (impulses[row] - rows.begun[row]);
            let stiffness = if active >> row & 1 == 1 { rows.stiffness[row] } else { 0.0 };
            curvature += stiffness * change * change;
        }
    }
    (slope, curvature)
}
