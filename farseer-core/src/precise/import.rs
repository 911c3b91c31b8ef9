//! Import of edits: moved and changed bodies and geoms, and the rebuild of all lists.
//!
//! The simulator marks edited bodies and geoms. [`import_edits`](Precise::import_edits) runs at the start of a step. It copies
//! changed properties, invalidates affected pairs and wakes sleeping bodies. If a body or geom has changed its type or filter,
//! everything is [rebuilt](Precise::rebuild) from the state that a snapshot would hold. The module reads the simulator's
//! objects and writes bodies, proxies, pairs and sleep.

use super::Precise;
use super::bodies::{gyration_radius, inverse_mass_inertia_of};
use super::depth::interface::{DepthInterval, DepthShape, is_geom};
use super::fingerprint::Fingerprint;
use super::saved::{EditPolicy, Saved};
use super::shape::Shape;
use crate::body::{Body, BodyId};
use crate::geom::entry::GeomEntry;
use crate::geom::filter::{is_valid_pair, may_keep_touching};
use crate::geom::pieces::Piece;
use crate::geom::{Geom, GeomId};
use crate::math::plane::Vector;
use crate::objects::Objects;
use crate::precise::broad_phase::hash_grid::PackedAabb;
use crate::precise::broad_phase::pair_finder::{initial_one_way_state, is_pair_reported};
use crate::precise::broad_phase::proxies::{BodyType, Proxy, geom_filter};

/// Entry of a table that stands for no body or proxy; all other entries are indices.
pub(super) const NOT_LISTED: u32 = u32::MAX;

/// Sets the entry `slot` of a table to `value`. Lengthens the table with [`NOT_LISTED`] as needed.
pub(super) fn set_entry(table: &mut Vec<u32>, slot: usize, value: u32) {
    if table.len() <= slot {
        table.resize(slot + 1, NOT_LISTED);
    }
    table[slot] = value;
}

/// Returns the entry `slot` of a table; `None` if it is [`NOT_LISTED`] or beyond the end of the table.
pub(super) fn entry_of(table: &[u32], slot: usize) -> Option<usize> {
    table.get(slot).copied().filter(|&number| number != NOT_LISTED).map(|number| number as usize)
}

impl Precise {
    /// Returns the index of a body into `bodies`; `None` if the body is not listed.
    pub(crate) fn body_index(&self, body: BodyId) -> Option<usize> {
        entry_of(&self.body_indices, body.slot()).filter(|&number| self.bodies.ids[number] == Some(body))
    }

    /// Requests a rebuild of all lists by the next import, because a body or geom has changed its type.
    pub(crate) fn mark_stale(&mut self) {
        self.needs_rebuild = true;
    }

    /// Requests that the next import compares the engine's lists of bodies and geoms with those of the simulator, because some were
    /// added or removed.
    pub(crate) fn mark_membership_changed(&mut self) {
        self.has_membership_changes = true;
    }

    /// Adds a body to `edited_bodies`. The next import copies the properties that the body has then.
    pub(crate) fn mark_body_edited(&mut self, body: BodyId) {
        self.edited_bodies.push(body);
    }

    /// Adds a geom to `edited_geoms`. The next import copies the properties that the geom has then.
    pub(crate) fn mark_geom_edited(&mut self, geom: GeomId) {
        self.edited_geoms.push(geom);
    }

    /// Returns whether an edit has changed the type of a body. The type is static, kinematic, dynamic or not simulated, and
    /// whether mass and inertia are infinite.
    fn type_changed(&self, id: BodyId, objects: &Objects) -> bool {
        let Some(body) = objects.bodies.get(id).map(|entry| &entry.body) else { return false };
        // Added bodies are handled by `apply_add_remove`.
        let Some(index) = self.body_index(id) else {
            return !self.has_membership_changes && is_simulated(id, objects);
        };
        let is_movable = index < self.bodies.first_static();
        let inverses = if is_movable { inverse_mass_inertia_of(body) } else { [0.0; 2] };
        // Bodies of infinite mass and inertia use no graph colours, so that this property is part of the type.
        let is_same_type = body.enabled()
            && is_movable == body.is_integrated()
            && self.bodies.is_kinematic(index) == (is_movable && body.is_kinematic())
            && (inverses == [0.0; 2]) == (self.bodies.inverse_mass_inertia[index] == [0.0; 2]);
        !is_same_type
    }

