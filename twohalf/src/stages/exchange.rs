//! What the precise set is told of depth before a step, and what is taken over after it.

use farseer_core::{BodyId, GeomId, PhysicsSimulator, SpaceBody, SpaceProfile, Swings};

use super::forces::disable;
use super::report::Report;
use crate::Vector3;
use crate::depth::{Depths, PlatformId, World, is_movable};
use crate::events::Event;

/// An update begins: forces that have not acted in the last one are told again.
pub(super) fn note_forced(depths: &mut Depths) {
    let mut forced = std::mem::take(&mut depths.forced);
    for id in forced.drain(..) {
        if depths.bodies.get(id).is_some_and(|state| state.force_z != 0.0) {
            depths.edit(id);
        }
    }
    depths.forced = forced;
}

/// Lists what was loaded, so that who asks before the next update is told what touches and what is near. Nothing acts yet, and that
/// update tells all again.
pub(crate) fn list_loaded(core: &mut PhysicsSimulator, world: &World) {
    if !core.is_in_space() {
        return;
    }
    let bodies: Vec<BodyId> = core.bodies().collect();
    for id in bodies {
        let (Some(body), Some(state)) = (core.body(id), world.depths.bodies.get(id)) else { continue };
        let told = state.told(state.velocity_z, 0.0, body.is_kinematic());
        core.set_space_body(id, told);
        for at in 0..core.geoms_of(id).len() {
            tell_profile(core, &world.depths, core.geoms_of(id)[at]);
        }
    }
    core.set_fixtures(world.platforms.iter().map(|(id, platform)| platform.fixture(id)));
    core.list_loaded_in_space();
}

/// The 2D engine is told what has become otherwise along Z: all of it, if it knows nothing yet.
pub(super) fn tell_depths(core: &mut PhysicsSimulator, world: &mut World, report: &mut Report) {
    let World { depths, platforms, .. } = world;
    if !std::mem::replace(&mut depths.is_told, true) {
        core.bodies().for_each(|id| _ = depths.edit(id));
    }
    let mut waiting = std::mem::take(&mut depths.waiting);
    waiting.retain(|&id| {
        let can_move = is_movable(core, id);
        if can_move {
            depths.edit(id);
        }
        !can_move && core.body(id).is_some()
    });
    depths.waiting = waiting;
    let mut news = std::mem::take(&mut depths.news);
    for id in news.drain(..) {
        tell_body(core, depths, report, id);
        for at in 0..core.geoms_of(id).len() {
            tell_profile(core, depths, core.geoms_of(id)[at]);
        }
    }
    depths.news = news;
    if platforms.take_changed() {
        let fixtures = platforms.iter().map(|(id, platform)| platform.fixture(id));
        core.set_fixtures(fixtures);
    }
    for (id, motion) in platforms.edited_motions() {
        core.set_fixture_motion(id.number(), motion);
    }
}

fn tell_body(core: &mut PhysicsSimulator, depths: &mut Depths, report: &mut Report, id: BodyId) {
    let (Some(body), Some(state)) = (core.body(id), depths.bodies.get_mut(id)) else { return };
    state.is_news = false;
    let can_move = is_movable(core, id);
    let inverse_mass = if can_move { body.inverse_mass() } else { 0.0 };
    if state.force_z != 0.0 {
        if can_move {
            depths.forced.push(id);
        } else if !depths.waiting.contains(&id) {
            depths.waiting.push(id);
        }
    }
    // Nothing added to a negative zero would make it a positive one, and no force on a negative mass is a negative zero, which
    // a save must not do.
    let impulse = std::mem::take(&mut state.impulse_z);
    let velocity = if impulse == 0.0 { state.velocity_z } else { state.velocity_z + impulse * inverse_mass };
    let acceleration = if state.force_z == 0.0 { 0.0 } else { state.force_z * inverse_mass };
    if !(velocity.is_finite() && acceleration.is_finite()) {
        disable(core, id);
        report.events.push(Event::NotFinite { body: id, disabled: true });
        return;
    }
    state.velocity_z = velocity;
    let told = state.told(velocity, acceleration, body.is_kinematic());
    core.set_space_body(id, told);
}

fn tell_profile(core: &mut PhysicsSimulator, depths: &Depths, id: GeomId) {
    let (Some(view), Some(profile)) = (core.geom(id), depths.profiles.get(id)) else { return };
    let ground = depths.bodies.get(view.body()).map(|state| state.ground);
    let ground = ground.filter(|ground| ground.object_geom() == Some(id));
    let told = SpaceProfile {
        half_depth: profile.half_depth(),
        is_round: profile.is_round(),
        ground: ground.map(|ground| [ground.friction_coefficient(), ground.restitution_coefficient()]),
        upright: profile.upright(),
    };
    core.set_space_profile(id, told);
}

/// Takes over where bodies have come along Z, and platforms, before anybody is told that they moved.
pub(super) fn read_depths(core: &PhysicsSimulator, world: &mut World) {
    for (number, centre, yaw, motion) in core.fixtures_moved() {
        world.platforms.has_moved(PlatformId::from_number(number), centre, yaw, motion);
    }
    // `for_each` runs the iterators within this one as loops, a `for` does not.
    core.space_moved().for_each(|(id, told)| {
        let Some(state) = world.depths.bodies.get_mut(id) else { return };
        let SpaceBody { z, velocity, angular_velocity: [x, y], motion, sunk, target, .. } = told;
        (state.z, state.velocity_z, state.motion) = (z, velocity, Some(Vector3::from(motion)));
        (state.angular_velocity_x, state.angular_velocity_y) = (x, y);
        (state.sunk, state.target) = (sunk, target);
        // It has acted.
        state.force_z = 0.0;
    });
}

/// What has fallen asleep does not move, and what pushed it has acted.
pub(super) fn rest(core: &PhysicsSimulator, world: &mut World) {
    let World { depths, platforms, .. } = world;
    if Swings::ARE_THERE {
        for (number, .., motion) in core.fixtures_moved().filter(|(.., motion)| motion.swing().is_some()) {
            platforms.has_rested(PlatformId::from_number(number), motion);
        }
    }
    for (id, told) in core.space_rested() {
        let Some(state) = depths.bodies.get_mut(id).filter(|state| !state.is_news) else { continue };
        (state.z, state.velocity_z, state.sunk) = (told.z, 0.0, told.sunk);
        (state.angular_velocity_x, state.angular_velocity_y) = (0.0, 0.0);
        state.motion = Some(Vector3::zeros());
        state.force_z = 0.0;
    }
}
