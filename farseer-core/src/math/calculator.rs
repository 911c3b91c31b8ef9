//! Cross products, angles, curves and interpolation (behaviour chapter 01, section 6).
//!
//! Angles between vectors and radians are measured here from "up", `(0, -1)`: a quarter turn is `(1, 0)`,
//! half a turn `(0, 1)`.

use super::{Vector2, math_helper, scalar, vector2};
use crate::error::{Error, Result};

/// 180 / pi, the factor from radians to degrees. The name is the original's, and the wrong way round.
#[doc(alias = "Calculator.DegreesToRadiansRatio")]
pub const DEGREES_TO_RADIANS_RATIO: f32 = f32::from_bits(0x4265_2EE1);

/// pi / 180, the factor from degrees to radians. The name is the original's, and the wrong way round.
#[doc(alias = "Calculator.RadiansToDegreesRatio")]
pub const RADIANS_TO_DEGREES_RATIO: f32 = f32::from_bits(0x3C8E_FA35);

pub use super::scalar::{acos, atan2, cos, sin};
pub use super::vector2::{cross, distance as distance_between_point_and_point};

/// The value limited to the range from `low` to `high`; `low` if they are in the wrong order. NaN stays NaN.
/// Differs from [`math_helper::clamp`] in the sign of zero.
#[doc(alias = "Calculator.Clamp")]
#[inline]
pub fn clamp(value: f32, low: f32, high: f32) -> f32 {
    scalar::max(low, scalar::min(value, high))
}

/// Bilinear interpolation between the corners of a rectangle, at the rectangle's point that is nearest to `point`:
/// `value1` at `(min.x, min.y)`, `value2` at `(min.x, max.y)`, `value3` at `(max.x, max.y)`, `value4` at `(max.x,
/// min.y)`. The result is limited to `min_value` to `max_value`; an empty rectangle gives NaN.
#[doc(alias = "Calculator.BiLerp")]
#[allow(clippy::too_many_arguments)] // The original's signature.
pub fn bi_lerp(
    point: Vector2,
    min: Vector2,
    max: Vector2,
    value1: f32,
    value2: f32,
    value3: f32,
    value4: f32,
    min_value: f32,
    max_value: f32,
) -> f32 {
    let nearest = vector2::clamp(point, min, max);
    let x_ratio = (nearest.x - min.x) / (max.x - min.x);
    let y_ratio = (nearest.y - min.y) / (max.y - min.y);
    let at_min_y = math_helper::lerp(value1, value4, x_ratio);
    let at_max_y = math_helper::lerp(value2, value3, x_ratio);
    math_helper::clamp(math_helper::lerp(at_min_y, at_max_y, y_ratio), min_value, max_value)
}

/// Distance of a point from the segment between two points.
#[doc(alias = "Calculator.DistanceBetweenPointAndLineSegment")]
pub fn distance_between_point_and_line_segment(
    point: Vector2,
    end_point1: Vector2,
    end_point2: Vector2,
) -> f32 {
    let v = end_point2 - end_point1;
    let w = point - end_point1;
    let c1 = vector2::dot(w, v);
    if c1 <= 0.0 {
        return vector2::length(point - end_point1);
    }
    let c2 = vector2::dot(v, v);
    if c2 <= c1 {
        return vector2::length(point - end_point2);
    }
    vector2::length(point - (end_point1 + v * (c1 / c2)))
}

/// Cross product of a vector of the plane with one along the depth axis, `(s * v.y, -s * v.x)`.
#[doc(alias = "Calculator.Cross")]
#[inline]
pub fn cross_vector_scalar(v: Vector2, s: f32) -> Vector2 {
    Vector2::new(s * v.y, -s * v.x)
}

/// Cross product of a vector along the depth axis with one of the plane, `(-s * v.y, s * v.x)`.
#[doc(alias = "Calculator.Cross")]
#[inline]
pub fn cross_scalar_vector(s: f32, v: Vector2) -> Vector2 {
    Vector2::new(-s * v.y, s * v.x)
}

