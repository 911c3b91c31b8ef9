//! Springs.

use std::mem::MaybeUninit;

use farseer_core::{
    AngleSpring, BodyId, FixedAngleSpring, FixedLinearSpring, LinearSpring, Objects, Spring, SpringFactory,
    SpringId, SpringKind,
};

use crate::arguments::{FarseerVector2, Finite, flag};
use crate::failure::{Failure, FarseerStatus, Outcome};
use crate::guard::{FarseerSimulator, with, write};
use crate::ids::{FarseerBody, FarseerSpring, Id};

/// Makes a spring, adds it, and writes its id.
fn create(
    simulator: Option<&FarseerSimulator>,
    spring: Option<&mut MaybeUninit<FarseerSpring>>,
    make: impl FnOnce(&mut Objects) -> Outcome<SpringId>,
) -> FarseerStatus {
    write(simulator, "spring", spring, |world| make(&mut world.simulator)?.to_number())
}

/// Writes a property of a spring. `argument`: name of the result.
fn look<T>(
    simulator: Option<&FarseerSimulator>,
    spring: FarseerSpring,
    argument: &'static str,
    result: Option<&mut MaybeUninit<T>>,
    property: impl FnOnce(&Spring) -> T,
) -> FarseerStatus {
    write(simulator, argument, result, |world| {
        let spring = SpringId::from_number("spring", spring)?;
        world.simulator.spring(spring).map(property).ok_or_else(|| Failure::stale("spring"))
    })
}

/// Changes a spring.
fn edit(
    simulator: Option<&FarseerSimulator>,
    spring: FarseerSpring,
    change: impl FnOnce(&mut Spring) -> Outcome,
) -> FarseerStatus {
    with(simulator, |world| {
        let spring = SpringId::from_number("spring", spring)?;
        change(world.simulator.spring_mut(spring).ok_or_else(|| Failure::stale("spring"))?)
    })
}

/// Sets the target of a spring: a length in length units, or an angle in radians.
fn set_target(objects: &mut Objects, spring: SpringId, target: f32) -> Outcome {
    let kind = objects.spring(spring).ok_or_else(|| Failure::stale("spring"))?.kind();
    match kind {
        SpringKind::Angle(_) => objects.spring_as_mut::<AngleSpring>(spring)?.set_target_angle(target)?,
        SpringKind::FixedAngle(_) => {
            objects.spring_as_mut::<FixedAngleSpring>(spring)?.set_target_angle(target)?
        }
        SpringKind::FixedLinear(_) => {
            objects.spring_as_mut::<FixedLinearSpring>(spring)?.set_rest_length(target)?
        }
        _ => objects.spring_as_mut::<LinearSpring>(spring)?.set_rest_length(target)?,
    }
    Ok(())
}

/// A spring between points of two bodies, in their frames, in length units. Stiffness in mass units/s², damping in mass units/s.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_spring_create_linear(
    simulator: Option<&FarseerSimulator>,
    body1: FarseerBody,
    point1: FarseerVector2,
    body2: FarseerBody,
    point2: FarseerVector2,
    spring_constant: f32,
    damping_constant: f32,
    spring: Option<&mut MaybeUninit<FarseerSpring>>,
) -> FarseerStatus {
    create(simulator, spring, |objects| {
        let (body1, body2) = (BodyId::from_number("body1", body1)?, BodyId::from_number("body2", body2)?);
        let (point1, point2) = (point1.finite("point1")?, point2.finite("point2")?);
        let constants = (spring_constant, damping_constant);
        Ok(SpringFactory::create_linear_spring_in(
            objects,
            body1,
            point1,
            body2,
            point2,
            constants.0,
            constants.1,
        )?)
    })
}

/// A spring between a point of a body, in its frame, and a point of the world, in length units.
/// Stiffness in mass units/s², damping in mass units/s.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_spring_create_fixed_linear(
    simulator: Option<&FarseerSimulator>,
    body: FarseerBody,
    body_point: FarseerVector2,
    world_point: FarseerVector2,
    spring_constant: f32,
    damping_constant: f32,
    spring: Option<&mut MaybeUninit<FarseerSpring>>,
) -> FarseerStatus {
    create(simulator, spring, |objects| {
        let body = BodyId::from_number("body", body)?;
        let (point, world) = (body_point.finite("body_point")?, world_point.finite("world_point")?);
        let constants = (spring_constant, damping_constant);
        Ok(SpringFactory::create_fixed_linear_spring_in(
            objects,
            body,
            point,
            world,
            constants.0,
            constants.1,
        )?)
    })
}

/// A spring between the angles of two bodies. Stiffness and damping in torque per radian and per rad/s.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_spring_create_angle(
    simulator: Option<&FarseerSimulator>,
    body1: FarseerBody,
    body2: FarseerBody,
    spring_constant: f32,
    damping_constant: f32,
    spring: Option<&mut MaybeUninit<FarseerSpring>>,
) -> FarseerStatus {
    create(simulator, spring, |objects| {
        let (body1, body2) = (BodyId::from_number("body1", body1)?, BodyId::from_number("body2", body2)?);
        Ok(SpringFactory::create_angle_spring_in(objects, body1, body2, spring_constant, damping_constant)?)
    })
}

