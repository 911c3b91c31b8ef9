//! Integration of impulses, forces and drag into velocities, along Z as well.

use farseer_core::{BodyId, Event as CoreEvent, PhysicsSimulator};

use crate::depth::{DepthState, is_movable};

/// Fourth stage of the faithful scheme: integrates impulses, forces and drag into the velocities of all bodies.
pub(super) fn apply(core: &mut PhysicsSimulator, depths: &mut DepthState, dt: f32) {
    for index in 0..core.body_list().len() {
        let id = core.body_list()[index];
        let (Some(body), Some(state)) = (core.body(id), depths.bodies.get_mut(id)) else { continue };
        state.bias_z = 0.0;
        if !is_movable(core, id) {
            continue;
        }
        let before = (state.velocity_z, state.angular_velocity_x, state.angular_velocity_y);
        state.integrate_velocity(body, dt);
        if !state.motion_is_finite() {
            (state.velocity_z, state.angular_velocity_x, state.angular_velocity_y) = before;
            disable(core, id);
        }
    }
    core.apply_forces(dt, 0.0, None);
}

/// Disables a body whose state would not be finite.
#[cold]
pub(super) fn disable(core: &mut PhysicsSimulator, id: BodyId) {
    if let Some(body) = core.body_mut(id) {
        body.set_enabled(false);
        core.report(CoreEvent::NotFinite { body: id, disabled: true });
    }
}
