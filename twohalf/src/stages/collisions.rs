//! Conversion of contacts to collisions as games see them.

use farseer_core::depth::DepthContact;
use farseer_core::math::scalar::nearest_finite;
use farseer_core::{GeomId, PhysicsSimulator};

use crate::depth::{Contact, ContactPoint, ContactTarget};
use crate::events::Collision;
use crate::projection::to_world;
use crate::views::contact_of;

/// Returns whether a geom has collision callbacks.
pub(super) fn has_callbacks(core: &PhysicsSimulator, geom: GeomId) -> bool {
    core.geom(geom).is_none_or(|geom| geom.collision_callbacks_enabled())
}

pub(super) fn impulse_of_points(points: &[ContactPoint]) -> f32 {
    nearest_finite(points.iter().map(|point| point.normal_impulse).sum())
}

/// Returns a contact that `twohalf` found as a collision of one of its geoms: of the other side if `is_partner`. `None` if that
/// side is no geom or the contact has no points.
pub(super) fn collision(touch: &Contact, points: &[ContactPoint], is_partner: bool) -> Option<Collision> {
    let deepest = points.iter().min_by(|a, b| a.separation.total_cmp(&b.separation))?;
    let (this, partner, sign) = match (is_partner, touch.partner) {
        (false, partner) => (touch.this, partner, 1.0),
        (true, ContactTarget::Geom(other)) => (other, ContactTarget::Geom(touch.this), -1.0),
        (true, _) => return None,
    };
    Some(Collision {
        this,
        partner,
        axis: touch.axis(),
        normal: to_world(touch.normal) * sign,
        position: to_world(deepest.position),
        contacts: touch.point_count,
        normal_impulse: impulse_of_points(points),
        vetoed: false,
    })
}

/// Returns a contact of the precise set as collisions of both sides, the older geom first. `None` for a side that is no geom or
/// does not exist any more.
pub(super) fn collisions(core: &PhysicsSimulator, found: &DepthContact) -> [Option<Collision>; 2] {
    let Some((touch, points)) = contact_of(core, found) else { return [None; 2] };
    [true, false].map(|is_partner| collision(&touch, &points[..found.count], is_partner))
}
