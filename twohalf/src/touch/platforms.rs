//! Where objects touch platforms.

use farseer_core::{GeomId, GeomRef, PhysicsSimulator};

use super::list::Subject;
use super::{Kept, Manifold, Spot, Surfaces, TouchKey};
use crate::depth::{DepthProfile, is_movable};
use crate::shapes::{BoxManifold, SlantedBox, prism_box};
use crate::world::World;
use crate::{Partner, Platform, PlatformId, Vector3};

/// Finds the contacts of all objects with all platforms.
pub(super) fn touch_platforms(core: &PhysicsSimulator, world: &mut World) {
    if world.platforms.is_empty() {
        return;
    }
    world.platforms.sort();
    // Nothing below changes them.
    let platforms = std::mem::take(&mut world.platforms);
    for &geom in core.geom_list() {
        let Some(view) = core.geom(geom) else { continue };
        if !is_movable(core, view.body()) {
            continue;
        }
        let (aabb, reach) = (view.aabb(), world.reach(geom));
        let low = Vector3::new(aabb.min.x, aabb.min.y, reach.z - reach.half);
        let high = Vector3::new(aabb.max.x, aabb.max.y, reach.z + reach.half);
        for (id, platform) in platforms.overlapping(low, high) {
            if view.may_collide_with(platform.settings()) {
                world.counters.pairs_tested += 1;
                touch_platform(core, world, geom, view, id, platform);
            }
        }
    }
    world.platforms = platforms;
}

fn touch_platform(
    core: &PhysicsSimulator,
    world: &mut World,
    geom: GeomId,
    view: GeomRef<'_>,
    id: PlatformId,
    platform: &Platform,
) -> Option<()> {
    let key = TouchKey::Platform(view.id(), id);
    let kept = world.last.find(key).map(|touch| touch.kept);
    let manifold = match *world.depths.profiles.get(geom)? {
        DepthProfile::Round { radius } => of_ball(core, world, view, radius, platform.shape(), kept),
        _ => of_prism(core, world, geom, view, platform.shape(), kept),
    }?;
    let settings = platform.settings();
    let surfaces =
        Surfaces::combine(core, view, settings.friction_coefficient(), settings.restitution_coefficient())?;
    let subject = Subject {
        key,
        this: geom,
        body: view.body(),
        partner: Partner::Platform(id),
        partner_body: None,
        responds: view.collision_response_enabled() && settings.collision_response_enabled(),
    };
    world.touches.push(subject, &manifold, surfaces, &world.last);
    Some(())
}

fn of_ball(
    core: &PhysicsSimulator,
    world: &World,
    view: GeomRef<'_>,
    radius: f32,
    shape: &SlantedBox,
    kept: Option<Kept>,
) -> Option<Manifold> {
    let position = view.position();
    let centre = Vector3::new(position.x, position.y, world.z_of(view.body()));
    let before = centre - world.motion_of(core, view.body());
    let face = match kept {
        Some(Kept::Face(face)) => Some(face),
        _ => None,
    };
    let touch = shape.ball_touch(centre, before, radius, face)?;
    let kept = touch.face.map_or(Kept::Nothing, Kept::Face);
    Some(Manifold::of_point(touch.normal, touch.point, touch.separation, kept))
}

fn of_prism(
    core: &PhysicsSimulator,
    world: &mut World,
    geom: GeomId,
    view: GeomRef<'_>,
    shape: &SlantedBox,
    kept: Option<Kept>,
) -> Option<Manifold> {
    let motion = world.motion_of(core, view.body());
    let reach = world.reach(geom);
    world.pieces_of(core, geom)?;
    let crate::world::Update { pieces, scratch, .. } = &mut world.update;
    let pieces = pieces.get(geom)?;
    pieces.lay_out(&view.matrix(), &mut scratch.pieces_a);
    let BoxManifold { normal, points, count, kept, is_depth } = prism_box(
        shape,
        pieces.pieces(&scratch.pieces_a),
        reach.z,
        reach.half,
        motion,
        core.allowed_penetration(),
        kept.and_then(Kept::axis),
        &mut scratch.points,
    )?;
    let points = points.map(|point| Spot {
        position: point.position,
        separation: point.separation,
        feature: point.feature,
    });
    Some(Manifold { normal, points, count, kept: Kept::Axis(kept), shares_pressure: is_depth })
}
