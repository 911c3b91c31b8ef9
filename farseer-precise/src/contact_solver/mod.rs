//! The [iterative solver](iterative_solver) with its contact rows ([`soft_step`]), and closed forms for polygons that roll ([`rolling`]) or pivot from vertex to
//! vertex ([`pivoting`]) over a static face.

pub(crate) mod iterative_solver;
pub(crate) mod pivoting;
pub(crate) mod pivoting_bodies;
pub(crate) mod rolling;
pub(crate) mod soft_step;
