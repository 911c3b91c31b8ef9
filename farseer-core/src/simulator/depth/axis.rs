//! Access to the depth axis of a simulator: [`DepthAxis`] reads it, [`DepthAxisMut`] edits it and runs its updates.

use std::ops::{Deref, DerefMut};

use super::{
    DepthBodyState, DepthContact, DepthContactEvent, DepthContactTarget, DepthHandler, DepthShape, WorldBox,
    WorldBoxMotion,
};
use crate::Result;
use crate::body::BodyId;
use crate::geom::GeomId;
use crate::geom::filter::Filter;
use crate::math::{Vector2, Vector3};
use crate::methods::Methods;
use crate::objects::Objects;
use crate::precise::Precise;
use crate::report::{Event, Stopwatch};
use crate::simulator::callbacks::Handler;
use crate::simulator::candidates::Segment;
use crate::simulator::{Context, PhysicsSimulator};
use farseer_precise::index::{BodyIndex, DenseIndex, PairIndex};

/// A straight path of an upright box over x and z, at any height.
#[derive(Debug, Clone, Copy)]
pub struct DepthPath {
    /// Centre of the box at the start, x and z, in length units.
    pub start: [f32; 2],
    /// Centre of the box at the end, x and z, in length units.
    pub end: [f32; 2],
    /// Half extents of the box along x and z, in length units, >= 0; 0 for a ray.
    pub half_extents: [f32; 2],
}

/// Read access to the depth axis of a simulator. Without a depth axis all lists are empty.
#[derive(Debug, Clone, Copy)]
pub struct DepthAxis<'a>(&'a PhysicsSimulator);

/// Write access to the depth axis of a simulator, and to its objects.
#[derive(Debug)]
pub struct DepthAxisMut<'a>(&'a mut PhysicsSimulator);

impl<'a> DepthAxis<'a> {
    /// The depth axis of a simulator.
    pub fn of(simulator: &'a PhysicsSimulator) -> Self {
        DepthAxis(simulator)
    }

