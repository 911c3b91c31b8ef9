//! Supports of bodies, from the contacts of an update.

use farseer_core::{BodyId, GeomId, PhysicsSimulator};

use crate::Vector3;
use crate::depth::{ContactList, ContactTarget, DepthScheme, DepthState, Support, World};
use crate::projection::to_world;

/// A body with its support in the last update.
pub(super) type SupportCandidate = (BodyId, Support);

/// Stores the best support of every body. `last` is a buffer for the supports of the last update.
pub(super) fn find(
    core: &PhysicsSimulator,
    world: &mut World,
    found: &ContactList,
    last: &mut Vec<SupportCandidate>,
    dt: f32,
) {
    let depths = &mut world.depths;
    last.clear();
    for &body in core.body_list() {
        if let Some(state) = depths.bodies.get_mut(body)
            && let Some(support) = state.support.take()
            && !std::mem::take(&mut state.is_support_kept)
        {
            last.push((body, support));
        }
    }
    for contact in core.arbiters() {
        let (a, b) = (contact.geom_a(), contact.geom_b());
        let Some(normal) = contact.contacts().next().map(|contact| contact.normal) else { continue };
        let upward = Vector3::new(normal.x, -normal.y, 0.0);
        record_support(core, depths, b, ContactTarget::Geom(a), upward);
        record_support(core, depths, a, ContactTarget::Geom(b), -upward);
    }
    for touch in found.touches.iter().filter(|touch| !touch.is_plane() && touch.responds) {
        let normal = to_world(touch.normal);
        record_support(core, depths, touch.this, touch.partner, normal);
        if let ContactTarget::Geom(other) = touch.partner {
            record_support(core, depths, other, ContactTarget::Geom(touch.this), -normal);
        }
    }
    keep_recent_support(core, world, last, dt);
}

fn record_support(
    core: &PhysicsSimulator,
    depths: &mut DepthState,
    geom: GeomId,
    partner: ContactTarget,
    normal: Vector3,
) {
    let responds = |geom: GeomId| core.geom(geom).is_some_and(|geom| geom.collision_response_enabled());
    if normal.y <= 0.0 || !responds(geom) || matches!(partner, ContactTarget::Geom(other) if !responds(other))
    {
        return;
    }
    let body = core.geom(geom).map(|geom| geom.body());
    let Some(state) = body.and_then(|body| depths.bodies.get_mut(body)) else { return };
    if state.support.is_none_or(|best: Support| best.normal.y < normal.y) {
        state.support = Some(Support { partner, normal });
    }
}

/// Keeps the support of a resting body that separates from it for a single step, no faster than gravity accelerates in two
/// steps.
fn keep_recent_support(core: &PhysicsSimulator, world: &mut World, last: &[SupportCandidate], dt: f32) {
    let slow = 2.0 * core.gravity().y.abs() * dt.abs();
    for &(id, support) in last {
        let is_slow = core.body(id).is_some_and(|body| {
            !body.ignore_gravity() && body.linear_velocity().y.abs() <= slow * body.gravity_scale().abs()
        });
        let is_there = world.exists(core, support.partner);
        let Some(state) = world.depths.bodies.get_mut(id).filter(|state| state.support.is_none()) else {
            continue;
        };
        if is_there && is_slow {
            (state.support, state.is_support_kept) = (Some(support), true);
        }
    }
}

/// Drops stored contacts and supports of removed objects. Contacts that queries take from the core are filtered in the query.
pub(super) fn remove_stale_contacts(core: &PhysicsSimulator, world: &mut World) {
    if world.scheme != DepthScheme::Precise {
        let mut touches = std::mem::take(&mut world.touches.touches);
        touches.retain(|touch| core.geom(touch.this).is_some() && world.exists(core, touch.partner));
        world.touches.touches = touches;
    }
    for &body in core.body_list() {
        let support = world.depths.bodies.get(body).and_then(|state| state.support);
        if support.is_some_and(|support| !world.exists(core, support.partner)) {
            world.depths.bodies[body].support = None;
        }
    }
}
