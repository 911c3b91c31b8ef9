//! What a callback may do.

use farseer_core::{Body, BodyId, Geom, GeomId, ObjectId, PhysicsSimulator};

use crate::Result;
use crate::depth::{Platform, PlatformId, World};
use crate::views::{Access, AccessMut, TwoHalfBody, TwoHalfGeom};

/// What a callback may do to the simulator that calls it. How a collision goes, which callbacks of the 2D engine may set for
/// an update, cannot be set here.
#[derive(Debug)]
pub struct Context<'a> {
    pub(crate) core: farseer_core::Context<'a>,
    pub(crate) world: &'a mut World,
}

impl<'a> Context<'a> {
    /// The context of a callback that the 2D engine calls.
    pub(crate) fn within(core: &'a mut farseer_core::Context<'_>, world: &'a mut World) -> Self {
        Context { core: core.reborrow(), world }
    }

    /// A body to look at, unless the id is stale.
    pub fn body(&self, body: BodyId) -> Option<TwoHalfBody<&Self>> {
        TwoHalfBody::new(self, body)
    }

    /// A body to edit at once, unless the id is stale.
    pub fn body_mut(&mut self, body: BodyId) -> Option<TwoHalfBody<&mut Self>> {
        TwoHalfBody::new(self, body)
    }

    /// A geom to look at, unless the id is stale.
    pub fn geom(&self, geom: GeomId) -> Option<TwoHalfGeom<'_>> {
        TwoHalfGeom::new(self.core.simulator(), self.world, geom)
    }

    /// The settings of a geom to edit at once, unless the id is stale.
    pub fn geom_mut(&mut self, geom: GeomId) -> Option<&mut Geom> {
        self.core.geom_mut(geom)
    }

    /// A platform to look at, unless the id is stale.
    pub fn platform(&self, platform: PlatformId) -> Option<&Platform> {
        self.world.platforms.get(platform)
    }

    /// Lets an object take part from the next update on.
    ///
    /// # Errors
    /// A stale id.
    pub fn add(&mut self, object: impl Into<ObjectId>) -> Result<()> {
        Ok(self.core.add(object)?)
    }

    /// Takes an object out with the next update.
    ///
    /// # Errors
    /// A stale id.
    pub fn remove(&mut self, object: impl Into<ObjectId>) -> Result<()> {
        Ok(self.core.remove(object)?)
    }

    /// Ends the life of an object; its id goes stale with the next update.
    ///
    /// # Errors
    /// A stale id.
    pub fn dispose(&mut self, object: impl Into<ObjectId>) -> Result<()> {
        Ok(self.core.dispose(object)?)
    }

    /// The body in the 2D engine, to be edited.
    pub(crate) fn core_body_mut(&mut self, body: BodyId) -> Option<&mut Body> {
        self.core.body_mut(body)
    }
}

macro_rules! access {
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

access!(&Context<'_>, &mut Context<'_>);

impl AccessMut for &mut Context<'_> {
    fn core_body_mut(&mut self, body: BodyId) -> Option<&mut Body> {
        Context::core_body_mut(self, body)
    }
    fn world_mut(&mut self) -> &mut World {
        self.world
    }
}
