//! Motor joint: moves a body to a pose relative to another with bounded force. Not in the original, and only for the precise
//! set.

use serde::{Deserialize, Serialize};

use crate::body::missing_body::missing_body_id;
use crate::body::{Body, BodyId};
use crate::error::Result;
use crate::joints::bodies::{only_precise, two_bodies};
use crate::joints::joint_body::{JointBodies, JointPose, JointStep};
use crate::joints::{Joint, JointKind};
use crate::math::Vector2;
use crate::math::finite::{finite, finite_vector, zero_or_more};
use crate::math::scalar::nearest_finite;

/// Strength of a [`MotorJoint`].
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct PoseServo {
    /// Frequency of the free oscillation about the pose, Hz, 0 or more. Stiffness and damping follow from it and from the
    /// masses of the two bodies, as for centres on each other. With an offset from a light first body, which turns too, the
    /// oscillation is faster. 0 is friction, which seeks no pose. Default 4.
    pub frequency: f32,
    /// Damping ratio, 0 or more; 1 is critical damping. Without a frequency any ratio above 0 is dry friction, and 0 no force.
    /// Default 1.
    pub damping_ratio: f32,
    /// Greatest force, in mass units · length units/s², 0 or more. Default [`f32::MAX`].
    pub greatest_force: f32,
    /// Greatest torque, in mass units · length units²/s², 0 or more. Default [`f32::MAX`].
    pub greatest_torque: f32,
}

impl Default for PoseServo {
    fn default() -> Self {
        PoseServo { frequency: 4.0, damping_ratio: 1.0, greatest_force: f32::MAX, greatest_torque: f32::MAX }
    }
}

impl PoseServo {
    /// Dry friction between two bodies: it stops their relative motion with at most these forces and torques, and seeks no pose.
    /// For things that slide on the floor of a game that is seen from above. With the coefficient μ the greatest force is μ m g. The
    /// greatest torque of a disk of radius r is ⅔ μ m g r.
    ///
    /// ```
    /// use farseer_core::{BodyFactory, JointFactory, Methods, PhysicsSimulator, PoseServo, math::Vector2};
    /// let mut simulator = PhysicsSimulator::default();
    /// simulator.set_methods(Methods::PRECISE)?;
    /// let floor = BodyFactory::create_rectangle_body_in(&mut simulator, 10.0, 10.0, 1.0)?;
    /// simulator[floor].set_is_static(true);
    /// let crate_ = BodyFactory::create_rectangle_body_in(&mut simulator, 20.0, 20.0, 2.0)?;
    /// let friction = PoseServo::friction(2.0 * 100.0, 2000.0);
    /// JointFactory::create_motor_joint_in(&mut simulator, floor, crate_, friction)?;
    /// simulator[crate_].set_linear_velocity(Vector2::new(50.0, 0.0));
    /// (0..60).for_each(|_| simulator.update(1.0 / 60.0));
    /// // It slid v² / (2 μ g).
    /// assert!((simulator[crate_].position().x - 12.5).abs() < 0.5);
    /// # Ok::<(), farseer_core::Error>(())
    /// ```
    #[doc(alias("b2FrictionJoint", "FrictionJoint"))]
    pub fn friction(greatest_force: f32, greatest_torque: f32) -> Self {
        PoseServo { frequency: 0.0, damping_ratio: 1.0, greatest_force, greatest_torque }
    }

    fn check(self) -> Result<Self> {
        zero_or_more("frequency", self.frequency)?;
        zero_or_more("damping_ratio", self.damping_ratio)?;
        zero_or_more("greatest_force", self.greatest_force)?;
        zero_or_more("greatest_torque", self.greatest_torque)?;
        Ok(self)
    }
}

