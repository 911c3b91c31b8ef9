//! Forces, impulses, motion and sleep of bodies.

use std::mem::MaybeUninit;

use farseer_core::BodyId;

use crate::arguments::{FarseerVector2, Finite};
use crate::body::edit;
use crate::failure::Outcome;
use crate::failure::{Failure, FarseerStatus};
use crate::guard::{FarseerSimulator, World, with, write};
use crate::ids::{FarseerBody, Id};

/// The body of a number, if it is not stale.
fn existing(world: &World, body: FarseerBody) -> Outcome<BodyId> {
    let id = BodyId::from_number("body", body)?;
    world.simulator.body(id).map(|_| id).ok_or_else(|| Failure::stale("body"))
}

/// Adds a force in mass units · length units/s² that acts at the origin in the next update.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_body_apply_force(
    simulator: Option<&FarseerSimulator>,
    body: FarseerBody,
    force: FarseerVector2,
) -> FarseerStatus {
    edit(simulator, body, |body| {
        body.apply_force(force.finite("force")?);
        Ok(())
    })
}

/// Adds a force in mass units · length units/s² that acts at a point of the world in the next update.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_body_apply_force_at_world_point(
    simulator: Option<&FarseerSimulator>,
    body: FarseerBody,
    force: FarseerVector2,
    point: FarseerVector2,
) -> FarseerStatus {
    edit(simulator, body, |body| {
        body.apply_force_at_world_point(force.finite("force")?, point.finite("point")?);
        Ok(())
    })
}

/// Adds a torque in mass units · length units²/s² that acts in the next update.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_body_apply_torque(
    simulator: Option<&FarseerSimulator>,
    body: FarseerBody,
    torque: f32,
) -> FarseerStatus {
    edit(simulator, body, |body| {
        body.apply_torque(torque.finite("torque")?);
        Ok(())
    })
}

/// Adds an impulse at the origin in mass units · length units/s.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_body_apply_impulse(
    simulator: Option<&FarseerSimulator>,
    body: FarseerBody,
    impulse: FarseerVector2,
) -> FarseerStatus {
    edit(simulator, body, |body| {
        body.apply_impulse(impulse.finite("impulse")?);
        Ok(())
    })
}

/// Adds an impulse at a point of the world in mass units · length units/s.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_body_apply_impulse_at_world_point(
    simulator: Option<&FarseerSimulator>,
    body: FarseerBody,
    impulse: FarseerVector2,
    point: FarseerVector2,
) -> FarseerStatus {
    edit(simulator, body, |body| {
        body.apply_impulse_at_world_point(impulse.finite("impulse")?, point.finite("point")?);
        Ok(())
    })
}

/// Adds an angular impulse in mass units · length units²/s.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_body_apply_angular_impulse(
    simulator: Option<&FarseerSimulator>,
    body: FarseerBody,
    impulse: f32,
) -> FarseerStatus {
    edit(simulator, body, |body| {
        body.apply_angular_impulse(impulse.finite("impulse")?);
        Ok(())
    })
}

/// Removes the forces, torques and impulses that wait for the next update.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_body_clear_forces(
    simulator: Option<&FarseerSimulator>,
    body: FarseerBody,
) -> FarseerStatus {
    edit(simulator, body, |body| {
        body.clear_force();
        body.clear_torque();
        body.clear_impulse();
        Ok(())
    })
}

/// Puts the body at the origin, at rest and without rotation, and removes the forces that wait, as Farseer's ResetDynamics.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_body_reset_dynamics(
    simulator: Option<&FarseerSimulator>,
    body: FarseerBody,
) -> FarseerStatus {
    edit(simulator, body, |body| {
        body.reset_dynamics();
        Ok(())
    })
}

/// Moves a kinematic body to a position in length units and a rotation in radians in the next update.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_body_move_to(
    simulator: Option<&FarseerSimulator>,
    body: FarseerBody,
    position: FarseerVector2,
    rotation: f32,
) -> FarseerStatus {
    edit(
        simulator,
        body,
        |body| Ok(body.move_to(position.finite("position")?, rotation.finite("rotation")?)?),
    )
}

/// Puts a body to sleep at the end of the next update, with all bodies that touch it, under the precise methods.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_body_sleep(
    simulator: Option<&FarseerSimulator>,
    body: FarseerBody,
) -> FarseerStatus {
    with(simulator, |world| {
        let body = existing(world, body)?;
        world.simulator.sleep(body);
        Ok(())
    })
}

/// Wakes a body in the next update.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_body_wake(
    simulator: Option<&FarseerSimulator>,
    body: FarseerBody,
) -> FarseerStatus {
    with(simulator, |world| {
        let body = existing(world, body)?;
        world.simulator.wake(body);
        Ok(())
    })
}

/// Writes whether a body sleeps: 0 or 1.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_body_is_asleep(
    simulator: Option<&FarseerSimulator>,
    body: FarseerBody,
    is_asleep: Option<&mut MaybeUninit<i32>>,
) -> FarseerStatus {
    write(simulator, "is_asleep", is_asleep, |world| {
        Ok(world.simulator.is_asleep(existing(world, body)?).into())
    })
}
