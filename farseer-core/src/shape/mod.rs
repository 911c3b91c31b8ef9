//! Outlines and boxes (behaviour chapters 05 and 15).
pub mod aabb;
pub mod vertices;

pub use aabb::Aabb;
pub use vertices::Vertices;
