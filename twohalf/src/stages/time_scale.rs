//! Application of time scales during an update.
//!
//! Between updates a body has the velocities, mass and gravity of its own time. During an update it has the velocities, mass
//! and gravity that other bodies see. Setters, impulses and saves therefore need no special case.

use farseer_core::{BodyId, PhysicsSimulator};

use crate::Vector2;
use crate::depth::{DepthState, World, is_movable};

/// State of a body in its own time, kept while its time scale is applied.
#[derive(Debug, Clone, Copy)]
pub(super) struct UnscaledState {
    body: BodyId,
    /// Time scale of the body in this update, dimensionless; 0 stops the time of the body.
    scale: f32,
    motion: Motion,
    /// Mass, in mass units.
    mass: f32,
    /// Moment of inertia, mass · px².
    moment_of_inertia: f32,
    /// Factor of gravity, dimensionless.
    gravity_scale: f32,
    /// Quadratic drag coefficient, mass units per px.
    quadratic_drag: f32,
    /// Rotational drag coefficient, mass · px² per radian.
    rotational_drag: f32,
    /// Velocities of the body that other bodies see during the update.
    seen: Motion,
}

#[derive(Debug, Clone, Copy, PartialEq, Default)]
struct Motion {
    velocity: Vector2,
    /// Velocity along Z, px/s.
    velocity_z: f32,
    /// Angular velocity about the depth axis, radians/s.
    spin: f32,
    /// Angular velocity about x and y, radians/s.
    spin_xy: [f32; 2],
}

impl Motion {
    fn scaled_by(self, factor: f32) -> Self {
        Motion {
            velocity: self.velocity * factor,
            velocity_z: self.velocity_z * factor,
            spin: self.spin * factor,
            spin_xy: self.spin_xy.map(|spin| spin * factor),
        }
    }
}

/// Applies the time scales at the start of an update, and stores the states of the bodies in their own time in `slowed`.
pub(super) fn apply_time_scale(
    core: &mut PhysicsSimulator,
    world: &mut World,
    slowed: &mut Vec<UnscaledState>,
) {
    slowed.clear();
    world.paces.retain(|pace| !pace.is_over() && core.body(pace.body).is_some());
    for at in 0..world.paces.len() {
        let (body, scale) = (world.paces[at].body, world.paces[at].scale_now());
        if scale < 1.0 && is_movable(core, body) {
            slowed.extend(scale_body(core, &mut world.depths, body, scale));
        }
    }
}

/// Restores the states of the bodies in their own time from `slowed` at the end of an update.
pub(super) fn restore_time_scale(
    core: &mut PhysicsSimulator,
    world: &mut World,
    slowed: &mut Vec<UnscaledState>,
    has_moved: bool,
) {
    for pace in world.paces.iter_mut().filter(|_| has_moved) {
        pace.stops = pace.stops.saturating_sub(1);
    }
    slowed.drain(..).for_each(|own| restore_body(core, &mut world.depths, own));
}

fn motion(core: &PhysicsSimulator, depths: &DepthState, body: BodyId) -> Option<Motion> {
    let (plane, state) = (core.body(body)?, depths.bodies.get(body)?);
    Some(Motion {
        velocity: plane.linear_velocity(),
        velocity_z: state.velocity_z,
        spin: plane.angular_velocity(),
        spin_xy: [state.angular_velocity_x, state.angular_velocity_y],
    })
}

fn set_motion(core: &mut PhysicsSimulator, depths: &mut DepthState, body: BodyId, motion: Motion) {
    let (Some(plane), Some(state)) = (core.body_mut(body), depths.edit(body)) else { return };
    plane.set_linear_velocity(motion.velocity);
    plane.set_angular_velocity(motion.spin);
    state.velocity_z = motion.velocity_z;
    [state.angular_velocity_x, state.angular_velocity_y] = motion.spin_xy;
}

