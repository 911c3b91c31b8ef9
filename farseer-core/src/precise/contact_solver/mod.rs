//! The [iterative solver](iterative_solver) with its contact rows ([`soft_step`]), and closed forms for polygons that roll ([`rolling`]) or pivot from vertex to
//! vertex ([`pivoting`]) over a static face.

pub(super) mod iterative_solver;
pub(super) mod pivoting;
pub(super) mod pivoting_bodies;
pub(super) mod rolling;
pub(super) mod soft_step;
