//! Motors, limits, servos, targets and ranges of joints.

use std::mem::MaybeUninit;

use farseer_core::{
    AngleJoint, AngleLimitJoint, FixedAngleJoint, FixedAngleLimitJoint, JointId, JointKind, JointLimits,
    JointMotor, JointServo, Objects, PinJoint, SliderJoint,
};

use crate::arguments::{FarseerVector2, Finite};
use crate::failure::{Failure, FarseerStatus, Outcome};
use crate::guard::{FarseerSimulator, with, write};
use crate::ids::{FarseerJoint, Id};

/// Changes the motion of a joint.
fn set(
    simulator: Option<&FarseerSimulator>,
    joint: FarseerJoint,
    change: impl FnOnce(&mut Objects, JointId) -> farseer_core::Result<()>,
) -> FarseerStatus {
    with(simulator, |world| Ok(change(&mut world.simulator, JointId::from_number("joint", joint)?)?))
}

/// Sets the range of the kinds of joints that have one: of distances in length units, or of angles in radians.
fn set_range(objects: &mut Objects, joint: JointId, lower: f32, upper: f32) -> Outcome {
    let kind = objects.joint(joint).ok_or_else(|| Failure::stale("joint"))?.kind();
    match kind {
        JointKind::AngleLimit(_) => {
            objects.joint_as_mut::<AngleLimitJoint>(joint)?.set_limits(lower, upper)?
        }
        JointKind::FixedAngleLimit(_) => {
            objects.joint_as_mut::<FixedAngleLimitJoint>(joint)?.set_limits(lower, upper)?;
        }
        _ => objects.joint_as_mut::<SliderJoint>(joint)?.set_range(lower, upper)?,
    }
    Ok(())
}

/// Sets the target of the kinds of joints that have one: a distance in length units, or an angle in radians.
fn set_target(objects: &mut Objects, joint: JointId, target: f32) -> Outcome {
    let kind = objects.joint(joint).ok_or_else(|| Failure::stale("joint"))?.kind();
    match kind {
        JointKind::Pin(_) => objects.joint_as_mut::<PinJoint>(joint)?.set_target_distance(target)?,
        JointKind::FixedAngle(_) => {
            objects.joint_as_mut::<FixedAngleJoint>(joint)?.set_target_angle(target)?
        }
        _ => objects.joint_as_mut::<AngleJoint>(joint)?.set_target_angle(target)?,
    }
    Ok(())
}

/// Drives a joint, under the precise methods: speed in rad/s or length units/s, greatest torque or force in mass units · length
/// units²/s² or mass units · length units/s².
#[unsafe(no_mangle)]
pub extern "C" fn farseer_joint_set_motor(
    simulator: Option<&FarseerSimulator>,
    joint: FarseerJoint,
    speed: f32,
    greatest_effort: f32,
) -> FarseerStatus {
    set(simulator, joint, |objects, joint| {
        objects.set_joint_motor(joint, Some(JointMotor { speed, greatest_effort }))
    })
}

/// Drives a joint no longer.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_joint_remove_motor(
    simulator: Option<&FarseerSimulator>,
    joint: FarseerJoint,
) -> FarseerStatus {
    set(simulator, joint, |objects, joint| objects.set_joint_motor(joint, None))
}

/// Bounds the travel of a joint, in radians or length units, under the precise methods.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_joint_set_limits(
    simulator: Option<&FarseerSimulator>,
    joint: FarseerJoint,
    lower: f32,
    upper: f32,
) -> FarseerStatus {
    set(simulator, joint, |objects, joint| {
        objects.set_joint_limits(joint, Some(JointLimits { lower, upper }))
    })
}

/// Bounds the travel of a joint no longer.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_joint_remove_limits(
    simulator: Option<&FarseerSimulator>,
    joint: FarseerJoint,
) -> FarseerStatus {
    set(simulator, joint, |objects, joint| objects.set_joint_limits(joint, None))
}

/// Lets a joint seek a position in radians or length units, under the precise methods. Stiffness and damping are torque per
/// radian and per rad/s, or force per length unit and per length unit/s.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_joint_set_servo(
    simulator: Option<&FarseerSimulator>,
    joint: FarseerJoint,
    target: f32,
    stiffness: f32,
    damping: f32,
    greatest_effort: f32,
) -> FarseerStatus {
    set(simulator, joint, |objects, joint| {
        objects.set_joint_servo(joint, Some(JointServo { target, stiffness, damping, greatest_effort }))
    })
}

/// Lets a joint seek no position.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_joint_remove_servo(
    simulator: Option<&FarseerSimulator>,
    joint: FarseerJoint,
) -> FarseerStatus {
    set(simulator, joint, |objects, joint| objects.set_joint_servo(joint, None))
}

/// Sets the range of a slider joint in length units, or of an angle limit joint in radians.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_joint_set_range(
    simulator: Option<&FarseerSimulator>,
    joint: FarseerJoint,
    lower: f32,
    upper: f32,
) -> FarseerStatus {
    with(simulator, |world| {
        set_range(&mut world.simulator, JointId::from_number("joint", joint)?, lower, upper)
    })
}

/// Sets the distance of a pin joint in length units, or the angle of an angle joint in radians.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_joint_set_target(
    simulator: Option<&FarseerSimulator>,
    joint: FarseerJoint,
    target: f32,
) -> FarseerStatus {
    with(simulator, |world| set_target(&mut world.simulator, JointId::from_number("joint", joint)?, target))
}

/// Sets the pose of the second body of a motor joint relative to the first: offset in length units, angle in radians.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_joint_set_motor_target(
    simulator: Option<&FarseerSimulator>,
    joint: FarseerJoint,
    offset: FarseerVector2,
    angle: f32,
) -> FarseerStatus {
    with(simulator, |world| {
        let joint = JointId::from_number("joint", joint)?;
        Ok(world.simulator.set_motor_joint_target(joint, offset.finite("offset")?, angle)?)
    })
}

/// Writes how far a joint has turned in radians, or slid in length units.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_joint_travel(
    simulator: Option<&FarseerSimulator>,
    joint: FarseerJoint,
    travel: Option<&mut MaybeUninit<f32>>,
) -> FarseerStatus {
    write(simulator, "travel", travel, |world| {
        Ok(world.simulator.joint_travel(JointId::from_number("joint", joint)?)?)
    })
}
