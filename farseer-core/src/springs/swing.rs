//! Springs as strong in a step as they are over its length: the precise set's.
//!
//! A force that is found once per step and acts on the velocity before bodies move (the symplectic Euler method) keeps the
//! swing of a spring, and gives it the angular frequency w' with sin(w' h / 2) = w h / 2, where w^2 = k / m and m is the mass
//! that the spring feels: too fast, and without end from w h = 2 on. A constant k' = k sin^2(x) / x^2, x = w h / 2, swings
//! with w itself. The damping of a step takes away what a damper takes in that time: 1 - exp(-c h / m) of the velocity.
//!
//! Where a step is not as long as the one before, that is not enough: a spring that is as strong as it should be in each of them
//! gains energy without end. The velocity u is that of the way of a step; with w known, that of the next way is too, from where
//! the spring is and the way of the last one (x(t + h) = x cos w h + v sin(w h) / w, and the same back by the step g before):
//!
//! u' = r u - x (r (1 - cos w g) / g + (1 - cos w h) / h), where r = (sin(w h) / w h) / (sin(w g) / w g).
//!
//! So it swings with w whatever the steps are; if they are equal it is the k' from above.

use super::Constants;
use crate::body::Body;
use crate::math::scalar::sin;
use crate::math::vector2::cross;
use crate::math::{Vector2, decay};

/// Above this x a spring is as strong as at it: a quarter of a swing in a step is the most that a step shows.
const FASTEST: f32 = 1.4;

/// Square of the x below which a spring is as strong as it is, to the last digit.
const SLOWEST: f32 = 1e-8;

/// The part of what a step bears that is used.
const MOST: f32 = 0.97;

/// What in steps that are not equal is faster than this in the longer of two, in radians, is as fast as this: a quarter of a
/// swing.
const FASTEST_UNEVEN: f32 = std::f32::consts::FRAC_PI_2;

/// A step that is shorter than this part of another is none.
const NEGLIGIBLE: f32 = 1e-6;

/// Seconds of a step, and of the one before.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Steps {
    pub(crate) now: f32,
    pub(crate) before: f32,
}

impl Steps {
    fn are_even(self) -> bool {
        let Steps { now, before } = self;
        // Also if there was none, or one of them is none to speak of.
        now == before || before <= NEGLIGIBLE * now || now <= NEGLIGIBLE * before
    }
}

impl Constants {
    /// As they act in a step, if there is one to act in, on something with this reciprocal of its mass.
    pub(super) fn tuned(self, inverse_mass: impl FnOnce() -> f32) -> Self {
        let Some(steps) = self.step else { return self };
        let (inverse, dt) = (inverse_mass(), steps.now);
        let squared = 0.25 * dt * dt * self.spring * inverse;
        let damped = if self.damping > 0.0 && inverse > 0.0 {
            self.damping * decay::grown(self.damping * inverse, dt) / dt
        } else {
            self.damping
        };
        if !steps.are_even() && squared > SLOWEST {
            return self.tuned_to_uneven(steps, inverse, damped);
        }
        Constants { spring: self.spring * weaker(squared, damped * inverse * dt), damping: damped, ..self }
    }

    /// The same in a step that is not as long as the one before. What is too fast for that is damped by as much as its swing
    /// would grow by being taken for one of another frequency from step to step.
    fn tuned_to_uneven(self, Steps { now, before }: Steps, inverse: f32, damped: f32) -> Self {
        let (shorter, longer) = if now < before { (now, before) } else { (before, now) };
        let (frequency, fastest) = ((self.spring * inverse).sqrt(), FASTEST_UNEVEN / longer);
        let (frequency, kept) =
            if frequency < fastest { (frequency, 1.0) } else { (fastest, shorter / longer) };
        let next = kept * (sin(frequency * now) * before) / (sin(frequency * before) * now);
        // 1 - cos, without what that leaves of small angles.
        let pull = |step: f32| {
            let sine = sin(0.5 * frequency * step);
            2.0 * sine * sine / step
        };
        let left = 1.0 - damped * inverse * now;
        let mass = 1.0 / (inverse * now);
        Constants {
            spring: mass * (next * pull(before) + pull(now)),
            damping: mass * (1.0 - left * next),
            ..self
        }
    }
}

/// sin^2(x) / x^2, or less for what is too fast, from the square of x and the part of the velocity that damping takes away:
/// a step bears x^2 < 1 - that part / 2.
fn weaker(squared: f32, damped: f32) -> f32 {
    // Springs that push apart do not swing, and what is not finite is told elsewhere.
    if squared.is_nan() || squared <= SLOWEST {
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
