//! Joints of all kinds.

use std::mem::MaybeUninit;

use farseer_core::{BodyId, JointFactory, JointId, Objects, PoseServo};

use crate::arguments::{FarseerVector2, Finite};
use crate::failure::{FarseerStatus, Outcome};
use crate::guard::{FarseerSimulator, write};
use crate::ids::{FarseerBody, FarseerJoint, Id};

/// Makes a joint of one body, adds it, and writes its id.
fn fixed(
    simulator: Option<&FarseerSimulator>,
    body: FarseerBody,
    joint: Option<&mut MaybeUninit<FarseerJoint>>,
    make: impl FnOnce(&mut Objects, BodyId) -> Outcome<JointId>,
) -> FarseerStatus {
    write(simulator, "joint", joint, |world| {
        make(&mut world.simulator, BodyId::from_number("body", body)?)?.to_number()
    })
}

/// Makes a joint of two bodies, adds it, and writes its id.
fn between(
    simulator: Option<&FarseerSimulator>,
    [body1, body2]: [FarseerBody; 2],
    joint: Option<&mut MaybeUninit<FarseerJoint>>,
    make: impl FnOnce(&mut Objects, BodyId, BodyId) -> Outcome<JointId>,
) -> FarseerStatus {
    write(simulator, "joint", joint, |world| {
        let (body1, body2) = (BodyId::from_number("body1", body1)?, BodyId::from_number("body2", body2)?);
        make(&mut world.simulator, body1, body2)?.to_number()
    })
}

/// Two bodies keep a common point of the world, in length units: a hinge.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_joint_create_revolute(
    simulator: Option<&FarseerSimulator>,
    body1: FarseerBody,
    body2: FarseerBody,
    anchor: FarseerVector2,
    joint: Option<&mut MaybeUninit<FarseerJoint>>,
) -> FarseerStatus {
    between(simulator, [body1, body2], joint, |objects, body1, body2| {
        Ok(JointFactory::create_revolute_joint_in(objects, body1, body2, anchor.finite("anchor")?)?)
    })
}

/// A point of a body stays at a point of the world, in length units: a hinge.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_joint_create_fixed_revolute(
    simulator: Option<&FarseerSimulator>,
    body: FarseerBody,
    anchor: FarseerVector2,
    joint: Option<&mut MaybeUninit<FarseerJoint>>,
) -> FarseerStatus {
    fixed(simulator, body, joint, |objects, body| {
        Ok(JointFactory::create_fixed_revolute_joint_in(objects, body, anchor.finite("anchor")?)?)
    })
}

/// Two points keep their distance: a rod. Anchors are in the frames of the bodies, in length units.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_joint_create_pin(
    simulator: Option<&FarseerSimulator>,
    body1: FarseerBody,
    anchor1: FarseerVector2,
    body2: FarseerBody,
    anchor2: FarseerVector2,
    joint: Option<&mut MaybeUninit<FarseerJoint>>,
) -> FarseerStatus {
    between(simulator, [body1, body2], joint, |objects, body1, body2| {
        let (anchor1, anchor2) = (anchor1.finite("anchor1")?, anchor2.finite("anchor2")?);
        Ok(JointFactory::create_pin_joint_in(objects, body1, anchor1, body2, anchor2)?)
    })
}

/// The distance of two points stays in a range: a rope, a telescope. Anchors are in the frames of the bodies, all in length
/// units.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_joint_create_slider(
    simulator: Option<&FarseerSimulator>,
    body1: FarseerBody,
    anchor1: FarseerVector2,
    body2: FarseerBody,
    anchor2: FarseerVector2,
    min: f32,
    max: f32,
    joint: Option<&mut MaybeUninit<FarseerJoint>>,
) -> FarseerStatus {
    between(simulator, [body1, body2], joint, |objects, body1, body2| {
        let (anchor1, anchor2) = (anchor1.finite("anchor1")?, anchor2.finite("anchor2")?);
        let (min, max) = (min.finite("min")?, max.finite("max")?);
        Ok(JointFactory::create_slider_joint_in(objects, body1, anchor1, body2, anchor2, min, max)?)
    })
}

/// Two bodies keep a relative angle.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_joint_create_angle(
    simulator: Option<&FarseerSimulator>,
    body1: FarseerBody,
    body2: FarseerBody,
    joint: Option<&mut MaybeUninit<FarseerJoint>>,
) -> FarseerStatus {
    between(simulator, [body1, body2], joint, |objects, body1, body2| {
        Ok(JointFactory::create_angle_joint_in(objects, body1, body2)?)
    })
}

/// A body keeps its angle.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_joint_create_fixed_angle(
    simulator: Option<&FarseerSimulator>,
    body: FarseerBody,
    joint: Option<&mut MaybeUninit<FarseerJoint>>,
) -> FarseerStatus {
    fixed(simulator, body, joint, |objects, body| {
        Ok(JointFactory::create_fixed_angle_joint_in(objects, body)?)
    })
}

/// The relative angle of two bodies stays in a range, in radians.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_joint_create_angle_limit(
    simulator: Option<&FarseerSimulator>,
    body1: FarseerBody,
    body2: FarseerBody,
    min: f32,
    max: f32,
    joint: Option<&mut MaybeUninit<FarseerJoint>>,
) -> FarseerStatus {
    between(simulator, [body1, body2], joint, |objects, body1, body2| {
        Ok(JointFactory::create_angle_limit_joint_in(objects, body1, body2, min, max)?)
    })
}