    /// Returns whether an edit has changed the collision filter of a geom or its collision response, whether its contacts exert
    /// impulses.
    fn filter_changed(&self, id: GeomId, objects: &Objects) -> bool {
        let Some(entry) = objects.geoms.get(id) else { return false };
        let (filter, responds) = (geom_filter(entry), entry.geom.collision_response_enabled());
        self.proxies_of_geom(id, objects).any(|at| {
            let proxy = &self.proxies.all[at];
            proxy.filter != filter || proxy.responds != responds
        })
    }

    /// Copies pose, velocity, mass, gravity scale and surface velocity of an edited body to `bodies` and its proxies. Requests
    /// that a sleeping body wakes if it was moved, has another mass or is not at rest.
    fn import_body(&mut self, id: BodyId, objects: &Objects) {
        let (Some(entry), Some(index)) = (objects.bodies.get(id), self.body_index(id)) else { return };
        let body = &entry.body;
        let is_movable = index < self.bodies.first_static();
        let inverses = if is_movable { self.inverse_mass_and_inertia(index, body) } else { [0.0; 2] };
        let velocity = self.surface_velocity(id, is_movable, body);
        let has_moved = self.bodies.was_moved(index, body) || self.was_moved_along_z(index, id);
        let has_mass_changed = inverses != self.bodies.inverse_mass_inertia[index];
        let is_at_rest = body.is_at_rest_under(self.bodies.gravity_scales[index]) && self.rests_along_z(id);
        if has_moved || has_mass_changed || !is_at_rest {
            self.sleep.request_wake(index);
        } else {
            self.sleep.record_force(index);
        }
        self.bodies.inverse_mass_inertia[index] = inverses;
        if is_movable {
            self.compute_geomless_extent(index, objects);
        }
        if has_mass_changed {
            self.invalidate_joints();
        }
        self.bodies.gravity_scales[index] = body.effective_gravity_scale();
        if is_movable {
            self.bodies.are_bullets[index] = body.is_bullet();
        }
        self.bodies.set_velocity(index, body);
        if has_moved {
            self.bodies.set_pose(index, body);
            self.bodies.clear_delta_pose(index);
        }
        self.import_body_z(index, id);
        self.fix_rotation_if_vertical(index);
        for &geom in &entry.geoms {
            self.update_proxies(geom, objects, |proxy| {
                let is_belt_changed = proxy.surface_velocity != velocity;
                proxy.surface_velocity = velocity;
                let contacts = has_mass_changed || is_belt_changed;
                ProxyUpdate { moved: has_moved, contacts, callbacks: false, one_way: false }
            });
        }
    }

    /// Computes the greatest and the least extent of the body at `index` from its shapes, and stores them in `bodies`, length
    /// units.
    pub(super) fn compute_extents(&mut self, index: usize, objects: &Objects) {
        let Precise { bodies, proxies, .. } = self;
        let shapes = proxies.proxies_of(index).map(|proxy| proxies.all[proxy as usize].shape);
        bodies.compute_extents(index, shapes.map(|shape| (shape, proxies.vertices.min_extent(shape))));
        if let Some(space) = self.depth.as_deref_mut() {
            space.update_is_ball(index, &self.proxies);
        }
        self.compute_geomless_extent(index, objects);
    }

    /// Sets the greatest extent of a body without geoms to its radius of gyration, length units.
    fn compute_geomless_extent(&mut self, index: usize, objects: &Objects) {
        let body = self.bodies.ids[index].and_then(|id| objects.bodies.get(id));
        if let Some(entry) = body.filter(|entry| !entry.body.is_kinematic())
            && self.proxies.proxies_of(index).next().is_none()
        {
            self.bodies.max_extents[index] = gyration_radius(&entry.body);
        }
    }

