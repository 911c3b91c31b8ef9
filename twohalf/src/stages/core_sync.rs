//! Synchronisation of depth with the precise set: input before a step, results after it.

use farseer_core::{BodyId, GeomId, PhysicsSimulator, SpaceBody, SpaceProfile, Swings};

use super::forces::disable;
use super::report::Report;
use crate::Vector3;
use crate::depth::{DepthState, PlatformId, World, is_movable};
use crate::events::Event;

/// Sends forces again that had no effect in the last update.
pub(super) fn requeue_forces(depths: &mut DepthState) {
    let mut forced = std::mem::take(&mut depths.forced);
    for id in forced.drain(..) {
        if depths.bodies.get(id).is_some_and(|state| state.force_z != 0.0) {
            depths.edit(id);
        }
    }
    depths.forced = forced;
}

/// Sends loaded state to the core, so that queries before the next update work. It has no other effect; that
/// update sends everything again.
pub(crate) fn list_loaded(core: &mut PhysicsSimulator, world: &World) {
    if !core.is_in_space() {
        return;
    }
    let bodies: Vec<BodyId> = core.bodies().collect();
    for id in bodies {
        let (Some(body), Some(state)) = (core.body(id), world.depths.bodies.get(id)) else { continue };
        let input = state.core_input(state.velocity_z, 0.0, body.is_kinematic());
        core.set_space_body(id, input);
        for at in 0..core.geoms_of(id).len() {
            push_profile_to_core(core, &world.depths, core.geoms_of(id)[at]);
        }
    }
    core.set_fixtures(world.platforms.iter().map(|(id, platform)| platform.fixture(id)));
    core.list_loaded_in_space();
}

/// Sends changes of depth to the core: all of it, if the core has none yet.
pub(super) fn push_depth_to_core(core: &mut PhysicsSimulator, world: &mut World, report: &mut Report) {
    let World { depths, platforms, .. } = world;
    if !std::mem::replace(&mut depths.is_sent, true) {
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
    let mut edited = std::mem::take(&mut depths.edited);
    for id in edited.drain(..) {
        push_body_to_core(core, depths, report, id);
        for at in 0..core.geoms_of(id).len() {
            push_profile_to_core(core, depths, core.geoms_of(id)[at]);
        }
    }
    depths.edited = edited;
    if platforms.take_changed() {
        let fixtures = platforms.iter().map(|(id, platform)| platform.fixture(id));
        core.set_fixtures(fixtures);
    }
    for (id, motion) in platforms.edited_motions() {
        core.set_fixture_motion(id.number(), motion);
    }
}

fn push_body_to_core(core: &mut PhysicsSimulator, depths: &mut DepthState, report: &mut Report, id: BodyId) {
    let (Some(body), Some(state)) = (core.body(id), depths.bodies.get_mut(id)) else { return };
    state.is_edited = false;
    let can_move = is_movable(core, id);
    let inverse_mass = if can_move { body.inverse_mass() } else { 0.0 };
    if state.force_z != 0.0 {
        if can_move {
            depths.forced.push(id);
        } else if !depths.waiting.contains(&id) {
            depths.waiting.push(id);
        }
    }
    // The sum of a negative zero and 0 would be a positive one, and 0 times a negative mass a negative zero.
    // A save must change neither.
    let impulse = std::mem::take(&mut state.impulse_z);
    let velocity = if impulse == 0.0 { state.velocity_z } else { state.velocity_z + impulse * inverse_mass };
    let acceleration = if state.force_z == 0.0 { 0.0 } else { state.force_z * inverse_mass };
    if !(velocity.is_finite() && acceleration.is_finite()) {
        disable(core, id);
        report.events.push(Event::NotFinite { body: id, disabled: true });
        return;
    }
    state.velocity_z = velocity;
    let input = state.core_input(velocity, acceleration, body.is_kinematic());
    core.set_space_body(id, input);
}

fn push_profile_to_core(core: &mut PhysicsSimulator, depths: &DepthState, id: GeomId) {
    let (Some(view), Some(profile)) = (core.geom(id), depths.profiles.get(id)) else { return };
    let ground = depths.bodies.get(view.body()).map(|state| state.ground);
    let ground = ground.filter(|ground| ground.object_geom() == Some(id));
    let profile = SpaceProfile {
        half_depth: profile.half_depth(),
        is_round: profile.is_round(),
        ground: ground.map(|ground| [ground.friction_coefficient(), ground.restitution_coefficient()]),
        upright: profile.upright(),
    };
    core.set_space_profile(id, profile);
}

/// Stores the motion of bodies along Z and of platforms, before callbacks report it.
pub(super) fn pull_depth_from_core(core: &PhysicsSimulator, world: &mut World) {
    for (number, centre, yaw, motion) in core.fixtures_moved() {
        world.platforms.has_moved(PlatformId::from_number(number), centre, yaw, motion);
    }
    // `for_each` compiles the nested iterators to loops, `for` does not.
    core.space_moved().for_each(|(id, moved)| {
        let Some(state) = world.depths.bodies.get_mut(id) else { return };
        let SpaceBody { z, velocity, angular_velocity: [x, y], motion, sunk, target, .. } = moved;
        (state.z, state.velocity_z, state.motion) = (z, velocity, Some(Vector3::from(motion)));
        (state.angular_velocity_x, state.angular_velocity_y) = (x, y);
        (state.sunk, state.target) = (sunk, target);
        // The force has acted.
        state.force_z = 0.0;
    });
}

/// Stores the state of bodies that have fallen asleep: no velocity, and no force.
pub(super) fn pull_sleep_from_core(core: &PhysicsSimulator, world: &mut World) {
    let World { depths, platforms, .. } = world;
    if Swings::ARE_THERE {
        for (number, .., motion) in core.fixtures_moved().filter(|(.., motion)| motion.swing().is_some()) {
            platforms.has_rested(PlatformId::from_number(number), motion);
        }
    }
    for (id, rested) in core.space_rested() {
        let Some(state) = depths.bodies.get_mut(id).filter(|state| !state.is_edited) else { continue };
        (state.z, state.velocity_z, state.sunk) = (rested.z, 0.0, rested.sunk);
        (state.angular_velocity_x, state.angular_velocity_y) = (0.0, 0.0);
        state.motion = Some(Vector3::zeros());
        state.force_z = 0.0;
    }
}
