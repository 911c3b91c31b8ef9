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

/// A servo of a joint: a damped spring that seeks a target position with a bounded force or torque. Only with the [precise
/// set](crate::Methods::Precise).
///
/// With e the position minus the target and v its rate, the force or torque along the joint's motion is
/// -`stiffness` · e - `damping` · v, but at most `greatest_effort`. A load F displaces a servo that is strong enough by
/// F / `stiffness`. The rows of the solvers are implicit: a servo of any stiffness is stable with any step. Chains of stiff servos shake
/// in the iterative solver, and need the [direct one](crate::guide::solvers). A servo may act
/// beside a [motor](JointMotor) and [limits](JointLimits); a motor of speed 0 is friction then. A body that creeps to its target
/// more slowly than bodies [sleep](crate::PhysicsSimulator::set_sleep_enabled) may fall asleep before it.
///
/// Positions count as those of the limits: angles in radians, positive as rotations are; lengths along the axis.
///
/// ```
/// use farseer_core::math::Vector2;
/// use farseer_core::{BodyFactory, JointFactory, JointServo, Methods, PhysicsSimulator};
/// let mut simulator = PhysicsSimulator::default();
/// simulator.set_methods(Methods::PRECISE)?;
/// let arm = BodyFactory::create_rectangle_body_in(&mut simulator, 40.0, 10.0, 1.0)?;
/// let shoulder = JointFactory::create_fixed_revolute_joint_in(&mut simulator, arm, Vector2::zeros())?;
/// // Two oscillations per second, critically damped, to a quarter of a turn.
/// let inertia = simulator[arm].moment_of_inertia();
/// let target = std::f32::consts::FRAC_PI_2;
/// simulator.set_joint_servo(shoulder, Some(JointServo::of_frequency(target, 2.0, 1.0, inertia)))?;
/// (0..120).for_each(|_| simulator.update(1.0 / 60.0));
/// assert!((simulator.joint_travel(shoulder)? - target).abs() < 0.001);
/// # Ok::<(), farseer_core::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[doc(alias("spring", "position motor", "JointMotor::ForceBased", "enableSpring", "hertz"))]
pub struct JointServo {
    /// Position that the servo seeks: radians for a joint that turns, length units along an axis.
    pub target: f32,
    /// Torque per radian in mass units · length units²/s², or along an axis force per length in mass units/s². 0 or more.
    pub stiffness: f32,
    /// Torque per angular velocity in mass units · length units²/s, or along an axis force per velocity in mass units/s. 0 or
    /// more. The least damping in effect is `stiffness` times the step, or the substep in the iterative solver.
    pub damping: f32,
    /// Maximum torque in mass units · length units²/s², or along an axis maximum force in mass units · length units/s². 0 or
    /// more; [`f32::MAX`] is no bound.
    pub greatest_effort: f32,
}

impl JointServo {
    /// A servo without bound for a load of `inertia` that would swing freely with `frequency` oscillations per second, Hz.
    /// `damping_ratio` is 1 for critical damping, less for a servo that overshoots. `inertia` is the moment of inertia of what
    /// turns about the joint, in mass units · length units², or along an axis the mass that slides, in mass units. Between
    /// two bodies of moments a and b it is a b / (a + b), and likewise for masses.
    ///
    /// The stiffness is `inertia` · ω² and the damping 2 · `damping_ratio` · `inertia` · ω, with ω = 2 π `frequency`.
    pub fn of_frequency(target: f32, frequency: f32, damping_ratio: f32, inertia: f32) -> Self {
        let angular_frequency = std::f32::consts::TAU * frequency;
        JointServo {
            target,
            stiffness: inertia * angular_frequency * angular_frequency,
            damping: 2.0 * damping_ratio * inertia * angular_frequency,
            greatest_effort: f32::MAX,
        }
    }

    pub(super) fn check(self) -> Result<Self> {
        finite("target", self.target)?;
        zero_or_more("stiffness", self.stiffness)?;
        zero_or_more("damping", self.damping)?;
        zero_or_more("greatest_effort", self.greatest_effort)?;
        Ok(self)
    }
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

/// The motor, the limits and the servo of a joint.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct MotorAndLimits {
    motor: Option<JointMotor>,
    limits: Option<JointLimits>,
    servo: Option<JointServo>,
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

    pub(crate) fn servo(&self) -> Option<JointServo> {
        self.servo
    }

    /// Whether there is neither a motor nor a limit nor a servo.
    #[cfg(feature = "precise")]
    pub(crate) fn is_empty(&self) -> bool {
        self.motor.is_none() && self.limits.is_none() && self.servo.is_none()
    }

    /// Which of motor, limits and servo there are.
    pub(crate) fn present(&self) -> [bool; 3] {
        [self.motor.is_some(), self.limits.is_some(), self.servo.is_some()]
    }

    pub(crate) fn set_servo(&mut self, servo: Option<JointServo>) -> Result<()> {
        self.servo = servo.map(JointServo::check).transpose()?;
        Ok(())
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
            && self.servo.is_none_or(|servo| servo.check().is_ok())
    }
}
