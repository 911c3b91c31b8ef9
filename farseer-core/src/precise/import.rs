//! Adapter: import of edits, which are moved and changed bodies and geoms, and the rebuild of all lists.
//!
//! The simulator marks edited bodies and geoms. [`import_edits`](Precise::import_edits) runs at the start of a step. It copies
//! changed properties, invalidates affected pairs and wakes sleeping bodies. After an edit that the lists cannot follow,
//! everything is [rebuilt](Precise::rebuild) from the state that a snapshot would hold. The module reads the simulator's
//! objects and writes bodies, proxies, pairs and sleep.

use super::Precise;
use super::body_import::{
    gyration_radius, has_other_pose_bits, inverse_mass_inertia_of, listed_body, pose_of, velocity_of,
    was_moved,
};
use super::geom_import::{
    ProxyImport, RecentShapes, one_way_direction, surface_coefficients, surface_velocity,
};
use super::ids::{IdTable, piece_at};
use super::listed::{Listed, is_simulated};
use super::saved::{EditPolicy, Saved};
use super::world_boxes::is_geom;
use crate::body::{Body, BodyId};
use crate::geom::GeomId;
use crate::geom::filter::is_valid_pair;
use crate::geom::sensor_pairs::may_keep_touching;
use crate::objects::{NewMembers, Objects};
use farseer_precise::Solver;
use farseer_precise::bodies::BodySet;
use farseer_precise::broad_phase::pair_finder::is_pair_reported;
use farseer_precise::broad_phase::pairs::Pairs;
use farseer_precise::broad_phase::proxies::{Proxies, Proxy};
use farseer_precise::depth::feature_gate::FeatureGate;
use farseer_precise::index::{BodyIndex, DenseIndex, IndexRange, ProxyIndex};
use farseer_precise::narrow_phase::pair_lifetime::initial_one_way_state;

impl Precise {
    /// Returns the index of a body into `bodies`; `None` if the body is not listed.
    pub(crate) fn body_index(&self, body: BodyId) -> Option<BodyIndex> {
        self.ids.body_index(body)
    }

    /// Copies pose, velocity, mass, gravity scale and surface velocity of an edited body to `bodies` and its proxies. Requests
    /// that a sleeping body wakes if it was moved, has another mass or is not at rest.
    fn import_body(&mut self, id: BodyId, objects: &Objects) {
        let (Some(entry), Some(index)) = (objects.bodies.get(id), self.body_index(id)) else { return };
        let body = &entry.body;
        let is_movable = index < self.solver.bodies.first_static();
        let depth = self.solver.depth.as_ref().map(FeatureGate::by_ref);
        let mut inverses = if is_movable { inverse_mass_inertia_of(body) } else { [0.0; 2] };
        inverses = depth.map_or(inverses, |space| space.without_fixed_inertia(index, inverses));
        let is_at_other_z = depth.is_some_and(|space| space.was_moved_along_z(index, id.slot()));
        let velocity = if is_movable { [0.0; 4] } else { surface_velocity(body, id, depth) };
        let has_moved = was_moved(&self.solver.bodies, index, body) || is_at_other_z;
        let has_mass_changed = inverses != self.solver.bodies.inverse_mass_inertia[index];
        let is_at_rest = body.is_at_rest_under(self.solver.bodies.gravity_scales[index])
            && self.rests_along_z(id, || true);
        if has_moved || has_mass_changed || !is_at_rest {
            self.solver.sleep.request_wake(index);
        } else {
            self.solver.sleep.record_force(index);
        }
        self.solver.bodies.inverse_mass_inertia[index] = inverses;
        if is_movable {
            set_geomless_extent(&mut self.solver.bodies, &self.solver.proxies, index, body);
        }
        if has_mass_changed {
            self.invalidate_joints();
        }
        self.solver.bodies.gravity_scales[index] = body.effective_gravity_scale();
        if is_movable {
            self.solver.bodies.are_bullets[index] = body.is_bullet();
        }
        self.sleep_options.note(id, body);
        if self.axis_locks.note(id, body) {
            self.solver.sleep.request_wake(index);
            self.joint_table.invalidate();
        }
        if !body.is_sleep_allowed() {
            self.solver.sleep.request_wake(index);
        }
        self.solver.bodies.set_velocity(index, velocity_of(body));
        if has_other_pose_bits(&self.solver.bodies, index, body) {
            self.solver.bodies.set_pose(index, pose_of(body));
        }
        if has_moved {
            self.solver.bodies.clear_delta_pose(index);
        }
        if let Some(space) = &mut self.solver.depth {
            space.import_body(&mut self.solver.bodies, index, id.slot());
        }
        for &geom in &entry.geoms {
            self.update_proxies(geom, |proxy| {
                let is_belt_changed = proxy.surface_velocity != velocity;
                proxy.surface_velocity = velocity;
                let contacts = has_mass_changed || is_belt_changed;
                ProxyUpdate { moved: has_moved, contacts, callbacks: false, one_way: false }
            });
        }
    }

