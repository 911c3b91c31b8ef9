//! Operations on two-dimensional vectors (behaviour chapter 01, section 2).
//!
//! Sums, differences, negation, products with a scalar and comparison are nalgebra's own operators: one rounding per
//! component, as in the original. Operations that the original rounds in another way are written out here, above all
//! [`divide_by`]: nalgebra's `/` divides each component, the original multiplies by the reciprocal.

use super::{Matrix, Vector2, math_helper, scalar};

/// (0, 0)
#[doc(alias = "Vector2.Zero")]
pub const ZERO: Vector2 = Vector2::new(0.0, 0.0);

/// (1, 1)
#[doc(alias = "Vector2.One")]
pub const ONE: Vector2 = Vector2::new(1.0, 1.0);

/// (1, 0)
#[doc(alias = "Vector2.UnitX")]
pub const UNIT_X: Vector2 = Vector2::new(1.0, 0.0);

/// (0, 1)
#[doc(alias = "Vector2.UnitY")]
pub const UNIT_Y: Vector2 = Vector2::new(0.0, 1.0);

/// `a.x * b.x + a.y * b.y`, both products rounded.
#[doc(alias = "Vector2.Dot")]
#[inline(always)]
pub fn dot(a: Vector2, b: Vector2) -> f32 {
    a.x * b.x + a.y * b.y
}

/// The depth component of the cross product, `a.x * b.y - a.y * b.x`.
#[doc(alias = "Calculator.Cross")]
#[inline(always)]
pub fn cross(a: Vector2, b: Vector2) -> f32 {
    a.x * b.y - a.y * b.x
}

/// Square of the length.
#[doc(alias = "Vector2.LengthSquared")]
#[inline(always)]
pub fn length_squared(v: Vector2) -> f32 {
    v.x * v.x + v.y * v.y
}

/// Length of a vector.
#[doc(alias = "Vector2.Length")]
#[inline(always)]
pub fn length(v: Vector2) -> f32 {
    length_squared(v).sqrt()
}

/// Square of the distance of two points.
#[doc(alias = "Vector2.DistanceSquared")]
#[inline(always)]
pub fn distance_squared(a: Vector2, b: Vector2) -> f32 {
    length_squared(a - b)
}

/// Distance of two points.
#[doc(alias = "Vector2.Distance")]
#[inline(always)]
pub fn distance(a: Vector2, b: Vector2) -> f32 {
    length(a - b)
}

/// The vector times the reciprocal of its length. The zero vector gives NaN.
#[doc(alias = "Vector2.Normalize")]
#[inline(always)]
pub fn normalize(v: Vector2) -> Vector2 {
    v * (1.0 / length(v))
}

/// A point through a matrix (row vector convention, translation in the fourth row).
#[doc(alias = "Vector2.Transform")]
#[inline(always)]
pub fn transform(point: Vector2, matrix: &Matrix) -> Vector2 {
    Vector2::new(
        point.x * matrix.m11 + point.y * matrix.m21 + matrix.m41,
        point.x * matrix.m12 + point.y * matrix.m22 + matrix.m42,
    )
}

/// A direction through a matrix: like [`transform`], without the translation.
#[doc(alias = "Vector2.TransformNormal")]
#[inline(always)]
pub fn transform_normal(normal: Vector2, matrix: &Matrix) -> Vector2 {
    Vector2::new(normal.x * matrix.m11 + normal.y * matrix.m21, normal.x * matrix.m12 + normal.y * matrix.m22)
}

/// Product, component by component.
#[doc(alias = "Vector2.Multiply")]
#[inline(always)]
pub fn multiply(a: Vector2, b: Vector2) -> Vector2 {
    Vector2::new(a.x * b.x, a.y * b.y)
}

/// Quotient, component by component.
#[doc(alias = "Vector2.Divide")]
#[inline(always)]
pub fn divide(a: Vector2, b: Vector2) -> Vector2 {
    Vector2::new(a.x / b.x, a.y / b.y)
}

/// The vector times the reciprocal of `divider`, which is not always the vector divided by it.
///
/// ```
/// use farseer_core::math::{Vector2, vector2};
/// let third = vector2::divide_by(Vector2::new(5.0, 7.0), 3.0);
/// assert_ne!(third.x, 5.0 / 3.0);
/// ```
#[doc(alias = "Vector2.Divide")]
#[inline(always)]
pub fn divide_by(v: Vector2, divider: f32) -> Vector2 {
    v * (1.0 / divider)
}

