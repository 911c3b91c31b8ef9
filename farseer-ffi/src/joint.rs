//! Properties of joints of all kinds.

use std::mem::MaybeUninit;

use farseer_core::{Joint, JointId, JointKind};

use crate::arguments::{FarseerVector2, Finite, flag};
use crate::failure::{Failure, FarseerStatus, Outcome};
use crate::guard::{FarseerSimulator, with, write};
use crate::ids::{FarseerJoint, Id};

/// The kinds of joints.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FarseerJointKind {
    /// A kind that this interface does not have.
    Other = 0,
    /// A hinge between two bodies.
    Revolute = 1,
    /// A hinge between a body and the world.
    FixedRevolute = 2,
    /// A rod.
    Pin = 3,
    /// A range of distances.
    Slider = 4,
    /// A relative angle.
    Angle = 5,
    /// An angle of a body.
    FixedAngle = 6,
    /// A range of relative angles.
    AngleLimit = 7,
    /// A range of angles of a body.
    FixedAngleLimit = 8,
    /// A point and the relative angle.
    Weld = 9,
    /// A line and the relative angle.
    Prismatic = 10,
    /// A wheel with suspension.
    Wheel = 11,
    /// A spring between angles.
    AngleSpring = 12,
    /// A bounded force to a pose.
    Motor = 13,
    /// Two bodies that turn in a ratio.
    Gear = 14,
    /// A rope over two points.
    Pulley = 15,
}

impl From<&JointKind> for FarseerJointKind {
    fn from(kind: &JointKind) -> Self {
        match kind {
            JointKind::Revolute(_) => FarseerJointKind::Revolute,
            JointKind::FixedRevolute(_) => FarseerJointKind::FixedRevolute,
            JointKind::Pin(_) => FarseerJointKind::Pin,
            JointKind::Slider(_) => FarseerJointKind::Slider,
            JointKind::Angle(_) => FarseerJointKind::Angle,
            JointKind::FixedAngle(_) => FarseerJointKind::FixedAngle,
            JointKind::AngleLimit(_) => FarseerJointKind::AngleLimit,
            JointKind::FixedAngleLimit(_) => FarseerJointKind::FixedAngleLimit,
            JointKind::Weld(_) => FarseerJointKind::Weld,
            JointKind::Prismatic(_) => FarseerJointKind::Prismatic,
            JointKind::Wheel(_) => FarseerJointKind::Wheel,
            JointKind::AngleSpring(_) => FarseerJointKind::AngleSpring,
            JointKind::Motor(_) => FarseerJointKind::Motor,
            JointKind::Gear(_) => FarseerJointKind::Gear,
            JointKind::Pulley(_) => FarseerJointKind::Pulley,
            _ => FarseerJointKind::Other,
        }
    }
}

/// Writes a property of a joint. `argument`: name of the result.
fn look<T>(
    simulator: Option<&FarseerSimulator>,
    joint: FarseerJoint,
    argument: &'static str,
    result: Option<&mut MaybeUninit<T>>,
    property: impl FnOnce(&Joint) -> T,
) -> FarseerStatus {
    write(simulator, argument, result, |world| {
        let joint = JointId::from_number("joint", joint)?;
        world.simulator.joint(joint).map(property).ok_or_else(|| Failure::stale("joint"))
    })
}

/// Changes a joint.
fn edit(
    simulator: Option<&FarseerSimulator>,
    joint: FarseerJoint,
    change: impl FnOnce(&mut Joint) -> Outcome,
) -> FarseerStatus {
    with(simulator, |world| {
        let joint = JointId::from_number("joint", joint)?;
        change(world.simulator.joint_mut(joint).ok_or_else(|| Failure::stale("joint"))?)
    })
}

/// Writes whether the joint acts: 0 or 1. A joint that broke is disabled.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_joint_enabled(
    simulator: Option<&FarseerSimulator>,
    joint: FarseerJoint,
    enabled: Option<&mut MaybeUninit<i32>>,
) -> FarseerStatus {
    look(simulator, joint, "enabled", enabled, |joint| joint.enabled().into())
}

/// Sets whether the joint acts: 0 or 1. A joint that broke is disabled.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_joint_set_enabled(
    simulator: Option<&FarseerSimulator>,
    joint: FarseerJoint,
    enabled: i32,
) -> FarseerStatus {
    edit(simulator, joint, |joint| {
        joint.set_enabled(flag("enabled", enabled)?);
        Ok(())
    })
}

/// Writes the fraction of the error that an update corrects. Default 0.2, for fixed revolute joints 0.8.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_joint_bias_factor(
    simulator: Option<&FarseerSimulator>,
    joint: FarseerJoint,
    bias_factor: Option<&mut MaybeUninit<f32>>,
) -> FarseerStatus {
    look(simulator, joint, "bias_factor", bias_factor, Joint::bias_factor)
}

/// Sets the fraction of the error that an update corrects. Default 0.2, for fixed revolute joints 0.8.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_joint_set_bias_factor(
    simulator: Option<&FarseerSimulator>,
    joint: FarseerJoint,
    bias_factor: f32,
) -> FarseerStatus {
    edit(simulator, joint, |joint| Ok(joint.set_bias_factor(bias_factor.finite("bias_factor")?)?))
}

