//! Narrow phase of the faithful set: contacts of two geoms (behaviour chapters 06 and 07).

mod grid_collide;
mod sat;
pub(crate) mod update_arbiter;

use crate::contacts::contact::Contact;
use crate::geom::entry::GeomEntry;
use crate::math::Vector2;
use crate::methods::NarrowPhaseCollider;

/// Appends the contacts of two geoms; `a` is the one with the smaller creation number.
#[inline]
pub(crate) fn collide(
    method: NarrowPhaseCollider,
    max_contacts_to_detect: i32,
    a: &GeomEntry,
    b: &GeomEntry,
    contacts: &mut Vec<Contact>,
) {
    match method {
        NarrowPhaseCollider::DistanceGrid => grid_collide::collide(a, b, max_contacts_to_detect, contacts),
        NarrowPhaseCollider::Sat => sat::collide(a, b, max_contacts_to_detect, contacts),
    }
}

/// Whether a point in the geom's own coordinates lies inside. With distance grids a geom without one has no inside; the
/// original fails there. A chain has no inside at all.
pub(crate) fn intersect(method: NarrowPhaseCollider, geom: &GeomEntry, local_point: Vector2) -> bool {
    match method {
        _ if geom.outline.is_chain() => false,
        NarrowPhaseCollider::DistanceGrid => {
            geom.grid.as_ref().is_some_and(|grid| grid.intersect(local_point).is_some())
        }
        NarrowPhaseCollider::Sat => sat::contains(&geom.local_vertices, local_point),
    }
}
