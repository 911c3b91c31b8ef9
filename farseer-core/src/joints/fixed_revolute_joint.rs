//! Fixed revolute joint: a body that turns about a point of the world (behaviour chapter 10, section 11).

use serde::{Deserialize, Serialize};

use crate::body::missing_body::missing_body_id;
use crate::body::{Body, BodyId};
use crate::checked_properties::checked_properties;
use crate::error::Result;
use crate::joints::bodies::one_body;
use crate::joints::joint_body::{Inverse2, JointBodies, JointPose, JointStep, is_non_zero};
use crate::joints::motor_and_limits::MotorAndLimits;
use crate::joints::{Joint, JointKind};
use crate::math::Vector2;
use crate::math::calculator::truncate;
use crate::math::finite::finite_vector;
use crate::math::vector2::length;

/// Bias factor of this kind, dimensionless, Farseer's value; other joints have 0.2.
pub(super) const BIAS_FACTOR: f32 = 0.8;

/// Holds a point of a body at a point of the world. The bias factor of the joint is 0.8 when it is made. Under
/// the precise set it can have a [motor](crate::Objects::set_joint_motor) and
/// [limits](crate::Objects::set_joint_limits).
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct FixedRevoluteJoint {
    body: BodyId,
    anchor: Vector2,
    pub(super) local_anchor: Vector2,
    max_impulse: f32,
    /// Accumulated impulse on the body, with opposite sign, before it was limited.
    accumulated: Vector2,
    #[serde(with = "crate::storage::bits")]
    arm: Vector2,
    #[serde(with = "crate::storage::bits")]
    velocity_bias: Vector2,
    #[serde(with = "crate::storage::bits")]
    inverse: Inverse2,
    pub(super) drive: MotorAndLimits,
}

impl FixedRevoluteJoint {
    pub(crate) fn new(body: (BodyId, &Body), anchor: Vector2) -> Result<Joint> {
        let mut joint = FixedRevoluteJoint { body: body.0, ..FixedRevoluteJoint::without_bodies() };
        joint.set_anchor(anchor, body.1)?;
        Ok(Joint::of(JointKind::FixedRevolute(joint)))
    }

    pub(crate) fn without_bodies() -> Self {
        FixedRevoluteJoint {
            body: missing_body_id(),
            anchor: Vector2::zeros(),
            local_anchor: Vector2::zeros(),
            max_impulse: f32::MAX,
            accumulated: Vector2::zeros(),
            arm: Vector2::zeros(),
            velocity_bias: Vector2::zeros(),
            inverse: Inverse2::default(),
            drive: MotorAndLimits::default(),
        }
    }

    one_body! {}

    /// The point of the world.
    #[doc(alias = "Anchor")]
    pub fn anchor(&self) -> Vector2 {
        self.anchor
    }

    checked_properties! {
        /// Maximum impulse of the warm start and of each solver iteration, in mass units · length units/s. Default
        /// [`f32::MAX`]: no limit. With any smaller value the impulse is normalised and rescaled even if it is within
        /// the limit, which changes its last digits.
        #[doc(alias = "MaxImpulse")]
        max_impulse, set_max_impulse;
    }

    /// Attaches the body at a point of the world, at the body's present pose. The impulse stays.
    pub(crate) fn set_anchor(&mut self, anchor: Vector2, body: &Body) -> Result<()> {
        finite_vector("anchor", anchor)?;
        self.local_anchor = finite_vector("anchor", body.get_local_position(anchor))?;
        self.anchor = anchor;
        self.drive.set_reference(None, body);
        Ok(())
    }

    pub(crate) fn pre_step(
        &mut self,
        step: JointStep,
        poses: &[JointPose; 2],
        bodies: &mut JointBodies,
    ) -> f32 {
        let r = poses[0].rotate(self.local_anchor);
        self.arm = r;
        let body = bodies.first();
        let (m, i) = (body.inverse_mass, body.inverse_inertia);
        let k11 = m + i * r.y * r.y;
        let k12 = 0.0 + -i * r.x * r.y;
        let k22 = m + i * r.x * r.x;
        self.inverse = Inverse2::of(k11, k12, k22, step.softness);

        let error = self.anchor - (poses[0].position + r);
        self.velocity_bias = error * step.correction();

        let impulse = self.limited(-self.accumulated);
        bodies.first_mut().apply_impulse_at(impulse, r);
        length(error)
    }

    pub(crate) fn solve(&mut self, softness: f32, bodies: &mut JointBodies) -> bool {
        let velocity = -bodies.first().velocity_at(self.arm);
        let difference = self.velocity_bias - velocity;
        let impulse = self.inverse.apply(difference - self.accumulated * softness);
        self.accumulated += impulse;
        // The original tests the difference, not the impulse.
        if !is_non_zero(difference) {
            return false;
        }
        let impulse = self.limited(-impulse);
        bodies.first_mut().apply_impulse_at(impulse, self.arm);
        true
    }

    #[inline]
    fn limited(&self, mut impulse: Vector2) -> Vector2 {
        if self.max_impulse < f32::MAX { truncate(&mut impulse, self.max_impulse) } else { impulse }
    }

    pub(crate) fn forget_impulse(&mut self) {
        self.accumulated = Vector2::zeros();
    }

    pub(crate) fn impulse_is_finite(&self) -> bool {
        self.accumulated.iter().all(|number| number.is_finite())
    }

    pub(crate) fn is_valid(&self) -> bool {
        let vectors = [self.anchor, self.local_anchor];
        self.max_impulse.is_finite()
            && vectors.iter().all(|v| v.x.is_finite() && v.y.is_finite())
            && self.drive.is_valid()
    }
}
