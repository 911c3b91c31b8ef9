//! Properties of bodies.

use std::mem::MaybeUninit;

use farseer_core::{Body, BodyId};

use crate::arguments::{FarseerVector2, Finite, flag};
use crate::failure::{Failure, FarseerStatus, Outcome};
use crate::guard::{FarseerSimulator, with, write};
use crate::ids::{FarseerBody, Id};

/// Writes a property of a body. `argument`: name of the result.
fn look<T>(
    simulator: Option<&FarseerSimulator>,
    body: FarseerBody,
    argument: &'static str,
    result: Option<&mut MaybeUninit<T>>,
    property: impl FnOnce(&Body) -> T,
) -> FarseerStatus {
    write(simulator, argument, result, |world| {
        let body = BodyId::from_number("body", body)?;
        world.simulator.body(body).map(property).ok_or_else(|| Failure::stale("body"))
    })
}

/// Changes a body.
pub(crate) fn edit(
    simulator: Option<&FarseerSimulator>,
    body: FarseerBody,
    change: impl FnOnce(&mut Body) -> Outcome,
) -> FarseerStatus {
    with(simulator, |world| {
        let body = BodyId::from_number("body", body)?;
        change(world.simulator.body_mut(body).ok_or_else(|| Failure::stale("body"))?)
    })
}

/// Writes the position of the body's origin in length units.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_body_position(
    simulator: Option<&FarseerSimulator>,
    body: FarseerBody,
    position: Option<&mut MaybeUninit<FarseerVector2>>,
) -> FarseerStatus {
    look(simulator, body, "position", position, |body| body.position().into())
}

/// Sets the position of the body's origin in length units.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_body_set_position(
    simulator: Option<&FarseerSimulator>,
    body: FarseerBody,
    position: FarseerVector2,
) -> FarseerStatus {
    edit(simulator, body, |body| {
        body.set_position(position.finite("position")?);
        Ok(())
    })
}

/// Writes the rotation in radians, from 0 to a full turn.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_body_rotation(
    simulator: Option<&FarseerSimulator>,
    body: FarseerBody,
    rotation: Option<&mut MaybeUninit<f32>>,
) -> FarseerStatus {
    look(simulator, body, "rotation", rotation, Body::rotation)
}

/// Sets the rotation in radians, from 0 to a full turn.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_body_set_rotation(
    simulator: Option<&FarseerSimulator>,
    body: FarseerBody,
    rotation: f32,
) -> FarseerStatus {
    edit(simulator, body, |body| {
        body.set_rotation(rotation.finite("rotation")?);
        Ok(())
    })
}

/// Writes the rotation in radians with all turns.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_body_total_rotation(
    simulator: Option<&FarseerSimulator>,
    body: FarseerBody,
    total_rotation: Option<&mut MaybeUninit<f32>>,
) -> FarseerStatus {
    look(simulator, body, "total_rotation", total_rotation, Body::total_rotation)
}

/// Writes the velocity of the origin in length units/s.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_body_linear_velocity(
    simulator: Option<&FarseerSimulator>,
    body: FarseerBody,
    linear_velocity: Option<&mut MaybeUninit<FarseerVector2>>,
) -> FarseerStatus {
    look(simulator, body, "linear_velocity", linear_velocity, |body| body.linear_velocity().into())
}

/// Sets the velocity of the origin in length units/s.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_body_set_linear_velocity(
    simulator: Option<&FarseerSimulator>,
    body: FarseerBody,
    linear_velocity: FarseerVector2,
) -> FarseerStatus {
    edit(simulator, body, |body| {
        body.set_linear_velocity(linear_velocity.finite("linear_velocity")?);
        Ok(())
    })
}

/// Writes the angular velocity in rad/s, clockwise on the screen.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_body_angular_velocity(
    simulator: Option<&FarseerSimulator>,
    body: FarseerBody,
    angular_velocity: Option<&mut MaybeUninit<f32>>,
) -> FarseerStatus {
    look(simulator, body, "angular_velocity", angular_velocity, Body::angular_velocity)
}

