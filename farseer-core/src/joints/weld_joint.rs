//! Weld joint: two bodies that share a point and an angle (behaviour chapter 10, section 14).

use serde::{Deserialize, Serialize};

use crate::body::missing_body::missing_body_id;
use crate::body::{Body, BodyId};
use crate::checked_properties::checked_properties;
use crate::error::Result;
use crate::joints::angle_joint::solve_relative_angle;
use crate::joints::bodies::two_bodies;
use crate::joints::joint_body::{JointBodies, JointPose, JointStep};
use crate::joints::shared_point::SharedPoint;
use crate::joints::{Joint, JointKind};
use crate::math::Vector2;
use crate::math::finite::finite;

/// Holds a point of two bodies together and their relative angle as it was when the joint was made, or at equal total
/// rotations if it was made without its bodies.
///
/// As in the original the impulses at the point do not turn the first body in the iterations, so that angular momentum
/// is not conserved. Only the distance at the point counts for breaking.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct WeldJoint {
    body1: BodyId,
    body2: BodyId,
    pub(super) point: SharedPoint,
    pub(super) target_angle: f32,
    max_impulse: f32,
    #[serde(with = "crate::storage::bits")]
    angular_velocity_bias: f32,
    #[serde(with = "crate::storage::bits")]
    mass_factor: f32,
}

impl WeldJoint {
    pub(crate) fn new(body1: (BodyId, &Body), body2: (BodyId, &Body), anchor: Vector2) -> Result<Joint> {
        let angle = body2.1.total_rotation() - body1.1.total_rotation();
        Ok(Joint::of(JointKind::Weld(WeldJoint {
            body1: body1.0,
            body2: body2.0,
            point: SharedPoint::new(anchor, body1.1, body2.1)?,
            target_angle: finite("total_rotation", angle)?,
            ..WeldJoint::without_bodies()
        })))
    }

    pub(crate) fn without_bodies() -> Self {
        WeldJoint {
            body1: missing_body_id(),
            body2: missing_body_id(),
            point: SharedPoint::default(),
            target_angle: 0.0,
            max_impulse: f32::MAX,
            angular_velocity_bias: 0.0,
            mass_factor: 0.0,
        }
    }

    two_bodies! {}

    /// The anchor last set, in world coordinates. It does not follow the bodies.
    #[doc(alias = "Anchor")]
    pub fn anchor(&self) -> Vector2 {
        self.point.anchor
    }

    checked_properties! {
        /// Maximum angular impulse with which one solver iteration keeps the angle, in mass units · length units²/s;
        /// the point has no limit. Default [`f32::MAX`].
        #[doc(alias = "MaxImpulse")]
        max_impulse, set_max_impulse;
    }

    pub(crate) fn set_anchor(&mut self, anchor: Vector2, body1: &Body, body2: &Body) -> Result<()> {
        self.point.set_anchor(anchor, body1, body2)
    }

    /// The first body's position plus its arm in the last pre-step.
    pub(crate) fn current_anchor(&self, body1: &Body) -> Vector2 {
        body1.position() + self.point.arm1
    }

    pub(crate) fn pre_step(
        &mut self,
        step: JointStep,
        poses: &[JointPose; 2],
        bodies: &mut JointBodies,
    ) -> f32 {
        let error = poses[1].total_rotation - poses[0].total_rotation - self.target_angle;
        self.angular_velocity_bias = step.correction() * error;
        let inverse_inertia = bodies.first().inverse_inertia + bodies.second().inverse_inertia;
        self.mass_factor = (1.0 - step.softness) / inverse_inertia;
        // The angular error is never tested for breaking.
        self.point.pre_step(step, poses, bodies)
    }

    pub(crate) fn solve(&mut self, softness: f32, bodies: &mut JointBodies) -> bool {
        solve_relative_angle(bodies, self.angular_velocity_bias, self.mass_factor, self.max_impulse);
        // The impulse at the point does not turn the first body, though the warm start does.
        self.point.solve(softness, false, bodies)
    }

    pub(crate) fn forget_impulse(&mut self) {
        self.point.forget_impulse();
    }

    pub(crate) fn impulse_is_finite(&self) -> bool {
        self.point.impulse_is_finite()
    }

    pub(crate) fn is_valid(&self) -> bool {
        self.point.is_valid() && self.target_angle.is_finite() && self.max_impulse.is_finite()
    }
}
