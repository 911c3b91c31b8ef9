//! Contacts as games are told of them.

use farseer_core::math::scalar::nearest_finite;
use farseer_core::{GeomId, PhysicsSimulator, SpaceTouch};

use crate::depth::{Partner, Touch, TouchPoint};
use crate::events::Collision;
use crate::projection::to_world;
use crate::views::touch_of;

/// Whether a handler is told of what a geom touches.
pub(super) fn is_told(core: &PhysicsSimulator, geom: GeomId) -> bool {
    core.geom(geom).is_none_or(|geom| geom.collision_callbacks_enabled())
}

pub(super) fn impulse_of_points(points: &[TouchPoint]) -> f32 {
    nearest_finite(points.iter().map(|point| point.normal_impulse).sum())
}

/// A contact of this engine, seen by one of its geoms.
pub(super) fn collision(touch: &Touch, points: &[TouchPoint], is_partner: bool) -> Option<Collision> {
    let deepest = points.iter().min_by(|a, b| a.separation.total_cmp(&b.separation))?;
    let (this, partner, sign) = match (is_partner, touch.partner) {
        (false, partner) => (touch.this, partner, 1.0),
        (true, Partner::Geom(other)) => (other, Partner::Geom(touch.this), -1.0),
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

/// A contact, as both of its sides are told of it: the older geom first.
pub(super) fn collisions(core: &PhysicsSimulator, found: &SpaceTouch) -> [Option<Collision>; 2] {
    let Some((touch, points)) = touch_of(core, found) else { return [None; 2] };
    [true, false].map(|is_partner| collision(&touch, &points[..found.count], is_partner))
}
