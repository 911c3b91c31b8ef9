//! Joints keep bodies at a distance, an angle or a point by changing their velocities (behaviour chapter 10).
//!
//! A joint corrects a fraction of its error per update, the bias factor, in as many passes as the simulator has
//! [iterations](crate::PhysicsSimulator::iterations). Angles are in radians, distances in the user's unit.

// What is made of a kind is always the whole joint.
#![expect(clippy::new_ret_no_self)]

mod anchor_distance;
mod angle_joint;
mod angle_limit_joint;
mod fixed_angle_joint;
mod fixed_angle_limit_joint;
mod fixed_revolute_joint;
pub(crate) mod joint_body;
mod joint_type;
mod limit;
mod pin_joint;
mod revolute_joint;
mod shared_point;
mod slider_joint;
mod weld_joint;

use serde::{Deserialize, Serialize};

pub use angle_joint::AngleJoint;
pub use angle_limit_joint::AngleLimitJoint;
pub use fixed_angle_joint::FixedAngleJoint;
pub use fixed_angle_limit_joint::FixedAngleLimitJoint;
pub use fixed_revolute_joint::FixedRevoluteJoint;
pub use joint_type::JointType;
pub use pin_joint::PinJoint;
pub use revolute_joint::RevoluteJoint;
pub use slider_joint::SliderJoint;
pub use weld_joint::WeldJoint;

use crate::body::BodyId;
use crate::checked_properties::checked_properties;
use crate::math::Vector2;
use crate::math::scalar::nearest_finite;
use crate::storage::collection::Collection;
use joint_body::{JointBodies, JointPose, JointStep};

/// The joints of a simulator.
pub(crate) type Joints = Collection<Joint, JointId>;

crate::storage::arena::define_id! {
    /// Names a [`Joint`] of a simulator: the one that made it, its clones and what is loaded from its saves.
    JointId
}

const DEFAULT_BIAS_FACTOR: f32 = 0.2;
const DEFAULT_SLOP: f32 = 0.01;

/// What all joints have in common, and the joint of a certain kind.
///
/// Joints are made by [`JointFactory`](crate::JointFactory), or without bodies by
/// [`create_empty_joint`](crate::PhysicsSimulator::create_empty_joint). A joint in the simulation goes when one of its
/// bodies is disposed; another one when it is added.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Joint {
    bias_factor: f32,
    breakpoint: f32,
    softness: f32,
    #[serde(with = "crate::storage::bits")]
    joint_error: f32,
    enabled: bool,
    tag: u64,
    kind: JointKind,
}

/// The kinds of joints.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[non_exhaustive]
pub enum JointKind {
    /// Two bodies at a fixed angle to each other.
    Angle(AngleJoint),
    /// Two bodies whose angle to each other stays in a range.
    AngleLimit(AngleLimitJoint),
    /// A body at a fixed angle.
    FixedAngle(FixedAngleJoint),
    /// A body whose angle stays in a range.
    FixedAngleLimit(FixedAngleLimitJoint),
    /// A body that turns about a point of the world.
    FixedRevolute(FixedRevoluteJoint),
    /// Two anchors at a fixed distance.
    Pin(PinJoint),
    /// Two bodies that turn about a common point.
    Revolute(RevoluteJoint),
    /// Two anchors whose distance stays in a range.
    Slider(SliderJoint),
    /// Two bodies that share a point and an angle.
    Weld(WeldJoint),
}

/// Does the same to the joint of whatever kind.
macro_rules! each_kind {
    ($kind:expr, $joint:ident => $do:expr) => {
        match $kind {
            JointKind::Angle($joint) => $do,
            JointKind::AngleLimit($joint) => $do,
            JointKind::FixedAngle($joint) => $do,
            JointKind::FixedAngleLimit($joint) => $do,
            JointKind::FixedRevolute($joint) => $do,
            JointKind::Pin($joint) => $do,
            JointKind::Revolute($joint) => $do,
            JointKind::Slider($joint) => $do,
            JointKind::Weld($joint) => $do,
        }
    };
}

impl Joint {
    fn of(kind: JointKind) -> Self {
        let bias_factor = match kind {
            JointKind::FixedRevolute(_) => fixed_revolute_joint::BIAS_FACTOR,
            _ => DEFAULT_BIAS_FACTOR,
        };
        Joint {
            bias_factor,
            breakpoint: f32::MAX,
            softness: 0.0,
            joint_error: 0.0,
            enabled: true,
            tag: 0,
            kind,
        }
    }