    /// Copies friction, restitution, callback flag and one-way direction of an edited geom to its proxies, and updates their
    /// pairs.
    fn import_geom(&mut self, id: GeomId, objects: &Objects) {
        let Some(entry) = objects.geoms.get(id) else { return };
        let (geom, one_way) = (&entry.geom, self.one_way_direction(entry));
        let [friction, restitution] = surface_coefficients(geom);
        let is_reported = geom.collision_callbacks_enabled();
        self.has_restitution |= restitution > 0.0;
        self.update_proxies(id, objects, |proxy| {
            let have_coefficients_changed = proxy.friction != friction || proxy.restitution != restitution;
            (proxy.friction, proxy.restitution) = (friction, restitution);
            let callbacks = std::mem::replace(&mut proxy.is_reported, is_reported) != is_reported;
            let has_direction_changed = std::mem::replace(&mut proxy.one_way, one_way) != one_way;
            ProxyUpdate {
                moved: false,
                contacts: have_coefficients_changed || has_direction_changed,
                callbacks,
                one_way: has_direction_changed,
            }
        });
    }

    /// Returns the outward direction of the solid side of a one-way geom, a unit vector in the frame of its body. `None` for
    /// all other geoms, and in three axes.
    fn one_way_direction(&self, geom: &GeomEntry) -> Option<Vector> {
        geom.one_way.filter(|_| self.depth.is_none()).map(|direction| [direction.x, direction.y])
    }

