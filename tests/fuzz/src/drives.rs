//! Joints of the precise set with motors, servos and targets, their edits, and locks of axes: for the games of both engines.

use farseer_core::math::Vector2;
use farseer_core::{
    BodyId, JointFactory, JointId, JointLimits, JointMotor, JointServo, Objects, PoseServo, PulleyJoint,
    Result,
};

use crate::random::Random;

/// A function that makes a joint between two bodies and returns its id. The faithful set refuses to add such joints.
type Make = fn(&mut Objects, [BodyId; 2], &mut Random) -> Result<JointId>;

/// Functions that make the kinds of joints that have drives.
const DRIVEN_JOINTS: &[Make] = &[
    |objects, [a, b], random| {
        let (anchor, axis) = (near_middle(objects, [a, b], random), random.vector(1.0));
        let [stiffness, damping] = coefficients(random);
        JointFactory::create_wheel_joint(objects, a, b, anchor, axis, stiffness, damping).map(Into::into)
    },
    |objects, [a, b], random| {
        let [stiffness, damping] = coefficients(random);
        JointFactory::create_angle_spring_joint(objects, a, b, stiffness, damping).map(Into::into)
    },
    |objects, [a, b], random| {
        let servo = pose_servo(random);
        JointFactory::create_motor_joint(objects, a, b, servo).map(Into::into)
    },
    |objects, [a, b], random| {
        let ratio = random.number(-3.0, 3.0);
        JointFactory::create_gear_joint(objects, a, b, ratio).map(Into::into)
    },
    |objects, [a, b], random| {
        let ends = [(a, random.vector(10.0)), (b, random.vector(10.0))];
        let (pulleys, ratio) = ([random.vector(100.0), random.vector(100.0)], random.number(0.1, 3.0));
        JointFactory::create_pulley_joint(objects, ends, pulleys, ratio).map(Into::into)
    },
    |objects, [a, b], random| {
        let (anchor, axis) = (near_middle(objects, [a, b], random), random.vector(1.0));
        JointFactory::create_prismatic_joint(objects, a, b, anchor, axis)
    },
    |objects, [a, b], random| {
        let anchor = near_middle(objects, [a, b], random);
        JointFactory::create_revolute_joint(objects, a, b, anchor)
    },
    |objects, [a, _], random| {
        let anchor = near_middle(objects, [a, a], random);
        JointFactory::create_fixed_revolute_joint(objects, a, anchor)
    },
];

/// An edit of a joint's drive. Kinds that do not have the drive refuse it.
type Edit = fn(&mut Objects, JointId, &mut Random) -> Result<()>;

const EDITS: &[Edit] = &[
    |objects, joint, random| {
        let servo = random.chance(80).then(|| servo(random));
        objects.set_joint_servo(joint, servo)
    },
    |objects, joint, random| {
        let motor = random
            .chance(70)
            .then(|| JointMotor { speed: random.number(-10.0, 10.0), greatest_effort: effort(random, 1e4) });
        objects.set_joint_motor(joint, motor)
    },
    |objects, joint, random| {
        let limits = random
            .chance(70)
            .then(|| JointLimits { lower: random.number(-2.0, 0.0), upper: random.number(0.0, 2.0) });
        objects.set_joint_limits(joint, limits)
    },
    |objects, joint, random| objects.set_joint_bodies_collide(joint, random.chance(30)),
    |objects, joint, random| {
        let (offset, angle) = (random.vector(60.0), random.number(-3.0, 3.0));
        objects.set_motor_joint_target(joint, offset, angle)
    },
    |objects, joint, random| objects.set_motor_joint_servo(joint, pose_servo(random)),
    |objects, joint, random| objects.set_joint_axis(joint, random.vector(1.0)),
    |objects, joint, random| objects.set_gear_ratio(joint, random.number(-3.0, 3.0)),
    |objects, joint, random| {
        objects.joint_as_mut::<PulleyJoint>(joint)?.set_length(random.number(0.0, 300.0))
    },
    |objects, joint, random| {
        let pulleys = [random.vector(100.0), random.vector(100.0)];
        objects.joint_as_mut::<PulleyJoint>(joint)?.set_pulleys(pulleys)
    },
];

/// Makes a joint with drives between two bodies, and edits it up to twice.
pub(crate) fn create_driven_joint(
    objects: &mut Objects,
    bodies: [BodyId; 2],
    random: &mut Random,
) -> Result<JointId> {
    let joint = random.pick(DRIVEN_JOINTS)(objects, bodies, random)?;
    (0..random.below(3)).for_each(|_| drop(edit_drive(objects, joint, random)));
    Ok(joint)
}

/// Makes a random edit of a joint's drive.
pub(crate) fn edit_drive(objects: &mut Objects, joint: JointId, random: &mut Random) -> Result<()> {
    random.pick(EDITS)(objects, joint, random)
}

/// Locks axes of a body at random, or unlocks them.
pub(crate) fn lock_axes(objects: &mut Objects, body: BodyId, random: &mut Random) -> Result<()> {
    let axes = [random.chance(35), random.chance(35)];
    objects.set_axes_locked(body, axes)
}

/// Returns a point near the middle of two bodies, in world coordinates. Returns a point near the origin for bodies that are gone.
fn near_middle(objects: &Objects, bodies: [BodyId; 2], random: &mut Random) -> Vector2 {
    let [a, b] = bodies.map(|body| objects.body(body).map_or(Vector2::zeros(), |body| body.position()));
    (a + b) * 0.5 + random.vector(10.0)
}

/// Returns stiffness and damping of a servo: soft, stiff or none. Every order of magnitude is equally likely.
fn coefficients(random: &mut Random) -> [f32; 2] {
    [
        if random.chance(15) { 0.0 } else { 10_f32.powf(random.number(-1.0, 6.0)) },
        if random.chance(30) { 0.0 } else { 10_f32.powf(random.number(-1.0, 5.0)) },
    ]
}

/// Returns a greatest force or torque: none, without a bound, or up to `most`.
fn effort(random: &mut Random, most: f32) -> f32 {
    match random.below(6) {
        0 => 0.0,
        1 => f32::MAX,
        _ => random.number(0.0, most),
    }
}

fn servo(random: &mut Random) -> JointServo {
    let [stiffness, damping] = coefficients(random);
    JointServo { target: random.number(-3.0, 3.0), stiffness, damping, greatest_effort: effort(random, 1e5) }
}

fn pose_servo(random: &mut Random) -> PoseServo {
    PoseServo {
        frequency: if random.chance(20) { 0.0 } else { random.number(0.0, 20.0) },
        damping_ratio: random.number(0.0, 2.0),
        greatest_force: effort(random, 1e4),
        greatest_torque: effort(random, 1e5),
    }
}
