//! Queries and changes of a body in a step of the precise set.

use super::Body;
use crate::math::Vector2;
use crate::math::vector2::length;

/// Integration.
impl Body {
    /// Factor by which the simulator's gravity acts on the body, dimensionless. 0 if the body ignores gravity or is
    /// immovable.
    #[inline]
    pub(crate) fn effective_gravity_scale(&self) -> f32 {
        if self.ignore_gravity || self.is_immovable() { 0.0 } else { self.gravity_scale }
    }

    /// Begins a step of the precise set: the impulses that the game has applied since the last one change the velocity.
    #[inline]
    pub(crate) fn begin_dynamic_step(&mut self) {
        self.apply_accumulated_impulse();
    }

    /// Returns linear and angular acceleration for a step of the precise set, in length units/s² and rad/s². They are
    /// those of the accumulated force and torque, which are cleared, and of quadratic drag.
    pub(crate) fn take_accelerations(&mut self) -> (Vector2, f32) {
        let mut force = std::mem::replace(&mut self.force, Vector2::zeros());
        if self.is_quadratic_drag_enabled {
            force -= self.linear_velocity * (length(self.linear_velocity) * self.quadratic_drag_coefficient);
        }
        let torque = std::mem::take(&mut self.torque);
        (force * self.inverse_mass, torque * self.inverse_moment_of_inertia)
    }

    /// Fractions of the linear and of the angular velocity that drag takes per second (1/s), at the present angular
    /// velocity.
    pub(crate) fn drag_rates(&self) -> (f32, f32) {
        let spin_drag = match self.is_rotational_drag_linear() {
            false => self.rotational_drag_coefficient * self.angular_velocity.abs(),
            true => self.rotational_drag_coefficient,
        };
        (self.linear_drag_coefficient * self.inverse_mass, spin_drag * self.inverse_moment_of_inertia)
    }

    /// Stores the result of a step of the precise set: pose and velocities.
    #[inline]
    pub(crate) fn end_step(&mut self, position: [f32; 2], turned_by: f32, velocity: [f32; 2], spin: f32) {
        // As single numbers, which the compiler keeps in registers.
        [self.position.x, self.position.y] = position;
        self.normalize_rotation(self.rotation + turned_by);
        [self.linear_velocity.x, self.linear_velocity.y] = velocity;
        self.angular_velocity = spin;
        self.has_moved = true;
        if self.is_kinematic {
            self.finish_move();
        }
    }
}

/// Sleep.
impl Body {
    /// Whether the velocity is zero, no impulse is pending, and gravity acts on the body with this factor.
    pub(crate) fn is_at_rest_under(&self, gravity_part: f32) -> bool {
        let at_rest = Vector2::zeros();
        self.linear_velocity == at_rest
            && self.angular_velocity == 0.0
            && self.impulse == at_rest
            && self.effective_gravity_scale() == gravity_part
    }

    /// Sets linear and angular velocity to zero.
    pub(crate) fn stop(&mut self) {
        (self.linear_velocity, self.angular_velocity) = (Vector2::zeros(), 0.0);
    }

    /// Linear acceleration in length units/s² and angular acceleration in rad/s² that the accumulated force and torque
    /// would give.
    pub(crate) fn pending_accelerations(&self) -> [f32; 3] {
        let acceleration = self.force * self.inverse_mass;
        [acceleration.x, acceleration.y, self.torque * self.inverse_moment_of_inertia]
    }

    /// Whether the accumulated force and torque equal those that the sleeping body had (`borne`), and no impulse is
    /// pending. The tolerance is `slack` length units/s² at the distance `reach` from the origin. If so, they are
    /// cleared: they do not wake the body.
    pub(crate) fn take_unchanged_forces(&mut self, borne: [f32; 3], reach: f32, slack: f32) -> bool {
        let now = self.pending_accelerations();
        let [x, y, turning] = [0, 1, 2].map(|at| (now[at] - borne[at]).abs());
        let bears = x + y + reach * turning <= slack && self.impulse == Vector2::zeros();
        if bears {
            self.clear_force();
            self.clear_torque();
        }
        bears
    }
}
