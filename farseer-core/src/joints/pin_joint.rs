//! Pin joint: two anchors at a fixed distance (behaviour chapter 10, section 12).

use serde::{Deserialize, Serialize};

use crate::body::missing_body::missing_body_id;
use crate::body::{Body, BodyId};
use crate::checked_properties::checked_properties;
use crate::error::Result;
use crate::joints::anchor_distance::{AnchorDistance, two_anchors};
use crate::joints::bodies::two_bodies;
use crate::joints::joint_body::{JointBodies, JointPose, JointStep};
use crate::joints::{Joint, JointKind};
use crate::math::Vector2;
use crate::math::finite::finite;
use crate::math::vector2::length;

/// Holds an anchor of one body at a fixed distance from an anchor of another, like a rod.
///
/// Anchors at the same point define no direction: the impulse accumulates without effect, and acts all at once when
/// they separate.
///
/// Under the [precise set](crate::Methods::Precise) of an engine with depth the anchors are at the depths of their
/// bodies, and the joint acts along all three axes; its initial distance is that in the plane.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct PinJoint {
    body1: BodyId,
    body2: BodyId,
    pub(super) anchors: AnchorDistance,
    target_distance: f32,
    accumulated: f32,
    #[serde(with = "crate::storage::bits")]
    velocity_bias: f32,
}

impl PinJoint {
    pub(crate) fn new(
        body1: (BodyId, &Body),
        anchor1: Vector2,
        body2: (BodyId, &Body),
        anchor2: Vector2,
    ) -> Result<Joint> {
        let anchors = AnchorDistance::new(anchor1, body1.1, anchor2, body2.1)?;
        let distance = length(body2.1.get_world_position(anchor2) - body1.1.get_world_position(anchor1));
        Ok(Joint::of(JointKind::Pin(PinJoint {
            body1: body1.0,
            body2: body2.0,
            anchors,
            target_distance: finite("distance", distance)?,
            ..PinJoint::without_bodies()
        })))
    }

    pub(crate) fn without_bodies() -> Self {
        PinJoint {
            body1: missing_body_id(),
            body2: missing_body_id(),
            anchors: AnchorDistance::default(),
            target_distance: 0.0,
            accumulated: 0.0,
            velocity_bias: 0.0,
        }
    }

    two_bodies! {}

    two_anchors! {}

    checked_properties! {
        /// Target distance of the anchors, in length units: at first their distance when the joint was made, or 0 if it
        /// was made without its bodies. New anchors or bodies do not change it.
        #[doc(alias = "TargetDistance")]
        target_distance, set_target_distance;
    }

    pub(crate) fn pre_step(
        &mut self,
        step: JointStep,
        poses: &[JointPose; 2],
        bodies: &mut JointBodies,
    ) -> f32 {
        let distance = self.anchors.update_anchors(poses);
        let error = distance - self.target_distance;
        self.velocity_bias = step.correction() * error;
        self.anchors.prepare(distance, step.softness, self.accumulated, bodies);
        error
    }

    pub(crate) fn solve(&mut self, softness: f32, bodies: &mut JointBodies) -> bool {
        let wanted = self.velocity_bias - self.anchors.speed(bodies) - softness * self.accumulated;
        let magnitude = wanted * self.anchors.effective_mass;
        self.accumulated += magnitude;
        self.anchors.apply_along_line(magnitude, bodies)
    }

    pub(crate) fn forget_impulse(&mut self) {
        self.accumulated = 0.0;
    }

    pub(crate) fn impulse_is_finite(&self) -> bool {
        self.accumulated.is_finite()
    }

    pub(crate) fn is_valid(&self) -> bool {
        self.anchors.is_valid() && self.target_distance.is_finite()
    }
}
