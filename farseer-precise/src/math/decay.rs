//! Exponential decay of a velocity by drag and dampers.

use wide::f32x4;

/// exp(-r t) - 1 and (1 - exp(-r t)) / r: relative change of a velocity at decay rate r (1/s) after t seconds, and the
/// time (s) over which the old velocity would cover the same distance.
///
/// exp(-r t) is computed as the reciprocal of the series of exp(r t), cut after the fourth power. So it is positive,
/// falls with the rate, and is right to 4e-8 for rates up to 0.03 / t.
pub fn decay_and_integral(rate: f32, t: f32) -> (f32, f32) {
    let x = rate * t;
    if x == 0.0 {
        return (0.0, t);
    }
    let rest = 1.0 + x * (0.5 + x * (1.0 / 6.0 + x * (1.0 / 24.0)));
    let series = x * rest;
    (-series / (1.0 + series), t * rest / (1.0 + series))
}

/// The same for four rates.
#[inline(always)]
pub fn decay_and_integral_simd(rates: f32x4, t: f32) -> (f32x4, f32x4) {
    let (one, t) = (f32x4::splat(1.0), f32x4::splat(t));
    let part = |part: f32| f32x4::splat(part);
    let x = rates * t;
    let rest = one + x * (part(0.5) + x * (part(1.0 / 6.0) + x * part(1.0 / 24.0)));
    let series = x * rest;
    let left = one / (one + series);
    (f32x4::splat(-1.0) * series * left, t * rest * left)
}

/// (1 - exp(-r t)) / r, in seconds.
pub fn decay_integral(rate: f32, t: f32) -> f32 {
    decay_and_integral(rate, t).1
}