    fn precise(self) -> Option<&'a Precise> {
        self.0.pipeline.precise.as_deref()
    }

    /// The engine and the index of a body; `None` for a body that takes no part in the simulation.
    fn precise_and_index(self, body: BodyId) -> Option<(&'a Precise, BodyIndex)> {
        let precise = self.precise()?;
        Some((precise, precise.body_index(body)?))
    }

    /// Returns whether the simulator has a depth axis.
    pub fn is_enabled(self) -> bool {
        self.precise().is_some_and(|precise| precise.has_depth())
    }

    /// Iterates over the bodies that were awake in the last update, with id and depth state.
    pub fn moved_bodies(self) -> impl Iterator<Item = (BodyId, DepthBodyState)> + 'a {
        self.precise().into_iter().flat_map(|precise| precise.moved_depth_bodies())
    }

    /// Iterates over the bodies that fell asleep in the last update, with id and depth state.
    pub fn newly_asleep_bodies(self) -> impl Iterator<Item = (BodyId, DepthBodyState)> + 'a {
        self.precise().into_iter().flat_map(|precise| precise.newly_asleep_depth_bodies())
    }

    /// Iterates over the moving world boxes after an update: id, centre (world coordinates x, y down, z, length units), yaw
    /// (radians; `None` if the box never rotates) and motion.
    pub fn moving_world_boxes(
        self,
    ) -> impl Iterator<Item = (u32, Vector3, Option<f32>, WorldBoxMotion)> + 'a {
        self.precise().into_iter().flat_map(|precise| precise.moving_world_boxes())
    }

    /// Returns whether the contacts of the simulator are valid. Between loading a snapshot and the next update they are not.
    pub fn contacts_are_valid(self) -> bool {
        self.precise().is_some_and(|precise| precise.depth_contacts_are_valid())
    }

    /// Returns the number of convex pieces that touch the ground.
    pub fn ground_contact_count(self) -> usize {
        self.precise().map_or(0, |precise| precise.ground_contact_count())
    }

    /// Iterates over all contact manifolds in no defined order. Shapes that are only within the contact margin have one, too.
    pub fn contacts(self) -> impl Iterator<Item = DepthContact> + 'a {
        let precise = self.precise();
        let count = precise.map_or(0, |precise| precise.pair_count());
        (0..count).filter_map(move |pair| precise?.depth_contact(PairIndex::new(pair)))
    }

    /// Iterates over the contact manifolds of one body. Shapes that are only within the contact margin have one, too.
    pub fn contacts_of(self, body: BodyId) -> impl Iterator<Item = DepthContact> + 'a {
        let found = self.precise_and_index(body).into_iter();
        found.flat_map(|(precise, index)| precise.depth_contacts_of(index))
    }

    /// Iterates over touching pairs with an event listener, in no defined order. Each item is the index of the pair and its
    /// contact manifold.
    pub fn contacts_with_listener(self) -> impl Iterator<Item = (usize, DepthContact)> + 'a {
        self.precise().into_iter().flat_map(|precise| precise.depth_contacts_with_listener())
    }

    /// Iterates over the contacts of a body that a callback vetoed in the last update, in no defined order. Each item is the
    /// geom of the body and the contact target.
    pub fn vetoed_contacts_of(self, body: BodyId) -> impl Iterator<Item = (GeomId, DepthContactTarget)> + 'a {
        let found = self.precise_and_index(body).into_iter();
        found.flat_map(|(precise, index)| precise.vetoed_depth_contacts_of(index))
    }

    /// Iterates over the geoms that form a broad-phase pair with a body, touching or not. Pairs with a sensor or a vetoed
    /// contact are left out.
    pub fn neighbours_of(self, body: BodyId) -> impl Iterator<Item = GeomId> + 'a {
        let found = self.precise_and_index(body).into_iter();
        found.flat_map(|(precise, index)| precise.depth_neighbours_of(index))
    }

    /// Calls `visit` with the geoms that an upright box may touch on a straight path over x and z, and perhaps others, nearly in the
    /// order along the path; a geom may come twice. The first argument of `visit` is a number by which geoms are sorted as in their
    /// list. It returns the fraction of the path beyond which geoms are of no interest, 0..=1. `edited`: bodies whose
    /// depth state or shapes were changed and not set yet. Returns false without a call if the grid does not know all geoms.
    pub fn for_each_geom_along(
        self,
        path: &DepthPath,
        edited: &[BodyId],
        mut visit: impl FnMut(u32, GeomId) -> f64,
    ) -> bool {
        let [start, end, half_extents] = [path.start, path.end, path.half_extents].map(Vector2::from);
        let segment = Segment { start, end, half_extents };
        let grid = self.precise().and_then(|precise| precise.grid_query(&self.0.objects));
        grid.is_some_and(|grid| {
            grid.for_each_along_in_depth(&segment, edited, |candidate| {
                visit(candidate.list_key, candidate.geom)
            })
        })
    }

    /// Calls `find` for the geoms whose bounds overlap a box and that may collide with a geom of the body. `low` and `high` are
    /// the least and the greatest corner of the box in world coordinates x, y (down) and z, length units. The order is not
    /// defined; some geoms come twice. The bounds are those of the last update.
    pub fn for_each_geom_in(self, [low, high]: [[f32; 3]; 2], body: BodyId, mut find: impl FnMut(GeomId)) {
        let (geoms, bodies) = (&self.0.objects.geoms, &self.0.objects.bodies);
        let (Some(precise), Some(entry)) = (self.precise(), bodies.get(body)) else { return };
        let filter = Filter { geoms, bodies, separated_bodies: &self.0.objects.separated_bodies };
        precise.for_each_geom_in(low, high, |id| {
            let mut own = entry.geoms.iter().filter_map(|&geom| geoms.get(geom));
            let other = geoms.get(id).filter(|_| !geoms.is_disposed(id));
            if other.is_some_and(|other| own.any(|geom| filter.may_collide(geom, other))) {
                find(id);
            }
        });
    }
}

impl<'a> DepthAxisMut<'a> {
    /// The depth axis of a simulator.
    pub fn of(simulator: &'a mut PhysicsSimulator) -> Self {
        DepthAxisMut(simulator)
    }

    /// The depth axis of the simulator behind the context of a callback.
    pub fn within(context: &'a mut Context<'_>) -> Self {
        DepthAxisMut(context.simulator)
    }

    fn precise_mut(&mut self) -> Option<&mut Precise> {
        self.0.pipeline.precise.as_deref_mut()
    }

