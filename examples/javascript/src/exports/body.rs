//! Bodies.

use farseer_core::math::Vector2;
use farseer_core::{BodyFactory, BodyId};

use crate::boundary::{exports, points};
use crate::world::{Simulator, either, stale};

exports! {
    /// A body with the moment of inertia of a rectangle.
    fn body_rectangle(simulator: Simulator, width: f32, height: f32, mass: f32) {
        simulator.objects(|objects| BodyFactory::create_rectangle_body_in(objects, width, height, mass))
    }

    /// A body with that of a disc.
    fn body_circle(simulator: Simulator, radius: f32, mass: f32) {
        simulator.objects(|objects| BodyFactory::create_circle_body_in(objects, radius, mass))
    }

    /// A body with that of a capsule.
    fn body_capsule(simulator: Simulator, height: f32, end_radius: f32, mass: f32) {
        simulator.objects(|objects| BodyFactory::create_capsule_body_in(objects, height, end_radius, mass))
    }

    /// A body with the moment of inertia of the polygon whose corners were left as numbers.
    fn body_polygon(simulator: Simulator, mass: f32) {
        let corners = points()?;
        simulator.objects(|objects| BodyFactory::create_polygon_body_in(objects, &corners, mass))
    }

    /// A body with a moment of inertia of its own.
    fn body_new(simulator: Simulator, mass: f32, moment_of_inertia: f32) {
        simulator.objects(|objects| BodyFactory::create_body_in(objects, mass, moment_of_inertia))
    }

    /// Ends its life, and that of its geoms, with the next update.
    fn body_dispose(simulator: Simulator, body: BodyId) {
        simulator.doubt()?;
        either!(simulator, |engine| engine.dispose(body)?)
    }

    /// Whether it was disposed.
    fn body_is_disposed(simulator: Simulator, body: BodyId) {
        simulator.with(|world| Ok(world.engine.core().is_disposed(body)))
    }

    /// Where its origin is; in 2.5D in the plane, y down.
    fn body_position(simulator: Simulator, body: BodyId) { simulator.body(body, |body| body.position()) }

    /// Sets its position.
    fn body_set_position(simulator: Simulator, body: BodyId, x: f32, y: f32) {
        simulator.edit_body(body, |body| body.set_position(Vector2::new(x, y)))
    }

    /// Its rotation.
    fn body_rotation(simulator: Simulator, body: BodyId) { simulator.body(body, |body| body.rotation()) }

    /// Turns it.
    fn body_set_rotation(simulator: Simulator, body: BodyId, rotation: f32) {
        simulator.edit_body(body, |body| body.set_rotation(rotation))
    }

    /// Its rotation with all turns.
    fn body_total_rotation(simulator: Simulator, body: BodyId) { simulator.body(body, |body| body.total_rotation()) }

    /// Its velocity.
    fn body_linear_velocity(simulator: Simulator, body: BodyId) {
        simulator.body(body, |body| body.linear_velocity())
    }

    /// Sets its velocity.
    fn body_set_linear_velocity(simulator: Simulator, body: BodyId, x: f32, y: f32) {
        simulator.edit_body(body, |body| body.set_linear_velocity(Vector2::new(x, y)))
    }

    /// Its angular velocity.
    fn body_angular_velocity(simulator: Simulator, body: BodyId) {
        simulator.body(body, |body| body.angular_velocity())
    }

    /// Sets its angular velocity.
    fn body_set_angular_velocity(simulator: Simulator, body: BodyId, angular_velocity: f32) {
        simulator.edit_body(body, |body| body.set_angular_velocity(angular_velocity))
    }

    /// Its mass.
    fn body_mass(simulator: Simulator, body: BodyId) { simulator.body(body, |body| body.mass()) }

    /// Sets its mass.
    fn body_set_mass(simulator: Simulator, body: BodyId, mass: f32) {
        Ok(simulator.edit_body(body, |body| body.set_mass(mass))??)
    }

    /// Its moment of inertia.
    fn body_moment_of_inertia(simulator: Simulator, body: BodyId) {
        simulator.body(body, |body| body.moment_of_inertia())
    }

    /// Sets its moment of inertia.
    fn body_set_moment_of_inertia(simulator: Simulator, body: BodyId, moment_of_inertia: f32) {
        Ok(simulator.edit_body(body, |body| body.set_moment_of_inertia(moment_of_inertia))??)
    }

    /// Whether it is static.
    fn body_is_static(simulator: Simulator, body: BodyId) { simulator.body(body, |body| body.is_static()) }

    /// Sets whether it is static.
    fn body_set_is_static(simulator: Simulator, body: BodyId, value: bool) {
        simulator.doubt()?;
        either!(simulator, |engine| engine.body_mut(body).ok_or_else(|| stale("body"))?.set_is_static(value))
    }

    /// Whether only its velocity moves it.
    fn body_is_kinematic(simulator: Simulator, body: BodyId) { simulator.body(body, |body| body.is_kinematic()) }

    /// Sets whether only its velocity moves it.
    fn body_set_is_kinematic(simulator: Simulator, body: BodyId, value: bool) {
        simulator.doubt()?;
        either!(simulator, |engine| engine.body_mut(body).ok_or_else(|| stale("body"))?.set_is_kinematic(value))
    }

    /// Moves a kinematic body to a position and rotation in the next update.
    fn body_move_to(simulator: Simulator, body: BodyId, x: f32, y: f32, rotation: f32) {
        Ok(simulator.edit_body(body, |body| body.move_to(Vector2::new(x, y), rotation))??)
    }

    /// Whether it is a bullet, which has CCD against all bodies.
    fn body_is_bullet(simulator: Simulator, body: BodyId) { simulator.body(body, |body| body.is_bullet()) }

    /// Sets whether it is a bullet, which has CCD against all bodies.
    fn body_set_is_bullet(simulator: Simulator, body: BodyId, value: bool) {
        simulator.edit_body(body, |body| body.set_is_bullet(value))
    }

    /// Whether it is enabled.
    fn body_enabled(simulator: Simulator, body: BodyId) { simulator.body(body, |body| body.enabled()) }

    /// Sets whether it is enabled.
    fn body_set_enabled(simulator: Simulator, body: BodyId, value: bool) {
        simulator.doubt()?;
        either!(simulator, |engine| engine.body_mut(body).ok_or_else(|| stale("body"))?.set_enabled(value))
    }

    /// How much of the gravity it feels.
    fn body_gravity_scale(simulator: Simulator, body: BodyId) { simulator.body(body, |body| body.gravity_scale()) }

    /// Sets how much of the gravity it feels.
    fn body_set_gravity_scale(simulator: Simulator, body: BodyId, gravity_scale: f32) {
        simulator.edit_body(body, |body| body.set_gravity_scale(gravity_scale))
    }

    /// Its linear drag.
    fn body_linear_drag_coefficient(simulator: Simulator, body: BodyId) {
        simulator.body(body, |body| body.linear_drag_coefficient())
    }

    /// Sets its linear drag.
    fn body_set_linear_drag_coefficient(simulator: Simulator, body: BodyId, value: f32) {
        simulator.edit_body(body, |body| body.set_linear_drag_coefficient(value))
    }

    /// Its rotational drag.
    fn body_rotational_drag_coefficient(simulator: Simulator, body: BodyId) {
        simulator.body(body, |body| body.rotational_drag_coefficient())
    }

    /// Sets its rotational drag.
    fn body_set_rotational_drag_coefficient(simulator: Simulator, body: BodyId, value: f32) {
        simulator.edit_body(body, |body| body.set_rotational_drag_coefficient(value))
    }

    /// A force until the next update is over.
    fn body_apply_force(simulator: Simulator, body: BodyId, x: f32, y: f32) {
        simulator.edit_body(body, |body| body.apply_force(Vector2::new(x, y)))
    }

    /// A force that acts at a point of the world.
    fn body_apply_force_at_world_point(simulator: Simulator, body: BodyId, x: f32, y: f32, point_x: f32, point_y: f32) {
        let point = Vector2::new(point_x, point_y);
        simulator.edit_body(body, |body| body.apply_force_at_world_point(Vector2::new(x, y), point))
    }

    /// A torque until the next update is over.
    fn body_apply_torque(simulator: Simulator, body: BodyId, torque: f32) {
        simulator.edit_body(body, |body| body.apply_torque(torque))
    }

    /// An impulse.
    fn body_apply_impulse(simulator: Simulator, body: BodyId, x: f32, y: f32) {
        simulator.edit_body(body, |body| body.apply_impulse(Vector2::new(x, y)))
    }

    /// An angular impulse.
    fn body_apply_angular_impulse(simulator: Simulator, body: BodyId, amount: f32) {
        simulator.edit_body(body, |body| body.apply_angular_impulse(amount))
    }

    /// Whether it sleeps.
    fn body_is_asleep(simulator: Simulator, body: BodyId) {
        simulator.with(|world| Ok(world.engine.core().is_asleep(body)))
    }

    /// Wakes it.
    fn body_wake(simulator: Simulator, body: BodyId) {
        either!(simulator, |engine| engine.wake(body))
    }

    /// Converts a point from the world to its own frame.
    fn body_local_position(simulator: Simulator, body: BodyId, x: f32, y: f32) {
        simulator.body(body, |body| body.get_local_position(Vector2::new(x, y)))
    }

    /// Converts a point from its own frame to the world.
    fn body_world_position(simulator: Simulator, body: BodyId, x: f32, y: f32) {
        simulator.body(body, |body| body.get_world_position(Vector2::new(x, y)))
    }
}
