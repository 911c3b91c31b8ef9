//! The 2D Farseer Physics Engine 2.1.3 in Rust, exact to the bit.
//!
//! Farseer Physics (2009) was the 2D physics engine of the XNA years. This crate reproduces what it did, number by
//! number, behind an API its users recognise. In this order it wants to be:
//!
//! 1. **exact**: given the same calls, every position, velocity and callback is that of the original, on every
//!    platform, in every build;
//! 2. **safe**: bad input is an error that names the argument, a failed call changes nothing, NaN never spreads,
//!    stale ids are noticed;
//! 3. **fast**: flat arrays that are reused, no allocation in a settled scene, and whatever can be computed side by
//!    side without changing a bit is.
//!
//! # A first program
//!
//! ```
//! use farseer_core::{BodyFactory, GeomFactory, GeomPlacement, PhysicsSimulator, math::Vector2};
//!
//! // Pixels and seconds; y points down, as on the screen.
//! let mut simulator = PhysicsSimulator::new(Vector2::new(0.0, 150.0))?;
//!
//! let floor = BodyFactory::create_rectangle_body_in(&mut simulator, 400.0, 20.0, 1.0)?;
//! simulator[floor].set_is_static(true);
//! simulator[floor].set_position(Vector2::new(0.0, 200.0));
//! GeomFactory::create_rectangle_geom_in(&mut simulator, floor, 400.0, 20.0, GeomPlacement::default())?;
//!
//! let ball = BodyFactory::create_circle_body_in(&mut simulator, 10.0, 1.0)?;
//! let geom = GeomFactory::create_circle_geom_in(&mut simulator, ball, 10.0, 16, GeomPlacement::default())?;
//! simulator[geom].set_restitution_coefficient(0.5);
//!
//! for _ in 0..500 {
//!     simulator.update(0.01);
//! }
//! assert!((simulator[ball].position().y - 180.0).abs() < 0.5);
//! # Ok::<(), farseer_core::Error>(())
//! ```
//!
//! # What an update does
//!
//! [`PhysicsSimulator::update`] is a list of stages, each of which can be called on its own by engines built on top:
//!
//! | stage | what happens | chosen by |
//! |---|---|---|
//! | [`process_queues`](PhysicsSimulator::process_queues) | objects enter and leave | |
//! | [`find_pairs`](PhysicsSimulator::find_pairs) | which boxes overlap | [`BroadPhaseCollider`] |
//! | [`collide_pairs`](PhysicsSimulator::collide_pairs) | where shapes touch | [`NarrowPhaseCollider`] |
//! | [`apply_forces`](PhysicsSimulator::apply_forces) | impulses, gravity and drag become velocity | |
//! | [`pre_step`](PhysicsSimulator::pre_step), [`solve_iteration`](PhysicsSimulator::solve_iteration) | contacts push and rub | [`iterations`](PhysicsSimulator::set_iterations) |
//! | [`integrate`](PhysicsSimulator::integrate) | velocity becomes position | |
//!
//! Between the stages such an engine may [filter pairs](EventHandler::accepts_pair), take
//! [arbiters](PhysicsSimulator::leave_to_engine) over and work on [the velocities](PhysicsSimulator::solver_place) the
//! solver has.
//!
//! # Units and axes
//!
//! Lengths are in whatever unit the user takes for them (pixels or metres), seconds, radians and any unit of mass;
//! be consistent. Axes are those of the screen: x right, y down, so that positive angles turn clockwise to the eye.
//!
//! # Where the methods fail
//!
//! They fail where the original's did. With its default of 5 iterations a stack of ten boxes does not stand; what
//! is faster than the thickness of a wall per step goes through it; the distance grid sees nothing thinner than its
//! cells; SAT is for convex outlines. Far from the origin f32 runs out of digits.
//!
//! Joints, springs, controllers, paths and the remaining polygon tools of Farseer are not there yet. The documents
//! in `docs/farseer-2.1.3` of the repository say what the original does in every detail; the rustdoc refers to them
//! as *behaviour chapters*.

#![forbid(unsafe_code)]

pub mod error;
pub mod math;
pub mod ray_helper;
pub mod shape;

mod arbiter;
mod arena;
mod bits;
mod body;
mod body_entry;
mod broad_phase;
mod contact;
mod events;
mod factories;
mod geom;
mod geom_entry;
mod geom_ref;
mod methods;
mod narrow_phase;
mod object_id;
mod pair_filter;
mod pair_id;
mod pair_table;
mod simulator;
mod solver;
mod stamped_set;

pub use arbiter::ArbiterRef;
pub use body::{Body, BodyId};
pub use broad_phase::{SelectiveSweepOrder, SweepEnd};
pub use contact::{Contact, ContactId, Feature, index_of_safe};
pub use error::{Error, Result};
pub use events::{Context, Event, EventHandler};
pub use factories::{BodyFactory, GeomFactory};
pub use geom::{Geom, GeomId};
pub use geom_ref::GeomRef;
pub use methods::{BroadPhaseCollider, CollisionCategory, FrictionType, NarrowPhaseCollider};
pub use narrow_phase::distance_grid::DistanceGrid;
pub use object_id::ObjectId;
pub use pair_id::PairId;
pub use pair_table::GeomPairBitmap;
pub use shape::{Aabb, Vertices};
pub use simulator::{GeomPlacement, GeomPointPair, PhysicsSimulator, StepCounters};
pub use solver::{SolverBody, SolverPlace};
