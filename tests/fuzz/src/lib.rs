//! Random play with both engines, and the invariants that hold for all calls.
//!
//! The programs `fuzz` and `hashes` and the tests of this crate check the invariants. Every game follows from its seed alone.

#![forbid(unsafe_code)]

pub mod around;
mod calm;
pub mod checks;
pub mod churn;
mod depth;
mod drives;
mod engine;
#[cfg(feature = "programs")]
pub mod figures;
mod finite;
pub mod game;
pub mod hash;
#[cfg(feature = "programs")]
pub mod long_run;
mod plane;
mod random;
pub mod recording;
pub mod saves;
#[cfg(feature = "programs")]
pub mod scene_texts;
pub mod scenes;
mod shapes;
pub mod small;
pub mod soak;
#[cfg(feature = "programs")]
pub mod subjects;
pub mod textures;
mod tied;
pub mod twins;
mod upright;

pub use calm::{CalmDepth, CalmPlane};
pub use depth::Depth;
pub use engine::Engine;
pub use plane::{OneWayPlane, Plane, StagedPlane, SurfacePlane};
pub use random::Random;
pub use tied::Tied;
pub use upright::Upright;
