//! Methods of the simulator for an engine with depth (`twohalf`) that games do not call: see
//! [`precise::depth`](farseer_precise::depth).

use super::callbacks::Handler;
use super::{EventHandler, PhysicsSimulator};
use crate::body::BodyId;
use crate::geom::GeomId;
use crate::geom::filter::{CollisionFilter, Filter};
use crate::math::{Vector2, Vector3};
use crate::methods::{CollisionCategory, Methods};
use crate::precise::depth_contact::{DepthContact, DepthContactEvent, DepthContactTarget};
use crate::report::Stopwatch;
use crate::{Error, Result};
use farseer_precise::depth::feature_gate::IS_DEPTH_ENABLED;
use farseer_precise::depth::interface::{
    DepthBodyState, DepthShape, FilterNumbers, WorldBox, WorldBoxMotion,
};
use farseer_precise::index::{DenseIndex, PairIndex};

#[doc(hidden)]
impl PhysicsSimulator {
    /// Switches the simulator to the precise set in three axes. `length_unit` is the length unit (typical size of bodies), in
    /// the user's unit.
    ///
    /// # Errors
    /// As [`set_methods`](Self::set_methods) with [`Methods::Precise`]; [`Error::NotSupported`] without the feature `space`.
    pub fn enable_depth(&mut self, length_unit: f32) -> Result<()> {
        if !IS_DEPTH_ENABLED {
            return Err(Error::NotSupported {
                what: "depth axis: the feature `space` is off",
                methods: "precise",
            });
        }
        self.set_methods(Methods::Precise { length_unit })?;
        if let Some(precise) = self.pipeline.precise.as_mut().filter(|precise| !precise.has_depth()) {
            precise.enable_depth();
        }
        Ok(())
    }

    /// Switches the simulator to the faithful set and drops all contacts. Geoms get the distance grids that only the faithful
    /// set needs.
    ///
    /// # Errors
    /// As [`create_distance_grid`](crate::Objects::create_distance_grid), and [`set_methods`](Self::set_methods) with
    /// [`Methods::Faithful`].
    pub fn disable_depth(&mut self) -> Result<()> {
        if !self.has_depth() {
            // From the faithful set: the detour by the precise one drops the contacts.
            self.set_methods(Methods::PRECISE)?;
            return self.set_methods(Methods::default());
        }
        // On an error all geoms keep their former state.
        let before = self.objects.clone();
        let geoms: Vec<GeomId> = self.geoms().collect();
        let left = geoms
            .into_iter()
            .try_for_each(|geom| self.objects.create_distance_grid(geom))
            .and_then(|()| self.set_methods(Methods::default()));
        if left.is_err() {
            self.objects = before;
        }
        left
    }

    /// Returns whether the simulator has a depth axis.
    pub fn has_depth(&self) -> bool {
        self.pipeline.precise.as_ref().is_some_and(|precise| precise.has_depth())
    }

    /// Sets the depth state of a body: position, velocity and target along z, and angular velocity about x and y. A sleeping
    /// body wakes. Without a depth axis the call has no effect.
    pub fn set_depth_body(&mut self, body: BodyId, state: DepthBodyState) {
        if let Some(precise) = &mut self.pipeline.precise {
            precise.set_depth_body(body, state);
        }
    }

    /// Applies a force (mass units * length units/s^2) and a torque about z (mass units * length units^2/s^2) in the coming
    /// update. A sleeping body wakes only if its forces differ from the forces under which it fell asleep. Without a depth axis
    /// the z component is ignored. Returns false, and applies nothing, if a sum of forces would not be finite; else true.
    pub fn apply_force_3d(&mut self, id: BodyId, [x, y, z]: [f32; 3], torque: f32) -> bool {
        let PhysicsSimulator { objects, pipeline, .. } = self;
        let Some(body) = objects.bodies.get_mut(id).map(|entry| &mut entry.body) else { return true };
        let along_depth = z * body.inverse_mass();
        let pushed = pipeline.precise.as_ref().map_or(0.0, |precise| precise.depth_acceleration(id));
        let sums = [body.force().x + x, body.force().y + y, body.torque() + torque, pushed + along_depth];
        if !sums.iter().all(|sum| sum.is_finite()) {
            return false;
        }
        body.apply_force(Vector2::new(x, y));
        body.apply_torque(torque);
        if let Some(precise) = &mut pipeline.precise {
            precise.record_force(id, along_depth);
        }
        true
    }

