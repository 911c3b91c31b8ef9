//! What a body is asked that is at rest and may sleep, with the precise set. Ours: the original knows no sleep.

use super::Body;
use crate::math::Vector2;

impl Body {
    /// Whether the body stands still, no impulse waits, and this part of gravity acts on it.
    pub(crate) fn rests_with(&self, gravity_part: f32) -> bool {
        let at_rest = Vector2::zeros();
        self.linear_velocity == at_rest
            && self.angular_velocity == 0.0
            && self.impulse == at_rest
            && self.gravity_part() == gravity_part
    }

    /// The body stands still from now on.
    pub(crate) fn come_to_rest(&mut self) {
        (self.linear_velocity, self.angular_velocity) = (Vector2::zeros(), 0.0);
    }

    /// What the forces and the torque that wait would give the body.
    pub(crate) fn accelerations(&self) -> [f32; 3] {
        let acceleration = self.force * self.inverse_mass;
        [acceleration.x, acceleration.y, self.torque * self.inverse_moment_of_inertia]
    }

    /// Whether the forces that wait give the body what it bears, but for `slack` at a point so far away: then they have done
    /// nothing new, and are forgotten.
    pub(crate) fn bears(&mut self, borne: [f32; 3], reach: f32, slack: f32) -> bool {
        let now = self.accelerations();
        let [x, y, turning] = [0, 1, 2].map(|at| (now[at] - borne[at]).abs());
        let bears = x + y + reach * turning <= slack && self.impulse == Vector2::zeros();
        if bears {
            self.clear_force();
            self.clear_torque();
        }
        bears
    }
}