    /// The same for reading.
    pub fn as_ref(&self) -> DepthAxis<'_> {
        DepthAxis(self.0)
    }

    /// Switches the simulator to the precise set in three axes. `length_unit` is the length unit (typical size of bodies), in
    /// the user's unit.
    ///
    /// # Errors
    /// As [`set_methods`](PhysicsSimulator::set_methods) with [`Methods::Precise`].
    pub fn enable(&mut self, length_unit: f32) -> Result<()> {
        self.0.set_methods(Methods::Precise { length_unit })?;
        if let Some(precise) = self.precise_mut().filter(|precise| !precise.has_depth()) {
            precise.enable_depth();
        }
        Ok(())
    }

    /// Switches the simulator to the faithful set and drops all contacts. Geoms get the distance grids that only the faithful
    /// set needs.
    ///
    /// # Errors
    /// As [`create_distance_grid`](Objects::create_distance_grid), and [`set_methods`](PhysicsSimulator::set_methods) with
    /// [`Methods::Faithful`].
    pub fn disable(&mut self) -> Result<()> {
        let simulator = &mut *self.0;
        if !DepthAxis(simulator).is_enabled() {
            // From the faithful set: the detour by the precise one drops the contacts.
            simulator.set_methods(Methods::PRECISE)?;
            return simulator.set_methods(Methods::default());
        }
        // On an error all geoms keep their former state.
        let before = simulator.objects.clone();
        let geoms: Vec<GeomId> = simulator.geoms().collect();
        let left = geoms
            .into_iter()
            .try_for_each(|geom| simulator.objects.create_distance_grid(geom))
            .and_then(|()| simulator.set_methods(Methods::default()));
        if left.is_err() {
            simulator.objects = before;
        }
        left
    }

    /// Sets the depth state of a body: position, velocity and target along z, and angular velocity about x and y. A sleeping
    /// body wakes. Without a depth axis the call has no effect.
    pub fn set_body(&mut self, body: BodyId, state: DepthBodyState) {
        if let Some(precise) = self.precise_mut() {
            precise.set_depth_body(body, state);
        }
    }

    /// Disables a body whose state along z would not be finite, and reports it as [`Event::NotFinite`].
    pub fn disable_body(&mut self, id: BodyId) {
        if let Some(body) = self.0.body_mut(id) {
            body.set_enabled(false);
            self.0.report.push(Event::NotFinite { body: id, disabled: true });
        }
    }

    /// Applies a force (mass units * length units/s^2) and a torque about z (mass units * length units^2/s^2) in the coming
    /// update. A sleeping body wakes only if its forces differ from the forces under which it fell asleep. Without a depth axis
    /// the z component is ignored. Returns false, and applies nothing, if a sum of forces would not be finite; else true.
    pub fn apply_force(&mut self, id: BodyId, [x, y, z]: [f32; 3], torque: f32) -> bool {
        let PhysicsSimulator { objects, pipeline, .. } = &mut *self.0;
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
    pub fn set_shape(&mut self, geom: GeomId, shape: DepthShape) {
        if let Some(precise) = self.precise_mut() {
            precise.set_depth_shape(geom, shape);
        }
    }

    /// Replaces all world boxes of the simulator. Without a depth axis the call has no effect.
    pub fn set_world_boxes(&mut self, world_boxes: impl Iterator<Item = WorldBox>) {
        if let Some(precise) = self.precise_mut() {
            precise.set_world_boxes(world_boxes);
        }
    }

    /// Sets the motion (velocities, targets, hinge) of the moving world box with this id. An unknown id is ignored.
    pub fn set_world_box_motion(&mut self, id: u32, motion: WorldBoxMotion) {
        if let Some(precise) = self.precise_mut() {
            precise.set_world_box_motion(id, motion);
        }
    }

    /// Rebuilds the lists of bodies, proxies and pairs after loading a snapshot. The caller has set the depth states before. So
    /// queries before the next update find neighbours.
    pub fn rebuild_loaded(&mut self) {
        let PhysicsSimulator { objects, pipeline, .. } = &mut *self.0;
        if let Some(precise) = &mut pipeline.precise {
            precise.rebuild_from_loaded(objects);
        }
    }

    /// Continues an update of `dt` seconds with the step of the precise set. Call it after
    /// [`process_queues`](PhysicsSimulator::process_queues), if that returned true. Returns whether the state of any body or
    /// contact may have changed.
    pub fn step(&mut self, dt: f32, handler: Option<&mut dyn DepthHandler>) -> bool {
        self.0.pipeline.precise.is_some()
            && self.0.step_precise(dt, 0.0, &mut Handler::of_depth(handler), &mut Stopwatch::start(None))
    }

    /// The stage [`collide_pairs`](PhysicsSimulator::collide_pairs) of the faithful set, for a handler that is also told of
    /// [silent collisions](DepthHandler::on_silent_collision).
    pub fn collide_pairs(&mut self, handler: Option<&mut dyn DepthHandler>) {
        if self.0.has_stages() {
            self.0.run_narrow_phase(&mut Handler::of_depth(handler));
        }
    }

    /// Returns the events of contacts that began or ended in the last update, and clears the list of them.
    pub fn drain_contact_events(&mut self) -> Vec<DepthContactEvent> {
        self.precise_mut().map_or(Vec::new(), |precise| precise.drain_depth_contact_events())
    }
}

impl Deref for DepthAxisMut<'_> {
    type Target = Objects;
    #[inline]
    fn deref(&self) -> &Objects {
        self.0
    }
}

impl DerefMut for DepthAxisMut<'_> {
    #[inline]
    fn deref_mut(&mut self) -> &mut Objects {
        self.0
    }
}