/// Moves the centre of the second body to an offset from the first one, and turns it to an angle relative to the first one,
/// with a force and a torque that are bounded. A first body that is static stands for the world. For platforms that a game
/// steers, and grips that slip. With [`PoseServo::friction`] it is the friction of a game that is seen from above.
///
/// The joint is a damped spring of a given [frequency](PoseServo::frequency) in implicit rows: it is stable at any frequency
/// and step. The length of its force is never above [`greatest_force`](PoseServo::greatest_force), nor its torque
/// above [`greatest_torque`](PoseServo::greatest_torque).
/// [`set_motor_joint_target`](crate::Objects::set_motor_joint_target) moves the pose.
///
/// Only the [precise set](crate::Methods::Precise) supports it: under the faithful one it cannot be added. Its
/// [error](crate::Joint::joint_error) is always 0.
///
/// ```
/// use farseer_core::{BodyFactory, JointFactory, Methods, PhysicsSimulator, PoseServo, math::Vector2};
/// let mut simulator = PhysicsSimulator::default();
/// simulator.set_methods(Methods::PRECISE)?;
/// let base = BodyFactory::create_rectangle_body_in(&mut simulator, 10.0, 10.0, 1.0)?;
/// simulator[base].set_is_static(true);
/// let lift = BodyFactory::create_rectangle_body_in(&mut simulator, 60.0, 10.0, 2.0)?;
/// let servo = PoseServo { frequency: 2.0, ..PoseServo::default() };
/// let joint = JointFactory::create_motor_joint_in(&mut simulator, base, lift, servo)?;
/// simulator.set_motor_joint_target(joint, Vector2::new(0.0, -80.0), 0.5)?;
/// (0..180).for_each(|_| simulator.update(1.0 / 60.0));
/// assert!((simulator[lift].position().y + 80.0).abs() < 0.1);
/// assert!((simulator[lift].rotation() - 0.5).abs() < 0.01);
/// # Ok::<(), farseer_core::Error>(())
/// ```
#[derive(Debug, Clone, Serialize, Deserialize)]
#[doc(alias("b2MotorJoint", "mouse joint"))]
pub struct MotorJoint {
    body1: BodyId,
    body2: BodyId,
    offset: Vector2,
    angle: f32,
    servo: PoseServo,
}

impl MotorJoint {
    pub(crate) fn new(body1: (BodyId, &Body), body2: (BodyId, &Body), servo: PoseServo) -> Result<Joint> {
        let offset = body1.1.get_local_position(body2.1.position());
        Ok(Joint::of(JointKind::Motor(MotorJoint {
            body1: body1.0,
            body2: body2.0,
            offset: finite_vector("body2", offset)?,
            angle: nearest_finite(body2.1.total_rotation() - body1.1.total_rotation()),
            servo: servo.check()?,
        })))
    }

    pub(crate) fn without_bodies() -> Self {
        MotorJoint {
            body1: missing_body_id(),
            body2: missing_body_id(),
            offset: Vector2::zeros(),
            angle: 0.0,
            servo: PoseServo::default(),
        }
    }

    two_bodies! {}

    /// Place that the joint seeks for the centre of the second body, in the coordinates of the first one, in length units. By
    /// default where it was when the joint was made.
    #[doc(alias = "linearOffset")]
    pub fn offset(&self) -> Vector2 {
        self.offset
    }

    /// Difference of the total rotations of the second body and the first that the joint seeks, in radians. By default what
    /// it was when the joint was made.
    #[doc(alias = "angularOffset")]
    pub fn angle(&self) -> f32 {
        self.angle
    }

    /// Strength of the joint.
    pub fn servo(&self) -> PoseServo {
        self.servo
    }

    pub(crate) fn set_target(&mut self, offset: Vector2, angle: f32) -> Result<()> {
        (self.offset, self.angle) = (finite_vector("offset", offset)?, finite("angle", angle)?);
        Ok(())
    }

    pub(crate) fn set_servo(&mut self, servo: PoseServo) -> Result<()> {
        self.servo = servo.check()?;
        Ok(())
    }

    only_precise! {}

    pub(crate) fn is_valid(&self) -> bool {
        let numbers = [self.offset.x, self.offset.y, self.angle];
        numbers.iter().all(|number| number.is_finite()) && self.servo.check().is_ok()
    }
}
