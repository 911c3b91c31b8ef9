//! The mathematics of the engine, exact to the bit.
//!
//! nalgebra gives the types; every operation whose rounding matters is written out in f32, one rounding per operation,
//! without fused multiply-add.

pub mod decay;
pub mod lanes;
pub mod plane;
pub mod scalar;

/// A point or direction of the plane. Positions in the user's length unit, screen y down. Sums, differences and
/// comparison are its operators; everything else is in [`vector2`].
#[doc(alias("Vector2.Add", "Vector2.Subtract", "Vector2.Equals"))]
pub type Vector2 = nalgebra::Vector2<f32>;

/// A vector of three components; only `Matrix` rows are given out as such.
pub type Vector3 = nalgebra::Vector3<f32>;
