//! Queries and changes that sleeping in the precise set needs. Ours: the original has no sleep.

use super::Body;
use crate::math::Vector2;

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
