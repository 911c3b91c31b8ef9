//! Warm start of contacts: the accumulated impulses of the last step act again in each substep.

use super::load_adaptation::{adapt_load, adapt_load_with_joints};
use super::pair_velocities::{load_velocities, magnitude};
use super::restitution::record_approach_velocity;
use crate::bodies::MotionState;
use crate::constraint_graph::{ColorSet, ContactConstraintSimd, ContactPointSimd};
use crate::index::{BodyIndex, DenseIndex};
use crate::scaled_parameters::LoadAdaptation;
use wide::f32x4;

const ZERO: f32x4 = f32x4::ZERO;

/// Warm start: adds to `warm_start` of each body the velocity change per substep by the accumulated impulses of its contacts:
/// x, y (length units/s), angular velocity (radians/s), 0. Runs load adaptation before it. `masks`: for each body all bits set
/// if it has joints in the iterative solver, else 0; `None` if no body has.
///
/// With a `restitution_threshold` (length units/s) the constraints with restitution also store their approach velocities and
/// separations. Returns whether a point of them approaches faster than the threshold.
#[inline(always)]
pub(crate) fn accumulate_warm_start<const FIXED: bool, const P: usize>(
    constraints: &mut ColorSet<ContactConstraintSimd<P>>,
    warm_start: &mut [[f32; 4]],
    states: &[MotionState],
    (adaptation, masks): (&LoadAdaptation, Option<&[u32]>),
    restitution_threshold: Option<f32>,
) -> bool {
    let mut may_bounce = false;
    constraints.for_each(|constraint| {
        let pair_velocities = load_velocities::<FIXED, P>(constraint, states);
        if let Some(threshold) = restitution_threshold {
            may_bounce |= record_approach_velocity::<FIXED, P, _>(constraint, &pair_velocities, threshold);
        }
        let slip = pair_velocities.relative_tangent_velocity::<FIXED, P>(constraint)
            + pair_velocities
                .relative_angular_velocity::<FIXED>(constraint.tangent_arm_a, constraint.tangent_arm_b);
        let speed = magnitude(slip - constraint.tangent_speed);
        match masks {
            None => adapt_load::<FIXED, P, _>(constraint, &pair_velocities, speed, adaptation),
            Some(masks) => {
                adapt_load_with_joints::<FIXED, P, _>(constraint, &pair_velocities, speed, adaptation, masks)
            }
        }
        add_impulses::<FIXED, P>(constraint, warm_start);
    });
    may_bounce
}

/// Adds to `warm_start` of both bodies of each lane the velocity changes by the impulses of a block of constraints in the plane:
/// x, y (length units/s), angular velocity (radians/s), 0.
#[inline(always)]
fn add_impulses<const FIXED: bool, const P: usize>(
    constraint: &ContactConstraintSimd<P>,
    warm_start: &mut [[f32; 4]],
) {
    let sum = |of: fn(&ContactPointSimd) -> f32x4| {
        constraint.points[1..].iter().fold(of(&constraint.points[0]), |sum, point| sum + of(point))
    };
    let along = sum(|point| point.normal_impulse);
    let turn_a = sum(|point| point.normal_impulse * point.normal_arm_a)
        + constraint.tangent_impulse * constraint.tangent_arm_a;
    let turn_b = sum(|point| point.normal_impulse * point.normal_arm_b)
        + constraint.tangent_impulse * constraint.tangent_arm_b;
    let x = along * constraint.normal_x + constraint.tangent_impulse * constraint.normal_y;
    let y = along * constraint.normal_y - constraint.tangent_impulse * constraint.normal_x;
    if !FIXED {
        let (mass, inertia) = (ZERO - constraint.inverse_mass_a, ZERO - constraint.inverse_inertia_a);
        add_columns(warm_start, &constraint.a, [mass * x, mass * y, inertia * turn_a, ZERO]);
    }
    let (mass, inertia) = (constraint.inverse_mass_b, constraint.inverse_inertia_b);
    add_columns(warm_start, &constraint.b, [mass * x, mass * y, inertia * turn_b, ZERO]);
}

/// Adds four columns, one lane for each of four bodies, to the rows of these bodies.
#[inline(always)]
pub(crate) fn add_columns(rows: &mut [[f32; 4]], bodies: &[BodyIndex; 4], columns: [f32x4; 4]) {
    for (&body, change) in bodies.iter().zip(f32x4::transpose(columns)) {
        let sum = &mut rows[body.position()];
        *sum = (f32x4::new(*sum) + change).to_array();
    }
}