/// Sets the angular velocity in rad/s, clockwise on the screen.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_body_set_angular_velocity(
    simulator: Option<&FarseerSimulator>,
    body: FarseerBody,
    angular_velocity: f32,
) -> FarseerStatus {
    edit(simulator, body, |body| {
        body.set_angular_velocity(angular_velocity.finite("angular_velocity")?);
        Ok(())
    })
}

/// Writes the mass in mass units, not 0.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_body_mass(
    simulator: Option<&FarseerSimulator>,
    body: FarseerBody,
    mass: Option<&mut MaybeUninit<f32>>,
) -> FarseerStatus {
    look(simulator, body, "mass", mass, Body::mass)
}

/// Sets the mass in mass units, not 0.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_body_set_mass(
    simulator: Option<&FarseerSimulator>,
    body: FarseerBody,
    mass: f32,
) -> FarseerStatus {
    edit(simulator, body, |body| Ok(body.set_mass(mass.finite("mass")?)?))
}

/// Writes the moment of inertia in mass units · length units², > 0.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_body_moment_of_inertia(
    simulator: Option<&FarseerSimulator>,
    body: FarseerBody,
    moment_of_inertia: Option<&mut MaybeUninit<f32>>,
) -> FarseerStatus {
    look(simulator, body, "moment_of_inertia", moment_of_inertia, Body::moment_of_inertia)
}

/// Sets the moment of inertia in mass units · length units², > 0.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_body_set_moment_of_inertia(
    simulator: Option<&FarseerSimulator>,
    body: FarseerBody,
    moment_of_inertia: f32,
) -> FarseerStatus {
    edit(simulator, body, |body| {
        Ok(body.set_moment_of_inertia(moment_of_inertia.finite("moment_of_inertia")?)?)
    })
}

/// Writes the coefficient of linear drag in mass units/s: force = -c · velocity. Default 0.001.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_body_linear_drag_coefficient(
    simulator: Option<&FarseerSimulator>,
    body: FarseerBody,
    linear_drag_coefficient: Option<&mut MaybeUninit<f32>>,
) -> FarseerStatus {
    look(simulator, body, "linear_drag_coefficient", linear_drag_coefficient, Body::linear_drag_coefficient)
}

/// Sets the coefficient of linear drag in mass units/s: force = -c · velocity. Default 0.001.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_body_set_linear_drag_coefficient(
    simulator: Option<&FarseerSimulator>,
    body: FarseerBody,
    linear_drag_coefficient: f32,
) -> FarseerStatus {
    edit(simulator, body, |body| {
        body.set_linear_drag_coefficient(linear_drag_coefficient.finite("linear_drag_coefficient")?);
        Ok(())
    })
}

/// Writes the coefficient of rotational drag: torque = -c · angular velocity · |angular velocity|. Default 0.001.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_body_rotational_drag_coefficient(
    simulator: Option<&FarseerSimulator>,
    body: FarseerBody,
    rotational_drag_coefficient: Option<&mut MaybeUninit<f32>>,
) -> FarseerStatus {
    look(
        simulator,
        body,
        "rotational_drag_coefficient",
        rotational_drag_coefficient,
        Body::rotational_drag_coefficient,
    )
}

/// Sets the coefficient of rotational drag: torque = -c · angular velocity · |angular velocity|. Default 0.001.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_body_set_rotational_drag_coefficient(
    simulator: Option<&FarseerSimulator>,
    body: FarseerBody,
    rotational_drag_coefficient: f32,
) -> FarseerStatus {
    edit(simulator, body, |body| {
        body.set_rotational_drag_coefficient(
            rotational_drag_coefficient.finite("rotational_drag_coefficient")?,
        );
        Ok(())
    })
}

/// Writes the factor by which gravity acts on the body. Default 1.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_body_gravity_scale(
    simulator: Option<&FarseerSimulator>,
    body: FarseerBody,
    gravity_scale: Option<&mut MaybeUninit<f32>>,
) -> FarseerStatus {
    look(simulator, body, "gravity_scale", gravity_scale, Body::gravity_scale)
}

