//! Joints keep bodies at a distance, an angle or a point by changing their velocities (behaviour chapter 10).
//!
//! A joint corrects a fraction of its error per update, the bias factor, in as many passes as the simulator has
//! [iterations](crate::PhysicsSimulator::iterations). Angles are in radians, distances in the user's unit.

// What is made of a kind is always the whole joint.
#![expect(clippy::new_ret_no_self)]

mod anchor_distance;
mod angle_joint;
mod angle_limit_joint;
mod bodies;
mod drive;
mod fixed_angle_joint;
mod fixed_angle_limit_joint;
mod fixed_revolute_joint;
pub(crate) mod held;
pub(crate) mod joint_body;
mod kinds;
mod limit;
mod pin_joint;
mod prismatic_joint;
mod revolute_joint;
mod shared_point;
mod slider_joint;
mod weld_joint;

use serde::{Deserialize, Serialize};

pub use angle_joint::AngleJoint;
pub use angle_limit_joint::AngleLimitJoint;
pub(crate) use drive::Drive;
pub use drive::{JointLimits, JointMotor};
pub use fixed_angle_joint::FixedAngleJoint;
pub use fixed_angle_limit_joint::FixedAngleLimitJoint;
pub use fixed_revolute_joint::FixedRevoluteJoint;
pub use kinds::{JointKind, JointType};
pub use pin_joint::PinJoint;
pub use prismatic_joint::PrismaticJoint;
pub use revolute_joint::RevoluteJoint;
pub use slider_joint::SliderJoint;
pub use weld_joint::WeldJoint;

