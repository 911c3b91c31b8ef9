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

    /// What forces and torque would give the body, unless it differs from this by more than `slack` at a point that far away:
    /// then they have done nothing new, and are forgotten.
    pub(crate) fn bears(&mut self, [x, y, turning]: [f32; 3], reach: f32, slack: f32) -> bool {
        let acceleration = self.force * self.inverse_mass;
        let turned = self.torque * self.inverse_moment_of_inertia;
        let change =
            (acceleration.x - x).abs() + (acceleration.y - y).abs() + reach * (turned - turning).abs();
        let bears = change <= slack && self.impulse == Vector2::zeros();
        if bears {
            self.clear_force();
            self.clear_torque();
        }
        bears
    }
}
