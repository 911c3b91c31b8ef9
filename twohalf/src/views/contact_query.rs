//! Contacts and supports of bodies. With the precise set they are queried from the core on demand.

use std::borrow::Cow;

use farseer_core::depth::{DepthAxis, DepthContact, DepthContactTarget};
use farseer_core::{BodyId, PhysicsSimulator};
use farseer_precise::storage::order::sort_by_number;

use crate::Vector3;
use crate::depth::{
    Contact, ContactKey, ContactList, ContactPoint, ContactTarget, DepthScheme, PersistedFeature, PlatformId,
    Support, World,
};
use crate::projection::to_world;

pub(crate) fn partner_of(partner: DepthContactTarget) -> ContactTarget {
    match partner {
        DepthContactTarget::Ground => ContactTarget::Ground,
        DepthContactTarget::WorldBox(number) => ContactTarget::Platform(PlatformId::from_number(number)),
        DepthContactTarget::Geom(geom) => ContactTarget::Geom(geom),
    }
}

/// Returns whether the two sides of a contact exerted an impulse in this update, or touch at its end.
pub(super) fn is_touching(found: &DepthContact) -> bool {
    found.points[..found.count].iter().any(|point| point.impulse > 0.0 || point.separation <= TOUCH_DISTANCE)
}

/// Greatest separation of touching sides, px; resting contacts are nearer.
const TOUCH_DISTANCE: f32 = 0.01;

/// Returns a contact of the precise set as a contact of `twohalf`, with its points; `None` if a geom of the contact does not
/// exist any more.
pub(crate) fn contact_of(
    core: &PhysicsSimulator,
    found: &DepthContact,
) -> Option<(Contact, [ContactPoint; 2])> {
    let number = core.geom(found.this)?.id();
    let partner = partner_of(found.target);
    let key = match partner {
        ContactTarget::Ground => ContactKey::Ground(number),
        ContactTarget::Platform(id) => ContactKey::Platform(number, id),
        ContactTarget::Geom(other) => ContactKey::Pair(core.geom(other)?.id(), number),
    };
    let normal = Vector3::from(found.normal);
    let points = found.points.map(|point| ContactPoint {
        position: Vector3::new(point.position.x, point.position.y, found.z),
        normal,
        separation: point.separation,
        feature: point.feature,
        normal_impulse: point.impulse,
        friction_impulse: point.friction_impulse,
    });
    let touch = Contact {
        key,
        this: found.this,
        body: found.body,
        partner,
        partner_body: found.target_body,
        normal,
        kept: PersistedFeature::Nothing,
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

/// Returns the contacts of the last update, queried from the core; before the first update after loading those of the save.
pub(crate) fn list_contacts<'w>(core: &PhysicsSimulator, world: &'w World) -> Cow<'w, ContactList> {
    if !DepthAxis::of(core).contacts_are_valid() {
        return loaded_contacts(core, world);
    }
    Cow::Owned(list(core, world, DepthAxis::of(core).contacts()))
}

/// Returns the contacts of one body, if contacts are queried from the core; else all stored contacts.
pub(super) fn list_contacts_of<'w>(
    core: &PhysicsSimulator,
    world: &'w World,
    body: BodyId,
) -> Cow<'w, ContactList> {
    if !DepthAxis::of(core).contacts_are_valid() {
        return loaded_contacts(core, world);
    }
    Cow::Owned(list(core, world, DepthAxis::of(core).contacts_of(body)))
}

/// Returns the stored contacts whose sides still take part in the simulation.
fn loaded_contacts<'w>(core: &PhysicsSimulator, world: &'w World) -> Cow<'w, ContactList> {
    let is_there = |touch: &Contact| world.may_touch(core, touch.this, touch.partner);
    if world.touches.touches.iter().all(is_there) {
        return Cow::Borrowed(&world.touches);
    }
    let mut list = ContactList::default();
    for touch in world.touches.touches.iter().filter(|touch| is_there(touch)) {
        let first_point = list.points.len() as u32;
        list.points.extend_from_slice(world.touches.points_of(touch));
        list.touches.push(Contact { first_point, ..*touch });
    }
    Cow::Owned(list)
}

fn list(core: &PhysicsSimulator, world: &World, found: impl Iterator<Item = DepthContact>) -> ContactList {
    let touches = found.filter(is_touching).filter_map(|found| contact_of(core, &found));
    let is_there = |(touch, _): &(Contact, _)| world.may_touch(core, touch.this, touch.partner);
    let mut touches: Vec<(Contact, [ContactPoint; 2])> = touches.filter(is_there).collect();
    // The points are sorted as well, so that a list without some contacts equals the remaining part of the
    // full list.
    sort_by_number(&mut touches, |(touch, _)| touch.key.rank());
    let mut list = ContactList::default();
    for (touch, points) in touches {
        let first_point = list.points.len() as u32;
        list.points.extend_from_slice(&points[..touch.point_count as usize]);
        list.touches.push(Contact { first_point, ..touch });
    }
    list
}

/// Returns the best support of a body, without allocation; `None` in the air.
pub(super) fn support_of(core: &PhysicsSimulator, world: &World, body: BodyId) -> Option<Support> {
    if world.scheme != DepthScheme::Precise {
        return world.depths.bodies.get(body)?.support;
    }
    let mut best = None;
    if DepthAxis::of(core).contacts_are_valid() {
        let touches = DepthAxis::of(core).contacts_of(body).filter(is_touching);
        touches.for_each(|found| {
            if let Some((touch, _)) = contact_of(core, &found) {
                improve_support(core, world, body, &touch, &mut best);
            }
        });
    } else {
        world.touches.touches.iter().for_each(|touch| improve_support(core, world, body, touch, &mut best));
    }
    best.map(|(support, _)| support)
}

/// Replaces the best support by a contact with a more upward normal; of equal ones the first by key wins.
fn improve_support(
    core: &PhysicsSimulator,
    world: &World,
    body: BodyId,
    touch: &Contact,
    best: &mut Option<(Support, ContactKey)>,
) {
    let normal = to_world(touch.normal);
    let found = match touch.partner {
        partner if touch.body == body => Support { partner, normal },
        ContactTarget::Geom(_) if touch.partner_body == Some(body) => {
            Support { partner: ContactTarget::Geom(touch.this), normal: -normal }
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
