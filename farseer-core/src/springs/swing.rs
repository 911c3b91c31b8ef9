//! Springs as strong in a step as they are over its length: the precise set's.
//!
//! A force that is found once per step and acts on the velocity before bodies move (the symplectic Euler method) keeps the
//! swing of a spring, and gives it the angular frequency w' with sin(w' h / 2) = w h / 2, where w^2 = k / m and m is the mass
//! that the spring feels: too fast, and without end from w h = 2 on. A constant k' = k sin^2(x) / x^2, x = w h / 2, swings
//! with w itself. The damping of a step takes away what a damper takes in that time: 1 - exp(-c h / m) of the velocity.

use super::Constants;
use crate::body::Body;
use crate::math::scalar::sin;
use crate::math::vector2::cross;
use crate::math::{Vector2, decay};

/// Above this x a spring is as strong as at it: a quarter of a swing in a step is the most that a step shows.
const FASTEST: f32 = 1.4;

/// The part of what a step bears that is used.
const MOST: f32 = 0.97;

impl Constants {
    /// As they act in a step, if there is one to act in, on something with this reciprocal of its mass.
    pub(super) fn tuned(self, inverse_mass: impl FnOnce() -> f32) -> Self {
        let Some(dt) = self.step else { return self };
        let inverse = inverse_mass();
        let squared = 0.25 * dt * dt * self.spring * inverse;
        let damped = if self.damping > 0.0 && inverse > 0.0 {
            self.damping * decay::grown(self.damping * inverse, dt) / dt
        } else {
            self.damping
        };
        Constants { spring: self.spring * weaker(squared, damped * inverse * dt), damping: damped, ..self }
    }
}

/// sin^2(x) / x^2, or less for what is too fast, from the square of x and the part of the velocity that damping takes away:
/// a step bears x^2 < 1 - that part / 2.
fn weaker(squared: f32, damped: f32) -> f32 {
    // Below it is 1 to the last digit; springs that push apart do not swing, and what is not finite is told elsewhere.
    if squared.is_nan() || squared <= 1e-8 {
        return 1.0;
    }
    let x = squared.sqrt();
    let sine = sin(if x < FASTEST { x } else { FASTEST });
    let (swing, most) = (sine * sine, MOST * (1.0 - 0.5 * damped));
    (if swing < most { swing } else { most }) / squared
}

/// Reciprocal of the mass that a force at a point of a body feels along a direction.
pub(super) fn inverse_mass_at(body: &Body, arm: Vector2, direction: Vector2) -> f32 {
    if body.is_immovable() {
        return 0.0;
    }
    let turning = cross(arm, direction);
    body.inverse_mass() + body.inverse_moment_of_inertia() * turning * turning
}

/// Reciprocal of the inertia that a torque on a body feels.
pub(super) fn inverse_inertia(body: &Body) -> f32 {
    if body.is_immovable() { 0.0 } else { body.inverse_moment_of_inertia() }
}