use crate::body::BodyId;
use crate::checked_properties::checked_properties;
use crate::math::Vector2;
use crate::math::scalar::nearest_finite;
use crate::math::vector2::length;
use crate::storage::collection::Collection;
use joint_body::{JointBodies, JointPose, JointStep};
use kinds::each_kind;

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
    /// Of the last update, on the second body; the precise set's. In f64, so that impulses that hold what stands still hold it still in
    /// the next update.
    force: [f64; 3],
    force_along_depth: f32,
    greatest_force: f32,
    greatest_torque: f32,
    kind: JointKind,
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
            force: [0.0; 3],
            force_along_depth: 0.0,
            greatest_force: f32::MAX,
            greatest_torque: f32::MAX,
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
        /// Greatest force with which the joint holds, in the user's unit of mass times length per s^2: one that had to hold
        /// with more in the mean of an update breaks at its end. Default [`f32::MAX`]. Only the
        /// [precise set](crate::Methods::Precise) measures forces; there hardly any error is left for
        /// [`breakpoint`](Self::breakpoint) to measure.
        greatest_force, set_greatest_force;
        /// Greatest torque with which the joint holds the angle of its bodies, in the user's unit of mass times length^2
        /// per s^2, as [`greatest_force`](Self::greatest_force). Default [`f32::MAX`].
        greatest_torque, set_greatest_torque;
    }

    /// The force with which the joint held its second body, or its only one, in the mean of the last update, in
    /// the user's unit of mass times length per s^2; the first body felt the opposite. Zero with the faithful set, which
    /// does not measure it.
    pub fn force(&self) -> Vector2 {
        Vector2::new(self.force[0] as f32, self.force[1] as f32)
    }

    /// The torque with which the joint held the angle of its second body, or its only one, as [`force`](Self::force): what
    /// a force at its anchor does to turn a body is not in it.
    pub fn torque(&self) -> f32 {
        self.force[2] as f32
    }

    /// What of the [force](Self::force) was along the depth axis, in an engine that has one: of pins and sliders, and of what
    /// hangs together with them. 0 of all others.
    pub fn force_along_depth(&self) -> f32 {
        self.force_along_depth
    }

    pub(crate) fn force_and_torque(&self) -> [f64; 3] {
        self.force
    }

    /// Notes what held the joint at the end of an update. Answers whether the mean over the update was too much; the joint is disabled
    /// then, and tells that.
    pub(crate) fn bear(&mut self, force: [f64; 3], mean: [f64; 3], along_depth: f32) -> bool {
        let finite = |number: f64| if number.abs() <= f64::from(f32::MAX) { number } else { 0.0 };
        let mean = mean.map(finite);
        let [x, y, torque] = mean.map(|number| number as f32);
        self.force_along_depth = finite(along_depth.into()) as f32;
        let in_plane = length(Vector2::new(x, y));
        let size = if self.force_along_depth == 0.0 {
            in_plane
        } else {
            length(Vector2::new(in_plane, self.force_along_depth))
        };
        let breaks = self.enabled && self.is_overloaded([size, torque]);
        if breaks {
            self.enabled = false;
        }
        self.force = if breaks { mean } else { force.map(finite) };
        breaks
    }

    /// Whether a force and a torque are more than the joint bears.
    fn is_overloaded(&self, [force, torque]: [f32; 2]) -> bool {
        !(force <= self.greatest_force && torque.abs() <= self.greatest_torque)
    }

    /// Whether it bears what held it in the last update.
    pub(crate) fn bears_its_load(&self) -> bool {
        let [x, y, torque] = self.force.map(|number| number as f32);
        let force = length(Vector2::new(length(Vector2::new(x, y)), self.force_along_depth));
        !self.is_overloaded([force, torque])
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
        each_kind!(&self.kind, joint => joint.bodies())
    }

    /// The joint of its kind.
    pub fn kind(&self) -> &JointKind {
        &self.kind
    }

    /// The [motor](crate::Objects::set_joint_motor) that drives the joint.
    pub fn motor(&self) -> Option<JointMotor> {
        self.drive()?.motor()
    }

    /// The [limits](crate::Objects::set_joint_limits) within which the joint may move.
    pub fn limits(&self) -> Option<JointLimits> {
        self.drive()?.limits()
    }

    /// What of a joint leaves a way free on which it can be driven.
    pub(crate) fn drive(&self) -> Option<&Drive> {
        match &self.kind {
            JointKind::Revolute(joint) => Some(&joint.drive),
            JointKind::FixedRevolute(joint) => Some(&joint.drive),
            JointKind::Prismatic(joint) => Some(&joint.drive),
            _ => None,
        }
    }

    pub(crate) fn drive_mut(&mut self) -> Option<&mut Drive> {
        match &mut self.kind {
            JointKind::Revolute(joint) => Some(&mut joint.drive),
            JointKind::FixedRevolute(joint) => Some(&mut joint.drive),
            JointKind::Prismatic(joint) => Some(&mut joint.drive),
            _ => None,
        }
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
        each_kind!(&mut self.kind, joint => joint.bodies_mut())
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
        let has_acted = each_kind!(&mut self.kind, joint => joint.solve(softness, bodies));
        if !self.is_impulse_finite() {
            bodies.spoil();
        }
        has_acted
    }

    /// Forgets the impulse, so that the next pre-step starts afresh.
    pub(crate) fn forget_impulse(&mut self) {
        each_kind!(&mut self.kind, joint => joint.forget_impulse());
        (self.force, self.force_along_depth) = ([0.0; 3], 0.0);
    }

    fn is_impulse_finite(&self) -> bool {
        each_kind!(&self.kind, joint => joint.impulse_is_finite())
    }

    /// Whether settings and impulse are finite. What the pre-step makes anew from the bodies need not be, and is
    /// saved as bits: the velocities that come of it are looked at before a body gets them.
    pub(crate) fn is_valid(&self) -> bool {
        let settings =
            [self.bias_factor, self.breakpoint, self.softness, self.greatest_force, self.greatest_torque];
        settings.iter().chain([&self.force_along_depth]).all(|number| number.is_finite())
            && self.force.iter().all(|number| number.abs() <= f64::from(f32::MAX))
            && self.is_impulse_finite()
            && each_kind!(&self.kind, joint => joint.is_valid())
    }
}
