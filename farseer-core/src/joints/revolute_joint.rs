//! Revolute joint: two bodies that turn about a common point (behaviour chapter 10, section 10).

use serde::{Deserialize, Serialize};

use crate::body::missing_body::missing_body_id;
use crate::body::{Body, BodyId};
use crate::error::Result;
use crate::joints::bodies::two_bodies;
use crate::joints::joint_body::{JointBodies, JointPose, JointStep};
use crate::joints::motor_and_limits::MotorAndLimits;
use crate::joints::shared_point::SharedPoint;
use crate::joints::{Joint, JointKind};
use crate::math::Vector2;

/// Holds a point of two bodies together: a hinge. Its impulse has no limit. Under the precise set it can have a
/// [motor](crate::Objects::set_joint_motor) and [limits](crate::Objects::set_joint_limits).
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct RevoluteJoint {
    body1: BodyId,
    body2: BodyId,
    pub(super) point: SharedPoint,
    pub(super) drive: MotorAndLimits,
}

impl RevoluteJoint {
    pub(crate) fn new(body1: (BodyId, &Body), body2: (BodyId, &Body), anchor: Vector2) -> Result<Joint> {
        let mut joint = RevoluteJoint { body1: body1.0, body2: body2.0, ..RevoluteJoint::without_bodies() };
        joint.set_anchor(anchor, body1.1, body2.1)?;
        Ok(Joint::of(JointKind::Revolute(joint)))
    }

    pub(crate) fn without_bodies() -> Self {
        RevoluteJoint {
            body1: missing_body_id(),
            body2: missing_body_id(),
            point: SharedPoint::default(),
            drive: MotorAndLimits::default(),
        }
    }

    two_bodies! {}

    /// The anchor last set, in world coordinates. It does not follow the bodies.
    #[doc(alias = "Anchor")]
    pub fn anchor(&self) -> Vector2 {
        self.point.anchor
    }

    pub(crate) fn set_anchor(&mut self, anchor: Vector2, body1: &Body, body2: &Body) -> Result<()> {
        self.point.set_anchor(anchor, body1, body2)?;
        self.drive.set_reference(Some(body1), body2);
        Ok(())
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
        self.point.pre_step(step, poses, bodies)
    }

    pub(crate) fn solve(&mut self, softness: f32, bodies: &mut JointBodies) -> bool {
        self.point.solve(softness, true, bodies)
    }

    pub(crate) fn forget_impulse(&mut self) {
        self.point.forget_impulse();
    }

    pub(crate) fn impulse_is_finite(&self) -> bool {
        self.point.impulse_is_finite()
    }

    pub(crate) fn is_valid(&self) -> bool {
        self.point.is_valid() && self.drive.is_valid()
    }
}
