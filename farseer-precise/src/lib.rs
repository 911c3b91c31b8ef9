//! Solver of the precise engine: collision detection, contacts, joints and their solvers, over dense indices.
//!
//! The API is for `farseer-core` and `twohalf` and may change with them: games use one of these two. The crate knows no
//! ids, objects, events or handlers of a game. Its caller keeps a [`Solver`], writes the bodies of the game to it before
//! each step and reads them after it.
//!
//! # A step, from top to bottom
//!
//! | stage | function | parts |
//! |---|---|---|
//! | begin: length of the step, parameters in the user's length unit | [`begin_step`](Solver::begin_step) | [`scaled_parameters`] |
//! | broad phase: pairs whose fat AABBs have separated go, new ones are found | [`find_pairs`](Solver::find_pairs) | [`broad_phase`]: [`HashGrid`](broad_phase::hash_grid::HashGrid), [`Pairs`](broad_phase::pairs::Pairs) |
//! | narrow phase: manifolds of pairs that have moved, touch events | [`begin_contacts`](Solver::begin_contacts), [`find_contacts`](Solver::find_contacts) | [`narrow_phase`] |
//! | constraint graph: contacts as constraints, in graph colours and SIMD lanes | within `find_contacts` | [`constraint_graph`] |
//! | joints and springs as constraints | [`prepare`](joints::JointSystem::prepare) | [`joints`] |
//! | solver selection: islands, and the solver of each | [`solve`](Solver::solve) | [`direct_solver::selection`] |
//! | direct solver: all constraints of an island at once | within `solve` | [`direct_solver`] |
//! | articulated solver: trees of joints without contacts | within `solve` | [`joints::articulated_body`] |
//! | iterative solver: soft constraints in substeps; ballistic motion if there are none | within `solve` | [`contact_solver`], [`integration`] |
//! | continuous collision: fast bodies stop at their time of impact | [`find_fast_bodies`](Solver::find_fast_bodies), [`find_pairs_of_fast_bodies`](Solver::find_pairs_of_fast_bodies), [`clamp_to_toi`](Solver::clamp_to_toi), [`clamp_carried_motion`](Solver::clamp_carried_motion) | [`continuous_collision`] |
//! | end: new poses, refitted AABBs | [`integrate_poses`](integration::integrate_poses), [`refit_aabbs`](Solver::refit_aabbs) | [`integration`] |
//! | islands and sleep | [`accumulate_rest_time`](island::sleep::SleepState::accumulate_rest_time), [`list_falling_asleep`](island::falling_asleep::RestDetector::list_falling_asleep), [`sleep_bodies`](island::sleep::SleepState::sleep_bodies), [`sleep_pairs`](island::wake::sleep_pairs) | [`island`] |
//! | waking | [`wake_touched`](island::wake::wake_touched), [`wake_requested`](island::wake::wake_requested) | [`island::wake`] |
//!
//! With the feature `space` all stages also work in three axes: see [`depth`]. The chosen numbers of all methods are in
//! [`parameters`], each with unit and source.
//!
//! # Features
//!
//! `engine`, on by default, is the solver. Without it the crate has only the mathematics, sorting and shapes that the
//! faithful set of `farseer-core` shares with it. `space` is the depth axis, `swing` boxes that rotate about a hinge.

#![forbid(unsafe_code)]

pub mod convex_parts;
pub mod edge_adjacency;
pub mod fingerprint;
pub mod footprint_corners;
mod former_names;
pub mod index;
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
pub mod integration;
#[cfg(feature = "engine")]
pub mod island;
#[cfg(feature = "engine")]
pub mod joints;
#[cfg(feature = "engine")]
pub mod mass;
#[cfg(feature = "engine")]
pub mod minimum_degree;
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
pub mod sparse_ordering;
#[cfg(feature = "engine")]
pub mod step;

#[cfg(feature = "engine")]
pub use solver::Solver;

/// The example of the README is run with those of the documentation.
#[cfg(all(doctest, feature = "engine"))]
#[doc = include_str!("../README.md")]
struct Readme;
