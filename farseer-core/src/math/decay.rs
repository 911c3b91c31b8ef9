//! What drag and dampers leave of a velocity.

use wide::f32x4;

/// exp(-r t) - 1 and (1 - exp(-r t)) / r. The exponential as the reciprocal of its series: positive and falling for every
/// rate, and right to 4e-8 for rates up to 0.03 / t.
pub(crate) fn over(rate: f32, t: f32) -> (f32, f32) {
    let x = rate * t;
    if x == 0.0 {
        return (0.0, t);
    }
    let rest = 1.0 + x * (0.5 + x * (1.0 / 6.0 + x * (1.0 / 24.0)));
    let series = x * rest;
    (-series / (1.0 + series), t * rest / (1.0 + series))
}

/// The same of four rates.
#[inline(always)]
pub(crate) fn over_each(rates: f32x4, t: f32) -> (f32x4, f32x4) {
    let (one, t) = (f32x4::splat(1.0), f32x4::splat(t));
    let part = |part: f32| f32x4::splat(part);
    let x = rates * t;
    let rest = one + x * (part(0.5) + x * (part(1.0 / 6.0) + x * part(1.0 / 24.0)));
    let series = x * rest;
    let left = one / (one + series);
    (f32x4::splat(-1.0) * series * left, t * rest * left)
}

/// (1 - exp(-r t)) / r.
pub(crate) fn grown(rate: f32, t: f32) -> f32 {
    over(rate, t).1
}
