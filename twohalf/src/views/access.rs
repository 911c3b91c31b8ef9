//! What a view of a body looks through: the simulator, or the context of a callback.

use farseer_core::{Body, BodyId, PhysicsSimulator};

use crate::depth::World;

/// Something that holds a simulator to look at. Implemented for references to
/// [`TwoHalfPhysicsSimulator`](crate::TwoHalfPhysicsSimulator) and [`Context`](crate::Context) only.
pub trait Access {
    #[doc(hidden)]
    fn core(&self) -> &PhysicsSimulator;
    #[doc(hidden)]
    fn world(&self) -> &World;
}

/// Something that holds a simulator to change.
pub trait AccessMut: Access {
    #[doc(hidden)]
    fn core_body_mut(&mut self, body: BodyId) -> Option<&mut Body>;
    #[doc(hidden)]
    fn world_mut(&mut self) -> &mut World;
}
