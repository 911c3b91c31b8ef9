//! Constants and interpolation of single values (behaviour chapter 01, sections 1 and 5).

/// Euler's number.
#[doc(alias = "MathHelper.E")]
pub const E: f32 = f32::from_bits(0x402D_F854);

/// Decimal logarithm of Euler's number.
#[doc(alias = "MathHelper.Log10E")]
pub const LOG10_E: f32 = f32::from_bits(0x3EDE_5BD9);

/// Binary logarithm of Euler's number.
#[doc(alias = "MathHelper.Log2E")]
pub const LOG2_E: f32 = f32::from_bits(0x3FB8_AA3B);

/// Half a turn in radians.
#[doc(alias = "MathHelper.Pi")]
pub const PI: f32 = f32::from_bits(0x4049_0FDB);

/// A quarter turn in radians.
#[doc(alias = "MathHelper.PiOver2")]
pub const PI_OVER_2: f32 = f32::from_bits(0x3FC9_0FDB);

/// An eighth of a turn in radians.
#[doc(alias = "MathHelper.PiOver4")]
pub const PI_OVER_4: f32 = f32::from_bits(0x3F49_0FDB);

/// A full turn in radians.
#[doc(alias = "MathHelper.TwoPi")]
pub const TWO_PI: f32 = farseer_precise::math::plane::TWO_PI;

pub use super::scalar::{max, min};

/// The point of a triangle with the given weights of its second and third corner, one coordinate.
#[doc(alias = "MathHelper.Barycentric")]
pub fn barycentric(value1: f32, value2: f32, value3: f32, amount1: f32, amount2: f32) -> f32 {
    value1 + (value2 - value1) * amount1 + (value3 - value1) * amount2
}

/// Catmull-Rom interpolation from `value2` (amount 0) to `value3` (amount 1), evaluated in double precision
/// except for two products.
#[doc(alias = "MathHelper.CatmullRom")]
pub fn catmull_rom(value1: f32, value2: f32, value3: f32, value4: f32, amount: f32) -> f32 {
    let squared = f64::from(amount * amount);
    let cubed = squared * f64::from(amount);
    let linear = 2.0 * f64::from(value2) + f64::from((value3 - value1) * amount);
    let (v1, v2, v3, v4) = (f64::from(value1), f64::from(value2), f64::from(value3), f64::from(value4));
    let quadratic = 2.0 * v1 - 5.0 * v2 + 4.0 * v3 - v4;
    let cubic = 3.0 * v2 - v1 - 3.0 * v3 + v4;
    (0.5 * (linear + quadratic * squared + cubic * cubed)) as f32
}

/// The value limited to the range from `min` to `max`; `min` if they are in the wrong order. NaN stays NaN.
/// Differs from [`calculator::clamp`](super::calculator::clamp) in the sign of zero.
#[doc(alias = "MathHelper.Clamp")]
pub fn clamp(value: f32, min: f32, max: f32) -> f32 {
    let value = if value > max { max } else { value };
    if value < min { min } else { value }
}

/// Absolute difference.
#[doc(alias = "MathHelper.Distance")]
pub fn distance(value1: f32, value2: f32) -> f32 {
    (value1 - value2).abs()
}

/// Hermite interpolation from `value1` (amount 0) to `value2` (amount 1), in double precision.
#[doc(alias = "MathHelper.Hermite")]
pub fn hermite(value1: f32, tangent1: f32, value2: f32, tangent2: f32, amount: f32) -> f32 {
    if amount == 0.0 {
        return value1;
    }
    if amount == 1.0 {
        return value2;
    }
    let (v1, t1, v2, t2) = (f64::from(value1), f64::from(tangent1), f64::from(value2), f64::from(tangent2));
    let s = f64::from(amount);
    let (squared, cubed) = (s * s, s * s * s);
    let cubic = 2.0 * v1 - 2.0 * v2 + t2 + t1;
    let quadratic = 3.0 * v2 - 3.0 * v1 - 2.0 * t1 - t2;
    (cubic * cubed + quadratic * squared + t1 * s + v1) as f32
}

/// Linear interpolation, `value1 + (value2 - value1) * amount`; not exact at amount 1.
#[doc(alias = "MathHelper.Lerp")]
#[inline]
pub fn lerp(value1: f32, value2: f32, amount: f32) -> f32 {
    value1 + (value2 - value1) * amount
}

/// Hermite interpolation with level ends, the amount limited to 0 to 1.
#[doc(alias = "MathHelper.SmoothStep")]
pub fn smooth_step(value1: f32, value2: f32, amount: f32) -> f32 {
    hermite(value1, 0.0, value2, 0.0, clamp(amount, 0.0, 1.0))
}

/// Radians to degrees, in double precision.
#[doc(alias = "MathHelper.ToDegrees")]
pub fn to_degrees(radians: f32) -> f32 {
    (f64::from(radians) * 57.295_779_513_082_32) as f32
}

/// Degrees to radians, in double precision; see also
/// [`calculator::degrees_to_radians`](super::calculator::degrees_to_radians).
#[doc(alias = "MathHelper.ToRadians")]
pub fn to_radians(degrees: f32) -> f32 {
    (f64::from(degrees) * 0.017_453_292_519_943_295) as f32
}
