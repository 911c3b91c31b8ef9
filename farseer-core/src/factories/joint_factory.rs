//! Joints between bodies, and between bodies and the world (behaviour chapter 13, section 4).

use crate::body::{Body, BodyId};
use crate::joints::{
    AngleJoint, AngleLimitJoint, AngleSpringJoint, FixedAngleJoint, FixedAngleLimitJoint, FixedRevoluteJoint,
    GearJoint, Joint, JointId, JointType, MotorJoint, PinJoint, PoseServo, PrismaticJoint, PulleyJoint,
    RevoluteJoint, SliderJoint, WeldJoint, WheelJoint,
};
use crate::math::Vector2;
use crate::math::finite::{finite, finite_vector};
use crate::objects::{Objects, TypedJointId};
use crate::{Error, Result};

/// Makes joints. Anchors and angles are computed from the present poses of the bodies, so place the bodies first.
///
/// Lengths are in the user's unit, angles in radians.
///
/// Bodies that a joint connects **collide** with each other by default, as all others do. Links that overlap push each other
/// then, and the joint works against that. With the precise set,
/// [`set_joint_bodies_collide`](Objects::set_joint_bodies_collide) switches that off for a joint. With both sets,
/// [ignore](Objects::ignore_collision_with) the collisions of the geoms, or give them one
/// [group](crate::Geom::set_collision_group).
///
/// The [precise set](crate::Methods::Precise) refuses a joint of a body with itself. The original makes it, and it has no effect.
#[doc(alias = "JointFactory.Instance")]
#[derive(Debug, Clone, Copy)]
pub struct JointFactory;

impl JointFactory {
    /// Two bodies that turn about a common point of the world.
    ///
    /// # Errors
    /// A stale body; a position that is not finite.
    #[doc(alias = "CreateRevoluteJoint")]
    pub fn create_revolute_joint(
        simulator: &mut Objects,
        body1: BodyId,
        body2: BodyId,
        initial_anchor_position: Vector2,
    ) -> Result<JointId> {
        finite_vector("initial_anchor_position", initial_anchor_position)?;
        let (first, second) = (find(simulator, "body1", body1)?, find(simulator, "body2", body2)?);
        let joint = RevoluteJoint::new(first, second, initial_anchor_position)?;
        simulator.create_joint(joint)
    }

    /// A body that turns about a point of the world. If the body is static now the joint is disabled, and stays
    /// disabled when the body becomes dynamic, as in the original.
    ///
    /// # Errors
    /// A stale body; an anchor that is not finite.
    #[doc(alias = "CreateFixedRevoluteJoint")]
    pub fn create_fixed_revolute_joint(
        simulator: &mut Objects,
        body: BodyId,
        anchor: Vector2,
    ) -> Result<JointId> {
        let body_with_id = find(simulator, "body", body)?;
        let is_static = body_with_id.1.is_immovable();
        let mut joint = FixedRevoluteJoint::new(body_with_id, anchor)?;
        if is_static {
            joint.set_enabled(false);
        }
        simulator.create_joint(joint)
    }

    /// Two anchors, each in the coordinates of its body, that keep their present distance.
    ///
    /// # Errors
    /// A stale body; an anchor that is not finite; anchors too far apart for a finite distance.
    #[doc(alias = "CreatePinJoint")]
    pub fn create_pin_joint(
        simulator: &mut Objects,
        body1: BodyId,
        anchor1: Vector2,
        body2: BodyId,
        anchor2: Vector2,
    ) -> Result<JointId> {
        let (first, second) = (find(simulator, "body1", body1)?, find(simulator, "body2", body2)?);
        let joint = PinJoint::new(first, anchor1, second, anchor2)?;
        simulator.create_joint(joint)
    }

    /// Two anchors, each in the coordinates of its body, at a distance from `min` to `max` length units.
    ///
    /// # Errors
    /// A stale body; a number that is not finite; with the precise set a `min` greater than `max`.
    #[doc(alias = "CreateSliderJoint")]
    pub fn create_slider_joint(
        simulator: &mut Objects,
        body1: BodyId,
        anchor1: Vector2,
        body2: BodyId,
        anchor2: Vector2,
        min: f32,
        max: f32,
    ) -> Result<JointId> {
        simulator.check_range(min, max)?;
        let (first, second) = (find(simulator, "body1", body1)?, find(simulator, "body2", body2)?);
        let joint = SliderJoint::new(first, anchor1, second, anchor2, min, max)?;
        simulator.create_joint(joint)
    }

