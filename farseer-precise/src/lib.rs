//! Solver of the precise engine: collision detection, contacts, joints and their solvers, over dense indices.

#![forbid(unsafe_code)]

mod convex_parts;
pub mod edge_adjacency;
pub mod footprint_corners;
mod former_names;
pub mod island_report;
pub mod math;
pub mod pieces;
pub mod slanted_box;
pub mod solver_choice;
pub mod storage;
pub mod surface;

#[cfg(feature = "engine")]
pub mod bodies;
#[cfg(feature = "engine")]
pub mod broad_phase;
#[cfg(feature = "engine")]
pub mod constraint_graph;
#[cfg(feature = "engine")]
pub mod contact_solver;
#[cfg(feature = "engine")]
pub mod continuous_collision;
#[cfg(feature = "engine")]
pub mod depth;
#[cfg(feature = "engine")]
pub mod direct_solver;
#[cfg(feature = "engine")]
pub mod fingerprint;
#[cfg(feature = "engine")]
pub mod integration;
#[cfg(feature = "engine")]
pub mod island;
#[cfg(feature = "engine")]
pub mod joints;
#[cfg(feature = "engine")]
mod mass;
#[cfg(feature = "engine")]
mod minimum_degree;
#[cfg(feature = "engine")]
pub mod narrow_phase;
#[cfg(feature = "engine")]
pub mod non_finite;
#[cfg(feature = "engine")]
pub mod parameters;
#[cfg(feature = "engine")]
pub mod scaled_parameters;
#[cfg(feature = "engine")]
pub mod shape;
#[cfg(feature = "engine")]
mod solver;
#[cfg(feature = "engine")]
mod sparse_ordering;
#[cfg(feature = "engine")]
pub mod step;

#[cfg(feature = "engine")]
pub use solver::Solver;
