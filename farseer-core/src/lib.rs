//! The 2D Farseer Physics Engine 2.1.3, bit for bit.
pub mod error;
pub mod math;
pub mod ray_helper;
pub mod shape;

mod arbiter;
mod arena;
mod body;
mod broad_phase;
mod contact;
mod events;
mod factories;
mod geom;
mod methods;
mod narrow_phase;
mod pair_table;
mod simulator;
mod solver;
mod stamped_set;

pub use body::{Body, BodyId};
pub use broad_phase::{SelectiveSweepOrder, SweepEnd};
pub use contact::{Contact, ContactId, Feature, index_of_safe};
pub use error::{Error, Result};
pub use events::{Context, Event, EventHandler};
pub use factories::{BodyFactory, GeomFactory};
pub use geom::{Geom, GeomId, GeomRef};
pub use methods::{BroadPhaseCollider, CollisionCategory, FrictionType, NarrowPhaseCollider};
pub use narrow_phase::distance_grid::DistanceGrid;
pub use pair_table::GeomPairBitmap;
pub use shape::{Aabb, Vertices};
pub use simulator::{ArbiterRef, GeomPlacement, GeomPointPair, ObjectId, PhysicsSimulator, StepCounters};
pub use solver::SurfaceContacts;