    /// Returns the indices of the proxies of a geom.
    fn proxies_of_geom(&self, geom: GeomId, objects: &Objects) -> impl Iterator<Item = usize> + use<'_> {
        let first = entry_of(&self.first_proxies, geom.slot()).unwrap_or(self.proxies.all.len());
        let count = objects.geoms.get(geom).map_or(0, |entry| entry.pieces().len());
        (first..(first + count).min(self.proxies.all.len()))
            .take_while(move |&at| self.proxies.all[at].geom == geom)
    }

    /// Calls `apply` for each proxy of a geom, and updates the pairs of that proxy by the [`ProxyUpdate`] that `apply` returns.
    fn update_proxies(
        &mut self,
        geom: GeomId,
        objects: &Objects,
        mut apply: impl FnMut(&mut Proxy) -> ProxyUpdate,
    ) {
        let Some(first) = self.proxies_of_geom(geom, objects).next() else { return };
        for at in first..first + self.proxies_of_geom(geom, objects).count() {
            let was_one_way = self.proxies.all[at].one_way.is_some();
            let update = apply(&mut self.proxies.all[at]);
            self.proxies.one_way_count += usize::from(self.proxies.all[at].one_way.is_some());
            self.proxies.one_way_count -= usize::from(was_one_way);
            if update.moved {
                self.teleport_proxy(at as u32);
                self.proxies.refitted.push(at as u32);
            }
            if update.contacts || update.moved {
                self.invalidate_pairs(at as u32);
            }
            if update.callbacks {
                self.update_callbacks(at as u32);
            }
            if update.one_way {
                self.reset_one_way_states(at as u32);
            }
        }
    }

    /// Sets for each pair of a proxy whether a collision handler is called for the pair.
    fn update_callbacks(&mut self, proxy: u32) {
        let mut pairs = std::mem::take(&mut self.pair_scratch);
        pairs.extend(self.pairs.pairs_of(proxy).map(|pair| pair as u32));
        for pair in pairs.drain(..) {
            let is_reported = is_pair_reported(&self.proxies, self.pairs.triggers[pair as usize].proxies);
            self.pairs.set_reported(pair as usize, is_reported);
        }
        self.pair_scratch = pairs;
    }

    /// Resets the one-way states of all pairs of a proxy, after the one-way direction of the proxy has changed.
    pub(super) fn reset_one_way_states(&mut self, proxy: u32) {
        let mut pairs = std::mem::take(&mut self.pair_scratch);
        pairs.extend(self.pairs.pairs_of(proxy).map(|pair| pair as u32));
        for pair in pairs.drain(..) {
            self.pairs.all[pair as usize].one_way_state =
                initial_one_way_state(&self.proxies, &self.pairs, pair as usize);
        }
        self.pair_scratch = pairs;
    }

    /// Moves a proxy to the new pose of its body at once: computes a new fat AABB, and raises the travel so that all pairs of
    /// the proxy become due for an update.
    pub(super) fn teleport_proxy(&mut self, proxy: u32) {
        let motion = &mut self.proxies.travel[proxy as usize];
        *motion = motion.wrapping_add(1 << 30);
        self.enlarge_aabb(proxy);
    }

    /// Invalidates the pairs of a proxy: the next step updates their contacts in full, wakes sleeping partners and may select
    /// solvers anew.
    pub(super) fn invalidate_pairs(&mut self, proxy: u32) {
        self.direct_solver.timer.may_be_due = true;
        let mut pairs = std::mem::take(&mut self.pair_scratch);
        pairs.extend(self.pairs.pairs_of(proxy).map(|pair| pair as u32));
        for pair in pairs.drain(..) {
            self.pairs.invalidate(pair as usize);
            self.pair_support_removed(pair as usize);
        }
        self.pair_scratch = pairs;
    }

    /// First stage of a step: applies edits, additions and removals of bodies and geoms to the lists.
    ///
    /// If a body or geom has changed its type or filter, everything is rebuilt from the state before all edits, as after
    /// loading a snapshot.
    pub(crate) fn import_edits(&mut self, objects: &Objects) {
        let has_edits = !(self.edited_bodies.is_empty() && self.edited_geoms.is_empty());
        if has_edits || self.needs_rebuild || self.has_membership_changes {
            return self.apply_edits(objects);
        }
        debug_assert!(!self.has_unmarked_change(objects), "what comes, goes and changes is noted");
        self.wake_requested_by_game();
        self.wake_for_changed_joints(objects);
        self.wake_up();
    }

    /// Applies edits, additions and removals of bodies and geoms to the lists: see [`import_edits`](Self::import_edits).
    fn apply_edits(&mut self, objects: &Objects) {
        let (mut bodies, mut geoms) =
            (std::mem::take(&mut self.edited_bodies), std::mem::take(&mut self.edited_geoms));
        self.needs_rebuild = self.needs_rebuild
            || bodies.iter().any(|&body| self.type_changed(body, objects))
            || geoms.iter().any(|&geom| self.filter_changed(geom, objects));
        let has_new_members = std::mem::take(&mut self.has_membership_changes);
        let had_one_way = self.proxies.one_way_count > 0;
        let before = (cfg!(debug_assertions) && has_new_members).then(|| self.save());
        if has_new_members {
            self.needs_rebuild =
                self.needs_rebuild || self.loaded.is_some() || !self.apply_add_remove(objects);
        }
        debug_assert!(
            self.needs_rebuild || !self.has_unmarked_change(objects),
            "what comes, goes and changes is noted"
        );
        if self.needs_rebuild {
            let saved = self.loaded.take().unwrap_or_else(|| self.save());
            self.rebuild(objects, &saved, EditPolicy::Apply);
        } else {
            self.wake_requested_by_game();
            bodies.iter().for_each(|&body| self.import_body(body, objects));
            bodies.retain(|&body| self.body_index(body).is_none());
            if !bodies.is_empty() {
                self.reread_joints_of_unlisted(&bodies);
            }
            geoms.iter().for_each(|&geom| self.import_geom(geom, objects));
            if !had_one_way && self.proxies.one_way_count > 0 {
                self.bodies.clear_delta_poses();
            }
        }
        bodies.clear();
        geoms.clear();
        (self.edited_bodies, self.edited_geoms) = (bodies, geoms);
        self.wake_for_changed_joints(objects);
        self.wake_up();
        debug_assert!(
            before.is_none_or(|before| self.equals_rebuild(objects, &before)),
            "who comes and goes changes no bit of the others"
        );
    }

    /// Returns whether this state equals the result of a rebuild from the saved state `before`. For debug assertions.
    fn equals_rebuild(&self, objects: &Objects, before: &Saved) -> bool {
        let mut rebuilt = self.clone();
        rebuilt.rebuild(objects, before, EditPolicy::Apply);
        rebuilt.wake_for_changed_joints(objects);
        rebuilt.wake_up();
        rebuilt.save() == self.save()
    }

    /// Returns whether a body has begun or ceased to be simulated without a call that marks it. For debug assertions.
    fn has_unmarked_change(&self, objects: &Objects) -> bool {
        let ids = &self.bodies.ids[1..];
        let has_changed = |(at, id): (usize, &Option<BodyId>)| {
            let is_movable = at < self.bodies.last_movable;
            id.is_some_and(|id| {
                objects
                    .bodies
                    .get(id)
                    .is_none_or(|entry| !entry.body.enabled() || (is_movable && !entry.body.is_integrated()))
            })
        };
        let has_returned = |&id: &BodyId| is_simulated(id, objects);
        ids.iter().enumerate().any(has_changed) || self.disabled_bodies.iter().any(has_returned)
    }

    /// Rebuilds all lists from the simulated bodies and geoms, and restores the state of known bodies and pairs from `saved`.
    /// `edits`: when edits made since that state take effect.
    pub(super) fn rebuild(&mut self, objects: &Objects, saved: &Saved, edits: EditPolicy) {
        (self.needs_rebuild, self.has_membership_changes) = (false, false);
        // Indices of proxies change here, also if a handler has caused the rebuild in the middle of an update.
        self.rolling_contacts.clear();
        self.invalidate_joints();
        self.rebuild_bodies(objects);
        self.rebuild_proxies(objects);
        self.list_always_tested(objects);
        self.fix_rotation_of_all();
        self.sleep.reset(&self.bodies.ids[..self.bodies.first_static()]);
        self.keep_moving_boxes_awake();
        self.direct_solver.reset(self.bodies.states.len());
        // The body indices in the springs have become invalid.
        self.springs.clear();
        (1..=self.bodies.last_movable).for_each(|number| self.compute_extents(number, objects));
        self.restore(saved, objects, edits);
    }

    /// Returns whether a body has velocity 0 and no pending impulse.
    pub(super) fn is_at_rest(&self, id: BodyId, objects: &Objects) -> bool {
        let body = objects.bodies.get(id).map(|entry| &entry.body);
        body.is_some_and(|body| body.is_at_rest_under(body.effective_gravity_scale()))
            && self.rests_along_z(id)
    }

    /// Returns whether the collision filters still allow the pair of these geoms, which existed before.
    pub(super) fn may_keep_pair(&self, geoms: (GeomId, GeomId), objects: &Objects) -> bool {
        let may_stay = if self.depth.is_some() { is_valid_pair } else { may_keep_touching };
        self.may_meet_world_geom(geoms, objects)
            .unwrap_or_else(|| may_stay(geoms, &objects.geoms, &objects.bodies))
    }

    /// Lists the simulated bodies: dynamic and kinematic ones, then static ones with geoms, in the order of the simulator's
    /// lists.
    fn rebuild_bodies(&mut self, objects: &Objects) {
        let bodies = &objects.bodies;
        let movable = || (0..bodies.list().len()).filter_map(|at| bodies.at(at));
        self.body_indices.clear();
        let mut static_bodies = Vec::new();
        let mut is_visited = vec![false; bodies.slot_count()];
        let mut visit = |id: BodyId| !std::mem::replace(&mut is_visited[id.slot()], true);
        movable().filter(|(_, entry)| entry.body.is_integrated()).for_each(|(id, _)| {
            visit(id);
        });
        for at in 0..objects.geoms.list().len() {
            let Some((_, geom)) = objects.geoms.at(at) else { continue };
            if bodies.get(geom.body).is_some_and(|entry| entry.body.enabled()) && visit(geom.body) {
                static_bodies.push(geom.body);
            }
        }
        self.bodies.rebuild(
            bodies.list().len(),
            self.depth.iter().flat_map(|space| space.moving_poses()),
            movable().filter(|(_, entry)| entry.body.is_integrated()).map(|(id, entry)| (id, &entry.body)),
            static_bodies.iter().map(|&id| (id, &bodies[id].body)),
        );
        self.rebuild_world_boxes();
        for (number, id) in self.bodies.ids.iter().enumerate() {
            if let Some(id) = id {
                set_entry(&mut self.body_indices, id.slot(), number as u32);
            }
        }
        self.disabled_bodies.clear();
        self.disabled_bodies.extend(movable().filter(|(_, entry)| !entry.body.enabled()).map(|(id, _)| id));
        if let Some(space) = self.depth.as_deref_mut() {
            // A force along the depth axis on a body that a handler has made static is in no snapshot, so it is removed here,
            // too.
            let unmoved = movable().filter(|(_, entry)| !entry.body.is_integrated());
            unmoved.for_each(|(id, _)| space.set_acceleration(id, 0.0));
        }
    }

    /// Lists a proxy for each convex piece: pieces of dynamic and kinematic bodies, capacity for new ones, then pieces of
    /// static bodies.
    fn rebuild_proxies(&mut self, objects: &Objects) {
        self.proxies.clear();
        self.proxies.reserve_lists(objects.geoms.list().len());
        self.first_proxies.clear();
        self.proxy_flags.clear();
        self.has_restitution = false;
        let first_fixed = self.bodies.first_static() as u32;
        self.add_moving_box_proxies();
        self.add_proxies(objects, |body| body < first_fixed);
        self.proxies.add_spare_positions();
        self.add_proxies(objects, |body| body >= first_fixed);
        self.add_ground_and_static_proxies();
        self.proxies.link_bodies(self.bodies.poses.len());
        self.proxy_flags.resize(self.proxies.all.len(), false);
    }

    /// Appends the proxies of all geoms for whose body index `is_wanted` returns true.
    fn add_proxies(&mut self, objects: &Objects, is_wanted: impl Fn(u32) -> bool) {
        for at in 0..objects.geoms.list().len() {
            let Some((id, geom)) = objects.geoms.at(at) else { continue };
            let Some(body) = entry_of(&self.body_indices, geom.body.slot()) else { continue };
            if !is_wanted(body as u32) {
                continue;
            }
            set_entry(&mut self.first_proxies, id.slot(), self.proxies.all.len() as u32);
            for piece in 0..geom.pieces().len() {
                if let Some(proxy) = self.make_proxy(at, piece, objects) {
                    self.proxies.push(proxy);
                }
            }
        }
    }

    /// Returns the proxy of one convex piece of a geom in its current state; `None` if its body is not listed. `at`: position
    /// of the geom in the simulator's list.
    pub(super) fn make_proxy(&mut self, at: usize, piece: usize, objects: &Objects) -> Option<Proxy> {
        let (id, geom) = objects.geoms.at(at)?;
        let body = self.body_index(geom.body)?;
        let is_movable = body < self.bodies.first_static();
        let body_type = match is_movable {
            false => BodyType::Fixed,
            true if self.bodies.is_kinematic(body) => BodyType::Kinematic,
            true => BodyType::Dynamic,
        };
        let [friction, restitution] = surface_coefficients(&geom.geom);
        self.has_restitution |= restitution > 0.0;
        let shape = self.add_shape(id, geom, piece);
        Some(Proxy {
            geom: id,
            piece: piece as u32,
            list_index: at as u32,
            creation_number: geom.number,
            body: body as u32,
            body_type,
            shape,
            fingerprint: self.fingerprint_of(id, shape),
            friction,
            restitution,
            responds: geom.geom.collision_response_enabled(),
            is_reported: geom.geom.collision_callbacks_enabled(),
            filter: geom_filter(geom),
            surface_velocity: self.surface_velocity(geom.body, is_movable, &objects.bodies[geom.body].body),
            one_way: self.one_way_direction(geom),
        })
    }

    /// Returns the surface velocity of a static body, a conveyor belt if it is not 0: x, y (length units/s), angular velocity
    /// (radians/s), z (length units/s). All 0 for movable bodies.
    fn surface_velocity(&self, id: BodyId, is_movable: bool, body: &Body) -> [f32; 4] {
        let (velocity, spin) = (body.linear_velocity(), body.angular_velocity());
        let along_depth = self.depth.as_ref().map_or(0.0, |space| space.body(id).velocity);
        if is_movable {
            [0.0; 4]
        } else {
            [velocity.x, velocity.y, spin, along_depth].map(without_negative_zero)
        }
    }

    /// Adds the shape of a convex piece, in the frame of its body, to the vertex pool. Returns the shape.
    fn add_shape(&mut self, id: GeomId, geom: &GeomEntry, piece: usize) -> Shape {
        match self.depth.as_ref().map(|space| space.shape(id)) {
            Some(DepthShape { vertical: Some(upright), .. }) => {
                let ([x, y], half) = upright.front_box();
                self.proxies.vertices.add_box_at([geom.offset.x + x, geom.offset.y + y], half)
            }
            Some(DepthShape { is_sphere: true, half_depth, .. }) => {
                let circle = Piece::Circle { centre: [0.0; 2], radius: half_depth };
                self.proxies.vertices.add(&circle, geom)
            }
            _ => self.proxies.vertices.add(&geom.pieces()[piece], geom),
        }
    }

    /// Returns the [fingerprint](super::fingerprint) of a listed `shape` of a geom, with its depth shape in three axes.
    fn fingerprint_of(&self, id: GeomId, shape: Shape) -> u64 {
        let mut fingerprint = Fingerprint::default();
        fingerprint.add_outline(self.proxies.vertices.shape_ref(shape));
        if let Some(space) = &self.depth {
            fingerprint.add_depth_shape(&space.shape(id));
        }
        fingerprint.bits()
    }

    /// Returns the index of the proxy of a geom's convex piece; `None` if there is none.
    pub(super) fn proxy_of(&self, geom: GeomId, piece: u32) -> Option<u32> {
        let first = if is_geom(geom) {
            entry_of(&self.first_proxies, geom.slot())
        } else {
            self.world_proxy_of(geom)
        };
        let at = first? + piece as usize;
        let proxy = self.proxies.all.get(at)?;
        (proxy.geom == geom && proxy.piece == piece).then_some(at as u32)
    }

    /// Inserts a new proxy into the broad phase: computes its fat AABB and lists the proxy for the next search of pairs.
    pub(super) fn insert_proxy(&mut self, proxy: u32) {
        self.proxies.refitted.push(proxy);
        self.enlarge_aabb(proxy);
    }

    /// Inserts a proxy into the broad phase with a saved fat AABB (`bounds`) and fat interval along z (`depths`), length units.
    pub(super) fn insert_proxy_with_aabb(&mut self, proxy: u32, bounds: PackedAabb, depths: DepthInterval) {
        self.proxies.fat_aabbs[proxy as usize] = bounds;
        let may_stop = self.proxies.all[proxy as usize].may_stop();
        let Some(space) = self.depth.as_deref_mut() else {
            return self.grid.insert_or_move(proxy, &bounds, may_stop);
        };
        space.set_interval(proxy, depths);
        if space.is_in_grid(proxy) {
            self.grid.insert_or_move(proxy, &space.grid_bounds(proxy, &bounds), may_stop);
        }
    }
}

