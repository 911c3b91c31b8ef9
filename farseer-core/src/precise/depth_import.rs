//! Adapter: import of depth states of bodies, depth shapes of geoms and forces along z, which the engine above sets, and output of the
//! depth states of moved bodies.

use super::Precise;
use super::depth_contact::{
    DepthContactTarget, contact_target_of, is_geom, world_box_body_id, world_box_of_body_id,
};
use super::ids::geom_of;
use crate::body::BodyId;
use crate::geom::GeomId;
use crate::math::Vector3;
use crate::objects::Objects;
use farseer_precise::Solver;
use farseer_precise::broad_phase::proxies::BodyType;
use farseer_precise::depth::feature_gate::FeatureGate;
use farseer_precise::depth::interface::{DepthBodyState, DepthShape, HingeFeature, WorldBox, WorldBoxMotion};
use farseer_precise::depth::world_box_shape::solver_velocity;
use farseer_precise::index::{BodyIndex, ProxyIndex};

impl Precise {
    /// Returns whether the engine has a depth axis.
    pub(crate) fn has_depth(&self) -> bool {
        self.solver.depth.is_some()
    }

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

    /// Returns the body index of a dynamic or kinematic body; `None` for static and absent ones.
    fn movable_index_of(&self, id: BodyId) -> Option<BodyIndex> {
        self.body_index(id).filter(|&number| number < self.solver.bodies.first_static())
    }

    /// Returns, for each of two bodies, its id and its acceleration along z by forces (length units/s^2) if updates do not move
    /// it. The entry of a dynamic or kinematic body of the simulation is `None`.
    pub(crate) fn inactive_depth_accelerations(
        &self,
        ids: [Option<BodyId>; 2],
    ) -> [Option<(BodyId, f32)>; 2] {
        ids.map(|id| {
            let (id, space) = (id?, self.solver.depth.as_ref()?);
            self.movable_index_of(id).is_none().then(|| (id, space.acceleration(id.slot())))
        })
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
        if let Some(hot) = self.solver.bodies.states.at_mut(body_index).filter(|_| !self.edits.needs_rebuild)
        {
            hot.velocity = solver_velocity(&motion);
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

/// Import of edits at the start of a step.
impl Precise {
    /// Returns whether a body is at rest along z and, if it is a sphere, does not rotate about x or y. A force along z counts as
    /// motion if `has_force_of_game` returns true.
    pub(super) fn rests_along_z(&self, id: BodyId, has_force_of_game: impl Fn() -> bool) -> bool {
        self.solver.depth.as_ref().is_none_or(|space| {
            space.is_at_rest(self.body_index(id), id.slot())
                && (space.acceleration(id.slot()) == 0.0 || !has_force_of_game())
        })
    }

    /// Adds the ground and the static boxes to `BodySet` after all bodies, and sets the velocities and inverse inertias of
    /// moving boxes. Then rebuilds the depth data by body index.
    pub(super) fn rebuild_world_boxes(&mut self) {
        let Precise { solver: Solver { depth: Some(space), bodies, .. }, ids, .. } = self else { return };
        space.add_box_bodies(bodies);
        space.rebuild_bodies(bodies, ids.bodies.iter().map(|id| id.map(|id| id.slot())));
        for body_index in bodies.movable() {
            if let Some(id) = ids.bodies[body_index] {
                space.import_body(bodies, body_index, id.slot());
            }
        }
    }

    /// Returns the id of a body for a snapshot, or the id that stands for a sleeping hinged box; `None` for all other bodies
    /// without an id. A box is identified by its proxy, because the list of boxes may be newer than the list of bodies.
    pub(super) fn saved_body_id(&self, body_index: BodyIndex) -> Option<BodyId> {
        let of_world_box = || {
            let mut proxies =
                self.solver.proxies.proxies_of(body_index).map(|at| self.solver.proxies.proxy(at));
            proxies
                .find(|proxy| proxy.body_type == BodyType::Hinged)
                .map(|proxy| world_box_body_id(geom_of(proxy)))
        };
        self.ids.bodies[body_index].or_else(|| if HingeFeature::ENABLED { of_world_box() } else { None })
    }

    /// Returns the body index of the body or hinged box that an id in a snapshot stands for; `None` if it no longer exists.
    pub(super) fn body_of_saved_id(&self, name: BodyId) -> Option<BodyIndex> {
        self.body_index(name).or_else(|| {
            if !HingeFeature::ENABLED {
                return None;
            }
            self.solver.depth.as_ref()?.hinged_body(world_box_of_body_id(name)?)
        })
    }

    /// Returns the proxy index of the ground or of a world box; `None` for a geom or an unknown box.
    pub(super) fn world_proxy_of(&self, id: GeomId) -> Option<ProxyIndex> {
        let space = self.solver.depth.as_ref()?;
        match contact_target_of(id) {
            DepthContactTarget::Ground => Some(space.ground_proxy),
            DepthContactTarget::WorldBox(id) => space.proxy_of_world_box(id),
            DepthContactTarget::Geom(_) => None,
        }
    }

    /// Returns whether a geom may collide with a world box or with the ground, by the collision filters and by whether its body
    /// is enabled; `None` for two geoms.
    pub(crate) fn may_meet_world_geom(&self, (a, b): (GeomId, GeomId), objects: &Objects) -> Option<bool> {
        let (geom, other) = match (is_geom(a), is_geom(b)) {
            (true, true) => return None,
            (true, false) => (a, b),
            (false, _) => (b, a),
        };
        let (Some(space), Some(entry)) = (&self.solver.depth, objects.geoms.get(geom)) else {
            return Some(false);
        };
        let is_enabled = objects.bodies.get(entry.body).is_some_and(|body| body.body.enabled());
        let meets = match contact_target_of(other) {
            DepthContactTarget::Ground => entry.geom.collision_enabled(),
            DepthContactTarget::WorldBox(id) => space
                .world_box_by_id(id)
                .is_some_and(|(_, world_box)| entry.geom.filter().may_meet(&world_box.filter.into())),
            DepthContactTarget::Geom(_) => false,
        };
        Some(is_enabled && meets && !objects.geoms.is_disposed(geom))
    }
}
