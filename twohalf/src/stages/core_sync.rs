//! Synchronisation of depth with the precise set: input before a step, results after it.

use farseer_core::depth::{DepthAxis, DepthAxisMut, DepthBodyState, DepthShape, HingeFeature};
use farseer_core::{BodyId, GeomId, PhysicsSimulator};

use super::report::Report;
use crate::Vector3;
use crate::depth::{DepthState, PlatformId, World, is_movable};
use crate::events::Event;

/// Queues the forces along Z that had no effect in the last update, so that the next update sends them to the core again.
pub(super) fn requeue_forces(depths: &mut DepthState) {
    let mut forced = std::mem::take(&mut depths.forced);
    for id in forced.drain(..) {
        if depths.bodies.get(id).is_some_and(|state| state.force_z != 0.0) {
            depths.edit(id);
        }
    }
    depths.forced = forced;
}

/// Sends loaded state to the core, so that queries before the next update work. The next update sends all of it again.
pub(crate) fn list_loaded(core: &mut DepthAxisMut<'_>, world: &World) {
    if !core.as_ref().is_enabled() {
        return;
    }
    let bodies: Vec<BodyId> = core.bodies().collect();
    for id in bodies {
        let (Some(body), Some(state)) = (core.body(id), world.depths.bodies.get(id)) else { continue };
        let input = state.core_input(state.velocity_z, 0.0, body.is_kinematic());
        core.set_body(id, input);
    }
    // A disposed geom, which its body has lost, keeps its contacts until the next update.
    let geoms: Vec<GeomId> = core.geoms().collect();
    geoms.into_iter().for_each(|id| push_profile_to_core(core, &world.depths, id));
    core.set_world_boxes(world.platforms.iter().map(|(id, platform)| platform.fixture(id)));
    core.rebuild_loaded();
}

/// Sends changed depth states, shapes, platforms and forces along Z to the core; the first time, all of them.
pub(super) fn push_depth_to_core(core: &mut DepthAxisMut<'_>, world: &mut World, report: &mut Report) {
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
        core.set_world_boxes(fixtures);
    }
    for (id, motion) in platforms.edited_motions() {
        core.set_world_box_motion(id.number(), motion);
    }
}

fn push_body_to_core(core: &mut DepthAxisMut<'_>, depths: &mut DepthState, report: &mut Report, id: BodyId) {
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
        core.disable_body(id);
        report.events.push(Event::NotFinite { body: id, disabled: true });
        return;
    }
    state.velocity_z = velocity;
    let input = state.core_input(velocity, acceleration, body.is_kinematic());
    core.set_body(id, input);
}

fn push_profile_to_core(core: &mut DepthAxisMut<'_>, depths: &DepthState, id: GeomId) {
    let (Some(view), Some(profile)) = (core.geom(id), depths.profiles.get(id)) else { return };
    let ground = depths.bodies.get(view.body()).map(|state| state.ground);
    let ground = ground.filter(|ground| ground.object_geom() == Some(id));
    let profile = DepthShape {
        half_depth: profile.half_depth(),
        is_sphere: profile.is_round(),
        ground_surface: ground
            .map(|ground| [ground.friction_coefficient(), ground.restitution_coefficient()]),
        vertical: profile.upright(),
    };
    core.set_shape(id, profile);
}

/// Stores the motion of bodies along Z and of platforms in the world state after a step of the core, before callbacks report
/// the motion.
pub(super) fn pull_depth_from_core(core: &PhysicsSimulator, world: &mut World) {
    for (number, centre, yaw, motion) in DepthAxis::of(core).moving_world_boxes() {
        world.platforms.has_moved(PlatformId::from_number(number), centre, yaw, motion);
    }
    // `for_each` compiles the nested iterators to loops, `for` does not.
    DepthAxis::of(core).moved_bodies().for_each(|(id, moved)| {
        let Some(state) = world.depths.bodies.get_mut(id) else { return };
        let DepthBodyState {
            z,
            velocity,
            angular_velocity: [x, y],
            displacement: motion,
            residual_penetration: sunk,
            target,
            ..
        } = moved;
        (state.z, state.velocity_z, state.motion) = (z, velocity, Some(Vector3::from(motion)));
        (state.angular_velocity_x, state.angular_velocity_y) = (x, y);
        (state.sunk, state.target) = (sunk, target);
        // The force has acted.
        state.force_z = 0.0;
    });
}

/// Stores the depth state of bodies that have fallen asleep in the core: velocity and force along Z are 0.
pub(super) fn pull_sleep_from_core(core: &PhysicsSimulator, world: &mut World) {
    let World { depths, platforms, .. } = world;
    if HingeFeature::ENABLED {
        for (number, .., motion) in
            DepthAxis::of(core).moving_world_boxes().filter(|(.., motion)| motion.hinge().is_some())
        {
            platforms.has_rested(PlatformId::from_number(number), motion);
        }
    }
    for (id, rested) in DepthAxis::of(core).newly_asleep_bodies() {
        let Some(state) = depths.bodies.get_mut(id).filter(|state| !state.is_edited) else { continue };
        (state.z, state.velocity_z, state.sunk) = (rested.z, 0.0, rested.residual_penetration);
        (state.angular_velocity_x, state.angular_velocity_y) = (0.0, 0.0);
        state.motion = Some(Vector3::zeros());
        state.force_z = 0.0;
    }
}
