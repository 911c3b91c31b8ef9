//! Ready-made bodies and geoms for the 2.5D engine (thesis, appendix A).
//!
//! Factories check their arguments, pick shapes and formulas, make the object and add it to the simulator: it
//! takes part from the next update. Lengths are in px, masses in the user's unit.
//!
//! ```
//! use twohalf::{TwoHalfPhysicsSimulator, Vector2, Vector3};
//! use twohalf_factories::{TwoHalfBodyFactory, TwoHalfGeomFactory};
//!
//! let mut simulator = TwoHalfPhysicsSimulator::with_gravity(480, Vector2::new(0.0, 100.0))?;
//! let ball = TwoHalfBodyFactory::create_circle_body(&mut simulator, 20.0, 1.0)?;
//! let geom = TwoHalfGeomFactory::create_circle_geom(&mut simulator, ball, 20.0, 24)?;
//! let mut ball = simulator.body_mut(ball).unwrap();
//! ball.ground_mut().set_object_geom(geom, None)?;
//! ball.set_position3d(Vector3::new(100.0, 200.0, 50.0));
//! # Ok::<(), twohalf::Error>(())
//! ```

#![forbid(unsafe_code)]

mod body_factory;
mod geom_factory;

pub use body_factory::TwoHalfBodyFactory;
pub use geom_factory::TwoHalfGeomFactory;
