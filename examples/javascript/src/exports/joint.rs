//! Joints.

use farseer_core::math::Vector2;
use farseer_core::{
    BodyId, Error, Joint, JointFactory, JointId, JointKind, JointLimits, JointMotor, JointServo, Objects,
    PoseServo, Result,
};

use crate::boundary::exports;
use crate::world::Simulator;

fn edit<T>(objects: &mut Objects, joint: JointId, edit: impl FnOnce(&mut Joint) -> T) -> Result<T> {
    objects.joint_mut(joint).map(edit).ok_or(Error::StaleId { argument: "joint" })
}

exports! {
    /// Two bodies turn about a point of the world.
    fn joint_revolute(simulator: Simulator, body1: BodyId, body2: BodyId, x: f32, y: f32) {
        simulator.objects(|objects| {
            JointFactory::create_revolute_joint_in(objects, body1, body2, Vector2::new(x, y))
        })
    }

    /// A body turns about a point of the world.
    fn joint_fixed_revolute(simulator: Simulator, body: BodyId, x: f32, y: f32) {
        simulator.objects(|objects| JointFactory::create_fixed_revolute_joint_in(objects, body, Vector2::new(x, y)))
    }

    /// Two points of two bodies keep their distance.
    fn joint_pin(simulator: Simulator, body1: BodyId, x1: f32, y1: f32, body2: BodyId, x2: f32, y2: f32) {
        let (anchor1, anchor2) = (Vector2::new(x1, y1), Vector2::new(x2, y2));
        simulator.objects(|objects| JointFactory::create_pin_joint_in(objects, body1, anchor1, body2, anchor2))
    }

    /// The distance of two points of two bodies stays within bounds.
    fn joint_slider(
        simulator: Simulator, body1: BodyId, x1: f32, y1: f32, body2: BodyId, x2: f32, y2: f32, min: f32, max: f32,
    ) {
        let (anchor1, anchor2) = (Vector2::new(x1, y1), Vector2::new(x2, y2));
        simulator.objects(|objects| {
            JointFactory::create_slider_joint_in(objects, body1, anchor1, body2, anchor2, min, max)
        })
    }

    /// Two bodies are one.
    fn joint_weld(simulator: Simulator, body1: BodyId, body2: BodyId, x: f32, y: f32) {
        simulator.objects(|objects| JointFactory::create_weld_joint_in(objects, body1, body2, Vector2::new(x, y)))
    }

    /// One body slides along an axis of another.
    fn joint_prismatic(
        simulator: Simulator, body1: BodyId, body2: BodyId, x: f32, y: f32, axis_x: f32, axis_y: f32,
    ) {
        let (anchor, axis) = (Vector2::new(x, y), Vector2::new(axis_x, axis_y));
        simulator.objects(|objects| JointFactory::create_prismatic_joint_in(objects, body1, body2, anchor, axis))
    }

    /// A wheel on a suspension.
    fn joint_wheel(
        simulator: Simulator, body1: BodyId, body2: BodyId, x: f32, y: f32, axis_x: f32, axis_y: f32,
        stiffness: f32, damping: f32,
    ) {
        let (anchor, axis) = (Vector2::new(x, y), Vector2::new(axis_x, axis_y));
        simulator.objects(|objects| {
            let joint =
                JointFactory::create_wheel_joint_in(objects, body1, body2, anchor, axis, stiffness, damping)?;
            Ok(joint.id())
        })
    }

    /// A damped spring between the angles of two bodies.
    fn joint_angle_spring(simulator: Simulator, body1: BodyId, body2: BodyId, stiffness: f32, damping: f32) {
        simulator.objects(|objects| {
            Ok(JointFactory::create_angle_spring_joint_in(objects, body1, body2, stiffness, damping)?.id())
        })
    }

    /// One body seeks a pose relative to another.
    fn joint_motor(
        simulator: Simulator, body1: BodyId, body2: BodyId,
        frequency: f32, damping_ratio: f32, greatest_force: f32, greatest_torque: f32,
    ) {
        let servo = PoseServo { frequency, damping_ratio, greatest_force, greatest_torque };
        simulator.objects(|objects| Ok(JointFactory::create_motor_joint_in(objects, body1, body2, servo)?.id()))
    }

    /// Sets the pose that a motor joint seeks.
    fn joint_set_target_pose(simulator: Simulator, joint: JointId, x: f32, y: f32, angle: f32) {
        simulator.objects(|objects| objects.set_motor_joint_target(joint, Vector2::new(x, y), angle))
    }

    /// Sets the strength of a motor joint.
    fn joint_set_pose_servo(
        simulator: Simulator, joint: JointId,
        frequency: f32, damping_ratio: f32, greatest_force: f32, greatest_torque: f32,
    ) {
        let servo = PoseServo { frequency, damping_ratio, greatest_force, greatest_torque };
        simulator.objects(|objects| objects.set_motor_joint_servo(joint, servo))
    }

    /// Lets it seek a target, with the precise set.
    fn joint_set_servo(
        simulator: Simulator, joint: JointId, target: f32, stiffness: f32, damping: f32, greatest_effort: f32,
    ) {
        let servo = JointServo { target, stiffness, damping, greatest_effort };
        simulator.objects(|objects| objects.set_joint_servo(joint, Some(servo)))
    }

    /// Lets it seek no target.
    fn joint_remove_servo(simulator: Simulator, joint: JointId) {
        simulator.objects(|objects| objects.set_joint_servo(joint, None))
    }

    /// Two bodies keep an angle.
    fn joint_angle(simulator: Simulator, body1: BodyId, body2: BodyId) {
        simulator.objects(|objects| JointFactory::create_angle_joint_in(objects, body1, body2))
    }

    /// A body keeps its angle.
    fn joint_fixed_angle(simulator: Simulator, body: BodyId) {
        simulator.objects(|objects| JointFactory::create_fixed_angle_joint_in(objects, body))
    }

    /// The angle between two bodies stays within bounds.
    fn joint_angle_limit(simulator: Simulator, body1: BodyId, body2: BodyId, min: f32, max: f32) {
        simulator.objects(|objects| JointFactory::create_angle_limit_joint_in(objects, body1, body2, min, max))
    }

    /// The angle of a body stays within bounds.
    fn joint_fixed_angle_limit(simulator: Simulator, body: BodyId, min: f32, max: f32) {
        simulator.objects(|objects| JointFactory::create_fixed_angle_limit_joint_in(objects, body, min, max))
    }

    /// Ends its life with the next update.
    fn joint_dispose(simulator: Simulator, joint: JointId) { simulator.objects(|objects| objects.dispose(joint)) }

    /// Whether it was disposed.
    fn joint_is_disposed(simulator: Simulator, joint: JointId) {
        simulator.with(|world| Ok(world.engine.core().is_disposed(joint)))
    }

    /// Drives it, with the precise set.
    fn joint_set_motor(simulator: Simulator, joint: JointId, speed: f32, greatest_effort: f32) {
        let motor = JointMotor { speed, greatest_effort };
        simulator.objects(|objects| objects.set_joint_motor(joint, Some(motor)))
    }

    /// Drives it no longer.
    fn joint_remove_motor(simulator: Simulator, joint: JointId) {
        simulator.objects(|objects| objects.set_joint_motor(joint, None))
    }

    /// Bounds its travel, with the precise set.
    fn joint_set_limits(simulator: Simulator, joint: JointId, lower: f32, upper: f32) {
        simulator.objects(|objects| objects.set_joint_limits(joint, Some(JointLimits { lower, upper })))
    }

    /// Bounds it no longer.
    fn joint_remove_limits(simulator: Simulator, joint: JointId) {
        simulator.objects(|objects| objects.set_joint_limits(joint, None))
    }

    /// How far it has turned or slid.
    fn joint_travel(simulator: Simulator, joint: JointId) { simulator.objects(|objects| objects.joint_travel(joint)) }

    /// Whether it is enabled.
    fn joint_enabled(simulator: Simulator, joint: JointId) {
        simulator.objects(|objects| {
            objects.joint(joint).map(Joint::enabled).ok_or(Error::StaleId { argument: "joint" })
        })
    }

    /// Sets whether it is enabled.
    fn joint_set_enabled(simulator: Simulator, joint: JointId, value: bool) {
        simulator.objects(|objects| edit(objects, joint, |joint| joint.set_enabled(value)))
    }

    /// The force with which it held in the last update, with the precise set.
    fn joint_force(simulator: Simulator, joint: JointId) {
        simulator.objects(|objects| {
            objects.joint(joint).map(Joint::force).ok_or(Error::StaleId { argument: "joint" })
        })
    }

    /// The torque with which it held the angle.
    fn joint_torque(simulator: Simulator, joint: JointId) {
        simulator.objects(|objects| {
            objects.joint(joint).map(Joint::torque).ok_or(Error::StaleId { argument: "joint" })
        })
    }

    /// The error beyond which it breaks.
    fn joint_set_breakpoint(simulator: Simulator, joint: JointId, breakpoint: f32) {
        simulator.objects(|objects| edit(objects, joint, |joint| joint.set_breakpoint(breakpoint))?)
    }

    /// The force beyond which it breaks, with the precise set.
    fn joint_set_greatest_force(simulator: Simulator, joint: JointId, greatest_force: f32) {
        simulator.objects(|objects| edit(objects, joint, |joint| joint.set_greatest_force(greatest_force))?)
    }

    /// The torque beyond which it breaks, with the precise set.
    fn joint_set_greatest_torque(simulator: Simulator, joint: JointId, greatest_torque: f32) {
        simulator.objects(|objects| edit(objects, joint, |joint| joint.set_greatest_torque(greatest_torque))?)
    }

    /// How much it yields.
    fn joint_set_softness(simulator: Simulator, joint: JointId, softness: f32) {
        simulator.objects(|objects| edit(objects, joint, |joint| joint.set_softness(softness))?)
    }

    /// How much of its error an update corrects.
    fn joint_set_bias_factor(simulator: Simulator, joint: JointId, bias_factor: f32) {
        simulator.objects(|objects| edit(objects, joint, |joint| joint.set_bias_factor(bias_factor))?)
    }

    /// The angle that an angle joint keeps.
    fn joint_set_target_angle(simulator: Simulator, joint: JointId, target_angle: f32) {
        simulator.objects(|objects| set_target_angle(objects, joint, target_angle))
    }
}

fn set_target_angle(objects: &mut Objects, joint: JointId, target_angle: f32) -> Result<()> {
    let kind = objects.joint(joint).ok_or(Error::StaleId { argument: "joint" })?.kind();
    if matches!(kind, JointKind::FixedAngle(_)) {
        return objects.joint_as_mut::<farseer_core::FixedAngleJoint>(joint)?.set_target_angle(target_angle);
    }
    objects.joint_as_mut::<farseer_core::AngleJoint>(joint)?.set_target_angle(target_angle)
}
