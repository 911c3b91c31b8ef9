//! Joints: constraints on points, distances or angles of bodies, solved by impulses (behaviour chapter 10).
//!
//! A joint corrects a fraction of its error per update, the bias factor, over all of the simulator's
//! [iterations](crate::PhysicsSimulator::iterations). Angles are in radians, distances in length units.

// Constructors of a kind return the whole joint.
#![expect(clippy::new_ret_no_self)]

mod anchor_distance;
mod angle_joint;
mod angle_limit_joint;
mod angle_spring_joint;
mod bodies;
#[cfg(feature = "precise")]
pub(crate) mod constraint_spec;
mod fixed_angle_joint;
mod fixed_angle_limit_joint;
mod fixed_revolute_joint;
mod gear_joint;
pub(crate) mod joint_body;
mod kinds;
mod limit;
#[cfg(feature = "precise")]
mod load;
mod motor_and_limits;
mod motor_joint;
mod pin_joint;
mod prismatic_joint;
mod pulley_joint;
mod revolute_joint;
mod shared_point;
mod slider_joint;
mod weld_joint;
mod wheel_joint;

use serde::{Deserialize, Serialize};

pub use angle_joint::AngleJoint;
pub use angle_limit_joint::AngleLimitJoint;
pub use angle_spring_joint::AngleSpringJoint;
pub use fixed_angle_joint::FixedAngleJoint;
pub use fixed_angle_limit_joint::FixedAngleLimitJoint;
pub use fixed_revolute_joint::FixedRevoluteJoint;
pub use gear_joint::GearJoint;
pub use kinds::{JointKind, JointType};
pub(crate) use motor_and_limits::MotorAndLimits;
pub use motor_and_limits::{JointLimits, JointMotor, JointServo};
pub use motor_joint::{MotorJoint, PoseServo};
pub use pin_joint::PinJoint;
pub use prismatic_joint::PrismaticJoint;
pub use pulley_joint::PulleyJoint;
pub use revolute_joint::RevoluteJoint;
pub use slider_joint::SliderJoint;
pub use weld_joint::WeldJoint;
pub use wheel_joint::WheelJoint;

use crate::body::BodyId;
use crate::checked_properties::checked_properties;
use crate::math::Vector2;
use crate::math::scalar::nearest_finite;
use crate::storage::collection::Collection;
use crate::{Error, Result};
use joint_body::{JointBodies, JointPose, JointStep};
use kinds::each_kind;

/// The joints of a simulator.
pub(crate) type Joints = Collection<Joint, JointId>;

crate::storage::arena::define_id! {
    /// Id of a [`Joint`], valid in the simulator that made it, in its clones and in simulators loaded from its saves.
    JointId
}

const DEFAULT_BIAS_FACTOR: f32 = 0.2;
const DEFAULT_SLOP: f32 = 0.01;

/// A joint: the settings that all kinds share, and the joint of its kind.
///
/// Joints are made by [`JointFactory`](crate::JointFactory), or without bodies by
/// [`create_empty_joint`](crate::PhysicsSimulator::create_empty_joint). A joint in the simulation is removed when one
/// of its bodies is disposed; a joint that was not added yet is removed when it is added.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Joint {
    bias_factor: f32,
    breakpoint: f32,
    softness: f32,
    #[serde(with = "crate::storage::bits")]
    joint_error: f32,
    enabled: bool,
    tag: u64,
    /// Force and torque on the second body in the last update, computed by the precise set. In f64, so that impulses
    /// that hold bodies at rest still do so in the next update.
    force: [f64; 3],
    /// The part of the servo in the mean force and torque on the second body in the last update. Not in `force`, which the
    /// next update starts with.
    servo_force: [f32; 3],
    force_along_depth: f32,
    greatest_force: f32,
    greatest_torque: f32,
    do_bodies_collide: bool,
    kind: JointKind,
}

