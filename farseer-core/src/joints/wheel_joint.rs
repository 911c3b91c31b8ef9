//! Wheel joint: a wheel on a sprung axle. Not in the original, and only for the precise set.

use serde::{Deserialize, Serialize};

use crate::body::missing_body::missing_body_id;
use crate::body::{Body, BodyId};
use crate::error::Result;
use crate::joints::bodies::{anchor_and_axis, only_precise, two_bodies};
use crate::joints::joint_body::{JointBodies, JointPose, JointStep};
use crate::joints::motor_and_limits::{JointServo, MotorAndLimits};
use crate::joints::prismatic_joint::{axis_travel, is_unit, local_axis};
use crate::joints::shared_point::SharedPoint;
use crate::joints::{Joint, JointKind};
use crate::math::Vector2;

/// Holds a point of the second body, the wheel, on an axis that is fixed in the first one, the chassis. The wheel turns
/// freely, and a spring along the axis carries the chassis: the suspension, which is the joint's
/// [servo](crate::Objects::set_joint_servo). A [motor](crate::Objects::set_joint_motor) turns the wheel.
///
/// A chassis that presses with the force F on a suspension of stiffness k sinks by F / k. As Y points down, a positive
/// [`joint_travel`](crate::Objects::joint_travel) along the axis (0, 1) is a wheel below its place, and a positive motor speed
/// drives to the right. The joint has no limits; a stiff suspension ends its own travel.
///
/// Only the [precise set](crate::Methods::Precise) supports it: under the faithful one it cannot be added. Its
/// [error](crate::Joint::joint_error) is the distance of the wheel's anchor from the axis.
///
/// ```
/// use farseer_core::{BodyBuilder, GeomBuilder, JointFactory, JointMotor, PhysicsSimulator, math::Vector2};
/// let mut simulator = PhysicsSimulator::precise([0.0, 400.0])?;
/// simulator.add_body(BodyBuilder::fixed().position([0.0, 60.0]), [GeomBuilder::rectangle(4000.0, 20.0)])?;
/// let (car, _) = simulator.add_body(BodyBuilder::dynamic(), [GeomBuilder::rectangle(80.0, 20.0).density(0.01)])?;
/// for x in [-30.0, 30.0] {
///     let wheel = BodyBuilder::dynamic().position([x, 20.0]);
///     let (wheel, _) = simulator.add_body(wheel, [GeomBuilder::circle(12.0).density(0.01)])?;
///     let (axis, at) = (Vector2::new(0.0, 1.0), Vector2::new(x, 20.0));
///     let (stiffness, damping) = (1000.0, 60.0);
///     let axle =
///         JointFactory::create_wheel_joint_in(&mut simulator, car, wheel, at, axis, stiffness, damping)?;
///     simulator.set_joint_bodies_collide(axle, false)?;
///     simulator.set_joint_motor(axle, Some(JointMotor { speed: 10.0, greatest_effort: 1000.0 }))?;
/// }
/// (0..120).for_each(|_| simulator.update(1.0 / 60.0));
/// assert!(simulator[car].position().x > 5.0);
/// # Ok::<(), farseer_core::Error>(())
/// ```
#[derive(Debug, Clone, Serialize, Deserialize)]
#[doc(alias("b2WheelJoint", "suspension", "line joint", "axle"))]
pub struct WheelJoint {
    body1: BodyId,
    body2: BodyId,
    pub(super) point: SharedPoint,
    axis: Vector2,
    pub(super) drive: MotorAndLimits,
}

impl WheelJoint {
    pub(crate) fn new(
        body1: (BodyId, &Body),
        body2: (BodyId, &Body),
        (anchor, axis): (Vector2, Vector2),
        [stiffness, damping]: [f32; 2],
    ) -> Result<Joint> {
        let mut joint = WheelJoint {
            body1: body1.0,
            body2: body2.0,
            point: SharedPoint::new(anchor, body1.1, body2.1)?,
            axis: local_axis(axis, body1.1)?,
            drive: MotorAndLimits::default(),
        };
        joint.drive.set_servo(Some(JointServo {
            target: 0.0,
            stiffness,
            damping,
            greatest_effort: f32::MAX,
        }))?;
        Ok(Joint::of(JointKind::Wheel(joint)))
    }

    pub(crate) fn without_bodies() -> Self {
        WheelJoint {
            body1: missing_body_id(),
            body2: missing_body_id(),
            point: SharedPoint::default(),
            axis: Vector2::new(0.0, 1.0),
            drive: MotorAndLimits::default(),
        }
    }

    two_bodies! {}

    anchor_and_axis! {}

    only_precise! {}

    pub(crate) fn is_valid(&self) -> bool {
        self.point.is_valid() && is_unit(self.axis) && self.drive.is_valid() && self.drive.limits().is_none()
    }
}
