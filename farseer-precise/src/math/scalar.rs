//! Scalar operations whose corner cases differ from Rust's own (behaviour chapter 01, section 1).
//!
//! `f32::max`, `f32::min`, `f32::signum`, `as i32` and the platform's trigonometry all give other bits
//! than Farseer in some corner (NaN, signed zeros, saturation, last digit), so the engine uses these.

/// The greater of two values. Equal values give the **second** one, a NaN on either side gives NaN.
///
/// ```
/// use farseer_precise::math::scalar::max;
/// assert!(max(0.0, -0.0).is_sign_negative());
/// ```
#[doc(alias = "Math.Max")]
#[inline(always)]
pub fn max(a: f32, b: f32) -> f32 {
    if a > b || a.is_nan() { a } else { b }
}

/// The smaller of two values. Equal values give the **second** one, a NaN on either side gives NaN.
#[doc(alias = "Math.Min")]
#[inline(always)]
pub fn min(a: f32, b: f32) -> f32 {
    if a < b || a.is_nan() { a } else { b }
}

/// -1, 0 or 1. Both zeros give 0, and so does NaN, for which the original throws.
#[doc(alias = "Math.Sign")]
#[inline(always)]
pub fn sign(x: f32) -> f32 {
    f32::from(i8::from(x > 0.0) - i8::from(x < 0.0))
}

/// The finite number that is nearest to a value; for NaN the greatest. It makes infinite results displayable. Not in
/// the original.
///
/// ```
/// use farseer_precise::math::scalar::nearest_finite;
/// assert_eq!(nearest_finite(2.5), 2.5);
/// assert_eq!(nearest_finite(f32::NEG_INFINITY), f32::MIN);
/// assert_eq!(nearest_finite(f32::NAN), f32::MAX);
/// ```
#[inline(always)]
pub fn nearest_finite(value: f32) -> f32 {
    if value.is_nan() { f32::MAX } else { value.clamp(f32::MIN, f32::MAX) }
}

/// Truncation toward zero; NaN and all values outside the range of `i32` give `i32::MIN`.
#[inline(always)]
pub fn to_int(x: f32) -> i32 {
    to_int_f64(f64::from(x))
}

/// [`to_int`] of a double.
#[inline(always)]
pub fn to_int_f64(x: f64) -> i32 {
    if x > -2_147_483_649.0 && x < 2_147_483_648.0 { x as i32 } else { i32::MIN }
}

/// Argument, in radians, from which on the original's processor instruction returned the argument itself.
const ARGUMENT_LIMIT: f64 = 9_223_372_036_854_775_808.0;

/// Sine of an angle in radians, evaluated in double precision by a portable implementation and rounded once.
/// Arguments of 2^63 and more come back unchanged, as in the original.
#[doc(alias("Calculator.Sin", "Math.Sin"))]
#[inline]
pub fn sin(angle: f32) -> f32 {
    let x = f64::from(angle);
    if x.abs() >= ARGUMENT_LIMIT && x.is_finite() { angle } else { libm::sin(x) as f32 }
}

/// Cosine of an angle in radians; see [`sin`].
#[doc(alias("Calculator.Cos", "Math.Cos"))]
#[inline]
pub fn cos(angle: f32) -> f32 {
    let x = f64::from(angle);
    if x.abs() >= ARGUMENT_LIMIT && x.is_finite() { angle } else { libm::cos(x) as f32 }
}

/// Sine and cosine of an angle in radians; see [`sin`].
#[inline]
pub fn sin_cos(angle: f32) -> (f32, f32) {
    let x = f64::from(angle);
    if x.abs() >= ARGUMENT_LIMIT && x.is_finite() {
        return (angle, angle);
    }
    sin_cos_of_any(angle)
}

/// Sine and cosine of any angle in radians. From 2^63 on the original, and [`sin_cos`] with it, returns the angle
/// itself; this function is for features that the original does not have.
#[inline]
pub fn sin_cos_of_any(angle: f32) -> (f32, f32) {
    let (s, c) = libm::sincos(f64::from(angle));
    (s as f32, c as f32)
}

/// Angle of the vector `(x, y)` in radians, evaluated in double precision and rounded once.
#[doc(alias("Calculator.ATan2", "Math.Atan2"))]
#[inline]
pub fn atan2(y: f32, x: f32) -> f32 {
    libm::atan2(f64::from(y), f64::from(x)) as f32
}

/// Arc tangent in radians, evaluated in double precision and rounded once.
#[inline]
pub fn atan(x: f32) -> f32 {
    libm::atan(f64::from(x)) as f32
}

/// Arc cosine in radians, evaluated in double precision and rounded once; NaN outside -1 to 1.
#[doc(alias = "Calculator.ACos")]
#[inline]
pub fn acos(x: f32) -> f32 {
    libm::acos(f64::from(x)) as f32
}
