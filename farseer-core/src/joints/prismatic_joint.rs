//! Prismatic joint: a body slides along an axis of another. Not in the original, and only for the precise set.

use serde::{Deserialize, Serialize};

use crate::body::missing_body::missing_body_id;
use crate::body::{Body, BodyId};
use crate::error::{Error, Result};
use crate::joints::bodies::{anchor_and_axis, only_precise, two_bodies};
use crate::joints::joint_body::{JointBodies, JointPose, JointStep};
use crate::joints::motor_and_limits::MotorAndLimits;
use crate::joints::shared_point::SharedPoint;
use crate::joints::{Joint, JointKind};
use crate::math::finite::{finite, finite_vector};
use crate::math::{Vector2, scalar};

/// Lets the second body slide along an axis that is fixed in the first one, and keeps their relative angle as it was
/// when the joint was made: a piston, a lift, a drawer. It can have a [motor](crate::Objects::set_joint_motor) and
/// [limits](crate::Objects::set_joint_limits).
///
/// Only the [precise set](crate::Methods::Precise) supports it: under the faithful one it cannot be added. Its
/// [error](crate::Joint::joint_error) is the distance of the second body's anchor from the line.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct PrismaticJoint {
    body1: BodyId,
    body2: BodyId,
    pub(super) point: SharedPoint,
    axis: Vector2,
    pub(super) target_angle: f32,
    pub(super) drive: MotorAndLimits,
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
            body1: missing_body_id(),
            body2: missing_body_id(),
            point: SharedPoint::default(),
            axis: Vector2::new(1.0, 0.0),
            target_angle: 0.0,
            drive: MotorAndLimits::default(),
        }
    }

    two_bodies! {}

    anchor_and_axis! {}

    only_precise! {}

    pub(crate) fn is_valid(&self) -> bool {
        self.point.is_valid() && self.target_angle.is_finite() && is_unit(self.axis) && self.drive.is_valid()
    }
}

/// A direction of the world as a unit vector in the coordinates of a body, at its present angle.
pub(super) fn local_axis(axis: Vector2, body: &Body) -> Result<Vector2> {
    finite_vector("axis", axis)?;
    let [x, y] = [f64::from(axis.x), f64::from(axis.y)];
    let length = (x * x + y * y).sqrt();
    if length == 0.0 {
        return Err(Error::invalid("axis", (axis.x, axis.y), "longer than 0"));
    }
    let (sine, cosine) = libm::sincos(f64::from(body.rotation()));
    let local = [(cosine * x + sine * y) / length, (cosine * y - sine * x) / length];
    Ok(Vector2::new(local[0] as f32, local[1] as f32))
}

/// Distance along the axis by which the second body has slid, in length units.
pub(super) fn axis_travel(point: &SharedPoint, axis: Vector2, body1: &Body, body2: &Body) -> f32 {
    let [anchor1, anchor2] = point.local_anchors();
    let apart = body2.get_world_position(anchor2) - body1.get_world_position(anchor1);
    let (sine, cosine) = scalar::sin_cos(body1.rotation());
    let (x, y) = (axis.x, axis.y);
    apart.x * (cosine * x - sine * y) + apart.y * (sine * x + cosine * y)
}

/// Whether an axis is a unit vector.
pub(super) fn is_unit(axis: Vector2) -> bool {
    (axis.norm() - 1.0).abs() < 1e-5
}
