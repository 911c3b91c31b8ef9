//! Solver of the precise engine: collision detection, contacts, joints and their solvers, over dense indices. It knows no ids
//! or objects of the game, and no events; the files beside this folder translate.

pub(in crate::precise) mod bodies;
pub(crate) mod broad_phase;
pub(in crate::precise) mod constraint_graph;
pub(in crate::precise) mod contact_solver;
pub(in crate::precise) mod continuous_collision;
pub(crate) mod depth;
pub(in crate::precise) mod direct_solver;
pub(in crate::precise) mod fingerprint;
pub(in crate::precise) mod integration;
pub(in crate::precise) mod island;
pub(in crate::precise) mod joints;
pub(in crate::precise) mod mass;
pub(in crate::precise) mod minimum_degree;
pub(in crate::precise) mod narrow_phase;
pub(in crate::precise) mod non_finite;
pub(in crate::precise) mod parameters;
pub(in crate::precise) mod scaled_parameters;
pub(in crate::precise) mod shape;
pub(in crate::precise) mod sparse_ordering;
