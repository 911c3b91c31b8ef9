//! Controllers in the simulator, and when they act (behaviour chapter 12).

use super::PhysicsSimulator;
use super::queues::Handler;
use crate::controllers::{
    Controller, ControllerId, ControllerKind, ControllerType, FluidContainer, FluidContainerRef,
    FluidDragController, WaveController,
};
use crate::error::{Error, Result};
use crate::events::{Context, Event};
use crate::geom::GeomId;
use crate::geom_entry::GeomEntry;
use crate::shape::Vertices;

/// Controllers.
impl PhysicsSimulator {
    /// Takes a controller in. It acts after it was [added](Self::add).
    ///
    /// # Errors
    /// A fluid whose [container](FluidContainerRef::Wave) is stale, or is no wave.
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

    /// A controller as what it is: `simulator.controller_as::<WaveController>(sea)?.current_wave()`.
    ///
    /// # Errors
    /// A stale id; a controller of another kind.
    pub fn controller_as<C: ControllerType>(&self, controller: ControllerId) -> Result<&C> {
        let argument = "controller";
        C::of(self.controllers.find(argument, controller)?)
            .ok_or(Error::WrongKind { argument, expected: C::NAME })
    }

    /// A controller as what it is, to edit.
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

    /// Lets the game's own controllers look after themselves, disabled and disposed ones as well.
    pub(super) fn validate_controllers(&mut self, handler: Handler) {
        for position in 0..self.controllers.list().len() {
            let id = self.controllers.list()[position];
            if !matches!(self.controllers[id].kind(), ControllerKind::UserDefined) {
                continue;
            }
            if let Some(user) = handler.as_mut().and_then(|handler| handler.user_controller(id)) {
                user.validate(&mut Context { simulator: self }, id);
                self.settle_edits(handler);
            }
        }
    }

    /// Controllers in list order: each is looked at when its turn comes, since one before it may have disabled or
    /// disposed it.
    pub(super) fn update_controllers(&mut self, dt: f32, dt_real: f32, handler: Handler) {
        for position in 0..self.controllers.list().len() {
            let Some((id, controller)) = self.controllers.at(position) else { continue };
            if controller.enabled() && !self.update_controller(id, dt, dt_real, handler) {
                self.events.push(Event::ControllerNotFinite { controller: id });
            }
        }
    }

    /// Answers false if the controller would have made something that is not finite.
    fn update_controller(&mut self, id: ControllerId, dt: f32, dt_real: f32, handler: Handler) -> bool {
        let PhysicsSimulator { controllers, body_list, bodies, .. } = self;
        match controllers[id].kind_mut() {
            ControllerKind::FluidDrag(_) => self.update_fluid_drag(id, handler),
            ControllerKind::Gravity(gravity) => gravity.update(body_list, bodies),
            ControllerKind::Inactivity(inactivity) => inactivity.update(dt, body_list, bodies),
            ControllerKind::Scaling(scaling) => {
                scaling.update(dt, dt_real);
                true
            }
            ControllerKind::Wave(wave) => wave.advance(dt),
            ControllerKind::UserDefined => {
                self.update_user_defined(id, dt, dt_real, handler);
                true
            }
        }
    }

    fn update_user_defined(&mut self, id: ControllerId, dt: f32, dt_real: f32, handler: Handler) {
        match handler.as_mut().and_then(|handler| handler.user_controller(id)) {
            Some(user) => {
                user.update(&mut Context { simulator: self }, id, dt, dt_real);
                self.settle_edits(handler);
            }
            None => self.events.push(Event::MissingController { controller: id }),
        }
    }

    fn update_fluid_drag(&mut self, id: ControllerId, handler: Handler) -> bool {
        let PhysicsSimulator { controllers, geoms, .. } = self;
        if let Some(drag) = FluidDragController::of_mut(&mut controllers[id]) {
            drag.geoms.retain(|&(geom, _)| geoms.contains(geom));
        }
        let mut all_finite = true;
        // Looked at anew each time: callbacks may change the controller.
        for index in 0.. {
            let Some(drag) = FluidDragController::of_mut(&mut self.controllers[id]) else { break };
            let Some(&(geom, _)) = drag.geoms.get(index) else { break };
            let container = drag.container();
            let mut submerged = std::mem::take(&mut drag.submerged);
            let found = self.submerge(id, container, geom, &mut submerged, handler);
            let mut enters = false;
            match found {
                Found::Dry => {}
                Found::Reached => {
                    let (has_entered, is_finite) = self.float(id, index, &submerged);
                    enters = has_entered;
                    all_finite &= is_finite;
                }
                Found::NoContainer => self.events.push(Event::MissingController { controller: id }),
            }
            if enters {
                self.tell_fluid_entry(id, geom, &submerged, handler);
            }
            if let Some(drag) = FluidDragController::of_mut(&mut self.controllers[id]) {
                drag.submerged = submerged;
            }
            if found == Found::NoContainer {
                break;
            }
        }
        all_finite
    }

