//! Angle spring: torques toward a relative angle of two bodies (behaviour chapter 11, section 4).

use serde::{Deserialize, Serialize};

use crate::body::entry::Bodies;
use crate::body::missing_body::missing_body_id;
use crate::body::{Body, BodyId};
use crate::checked_properties::checked_properties;
use crate::error::Result;
use crate::math::finite::finite;
use crate::math::scalar;
use crate::springs::discrete_spring::inverse_inertia;
use crate::springs::spring_body::{SpringBody, may_act};
use crate::springs::{Spring, SpringConstants, SpringEvaluation, SpringForce, SpringKind};

/// Maximum absolute target angle that can be set, in radians. Farseer's value.
const TARGET_ANGLE_LIMIT: f32 = 5.5;

/// Turns two bodies toward a relative angle. As in the original the damping uses the angular velocity of each body, not
/// the difference.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct AngleSpring {
    pub(crate) body1: BodyId,
    pub(crate) body2: BodyId,
    target_angle: f32,
    max_torque: f32,
    torque_multiplier: f32,
}

impl AngleSpring {
    pub(crate) fn new(
        body1: (BodyId, &Body),
        body2: (BodyId, &Body),
        spring_constant: f32,
        damping_constant: f32,
    ) -> Result<Spring> {
        let target_angle = body2.1.total_rotation() - body1.1.total_rotation();
        let kind = SpringKind::Angle(AngleSpring {
            body1: body1.0,
            body2: body2.0,
            target_angle: finite("total_rotation", target_angle)?,
            ..AngleSpring::without_bodies()
        });
        Spring::of(kind, spring_constant, damping_constant)
    }

    pub(crate) fn without_bodies() -> Self {
        AngleSpring {
            body1: missing_body_id(),
            body2: missing_body_id(),
            target_angle: 0.0,
            max_torque: f32::MAX,
            torque_multiplier: 1.0,
        }
    }

    /// The first body.
    #[doc(alias = "Body1")]
    pub fn body1(&self) -> BodyId {
        self.body1
    }

    /// The second body.
    #[doc(alias = "Body2")]
    pub fn body2(&self) -> BodyId {
        self.body2
    }

    /// Target of the second body's total rotation minus that of the first, in radians: at first their angle when the
    /// spring was made, or 0 if it was made without its bodies.
    #[doc(alias = "TargetAngle")]
    pub fn target_angle(&self) -> f32 {
        self.target_angle
    }

    /// Sets [`target_angle`](Self::target_angle), clamped to the range from -5.5 to 5.5 radians.
    ///
    /// # Errors
    /// A value that is not finite.
    pub fn set_target_angle(&mut self, value: f32) -> Result<()> {
        self.target_angle = finite("target_angle", value)?.clamp(-TARGET_ANGLE_LIMIT, TARGET_ANGLE_LIMIT);
        Ok(())
    }

    checked_properties! {
        /// Maximum torque on a body, in mass units · length units²/s²; a negative one acts in the wrong direction.
        /// Default [`f32::MAX`].
        #[doc(alias = "MaxTorque")]
        max_torque, set_max_torque;
        /// Factor of the torque before it is limited, dimensionless; its sign has no effect. Default 1.
        #[doc(alias = "TorqueMultiplier")]
        torque_multiplier, set_torque_multiplier;
    }

    pub(crate) fn evaluate(&self, constants: SpringConstants, bodies: &Bodies) -> SpringEvaluation {
        let (Some(entry1), Some(entry2)) = (bodies.get(self.body1), bodies.get(self.body2)) else {
            return SpringEvaluation::None;
        };
        let (body1, body2) = (&entry1.body, &entry2.body);
        if !may_act(body1, body2) {
            return SpringEvaluation::None;
        }
        let error = body2.total_rotation() - (body1.total_rotation() + self.target_angle);
        let constants = constants.for_step(|| inverse_inertia(body1) + inverse_inertia(body2));
        let torque = constants.spring * error;
        let torque1 = self.torque_on(body1, torque, constants.damping);
        let torque2 = self.torque_on(body2, -torque, constants.damping);

        let load1 = SpringBody::of(body1).with_torque(torque1);
        let before2 = if self.body1 == self.body2 { load1 } else { SpringBody::of(body2) };
        if !(error.is_finite() && load1.is_finite() && before2.with_torque(torque2).is_finite()) {
            return SpringEvaluation::NotFinite;
        }
        let pushes = [(self.body1, torque1), (self.body2, torque2)]
            .map(|(body, torque)| (torque != 0.0).then_some(SpringForce::Torque { body, torque }));
        SpringEvaluation::Done { error, has_acted: torque1 != 0.0 || torque2 != 0.0, forces: pushes }
    }

    /// The torque on one of the bodies; 0 on one that is immovable.
    fn torque_on(&self, body: &Body, torque: f32, damping: f32) -> f32 {
        if body.is_immovable() {
            return 0.0;
        }
        limited(torque - damping * body.angular_velocity(), self.torque_multiplier, self.max_torque)
    }

    pub(crate) fn is_valid(&self) -> bool {
        [self.target_angle, self.max_torque, self.torque_multiplier].iter().all(|number| number.is_finite())
    }
}

/// A torque multiplied and limited; its sign is that before the multiplication.
#[inline]
pub(crate) fn limited(torque: f32, multiplier: f32, max_torque: f32) -> f32 {
    scalar::min((torque * multiplier).abs(), max_torque) * scalar::sign(torque)
}