/// Writes how far the joint yields to its load; the unit depends on the kind. Default 0.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_joint_softness(
    simulator: Option<&FarseerSimulator>,
    joint: FarseerJoint,
    softness: Option<&mut MaybeUninit<f32>>,
) -> FarseerStatus {
    look(simulator, joint, "softness", softness, Joint::softness)
}

/// Sets how far the joint yields to its load; the unit depends on the kind. Default 0.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_joint_set_softness(
    simulator: Option<&FarseerSimulator>,
    joint: FarseerJoint,
    softness: f32,
) -> FarseerStatus {
    edit(simulator, joint, |joint| Ok(joint.set_softness(softness.finite("softness")?)?))
}

/// Writes the error, in length units or radians, beyond which the joint breaks.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_joint_breakpoint(
    simulator: Option<&FarseerSimulator>,
    joint: FarseerJoint,
    breakpoint: Option<&mut MaybeUninit<f32>>,
) -> FarseerStatus {
    look(simulator, joint, "breakpoint", breakpoint, Joint::breakpoint)
}

/// Sets the error, in length units or radians, beyond which the joint breaks.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_joint_set_breakpoint(
    simulator: Option<&FarseerSimulator>,
    joint: FarseerJoint,
    breakpoint: f32,
) -> FarseerStatus {
    edit(simulator, joint, |joint| Ok(joint.set_breakpoint(breakpoint.finite("breakpoint")?)?))
}

/// Writes the force, in mass units · length units/s², beyond which the joint breaks under the precise methods.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_joint_greatest_force(
    simulator: Option<&FarseerSimulator>,
    joint: FarseerJoint,
    greatest_force: Option<&mut MaybeUninit<f32>>,
) -> FarseerStatus {
    look(simulator, joint, "greatest_force", greatest_force, Joint::greatest_force)
}

/// Sets the force, in mass units · length units/s², beyond which the joint breaks under the precise methods.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_joint_set_greatest_force(
    simulator: Option<&FarseerSimulator>,
    joint: FarseerJoint,
    greatest_force: f32,
) -> FarseerStatus {
    edit(simulator, joint, |joint| Ok(joint.set_greatest_force(greatest_force.finite("greatest_force")?)?))
}

/// Writes the torque, in mass units · length units²/s², beyond which the joint breaks under the precise methods.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_joint_greatest_torque(
    simulator: Option<&FarseerSimulator>,
    joint: FarseerJoint,
    greatest_torque: Option<&mut MaybeUninit<f32>>,
) -> FarseerStatus {
    look(simulator, joint, "greatest_torque", greatest_torque, Joint::greatest_torque)
}

/// Sets the torque, in mass units · length units²/s², beyond which the joint breaks under the precise methods.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_joint_set_greatest_torque(
    simulator: Option<&FarseerSimulator>,
    joint: FarseerJoint,
    greatest_torque: f32,
) -> FarseerStatus {
    edit(simulator, joint, |joint| Ok(joint.set_greatest_torque(greatest_torque.finite("greatest_torque")?)?))
}

/// Writes the force of the joint in the last update, in mass units · length units/s², under the precise methods.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_joint_force(
    simulator: Option<&FarseerSimulator>,
    joint: FarseerJoint,
    force: Option<&mut MaybeUninit<FarseerVector2>>,
) -> FarseerStatus {
    look(simulator, joint, "force", force, |joint| joint.force().into())
}

/// Writes the torque of the joint in the last update, in mass units · length units²/s², under the precise methods.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_joint_torque(
    simulator: Option<&FarseerSimulator>,
    joint: FarseerJoint,
    torque: Option<&mut MaybeUninit<f32>>,
) -> FarseerStatus {
    look(simulator, joint, "torque", torque, Joint::torque)
}

/// Writes the error of the joint in the last update, in length units or radians.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_joint_error(
    simulator: Option<&FarseerSimulator>,
    joint: FarseerJoint,
    error: Option<&mut MaybeUninit<f32>>,
) -> FarseerStatus {
    look(simulator, joint, "error", error, Joint::joint_error)
}

/// Writes a number of yours, which the engine never reads.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_joint_tag(
    simulator: Option<&FarseerSimulator>,
    joint: FarseerJoint,
    tag: Option<&mut MaybeUninit<u64>>,
) -> FarseerStatus {
    look(simulator, joint, "tag", tag, Joint::tag)
}

/// Sets a number of yours, which the engine never reads.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_joint_set_tag(
    simulator: Option<&FarseerSimulator>,
    joint: FarseerJoint,
    tag: u64,
) -> FarseerStatus {
    edit(simulator, joint, |joint| {
        joint.set_tag(tag);
        Ok(())
    })
}

/// Writes the kind of a joint: a FarseerJointKind.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_joint_kind(
    simulator: Option<&FarseerSimulator>,
    joint: FarseerJoint,
    kind: Option<&mut MaybeUninit<i32>>,
) -> FarseerStatus {
    look(simulator, joint, "kind", kind, |joint| FarseerJointKind::from(joint.kind()) as i32)
}

/// Sets whether the two bodies collide: 0 or 1. Default 1; 0 needs the precise methods.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_joint_set_bodies_collide(
    simulator: Option<&FarseerSimulator>,
    joint: FarseerJoint,
    bodies_collide: i32,
) -> FarseerStatus {
    with(simulator, |world| {
        let joint = JointId::from_number("joint", joint)?;
        Ok(world.simulator.set_joint_bodies_collide(joint, flag("bodies_collide", bodies_collide)?)?)
    })
}
