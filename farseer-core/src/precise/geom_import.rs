//! Adapter: reads the properties of geoms that proxies hold.

use crate::geom::Geom;
use crate::geom::entry::GeomEntry;
use crate::geom::filter::CollisionFilter;

/// Returns the collision filter of a geom in the form of [`Proxy::filter`](super::broad_phase::proxies::Proxy::filter).
pub(super) fn geom_filter(entry: &GeomEntry) -> [i32; 5] {
    let geom = &entry.geom;
    let (categories, collides_with) = (geom.collision_categories().bits(), geom.collides_with().bits());
    [
        categories,
        collides_with,
        geom.collision_group(),
        i32::from(geom.collision_enabled()),
        entry.ignore_changes,
    ]
}

/// Returns the collision filter of a world box in the form of [`Proxy::filter`](super::broad_phase::proxies::Proxy::filter).
pub(super) fn world_box_filter(filter: &CollisionFilter) -> [i32; 5] {
    let CollisionFilter { categories, collides_with, group, is_enabled, .. } = filter;
    [categories.bits(), collides_with.bits(), *group, i32::from(*is_enabled), 0]
}

/// Returns the friction and the restitution coefficient of a geom, dimensionless.
pub(super) fn surface_coefficients(geom: &Geom) -> [f32; 2] {
    [geom.friction_coefficient(), geom.restitution_coefficient()].map(without_negative_zero)
}

/// Returns `value`, with +0 in place of -0. Imports copy only values that compare unequal, so both zeros must have the same
/// bits.
pub(super) fn without_negative_zero(value: f32) -> f32 {
    value + 0.0
}
