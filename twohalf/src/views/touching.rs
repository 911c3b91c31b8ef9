//! What touches, as this engine lists it, and what holds bodies up: with the precise set found in the engine below when somebody
//! asks.

use std::borrow::Cow;

use farseer_core::order::sort_by_number;
use farseer_core::{BodyId, PhysicsSimulator, SpacePartner, SpaceTouch};

use crate::Vector3;
use crate::depth::{
    DepthScheme, Kept, Partner, PlatformId, Support, Touch, TouchKey, TouchList, TouchPoint, World,
};
use crate::projection::to_world;

pub(crate) fn partner_of(partner: SpacePartner) -> Partner {
    match partner {
        SpacePartner::Ground => Partner::Ground,
        SpacePartner::Fixture(number) => Partner::Platform(PlatformId::from_number(number)),
        SpacePartner::Geom(geom) => Partner::Geom(geom),
    }
}

/// Whether two have pushed each other in this update, or are not apart at its end.
pub(super) fn is_touching(found: &SpaceTouch) -> bool {
    found.points[..found.count].iter().any(|point| point.impulse > 0.0 || point.separation <= APART)
}

/// Resting contacts are as near as that, px.
const APART: f32 = 0.01;

/// What touches, as this engine lists it, and its points.
pub(crate) fn touch_of(core: &PhysicsSimulator, found: &SpaceTouch) -> Option<(Touch, [TouchPoint; 2])> {
    let number = core.geom(found.this)?.id();
    let partner = partner_of(found.partner);
    let key = match partner {
        Partner::Ground => TouchKey::Ground(number),
        Partner::Platform(id) => TouchKey::Platform(number, id),
        Partner::Geom(other) => TouchKey::Pair(core.geom(other)?.id(), number),
    };
    let normal = Vector3::from(found.normal);
    let points = found.points.map(|point| TouchPoint {
        position: Vector3::new(point.position.x, point.position.y, found.z),
        normal,
        separation: point.separation,
        feature: point.feature,
        normal_impulse: point.impulse,
        friction_impulse: point.friction_impulse,
    });
    let touch = Touch {
        key,
        this: found.this,
        body: found.body,
        partner,
        partner_body: found.partner_body,
        normal,
        kept: Kept::Nothing,
        first_point: 0,
        point_count: found.count as u32,
        friction: found.friction,
        restitution: found.restitution,
        responds: found.responds,
        shares_pressure: false,
        arbiter: 0,
    };
    Some((touch, points))
}

/// The contacts of the last update, found in the engine below when somebody asks; what was loaded, until it moves on.
pub(crate) fn list_touches<'w>(core: &PhysicsSimulator, world: &'w World) -> Cow<'w, TouchList> {
    if !core.knows_touches() {
        return loaded_touches(core, world);
    }
    Cow::Owned(list(core, world, core.space_touches()))
}

/// Those of one body, if they are found when somebody asks.
pub(super) fn list_touches_of<'w>(
    core: &PhysicsSimulator,
    world: &'w World,
    body: BodyId,
) -> Cow<'w, TouchList> {
    if !core.knows_touches() {
        return loaded_touches(core, world);
    }
    Cow::Owned(list(core, world, core.space_touches_of(body)))
}

/// Those that were loaded, but for what has gone since.
fn loaded_touches<'w>(core: &PhysicsSimulator, world: &'w World) -> Cow<'w, TouchList> {
    let is_there = |touch: &Touch| world.may_touch(core, touch.this, touch.partner);
    if world.touches.touches.iter().all(is_there) {
        return Cow::Borrowed(&world.touches);
    }
    let mut list = TouchList::default();
    for touch in world.touches.touches.iter().filter(|touch| is_there(touch)) {
        let first_point = list.points.len() as u32;
        list.points.extend_from_slice(world.touches.points_of(touch));
        list.touches.push(Touch { first_point, ..*touch });
    }
    Cow::Owned(list)
}

fn list(core: &PhysicsSimulator, world: &World, found: impl Iterator<Item = SpaceTouch>) -> TouchList {
    let touches = found.filter(is_touching).filter_map(|found| touch_of(core, &found));
    let is_there = |(touch, _): &(Touch, _)| world.may_touch(core, touch.this, touch.partner);
    let mut touches: Vec<(Touch, [TouchPoint; 2])> = touches.filter(is_there).collect();
    // Points as well, so that what is left of a list is what would be listed without the others.
    sort_by_number(&mut touches, |(touch, _)| touch.key.rank());
    let mut list = TouchList::default();
    for (touch, points) in touches {
        let first_point = list.points.len() as u32;
        list.points.extend_from_slice(&points[..touch.point_count as usize]);
        list.touches.push(Touch { first_point, ..touch });
    }
    list
}

/// What holds a body up best. Allocates nothing.
pub(super) fn support_of(core: &PhysicsSimulator, world: &World, body: BodyId) -> Option<Support> {
    if world.scheme != DepthScheme::Precise {
        return world.depths.bodies.get(body)?.support;
    }
    let mut best = None;
    if core.knows_touches() {
        let touches = core.space_touches_of(body).filter(is_touching);
        touches.for_each(|found| {
            if let Some((touch, _)) = touch_of(core, &found) {
                hold_up(core, world, body, &touch, &mut best);
            }
        });
    } else {
        world.touches.touches.iter().for_each(|touch| hold_up(core, world, body, touch, &mut best));
    }
    best.map(|(support, _)| support)
}

/// A touch that pushes a body up more than the best one so far; of equal ones the first in the order of their names counts.
fn hold_up(
    core: &PhysicsSimulator,
    world: &World,
    body: BodyId,
    touch: &Touch,
    best: &mut Option<(Support, TouchKey)>,
) {
    let normal = to_world(touch.normal);
    let found = match touch.partner {
        partner if touch.body == body => Support { partner, normal },
        Partner::Geom(_) if touch.partner_body == Some(body) => {
            Support { partner: Partner::Geom(touch.this), normal: -normal }
        }
        _ => return,
    };
    let is_better = match *best {
        Some((best, key)) => (found.normal.y, key) > (best.normal.y, touch.key),
        None => found.normal.y > 0.0,
    };
    if touch.responds && is_better && world.may_touch(core, touch.this, touch.partner) {
        *best = Some((found, touch.key));
    }
}