    /// Two bodies at the same total rotation. The target angle is 0, whatever the present angle; see
    /// [`AngleJoint::set_target_angle`].
    ///
    /// # Errors
    /// A stale body.
    #[doc(alias = "CreateAngleJoint")]
    pub fn create_angle_joint(simulator: &mut Objects, body1: BodyId, body2: BodyId) -> Result<JointId> {
        let (first, second) = (find(simulator, "body1", body1)?, find(simulator, "body2", body2)?);
        let joint = AngleJoint::new(first, second, 0.0)?;
        simulator.create_joint(joint)
    }

    /// [`create_angle_joint`](Self::create_angle_joint) with a softness and a bias factor, both dimensionless.
    ///
    /// # Errors
    /// A stale body; a number that is not finite.
    #[doc(alias = "CreateAngleJoint(Body, Body, float, float)")]
    pub fn create_angle_joint_with(
        simulator: &mut Objects,
        body1: BodyId,
        body2: BodyId,
        softness: f32,
        bias_factor: f32,
    ) -> Result<JointId> {
        let (first, second) = (find(simulator, "body1", body1)?, find(simulator, "body2", body2)?);
        let mut joint = AngleJoint::new(first, second, 0.0)?;
        joint.set_softness(softness)?;
        joint.set_bias_factor(bias_factor)?;
        simulator.create_joint(joint)
    }

    /// A body at total rotation 0; see [`FixedAngleJoint::set_target_angle`].
    ///
    /// # Errors
    /// A stale body.
    #[doc(alias = "CreateFixedAngleJoint")]
    pub fn create_fixed_angle_joint(simulator: &mut Objects, body: BodyId) -> Result<JointId> {
        let joint = FixedAngleJoint::new(find(simulator, "body", body)?, 0.0)?;
        simulator.create_joint(joint)
    }

    /// Two bodies whose total rotations differ by `min` to `max` radians.
    ///
    /// # Errors
    /// A stale body; a number that is not finite; with the precise set a `min` greater than `max`.
    #[doc(alias = "CreateAngleLimitJoint")]
    pub fn create_angle_limit_joint(
        simulator: &mut Objects,
        body1: BodyId,
        body2: BodyId,
        min: f32,
        max: f32,
    ) -> Result<JointId> {
        finite("min", min)?;
        finite("max", max)?;
        simulator.check_range(min, max)?;
        let (first, second) = (find(simulator, "body1", body1)?, find(simulator, "body2", body2)?);
        let joint = AngleLimitJoint::new(first, second, min, max)?;
        simulator.create_joint(joint)
    }

    /// A body whose total rotation stays between `min` and `max` radians.
    ///
    /// # Errors
    /// A stale body; a number that is not finite; with the precise set a `min` greater than `max`.
    #[doc(alias = "CreateFixedAngleLimitJoint")]
    pub fn create_fixed_angle_limit_joint(
        simulator: &mut Objects,
        body: BodyId,
        min: f32,
        max: f32,
    ) -> Result<JointId> {
        finite("min", min)?;
        finite("max", max)?;
        simulator.check_range(min, max)?;
        let joint = FixedAngleLimitJoint::new(find(simulator, "body", body)?, min, max)?;
        simulator.create_joint(joint)
    }

    /// Two bodies that share a point of the world and keep their present relative angle. The original has only the
    /// constructor.
    ///
    /// # Errors
    /// A stale body; a number that is not finite.
    #[doc(alias = "WeldJoint(Body, Body, Vector2)")]
    pub fn create_weld_joint(
        simulator: &mut Objects,
        body1: BodyId,
        body2: BodyId,
        anchor: Vector2,
    ) -> Result<JointId> {
        let (first, second) = (find(simulator, "body1", body1)?, find(simulator, "body2", body2)?);
        let joint = WeldJoint::new(first, second, anchor)?;
        simulator.create_joint(joint)
    }
}

