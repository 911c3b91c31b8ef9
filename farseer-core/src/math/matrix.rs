//! 4x4 matrices in row vector convention, translation in the fourth row (behaviour chapter 01, section 4).

use super::{Matrix, scalar};

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
