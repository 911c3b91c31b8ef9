//! Calls of controllers in an update (behaviour chapter 12).

use super::PhysicsSimulator;
use super::callbacks::Handler;
use crate::controllers::{
    ControllerId, ControllerKind, ControllerType, FluidContainer, FluidContainerRef, FluidDragController,
    WaveController,
};
use crate::geom::GeomId;
use crate::geom::entry::GeomEntry;
use crate::objects::Objects;
use crate::report::Event;
use crate::shape::Vertices;

impl PhysicsSimulator {
    /// Calls `validate` of the game's own controllers, also of disabled and disposed ones.
    pub(super) fn validate_controllers(&mut self, handler: &mut Handler<'_>) {
        for position in 0..self.controller_list().len() {
            let id = self.controller_list()[position];
            if !matches!(self.objects.controllers[id].kind(), ControllerKind::UserDefined) {
                continue;
            }
            self.call_handler(handler, |handler, context| {
                if let Some(user) = handler.user_controller(id) {
                    user.validate(context, id);
                }
            });
        }
    }

    /// Updates controllers in list order. The state of each is read when its turn comes, since an earlier one may have
    /// disabled or disposed it.
    pub(super) fn update_controllers(&mut self, dt: f32, dt_real: f32, handler: &mut Handler<'_>) {
        for position in 0..self.controller_list().len() {
            let Some((id, controller)) = self.objects.controllers.at(position) else { continue };
            if controller.enabled() && !self.update_controller(id, dt, dt_real, handler) {
                self.report.push(Event::ControllerNotFinite { controller: id });
            }
        }
    }

    /// Returns false if the controller would have computed values that are not finite.
    fn update_controller(
        &mut self,
        id: ControllerId,
        dt: f32,
        dt_real: f32,
        handler: &mut Handler<'_>,
    ) -> bool {
        let Objects { controllers, bodies, has_new_structure, .. } = &mut self.objects;
        match controllers[id].kind_mut() {
            ControllerKind::FluidDrag(_) => self.update_fluid_drag(id, handler),
            ControllerKind::Gravity(gravity) => gravity.update(bodies),
            ControllerKind::Inactivity(inactivity) => inactivity.update(dt, bodies, has_new_structure),
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

    fn update_user_defined(&mut self, id: ControllerId, dt: f32, dt_real: f32, handler: &mut Handler<'_>) {
        let is_there = self.call_handler(handler, |handler, context| {
            handler.user_controller(id).map(|user| user.update(context, id, dt, dt_real)).is_some()
        });
        if is_there != Some(true) {
            self.report.push(Event::MissingController { controller: id });
        }
    }

    fn update_fluid_drag(&mut self, id: ControllerId, handler: &mut Handler<'_>) -> bool {
        let Objects { controllers, geoms, .. } = &mut self.objects;
        if let Some(drag) = FluidDragController::of_mut(&mut controllers[id]) {
            drag.geoms.retain(|&(geom, _)| geoms.contains(geom));
        }
        let mut all_finite = true;
        // Read again each time: callbacks may change the controller.
        for index in 0.. {
            let Some(drag) = FluidDragController::of_mut(&mut self.objects.controllers[id]) else { break };
            let Some(&(geom, _)) = drag.geoms.get(index) else { break };
            let container = drag.container();
            let mut submerged = std::mem::take(&mut drag.submerged);
            let found = self.find_submerged_vertices(id, container, geom, &mut submerged, handler);
            let mut enters = false;
            match found {
                SubmersionResult::Dry => {}
                SubmersionResult::Reached => {
                    let (has_entered, is_finite) = self.apply_fluid(id, index, &submerged);
                    enters = has_entered;
                    all_finite &= is_finite;
                }
                SubmersionResult::NoContainer => {
                    self.report.push(Event::MissingController { controller: id })
                }
            }
            if enters {
                self.report_fluid_entry(id, geom, &submerged, handler);
            }
            if let Some(drag) = FluidDragController::of_mut(&mut self.objects.controllers[id]) {
                drag.submerged = submerged;
            }
            if found == SubmersionResult::NoContainer {
                break;
            }
        }
        all_finite
    }

    /// Collects the vertices of a geom that are in a fluid.
    fn find_submerged_vertices(
        &mut self,
        id: ControllerId,
        container: FluidContainerRef,
        geom: GeomId,
        submerged: &mut Vertices,
        handler: &mut Handler<'_>,
    ) -> SubmersionResult {
        let Some(body) = self.objects.body_of(geom) else { return SubmersionResult::Dry };
        if self.objects.methods.is_precise() {
            // Geoms of a moved body are updated only when they are read.
            self.objects.update_edited_geom_transforms(body);
        }
        let geom = &self.objects.geoms[geom];
        match container {
            FluidContainerRef::Aabb(mut container) => collect_submerged(&mut container, geom, submerged),
            FluidContainerRef::Wave(wave) => {
                match self.objects.controllers.get_mut(wave).and_then(WaveController::of_mut) {
                    Some(wave) => collect_submerged(wave, geom, submerged),
                    None => SubmersionResult::NoContainer,
                }
            }
            FluidContainerRef::UserDefined => {
                match handler.get().and_then(|handler| handler.fluid_container(id)) {
                    Some(container) => collect_submerged(container, geom, submerged),
                    None => SubmersionResult::NoContainer,
                }
            }
        }
    }

    /// Applies the fluid's force to a geom. Returns whether the geom has just entered the fluid, and whether all
    /// numbers were finite.
    fn apply_fluid(&mut self, id: ControllerId, index: usize, submerged: &Vertices) -> (bool, bool) {
        let Objects { controllers, geoms, bodies, .. } = &mut self.objects;
        let Some(drag) = FluidDragController::of_mut(&mut controllers[id]) else { return (false, true) };
        let Some(geom) = geoms.get(drag.geoms[index].0) else { return (false, true) };
        let Some(entry) = bodies.get_mut(geom.body) else { return (false, true) };
        if FluidDragController::has_left(submerged.len(), geom.local_vertices.len()) {
            drag.geoms[index].1 = false;
        }
        let Some(load) = drag.fluid_force(submerged, geom.local_vertices.get_area(), &entry.body) else {
            return (false, true);
        };
        let is_finite = load.apply_to(&mut entry.body);
        let was_in_fluid = std::mem::replace(&mut drag.geoms[index].1, true);
        (!was_in_fluid, is_finite)
    }

    fn report_fluid_entry(
        &mut self,
        controller: ControllerId,
        geom: GeomId,
        submerged: &Vertices,
        handler: &mut Handler<'_>,
    ) {
        let vertices = submerged.len() as u32;
        self.report.push(Event::FluidEntry { controller, geom, vertices });
        self.call_handler(handler, |handler, context| {
            handler.on_fluid_entry(context, controller, geom, submerged)
        });
    }
}

/// Result of a search for submerged vertices.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum SubmersionResult {
    /// The geom's box is outside of the fluid.
    Dry,
    /// The geom's box reaches into the fluid.
    Reached,
    NoContainer,
}

fn collect_submerged(
    container: &mut dyn FluidContainer,
    geom: &GeomEntry,
    submerged: &mut Vertices,
) -> SubmersionResult {
    if !container.intersect(&geom.aabb) {
        return SubmersionResult::Dry;
    }
    submerged.clear();
    submerged.extend(geom.world_vertices.iter().copied().filter(|&vertex| container.contains(vertex)));
    SubmersionResult::Reached
}
