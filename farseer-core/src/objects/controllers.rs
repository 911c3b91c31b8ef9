//! Controllers (behaviour chapter 12).

use super::Objects;
use crate::controllers::{
    Controller, ControllerId, ControllerKind, ControllerType, FluidContainerRef, WaveController,
};
use crate::error::{Error, Result};

/// Controllers.
impl Objects {
    /// Stores a controller. It acts once it is [added](Self::add).
    ///
    /// # Errors
    /// A fluid whose [container](FluidContainerRef::Wave) is stale, or is not a wave controller.
    pub fn create_controller(&mut self, controller: impl Into<Controller>) -> Result<ControllerId> {
        let controller = controller.into();
        if let ControllerKind::FluidDrag(drag) = controller.kind()
            && let FluidContainerRef::Wave(wave) = drag.container()
        {
            let argument = "container";
            let wave = self.controllers.find(argument, wave)?;
            let expected = WaveController::NAME;
            WaveController::of(wave).ok_or(Error::WrongKind { argument, expected })?;
        }
        Ok(self.controllers.create(controller))
    }

    /// A controller, unless the id is stale.
    #[inline]
    pub fn controller(&self, controller: ControllerId) -> Option<&Controller> {
        self.controllers.get(controller)
    }

    /// A controller to edit, unless the id is stale.
    #[inline]
    pub fn controller_mut(&mut self, controller: ControllerId) -> Option<&mut Controller> {
        self.controllers.get_mut(controller)
    }

    /// A controller as its own type: `simulator.controller_as::<WaveController>(sea)?.current_wave()`.
    ///
    /// # Errors
    /// A stale id; a controller of another kind.
    pub fn controller_as<C: ControllerType>(&self, controller: ControllerId) -> Result<&C> {
        let argument = "controller";
        C::of(self.controllers.find(argument, controller)?)
            .ok_or(Error::WrongKind { argument, expected: C::NAME })
    }

    /// A controller as its own type, to edit.
    ///
    /// # Errors
    /// A stale id; a controller of another kind.
    pub fn controller_as_mut<C: ControllerType>(&mut self, controller: ControllerId) -> Result<&mut C> {
        let argument = "controller";
        C::of_mut(self.controllers.find_mut(argument, controller)?)
            .ok_or(Error::WrongKind { argument, expected: C::NAME })
    }

    /// The controllers that take part, in the order in which they were added.
    #[doc(alias = "ControllerList")]
    pub fn controller_list(&self) -> &[ControllerId] {
        self.controllers.list()
    }
}

impl std::ops::Index<ControllerId> for Objects {
    type Output = Controller;
    /// # Panics
    /// If the id is stale; see [`Objects::controller`].
    fn index(&self, controller: ControllerId) -> &Controller {
        &self.controllers[controller]
    }
}

impl std::ops::IndexMut<ControllerId> for Objects {
    /// # Panics
    /// If the id is stale; see [`Objects::controller_mut`].
    fn index_mut(&mut self, controller: ControllerId) -> &mut Controller {
        &mut self.controllers[controller]
    }
}
