//! Arrays of the caller: the only memory that is read and written by address and length.

use std::mem::MaybeUninit;
use std::slice;

use crate::failure::{Failure, FarseerStatus, Outcome};
use crate::guard::{FarseerSimulator, World, with};

/// Refuses an array that no slice can be. `count`: number of items.
fn check<T>(argument: &str, pointer: *const T, count: usize) -> Outcome {
    if pointer.is_null() {
        return Err(Failure::null(argument));
    }
    if !pointer.is_aligned() {
        return Err(Failure::invalid(argument, format_args!("at {pointer:p}"), "aligned"));
    }
    let most = isize::MAX as usize / size_of::<T>();
    if count > most {
        return Err(Failure::invalid("count", count, "a number of items that memory has room for"));
    }
    Ok(())
}

/// The caller's array to read. Null is an empty array if `count`, the number of items, is 0.
///
/// # Safety
/// Unless null, `pointer` points to `count` initialised items that nobody writes during `'a`.
pub(crate) unsafe fn read<'a, T>(argument: &str, pointer: *const T, count: usize) -> Outcome<&'a [T]> {
    if count == 0 {
        return Ok(&[]);
    }
    check(argument, pointer, count)?;
    // SAFETY: the pointer is not null, aligned, and its length fits; the caller answers for the items.
    Ok(unsafe { slice::from_raw_parts(pointer, count) })
}

/// The caller's array to write. Null is an empty array if `count`, the number of items, is 0.
///
/// # Safety
/// Unless null, `pointer` points to room for `count` items that nobody else reads or writes during `'a`.
pub(crate) unsafe fn room<'a, T>(
    argument: &str,
    pointer: *mut T,
    count: usize,
) -> Outcome<&'a mut [MaybeUninit<T>]> {
    if count == 0 {
        return Ok(&mut []);
    }
    check(argument, pointer, count)?;
    // SAFETY: the pointer is not null, aligned, and its length fits; `MaybeUninit` needs no initialised items; the caller answers for
    // the room.
    Ok(unsafe { slice::from_raw_parts_mut(pointer.cast(), count) })
}

/// A call with a list as its result. It writes the number of all items to `count` and the first items, as many as there is
/// room for, to `room`. An array without room asks for the number alone.
pub(crate) fn write_list<T>(
    simulator: Option<&FarseerSimulator>,
    room: Outcome<&mut [MaybeUninit<T>]>,
    count: Option<&mut MaybeUninit<usize>>,
    look: impl FnOnce(&mut World) -> Outcome<Vec<T>>,
) -> FarseerStatus {
    with(simulator, |world| {
        let room = room?;
        let count = count.ok_or_else(|| Failure::null("count"))?;
        let items = look(world)?;
        let all = items.len();
        count.write(all);
        let capacity = room.len();
        room.iter_mut().zip(items).for_each(|(place, item)| {
            place.write(item);
        });
        if capacity > 0 && capacity < all {
            let message = format!("capacity is {capacity}, but there are {all} items");
            return Err(Failure::new(FarseerStatus::BufferTooSmall, message));
        }
        Ok(())
    })
}
