//! Bodies whose time passes more slowly than that of the others, or not at all.
//!
//! Between updates a body has what is its own: the velocities, mass and gravity of its own time. During an update it is what
//! others see of it. So setters, impulses and saves need to know nothing of this.

use farseer_core::{BodyId, PhysicsSimulator};

use crate::Vector2;
use crate::depth::{Depths, World, is_movable};

/// What is its own, while it is in an update as others see it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Own {
    body: BodyId,
    /// Of this update; 0 stands still.
    scale: f32,
    motion: Motion,
    mass: f32,
    moment_of_inertia: f32,
    gravity_scale: f32,
    quadratic_drag: f32,
    rotational_drag: f32,
    /// What others see.
    seen: Motion,
}

#[derive(Debug, Clone, Copy, PartialEq, Default)]
struct Motion {
    velocity: Vector2,
    velocity_z: f32,
    spin: f32,
    spin_xy: [f32; 2],
}

impl Motion {
    fn times(self, factor: f32) -> Self {
        Motion {
            velocity: self.velocity * factor,
            velocity_z: self.velocity_z * factor,
            spin: self.spin * factor,
            spin_xy: self.spin_xy.map(|spin| spin * factor),
        }
    }
}

/// An update begins: bodies become what others see of them. Answers in `slowed` what they are.
pub(super) fn slow_down(core: &mut PhysicsSimulator, world: &mut World, slowed: &mut Vec<Own>) {
    slowed.clear();
    world.paces.retain(|pace| !pace.is_over() && core.body(pace.body).is_some());
    for at in 0..world.paces.len() {
        let (body, scale) = (world.paces[at].body, world.paces[at].scale_now());
        if scale < 1.0 && is_movable(core, body) {
            slowed.extend(as_seen(core, &mut world.depths, body, scale));
        }
    }
}

/// It ends: they become what they are.
pub(super) fn catch_up(
    core: &mut PhysicsSimulator,
    world: &mut World,
    slowed: &mut Vec<Own>,
    has_moved: bool,
) {
    for pace in world.paces.iter_mut().filter(|_| has_moved) {
        pace.stops = pace.stops.saturating_sub(1);
    }
    slowed.drain(..).for_each(|own| give_back(core, &mut world.depths, own));
}

fn motion(core: &PhysicsSimulator, depths: &Depths, body: BodyId) -> Option<Motion> {
    let (plane, state) = (core.body(body)?, depths.bodies.get(body)?);
    Some(Motion {
        velocity: plane.linear_velocity(),
        velocity_z: state.velocity_z,
        spin: plane.angular_velocity(),
        spin_xy: [state.angular_velocity_x, state.angular_velocity_y],
    })
}

fn set_motion(core: &mut PhysicsSimulator, depths: &mut Depths, body: BodyId, motion: Motion) {
    let (Some(plane), Some(state)) = (core.body_mut(body), depths.edit(body)) else { return };
    plane.set_linear_velocity(motion.velocity);
    plane.set_angular_velocity(motion.spin);
    state.velocity_z = motion.velocity_z;
    [state.angular_velocity_x, state.angular_velocity_y] = motion.spin_xy;
}

fn own(core: &PhysicsSimulator, depths: &Depths, body: BodyId, scale: f32) -> Option<Own> {
    let (motion, plane) = (motion(core, depths, body)?, core.body(body)?);
    Some(Own {
        body,
        scale,
        motion,
        mass: plane.mass(),
        moment_of_inertia: plane.moment_of_inertia(),
        gravity_scale: plane.gravity_scale(),
        quadratic_drag: plane.quadratic_drag_coefficient(),
        rotational_drag: plane.rotational_drag_coefficient(),
        seen: motion.times(scale),
    })
}

/// A body becomes what others see of it. The numbers of one that is very heavy may have no room for more: it stands still.
fn as_seen(core: &mut PhysicsSimulator, depths: &mut Depths, body: BodyId, scale: f32) -> Option<Own> {
    let slow = if scale > 0.0 { slow(core, depths, body, scale) } else { None };
    slow.or_else(|| hold(core, depths, body))
}

/// A body stands still; what was applied to it becomes velocity of its own.
fn hold(core: &mut PhysicsSimulator, depths: &mut Depths, body: BodyId) -> Option<Own> {
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
    let own = own(core, depths, body, 0.0)?;
    core.body_mut(body)?.set_is_kinematic(true);
    set_motion(core, depths, body, Motion::default());
    Some(own)
}

/// A body becomes slow and heavy, if there are numbers for it.
fn slow(core: &mut PhysicsSimulator, depths: &mut Depths, body: BodyId, scale: f32) -> Option<Own> {
    let own = own(core, depths, body, scale)?;
    let plane = core.body_mut(body)?;
    plane.set_mass(own.mass / scale).ok()?;
    if plane.set_moment_of_inertia(own.moment_of_inertia / scale).is_err() {
        // What was accepted before is accepted again.
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

fn give_back(core: &mut PhysicsSimulator, depths: &mut Depths, own: Own) {
    let body = own.body;
    let (Some(now), Some(plane)) = (motion(core, depths, body), core.body_mut(body)) else { return };
    if own.scale == 0.0 {
        plane.set_is_kinematic(false);
    } else {
        // What was accepted before is accepted again.
        let _ = plane.set_mass(own.mass).and(plane.set_moment_of_inertia(own.moment_of_inertia));
        plane.set_gravity_scale(own.gravity_scale);
        plane.set_quadratic_drag_coefficient(own.quadratic_drag);
        plane.set_rotational_drag_coefficient(own.rotational_drag);
    }
    // What has not changed comes back to the bit.
    let is_same = own.scale == 0.0 || now == own.seen;
    set_motion(core, depths, body, if is_same { own.motion } else { now.times(1.0 / own.scale) });
}