/// Sets the factor by which gravity acts on the body. Default 1.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_body_set_gravity_scale(
    simulator: Option<&FarseerSimulator>,
    body: FarseerBody,
    gravity_scale: f32,
) -> FarseerStatus {
    edit(simulator, body, |body| {
        body.set_gravity_scale(gravity_scale.finite("gravity_scale")?);
        Ok(())
    })
}

/// Writes whether gravity has no effect on the body: 0 or 1.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_body_ignore_gravity(
    simulator: Option<&FarseerSimulator>,
    body: FarseerBody,
    ignore_gravity: Option<&mut MaybeUninit<i32>>,
) -> FarseerStatus {
    look(simulator, body, "ignore_gravity", ignore_gravity, |body| body.ignore_gravity().into())
}

/// Sets whether gravity has no effect on the body: 0 or 1.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_body_set_ignore_gravity(
    simulator: Option<&FarseerSimulator>,
    body: FarseerBody,
    ignore_gravity: i32,
) -> FarseerStatus {
    edit(simulator, body, |body| {
        body.set_ignore_gravity(flag("ignore_gravity", ignore_gravity)?);
        Ok(())
    })
}

/// Writes whether the body never moves: 0 or 1.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_body_is_static(
    simulator: Option<&FarseerSimulator>,
    body: FarseerBody,
    is_static: Option<&mut MaybeUninit<i32>>,
) -> FarseerStatus {
    look(simulator, body, "is_static", is_static, |body| body.is_static().into())
}

/// Sets whether the body never moves: 0 or 1.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_body_set_is_static(
    simulator: Option<&FarseerSimulator>,
    body: FarseerBody,
    is_static: i32,
) -> FarseerStatus {
    edit(simulator, body, |body| {
        body.set_is_static(flag("is_static", is_static)?);
        Ok(())
    })
}

/// Writes whether only its velocity moves the body: 0 or 1.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_body_is_kinematic(
    simulator: Option<&FarseerSimulator>,
    body: FarseerBody,
    is_kinematic: Option<&mut MaybeUninit<i32>>,
) -> FarseerStatus {
    look(simulator, body, "is_kinematic", is_kinematic, |body| body.is_kinematic().into())
}

/// Sets whether only its velocity moves the body: 0 or 1.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_body_set_is_kinematic(
    simulator: Option<&FarseerSimulator>,
    body: FarseerBody,
    is_kinematic: i32,
) -> FarseerStatus {
    edit(simulator, body, |body| {
        body.set_is_kinematic(flag("is_kinematic", is_kinematic)?);
        Ok(())
    })
}

/// Writes whether continuous collision acts against all bodies: 0 or 1.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_body_is_bullet(
    simulator: Option<&FarseerSimulator>,
    body: FarseerBody,
    is_bullet: Option<&mut MaybeUninit<i32>>,
) -> FarseerStatus {
    look(simulator, body, "is_bullet", is_bullet, |body| body.is_bullet().into())
}

/// Sets whether continuous collision acts against all bodies: 0 or 1.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_body_set_is_bullet(
    simulator: Option<&FarseerSimulator>,
    body: FarseerBody,
    is_bullet: i32,
) -> FarseerStatus {
    edit(simulator, body, |body| {
        body.set_is_bullet(flag("is_bullet", is_bullet)?);
        Ok(())
    })
}

/// Writes whether the body takes part: 0 or 1. Default 1.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_body_enabled(
    simulator: Option<&FarseerSimulator>,
    body: FarseerBody,
    enabled: Option<&mut MaybeUninit<i32>>,
) -> FarseerStatus {
    look(simulator, body, "enabled", enabled, |body| body.enabled().into())
}

/// Sets whether the body takes part: 0 or 1. Default 1.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_body_set_enabled(
    simulator: Option<&FarseerSimulator>,
    body: FarseerBody,
    enabled: i32,
) -> FarseerStatus {
    edit(simulator, body, |body| {
        body.set_enabled(flag("enabled", enabled)?);
        Ok(())
    })
}