/// Refuses a maximum of force or torque that is not finite, or negative.
fn load_limit(argument: &'static str, value: f32) -> Result<f32> {
    if value.is_finite() && value >= 0.0 {
        Ok(value)
    } else {
        Err(Error::invalid(argument, value, "0 or more and finite; f32::MAX stands for no maximum"))
    }
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
            servo_force: [0.0; 3],
            force_along_depth: 0.0,
            greatest_force: f32::MAX,
            greatest_torque: f32::MAX,
            do_bodies_collide: true,
            kind,
        }
    }

    checked_properties! {
        /// Fraction of the error that an update corrects. Default 0.2; 0.8 for a [`FixedRevoluteJoint`].
        #[doc(alias = "BiasFactor")]
        bias_factor, set_bias_factor;
        /// Maximum absolute error, in length units or radians. Beyond it the joint breaks: it is disabled and
        /// [`Event::JointBroke`](crate::Event::JointBroke) is reported. With a negative value it breaks at once.
        /// Default [`f32::MAX`].
        #[doc(alias = "Breakpoint")]
        breakpoint, set_breakpoint;
        /// How far the joint yields to its load; the unit depends on the kind. Default 0: rigid.
        #[doc(alias = "Softness")]
        softness, set_softness;
    }

    /// Maximum force of the joint, in mass units · length units/s². A joint whose mean force in an update is greater
    /// breaks at the end of the update. Default [`f32::MAX`]: none. Only the [precise set](crate::Methods::Precise)
    /// computes forces; there joints have hardly any error for [`breakpoint`](Self::breakpoint) to detect.
    pub fn greatest_force(&self) -> f32 {
        self.greatest_force
    }

    /// Sets [`greatest_force`](Self::greatest_force).
    ///
    /// # Errors
    /// A value that is not finite, or less than 0.
    pub fn set_greatest_force(&mut self, value: f32) -> Result<()> {
        self.greatest_force = load_limit("greatest_force", value)?;
        Ok(())
    }

    /// Maximum torque with which the joint keeps the relative angle of its bodies, in mass units · length units²/s². A
    /// joint breaks by it as by [`greatest_force`](Self::greatest_force). Default [`f32::MAX`]: none.
    pub fn greatest_torque(&self) -> f32 {
        self.greatest_torque
    }

    /// Sets [`greatest_torque`](Self::greatest_torque).
    ///
    /// # Errors
    /// A value that is not finite, or less than 0.
    pub fn set_greatest_torque(&mut self, value: f32) -> Result<()> {
        self.greatest_torque = load_limit("greatest_torque", value)?;
        Ok(())
    }

    /// The mean force of the joint on its second body, or its only one, in the last update, in mass units · length
    /// units/s². The opposite force acts on the first body. Zero with the faithful set, which does not compute it. Of a
    /// joint that broke by its load it stays the force that broke it, until the joint is enabled again.
    pub fn force(&self) -> Vector2 {
        Vector2::new(self.force[0] as f32 + self.servo_force[0], self.force[1] as f32 + self.servo_force[1])
    }

    /// The mean torque with which the joint kept the angle of its second body, or its only one, in mass units · length
    /// units²/s². The torque of [`force`](Self::force) about the body's centre is not included.
    pub fn torque(&self) -> f32 {
        self.force[2] as f32 + self.servo_force[2]
    }

    /// Component of the [force](Self::force) along the depth axis, in mass units · length units/s², in an engine with
    /// depth. It is computed for pin and slider joints and for joints in the same articulation, and 0 for all others.
    pub fn force_along_depth(&self) -> f32 {
        self.force_along_depth
    }

    /// Error of the last update in which the joint was enabled and could move a body, in radians or length units. An
    /// error that is not finite, because the anchors are too far apart, is shown as the greatest finite number.
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

    /// Whether the two bodies of the joint collide with each other. Default true. Set by
    /// [`set_joint_bodies_collide`](crate::Objects::set_joint_bodies_collide).
    #[doc(alias("collideConnected", "contacts_enabled"))]
    pub fn do_bodies_collide(&self) -> bool {
        self.do_bodies_collide
    }

    pub(crate) fn set_bodies_collide(&mut self, value: bool) {
        self.do_bodies_collide = value;
    }

    #[cfg(feature = "precise")]
    /// The bodies that do not collide because of this joint, while it is enabled; the smaller id first.
    pub(crate) fn separated_bodies(&self) -> Option<(BodyId, BodyId)> {
        let (one, other) = (self.body1(), self.body2()?);
        (self.enabled && !self.do_bodies_collide).then(|| (one.min(other), one.max(other)))
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

    /// The first body, or the only one. For a joint that was made without bodies the id is invalid until it is set:
    /// `simulator.body(joint.body1())` is `None` then.
    pub fn body1(&self) -> BodyId {
        self.bodies().0
    }

    /// The second body, if the joint has two. Until it is set the id is invalid, as that of [`body1`](Self::body1).
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

    /// The joint's [motor](crate::Objects::set_joint_motor).
    pub fn motor(&self) -> Option<JointMotor> {
        self.motor_and_limits()?.motor()
    }

    /// The [limits](crate::Objects::set_joint_limits) of the joint's motion.
    pub fn limits(&self) -> Option<JointLimits> {
        self.motor_and_limits()?.limits()
    }

    /// The joint's [servo](crate::Objects::set_joint_servo).
    pub fn servo(&self) -> Option<JointServo> {
        self.motor_and_limits()?.servo()
    }

    /// Whether the joint has a servo, or is one.
    #[cfg(feature = "precise")]
    pub(crate) fn has_servo(&self) -> bool {
        self.servo().is_some() || matches!(self.kind, JointKind::Motor(_))
    }

    /// Motor, limits and servo, for kinds that can have them.
    pub(crate) fn motor_and_limits(&self) -> Option<&MotorAndLimits> {
        match &self.kind {
            JointKind::Revolute(joint) => Some(&joint.drive),
            JointKind::FixedRevolute(joint) => Some(&joint.drive),
            JointKind::Prismatic(joint) => Some(&joint.drive),
            JointKind::Wheel(joint) => Some(&joint.drive),
            JointKind::AngleSpring(joint) => Some(&joint.drive),
            _ => None,
        }
    }

    pub(crate) fn motor_and_limits_mut(&mut self) -> Option<&mut MotorAndLimits> {
        match &mut self.kind {
            JointKind::Revolute(joint) => Some(&mut joint.drive),
            JointKind::FixedRevolute(joint) => Some(&mut joint.drive),
            JointKind::Prismatic(joint) => Some(&mut joint.drive),
            JointKind::Wheel(joint) => Some(&mut joint.drive),
            JointKind::AngleSpring(joint) => Some(&mut joint.drive),
            _ => None,
        }
    }

    /// Makes setters of ranges refuse a range that ends before it begins, or take it as the original does.
    pub(crate) fn set_refuses_reversed(&mut self, refuses: bool) {
        match &mut self.kind {
            JointKind::Slider(joint) => joint.set_refuses_reversed(refuses),
            JointKind::AngleLimit(joint) => joint.set_refuses_reversed(refuses),
            JointKind::FixedAngleLimit(joint) => joint.set_refuses_reversed(refuses),
            _ => {}
        }
    }

    pub(crate) fn kind_mut(&mut self) -> &mut JointKind {
        &mut self.kind
    }

    pub(crate) fn set_body1(&mut self, body: BodyId) {
        *self.bodies_mut().0 = body;
    }

    /// Sets the second body; no effect on a joint of one body.
    pub(crate) fn set_body2(&mut self, body: BodyId) {
        if let Some(body2) = self.bodies_mut().1 {
            *body2 = body;
        }
    }

    fn bodies_mut(&mut self) -> (&mut BodyId, Option<&mut BodyId>) {
        each_kind!(&mut self.kind, joint => joint.bodies_mut())
    }

    /// Tests the breakpoint and returns whether the joint broke just now; then it is disabled. As in the original the
    /// iteration that finds it broken still acts.
    pub(crate) fn breaks(&mut self) -> bool {
        let holds = self.joint_error.abs() <= self.breakpoint;
        let breaks = self.enabled && !holds;
        if breaks {
            self.enabled = false;
        }
        breaks
    }

    /// Computes error and effective mass and applies the warm start. The caller has checked that the joint is enabled,
    /// that one of its bodies is enabled and one is not static.
    pub(crate) fn pre_step(&mut self, inverse_dt: f32, poses: &[JointPose; 2], bodies: &mut JointBodies) {
        let step = JointStep { inverse_dt, bias_factor: self.bias_factor, softness: self.softness };
        self.joint_error = each_kind!(&mut self.kind, joint => joint.pre_step(step, poses, bodies));
    }

    /// One iteration; returns whether the original raises JointUpdated.
    pub(crate) fn solve(&mut self, bodies: &mut JointBodies) -> bool {
        let softness = self.softness;
        let has_acted = each_kind!(&mut self.kind, joint => joint.solve(softness, bodies));
        if !self.is_impulse_finite() {
            bodies.mark_non_finite();
        }
        has_acted
    }

    /// Resets the accumulated impulse, so that the next pre-step starts without warm start.
    pub(crate) fn forget_impulse(&mut self) {
        each_kind!(&mut self.kind, joint => joint.forget_impulse());
        (self.force, self.servo_force, self.force_along_depth) = ([0.0; 3], [0.0; 3], 0.0);
    }

    fn is_impulse_finite(&self) -> bool {
        each_kind!(&self.kind, joint => joint.impulse_is_finite())
    }

    /// Whether settings and impulse are finite. Values that the pre-step computes from the bodies need not be, and are
    /// saved as bits: the resulting velocities are checked before a body gets them.
    pub(crate) fn is_valid(&self) -> bool {
        let settings =
            [self.bias_factor, self.breakpoint, self.softness, self.greatest_force, self.greatest_torque];
        settings.iter().chain([&self.force_along_depth]).all(|number| number.is_finite())
            && self.servo_force.iter().all(|number| number.is_finite())
            && self.force.iter().all(|number| number.abs() <= f64::from(f32::MAX))
            && self.is_impulse_finite()
            && each_kind!(&self.kind, joint => joint.is_valid())
    }
}
