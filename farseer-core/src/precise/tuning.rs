//! Parameters in the user's units, and those of one step; their values are in [`parameters`](super::parameters).
//!
//! Six of them are Box2D 3.2's (E. Catto; `constants.h` and `b2DefaultWorldDef` in `types.c`), as fractions of a length unit
//! that stands for Box2D's metre. So is the doubled frequency of contacts with static bodies (`staticSoftness` in
//! `physics_world.c`). Box2D's contact frequency is 30 Hz and at most an eighth of the substep rate, its limit of the margin an
//! eighth of the extent.

use crate::precise::parameters::broad_phase::{
    AABB_MARGIN, AABB_MARGIN_PER_SIZE, AABB_REACH_PER_SIZE, AABB_STEPS_AHEAD, COLLISION_RANGE,
    UNPAIRED_AABB_REACH_PER_SIZE, UNPAIRED_AABB_STEPS_AHEAD,
};
use crate::precise::parameters::contacts::{
    CONTACT_DAMPING_RATIO, CONTACT_FREQUENCY, GREATEST_SAG, JOINTED_CONTACT_FREQUENCY,
    JOINTED_CONTACT_FREQUENCY_PER_RATE, LOAD_ADAPTATION_SPEED, LOAD_FALL_PER_STEP, LOAD_LEFT_ON_SPRING,
    LOAD_RISE_PER_STEP, PENETRATION_RECOVERY_SPEED, RECYCLING_DISTANCE, RESTITUTION_THRESHOLD,
    SEPARATION_REFRESH_DISTANCE, SPECULATIVE_DISTANCE, SUBSTEPS_PER_CONTACT_PERIOD,
};
use serde::{Deserialize, Serialize};
use wide::f32x4;

/// Parameters of contacts, in the user's units. They are fractions of [`Methods::Precise`](crate::Methods)' `length_unit`, the
/// size of things that a player looks at: a metre of a game in metres, 32 px of one in px.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) struct Tuning {
    /// The length unit, > 0.
    pub(crate) unit: f32,
    /// Speculative distance, length units: shapes nearer than this have contact points, so that they do not penetrate.
    pub(crate) speculative: f32,
    /// Margin of AABBs in the broad phase, length units.
    pub(crate) margin: f32,
    /// Relative motion of a pair, length units, below which its manifold is recycled.
    pub(crate) frozen: f32,
    /// Motion of a body, length units, after which the separations of its contacts are computed again.
    pub(crate) checked: f32,
    /// Relative speed at a contact, length units/s, from which on its spring does not learn its load.
    pub(crate) gate: f32,
    /// Greatest speed at which penetration is resolved, length units/s.
    pub(crate) push: f32,
    /// Restitution threshold, length units/s: slower approaches do not bounce.
    pub(crate) bounce: f32,
}

impl Tuning {
    /// For things of about this size.
    pub(crate) fn new(unit: f32) -> Self {
        Tuning {
            unit,
            speculative: SPECULATIVE_DISTANCE * unit,
            margin: AABB_MARGIN * unit,
            frozen: RECYCLING_DISTANCE * unit,
            checked: SEPARATION_REFRESH_DISTANCE * unit,
            gate: LOAD_ADAPTATION_SPEED * unit,
            push: PENETRATION_RECOVERY_SPEED * unit,
            bounce: RESTITUTION_THRESHOLD * unit,
        }
    }

    /// Margins of the AABB of a proxy that reaches this far from its centre, length units.
    pub(super) fn widening(&self, reach: f32) -> Widening {
        let by_size = AABB_MARGIN_PER_SIZE * reach;
        let margin = if by_size < self.margin { by_size } else { self.margin };
        Widening { margin, near: AABB_REACH_PER_SIZE * reach, lonely: 0.0 }
    }

    /// The same for a proxy without pairs: a longer look ahead saves searches of the broad phase, and makes no pairs while
    /// nothing is near.
    pub(super) fn widening_of_lonely(&self, reach: f32) -> Widening {
        Widening { lonely: UNPAIRED_AABB_REACH_PER_SIZE * reach, ..self.widening(reach) }
    }

    /// Sums of motion count in multiples of 2^-26 length units, and wrap.
    pub(crate) fn motion_scale(&self) -> f32 {
        67_108_864.0 / self.unit
    }
}

/// How far the fat AABB of a proxy reaches beyond its tight one, so that it does not change in every step. Length units.
#[derive(Debug, Clone, Copy)]
pub(super) struct Widening {
    /// To all sides.
    pub(super) margin: f32,
    /// Limit of the look ahead by more than the motion of the next step.
    near: f32,
    /// Limit of the longer look ahead of a proxy without pairs.
    lonely: f32,
}

impl Widening {
    /// How far the AABB reaches ahead along an axis on which the proxy moves by `way` in a step, length units.
    pub(super) fn ahead(&self, way: f32) -> f32 {
        let within = |steps: f32, limit: f32| (way * steps).clamp(-limit, limit);
        let (near, far) =
            (within(AABB_STEPS_AHEAD, self.near), within(UNPAIRED_AABB_STEPS_AHEAD, self.lonely));
        let longest = |one: f32, other: f32| if other.abs() > one.abs() { other } else { one };
        longest(longest(way, near), far).clamp(-COLLISION_RANGE, COLLISION_RANGE)
    }
}

