//! Rotation of a body in a substep: cosine and sine, and their nonlinear part.

/// Returns cosine and sine of the rotation of a body in a substep. `angle` is in radians.
///
/// Angles of up to 1 radian use a Taylor series. Its error is below 1e-10 for less than 0.3 radians.
#[inline(always)]
pub(super) fn cos_sin(angle: f64) -> [f64; 2] {
    if angle * angle > 1.0 {
        let (sine, cosine) = libm::sincos(angle);
        return [cosine, sine];
    }
    let x = angle * angle;
    let sine = angle * (1.0 - x * (1.0 / 6.0) * (1.0 - x * (1.0 / 20.0) * (1.0 - x * (1.0 / 42.0))));
    let cosine =
        1.0 - x * 0.5 * (1.0 - x * (1.0 / 12.0) * (1.0 - x * (1.0 / 30.0) * (1.0 - x * (1.0 / 56.0))));
    [cosine, sine]
}

/// Returns [cosine, sine minus the angle] of a rotation by `angle` radians. Applied to a vector r this is the rotated vector
/// minus the linear displacement `angle` * (-r.y, r.x) of its end.
///
/// The truncated series has an error of 1e-6 of the length of r at 0.3 radians; the next substep corrects it.
#[inline(always)]
pub(super) fn nonlinear_rotation(angle: f64) -> [f64; 2] {
    if angle * angle > 1.0 {
        let [cosine, sine] = cos_sin(angle);
        return [cosine, sine - angle];
    }
    let x = angle * angle;
    [1.0 - x * (0.5 - x * (1.0 / 24.0)), -angle * x * (1.0 / 6.0 - x * (1.0 / 120.0))]
}