/// Joints that the original does not have.
impl JointFactory {
    /// A second body that slides along an axis of the first. Axis and anchor are a direction and a point of the world.
    /// The bodies keep their present relative angle. Only the [precise set](crate::Methods::Precise) has such joints.
    ///
    /// # Errors
    /// A stale body; a number that is not finite; an axis without length. Under the faithful methods it cannot be
    /// added.
    #[doc(alias("line joint", "piston"))]
    pub fn create_prismatic_joint(
        simulator: &mut Objects,
        body1: BodyId,
        body2: BodyId,
        anchor: Vector2,
        axis: Vector2,
    ) -> Result<JointId> {
        let (first, second) = (find(simulator, "body1", body1)?, find(simulator, "body2", body2)?);
        let joint = PrismaticJoint::new(first, second, anchor, axis)?;
        simulator.create_joint(joint)
    }
}

/// More joints that the original does not have. Their ids know the kind: `simulator[joint]` is a [`WheelJoint`].
impl JointFactory {
    /// A wheel, the second body, on a sprung axle of the first one. Anchor and axis are a point and a direction of the world:
    /// the axle, and the way of the suspension. `stiffness` is in mass units/s², `damping` in mass units/s; both are 0 or more,
    /// and part of the joint's [servo](Objects::set_joint_servo). Only the [precise set](crate::Methods::Precise) has such
    /// joints.
    ///
    /// # Errors
    /// A stale body; a number that is not finite; an axis without length; a negative stiffness or damping; the same body twice.
    /// Under the faithful methods it cannot be added.
    #[doc(alias("b2WheelJoint", "suspension"))]
    pub fn create_wheel_joint(
        simulator: &mut Objects,
        body1: BodyId,
        body2: BodyId,
        anchor: Vector2,
        axis: Vector2,
        stiffness: f32,
        damping: f32,
    ) -> Result<TypedJointId<WheelJoint>> {
        let (first, second) = (find(simulator, "body1", body1)?, find(simulator, "body2", body2)?);
        let joint = WheelJoint::new(first, second, (anchor, axis), [stiffness, damping])?;
        create(simulator, joint)
    }

    /// A damped spring between the angles of two bodies, at rest at their present relative angle. `stiffness` is in mass units
    /// · length units²/s² per radian, `damping` in mass units · length units²/s; both are 0 or more. Only the [precise
    /// set](crate::Methods::Precise) has such joints.
    ///
    /// # Errors
    /// A stale body; a number that is not finite and 0 or more; the same body twice. Under the faithful methods it cannot be
    /// added.
    #[doc(alias("DampedRotarySpring", "torsion spring"))]
    pub fn create_angle_spring_joint(
        simulator: &mut Objects,
        body1: BodyId,
        body2: BodyId,
        stiffness: f32,
        damping: f32,
    ) -> Result<TypedJointId<AngleSpringJoint>> {
        let (first, second) = (find(simulator, "body1", body1)?, find(simulator, "body2", body2)?);
        let joint = AngleSpringJoint::new(first, second, stiffness, damping)?;
        create(simulator, joint)
    }

    /// A joint that keeps the second body at its present pose relative to the first, and moves it to
    /// [others](Objects::set_motor_joint_target), with bounded force and torque. Only the [precise
    /// set](crate::Methods::Precise) has such joints.
    ///
    /// # Errors
    /// A stale body; bodies too far apart; a number that is not finite and 0 or more; the same body twice. Under the faithful
    /// methods it cannot be added.
    #[doc(alias("b2MotorJoint"))]
    pub fn create_motor_joint(
        simulator: &mut Objects,
        body1: BodyId,
        body2: BodyId,
        servo: PoseServo,
    ) -> Result<TypedJointId<MotorJoint>> {
        let (first, second) = (find(simulator, "body1", body1)?, find(simulator, "body2", body2)?);
        let joint = MotorJoint::new(first, second, servo)?;
        create(simulator, joint)
    }

    /// A gear: the second body turns by `ratio` times the angle by which the first one turns from now on. Only the [precise
    /// set](crate::Methods::Precise) has such joints.
    ///
    /// # Errors
    /// A stale body; a ratio that is not finite, or 0; the same body twice. Under the faithful methods it cannot be added.
    #[doc(alias("b2GearJoint"))]
    pub fn create_gear_joint(
        simulator: &mut Objects,
        body1: BodyId,
        body2: BodyId,
        ratio: f32,
    ) -> Result<TypedJointId<GearJoint>> {
        let (first, second) = (find(simulator, "body1", body1)?, find(simulator, "body2", body2)?);
        let joint = GearJoint::new(first, second, ratio)?;
        create(simulator, joint)
    }

