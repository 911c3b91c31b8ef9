//! Motor and limits of the motion that a joint leaves free.

use serde::{Deserialize, Serialize};

use crate::body::Body;
use crate::error::{Error, Result};
use crate::math::finite::{finite, zero_or_more};
use crate::math::scalar::nearest_finite;

/// A motor of a joint: a target speed, and the maximum force or torque for it. Only with the [precise
/// set](crate::Methods::Precise).
///
/// A motor with the speed 0 is a brake: it resists any load up to its maximum.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct JointMotor {
    /// Target speed of the second body, or the only one, relative to the first or the world. Radians per s for a joint
    /// that turns, length units/s along the axis of a prismatic joint.
    pub speed: f32,
    /// Maximum torque in mass units · length units²/s², or for a prismatic joint maximum force in mass units · length
    /// units/s². 0 or more.
    pub greatest_effort: f32,
}

/// Limits of a joint's motion. Only with the [precise set](crate::Methods::Precise).
///
/// Angles are in radians, relative to the angle of the bodies when the anchor was set. Lengths are along the axis,
/// relative to the position at which the anchor was on both bodies. Until an anchor is set the reference is equal
/// [total rotations](crate::Body::total_rotation).
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct JointLimits {
    /// Minimum, in radians or length units.
    pub lower: f32,
    /// Maximum, in radians or length units; not less than `lower`.
    pub upper: f32,
}

impl JointMotor {
    fn check(self) -> Result<Self> {
        finite("speed", self.speed)?;
        zero_or_more("greatest_effort", self.greatest_effort)?;
        Ok(self)
    }
}

impl JointLimits {
    fn check(self) -> Result<Self> {
        finite("lower", self.lower)?;
        finite("upper", self.upper)?;
        if self.lower > self.upper {
            return Err(Error::invalid("lower", self.lower, "at most the upper limit"));
        }
        Ok(self)
    }
}

/// The motor and the limits of a joint.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct MotorAndLimits {
    motor: Option<JointMotor>,
    limits: Option<JointLimits>,
    /// Difference of total rotations that counts as angle 0, in radians.
    pub(crate) reference: f32,
}

impl MotorAndLimits {
    /// Makes the present angle of two bodies, or of one and the world, the reference.
    pub(super) fn set_reference(&mut self, body1: Option<&Body>, body2: &Body) {
        let turned = body1.map_or(0.0, Body::total_rotation);
        self.reference = nearest_finite(body2.total_rotation() - turned);
    }

    pub(crate) fn motor(&self) -> Option<JointMotor> {
        self.motor
    }

    pub(crate) fn limits(&self) -> Option<JointLimits> {
        self.limits
    }

    /// Whether there is neither a motor nor a limit.
    pub(crate) fn is_empty(&self) -> bool {
        self.motor.is_none() && self.limits.is_none()
    }

    pub(crate) fn set_motor(&mut self, motor: Option<JointMotor>) -> Result<()> {
        self.motor = motor.map(JointMotor::check).transpose()?;
        Ok(())
    }

    pub(crate) fn set_limits(&mut self, limits: Option<JointLimits>) -> Result<()> {
        self.limits = limits.map(JointLimits::check).transpose()?;
        Ok(())
    }

    pub(super) fn is_valid(&self) -> bool {
        self.reference.is_finite()
            && self.motor.is_none_or(|motor| motor.check().is_ok())
            && self.limits.is_none_or(|limits| limits.check().is_ok())
    }
}
