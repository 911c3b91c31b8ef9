//! Owners of proxies: geoms, world boxes and the ground. A proxy stores its owner as a number.
//!
//! The number has a slot in its lower 32 bits. Geoms have the lower half of the slots; the ground and the world boxes have the
//! upper end. The upper 32 bits tell apart geoms that use one slot after another; the solver does not read them.

use super::interface::WorldBox;

/// Slot of the ground, a number without a unit. World boxes have the slots below it; geoms have the lower half of the range of `u32`.
const GROUND_SLOT: u32 = u32::MAX - 1;
/// Slot of the world box with id 0, a number without a unit. The box with id n has the slot n below.
const FIRST_WORLD_BOX_SLOT: u32 = u32::MAX - 2;
/// Creation number of the ground, the greatest one. World boxes have the numbers below it, so that geoms come before boxes and
/// ground wherever creation numbers order pairs.
const LAST_CREATION_NUMBER: u32 = u32::MAX;

/// Owner of a proxy.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ShapeOwner {
    /// A geom, with this slot.
    Geom(usize),
    /// The world box with this id.
    WorldBox(u32),
    /// The ground, whose top is the plane y = 0.
    Ground,
}

/// Returns the numbers of the ground's proxy: its [owner](crate::broad_phase::proxies::Proxy::owner) and its
/// creation number.
pub(crate) fn ground_numbers() -> (u64, u32) {
    numbers_of(GROUND_SLOT)
}

/// Returns the numbers of a world box's proxy: its [owner](crate::broad_phase::proxies::Proxy::owner) and its
/// creation number.
pub(crate) fn world_box_numbers(world_box: &WorldBox) -> (u64, u32) {
    numbers_of(FIRST_WORLD_BOX_SLOT - world_box.id)
}

/// Returns owner and creation number of the proxy of a world box or the ground.
fn numbers_of(slot: u32) -> (u64, u32) {
    (u64::from(slot), LAST_CREATION_NUMBER - (GROUND_SLOT - slot))
}

/// Returns the id of the world box with this slot; `None` for a slot of a geom or of the ground.
pub fn world_box_at(slot: u32) -> Option<u32> {
    (!is_geom(slot) && slot <= FIRST_WORLD_BOX_SLOT).then(|| FIRST_WORLD_BOX_SLOT - slot)
}

/// Returns whether a slot belongs to a geom, and not to a world box or the ground.
pub fn is_geom(slot: u32) -> bool {
    slot <= u32::MAX / 2
}

/// Returns the owner that a number stands for.
pub fn owner_of(number: u64) -> ShapeOwner {
    match number as u32 {
        GROUND_SLOT => ShapeOwner::Ground,
        slot => world_box_at(slot).map_or(ShapeOwner::Geom(slot as usize), ShapeOwner::WorldBox),
    }
}