    checked_properties! {
        /// Fraction of the error that an update corrects. Default 0.2; 0.8 for a [`FixedRevoluteJoint`].
        #[doc(alias = "BiasFactor")]
        bias_factor, set_bias_factor;
        /// Greatest error the joint bears, whatever its sign; beyond it the joint breaks: it is disabled and
        /// [`Event::JointBroke`](crate::Event::JointBroke) is reported. A negative one breaks at once. Default
        /// [`f32::MAX`].
        #[doc(alias = "Breakpoint")]
        breakpoint, set_breakpoint;
        /// How much the joint yields; what the number means depends on the kind. Default 0: not at all.
        #[doc(alias = "Softness")]
        softness, set_softness;
    }

    /// Error of the last update that found the joint enabled and a body it could move: an angle in radians or a
    /// length. One that is no finite number, because the anchors are too far away, is shown as the greatest there is.
    #[doc(alias = "JointError")]
    pub fn joint_error(&self) -> f32 {
        nearest_finite(self.joint_error)
    }

    /// Whether the joint takes part in the simulation. Default true.
    #[doc(alias = "Enabled")]
    pub fn enabled(&self) -> bool {
        self.enabled
    }

    /// Sets [`enabled`](Self::enabled). A joint that broke resumes with the impulse it had, and breaks again if its
    /// error is still beyond the breakpoint.
    pub fn set_enabled(&mut self, value: bool) {
        self.enabled = value;
    }

    /// A number for the user's own purposes. Default 0.
    #[doc(alias = "Tag")]
    pub fn tag(&self) -> u64 {
        self.tag
    }

    /// Sets [`tag`](Self::tag).
    pub fn set_tag(&mut self, value: u64) {
        self.tag = value;
    }

    /// The first body, or the only one. The id names nothing until the first one of a joint that was made without bodies
    /// is set: `simulator.body(joint.body1())` is `None` then.
    pub fn body1(&self) -> BodyId {
        self.bodies().0
    }

    /// The second body, if the joint is one between two bodies. Until it is set the id names nothing, as that of
    /// [`body1`](Self::body1).
    pub fn body2(&self) -> Option<BodyId> {
        self.bodies().1
    }

    fn bodies(&self) -> (BodyId, Option<BodyId>) {
        match &self.kind {
            JointKind::Angle(joint) => (joint.body1, Some(joint.body2)),
            JointKind::AngleLimit(joint) => (joint.body1, Some(joint.body2)),
            JointKind::FixedAngle(joint) => (joint.body, None),
            JointKind::FixedAngleLimit(joint) => (joint.body, None),
            JointKind::FixedRevolute(joint) => (joint.body, None),
            JointKind::Pin(joint) => (joint.body1, Some(joint.body2)),
            JointKind::Revolute(joint) => (joint.body1, Some(joint.body2)),
            JointKind::Slider(joint) => (joint.body1, Some(joint.body2)),
            JointKind::Weld(joint) => (joint.body1, Some(joint.body2)),
        }
    }

    /// The joint of its kind.
    pub fn kind(&self) -> &JointKind {
        &self.kind
    }

    pub(crate) fn kind_mut(&mut self) -> &mut JointKind {
        &mut self.kind
    }

    pub(crate) fn set_body1(&mut self, body: BodyId) {
        *self.bodies_mut().0 = body;
    }

    /// Does nothing to a joint of one body.
    pub(crate) fn set_body2(&mut self, body: BodyId) {
        if let Some(body2) = self.bodies_mut().1 {
            *body2 = body;
        }
    }

    fn bodies_mut(&mut self) -> (&mut BodyId, Option<&mut BodyId>) {
        match &mut self.kind {
            JointKind::Angle(joint) => (&mut joint.body1, Some(&mut joint.body2)),
            JointKind::AngleLimit(joint) => (&mut joint.body1, Some(&mut joint.body2)),
            JointKind::FixedAngle(joint) => (&mut joint.body, None),
            JointKind::FixedAngleLimit(joint) => (&mut joint.body, None),
            JointKind::FixedRevolute(joint) => (&mut joint.body, None),
            JointKind::Pin(joint) => (&mut joint.body1, Some(&mut joint.body2)),
            JointKind::Revolute(joint) => (&mut joint.body1, Some(&mut joint.body2)),
            JointKind::Slider(joint) => (&mut joint.body1, Some(&mut joint.body2)),
            JointKind::Weld(joint) => (&mut joint.body1, Some(&mut joint.body2)),
        }
    }

