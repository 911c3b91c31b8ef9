//! Operations on two-dimensional vectors (behaviour chapter 01, section 2).
//!
//! Sums, differences, componentwise products and products with a scalar are nalgebra's own operators: one
//! rounding per component, as in the original. What rounds in another way there is written out here.

use super::{Matrix, Vector2};

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
    Vector2::new(
        normal.x * matrix.m11 + normal.y * matrix.m21,
        normal.x * matrix.m12 + normal.y * matrix.m22,
    )
}
