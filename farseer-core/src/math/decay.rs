//! What drag and dampers leave of a velocity.

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

/// (1 - exp(-r t)) / r.
pub(crate) fn grown(rate: f32, t: f32) -> f32 {
    over(rate, t).1
}
