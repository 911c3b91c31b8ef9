//! 4x4 matrices in row vector convention, translation in the fourth row (behaviour chapter 01, section 4).

use super::{Matrix, Vector3, scalar};

/// Rotation about the depth axis by an angle in radians.
#[doc(alias = "Matrix.CreateRotationZ")]
#[inline]
pub fn create_rotation_z(radians: f32) -> Matrix {
    let (s, c) = scalar::sin_cos(radians);
    #[rustfmt::skip]
    let m = Matrix::new(
          c,   s, 0.0, 0.0,
         -s,   c, 0.0, 0.0,
        0.0, 0.0, 1.0, 0.0,
        0.0, 0.0, 0.0, 1.0,
    );
    m
}

/// The identity with the given translation.
#[doc(alias = "Matrix.CreateTranslation")]
#[inline]
pub fn create_translation(x: f32, y: f32, z: f32) -> Matrix {
    let mut m = Matrix::identity();
    (m.m41, m.m42, m.m43) = (x, y, z);
    m
}

/// The first row without its last element.
#[doc(alias = "Matrix.Right")]
pub fn right(m: &Matrix) -> Vector3 {
    Vector3::new(m.m11, m.m12, m.m13)
}

/// Sets the first row but for its last element.
#[doc(alias = "Matrix.Right")]
pub fn set_right(m: &mut Matrix, right: Vector3) {
    (m.m11, m.m12, m.m13) = (right.x, right.y, right.z);
}

/// The second row without its last element.
#[doc(alias = "Matrix.Up")]
pub fn up(m: &Matrix) -> Vector3 {
    Vector3::new(m.m21, m.m22, m.m23)
}

/// Sets the second row but for its last element.
#[doc(alias = "Matrix.Up")]
pub fn set_up(m: &mut Matrix, up: Vector3) {
    (m.m21, m.m22, m.m23) = (up.x, up.y, up.z);
}

/// Rows and columns swapped.
#[doc(alias = "Matrix.Transpose")]
pub fn transpose(m: &Matrix) -> Matrix {
    m.transpose()
}

/// Sum, element by element.
#[doc(alias = "Matrix.Add")]
pub fn add(a: &Matrix, b: &Matrix) -> Matrix {
    a + b
}

/// Product: `a` is applied first, then `b` (row vector convention). The four products of an element are added
/// from left to right; nalgebra's own product may add them in another order.
#[doc(alias = "Matrix.Multiply")]
pub fn multiply(a: &Matrix, b: &Matrix) -> Matrix {
    Matrix::from_fn(|r, k| {
        a[(r, 0)] * b[(0, k)] + a[(r, 1)] * b[(1, k)] + a[(r, 2)] * b[(2, k)] + a[(r, 3)] * b[(3, k)]
    })
}

/// Inverse by cofactors. A singular matrix gives NaN or infinite elements.
///
/// ```
/// use farseer_core::math::{Vector2, matrix, vector2};
/// let m = matrix::create_translation(3.0, -4.0, 0.0);
/// let there = vector2::transform(Vector2::new(1.0, 2.0), &m);
/// assert_eq!(vector2::transform(there, &matrix::invert(&m)), Vector2::new(1.0, 2.0));
/// ```
#[doc(alias = "Matrix.Invert")]
#[rustfmt::skip]
pub fn invert(matrix: &Matrix) -> Matrix {
    // The elements by row, as in the chapter: a b c d / e f g h / i j k l / m n o p.
    let (a, b, c, d) = (matrix.m11, matrix.m12, matrix.m13, matrix.m14);
    let (e, f, g, h) = (matrix.m21, matrix.m22, matrix.m23, matrix.m24);
    let (i, j, k, l) = (matrix.m31, matrix.m32, matrix.m33, matrix.m34);
    let (m, n, o, p) = (matrix.m41, matrix.m42, matrix.m43, matrix.m44);

    let (q1, q2, q3) = (k * p - l * o, j * p - l * n, j * o - k * n);
    let (q4, q5, q6) = (i * p - l * m, i * o - k * m, i * n - j * m);

    let c1 =   f * q1 - g * q2 + h * q3;
    let c2 = -(e * q1 - g * q4 + h * q5);
    let c3 =   e * q2 - f * q4 + h * q6;
    let c4 = -(e * q3 - f * q5 + g * q6);

    let w = 1.0 / (a * c1 + b * c2 + c * c3 + d * c4);

    let (u1, u2, u3) = (g * p - h * o, f * p - h * n, f * o - g * n);
    let (u4, u5, u6) = (e * p - h * m, e * o - g * m, e * n - f * m);

    let (t1, t2, t3) = (g * l - h * k, f * l - h * j, f * k - g * j);
    let (t4, t5, t6) = (e * l - h * i, e * k - g * i, e * j - f * i);

    let (r11, r21, r31, r41) = (c1 * w, c2 * w, c3 * w, c4 * w);
    let r12 = -(b * q1 - c * q2 + d * q3) * w;
    let r22 =  (a * q1 - c * q4 + d * q5) * w;
    let r32 = -(a * q2 - b * q4 + d * q6) * w;
    let r42 =  (a * q3 - b * q5 + c * q6) * w;
    let r13 =  (b * u1 - c * u2 + d * u3) * w;
    let r23 = -(a * u1 - c * u4 + d * u5) * w;
    let r33 =  (a * u2 - b * u4 + d * u6) * w;
    let r43 = -(a * u3 - b * u5 + c * u6) * w;
    let r14 = -(b * t1 - c * t2 + d * t3) * w;
    let r24 =  (a * t1 - c * t4 + d * t5) * w;
    let r34 = -(a * t2 - b * t4 + d * t6) * w;
    let r44 =  (a * t3 - b * t5 + c * t6) * w;

    Matrix::new(
        r11, r12, r13, r14,
        r21, r22, r23, r24,
        r31, r32, r33, r34,
        r41, r42, r43, r44,
    )
}
