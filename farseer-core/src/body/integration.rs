//! Time integration of a body: forces to velocity, velocity to pose. Used by both sets of methods.

use super::Body;
use crate::math::vector2::length;
use crate::math::{Vector2, scalar};

/// Integration of bodies that are enabled and not static (behaviour chapter 02, sections 5, 6).
impl Body {
    /// Whether the simulator integrates the body.
    #[inline]
    pub(crate) fn is_integrated(&self) -> bool {
        self.enabled && !self.is_static
    }

    /// Whether the position and rotation are finite.
    #[inline]
    pub(crate) fn pose_is_finite(&self) -> bool {
        let sum =
            self.position.x * 0.0 + self.position.y * 0.0 + self.rotation * 0.0 + self.total_rotation * 0.0;
        sum == 0.0
    }

    /// Whether position, rotation and velocities are finite.
    pub(crate) fn is_finite(&self) -> bool {
        let sum = self.linear_velocity.x * 0.0
            + self.linear_velocity.y * 0.0
            + self.angular_velocity * 0.0
            + self.linear_velocity_bias.x * 0.0
            + self.linear_velocity_bias.y * 0.0
            + self.angular_velocity_bias * 0.0;
        sum == 0.0 && self.pose_is_finite()
    }

    /// Whether linear and angular velocity are finite. Forces change no other quantity.
    #[inline]
    pub(crate) fn velocity_is_finite(&self) -> bool {
        self.linear_velocity.x * 0.0 + self.linear_velocity.y * 0.0 + self.angular_velocity * 0.0 == 0.0
    }

    /// Adds gravity to the accumulated force. A gravity scale of 1 changes no bit.
    #[inline]
    pub(crate) fn accumulate_gravity(&mut self, gravity: Vector2) {
        if !self.ignore_gravity {
            self.force.x += gravity.x * self.mass * self.gravity_scale;
            self.force.y += gravity.y * self.mass * self.gravity_scale;
        }
    }

    /// Adds the accumulated impulse to the velocity. It also runs without any impulse: the addition turns -0 into +0.
    #[inline]
    pub(crate) fn apply_accumulated_impulse(&mut self) {
        if !self.is_immovable() {
            self.linear_velocity += self.impulse * self.inverse_mass;
        }
        self.impulse = Vector2::zeros();
    }

    /// Integrates force and drag into the velocity over `dt` seconds, then clears the force.
    #[inline]
    pub(crate) fn integrate_velocity(&mut self, dt: f32) {
        let v = self.linear_velocity;
        let w = self.angular_velocity;
        let mut drag = -v * self.linear_drag_coefficient;
        if self.is_quadratic_drag_enabled {
            let speed = length(v);
            drag.x += -speed * self.quadratic_drag_coefficient * scalar::sign(v.x);
            drag.y += -speed * self.quadratic_drag_coefficient * scalar::sign(v.y);
        }
        self.force += drag;
        let rotational_drag = match self.is_rotational_drag_linear() {
            false => w * w * scalar::sign(w) * -self.rotational_drag_coefficient,
            true => w * -self.rotational_drag_coefficient,
        };
        self.torque += rotational_drag;
        self.linear_velocity += self.force * self.inverse_mass * dt;
        self.angular_velocity += self.torque * self.inverse_moment_of_inertia * dt;
        self.force = Vector2::zeros();
        self.torque = 0.0;
    }

    /// Moves the body over `dt` seconds and returns whether its pose changed.
    #[inline]
    pub(crate) fn integrate_position(&mut self, dt: f32) -> bool {
        let mut moved = false;
        let d = (self.linear_velocity + self.linear_velocity_bias) * dt;
        if d.x != 0.0 || d.y != 0.0 {
            self.position += d;
            moved = true;
        }
        self.linear_velocity_bias = Vector2::zeros();
        let turn = (self.angular_velocity + self.angular_velocity_bias) * dt;
        if turn != 0.0 {
            self.normalize_rotation(self.rotation + turn);
            moved = true;
        }
        self.angular_velocity_bias = 0.0;
        if self.is_kinematic {
            self.finish_move();
        }
        self.has_moved |= moved;
        moved
    }

    /// Whether the body has ever moved. From then on the original raises its Updated event at the end of every step.
    #[inline]
    pub(crate) fn has_moved(&self) -> bool {
        self.has_moved
    }
}
