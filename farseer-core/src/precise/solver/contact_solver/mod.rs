//! The [iterative solver](iterative_solver) with its contact rows ([`soft_step`]), and closed forms for polygons that roll ([`rolling`]) or pivot from vertex to
//! vertex ([`pivoting`]) over a static face.

pub(in crate::precise) mod iterative_solver;
pub(in crate::precise) mod pivoting;
pub(in crate::precise) mod pivoting_bodies;
pub(in crate::precise) mod rolling;
pub(in crate::precise) mod soft_step;
