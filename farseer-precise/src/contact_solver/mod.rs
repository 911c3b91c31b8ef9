//! The [iterative solver](iterative_solver) with its contact rows ([`soft_step`]), and closed forms for polygons that roll
//! ([`rolling`]) or pivot from vertex to vertex ([`pivoting`]) over a static face.

pub mod held_contacts;
pub mod iterative_solver;
pub mod load_adaptation;
pub mod pair_velocities;
pub mod pivoting;
pub mod pivoting_bodies;
pub mod restitution;
pub mod rolling;
pub(crate) mod rolling_resistance;
pub mod soft_step;
pub mod warm_start;
