//! What holds bodies up.

use farseer_core::{BodyId, GeomId, PhysicsSimulator};

use crate::Vector3;
use crate::depth::{DepthScheme, Depths, Partner, Support, TouchList, World};
use crate::projection::to_world;

/// What held a body up in the last update.
pub(super) type Held = (BodyId, Support);

/// Notes for every body what holds it up best. `last` is room for what did in the update before.
pub(super) fn find(
    core: &PhysicsSimulator,
    world: &mut World,
    found: &TouchList,
    last: &mut Vec<Held>,
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
        note(core, depths, b, Partner::Geom(a), upward);
        note(core, depths, a, Partner::Geom(b), -upward);
    }
    for touch in found.touches.iter().filter(|touch| !touch.is_plane() && touch.responds) {
        let normal = to_world(touch.normal);
        note(core, depths, touch.this, touch.partner, normal);
        if let Partner::Geom(other) = touch.partner {
            note(core, depths, other, Partner::Geom(touch.this), -normal);
        }
    }
    keep(core, world, last, dt);
}

fn note(core: &PhysicsSimulator, depths: &mut Depths, geom: GeomId, partner: Partner, normal: Vector3) {
    let responds = |geom: GeomId| core.geom(geom).is_some_and(|geom| geom.collision_response_enabled());
    if normal.y <= 0.0 || !responds(geom) || matches!(partner, Partner::Geom(other) if !responds(other)) {
        return;
    }
    let body = core.geom(geom).map(|geom| geom.body());
    let Some(state) = body.and_then(|body| depths.bodies.get_mut(body)) else { return };
    if state.support.is_none_or(|best: Support| best.normal.y < normal.y) {
        state.support = Some(Support { partner, normal });
    }
}

/// What lies on something may leave it for a single step, no faster than gravity makes it in two, before it
/// lies on it again. For that step it still counts as held up.
fn keep(core: &PhysicsSimulator, world: &mut World, last: &[Held], dt: f32) {
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

/// Forgets contacts and supports of what has left. Of contacts that are listed when somebody asks, what has left is not
/// listed, whether they were loaded or not.
pub(super) fn forget_what_left(core: &PhysicsSimulator, world: &mut World) {
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