    /// A rope over two pulleys, which are points of the world. It ends at two bodies, each with a point in its coordinates, and
    /// is as long as now. Only the [precise set](crate::Methods::Precise) has such joints.
    ///
    /// # Errors
    /// A stale body; a point that is not finite; a ratio that is not greater than 0; the same body twice. Under the faithful
    /// methods it cannot be added.
    #[doc(alias("b2PulleyJoint"))]
    pub fn create_pulley_joint(
        simulator: &mut Objects,
        ends: [(BodyId, Vector2); 2],
        pulleys: [Vector2; 2],
        ratio: f32,
    ) -> Result<TypedJointId<PulleyJoint>> {
        let first = find(simulator, "ends[0]", ends[0].0)?;
        let second = find(simulator, "ends[1]", ends[1].0)?;
        let joint = PulleyJoint::new([first, second], ends.map(|(_, anchor)| anchor), pulleys, ratio)?;
        create(simulator, joint)
    }
}

/// Methods that also add the joint to the simulator.
impl JointFactory {
    added! {
        create_revolute_joint_in = create_revolute_joint(body1: BodyId, body2: BodyId, initial_anchor_position: Vector2) -> JointId;
        create_fixed_revolute_joint_in = create_fixed_revolute_joint(body: BodyId, anchor: Vector2) -> JointId;
        create_pin_joint_in = create_pin_joint(body1: BodyId, anchor1: Vector2, body2: BodyId, anchor2: Vector2) -> JointId;
        create_slider_joint_in = create_slider_joint(body1: BodyId, anchor1: Vector2, body2: BodyId, anchor2: Vector2, min: f32, max: f32) -> JointId;
        create_angle_joint_in = create_angle_joint(body1: BodyId, body2: BodyId) -> JointId;
        create_angle_joint_with_in = create_angle_joint_with(body1: BodyId, body2: BodyId, softness: f32, bias_factor: f32) -> JointId;
        create_fixed_angle_joint_in = create_fixed_angle_joint(body: BodyId) -> JointId;
        create_angle_limit_joint_in = create_angle_limit_joint(body1: BodyId, body2: BodyId, min: f32, max: f32) -> JointId;
        create_fixed_angle_limit_joint_in = create_fixed_angle_limit_joint(body: BodyId, min: f32, max: f32) -> JointId;
        create_prismatic_joint_in = create_prismatic_joint(body1: BodyId, body2: BodyId, anchor: Vector2, axis: Vector2) -> JointId;
        create_wheel_joint_in = create_wheel_joint(body1: BodyId, body2: BodyId, anchor: Vector2, axis: Vector2, stiffness: f32, damping: f32) -> TypedJointId<WheelJoint>;
        create_angle_spring_joint_in = create_angle_spring_joint(body1: BodyId, body2: BodyId, stiffness: f32, damping: f32) -> TypedJointId<AngleSpringJoint>;
        create_motor_joint_in = create_motor_joint(body1: BodyId, body2: BodyId, servo: PoseServo) -> TypedJointId<MotorJoint>;
        create_gear_joint_in = create_gear_joint(body1: BodyId, body2: BodyId, ratio: f32) -> TypedJointId<GearJoint>;
        create_pulley_joint_in = create_pulley_joint(ends: [(BodyId, Vector2); 2], pulleys: [Vector2; 2], ratio: f32) -> TypedJointId<PulleyJoint>;
        create_weld_joint_in = create_weld_joint(body1: BodyId, body2: BodyId, anchor: Vector2) -> JointId;
    }
}

/// Stores a joint of a known kind, which cannot join a body with itself.
fn create<J: JointType>(simulator: &mut Objects, joint: Joint) -> Result<TypedJointId<J>> {
    if joint.body2() == Some(joint.body1()) {
        return Err(Error::invalid("body2", joint.body1(), "another body than body1"));
    }
    let joint = simulator.create_joint(joint)?;
    simulator.typed_joint(joint)
}

fn find<'a>(simulator: &'a Objects, argument: &'static str, body: BodyId) -> Result<(BodyId, &'a Body)> {
    simulator.body(body).map(|found| (body, found)).ok_or(Error::StaleId { argument })
}
