//! Access of a view to its simulator: direct, or through the context of a callback.

use farseer_core::{Body, BodyId, PhysicsSimulator};

use crate::depth::World;

/// Read access to a simulator. Implemented for references to
/// [`TwoHalfPhysicsSimulator`](crate::TwoHalfPhysicsSimulator) and [`Context`](crate::Context) only.
pub trait Access {
    #[doc(hidden)]
    fn core(&self) -> &PhysicsSimulator;
    #[doc(hidden)]
    fn world(&self) -> &World;
}

/// Write access to a simulator.
pub trait AccessMut: Access {
    #[doc(hidden)]
    fn core_body_mut(&mut self, body: BodyId) -> Option<&mut Body>;
    #[doc(hidden)]
    fn world_mut(&mut self) -> &mut World;
}