/// Projection of `project_vector` onto `on_to_vector`; zero if that is zero.
#[doc(alias = "Calculator.Project")]
pub fn project(project_vector: Vector2, on_to_vector: Vector2) -> Vector2 {
    let numerator = vector2::dot(on_to_vector, project_vector);
    let denominator = vector2::dot(on_to_vector, on_to_vector);
    on_to_vector * if denominator != 0.0 { numerator / denominator } else { 0.0 }
}

/// The vector, shortened to `max_length` if it is longer. As in the original **the argument is normalised on
/// the way**, unless the resulting length is not greater than 0.
#[doc(alias = "Calculator.Truncate")]
pub fn truncate(vector: &mut Vector2, max_length: f32) -> Vector2 {
    let length = scalar::min(vector2::length(*vector), max_length);
    if length > 0.0 {
        *vector = vector2::normalize(*vector);
    }
    *vector * length
}

/// Degrees to radians in single precision; see also [`math_helper::to_radians`].
#[doc(alias = "Calculator.DegreesToRadians")]
pub fn degrees_to_radians(degrees: f32) -> f32 {
    degrees * RADIANS_TO_DEGREES_RATIO
}

/// A number from `min` to `max`. `uniform` is a random number, at least 0 and below 1: the original draws it from a
/// clock-seeded generator, here the caller brings one.
#[doc(alias = "Calculator.RandomNumber")]
pub fn random_number(min: f32, max: f32, uniform: f64) -> f32 {
    (f64::from(max - min) * uniform + f64::from(min)) as f32
}

/// Whether a number lies between two others and is neither of them.
#[doc(alias = "Calculator.IsBetweenNonInclusive")]
pub fn is_between_non_inclusive(number: f32, min: f32, max: f32) -> bool {
    number > min && number < max
}

/// Direction of a vector in radians from "up"; pi for the zero vector.
#[doc(alias = "Calculator.VectorToRadians")]
pub fn vector_to_radians(vector: Vector2) -> f32 {
    scalar::atan2(vector.x, -vector.y)
}

/// The vector of length 1 in a direction in radians from "up".
#[doc(alias = "Calculator.RadiansToVector")]
pub fn radians_to_vector(radians: f32) -> Vector2 {
    let (sin, cos) = scalar::sin_cos(radians);
    Vector2::new(sin, -cos)
}

/// The vector rotated by `radians`, computed from its angle and length.
#[doc(alias = "Calculator.RotateVector")]
pub fn rotate_vector(vector: Vector2, radians: f32) -> Vector2 {
    let length = vector2::length(vector);
    radians_to_vector(vector_to_radians(vector) + radians) * length
}

/// The point at `t`, 0 to 1, of the segment from `start` to `end`.
#[doc(alias = "Calculator.LinearBezierCurve")]
pub fn linear_bezier_curve(start: Vector2, end: Vector2, t: f32) -> Vector2 {
    start + (end - start) * t
}

/// The point at `t`, 0 to 1, of a quadratic Bezier curve.
#[doc(alias = "Calculator.QuadraticBezierCurve")]
pub fn quadratic_bezier_curve(start: Vector2, curve: Vector2, end: Vector2, t: f32) -> Vector2 {
    let u = 1.0 - t;
    start * (u * u) + curve * (2.0 * t * u) + end * (t * t)
}

/// The point at `t` of a quadratic Bezier curve and the curve's direction there in radians from "up". The
/// point is found by repeated division and may differ in the last bit from [`quadratic_bezier_curve`].
#[doc(alias = "Calculator.QuadraticBezierCurve")]
pub fn quadratic_bezier_curve_with_radians(
    start: Vector2,
    curve: Vector2,
    end: Vector2,
    t: f32,
) -> (Vector2, f32) {
    let l = linear_bezier_curve(start, curve, t);
    let m = linear_bezier_curve(curve, end, t);
    let direction = m - l;
    (l + direction * t, vector_to_radians(direction))
}

