//! Restitution of contacts, applied once after the substeps.

use super::pair_velocities::{
    PairVelocities, angular_impulses, load_velocities, normal_velocities, off_diagonal,
};
use super::soft_step::solve_two_point_block;
use crate::bodies::MotionState;
use crate::constraint_graph::{ColorSet, SimdContacts};
use crate::math::lanes::{positive, select};
use wide::f32x4;

const ZERO: f32x4 = f32x4::ZERO;

/// Stores the normal velocities and separations at the beginning of the step in a block of constraints with restitution, for
/// [`apply_restitution`]. Returns whether a point approaches faster than the restitution `threshold`, length units/s.
#[inline(always)]
pub(crate) fn record_approach_velocity<const FIXED: bool, const P: usize, R: SimdContacts<P>>(
    contacts: &mut R,
    pair_velocities: &PairVelocities,
    threshold: f32,
) -> bool {
    let bounces = contacts.constraint().restitution.simd_gt(ZERO);
    if bounces.to_bitmask() == 0 {
        return false;
    }
    let approach = normal_velocities::<FIXED, P, R>(contacts, pair_velocities);
    let constraint = contacts.constraint_mut();
    constraint.approach_velocity = approach;
    (constraint.initial_separation, constraint.was_active) =
        (constraint.points.map(|point| point.separation), [ZERO; P]);
    let threshold = f32x4::splat(-threshold);
    let may_bounce =
        approach.into_iter().fold(ZERO, |any, approach| any | (threshold.simd_gt(approach) & bounces));
    may_bounce.to_bitmask() != 0
}

/// Applies restitution after the step: points that approached faster than `threshold` (length units/s) and have had an impulse
/// get the velocity -restitution * approach velocity. Calls `on_bounce` with each block that has such points, the mask of the
/// lanes with such points, and `states`.
#[inline(always)]
pub(crate) fn apply_restitution<const FIXED: bool, const P: usize, R: SimdContacts<P>>(
    constraints: &mut ColorSet<R>,
    states: &mut [MotionState],
    threshold: f32,
    mut on_bounce: impl FnMut(&R, u32, &mut [MotionState]),
) {
    let threshold = f32x4::splat(-threshold);
    constraints.for_each(|contacts| {
        let constraint = contacts.constraint();
        let restitution = std::array::from_fn::<f32x4, P, _>(|at| {
            let is_due = threshold.simd_gt(constraint.approach_velocity[at]) & constraint.was_active[at];
            constraint.restitution & is_due
        });
        let due = restitution.iter().fold(0, |due, e| due | e.simd_gt(ZERO).to_bitmask());
        if due == 0 {
            return;
        }
        let mut pair_velocities = load_velocities::<FIXED, P>(constraint, states);
        let mut velocity = normal_velocities::<FIXED, P, R>(contacts, &pair_velocities);
        let constraint = contacts.constraint_mut();
        let coupling = off_diagonal::<FIXED, P>(constraint);
        let (mut sum, mut changes) = (ZERO, [ZERO; P]);
        let weights = std::array::from_fn(|at| constraint.points[at].normal_mass);
        let excess = |at: usize| velocity[at] + restitution[at] * constraint.approach_velocity[at];
        let losses = std::array::from_fn(|at| weights[at] * excess(at));
        let (is_block, both) = solve_two_point_block::<P, R>(constraint, coupling, &weights, &losses);
        let takes_block = restitution.iter().fold(is_block, |takes, e| takes & e.simd_gt(ZERO));
        for (at, restitution) in restitution.into_iter().enumerate() {
            let point = constraint.points[at];
            let wanted = velocity[at] + restitution * constraint.approach_velocity[at];
            let impulse =
                select(takes_block, both[at], positive(point.normal_impulse - point.normal_mass * wanted));
            changes[at] = (impulse - point.normal_impulse) & restitution.simd_gt(ZERO);
            constraint.points[at].normal_impulse = point.normal_impulse + changes[at];
            sum += changes[at];
            velocity[P - 1] += coupling * changes[at];
        }
        pair_velocities
            .apply_angular_impulses::<FIXED, P>(constraint, angular_impulses(constraint, &changes));
        pair_velocities.store_with_normal_impulse::<FIXED, P, R>(contacts, states, sum);
        on_bounce(contacts, due, states);
    });
}
