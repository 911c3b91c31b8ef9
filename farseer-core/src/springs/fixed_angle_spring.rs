//! Fixed angle spring: a torque toward an angle of a body (behaviour chapter 11, section 5).

use serde::{Deserialize, Serialize};

use crate::body::entry::Bodies;
use crate::body::missing_body::missing_body_id;
use crate::body::{Body, BodyId};
use crate::checked_properties::checked_properties;
use crate::error::Result;
use crate::math::finite::finite;
use crate::springs::angle_spring::limited;
use crate::springs::discrete_spring::inverse_inertia;
use crate::springs::spring_body::SpringBody;
use crate::springs::{Spring, SpringConstants, SpringEvaluation, SpringForce, SpringKind};

/// Turns a body toward an angle.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct FixedAngleSpring {
    pub(crate) body: BodyId,
    target_angle: f32,
    max_torque: f32,
    torque_multiplier: f32,
}

impl FixedAngleSpring {
    pub(crate) fn new(body: (BodyId, &Body), spring_constant: f32, damping_constant: f32) -> Result<Spring> {
        let kind = SpringKind::FixedAngle(FixedAngleSpring {
            body: body.0,
            target_angle: finite("total_rotation", body.1.total_rotation())?,
            ..FixedAngleSpring::without_bodies()
        });
        Spring::of(kind, spring_constant, damping_constant)
    }

    pub(crate) fn without_bodies() -> Self {
        FixedAngleSpring {
            body: missing_body_id(),
            target_angle: 0.0,
            max_torque: f32::MAX,
            torque_multiplier: 1.0,
        }
    }

    /// The body.
    #[doc(alias = "Body")]
    pub fn body(&self) -> BodyId {
        self.body
    }

    checked_properties! {
        /// Target total rotation in radians, of any size: at first that of the body when the spring was made, or 0 if
        /// it was made without its body.
        #[doc(alias = "TargetAngle")]
        target_angle, set_target_angle;
        /// Maximum torque, in mass units · length units²/s²; a negative one acts in the wrong direction. Default
        /// [`f32::MAX`].
        #[doc(alias = "MaxTorque")]
        max_torque, set_max_torque;
        /// Factor of the torque before it is limited, dimensionless; its sign has no effect. Default 1.
        #[doc(alias = "TorqueMultiplier")]
        torque_multiplier, set_torque_multiplier;
    }

    pub(crate) fn evaluate(&self, constants: SpringConstants, bodies: &Bodies) -> SpringEvaluation {
        let Some(body) = bodies.get(self.body).map(|entry| &entry.body) else {
            return SpringEvaluation::None;
        };
        if !body.is_integrated() {
            return SpringEvaluation::None;
        }
        let error = self.target_angle - body.total_rotation();
        let constants = constants.for_step(|| inverse_inertia(body));
        let torque = constants.spring * error - constants.damping * body.angular_velocity();
        let torque = limited(torque, self.torque_multiplier, self.max_torque);
        if !(error.is_finite() && SpringBody::of(body).with_torque(torque).is_finite()) {
            return SpringEvaluation::NotFinite;
        }
        let push = (torque != 0.0).then_some(SpringForce::Torque { body: self.body, torque });
        SpringEvaluation::Done { error, has_acted: push.is_some(), forces: [push, None] }
    }

    pub(crate) fn is_valid(&self) -> bool {
        [self.target_angle, self.max_torque, self.torque_multiplier].iter().all(|number| number.is_finite())
    }
}
