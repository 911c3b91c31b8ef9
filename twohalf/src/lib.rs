//! 2.5D game physics.

#![forbid(unsafe_code)]
mod body;
mod depth;
mod draw_order;
mod error;
mod ground;
mod ground_contacts;
mod pairs;
mod projection;
mod save;
mod simulator;
mod slots;
mod step;
mod texture_id;

pub use body::TwoHalfBody;
pub use depth::DepthProfile;
pub use error::{Error, Result};
pub use ground::{Ground, GroundMut};
pub use projection::Projection;
pub use simulator::TwoHalfPhysicsSimulator;
pub use step::StepCounters;
pub use texture_id::TextureId;

pub use farseer_core;
pub use farseer_core::math::{Vector2, Vector3};
pub use farseer_core::{BodyId, Contact, Context, Event, EventHandler, GeomId, ObjectId};