    /// Collects the vertices of a geom that are in a fluid.
    fn submerge(
        &mut self,
        id: ControllerId,
        container: FluidContainerRef,
        geom: GeomId,
        submerged: &mut Vertices,
        handler: Handler,
    ) -> Found {
        let Some(geom) = self.geoms.get(geom) else { return Found::Dry };
        match container {
            FluidContainerRef::Aabb(mut container) => collect_submerged(&mut container, geom, submerged),
            FluidContainerRef::Wave(wave) => {
                match self.controllers.get_mut(wave).and_then(WaveController::of_mut) {
                    Some(wave) => collect_submerged(wave, geom, submerged),
                    None => Found::NoContainer,
                }
            }
            FluidContainerRef::UserDefined => {
                match handler.as_mut().and_then(|handler| handler.fluid_container(id)) {
                    Some(container) => collect_submerged(container, geom, submerged),
                    None => Found::NoContainer,
                }
            }
        }
    }

    /// Lets the fluid act on a geom. Answers whether the geom has just entered it, and whether all was finite.
    fn float(&mut self, id: ControllerId, index: usize, submerged: &Vertices) -> (bool, bool) {
        let PhysicsSimulator { controllers, geoms, bodies, .. } = self;
        let Some(drag) = FluidDragController::of_mut(&mut controllers[id]) else { return (false, true) };
        let Some(geom) = geoms.get(drag.geoms[index].0) else { return (false, true) };
        let Some(entry) = bodies.get_mut(geom.body) else { return (false, true) };
        if FluidDragController::has_left(submerged.len(), geom.local_vertices.len()) {
            drag.geoms[index].1 = false;
        }
        let Some(load) = drag.load(submerged, geom.local_vertices.get_area(), &entry.body) else {
            return (false, true);
        };
        let is_finite = load.apply_to(&mut entry.body);
        let was_in_fluid = std::mem::replace(&mut drag.geoms[index].1, true);
        (!was_in_fluid, is_finite)
    }

    fn tell_fluid_entry(
        &mut self,
        controller: ControllerId,
        geom: GeomId,
        submerged: &Vertices,
        handler: Handler,
    ) {
        let vertices = submerged.len() as u32;
        self.events.push(Event::FluidEntry { controller, geom, vertices });
        if let Some(told) = handler {
            told.on_fluid_entry(&mut Context { simulator: self }, controller, geom, submerged);
            self.settle_edits(handler);
        }
    }
}

/// What a look for a geom in a fluid has found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Found {
    /// The geom's box is out of the fluid.
    Dry,
    /// The geom's box reaches into it.
    Reached,
    NoContainer,
}

fn collect_submerged(
    container: &mut dyn FluidContainer,
    geom: &GeomEntry,
    submerged: &mut Vertices,
) -> Found {
    if !container.intersect(&geom.aabb) {
        return Found::Dry;
    }
    submerged.clear();
    submerged.extend(geom.world_vertices.iter().copied().filter(|&vertex| container.contains(vertex)));
    Found::Reached
}

impl std::ops::Index<ControllerId> for PhysicsSimulator {
    type Output = Controller;
    /// # Panics
    /// If the id is stale; see [`PhysicsSimulator::controller`].
    fn index(&self, controller: ControllerId) -> &Controller {
        &self.controllers[controller]
    }
}

impl std::ops::IndexMut<ControllerId> for PhysicsSimulator {
    /// # Panics
    /// If the id is stale; see [`PhysicsSimulator::controller_mut`].
    fn index_mut(&mut self, controller: ControllerId) -> &mut Controller {
        &mut self.controllers[controller]
    }
}
