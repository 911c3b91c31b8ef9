//! Angle limit joint: two bodies whose relative angle stays in a range (behaviour chapter 10, section 8).

use serde::{Deserialize, Serialize};

use crate::body::missing_body::missing_body_id;
use crate::body::{Body, BodyId};
use crate::checked_properties::checked_properties;
use crate::error::Result;
use crate::joints::bodies::two_bodies;
use crate::joints::joint_body::{JointBodies, JointPose, JointStep};
use crate::joints::limit::{Limit, range_properties};
use crate::joints::{DEFAULT_SLOP, Joint, JointKind};
use crate::math::finite::finite;

/// Holds the difference of two bodies' total rotations in a range. The bodies may move freely otherwise.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct AngleLimitJoint {
    body1: BodyId,
    body2: BodyId,
    lower_limit: f32,
    upper_limit: f32,
    slop: f32,
    limit: Limit,
    /// Whether setters refuse a range that ends before it begins. Set whenever the joint is borrowed for edits.
    #[serde(skip)]
    refuses_reversed: bool,
    #[serde(with = "crate::storage::bits")]
    velocity_bias: f32,
    #[serde(with = "crate::storage::bits")]
    mass_factor: f32,
}

impl AngleLimitJoint {
    pub(crate) fn new(
        body1: (BodyId, &Body),
        body2: (BodyId, &Body),
        lower_limit: f32,
        upper_limit: f32,
    ) -> Result<Joint> {
        Ok(Joint::of(JointKind::AngleLimit(AngleLimitJoint {
            body1: body1.0,
            body2: body2.0,
            lower_limit: finite("lower_limit", lower_limit)?,
            upper_limit: finite("upper_limit", upper_limit)?,
            ..AngleLimitJoint::without_bodies()
        })))
    }

    pub(crate) fn without_bodies() -> Self {
        AngleLimitJoint {
            body1: missing_body_id(),
            body2: missing_body_id(),
            lower_limit: 0.0,
            upper_limit: 0.0,
            slop: DEFAULT_SLOP,
            limit: Limit::default(),
            refuses_reversed: false,
            velocity_bias: 0.0,
            mass_factor: 0.0,
        }
    }

    two_bodies! {}

    range_properties! {
        /// Minimum of the second body's total rotation minus that of the first, in radians.
        #[doc(alias = "LowerLimit")]
        lower_limit, set_lower_limit;
        /// Maximum of the second body's total rotation minus that of the first, in radians.
        #[doc(alias = "UpperLimit")]
        upper_limit, set_upper_limit;
        set_limits
    }

    checked_properties! {
        /// Violation in radians up to which the angle is not corrected; the velocity is. Default 0.01.
        #[doc(alias = "Slop")]
        slop, set_slop;
    }

    pub(crate) fn pre_step(
        &mut self,
        step: JointStep,
        poses: &[JointPose; 2],
        bodies: &mut JointBodies,
    ) -> f32 {
        let difference = poses[1].total_rotation - poses[0].total_rotation;
        let error = self.limit.update(difference, self.lower_limit, self.upper_limit, self.slop);
        self.velocity_bias = step.bias_factor * step.inverse_dt * error;
        self.mass_factor =
            1.0 / (step.softness + bodies.first().inverse_inertia + bodies.second().inverse_inertia);
        apply_angular_impulses(bodies, self.limit.accumulated);
        error
    }

    pub(crate) fn solve(&mut self, softness: f32, bodies: &mut JointBodies) -> bool {
        if !self.limit.is_violated() {
            return false;
        }
        let relative = bodies.second().angular_velocity - bodies.first().angular_velocity;
        let wanted = -(self.velocity_bias + relative + softness * self.limit.accumulated);
        let impulse = self.limit.accumulate(wanted * self.mass_factor);
        if impulse == 0.0 {
            return false;
        }
        apply_angular_impulses(bodies, impulse);
        true
    }

    pub(crate) fn forget_impulse(&mut self) {
        self.limit = Limit::default();
    }

    pub(crate) fn impulse_is_finite(&self) -> bool {
        self.limit.accumulated.is_finite()
    }

    pub(crate) fn is_valid(&self) -> bool {
        [self.lower_limit, self.upper_limit, self.slop].iter().all(|number| number.is_finite())
    }
}

#[inline]
fn apply_angular_impulses(bodies: &mut JointBodies, impulse: f32) {
    let first = bodies.first_mut();
    first.angular_velocity -= first.inverse_inertia * impulse;
    let second = bodies.second_mut();
    second.angular_velocity += second.inverse_inertia * impulse;
}