/// The vector with both signs flipped, also those of zeros.
#[doc(alias = "Vector2.Negate")]
#[inline(always)]
pub fn negate(v: Vector2) -> Vector2 {
    -v
}

/// The smaller of each pair of components; see [`scalar::min`] for ties and NaN.
#[doc(alias = "Vector2.Min")]
#[inline]
pub fn min(a: Vector2, b: Vector2) -> Vector2 {
    Vector2::new(scalar::min(a.x, b.x), scalar::min(a.y, b.y))
}

/// The greater of each pair of components; see [`scalar::max`] for ties and NaN.
#[doc(alias = "Vector2.Max")]
#[inline]
pub fn max(a: Vector2, b: Vector2) -> Vector2 {
    Vector2::new(scalar::max(a.x, b.x), scalar::max(a.y, b.y))
}

/// Each component limited to its range; see [`math_helper::clamp`].
#[doc(alias = "Vector2.Clamp")]
pub fn clamp(v: Vector2, min: Vector2, max: Vector2) -> Vector2 {
    Vector2::new(math_helper::clamp(v.x, min.x, max.x), math_helper::clamp(v.y, min.y, max.y))
}

/// Linear interpolation; see [`math_helper::lerp`].
#[doc(alias = "Vector2.Lerp")]
#[inline]
pub fn lerp(a: Vector2, b: Vector2, amount: f32) -> Vector2 {
    Vector2::new(math_helper::lerp(a.x, b.x, amount), math_helper::lerp(a.y, b.y, amount))
}

/// The point of a triangle with the given weights of its second and third corner; see
/// [`math_helper::barycentric`].
#[doc(alias = "Vector2.Barycentric")]
pub fn barycentric(a: Vector2, b: Vector2, c: Vector2, amount1: f32, amount2: f32) -> Vector2 {
    Vector2::new(
        math_helper::barycentric(a.x, b.x, c.x, amount1, amount2),
        math_helper::barycentric(a.y, b.y, c.y, amount1, amount2),
    )
}

/// Catmull-Rom interpolation from `b` to `c`; see [`math_helper::catmull_rom`].
#[doc(alias = "Vector2.CatmullRom")]
pub fn catmull_rom(a: Vector2, b: Vector2, c: Vector2, d: Vector2, amount: f32) -> Vector2 {
    Vector2::new(
        math_helper::catmull_rom(a.x, b.x, c.x, d.x, amount),
        math_helper::catmull_rom(a.y, b.y, c.y, d.y, amount),
    )
}

/// Hermite interpolation from `a` to `b`; see [`math_helper::hermite`].
#[doc(alias = "Vector2.Hermite")]
pub fn hermite(a: Vector2, tangent_a: Vector2, b: Vector2, tangent_b: Vector2, amount: f32) -> Vector2 {
    Vector2::new(
        math_helper::hermite(a.x, tangent_a.x, b.x, tangent_b.x, amount),
        math_helper::hermite(a.y, tangent_a.y, b.y, tangent_b.y, amount),
    )
}

/// Hermite interpolation with level ends; see [`math_helper::smooth_step`].
#[doc(alias = "Vector2.SmoothStep")]
pub fn smooth_step(a: Vector2, b: Vector2, amount: f32) -> Vector2 {
    Vector2::new(math_helper::smooth_step(a.x, b.x, amount), math_helper::smooth_step(a.y, b.y, amount))
}

/// The vector as the original writes it, `{X:1.5 Y:-2}`; numbers are formatted as Rust does.
#[doc(alias = "Vector2.ToString")]
pub fn to_text(v: Vector2) -> String {
    format!("{{X:{} Y:{}}}", v.x, v.y)
}

/// The original's hash code: the truncated sum of the components.
#[doc(alias = "Vector2.GetHashCode")]
pub fn hash_code(v: Vector2) -> i32 {
    scalar::to_int(v.x + v.y)
}

/// The range of the points' dot products with `axis`; `None` without points.
pub(crate) fn project_to_axis(points: &[Vector2], axis: Vector2) -> Option<(f32, f32)> {
    let first = dot(axis, *points.first()?);
    let (mut min, mut max) = (first, first);
    for &point in points {
        let d = dot(point, axis);
        if d < min {
            min = d;
        } else if d > max {
            max = d;
        }
    }
    Some((min, max))
}