    /// The breaking test. Answers whether the joint broke just now; it is disabled then. As in the original the
    /// pass that finds it broken still acts.
    pub(crate) fn breaks(&mut self) -> bool {
        let holds = self.joint_error.abs() <= self.breakpoint;
        let breaks = self.enabled && !holds;
        if breaks {
            self.enabled = false;
        }
        breaks
    }

    /// Finds the error, prepares the passes and applies the impulse of the last step. The simulator has seen to it
    /// that the joint is enabled and that a body is enabled and one is not static.
    pub(crate) fn pre_step(&mut self, inverse_dt: f32, poses: &[JointPose; 2], bodies: &mut JointBodies) {
        let step = JointStep { inverse_dt, bias_factor: self.bias_factor, softness: self.softness };
        self.joint_error = each_kind!(&mut self.kind, joint => joint.pre_step(step, poses, bodies));
    }

    /// One pass; answers whether the original raises JointUpdated.
    pub(crate) fn solve(&mut self, bodies: &mut JointBodies) -> bool {
        let softness = self.softness;
        let has_acted = match &mut self.kind {
            JointKind::Angle(joint) => joint.solve(bodies),
            JointKind::AngleLimit(joint) => joint.solve(softness, bodies),
            JointKind::FixedAngle(joint) => joint.solve(bodies),
            JointKind::FixedAngleLimit(joint) => joint.solve(softness, bodies),
            JointKind::FixedRevolute(joint) => joint.solve(softness, bodies),
            JointKind::Pin(joint) => joint.solve(softness, bodies),
            JointKind::Revolute(joint) => joint.solve(softness, bodies),
            JointKind::Slider(joint) => joint.solve(softness, bodies),
            JointKind::Weld(joint) => joint.solve(softness, bodies),
        };
        if !self.is_impulse_finite() {
            bodies.spoil();
        }
        has_acted
    }

    /// Forgets the impulse, so that the next pre-step starts afresh.
    pub(crate) fn forget_impulse(&mut self) {
        match &mut self.kind {
            JointKind::Angle(_) | JointKind::FixedAngle(_) => {}
            JointKind::AngleLimit(joint) => joint.limit = limit::Limit::default(),
            JointKind::FixedAngleLimit(joint) => joint.limit = limit::Limit::default(),
            JointKind::Slider(joint) => joint.limit = limit::Limit::default(),
            JointKind::Pin(joint) => joint.accumulated = 0.0,
            JointKind::FixedRevolute(joint) => joint.accumulated = Vector2::zeros(),
            JointKind::Revolute(joint) => joint.point.accumulated = Vector2::zeros(),
            JointKind::Weld(joint) => joint.point.accumulated = Vector2::zeros(),
        }
    }

    fn is_impulse_finite(&self) -> bool {
        let finite = |v: Vector2| v.x.is_finite() && v.y.is_finite();
        match &self.kind {
            JointKind::Angle(_) | JointKind::FixedAngle(_) => true,
            JointKind::AngleLimit(joint) => joint.limit.accumulated.is_finite(),
            JointKind::FixedAngleLimit(joint) => joint.limit.accumulated.is_finite(),
            JointKind::Slider(joint) => joint.limit.accumulated.is_finite(),
            JointKind::Pin(joint) => joint.accumulated.is_finite(),
            JointKind::FixedRevolute(joint) => finite(joint.accumulated),
            JointKind::Revolute(joint) => finite(joint.point.accumulated),
            JointKind::Weld(joint) => finite(joint.point.accumulated),
        }
    }

    /// Whether settings and impulse are finite. What the pre-step makes anew from the bodies need not be, and is
    /// saved as bits: the velocities that come of it are looked at before a body gets them.
    pub(crate) fn is_valid(&self) -> bool {
        let settings = [self.bias_factor, self.breakpoint, self.softness];
        settings.iter().all(|number| number.is_finite())
            && self.is_impulse_finite()
            && each_kind!(&self.kind, joint => joint.is_valid())
    }
}
