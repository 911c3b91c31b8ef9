//! What a view of a body looks through: the simulator, or the context of a callback.

use farseer_core::{Body, BodyId, PhysicsSimulator};

use crate::TwoHalfPhysicsSimulator;
use crate::events::Context;
use crate::world::World;

/// Something that holds a simulator to look at. Implemented for references to
/// [`TwoHalfPhysicsSimulator`] and [`Context`] only.
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

macro_rules! access {
    ($($type:ty),*) => {$(
        impl Access for $type {
            fn core(&self) -> &PhysicsSimulator {
                &self.core
            }
            fn world(&self) -> &World {
                &self.world
            }
        }
    )*};
}

macro_rules! access_of_context {
    ($($type:ty),*) => {$(
        impl Access for $type {
            fn core(&self) -> &PhysicsSimulator {
                self.core.simulator()
            }
            fn world(&self) -> &World {
                self.world
            }
        }
    )*};
}

access!(&TwoHalfPhysicsSimulator, &mut TwoHalfPhysicsSimulator);
access_of_context!(&Context<'_>, &mut Context<'_>);

impl AccessMut for &mut TwoHalfPhysicsSimulator {
    fn core_body_mut(&mut self, body: BodyId) -> Option<&mut Body> {
        self.core.body_mut(body)
    }
    fn world_mut(&mut self) -> &mut World {
        &mut self.world
    }
}

impl AccessMut for &mut Context<'_> {
    fn core_body_mut(&mut self, body: BodyId) -> Option<&mut Body> {
        Context::core_body_mut(self, body)
    }
    fn world_mut(&mut self) -> &mut World {
        self.world
    }
}
