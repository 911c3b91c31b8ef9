//! Two bodies, one of which slides along an axis of the other: not in the original, and only for the precise set.

use serde::{Deserialize, Serialize};

use crate::body::nobody::nobody;
use crate::body::{Body, BodyId};
use crate::error::{Error, Result};
use crate::joints::bodies::two_bodies;
use crate::joints::drive::Drive;
use crate::joints::joint_body::{JointBodies, JointPose, JointStep};
use crate::joints::shared_point::SharedPoint;
use crate::joints::{Joint, JointKind};
use crate::math::finite::{finite, finite_vector};
use crate::math::{Vector2, scalar};

/// Lets the second body slide along an axis that is fixed in the first one, and keeps their angle to each other as it was
/// when the joint was made: a piston, a lift, a drawer. It can have a [motor](crate::Objects::set_joint_motor) and
/// [limits](crate::Objects::set_joint_limits).
///
/// Only the [precise set](crate::Methods::Precise) has it: under the faithful one it cannot be added. Its
/// [error](crate::Joint::joint_error) is how far the anchor of the second body is off the line.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct PrismaticJoint {
    body1: BodyId,
    body2: BodyId,
    pub(super) point: SharedPoint,
    axis: Vector2,
    pub(super) target_angle: f32,
    pub(super) drive: Drive,
}

impl PrismaticJoint {
    pub(crate) fn new(
        body1: (BodyId, &Body),
        body2: (BodyId, &Body),
        anchor: Vector2,
        axis: Vector2,
    ) -> Result<Joint> {
        let angle = body2.1.total_rotation() - body1.1.total_rotation();
        let mut joint = PrismaticJoint {
            body1: body1.0,
            body2: body2.0,
            point: SharedPoint::new(anchor, body1.1, body2.1)?,
            target_angle: finite("total_rotation", angle)?,
            ..PrismaticJoint::without_bodies()
        };
        joint.set_axis(axis, body1.1)?;
        Ok(Joint::of(JointKind::Prismatic(joint)))
    }

    pub(crate) fn without_bodies() -> Self {
        PrismaticJoint {
            body1: nobody(),
            body2: nobody(),
            point: SharedPoint::default(),
            axis: Vector2::new(1.0, 0.0),
            target_angle: 0.0,
            drive: Drive::default(),
        }
    }

    two_bodies! {}

    /// The anchor last set, in world coordinates. It does not follow the bodies.
    pub fn anchor(&self) -> Vector2 {
        self.point.anchor
    }

    /// The axis in the coordinates of the first body, of length 1.
    pub fn axis(&self) -> Vector2 {
        self.axis
    }

    pub(crate) fn set_anchor(&mut self, anchor: Vector2, body1: &Body, body2: &Body) -> Result<()> {
        self.point.set_anchor(anchor, body1, body2)
    }

    /// Takes an axis of the world, at the body's present angle.
    pub(crate) fn set_axis(&mut self, axis: Vector2, body1: &Body) -> Result<()> {
        finite_vector("axis", axis)?;
        let [x, y] = [f64::from(axis.x), f64::from(axis.y)];
        let length = (x * x + y * y).sqrt();
        if length == 0.0 {
            return Err(Error::invalid("axis", (axis.x, axis.y), "longer than 0"));
        }
        let (sine, cosine) = libm::sincos(f64::from(body1.rotation()));
        let local = [(cosine * x + sine * y) / length, (cosine * y - sine * x) / length];
        self.axis = Vector2::new(local[0] as f32, local[1] as f32);
        Ok(())
    }

    /// The first body's position plus the arm of the last update.
    pub(crate) fn current_anchor(&self, body1: &Body) -> Vector2 {
        body1.position() + self.point.arm1
    }

    /// How far the second body has slid.
    pub(crate) fn travel(&self, body1: &Body, body2: &Body) -> f32 {
        let [anchor1, anchor2] = self.point.local_anchors();
        let apart = body2.get_world_position(anchor2) - body1.get_world_position(anchor1);
        let (sine, cosine) = scalar::sin_cos(body1.rotation());
        let (x, y) = (self.axis.x, self.axis.y);
        apart.x * (cosine * x - sine * y) + apart.y * (sine * x + cosine * y)
    }

    /// The faithful set, which asks for this, has no such joints.
    pub(crate) fn pre_step(&mut self, _: JointStep, _: &[JointPose; 2], _: &mut JointBodies) -> f32 {
        0.0
    }

    pub(crate) fn solve(&mut self, _: f32, _: &mut JointBodies) -> bool {
        false
    }

    pub(crate) fn forget_impulse(&mut self) {}

    pub(crate) fn impulse_is_finite(&self) -> bool {
        true
    }

    pub(crate) fn is_valid(&self) -> bool {
        let length = self.axis.norm();
        self.point.is_valid()
            && self.target_angle.is_finite()
            && (length - 1.0).abs() < 1e-5
            && self.drive.is_valid()
    }
}