/// Parameters of one step.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Step {
    /// Seconds of the whole step.
    pub(super) dt: f32,
    /// Number of substeps, and seconds of each.
    pub(super) substeps: u32,
    pub(super) h: f32,
    /// Contacts of two dynamic bodies, and contacts with a static or kinematic one.
    pub(super) soft: Softness,
    pub(super) soft_fixed: Softness,
    /// The same for contacts of bodies with joints in the iterative solver.
    pub(super) soft_jointed: Softness,
    pub(super) soft_jointed_fixed: Softness,
    pub(super) learning: Learning,
}

/// Coefficients of a soft constraint: a spring with a damper, integrated implicitly over a substep of `h` seconds (E. Catto,
/// "Soft Constraints", GDC 2011). With frequency f, damping ratio z and omega = 2 pi f, the exact implicit step is
/// l' = l - mass (u + bias s) k - impulse l.
#[derive(Debug, Clone, Copy)]
pub(super) struct Softness {
    pub(super) bias: f32,
    pub(super) mass: f32,
    pub(super) impulse: f32,
}

impl Softness {
    fn new(frequency: f32, damping: f32, h: f32) -> Self {
        let omega = 2.0 * std::f32::consts::PI * frequency;
        let a1 = 2.0 * damping + h * omega;
        let a2 = h * omega * a1;
        let a3 = 1.0 / (1.0 + a2);
        Softness { bias: omega / a1, mass: a2 * a3, impulse: a3 }
    }

    /// For four contacts: bias times mass, mass and leak.
    pub(super) fn lanes(&self) -> [f32x4; 3] {
        [self.bias * self.mass, self.mass, self.impulse].map(f32x4::splat)
    }
}

/// How springs learn their load in a step.
#[derive(Debug, Clone, Copy)]
pub(super) struct Learning {
    pub(super) up: f32,
    pub(super) down: f32,
    /// Part of the load that the spring does not learn.
    pub(super) learnt: f32,
    pub(super) inverse_gate: f32,
    /// What is deeper than this in something, as a negative distance, does not learn.
    pub(super) deepest: f32,
    /// Speed in length units/s with which bodies of a contact leave each other after a blow, and no slower.
    pub(super) leaving: f32,
}

impl Step {
    pub(super) fn new(dt: f32, substeps: u32, tuning: &Tuning) -> Self {
        let h = dt / substeps as f32;
        let frequency = CONTACT_FREQUENCY.min(1.0 / (SUBSTEPS_PER_CONTACT_PERIOD * h));
        let beside_joints = JOINTED_CONTACT_FREQUENCY.min(JOINTED_CONTACT_FREQUENCY_PER_RATE / h);
        let steps = dt * 60.0;
        Step {
            dt,
            substeps,
            h,
            soft: Softness::new(frequency, CONTACT_DAMPING_RATIO, h),
            soft_fixed: Softness::new(2.0 * frequency, CONTACT_DAMPING_RATIO, h),
            soft_jointed: Softness::new(beside_joints, CONTACT_DAMPING_RATIO, h),
            soft_jointed_fixed: Softness::new(2.0 * beside_joints, CONTACT_DAMPING_RATIO, h),
            learning: Learning {
                up: (LOAD_RISE_PER_STEP * steps).min(1.0),
                down: (LOAD_FALL_PER_STEP * steps).min(1.0),
                learnt: 1.0 - LOAD_LEFT_ON_SPRING,
                inverse_gate: 1.0 / tuning.gate,
                leaving: tuning.bounce,
                deepest: -GREATEST_SAG * tuning.unit,
            },
        }
    }
}

impl Step {
    /// Softness of contacts of other bodies, and of bodies with joints in the iterative solver; with static and kinematic bodies, or
    /// between dynamic ones.
    pub(super) fn softness_beside_joints(&self, is_fixed: bool) -> [Softness; 2] {
        if is_fixed { [self.soft_fixed, self.soft_jointed_fixed] } else { [self.soft, self.soft_jointed] }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_in_no_pair_looks_far_ahead_but_not_farther_than_it_is_wide() {
        let tuning = Tuning::new(32.0);
        let (lonely, other) = (tuning.widening_of_lonely(10.0), tuning.widening(10.0));
        assert_eq!([0.5, 1.0, -1.0, 5.0].map(|way| other.ahead(way)), [2.0, 4.0, -4.0, 10.0]);
        assert_eq!([0.5, 1.0, -1.0, 5.0].map(|way| lonely.ahead(way)), [16.0, 20.0, -20.0, 20.0]);
        assert_eq!(lonely.margin, other.margin);
    }

    #[test]
    fn an_aabb_contains_the_way_of_the_next_step_however_fast_it_is() {
        let tuning = Tuning::new(32.0);
        let both = [tuning.widening_of_lonely(10.0), tuning.widening(10.0)];
        assert_eq!(both.map(|widening| widening.ahead(30.0)), [30.0; 2]);
        assert_eq!(both.map(|widening| widening.ahead(-30.0)), [-30.0; 2]);
    }
}
