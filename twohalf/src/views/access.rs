//! Access of a view to its simulator: direct, or through the context of a callback.

use farseer_core::{Body, BodyId, PhysicsSimulator};

use crate::depth::World;

/// Read access to a simulator. Implemented for references to
/// [`TwoHalfPhysicsSimulator`](crate::TwoHalfPhysicsSimulator) and [`Context`](crate::Context) only.
pub trait Access: Source {}

/// Write access to a simulator.
pub trait AccessMut: Access + SourceMut {}

impl<S: Source> Access for S {}

impl<S: SourceMut> AccessMut for S {}

/// The parts of a simulator behind [`Access`]. No other crate can name this trait, so that none implements it.
pub trait Source {
    /// The 2D simulator.
    fn core(&self) -> &PhysicsSimulator;
    /// The state beside it.
    fn world(&self) -> &World;
}

/// The parts of a simulator behind [`AccessMut`].
pub trait SourceMut: Source {
    /// The body in the core; `None` for a stale id.
    fn core_body_mut(&mut self, body: BodyId) -> Option<&mut Body>;
    /// The state beside the core.
    fn world_mut(&mut self) -> &mut World;
}
