//! Context of a callback: access to the simulator that calls it.

use farseer_core::{Body, BodyId, Geom, GeomId, ObjectId, PhysicsSimulator};

use crate::Result;
use crate::depth::{Platform, PlatformId, World};
use crate::views::access::{Source, SourceMut};
use crate::views::{TwoHalfBody, TwoHalfGeom};

/// Access of a callback to the simulator that calls it. The outcome of a single collision, which callbacks of
/// the core may set for an update, cannot be set here.
#[derive(Debug)]
pub struct Context<'a> {
    pub(crate) core: farseer_core::Context<'a>,
    pub(crate) world: &'a mut World,
}

impl<'a> Context<'a> {
    /// The context of a callback that the core calls.
    pub(crate) fn within(core: &'a mut farseer_core::Context<'_>, world: &'a mut World) -> Self {
        Context { core: core.reborrow(), world }
    }

    /// A body for reading; `None` for a stale id.
    pub fn body(&self, body: BodyId) -> Option<TwoHalfBody<&Self>> {
        TwoHalfBody::new(self, body)
    }

    /// A body for editing at once; `None` for a stale id.
    pub fn body_mut(&mut self, body: BodyId) -> Option<TwoHalfBody<&mut Self>> {
        TwoHalfBody::new(self, body)
    }

    /// A geom for reading; `None` for a stale id.
    pub fn geom(&self, geom: GeomId) -> Option<TwoHalfGeom<'_>> {
        TwoHalfGeom::new(self.core.simulator(), self.world, geom)
    }

    /// The settings of a geom for editing at once; `None` for a stale id.
    pub fn geom_mut(&mut self, geom: GeomId) -> Option<&mut Geom> {
        self.core.geom_mut(geom)
    }

    /// A platform for reading; `None` for a stale id.
    pub fn platform(&self, platform: PlatformId) -> Option<&Platform> {
        self.world.platforms.get(platform)
    }

    /// Adds an object with the next update.
    ///
    /// # Errors
    /// A stale id.
    pub fn add(&mut self, object: impl Into<ObjectId>) -> Result<()> {
        Ok(self.core.add(object)?)
    }

    /// Removes an object with the next update.
    ///
    /// # Errors
    /// A stale id.
    pub fn remove(&mut self, object: impl Into<ObjectId>) -> Result<()> {
        Ok(self.core.remove(object)?)
    }

    /// Disposes an object; its id goes stale with the next update.
    ///
    /// # Errors
    /// A stale id.
    pub fn dispose(&mut self, object: impl Into<ObjectId>) -> Result<()> {
        Ok(self.core.dispose(object)?)
    }

    /// The body in the core, for editing.
    pub(crate) fn core_body_mut(&mut self, body: BodyId) -> Option<&mut Body> {
        self.core.body_mut(body)
    }
}

macro_rules! access {
    ($($type:ty),*) => {$(
        impl Source for $type {
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

impl SourceMut for &mut Context<'_> {
    fn core_body_mut(&mut self, body: BodyId) -> Option<&mut Body> {
        Context::core_body_mut(self, body)
    }
    fn world_mut(&mut self) -> &mut World {
        self.world
    }
}
