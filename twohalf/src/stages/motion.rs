//! Velocity becomes position, along Z as well.

use farseer_core::PhysicsSimulator;

use super::forces::disable;
use super::plane_handler::PlaneHandler;
use crate::Vector3;
use crate::depth::{Depths, is_movable};
use crate::events::Event;

/// Last stage: along Z first, so that callbacks see all of it.
pub(super) fn integrate(core: &mut PhysicsSimulator, game: &mut PlaneHandler<'_, '_>, dt: f32) {
    move_along_z(core, &mut game.world.depths, &mut game.meeting.moved, dt);
    core.integrate(dt, Some(game));
    for &id in core.body_list() {
        if let (Some(state), Some(body)) = (game.world.depths.bodies.get_mut(id), core.body(id)) {
            let Some(begin) = state.motion else { continue };
            let step = body.position() - begin.xy();
            let is_finite = step.x.is_finite() && step.y.is_finite();
            state.motion = is_finite.then(|| Vector3::new(step.x, step.y, begin.z));
        }
    }
    game.take_events(core);
    tell_moved(core, game);
}

fn move_along_z(core: &mut PhysicsSimulator, depths: &mut Depths, moved: &mut Vec<bool>, dt: f32) {
    moved.clear();
    for index in 0..core.body_list().len() {
        let id = core.body_list()[index];
        let (Some(state), Some(body)) = (depths.bodies.get_mut(id), core.body(id)) else { continue };
        let along_z = if is_movable(core, id) { (state.velocity_z + state.bias_z) * dt } else { 0.0 };
        // X and Y are where it begins, until it is known where it ends.
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

/// Tells of bodies that moved along Z alone, and have never moved otherwise.
fn tell_moved(core: &mut PhysicsSimulator, game: &mut PlaneHandler<'_, '_>) {
    for index in 0..core.body_list().len() {
        let Some(&body) = core.body_list().get(index) else { break };
        if game.meeting.moved.get(body.slot()) != Some(&true) {
            continue;
        }
        game.report.counters.bodies_moved += 1;
        game.report.events.push(Event::BodyUpdated { body });
        game.tell(core, |handler, context| handler.on_body_updated(context, body));
    }
}
