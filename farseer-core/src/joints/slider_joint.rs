//! Slider joint: two anchors whose distance stays in a range (behaviour chapter 10, section 13).

use serde::{Deserialize, Serialize};

use crate::body::missing_body::missing_body_id;
use crate::body::{Body, BodyId};
use crate::checked_properties::checked_properties;
use crate::error::Result;
use crate::joints::anchor_distance::{AnchorDistance, two_anchors};
use crate::joints::bodies::two_bodies;
use crate::joints::joint_body::{JointBodies, JointPose, JointStep};
use crate::joints::limit::{Limit, range_properties};
use crate::joints::{DEFAULT_SLOP, Joint, JointKind};
use crate::math::Vector2;
use crate::math::finite::finite;

/// Holds the distance of an anchor of one body and an anchor of another in a range, like a rope or a telescope.
///
/// Under the [precise set](crate::Methods::Precise) of an engine with depth the anchors are at the depths of their bodies, and
/// the joint acts along all three axes.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct SliderJoint {
    body1: BodyId,
    body2: BodyId,
    pub(super) anchors: AnchorDistance,
    min: f32,
    max: f32,
    slop: f32,
    limit: Limit,
    /// Whether setters refuse a range that ends before it begins. Set whenever the joint is borrowed for edits.
    #[serde(skip)]
    refuses_reversed: bool,
    #[serde(with = "crate::storage::bits")]
    velocity_bias: f32,
}

impl SliderJoint {
    pub(crate) fn new(
        body1: (BodyId, &Body),
        anchor1: Vector2,
        body2: (BodyId, &Body),
        anchor2: Vector2,
        min: f32,
        max: f32,
    ) -> Result<Joint> {
        Ok(Joint::of(JointKind::Slider(SliderJoint {
            body1: body1.0,
            body2: body2.0,
            anchors: AnchorDistance::new(anchor1, body1.1, anchor2, body2.1)?,
            min: finite("min", min)?,
            max: finite("max", max)?,
            ..SliderJoint::without_bodies()
        })))
    }

    pub(crate) fn without_bodies() -> Self {
        SliderJoint {
            body1: missing_body_id(),
            body2: missing_body_id(),
            anchors: AnchorDistance::default(),
            min: 0.0,
            max: 0.0,
            slop: DEFAULT_SLOP,
            limit: Limit::default(),
            refuses_reversed: false,
            velocity_bias: 0.0,
        }
    }

    two_bodies! {}

    two_anchors! {}

    range_properties! {
        /// Minimum distance of the anchors, in length units.
        #[doc(alias = "Min")]
        min, set_min;
        /// Maximum distance of the anchors, in length units.
        #[doc(alias = "Max")]
        max, set_max;
        set_range
    }

    checked_properties! {
        /// Violation in length units up to which the distance is not corrected; the velocity is. Default 0.01.
        #[doc(alias = "Slop")]
        slop, set_slop;
    }

    /// The first body's position plus its arm at the last setter or pre-step.
    pub(crate) fn current_anchor(&self, body1: &Body) -> Vector2 {
        body1.position() + self.anchors.arm1
    }

    pub(crate) fn pre_step(
        &mut self,
        step: JointStep,
        poses: &[JointPose; 2],
        bodies: &mut JointBodies,
    ) -> f32 {
        let distance = self.anchors.update_anchors(poses);
        let error = self.limit.update(distance, self.min, self.max, self.slop);
        self.velocity_bias = step.bias_factor * step.inverse_dt * error;
        self.anchors.prepare(distance, step.softness, self.limit.accumulated, bodies);
        error
    }

    pub(crate) fn solve(&mut self, softness: f32, bodies: &mut JointBodies) -> bool {
        if !self.limit.is_violated() {
            return false;
        }
        let wanted = -self.velocity_bias - self.anchors.speed(bodies) - softness * self.limit.accumulated;
        let magnitude = self.limit.accumulate(wanted * self.anchors.effective_mass);
        self.anchors.apply_along_line(magnitude, bodies)
    }

    pub(crate) fn forget_impulse(&mut self) {
        self.limit = Limit::default();
    }

    pub(crate) fn impulse_is_finite(&self) -> bool {
        self.limit.accumulated.is_finite()
    }

    pub(crate) fn is_valid(&self) -> bool {
        let numbers = [self.min, self.max, self.slop];
        self.anchors.is_valid() && numbers.iter().all(|number| number.is_finite())
    }
}