/// A spring that turns a body to an angle. Stiffness and damping in torque per radian and per rad/s.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_spring_create_fixed_angle(
    simulator: Option<&FarseerSimulator>,
    body: FarseerBody,
    spring_constant: f32,
    damping_constant: f32,
    spring: Option<&mut MaybeUninit<FarseerSpring>>,
) -> FarseerStatus {
    create(simulator, spring, |objects| {
        let body = BodyId::from_number("body", body)?;
        Ok(SpringFactory::create_fixed_angle_spring_in(objects, body, spring_constant, damping_constant)?)
    })
}

/// Writes whether the spring acts: 0 or 1. A spring that broke is disabled.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_spring_enabled(
    simulator: Option<&FarseerSimulator>,
    spring: FarseerSpring,
    enabled: Option<&mut MaybeUninit<i32>>,
) -> FarseerStatus {
    look(simulator, spring, "enabled", enabled, |spring| spring.enabled().into())
}

/// Sets whether the spring acts: 0 or 1. A spring that broke is disabled.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_spring_set_enabled(
    simulator: Option<&FarseerSimulator>,
    spring: FarseerSpring,
    enabled: i32,
) -> FarseerStatus {
    edit(simulator, spring, |spring| {
        spring.set_enabled(flag("enabled", enabled)?);
        Ok(())
    })
}

/// Writes the stiffness: force per length unit, or torque per radian.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_spring_spring_constant(
    simulator: Option<&FarseerSimulator>,
    spring: FarseerSpring,
    spring_constant: Option<&mut MaybeUninit<f32>>,
) -> FarseerStatus {
    look(simulator, spring, "spring_constant", spring_constant, Spring::spring_constant)
}

/// Sets the stiffness: force per length unit, or torque per radian.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_spring_set_spring_constant(
    simulator: Option<&FarseerSimulator>,
    spring: FarseerSpring,
    spring_constant: f32,
) -> FarseerStatus {
    edit(simulator, spring, |spring| {
        Ok(spring.set_spring_constant(spring_constant.finite("spring_constant")?)?)
    })
}

/// Writes the damping: force per length unit/s, or torque per rad/s.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_spring_damping_constant(
    simulator: Option<&FarseerSimulator>,
    spring: FarseerSpring,
    damping_constant: Option<&mut MaybeUninit<f32>>,
) -> FarseerStatus {
    look(simulator, spring, "damping_constant", damping_constant, Spring::damping_constant)
}

/// Sets the damping: force per length unit/s, or torque per rad/s.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_spring_set_damping_constant(
    simulator: Option<&FarseerSimulator>,
    spring: FarseerSpring,
    damping_constant: f32,
) -> FarseerStatus {
    edit(simulator, spring, |spring| {
        Ok(spring.set_damping_constant(damping_constant.finite("damping_constant")?)?)
    })
}

/// Writes the error, in length units or radians, beyond which the spring breaks.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_spring_breakpoint(
    simulator: Option<&FarseerSimulator>,
    spring: FarseerSpring,
    breakpoint: Option<&mut MaybeUninit<f32>>,
) -> FarseerStatus {
    look(simulator, spring, "breakpoint", breakpoint, Spring::breakpoint)
}

/// Sets the error, in length units or radians, beyond which the spring breaks.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_spring_set_breakpoint(
    simulator: Option<&FarseerSimulator>,
    spring: FarseerSpring,
    breakpoint: f32,
) -> FarseerStatus {
    edit(simulator, spring, |spring| Ok(spring.set_breakpoint(breakpoint.finite("breakpoint")?)?))
}

/// Writes the error of the spring in the last update, in length units or radians.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_spring_error(
    simulator: Option<&FarseerSimulator>,
    spring: FarseerSpring,
    error: Option<&mut MaybeUninit<f32>>,
) -> FarseerStatus {
    look(simulator, spring, "error", error, Spring::spring_error)
}

/// Writes a number of yours, which the engine never reads.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_spring_tag(
    simulator: Option<&FarseerSimulator>,
    spring: FarseerSpring,
    tag: Option<&mut MaybeUninit<u64>>,
) -> FarseerStatus {
    look(simulator, spring, "tag", tag, Spring::tag)
}

/// Sets a number of yours, which the engine never reads.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_spring_set_tag(
    simulator: Option<&FarseerSimulator>,
    spring: FarseerSpring,
    tag: u64,
) -> FarseerStatus {
    edit(simulator, spring, |spring| {
        spring.set_tag(tag);
        Ok(())
    })
}

/// Sets the rest length of a linear spring in length units, or the angle of an angle spring in radians.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_spring_set_target(
    simulator: Option<&FarseerSimulator>,
    spring: FarseerSpring,
    target: f32,
) -> FarseerStatus {
    with(simulator, |world| {
        set_target(&mut world.simulator, SpringId::from_number("spring", spring)?, target)
    })
}
