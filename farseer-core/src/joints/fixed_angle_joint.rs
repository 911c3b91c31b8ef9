//! Fixed angle joint: a body at a fixed angle (behaviour chapter 10, section 7).

use serde::{Deserialize, Serialize};

use crate::body::missing_body::missing_body_id;
use crate::body::{Body, BodyId};
use crate::checked_properties::checked_properties;
use crate::error::Result;
use crate::joints::bodies::one_body;
use crate::joints::joint_body::{JointBodies, JointPose, JointStep};
use crate::joints::{Joint, JointKind};
use crate::math::finite::finite;
use crate::math::scalar;

/// Holds a body's total rotation at a target. The body may move freely otherwise.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct FixedAngleJoint {
    body: BodyId,
    target_angle: f32,
    max_impulse: f32,
    #[serde(with = "crate::storage::bits")]
    velocity_bias: f32,
    #[serde(with = "crate::storage::bits")]
    mass_factor: f32,
}

impl FixedAngleJoint {
    pub(crate) fn new(body: (BodyId, &Body), target_angle: f32) -> Result<Joint> {
        Ok(Joint::of(JointKind::FixedAngle(FixedAngleJoint {
            body: body.0,
            target_angle: finite("target_angle", target_angle)?,
            ..FixedAngleJoint::without_bodies()
        })))
    }

    pub(crate) fn without_bodies() -> Self {
        FixedAngleJoint {
            body: missing_body_id(),
            target_angle: 0.0,
            max_impulse: f32::MAX,
            velocity_bias: 0.0,
            mass_factor: 0.0,
        }
    }

    one_body! {}

    checked_properties! {
        /// Target total rotation in radians. Default 0, whatever the angle was when the joint was made.
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
        let error = poses[0].total_rotation - self.target_angle;
        self.velocity_bias = step.correction() * error;
        self.mass_factor = (1.0 - step.softness) / bodies.first().inverse_inertia;
        error
    }

    pub(crate) fn solve(&mut self, _softness: f32, bodies: &mut JointBodies) -> bool {
        let body = bodies.first_mut();
        let impulse = (self.velocity_bias - body.angular_velocity) * self.mass_factor;
        if impulse == 0.0 {
            return false;
        }
        let magnitude = scalar::min(impulse.abs(), self.max_impulse);
        body.angular_velocity += body.inverse_inertia * scalar::sign(impulse) * magnitude;
        true
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
