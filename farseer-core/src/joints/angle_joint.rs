//! Angle joint: two bodies at a fixed relative angle (behaviour chapter 10, section 6).

use serde::{Deserialize, Serialize};

use crate::body::missing_body::missing_body_id;
use crate::body::{Body, BodyId};
use crate::checked_properties::checked_properties;
use crate::error::Result;
use crate::joints::bodies::two_bodies;
use crate::joints::joint_body::{JointBodies, JointPose, JointStep};
use crate::joints::{Joint, JointKind};
use crate::math::finite::finite;
use crate::math::scalar;

/// Holds the difference of two bodies' total rotations at a target. The bodies may move freely otherwise.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct AngleJoint {
    body1: BodyId,
    body2: BodyId,
    target_angle: f32,
    max_impulse: f32,
    #[serde(with = "crate::storage::bits")]
    velocity_bias: f32,
    #[serde(with = "crate::storage::bits")]
    mass_factor: f32,
}

impl AngleJoint {
    pub(crate) fn new(body1: (BodyId, &Body), body2: (BodyId, &Body), target_angle: f32) -> Result<Joint> {
        Ok(Joint::of(JointKind::Angle(AngleJoint {
            body1: body1.0,
            body2: body2.0,
            target_angle: finite("target_angle", target_angle)?,
            ..AngleJoint::without_bodies()
        })))
    }

    pub(crate) fn without_bodies() -> Self {
        AngleJoint {
            body1: missing_body_id(),
            body2: missing_body_id(),
            target_angle: 0.0,
            max_impulse: f32::MAX,
            velocity_bias: 0.0,
            mass_factor: 0.0,
        }
    }

    two_bodies! {}

    checked_properties! {
        /// Target of the second body's total rotation minus that of the first, in radians. Default 0, whatever the
        /// angle was when the joint was made.
        #[doc(alias = "TargetAngle")]
        target_angle, set_target_angle;
        /// Maximum angular impulse of one solver iteration, in mass units · length units²/s; a negative one acts in the
        /// wrong direction. Default [`f32::MAX`].
        #[doc(alias = "MaxImpulse")]
        max_impulse, set_max_impulse;
    }

    pub(crate) fn pre_step(
        &mut self,
        step: JointStep,
        poses: &[JointPose; 2],
        bodies: &mut JointBodies,
    ) -> f32 {
        let error = poses[1].total_rotation - poses[0].total_rotation - self.target_angle;
        self.velocity_bias = step.correction() * error;
        let inverse_inertia = bodies.first().inverse_inertia + bodies.second().inverse_inertia;
        self.mass_factor = (1.0 - step.softness) / inverse_inertia;
        error
    }

    pub(crate) fn solve(&mut self, _softness: f32, bodies: &mut JointBodies) -> bool {
        solve_relative_angle(bodies, self.velocity_bias, self.mass_factor, self.max_impulse)
    }

    /// The joint keeps no impulse from step to step.
    pub(crate) fn forget_impulse(&mut self) {}

    pub(crate) fn impulse_is_finite(&self) -> bool {
        true
    }

    pub(crate) fn is_valid(&self) -> bool {
        self.target_angle.is_finite() && self.max_impulse.is_finite()
    }
}

/// Changes the relative angular velocity of two bodies to the bias, and returns whether there was an impulse.
#[inline]
pub(crate) fn solve_relative_angle(
    bodies: &mut JointBodies,
    velocity_bias: f32,
    mass_factor: f32,
    max_impulse: f32,
) -> bool {
    let impulse =
        (velocity_bias - bodies.second().angular_velocity + bodies.first().angular_velocity) * mass_factor;
    if impulse == 0.0 {
        return false;
    }
    let magnitude = scalar::min(impulse.abs(), max_impulse);
    let sign = scalar::sign(impulse);
    let first = bodies.first_mut();
    first.angular_velocity -= first.inverse_inertia * sign * magnitude;
    let second = bodies.second_mut();
    second.angular_velocity += second.inverse_inertia * sign * magnitude;
    true
}
