//! Snapshots and hashes.

use std::mem::MaybeUninit;

use crate::arrays::{self, write_list};
use crate::failure::FarseerStatus;
use crate::guard::{FarseerSimulator, with, write};

/// Writes a hash of the complete state. Equal states have equal hashes, on every platform.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_simulator_state_hash(
    simulator: Option<&FarseerSimulator>,
    hash: Option<&mut MaybeUninit<u64>>,
) -> FarseerStatus {
    write(simulator, "hash", hash, |world| Ok(world.simulator.state_hash()))
}

/// Takes a snapshot of the simulator without its largest speed and hit speed, keeps it until the next one, and writes its length in bytes.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_simulator_take_snapshot(
    simulator: Option<&FarseerSimulator>,
    length: Option<&mut MaybeUninit<usize>>,
) -> FarseerStatus {
    write(simulator, "length", length, |world| {
        world.snapshot = world.simulator.snapshot();
        Ok(world.snapshot.len())
    })
}

/// Copies the snapshot that was taken last, and writes its length in bytes.
///
/// # Safety
/// An array that is not null has the items that its number says.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn farseer_simulator_copy_snapshot(
    simulator: Option<&FarseerSimulator>,
    bytes: *mut u8,
    capacity: usize,
    length: Option<&mut MaybeUninit<usize>>,
) -> FarseerStatus {
    // SAFETY: the caller answers for the array.
    let room = unsafe { arrays::room("bytes", bytes, capacity) };
    write_list(simulator, room, length, |world| Ok(world.snapshot.clone()))
}

/// Replaces the simulator by that of a snapshot of `length` bytes. It continues with the same bits, and ids of that time name the same
/// objects. Forget ids that were made since.
///
/// # Safety
/// An array that is not null has the items that its number says.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn farseer_simulator_restore(
    simulator: Option<&FarseerSimulator>,
    bytes: *const u8,
    length: usize,
) -> FarseerStatus {
    with(simulator, |world| {
        // SAFETY: the caller answers for the array.
        let bytes = unsafe { arrays::read("bytes", bytes, length) }?;
        Ok(world.simulator.restore(bytes)?)
    })
}