    /// Computes the greatest and the least extent of the body at `index` from its shapes, and stores them in `bodies`, length
    /// units.
    pub(super) fn compute_extents(&mut self, index: BodyIndex, objects: &Objects) {
        let Solver { bodies, proxies, depth, .. } = &mut self.solver;
        let shapes = proxies.proxies_of(index).map(|proxy| proxies.proxy(proxy).shape);
        bodies.compute_extents(index, shapes.map(|shape| (shape, proxies.vertices.min_extent(shape))));
        if let Some(space) = depth.as_deref_mut() {
            space.update_is_ball(index, proxies);
        }
        if let Some(entry) = self.ids.bodies[index].and_then(|id| objects.bodies.get(id)) {
            set_geomless_extent(bodies, proxies, index, &entry.body);
        }
    }

    /// Copies friction, restitution, callback flag and one-way direction of an edited geom to its proxies, and updates their
    /// pairs.
    fn import_geom(&mut self, id: GeomId, objects: &Objects) {
        let Some(entry) = objects.geoms.get(id) else { return };
        let (geom, one_way) = (&entry.geom, one_way_direction(entry, self.solver.depth.is_some()));
        let [friction, restitution] = surface_coefficients(geom);
        let is_reported = geom.collision_callbacks_enabled();
        self.solver.has_restitution |= restitution != 0.0;
        let surface = geom.surface();
        self.solver.proxies.resist_rolling |= surface.rolling_resistance > 0.0;
        self.update_proxies(id, |proxy| {
            let has_surface_changed = std::mem::replace(&mut proxy.surface, surface) != surface;
            let have_coefficients_changed =
                has_surface_changed || proxy.friction != friction || proxy.restitution != restitution;
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

    /// Calls `apply` for each proxy of a geom, and updates the pairs of that proxy by the [`ProxyUpdate`] that `apply` returns.
    fn update_proxies(&mut self, geom: GeomId, mut apply: impl FnMut(&mut Proxy) -> ProxyUpdate) {
        for at in self.ids.proxies_of_geom(&self.solver.proxies, geom) {
            let was_one_way = self.solver.proxies.proxy(at).one_way.is_some();
            let update = apply(self.solver.proxies.proxy_mut(at));
            self.solver.proxies.one_way_count += usize::from(self.solver.proxies.proxy(at).one_way.is_some());
            self.solver.proxies.one_way_count -= usize::from(was_one_way);
            if update.moved {
                self.solver.fat_aabbs().teleport(at);
                self.solver.proxies.search_pairs_of(at);
            }
            if update.contacts || update.moved {
                self.solver.invalidate_pairs(at);
            }
            if update.callbacks {
                update_callbacks(&mut self.solver.pairs, &self.solver.proxies, at);
            }
            if update.one_way {
                reset_one_way_states(&mut self.solver.pairs, &self.solver.proxies, at);
            }
        }
    }

    /// First stage of a step: applies edits, additions and removals of bodies and geoms to the lists.
    ///
    /// After an edit that the lists cannot follow, everything is rebuilt from the state before all edits, as after
    /// loading a snapshot.
    pub(crate) fn import_edits(&mut self, objects: &Objects) {
        let has_edits = !(self.edits.bodies.is_empty() && self.edits.geoms.is_empty());
        if has_edits || self.edits.needs_rebuild || self.edits.has_membership_changes {
            return self.apply_edits(objects);
        }
        debug_assert!(
            !self.listed(objects).has_unmarked_change(&self.edits.disabled_bodies),
            "what comes, goes and changes is noted"
        );
        self.wake_requested_by_game();
        self.wake_for_changed_joints(objects);
        self.wake_up();
    }

    /// Applies edits, additions and removals of bodies and geoms to the lists: see [`import_edits`](Self::import_edits).
    fn apply_edits(&mut self, objects: &Objects) {
        let (mut bodies, mut geoms) =
            (std::mem::take(&mut self.edits.bodies), std::mem::take(&mut self.edits.geoms));
        self.edits.needs_rebuild |= geoms.iter().any(|&geom| self.listed(objects).has_changed_filter(geom));
        if !self.edits.needs_rebuild {
            self.list_changed_types(&bodies, objects);
        }
        let has_new_members = std::mem::take(&mut self.edits.has_membership_changes);
        let mut new_members = std::mem::take(&mut self.edits.new_members);
        let had_one_way = self.solver.proxies.one_way_count > 0;
        let before = (cfg!(debug_assertions) && has_new_members).then(|| (self.save(), bodies.clone()));
        if has_new_members {
            // In the middle of an update, objects may be disposed and still be listed. A rebuild drops them.
            let has_disposed = !(objects.bodies.disposed().is_empty() && objects.geoms.disposed().is_empty());
            self.edits.needs_rebuild = self.edits.needs_rebuild
                || self.loaded.is_some()
                || has_disposed
                || !self.apply_add_remove(&new_members, objects);
        }
        debug_assert!(
            self.edits.needs_rebuild
                || !self.listed(objects).has_unmarked_change(&self.edits.disabled_bodies),
            "what comes, goes and changes is noted"
        );
        if self.edits.needs_rebuild {
            let saved = self.loaded.take().unwrap_or_else(|| self.save());
            self.rebuild(objects, &saved, EditPolicy::Apply(&bodies));
        } else {
            self.apply_listed_edits(&mut bodies, &geoms, &new_members, objects);
            if !had_one_way && self.solver.proxies.one_way_count > 0 {
                self.solver.bodies.clear_delta_poses();
            }
        }
        bodies.clear();
        geoms.clear();
        new_members.clear();
        (self.edits.bodies, self.edits.geoms, self.edits.new_members) = (bodies, geoms, new_members);
        self.wake_for_changed_joints(objects);
        self.wake_up();
        debug_assert!(
            before.is_none_or(|(before, edited)| self.equals_rebuild(objects, &before, &edited)),
            "who comes and goes changes no bit of the others"
        );
    }

    /// Applies the edits of `bodies` and `geoms` to the lists, which have all of them but those of `bodies` that are not simulated;
    /// these remain in `bodies`. `new_members` have entered the lists in this import.
    fn apply_listed_edits(
        &mut self,
        bodies: &mut Vec<BodyId>,
        geoms: &[GeomId],
        new_members: &NewMembers,
        objects: &Objects,
    ) {
        self.wake_requested_by_game();
        bodies.iter().for_each(|&body| self.import_body(body, objects));
        bodies.retain(|&body| self.body_index(body).is_none());
        if !bodies.is_empty() {
            self.reread_joints_of_unlisted(bodies);
        }
        geoms.iter().for_each(|&geom| self.import_geom(geom, objects));
        new_members.geoms.iter().for_each(|&geom| begin_travel(&self.ids, &mut self.solver.proxies, geom));
    }

    /// Returns the listed bodies and proxies, for a comparison with `objects`.
    pub(super) fn listed<'a>(&'a self, objects: &'a Objects) -> Listed<'a> {
        Listed { ids: &self.ids, bodies: &self.solver.bodies, proxies: &self.solver.proxies, objects }
    }

    /// Adds to the new members those of the edited `bodies` that have changed their type, or are simulated now and were not
    /// before. They come with all of their geoms, as if they had left the simulator's lists and entered them again.
    fn list_changed_types(&mut self, bodies: &[BodyId], objects: &Objects) {
        let mut changed = NewMembers::default();
        let (listed, members) = (self.listed(objects), &self.edits.new_members);
        let is_new = |id: BodyId| is_simulated(id, objects) && !has_entered(id, members, objects);
        for &id in bodies.iter().filter(|&&id| listed.has_changed_type(id).unwrap_or_else(|| is_new(id))) {
            let Some(entry) = objects.bodies.get(id) else { continue };
            changed.bodies.push(id);
            let is_listed =
                |&geom: &GeomId| objects.geoms.lifecycle_state(geom).is_some_and(|life| life.is_listed);
            changed.geoms.extend(entry.geoms.iter().copied().filter(is_listed));
        }
        if !changed.bodies.is_empty() {
            self.edits.mark_membership_changed(&mut changed);
        }
    }

    /// Returns whether this state equals the result of a rebuild from the saved state `before`, after the game has edited the
    /// bodies `edited`. For debug assertions.
    fn equals_rebuild(&self, objects: &Objects, before: &Saved, edited: &[BodyId]) -> bool {
        let mut rebuilt = self.clone();
        rebuilt.rebuild(objects, before, EditPolicy::Apply(edited));
        rebuilt.wake_for_changed_joints(objects);
        rebuilt.wake_up();
        // Restitution that is gone costs time, but changes no bit.
        let has_restitution = self.solver.has_restitution || !rebuilt.solver.has_restitution;
        has_restitution && rebuilt.save() == self.save()
    }

    /// Rebuilds all lists from the simulated bodies and geoms, and restores the state of known bodies and pairs from `saved`.
    /// `edits`: when edits made since that state take effect.
    pub(super) fn rebuild(&mut self, objects: &Objects, saved: &Saved, edits: EditPolicy<'_>) {
        (self.edits.needs_rebuild, self.edits.has_membership_changes) = (false, false);
        self.edits.new_members.clear();
        // Indices of proxies change here, also if a handler has caused the rebuild in the middle of an update.
        self.solver.rolling_contacts.clear();
        self.sleep_events.note_rebuild();
        self.invalidate_joints();
        self.rebuild_bodies(objects);
        self.rebuild_proxies(objects);
        self.list_always_tested(objects);
        self.solver.sleep.reset(&self.solver.bodies.has_body);
        if let Some(space) = &mut self.solver.depth {
            space.fix_rotation_of_all(&self.solver.proxies, &mut self.solver.bodies);
            space.keep_moving_boxes_awake(&mut self.solver.sleep);
        }
        self.solver.direct_solver.reset(self.solver.bodies.states.len());
        // The body indices in the springs have become invalid.
        self.solver.springs.clear();
        self.solver.bodies.movable().for_each(|number| self.compute_extents(number, objects));
        self.restore(saved, objects, edits);
    }

    /// Returns whether a body has velocity 0 and no pending impulse. The game's forces along z count as an impulse, those of
    /// fields do not: [`wake_disturbed`](Self::wake_disturbed) compares them with those that the body fell asleep under.
    pub(super) fn is_at_rest(&self, id: BodyId, objects: &Objects, edits: EditPolicy<'_>) -> bool {
        let body = objects.bodies.get(id).map(|entry| &entry.body);
        let is_edited = || matches!(edits, EditPolicy::Apply(edited) if edited.contains(&id));
        body.is_some_and(|body| body.is_at_rest_under(body.effective_gravity_scale()))
            && self.rests_along_z(id, is_edited)
    }

    /// Returns whether the collision filters still allow the pair of these geoms, which existed before.
    pub(super) fn may_keep_pair(&self, geoms: (GeomId, GeomId), objects: &Objects) -> bool {
        let may_stay = if self.solver.depth.is_some() { is_valid_pair } else { may_keep_touching };
        self.may_meet_world_geom(geoms, objects).unwrap_or_else(|| {
            may_stay(geoms, &objects.geoms, &objects.bodies) && !objects.are_separated_geoms(geoms)
        })
    }

    /// Lists the simulated bodies: dynamic and kinematic ones, then static ones with geoms, in the order of the simulator's
    /// lists.
    fn rebuild_bodies(&mut self, objects: &Objects) {
        let bodies = &objects.bodies;
        let movable = || (0..bodies.list().len()).filter_map(|at| bodies.at(at));
        let integrated = || movable().filter(|(_, entry)| entry.body.is_integrated());
        let mut static_bodies = Vec::new();
        let mut is_visited = vec![false; bodies.slot_count()];
        let mut visit = |id: BodyId| !std::mem::replace(&mut is_visited[id.slot()], true);
        integrated().for_each(|(id, _)| {
            visit(id);
        });
        for at in 0..objects.geoms.list().len() {
            let Some((_, geom)) = objects.geoms.at(at) else { continue };
            if bodies.get(geom.body).is_some_and(|entry| entry.body.enabled()) && visit(geom.body) {
                static_bodies.push(geom.body);
            }
        }
        self.solver.bodies.rebuild(
            bodies.list().len(),
            self.solver.depth.iter().flat_map(|space| space.moving_poses()),
            integrated().map(|(_, entry)| listed_body(&entry.body, true)),
            static_bodies.iter().map(|&id| listed_body(&bodies[id].body, false)),
        );
        self.ids.clear_bodies(self.solver.bodies.poses.len());
        let first_body = self.solver.bodies.last_movable.position() + 1 - self.solver.bodies.movable_count;
        let indices = IndexRange::new(BodyIndex::new(first_body), self.solver.bodies.movable_count);
        indices.zip(integrated()).for_each(|(index, (id, _))| self.ids.add_body(index, id));
        IndexRange::new(self.solver.bodies.first_static(), static_bodies.len())
            .zip(static_bodies)
            .for_each(|(index, id)| self.ids.add_body(index, id));
        self.rebuild_world_boxes();
        // The ground and the static boxes follow all bodies, and have no ids.
        self.ids.bodies.resize(self.solver.bodies.poses.len(), None);
        self.edits.disabled_bodies.clear();
        self.edits
            .disabled_bodies
            .extend(movable().filter(|(_, entry)| !entry.body.enabled()).map(|(id, _)| id));
        for (id, entry) in integrated() {
            self.sleep_options.note(id, &entry.body);
            self.axis_locks.note(id, &entry.body);
        }
        if let Some(space) = self.solver.depth.as_deref_mut() {
            // A force along the depth axis on a body that a handler has made static is in no snapshot, so it is removed here,
            // too.
            let unmoved = movable().filter(|(_, entry)| !entry.body.is_integrated());
            unmoved.for_each(|(id, _)| space.set_acceleration(id.slot(), 0.0));
        }
    }

    /// Lists a proxy for each convex piece: pieces of dynamic and kinematic bodies, capacity for new ones, then pieces of
    /// static bodies.
    fn rebuild_proxies(&mut self, objects: &Objects) {
        self.solver.proxies.clear();
        self.solver.proxies.reserve_lists(objects.geoms.list().len());
        self.ids.clear_geoms();
        self.solver.proxy_flags.clear();
        self.solver.has_restitution = false;
        let first_fixed = self.solver.bodies.first_static();
        let Solver { depth, proxies, has_restitution, .. } = &mut self.solver;
        *has_restitution |= depth.as_mut().is_some_and(|space| space.add_moving_box_proxies(proxies));
        self.proxy_import(objects).push_all(|body| body < first_fixed);
        self.solver.proxies.add_spare_positions(objects.geoms.list().len());
        self.proxy_import(objects).push_all(|body| body >= first_fixed);
        let Solver { depth, proxies, has_restitution, bodies, .. } = &mut self.solver;
        *has_restitution |= depth
            .as_mut()
            .is_some_and(|space| space.add_ground_and_static_proxies(proxies, bodies.poses.len()));
        self.solver.proxies.link_bodies(self.solver.bodies.poses.len());
        self.solver.proxy_flags.resize(self.solver.proxies.position_count(), false);
    }

    /// Returns the parts from which the proxies of geoms follow.
    pub(super) fn proxy_import<'a>(&'a mut self, objects: &'a Objects) -> ProxyImport<'a> {
        ProxyImport {
            ids: &mut self.ids,
            bodies: &self.solver.bodies,
            proxies: &mut self.solver.proxies,
            depth: self.solver.depth.as_ref().map(FeatureGate::by_ref),
            has_restitution: &mut self.solver.has_restitution,
            objects,
            recent_shapes: RecentShapes::default(),
        }
    }

    /// Returns the index of the proxy of a geom's convex piece; `None` if there is none.
    pub(super) fn proxy_of(&self, geom: GeomId, piece: u32) -> Option<ProxyIndex> {
        let first = if is_geom(geom) { self.ids.first_proxy(geom) } else { self.world_proxy_of(geom) };
        let at = first?.0.checked_add(piece)?;
        piece_at(&self.solver.proxies, ProxyIndex(at), (geom, piece))
    }
}

/// Sets the travel of a new geom's proxies to 0. They have no pairs yet, and their body may have moved in the same import.
fn begin_travel(ids: &IdTable, proxies: &mut Proxies, geom: GeomId) {
    let places = ids.proxies_of_geom(proxies, geom);
    places.for_each(|at| proxies.set_travel(at, 0));
}

/// Returns whether a simulated body, if it is dynamic or kinematic, and all of its geoms are among the `members` that have
/// entered the simulator's lists.
fn has_entered(id: BodyId, members: &NewMembers, objects: &Objects) -> bool {
    let Some(entry) = objects.bodies.get(id) else { return false };
    let is_listed = |&&geom: &&GeomId| objects.geoms.lifecycle_state(geom).is_some_and(|life| life.is_listed);
    (!entry.body.is_integrated() || members.has_body(id))
        && entry.geoms.iter().filter(is_listed).all(|&geom| members.has_geom(geom))
}

/// Sets the greatest extent of a dynamic body without geoms to its radius of gyration, length units.
fn set_geomless_extent(bodies: &mut BodySet, proxies: &Proxies, index: BodyIndex, body: &Body) {
    if !body.is_kinematic() && proxies.proxies_of(index).next().is_none() {
        bodies.max_extents[index] = gyration_radius(body);
    }
}

/// Sets for each pair of a proxy whether a collision handler is called for the pair.
fn update_callbacks(pairs: &mut Pairs, proxies: &Proxies, proxy: ProxyIndex) {
    pairs.for_each_index_of(proxy, |pairs, pair| {
        let is_reported = is_pair_reported(proxies, pairs.proxies_of(pair));
        pairs.set_reported(pair, is_reported);
    });
}

/// Resets the one-way states of all pairs of a proxy, after the one-way direction of the proxy has changed.
pub(super) fn reset_one_way_states(pairs: &mut Pairs, proxies: &Proxies, proxy: ProxyIndex) {
    pairs.for_each_index_of(proxy, |pairs, pair| {
        pairs.state_mut(pair).one_way_state = initial_one_way_state(proxies, pairs, pair);
    });
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