/// The point at `t`, 0 to 1, of a cubic Bezier curve.
#[doc(alias = "Calculator.CubicBezierCurve")]
pub fn cubic_bezier_curve(start: Vector2, curve1: Vector2, curve2: Vector2, end: Vector2, t: f32) -> Vector2 {
    let u = 1.0 - t;
    let (t2, u2) = (t * t, u * u);
    start * (u * u2) + curve1 * (3.0 * t * u2) + curve2 * (3.0 * t2 * u) + end * (t * t2)
}

/// The point at `t` of a cubic Bezier curve and the curve's direction there in radians from "up"; see
/// [`quadratic_bezier_curve_with_radians`].
#[doc(alias = "Calculator.CubicBezierCurve")]
pub fn cubic_bezier_curve_with_radians(
    start: Vector2,
    curve1: Vector2,
    curve2: Vector2,
    end: Vector2,
    t: f32,
) -> (Vector2, f32) {
    let p = linear_bezier_curve(start, curve1, t);
    let q = linear_bezier_curve(curve1, curve2, t);
    let r = linear_bezier_curve(curve2, end, t);
    quadratic_bezier_curve_with_radians(p, q, r, t)
}

/// The point at `t` of a cubic Bezier curve whose control points are given relative to its ends.
#[doc(alias = "Calculator.CubicBezierCurve2")]
pub fn cubic_bezier_curve2(
    start: Vector2,
    start_points_to: Vector2,
    end: Vector2,
    end_points_to: Vector2,
    t: f32,
) -> Vector2 {
    cubic_bezier_curve(start, start + start_points_to, end + end_points_to, end, t)
}

/// Point and direction at `t` of a cubic Bezier curve whose control points are given relative to its ends.
#[doc(alias = "Calculator.CubicBezierCurve2")]
pub fn cubic_bezier_curve2_with_radians(
    start: Vector2,
    start_points_to: Vector2,
    end: Vector2,
    end_points_to: Vector2,
    t: f32,
) -> (Vector2, f32) {
    cubic_bezier_curve_with_radians(start, start + start_points_to, end + end_points_to, end, t)
}

/// Point and direction at `t` of a cubic Bezier curve whose control points are given by direction (radians
/// from "up") and distance. As in the original they are relative to the origin, **not** to the curve's ends.
#[doc(alias = "Calculator.CubicBezierCurve2")]
pub fn cubic_bezier_curve2_with_directions(
    start: Vector2,
    (start_point_direction, start_point_length): (f32, f32),
    end: Vector2,
    (end_point_direction, end_point_length): (f32, f32),
    t: f32,
) -> (Vector2, f32) {
    let curve1 = radians_to_vector(start_point_direction) * start_point_length;
    let curve2 = radians_to_vector(end_point_direction) * end_point_length;
    cubic_bezier_curve_with_radians(start, curve1, curve2, end, t)
}

/// Linear interpolation of two directions, normalised. Opposite ones give NaN half way.
#[doc(alias = "Calculator.InterpolateNormal")]
pub fn interpolate_normal(vector1: Vector2, vector2: Vector2, t: f32) -> Vector2 {
    vector2::normalize(linear_bezier_curve(vector1, vector2, t))
}

/// Interpolation of two angles in radians, along the chord between their directions.
#[doc(alias = "Calculator.InterpolateRotation")]
pub fn interpolate_rotation(radians1: f32, radians2: f32, t: f32) -> f32 {
    vector_to_radians(interpolate_normal(radians_to_vector(radians1), radians_to_vector(radians2), t))
}

/// The range of the points' dot products with `axis`, **which is normalised in place**: `(min, max)`.
///
/// A list without points; the axis is normalised all the same.
#[doc(alias = "Calculator.ProjectToAxis")]
pub fn project_to_axis(points: &[Vector2], axis: &mut Vector2) -> Result<(f32, f32)> {
    *axis = vector2::normalize(*axis);
    vector2::project_to_axis(points, *axis)
        .ok_or_else(|| Error::invalid("points", points, "a list of one point or more"))
}
