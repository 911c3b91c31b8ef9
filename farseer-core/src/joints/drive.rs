//! What moves a joint along the way that it leaves free, and where that way ends.

use serde::{Deserialize, Serialize};

use crate::body::Body;
use crate::error::{Error, Result};
use crate::math::finite::{finite, zero_or_more};
use crate::math::scalar::nearest_finite;

/// What drives a joint: a speed that it seeks, and how much it can do for that. The
/// [precise set](crate::Methods::Precise)'s.
///
/// A motor at rest is a brake: with a speed of 0 it holds against whatever asks for less than its greatest effort.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct JointMotor {
    /// Of the second body, or the only one, against the first or the world: radians per s of a joint that turns, length
    /// per s along the axis of a prismatic joint.
    pub speed: f32,
    /// Greatest torque, in the user's unit of mass times length^2 per s^2, or of a prismatic joint greatest force, in mass
    /// times length per s^2. 0 or more.
    pub greatest_effort: f32,
}

/// From where to where a joint may move. The [precise set](crate::Methods::Precise)'s.
///
/// Radians from the angle that the bodies had when the anchor was set, or lengths along the axis from where it was on both;
/// until an anchor is set a joint counts from equal [total rotations](crate::Body::total_rotation).
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct JointLimits {
    /// The least.
    pub lower: f32,
    /// The greatest; not less than the least.
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
pub(crate) struct Drive {
    motor: Option<JointMotor>,
    limits: Option<JointLimits>,
    /// Difference of total rotations from which angles count.
    pub(crate) reference: f32,
}

impl Drive {
    /// Angles of two bodies, or of one and the world, count from now.
    pub(super) fn count_from(&mut self, body1: Option<&Body>, body2: &Body) {
        let turned = body1.map_or(0.0, Body::total_rotation);
        self.reference = nearest_finite(body2.total_rotation() - turned);
    }

    pub(crate) fn motor(&self) -> Option<JointMotor> {
        self.motor
    }

    pub(crate) fn limits(&self) -> Option<JointLimits> {
        self.limits
    }

    /// Whether it does nothing.
    pub(crate) fn is_idle(&self) -> bool {
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