/// Writes whether the body never turns: 0 or 1.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_body_rotation_locked(
    simulator: Option<&FarseerSimulator>,
    body: FarseerBody,
    rotation_locked: Option<&mut MaybeUninit<i32>>,
) -> FarseerStatus {
    look(simulator, body, "rotation_locked", rotation_locked, |body| body.is_rotation_locked().into())
}

/// Sets whether the body never turns: 0 or 1.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_body_set_rotation_locked(
    simulator: Option<&FarseerSimulator>,
    body: FarseerBody,
    rotation_locked: i32,
) -> FarseerStatus {
    edit(simulator, body, |body| {
        body.set_rotation_locked(flag("rotation_locked", rotation_locked)?);
        Ok(())
    })
}

/// Writes whether the body may fall asleep: 0 or 1. Default 1.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_body_sleep_allowed(
    simulator: Option<&FarseerSimulator>,
    body: FarseerBody,
    sleep_allowed: Option<&mut MaybeUninit<i32>>,
) -> FarseerStatus {
    look(simulator, body, "sleep_allowed", sleep_allowed, |body| body.is_sleep_allowed().into())
}

/// Sets whether the body may fall asleep: 0 or 1. Default 1.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_body_set_sleep_allowed(
    simulator: Option<&FarseerSimulator>,
    body: FarseerBody,
    sleep_allowed: i32,
) -> FarseerStatus {
    edit(simulator, body, |body| {
        body.set_sleep_allowed(flag("sleep_allowed", sleep_allowed)?);
        Ok(())
    })
}

/// Writes whether sleep and waking of the body are events: 0 or 1.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_body_sleep_events(
    simulator: Option<&FarseerSimulator>,
    body: FarseerBody,
    sleep_events: Option<&mut MaybeUninit<i32>>,
) -> FarseerStatus {
    look(simulator, body, "sleep_events", sleep_events, |body| body.has_sleep_events().into())
}

/// Sets whether sleep and waking of the body are events: 0 or 1.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_body_set_sleep_events(
    simulator: Option<&FarseerSimulator>,
    body: FarseerBody,
    sleep_events: i32,
) -> FarseerStatus {
    edit(simulator, body, |body| {
        body.set_sleep_events(flag("sleep_events", sleep_events)?);
        Ok(())
    })
}

/// Writes a number of yours, which the engine never reads.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_body_tag(
    simulator: Option<&FarseerSimulator>,
    body: FarseerBody,
    tag: Option<&mut MaybeUninit<u64>>,
) -> FarseerStatus {
    look(simulator, body, "tag", tag, Body::tag)
}

/// Sets a number of yours, which the engine never reads.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_body_set_tag(
    simulator: Option<&FarseerSimulator>,
    body: FarseerBody,
    tag: u64,
) -> FarseerStatus {
    edit(simulator, body, |body| {
        body.set_tag(tag);
        Ok(())
    })
}

/// Writes the position in the world of a point of the body, both in length units.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_body_world_position(
    simulator: Option<&FarseerSimulator>,
    body: FarseerBody,
    local: FarseerVector2,
    world: Option<&mut MaybeUninit<FarseerVector2>>,
) -> FarseerStatus {
    write(simulator, "world", world, |content| {
        let id = BodyId::from_number("body", body)?;
        let body = content.simulator.body(id).ok_or_else(|| Failure::stale("body"))?;
        Ok(body.get_world_position(local.finite("local")?).into())
    })
}

/// Writes the position on the body of a point of the world, both in length units.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_body_local_position(
    simulator: Option<&FarseerSimulator>,
    body: FarseerBody,
    world: FarseerVector2,
    local: Option<&mut MaybeUninit<FarseerVector2>>,
) -> FarseerStatus {
    write(simulator, "local", local, |content| {
        let id = BodyId::from_number("body", body)?;
        let body = content.simulator.body(id).ok_or_else(|| Failure::stale("body"))?;
        Ok(body.get_local_position(world.finite("world")?).into())
    })
}