/// Returns whether a body is simulated. It is enabled, and it is dynamic or kinematic in the simulator's list of bodies or has
/// a geom in the simulator's list of geoms.
fn is_simulated(id: BodyId, objects: &Objects) -> bool {
    let Some(entry) = objects.bodies.get(id).filter(|entry| entry.body.enabled()) else { return false };
    let has_geoms = || {
        entry.geoms.iter().any(|&geom| objects.geoms.lifecycle_state(geom).is_some_and(|life| life.is_listed))
    };
    (entry.body.is_integrated() && objects.bodies.lifecycle_state(id).is_some_and(|life| life.is_listed))
        || has_geoms()
}

/// Returns the friction and the restitution coefficient of a geom, dimensionless.
fn surface_coefficients(geom: &Geom) -> [f32; 2] {
    [geom.friction_coefficient(), geom.restitution_coefficient()].map(without_negative_zero)
}

/// Returns `value`, with +0 in place of -0. Imports copy only values that compare unequal, so both zeros must have the same
/// bits.
fn without_negative_zero(value: f32) -> f32 {
    value + 0.0
}

/// Changes of a proxy by an import, which determine the update of its pairs.
struct ProxyUpdate {
    /// Whether the body was moved: the proxy gets a new fat AABB.
    moved: bool,
    /// Whether contact properties have changed: the pairs of the proxy are invalidated.
    contacts: bool,
    /// Whether collision callbacks were switched on or off.
    callbacks: bool,
    /// Whether the one-way direction has changed.
    one_way: bool,
}
