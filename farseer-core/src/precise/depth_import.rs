//! Adapter: import of depth states of bodies, depth shapes of geoms, forces along z and world boxes, which the engine above
//! sets, and output of the depth states of moved bodies. Only with the feature `space`.

use super::Precise;
use crate::body::BodyId;
use crate::geom::GeomId;
use crate::math::Vector3;
use farseer_precise::depth::feature_gate::FeatureGate;
use farseer_precise::depth::interface::{DepthBodyState, DepthShape, WorldBox, WorldBoxMotion};
use farseer_precise::depth::world_box_shape::solver_velocity;

impl Precise {
    /// Adds an empty depth state to the engine. No call removes it.
    pub(crate) fn enable_depth(&mut self) {
        self.solver.depth = FeatureGate::new();
    }

    /// Sets the depth state of a body. This is an edit: the body wakes.
    pub(crate) fn set_depth_body(&mut self, id: BodyId, state: DepthBodyState) {
        let Some(space) = self.solver.depth.as_deref_mut() else { return };
        *space.body_mut(id.slot()) = state;
        self.edits.bodies.push(id);
    }

    /// Adds the acceleration `along_depth` by a force, in length units/s^2, to the depth state of a body. The body is also
    /// listed as forced, so that the next step checks whether it wakes. Static bodies ignore the call.
    pub(crate) fn record_force(&mut self, id: BodyId, along_depth: f32) {
        let Some(number) = self.movable_index_of(id) else { return };
        if let Some(space) = self.solver.depth.as_deref_mut() {
            space.add_acceleration(id.slot(), along_depth);
        }
        self.solver.sleep.record_force(number);
    }

    /// Returns the acceleration of a body along z by the forces applied for the coming step, in length units/s^2; 0 without a
    /// depth axis.
    pub(crate) fn depth_acceleration(&self, id: BodyId) -> f32 {
        self.solver.depth.as_ref().map_or(0.0, |space| space.acceleration(id.slot()))
    }

    /// Sets the depth shape of a geom. If the shape changes, all lists of bodies and proxies are rebuilt before the next step.
    pub(crate) fn set_depth_shape(&mut self, id: GeomId, shape: DepthShape) {
        let Some(space) = self.solver.depth.as_deref_mut() else { return };
        let known = space.shape_mut(id.slot());
        if *known != shape {
            *known = shape;
            self.edits.needs_rebuild |= self.proxy_of(id, 0).is_some();
        }
    }

    /// Sets all world boxes. All lists of bodies and proxies are rebuilt before the next step.
    pub(crate) fn set_world_boxes(&mut self, world_boxes: impl Iterator<Item = WorldBox>) {
        let Some(space) = self.solver.depth.as_deref_mut() else { return };
        space.set_world_boxes(world_boxes);
        self.edits.needs_rebuild = true;
    }

    /// Sets the motion of the moving box with this id; an unknown id is ignored. A hinged box wakes if its motion or its hinge
    /// changes.
    pub(crate) fn set_world_box_motion(&mut self, id: u32, motion: WorldBoxMotion) {
        let Some(space) = self.solver.depth.as_deref_mut() else { return };
        let Some((body_index, has_changed)) = space.set_world_box_motion(id, motion) else { return };
        if let Some(state) =
            self.solver.bodies.states.at_mut(body_index).filter(|_| !self.edits.needs_rebuild)
        {
            state.velocity = solver_velocity(&motion);
            if motion.hinge().is_some() && has_changed {
                self.solver.sleep.request_wake(body_index);
            }
        }
    }

    /// Iterates over the moving boxes: id, centre (world coordinates, length units), yaw (radians; `None` if the box never
    /// rotates) and motion.
    pub(crate) fn moving_world_boxes(
        &self,
    ) -> impl Iterator<Item = (u32, Vector3, Option<f32>, WorldBoxMotion)> + '_ {
        self.solver.depth.iter().flat_map(|space| space.moving_world_boxes())
    }

    /// Iterates over the bodies that were awake in the last update, with id and depth state.
    pub(crate) fn moved_depth_bodies(&self) -> impl Iterator<Item = (BodyId, DepthBodyState)> + '_ {
        let space = self.solver.depth.as_ref();
        self.solver.sleep.awake_bodies(self.solver.bodies.last_movable).filter_map(move |number| {
            let id = self.ids.bodies[number]?;
            Some((id, space?.body(id.slot())))
        })
    }

    /// Iterates over the bodies that fell asleep in the last update, with id and depth state.
    pub(crate) fn newly_asleep_depth_bodies(&self) -> impl Iterator<Item = (BodyId, DepthBodyState)> + '_ {
        self.solver.depth.iter().flat_map(|space| {
            space.newly_asleep.iter().map(|&id| {
                let id = BodyId::from_bits(id);
                (id, space.body(id.slot()))
            })
        })
    }
}
