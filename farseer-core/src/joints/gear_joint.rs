//! Gear joint: the angle of a body follows that of another. Not in the original, and only for the precise set.

use serde::{Deserialize, Serialize};

use crate::body::missing_body::missing_body_id;
use crate::body::{Body, BodyId};
use crate::error::{Error, Result};
use crate::joints::bodies::{only_precise, two_bodies};
use crate::joints::joint_body::{JointBodies, JointPose, JointStep};
use crate::joints::{Joint, JointId, JointKind, JointType};
use crate::math::finite::finite;
use crate::math::scalar::nearest_finite;
use crate::objects::Objects;

/// Turns the second body by a multiple of the angle by which the first one turns: the [ratio](Self::ratio). The bodies may move
/// freely otherwise, so each needs a bearing, such as a [`FixedRevoluteJoint`](crate::FixedRevoluteJoint). Two wheels that mesh
/// have the ratio -r1 / r2 of their radii, and wheels with a belt r1 / r2.
///
/// The error counts over all turns, so that the ratio holds however long the gear runs. The torque on the second body is
/// [`Joint::torque`], read by the [untyped id](crate::TypedJointId::id); that on the first is -ratio times as great. The bearings
/// carry the difference.
///
/// Only the [precise set](crate::Methods::Precise) supports it: under the faithful one it cannot be added. Its
/// [error](crate::Joint::joint_error) is the angle by which the second body is away from its place. In `twohalf` it does not act
/// on bodies in a group of pins and sliders.
///
/// ```
/// use farseer_core::{BodyFactory, JointFactory, JointMotor, Methods, PhysicsSimulator, math::Vector2};
/// let mut simulator = PhysicsSimulator::default();
/// simulator.set_methods(Methods::PRECISE)?;
/// let [small, large] = [(10.0, 0.0), (30.0, 40.0)].map(|(radius, x)| {
///     let wheel = BodyFactory::create_circle_body_in(&mut simulator, radius, 1.0)?;
///     simulator[wheel].set_position(Vector2::new(x, 0.0));
///     Ok::<_, farseer_core::Error>((wheel, JointFactory::create_fixed_revolute_joint_in(&mut simulator, wheel, Vector2::new(x, 0.0))?))
/// });
/// let ((small, axle), (large, _)) = (small?, large?);
/// JointFactory::create_gear_joint_in(&mut simulator, small, large, -10.0 / 30.0)?;
/// simulator.set_joint_motor(axle, Some(JointMotor { speed: 6.0, greatest_effort: 1e6 }))?;
/// (0..600).for_each(|_| simulator.update(1.0 / 60.0));
/// assert!((simulator[small].total_rotation() - 60.0).abs() < 0.2);
/// assert!((simulator[large].total_rotation() + 20.0).abs() < 0.1);
/// # Ok::<(), farseer_core::Error>(())
/// ```
#[derive(Debug, Clone, Serialize, Deserialize)]
#[doc(alias("b2GearJoint", "cpGearJoint", "belt", "cogwheel"))]
pub struct GearJoint {
    body1: BodyId,
    body2: BodyId,
    ratio: f32,
    /// Angle of the second body minus `ratio` times that of the first at which there is no error, in radians.
    pub(super) reference: f32,
}

/// Refuses a ratio that is not finite, or 0.
fn check_ratio(ratio: f32) -> Result<f32> {
    match finite("ratio", ratio)? {
        0.0 => Err(Error::invalid("ratio", ratio, "not 0")),
        ratio => Ok(ratio),
    }
}

impl GearJoint {
    pub(crate) fn new(body1: (BodyId, &Body), body2: (BodyId, &Body), ratio: f32) -> Result<Joint> {
        let mut joint = GearJoint { body1: body1.0, body2: body2.0, ..GearJoint::without_bodies() };
        joint.set_ratio(ratio, body1.1, body2.1)?;
        Ok(Joint::of(JointKind::Gear(joint)))
    }

    pub(crate) fn without_bodies() -> Self {
        GearJoint { body1: missing_body_id(), body2: missing_body_id(), ratio: 1.0, reference: 0.0 }
    }

    two_bodies! {}

    /// Angle by which the second body turns when the first one turns by one radian. Set by
    /// [`set_gear_ratio`](Objects::set_gear_ratio).
    pub fn ratio(&self) -> f32 {
        self.ratio
    }

    /// Sets the ratio; the present angles of the bodies are without error, up to the precision of an `f32` for the difference of
    /// both angles.
    fn set_ratio(&mut self, ratio: f32, body1: &Body, body2: &Body) -> Result<()> {
        self.ratio = check_ratio(ratio)?;
        let angle = body2.unwrapped_rotation() - f64::from(ratio) * body1.unwrapped_rotation();
        self.reference = nearest_finite(angle as f32);
        Ok(())
    }

    only_precise! {}

    pub(crate) fn is_valid(&self) -> bool {
        check_ratio(self.ratio).is_ok() && self.reference.is_finite()
    }
}

impl Objects {
    /// Changes the ratio of a gear joint, from the present angles of its bodies on. It takes effect with the next update.
    ///
    /// # Errors
    /// A stale id; a body that was not set yet; a joint of another kind; a ratio that is not finite, or 0. The old ratio stays
    /// then.
    pub fn set_gear_ratio(&mut self, joint: impl Into<JointId>, ratio: f32) -> Result<()> {
        let (joint, body1, body2) = self.joint_and_bodies(joint.into())?;
        let expected = Error::WrongKind { argument: "joint", expected: GearJoint::NAME };
        GearJoint::of_mut(joint).ok_or(expected)?.set_ratio(ratio, body1, body2)
    }
}
