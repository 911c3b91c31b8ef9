//! Ready-made bodies and geoms for the 2.5D engine (thesis, appendix A).
//!
//! Factories check their arguments, choose shape and moment of inertia, create the object and add it to the
//! simulator. It takes part from the next update. Lengths are in px, masses in the user's unit. The
//! [simulator](twohalf::TwoHalfPhysicsSimulator) changes all other properties.
//!
//! | shape | moment of inertia | depth |
//! |---|---|---|
//! | circle | of a disc, m r²/2, about all three axes | a ball |
//! | ellipse, polygon, rectangle | of the flat shape, about the depth axis | a prism as deep as the shorter side of the outline's box |
//!
//! [`set_depth_profile`](twohalf::TwoHalfPhysicsSimulator::set_depth_profile) gives a geom another depth, and
//! [`Body::set_moment_of_inertia`](twohalf::farseer_core::Body::set_moment_of_inertia) gives a ball the 2/5 m
//! r² of a solid one. [`spawn`] does all of it in one call. [`Platform::new`](twohalf::Platform::new) creates
//! and adds platforms.
//!
//! ```
//! use twohalf::{DepthProfile, TwoHalfPhysicsSimulator, Vector2, Vector3};
//! use twohalf_factories::{TwoHalfBodyFactory, TwoHalfGeomFactory};
//!
//! let mut simulator = TwoHalfPhysicsSimulator::with_gravity(480, Vector2::new(0.0, 100.0))?;
//! let plank = TwoHalfBodyFactory::create_rectangle_body(&mut simulator, 80.0, 10.0, 3.0)?;
//! let geom = TwoHalfGeomFactory::create_rectangle_geom(&mut simulator, plank, 80.0, 10.0)?;
//! assert_eq!(simulator.depth_interval(geom), Some((-5.0, 5.0)));
//! simulator.set_depth_profile(geom, DepthProfile::Prism { depth: 30.0 })?;
//!
//! // Without an object geom it would fall for ever.
//! let mut view = simulator.body_mut(plank).unwrap();
//! view.ground_mut().set_object_geom(geom, None)?;
//! view.set_position3d(Vector3::new(100.0, 20.0, 50.0));
//! for _ in 0..100 {
//!     simulator.update(0.01);
//! }
//! assert!(simulator.body(plank).unwrap().is_grounded());
//! # Ok::<(), twohalf::Error>(())
//! ```

//! Recipes of common tasks of games: [`recipes`].

#![forbid(unsafe_code)]

mod actor;
mod block;
mod blow;
mod body_factory;
mod door;
mod geom_factory;
mod hands;
mod lane;
mod rope;
mod slope;
mod spawn;
mod swing_door;

#[doc = include_str!("recipes.md")]
#[doc = include_str!("recipes_of_figures.md")]
pub mod recipes {}

pub use actor::Actor;
pub use block::spawn_block;
pub use blow::{Blow, in_reach, strike};
pub use body_factory::TwoHalfBodyFactory;
pub use door::{Door, spawn_door};
pub use geom_factory::TwoHalfGeomFactory;
pub use hands::Hands;
pub use lane::spawn_lane;
pub use rope::{Rope, RopeEnd, SpawnedRope, spawn_rope};
pub use slope::spawn_slope;
pub use spawn::{Ball, Capsule, Cylinder, Figure, Prism, Spawned, Thing, spawn};
pub use swing_door::{SwingDoor, spawn_swing_door};

/// The example of the README is run with those of the documentation.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