/// The angle of a body stays in a range, in radians.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_joint_create_fixed_angle_limit(
    simulator: Option<&FarseerSimulator>,
    body: FarseerBody,
    min: f32,
    max: f32,
    joint: Option<&mut MaybeUninit<FarseerJoint>>,
) -> FarseerStatus {
    fixed(simulator, body, joint, |objects, body| {
        Ok(JointFactory::create_fixed_angle_limit_joint_in(objects, body, min, max)?)
    })
}

/// Two bodies keep a common point of the world, in length units, and their relative angle.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_joint_create_weld(
    simulator: Option<&FarseerSimulator>,
    body1: FarseerBody,
    body2: FarseerBody,
    anchor: FarseerVector2,
    joint: Option<&mut MaybeUninit<FarseerJoint>>,
) -> FarseerStatus {
    between(simulator, [body1, body2], joint, |objects, body1, body2| {
        Ok(JointFactory::create_weld_joint_in(objects, body1, body2, anchor.finite("anchor")?)?)
    })
}

/// The second body slides along a line of the first: a piston. Anchor and axis are in the world, in length units. Under the precise
/// methods.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_joint_create_prismatic(
    simulator: Option<&FarseerSimulator>,
    body1: FarseerBody,
    body2: FarseerBody,
    anchor: FarseerVector2,
    axis: FarseerVector2,
    joint: Option<&mut MaybeUninit<FarseerJoint>>,
) -> FarseerStatus {
    between(simulator, [body1, body2], joint, |objects, body1, body2| {
        let (anchor, axis) = (anchor.finite("anchor")?, axis.finite("axis")?);
        Ok(JointFactory::create_prismatic_joint_in(objects, body1, body2, anchor, axis)?)
    })
}

/// The second body turns about a point on a sprung line of the first: a wheel with suspension. Anchor and axis are in the world,
/// in length units; stiffness in mass units/s², damping in mass units/s. Under the precise methods.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_joint_create_wheel(
    simulator: Option<&FarseerSimulator>,
    body1: FarseerBody,
    body2: FarseerBody,
    anchor: FarseerVector2,
    axis: FarseerVector2,
    stiffness: f32,
    damping: f32,
    joint: Option<&mut MaybeUninit<FarseerJoint>>,
) -> FarseerStatus {
    between(simulator, [body1, body2], joint, |objects, body1, body2| {
        let (anchor, axis) = (anchor.finite("anchor")?, axis.finite("axis")?);
        Ok(JointFactory::create_wheel_joint_in(objects, body1, body2, anchor, axis, stiffness, damping)?.id())
    })
}

/// A damped spring turns two bodies to their present relative angle: stiffness in torque per radian, damping in torque per rad/s.
/// Under the precise methods.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_joint_create_angle_spring(
    simulator: Option<&FarseerSimulator>,
    body1: FarseerBody,
    body2: FarseerBody,
    stiffness: f32,
    damping: f32,
    joint: Option<&mut MaybeUninit<FarseerJoint>>,
) -> FarseerStatus {
    between(simulator, [body1, body2], joint, |objects, body1, body2| {
        Ok(JointFactory::create_angle_spring_joint_in(objects, body1, body2, stiffness, damping)?.id())
    })
}

/// A bounded force and torque bring the second body to a pose relative to the first: frequency in Hz, damping ratio, greatest
/// force and torque. Under the precise methods.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_joint_create_motor(
    simulator: Option<&FarseerSimulator>,
    body1: FarseerBody,
    body2: FarseerBody,
    frequency: f32,
    damping_ratio: f32,
    greatest_force: f32,
    greatest_torque: f32,
    joint: Option<&mut MaybeUninit<FarseerJoint>>,
) -> FarseerStatus {
    between(simulator, [body1, body2], joint, |objects, body1, body2| {
        let servo = PoseServo { frequency, damping_ratio, greatest_force, greatest_torque };
        Ok(JointFactory::create_motor_joint_in(objects, body1, body2, servo)?.id())
    })
}

/// Two bodies turn in a ratio. Under the precise methods.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_joint_create_gear(
    simulator: Option<&FarseerSimulator>,
    body1: FarseerBody,
    body2: FarseerBody,
    ratio: f32,
    joint: Option<&mut MaybeUninit<FarseerJoint>>,
) -> FarseerStatus {
    between(simulator, [body1, body2], joint, |objects, body1, body2| {
        Ok(JointFactory::create_gear_joint_in(objects, body1, body2, ratio)?.id())
    })
}

/// A rope from the first body over two points of the world to the second, in length units, with a ratio of the two parts. Anchors
/// are in the frames of the bodies. Under the precise methods.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_joint_create_pulley(
    simulator: Option<&FarseerSimulator>,
    body1: FarseerBody,
    anchor1: FarseerVector2,
    pulley1: FarseerVector2,
    body2: FarseerBody,
    anchor2: FarseerVector2,
    pulley2: FarseerVector2,
    ratio: f32,
    joint: Option<&mut MaybeUninit<FarseerJoint>>,
) -> FarseerStatus {
    between(simulator, [body1, body2], joint, |objects, body1, body2| {
        let ends = [(body1, anchor1.finite("anchor1")?), (body2, anchor2.finite("anchor2")?)];
        let pulleys = [pulley1.finite("pulley1")?, pulley2.finite("pulley2")?];
        Ok(JointFactory::create_pulley_joint_in(objects, ends, pulleys, ratio)?.id())
    })
}