fn unscaled_state(
    core: &PhysicsSimulator,
    depths: &DepthState,
    body: BodyId,
    scale: f32,
) -> Option<UnscaledState> {
    let (motion, plane) = (motion(core, depths, body)?, core.body(body)?);
    Some(UnscaledState {
        body,
        scale,
        motion,
        mass: plane.mass(),
        moment_of_inertia: plane.moment_of_inertia(),
        gravity_scale: plane.gravity_scale(),
        quadratic_drag: plane.quadratic_drag_coefficient(),
        rotational_drag: plane.rotational_drag_coefficient(),
        seen: motion.scaled_by(scale),
    })
}

/// Applies a time scale to a body and returns its state in its own time. A scaled mass or inertia out of range stops the time
/// of the body. `None` for a body that does not exist.
fn scale_body(
    core: &mut PhysicsSimulator,
    depths: &mut DepthState,
    body: BodyId,
    scale: f32,
) -> Option<UnscaledState> {
    let slow = if scale > 0.0 { slow_body(core, depths, body, scale) } else { None };
    slow.or_else(|| stop_body(core, depths, body))
}

/// Stops the time of a body and returns its state in its own time. Pending impulses change its kept velocity.
fn stop_body(core: &mut PhysicsSimulator, depths: &mut DepthState, body: BodyId) -> Option<UnscaledState> {
    let (plane, state) = (core.body_mut(body)?, depths.edit(body)?);
    let velocity = plane.linear_velocity() + plane.impulse() * plane.inverse_mass();
    let velocity_z = state.velocity_z + state.impulse_z * plane.inverse_mass();
    plane.set_linear_velocity(velocity);
    if velocity_z.is_finite() {
        state.velocity_z = velocity_z;
    }
    plane.clear_impulse();
    plane.clear_force();
    plane.clear_torque();
    (state.impulse_z, state.force_z) = (0.0, 0.0);
    let own = unscaled_state(core, depths, body, 0.0)?;
    core.body_mut(body)?.set_is_kinematic(true);
    set_motion(core, depths, body, Motion::default());
    Some(own)
}

/// Makes a body slow and heavy by its time scale, and returns its state in its own time; `None` if scaled numbers are out of
/// range.
fn slow_body(
    core: &mut PhysicsSimulator,
    depths: &mut DepthState,
    body: BodyId,
    scale: f32,
) -> Option<UnscaledState> {
    let own = unscaled_state(core, depths, body, scale)?;
    let plane = core.body_mut(body)?;
    plane.set_mass(own.mass / scale).ok()?;
    if plane.set_moment_of_inertia(own.moment_of_inertia / scale).is_err() {
        // The setter accepted this mass before.
        let _ = plane.set_mass(own.mass);
        return None;
    }
    plane.set_gravity_scale(own.gravity_scale * (scale * scale));
    plane.set_quadratic_drag_coefficient(own.quadratic_drag / scale);
    plane.set_rotational_drag_coefficient(own.rotational_drag / scale);
    let (force, torque) = (plane.force() * scale, plane.torque() * scale);
    plane.clear_force();
    plane.clear_torque();
    plane.apply_force(force);
    plane.apply_torque(torque);
    depths.edit(body)?.force_z *= scale;
    set_motion(core, depths, body, own.seen);
    Some(own)
}

fn restore_body(core: &mut PhysicsSimulator, depths: &mut DepthState, own: UnscaledState) {
    let body = own.body;
    let (Some(now), Some(plane)) = (motion(core, depths, body), core.body_mut(body)) else { return };
    if own.scale == 0.0 {
        plane.set_is_kinematic(false);
    } else {
        // The setters accepted these values before.
        let _ = plane.set_mass(own.mass).and(plane.set_moment_of_inertia(own.moment_of_inertia));
        plane.set_gravity_scale(own.gravity_scale);
        plane.set_quadratic_drag_coefficient(own.quadratic_drag);
        plane.set_rotational_drag_coefficient(own.rotational_drag);
    }
    // A velocity that has not changed is restored to the bit.
    let is_same = own.scale == 0.0 || now == own.seen;
    set_motion(core, depths, body, if is_same { own.motion } else { now.scaled_by(1.0 / own.scale) });
}
