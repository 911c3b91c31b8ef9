//! The mathematics of the engine, exact to the bit.
//!
//! nalgebra gives the types; every operation whose rounding matters is written out in f32, one rounding per operation,
//! without fused multiply-add.

pub mod decay;
pub mod lanes;
pub mod plane;
pub mod scalar;

/// A point or direction of the plane: x right, y down.
pub type Vector2 = nalgebra::Vector2<f32>;

/// A point or direction in three axes: x right, y down, z into the picture.
pub type Vector3 = nalgebra::Vector3<f32>;
