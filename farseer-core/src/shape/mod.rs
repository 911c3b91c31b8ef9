//! Outlines and boxes (behaviour chapters 05 and 15).
pub mod aabb;
mod convex_hull;
mod creators;
mod decompose;
pub(crate) mod distance;
mod measures;
mod simplify;
mod static_tools;
mod triangulate;
pub mod vertices;

pub use aabb::Aabb;
pub use vertices::Vertices;
