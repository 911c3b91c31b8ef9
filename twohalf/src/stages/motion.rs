//! Integration of velocities into positions, along Z as well.

use farseer_core::PhysicsSimulator;

use super::core_events::CoreEventAdapter;
use super::forces::disable;
use crate::Vector3;
use crate::depth::{DepthState, is_movable};
use crate::events::Event;

/// Last stage of the faithful scheme: integrates velocities into positions. Z comes first, so that callbacks see the motion
/// along all axes.
pub(super) fn integrate(core: &mut PhysicsSimulator, game: &mut CoreEventAdapter<'_, '_>, dt: f32) {
    move_along_z(core, &mut game.world.depths, &mut game.pair_context.moved, dt);
    core.integrate(dt, Some(game));
    for &id in core.body_list() {
        if let (Some(state), Some(body)) = (game.world.depths.bodies.get_mut(id), core.body(id)) {
            let Some(begin) = state.motion else { continue };
            let step = body.position() - begin.xy();
            let is_finite = step.x.is_finite() && step.y.is_finite();
            state.motion = is_finite.then(|| Vector3::new(step.x, step.y, begin.z));
        }
    }
    game.adopt_core_events(core);
    emit_moved_events(core, game);
}

fn move_along_z(core: &mut PhysicsSimulator, depths: &mut DepthState, moved: &mut Vec<bool>, dt: f32) {
    moved.clear();
    for index in 0..core.body_list().len() {
        let id = core.body_list()[index];
        let (Some(state), Some(body)) = (depths.bodies.get_mut(id), core.body(id)) else { continue };
        let along_z = if is_movable(core, id) { (state.velocity_z + state.bias_z) * dt } else { 0.0 };
        // X and Y of the start, until the end is known.
        state.motion = Some(Vector3::new(body.position().x, body.position().y, along_z));
        if along_z == 0.0 {
            continue;
        }
        let z = state.z + along_z;
        if z.is_finite() {
            state.z = z;
            if id.slot() >= moved.len() {
                moved.resize(id.slot() + 1, false);
            }
            moved[id.slot()] = true;
        } else {
            state.motion = None;
            disable(core, id);
        }
    }
}

/// Reports bodies that moved along Z only and have never moved in X and Y.
fn emit_moved_events(core: &mut PhysicsSimulator, game: &mut CoreEventAdapter<'_, '_>) {
    for index in 0..core.body_list().len() {
        let Some(&body) = core.body_list().get(index) else { break };
        if game.pair_context.moved.get(body.slot()) != Some(&true) {
            continue;
        }
        game.report.counters.bodies_moved += 1;
        game.report.events.push(Event::BodyUpdated { body });
        game.call_handler(core, |handler, context| handler.on_body_updated(context, body));
    }
}
