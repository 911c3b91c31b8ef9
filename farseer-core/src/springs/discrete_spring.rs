//! Springs of the precise set whose frequency and damping do not depend on the step.
//!
//! Symplectic Euler computes a force once per step, which changes the velocity before the bodies move. A spring then
//! keeps its amplitude, but not its frequency. Let w² = k / m with m the effective mass, and h the step. The spring
//! swings with the angular frequency w', sin(w' h / 2) = w h / 2: too fast, and unstable from w h = 2 on. The corrected
//! constant k' = k sin²(x) / x², x = w h / 2, gives the frequency w. The damping of a step is that of a damper over its
//! time: it removes the fraction 1 - exp(-c h / m) of the velocity.
//!
//! For steps of unequal length this is not enough: the constant of each step alone would let the spring gain energy
//! without bound. There the velocity u of the next step follows from displacement x, last velocity and both steps: h,
//! and g the one before. From x(t + h) = x cos(w h) + v sin(w h) / w, and the same back by g, it is
//!
//! u' = r u - x (r (1 - cos w g) / g + (1 - cos w h) / h), where r = (sin(w h) / w h) / (sin(w g) / w g).
//!
//! So the spring swings with w whatever the steps are; for equal steps the formula is that with k'.

use super::SpringConstants;
use crate::body::Body;
use crate::math::Vector2;
use crate::math::scalar::sin;
use crate::math::vector2::cross;
use farseer_precise::math::decay;

/// Maximum half phase x = w h / 2 of a step, in radians: faster springs are computed with this x. A step resolves at
/// most half an oscillation, x = pi/2. Chosen; no range measured.
const MAX_HALF_PHASE: f32 = 1.4;

/// Square of the half phase x, in radians², up to which the correction is less than the last digit and left out.
const MIN_HALF_PHASE_SQUARED: f32 = 1e-8;

/// Fraction of the stable limit of x² that is used, dimensionless. Chosen; no range measured.
const STABLE_FRACTION: f32 = 0.97;

/// Maximum phase w h, in radians, of the longer of two unequal steps: a quarter of an oscillation. Faster springs are
/// computed with this phase.
const MAX_UNEVEN_PHASE: f32 = std::f32::consts::FRAC_PI_2;

/// Ratio of two successive steps below which the shorter one is ignored, dimensionless.
const MIN_STEP_RATIO: f32 = 1e-6;

/// Lengths of a step and of the one before, in seconds.
#[derive(Debug, Clone, Copy)]
pub(crate) struct StepLengths {
    pub(crate) now: f32,
    pub(crate) before: f32,
}

impl StepLengths {
    fn are_even(self) -> bool {
        let StepLengths { now, before } = self;
        // Steps count as even, too, if there was no step before, or if one of them is negligible.
        now == before || before <= MIN_STEP_RATIO * now || now <= MIN_STEP_RATIO * before
    }
}

impl SpringConstants {
    /// The constants for a step, if a step is known. `inverse_mass` returns the reciprocal of the effective mass.
    pub(super) fn for_step(self, inverse_mass: impl FnOnce() -> f32) -> Self {
        let Some(steps) = self.step else { return self };
        let (inverse, dt) = (inverse_mass(), steps.now);
        let squared = 0.25 * dt * dt * self.spring * inverse;
        let damped = if self.damping > 0.0 && inverse > 0.0 {
            self.damping * decay::decay_integral(self.damping * inverse, dt) / dt
        } else {
            self.damping
        };
        if !steps.are_even() && squared > MIN_HALF_PHASE_SQUARED {
            return self.for_uneven_steps(steps, inverse, damped);
        }
        SpringConstants {
            spring: self.spring * stiffness_factor(squared, damped * inverse * dt),
            damping: damped,
            ..self
        }
    }

    /// The constants for a step that is not as long as the one before. A spring that is too fast for it is computed
    /// with a lower frequency, and damped by as much as its amplitude would grow through that.
    fn for_uneven_steps(self, StepLengths { now, before }: StepLengths, inverse: f32, damped: f32) -> Self {
        let (shorter, longer) = if now < before { (now, before) } else { (before, now) };
        let (frequency, fastest) = ((self.spring * inverse).sqrt(), MAX_UNEVEN_PHASE / longer);
        let (frequency, kept) =
            if frequency < fastest { (frequency, 1.0) } else { (fastest, shorter / longer) };
        let next = kept * (sin(frequency * now) * before) / (sin(frequency * before) * now);
        // 1 - cos as 2 sin², without the loss of digits for small angles.
        let pull = |step: f32| {
            let sine = sin(0.5 * frequency * step);
            2.0 * sine * sine / step
        };
        let left = 1.0 - damped * inverse * now;
        let mass = 1.0 / (inverse * now);
        SpringConstants {
            spring: mass * (next * pull(before) + pull(now)),
            damping: mass * (1.0 - left * next),
            ..self
        }
    }
}

/// sin²(x) / x², or less for a spring that is too fast. `squared` is x², `damped` the fraction of the velocity that
/// damping removes. A step is stable for x² < 1 - damped / 2.
fn stiffness_factor(squared: f32, damped: f32) -> f32 {
    // Springs with a negative constant do not oscillate; values that are not finite are reported elsewhere.
    if squared.is_nan() || squared <= MIN_HALF_PHASE_SQUARED {
        return 1.0;
    }
    let x = squared.sqrt();
    let sine = sin(if x < MAX_HALF_PHASE { x } else { MAX_HALF_PHASE });
    let (swing, stable_limit) = (sine * sine, STABLE_FRACTION * (1.0 - 0.5 * damped));
    (if swing < stable_limit { swing } else { stable_limit }) / squared
}

/// Reciprocal of the effective mass of a body at an offset, along a direction, in 1/mass units.
pub(super) fn inverse_mass_at(body: &Body, arm: Vector2, direction: Vector2) -> f32 {
    if body.is_immovable() {
        return 0.0;
    }
    let turning = cross(arm, direction);
    body.inverse_mass() + body.inverse_moment_of_inertia() * turning * turning
}

/// Reciprocal of the moment of inertia of a body, 0 for an immovable one.
pub(super) fn inverse_inertia(body: &Body) -> f32 {
    if body.is_immovable() { 0.0 } else { body.inverse_moment_of_inertia() }
}
