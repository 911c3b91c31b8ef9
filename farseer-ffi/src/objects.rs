//! Life of objects of all kinds, and lists of them.

use std::mem::MaybeUninit;

use farseer_core::{BodyId, PhysicsSimulator};

use crate::arrays::{self, write_list};
use crate::failure::{Failure, FarseerStatus, Outcome};
use crate::guard::{FarseerSimulator, with, write};
use crate::ids::{FarseerBody, FarseerGeom, FarseerId, FarseerJoint, FarseerSpring, Id, object};

/// The numbers of ids.
fn numbers<I: Id>(ids: &[I]) -> Outcome<Vec<FarseerId>> {
    ids.iter().map(|id| id.to_number()).collect()
}

/// The list of objects of a kind.
fn list_of<I: Id>(
    simulator: Option<&FarseerSimulator>,
    room: Outcome<&mut [MaybeUninit<FarseerId>]>,
    count: Option<&mut MaybeUninit<usize>>,
    ids: impl FnOnce(&PhysicsSimulator) -> &[I],
) -> FarseerStatus {
    write_list(simulator, room, count, |world| numbers(ids(&world.simulator)))
}

/// Disposes a body, geom, joint or spring: with the next update it leaves, and its id goes stale. The geoms of a body go with it,
/// and the joints and springs between it and other bodies.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_object_dispose(
    simulator: Option<&FarseerSimulator>,
    number: FarseerId,
) -> FarseerStatus {
    with(simulator, |world| Ok(world.simulator.dispose(object("object", number)?)?))
}

/// Takes an object out of the simulation with the next update, without disposing it.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_object_remove(
    simulator: Option<&FarseerSimulator>,
    number: FarseerId,
) -> FarseerStatus {
    with(simulator, |world| Ok(world.simulator.remove(object("object", number)?)?))
}

/// Adds an object that was removed, with the next update.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_object_add(
    simulator: Option<&FarseerSimulator>,
    number: FarseerId,
) -> FarseerStatus {
    with(simulator, |world| Ok(world.simulator.add(object("object", number)?)?))
}

/// Writes whether an object was disposed: 0 or 1; 1 for every stale id.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_object_is_disposed(
    simulator: Option<&FarseerSimulator>,
    number: FarseerId,
    is_disposed: Option<&mut MaybeUninit<i32>>,
) -> FarseerStatus {
    write(simulator, "is_disposed", is_disposed, |world| {
        Ok(world.simulator.is_disposed(object("object", number)?).into())
    })
}

/// Writes the ids of the bodies that take part, in the order of their list, and their number. Objects enter with the next update.
///
/// # Safety
/// An array that is not null has the items that its number says.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn farseer_simulator_bodies(
    simulator: Option<&FarseerSimulator>,
    bodies: *mut FarseerBody,
    capacity: usize,
    count: Option<&mut MaybeUninit<usize>>,
) -> FarseerStatus {
    // SAFETY: the caller answers for the array.
    let room = unsafe { arrays::room("bodies", bodies, capacity) };
    list_of(simulator, room, count, |simulator| simulator.body_list())
}

/// Writes the ids of the geoms that take part, in the order of their list, and their number. Objects enter with the next update.
///
/// # Safety
/// An array that is not null has the items that its number says.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn farseer_simulator_geoms(
    simulator: Option<&FarseerSimulator>,
    geoms: *mut FarseerGeom,
    capacity: usize,
    count: Option<&mut MaybeUninit<usize>>,
) -> FarseerStatus {
    // SAFETY: the caller answers for the array.
    let room = unsafe { arrays::room("geoms", geoms, capacity) };
    list_of(simulator, room, count, |simulator| simulator.geom_list())
}

/// Writes the ids of the joints that take part, in the order of their list, and their number. Objects enter with the next update.
///
/// # Safety
/// An array that is not null has the items that its number says.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn farseer_simulator_joints(
    simulator: Option<&FarseerSimulator>,
    joints: *mut FarseerJoint,
    capacity: usize,
    count: Option<&mut MaybeUninit<usize>>,
) -> FarseerStatus {
    // SAFETY: the caller answers for the array.
    let room = unsafe { arrays::room("joints", joints, capacity) };
    list_of(simulator, room, count, |simulator| simulator.joint_list())
}

/// Writes the ids of the springs that take part, in the order of their list, and their number. Objects enter with the next update.
///
/// # Safety
/// An array that is not null has the items that its number says.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn farseer_simulator_springs(
    simulator: Option<&FarseerSimulator>,
    springs: *mut FarseerSpring,
    capacity: usize,
    count: Option<&mut MaybeUninit<usize>>,
) -> FarseerStatus {
    // SAFETY: the caller answers for the array.
    let room = unsafe { arrays::room("springs", springs, capacity) };
    list_of(simulator, room, count, |simulator| simulator.spring_list())
}

/// Writes the ids of the geoms of a body, and their number.
///
/// # Safety
/// An array that is not null has the items that its number says.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn farseer_body_geoms(
    simulator: Option<&FarseerSimulator>,
    body: FarseerBody,
    geoms: *mut FarseerGeom,
    capacity: usize,
    count: Option<&mut MaybeUninit<usize>>,
) -> FarseerStatus {
    // SAFETY: the caller answers for the array.
    let room = unsafe { arrays::room("geoms", geoms, capacity) };
    write_list(simulator, room, count, |world| {
        let id = BodyId::from_number("body", body)?;
        world.simulator.body(id).ok_or_else(|| Failure::stale("body"))?;
        numbers(world.simulator.geoms_of(id))
    })
}
