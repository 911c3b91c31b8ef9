//! Angle spring joint: a damped spring between the angles of two bodies. Not in the original, and only for the precise set.

use serde::{Deserialize, Serialize};

use crate::body::missing_body::missing_body_id;
use crate::body::{Body, BodyId};
use crate::error::Result;
use crate::joints::bodies::{only_precise, two_bodies};
use crate::joints::joint_body::{JointBodies, JointPose, JointStep};
use crate::joints::motor_and_limits::{JointServo, MotorAndLimits};
use crate::joints::{Joint, JointKind};

/// A damped spring between the angles of two bodies, which may move freely otherwise. The spring is the joint's
/// [servo](crate::Objects::set_joint_servo); its target counts from the relative angle of the bodies when the joint was made. The
/// joint can also have a [motor](crate::Objects::set_joint_motor) and [limits](crate::Objects::set_joint_limits) of that angle.
///
/// An [`AngleSpring`](crate::AngleSpring) damps the angular velocity of each body. This joint damps the relative one, so that
/// two bodies that turn together keep their spin. It is a row of the solvers, stable at any stiffness.
///
/// Only the [precise set](crate::Methods::Precise) supports it: under the faithful one it cannot be added. Its
/// [error](crate::Joint::joint_error) is always 0.
///
/// ```
/// use farseer_core::{BodyFactory, JointFactory, Methods, PhysicsSimulator};
/// let mut simulator = PhysicsSimulator::default();
/// simulator.set_methods(Methods::PRECISE)?;
/// let [a, b] = [0.0, 0.0].map(|_| BodyFactory::create_circle_body_in(&mut simulator, 10.0, 1.0));
/// let (a, b) = (a?, b?);
/// let spring = JointFactory::create_angle_spring_joint_in(&mut simulator, a, b, 2000.0, 300.0)?;
/// simulator[a].set_angular_velocity(2.0);
/// (0..240).for_each(|_| simulator.update(1.0 / 60.0));
/// // They turn together at half of the speed.
/// assert!(simulator.joint_travel(spring)?.abs() < 0.001);
/// # Ok::<(), farseer_core::Error>(())
/// ```
#[derive(Debug, Clone, Serialize, Deserialize)]
#[doc(alias("DampedRotarySpring", "torsion spring", "rotary spring"))]
pub struct AngleSpringJoint {
    body1: BodyId,
    body2: BodyId,
    pub(super) drive: MotorAndLimits,
}

impl AngleSpringJoint {
    pub(crate) fn new(
        body1: (BodyId, &Body),
        body2: (BodyId, &Body),
        stiffness: f32,
        damping: f32,
    ) -> Result<Joint> {
        let mut joint = AngleSpringJoint { body1: body1.0, body2: body2.0, drive: MotorAndLimits::default() };
        joint.drive.set_servo(Some(JointServo {
            target: 0.0,
            stiffness,
            damping,
            greatest_effort: f32::MAX,
        }))?;
        joint.drive.set_reference(Some(body1.1), body2.1);
        Ok(Joint::of(JointKind::AngleSpring(joint)))
    }

    pub(crate) fn without_bodies() -> Self {
        AngleSpringJoint {
            body1: missing_body_id(),
            body2: missing_body_id(),
            drive: MotorAndLimits::default(),
        }
    }

    two_bodies! {}

    only_precise! {}

    pub(crate) fn is_valid(&self) -> bool {
        self.drive.is_valid()
    }
}
