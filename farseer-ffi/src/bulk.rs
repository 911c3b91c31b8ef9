//! Poses and velocities of many bodies in one call.

use std::mem::MaybeUninit;

use farseer_core::{Body, BodyId, PhysicsSimulator};

use crate::arguments::FarseerVector2;
use crate::arrays;
use crate::failure::{Failure, FarseerStatus, Outcome};
use crate::guard::{FarseerSimulator, with};
use crate::ids::{FarseerBody, Id};

/// The bodies of numbers; refused if one of them is stale.
fn existing<'a>(simulator: &'a PhysicsSimulator, numbers: &[FarseerBody]) -> Outcome<Vec<&'a Body>> {
    let find = |&number| {
        let id = BodyId::from_number("bodies", number)?;
        simulator.body(id).ok_or_else(|| Failure::stale("bodies"))
    };
    numbers.iter().map(find).collect()
}

/// Room for one value of each body; none if the pointer is null. `count`: number of bodies.
///
/// # Safety
/// As [`arrays::room`].
unsafe fn optional<'a, T>(argument: &str, values: *mut T, count: usize) -> Outcome<&'a mut [MaybeUninit<T>]> {
    let count = if values.is_null() { 0 } else { count };
    // SAFETY: as that of this function.
    unsafe { arrays::room(argument, values, count) }
}

/// Fills an array with a property of each body.
fn fill<T>(values: &mut [MaybeUninit<T>], bodies: &[&Body], property: impl Fn(&Body) -> T) {
    values.iter_mut().zip(bodies).for_each(|(value, body)| {
        value.write(property(body));
    });
}

/// Reads `count` bodies into arrays of that length: positions in length units, rotations in radians, velocities in length units/s,
/// angular velocities in rad/s. An array that is not wanted is null. No array is written if one id is stale.
///
/// # Safety
/// An array that is not null has the items that its number says.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn farseer_bodies_read(
    simulator: Option<&FarseerSimulator>,
    bodies: *const FarseerBody,
    count: usize,
    positions: *mut FarseerVector2,
    rotations: *mut f32,
    linear_velocities: *mut FarseerVector2,
    angular_velocities: *mut f32,
) -> FarseerStatus {
    with(simulator, |world| {
        // SAFETY: the caller answers for the arrays.
        let numbers = unsafe { arrays::read("bodies", bodies, count) }?;
        let bodies = existing(&world.simulator, numbers)?;
        // SAFETY: the caller answers for the arrays.
        let positions = unsafe { optional("positions", positions, count) }?;
        // SAFETY: the caller answers for the arrays.
        let rotations = unsafe { optional("rotations", rotations, count) }?;
        // SAFETY: the caller answers for the arrays.
        let linear = unsafe { optional("linear_velocities", linear_velocities, count) }?;
        // SAFETY: the caller answers for the arrays.
        let angular = unsafe { optional("angular_velocities", angular_velocities, count) }?;
        fill(positions, &bodies, |body| body.position().into());
        fill(rotations, &bodies, Body::rotation);
        fill(linear, &bodies, |body| body.linear_velocity().into());
        fill(angular, &bodies, Body::angular_velocity);
        Ok(())
    })
}