    /// Sets the depth shape of a geom: its extent along z, sphere or vertical shape, and the ground's coefficients under it.
    /// Without a depth axis the call has no effect.
    pub fn set_depth_shape(&mut self, geom: GeomId, shape: DepthShape) {
        if let Some(precise) = &mut self.pipeline.precise {
            precise.set_depth_shape(geom, shape);
        }
    }

    /// Replaces all world boxes of the simulator. Without a depth axis the call has no effect.
    pub fn set_world_boxes(&mut self, world_boxes: impl Iterator<Item = WorldBox>) {
        if let Some(precise) = &mut self.pipeline.precise {
            precise.set_world_boxes(world_boxes);
        }
    }

    /// Sets the motion (velocities, targets, hinge) of the moving world box with this id. An unknown id is ignored.
    pub fn set_world_box_motion(&mut self, id: u32, motion: WorldBoxMotion) {
        if let Some(precise) = &mut self.pipeline.precise {
            precise.set_world_box_motion(id, motion);
        }
    }

    /// Iterates over the moving world boxes after an update: id, centre (world coordinates x, y down, z, length units), yaw
    /// (radians; `None` if the box never rotates) and motion.
    pub fn moving_world_boxes(
        &self,
    ) -> impl Iterator<Item = (u32, Vector3, Option<f32>, WorldBoxMotion)> + '_ {
        self.pipeline.precise.iter().flat_map(|precise| precise.moving_world_boxes())
    }

    /// Begins an update of `dt` seconds: queued objects are added and removed. Returns whether any body can move; then the
    /// caller calls [`continue_depth_update`](Self::continue_depth_update).
    pub fn begin_depth_update(&mut self, dt: f32, handler: Option<&mut dyn EventHandler>) -> bool {
        self.begin(dt, &mut Handler::new(handler))
    }

    /// Continues an update of `dt` seconds after [`begin_depth_update`](Self::begin_depth_update) with the step of the precise
    /// set. Returns whether the state of any body or contact may have changed.
    pub fn continue_depth_update(&mut self, dt: f32, handler: Option<&mut dyn EventHandler>) -> bool {
        self.pipeline.precise.is_some()
            && self.step_precise(dt, 0.0, &mut Handler::new(handler), &mut Stopwatch::start(None))
    }

    /// Iterates over the bodies that were awake in the last update, with id and depth state.
    pub fn moved_depth_bodies(&self) -> impl Iterator<Item = (BodyId, DepthBodyState)> + '_ {
        self.pipeline.precise.iter().flat_map(|precise| precise.moved_depth_bodies())
    }

    /// Iterates over the bodies that fell asleep in the last update, with id and depth state.
    pub fn newly_asleep_depth_bodies(&self) -> impl Iterator<Item = (BodyId, DepthBodyState)> + '_ {
        self.pipeline.precise.iter().flat_map(|precise| precise.newly_asleep_depth_bodies())
    }

    /// Returns whether the contacts of the simulator are valid. Between loading a snapshot and the next update they are not.
    pub fn depth_contacts_are_valid(&self) -> bool {
        self.pipeline.precise.as_ref().is_some_and(|precise| precise.depth_contacts_are_valid())
    }

    /// Rebuilds the lists of bodies, proxies and pairs after loading a snapshot. The caller has set the depth states before. So
    /// queries before the next update find neighbours.
    pub fn rebuild_loaded_depth(&mut self) {
        if let Some(precise) = &mut self.pipeline.precise {
            precise.rebuild_from_loaded(&mut self.objects);
        }
    }

    /// Returns the number of convex pieces that touch the ground.
    pub fn ground_contact_count(&self) -> usize {
        self.pipeline.precise.as_ref().map_or(0, |precise| precise.ground_contact_count())
    }

    /// Returns the events of contacts that began or ended in the last update, and clears the list of them.
    pub fn drain_depth_contact_events(&mut self) -> Vec<DepthContactEvent> {
        self.pipeline.precise.as_mut().map_or(Vec::new(), |precise| precise.drain_depth_contact_events())
    }

    /// Iterates over all contact manifolds in no defined order. Shapes that are only within the contact margin have one, too.
    pub fn depth_contacts(&self) -> impl Iterator<Item = DepthContact> + '_ {
        let precise = self.pipeline.precise.as_ref();
        let count = precise.map_or(0, |precise| precise.pair_count());
        (0..count).filter_map(move |pair| precise?.depth_contact(PairIndex::new(pair)))
    }

    /// Iterates over the contact manifolds of one body. Shapes that are only within the contact margin have one, too.
    pub fn depth_contacts_of(&self, body: BodyId) -> impl Iterator<Item = DepthContact> + '_ {
        let precise = self.pipeline.precise.as_ref();
        let number = precise.and_then(|precise| Some((precise, precise.body_index(body)?)));
        number.into_iter().flat_map(|(precise, number)| precise.depth_contacts_of(number))
    }

    /// Iterates over the geoms that form a broad-phase pair with a body, touching or not. Pairs with a sensor or a vetoed
    /// contact are left out.
    pub fn depth_neighbours_of(&self, body: BodyId) -> impl Iterator<Item = GeomId> + '_ {
        let precise = self.pipeline.precise.as_ref();
        let number = precise.and_then(|precise| Some((precise, precise.body_index(body)?)));
        number.into_iter().flat_map(|(precise, number)| precise.depth_neighbours_of(number))
    }

    /// Iterates over the contacts of a body that a callback vetoed in the last update, in no defined order. Each item is the
    /// geom of the body and the contact target.
    pub fn vetoed_depth_contacts_of(
        &self,
        body: BodyId,
    ) -> impl Iterator<Item = (GeomId, DepthContactTarget)> + '_ {
        let precise = self.pipeline.precise.as_ref();
        let number = precise.and_then(|precise| Some((precise, precise.body_index(body)?)));
        number.into_iter().flat_map(|(precise, number)| precise.vetoed_depth_contacts_of(number))
    }

    /// Calls `find` for the geoms whose bounds overlap a box and that may collide with a geom of the body. `low` and `high` are
    /// the least and the greatest corner of the box in world coordinates x, y (down) and z, length units. The order is not
    /// defined; some geoms come twice. The bounds are those of the last update.
    pub fn for_each_depth_geom_in(
        &self,
        [low, high]: [[f32; 3]; 2],
        body: BodyId,
        mut find: impl FnMut(GeomId),
    ) {
        let (geoms, bodies) = (&self.objects.geoms, &self.objects.bodies);
        let (Some(precise), Some(entry)) = (&self.pipeline.precise, bodies.get(body)) else { return };
        let filter = Filter { geoms, bodies };
        precise.for_each_geom_in(low, high, |id| {
            let mut own = entry.geoms.iter().filter_map(|&geom| geoms.get(geom));
            let other = geoms.get(id).filter(|_| !geoms.is_disposed(id));
            if other.is_some_and(|other| own.any(|geom| filter.may_collide(geom, other))) {
                find(id);
            }
        });
    }

    /// Iterates over touching pairs with an event listener, in no defined order. Each item is the index of the pair and its
    /// contact manifold.
    pub fn depth_contacts_with_listener(&self) -> impl Iterator<Item = (usize, DepthContact)> + '_ {
        self.pipeline.precise.iter().flat_map(|precise| precise.depth_contacts_with_listener())
    }

    /// Calls `on_depth_contacts` of the handler for the touching pairs. A pair that the handler vetoes exerts no impulses in
    /// this update.
    pub(super) fn ask_about_depth_contacts(&mut self, handler: &mut Handler<'_>) {
        let refused = self.call_handler(handler, |handler, context| handler.on_depth_contacts(context));
        for pair in refused.into_iter().flatten() {
            if let Some(precise) = &mut self.pipeline.precise {
                precise.disable_contact(pair);
            }
        }
    }
}

impl From<CollisionFilter> for FilterNumbers {
    fn from(filter: CollisionFilter) -> Self {
        let CollisionFilter { categories, collides_with, group, is_enabled, responds } = filter;
        let (categories, collides_with) = (categories.bits(), collides_with.bits());
        FilterNumbers { categories, collides_with, group, is_enabled, responds }
    }
}

impl From<FilterNumbers> for CollisionFilter {
    fn from(numbers: FilterNumbers) -> Self {
        let FilterNumbers { categories, collides_with, group, is_enabled, responds } = numbers;
        let [categories, collides_with] = [categories, collides_with].map(CollisionCategory::from_bits);
        CollisionFilter { categories, collides_with, group, is_enabled, responds }
    }
}
