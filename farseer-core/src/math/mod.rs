//! The engine's mathematics, exact to the bit (behaviour chapter 01).
//!
//! nalgebra gives the types; every operation whose rounding matters is written out in f32, one rounding per
//! operation, in the original's order, without fused multiply-add.

pub mod calculator;
pub mod convert_units;
pub(crate) mod finite;
pub mod interpolators;
pub mod math_helper;
pub mod matrix;
pub(crate) mod one_line;
pub mod vector2;

pub use convert_units::ConvertUnits;
pub(crate) use farseer_precise::math::lanes;
#[doc(inline)]
pub use farseer_precise::math::scalar;
pub use interpolators::{BilinearInterpolator, CircularInterpolator};
pub use one_line::OneLine;

/// A point or direction of the plane. Positions in the user's length unit, screen y down. Sums, differences and
/// comparison are its operators; everything else is in [`vector2`].
#[doc(alias("Vector2.Add", "Vector2.Subtract", "Vector2.Equals"))]
pub type Vector2 = nalgebra::Vector2<f32>;

/// A vector of three components; only `Matrix` rows are given out as such.
pub type Vector3 = nalgebra::Vector3<f32>;

/// A 4x4 matrix in row vector convention: translation in `m41`, `m42`.
/// Operations are in [`matrix`].
#[doc(alias = "Matrix.Identity")]
pub type Matrix = nalgebra::Matrix4<f32>;
