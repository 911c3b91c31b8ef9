//! Adapter: addition and removal of bodies and geoms without a rebuild of all lists.
//!
//! New bodies and proxies are appended; removed ones leave an empty position. A body that becomes static or movable, enabled or
//! disabled, is removed and added, at its former place if it returns there. The state is bit-identical to that after a
//! [rebuild](Precise::rebuild). The cost is proportional to the number of changes, but for joints, which are imported anew, and
//! geoms that every query tests. With one-way geoms everything is rebuilt,
//! because their pair states depend on all bodies and geoms. The module reads the lists of the simulator and writes bodies,
//! proxies, pairs, constraints and sleep.

use super::Precise;
use super::body_import::listed_body;
use super::ids::{IdTable, geom_of};
use super::listed::Listed;
use super::vacancies::fits_between;
use crate::body::BodyId;
use crate::geom::GeomId;
use crate::objects::{NewMembers, Objects};
use crate::precise::ids::AlwaysTested;
use crate::precise::sleeping_joints::drop_joints_of_awake;
use crate::storage::order::sort_by_number;
use farseer_precise::bodies::{BodySet, spare_capacity};
use farseer_precise::broad_phase::hash_grid::HashGrid;
use farseer_precise::broad_phase::proxies::Proxies;
use farseer_precise::index::{BodyIndex, DenseIndex, IndexRange, ProxyIndex};
use farseer_precise::island::sleep::SleepState;
use farseer_precise::parameters::broad_phase::MIN_EMPTY_POSITIONS_TO_COMPACT;

/// Bodies and geoms by which the simulator's lists differ from those of the precise set.
#[derive(Default)]
struct MembershipDiff {
    /// Indices of removed dynamic and kinematic bodies into `bodies`, ascending.
    removed_bodies: Vec<BodyIndex>,
    /// Indices of the proxies of removed geoms, ascending.
    removed_proxies: Vec<ProxyIndex>,
    /// Ids of new dynamic and kinematic bodies, in the order of the simulator's list.
    added_bodies: Vec<BodyId>,
    /// For each of `added_bodies` the index to which it returns; `None` if it is appended.
    body_places: Vec<Option<BodyIndex>>,
    /// Ids of new geoms, in the order of the simulator's list.
    added_geoms: Vec<GeomId>,
    /// For each of `added_geoms` the index of its first proxy if it returns there; `None` if its proxies are appended.
    geom_places: Vec<Option<ProxyIndex>>,
    /// Ids of the bodies that have changed their type, in the order of their slots: static, movable or disabled.
    retyped_bodies: Vec<BodyId>,
    /// Ids of new disabled bodies.
    disabled_bodies: Vec<BodyId>,
    /// Ids of new geoms whose body is disabled or missing.
    geoms_of_disabled: Vec<GeomId>,
}

impl Precise {
    /// Applies additions and removals of bodies and geoms to the lists. `changed`: what has entered or left the simulator's lists
    /// since the last import. Returns whether that was possible. If it returns false, nothing is changed and a rebuild is needed:
    /// there are other changes, too, or the lists have no capacity left.
    pub(super) fn apply_add_remove(&mut self, changed: &NewMembers, objects: &Objects) -> bool {
        let listed = self.listed(objects);
        let world_proxies = self.solver.depth.as_ref().map_or(0, |space| space.world_proxy_count());
        let diff = MembershipDiff::new(&listed, changed, world_proxies)
            .filter(|diff| !diff.involves_one_way(&listed) && diff.has_capacity(&listed, &self.solver.grid))
            .filter(|diff| !diff.retypes_sleeping(&listed, &self.solver.sleep));
        let Some(members) = diff else { return false };
        // As a rebuild does: a handler may have caused the import in the middle of an update, and only one of two worlds with
        // equal snapshots may have the capacity to do without a rebuild.
        self.solver.rolling_contacts.clear();
        let rest_times = members.kept_rest_times(&self.ids, &self.solver.bodies, &self.solver.sleep);
        self.remove_members(&members, objects);
        for (&id, &place) in members.added_bodies.iter().zip(&members.body_places) {
            self.add_body(id, place, objects);
        }
        for (index, rest_time) in rest_times {
            self.solver.sleep.rest_time[index] = rest_time;
        }
        for (&id, &place) in members.added_geoms.iter().zip(&members.geom_places) {
            self.add_geom(id, place, objects);
        }
        for &id in &members.added_bodies {
            if let Some(index) = self.body_index(id) {
                self.compute_extents(index, objects);
            }
        }
        self.update_always_tested(changed, &members, objects);
        if let Some(space) = self.solver.depth.as_deref_mut() {
            // A force along the depth axis on a body that has become static is in no snapshot, so it is removed here, too.
            let is_unmoved =
                |id: &BodyId| objects.bodies.get(*id).is_some_and(|entry| !entry.body.is_integrated());
            let unmoved = members.retyped_bodies.iter().copied().filter(is_unmoved);
            unmoved.for_each(|id| space.set_acceleration(id.slot(), 0.0));
        }
        if cfg!(debug_assertions) {
            let is_disabled =
                |id: &BodyId| objects.bodies.get(*id).is_some_and(|entry| !entry.body.enabled());
            self.edits.disabled_bodies.extend_from_slice(&members.disabled_bodies);
            self.edits.disabled_bodies.retain(is_disabled);
        }
        self.invalidate_joints();
        drop_joints_of_awake(&mut self.sleeping_joints, &self.ids, &self.solver.sleep);
        members.update_runs(&self.ids, &self.solver.proxies, &mut self.solver.sleep);
        true
    }

    /// Removes the proxies of removed geoms with their pairs and constraints, and the removed bodies. Bodies and geoms that stay in
    /// the simulator's lists may return to their places.
    fn remove_members(&mut self, diff: &MembershipDiff, objects: &Objects) {
        let MembershipDiff { removed_bodies, removed_proxies, .. } = diff;
        let sleeping = removed_bodies.iter().filter(|&&body| self.solver.sleep.is_asleep(body));
        self.sleep_events.note_woken(sleeping.filter_map(|&body| self.ids.bodies[body]));
        // A removed body wakes nothing later.
        removed_bodies.iter().for_each(|&number| self.solver.sleep.remove_body(number));
        let pairs = removed_proxies.iter().flat_map(|&proxy| self.solver.pairs.pairs_of(proxy));
        let pairs = pairs.collect();
        self.solver.narrow_phase().remove_pairs(pairs);
        self.solver.proxies.retain_refitted(|proxy| removed_proxies.binary_search(proxy).is_err());
        // The list of a body begins with its newest proxy, so that descending order finds each at the head.
        for &proxy in removed_proxies.iter().rev() {
            let removed = self.solver.proxies.proxy(proxy);
            let (geom, body, key) = (geom_of(removed), removed.body, removed.list_key);
            if body < self.solver.bodies.first_static() && is_geom_listed(objects, geom) {
                self.ids.vacant_proxies.leave(proxy, (geom, geom.slot()), key);
            }
            self.solver.grid.remove(proxy);
            self.solver.proxies.remove(proxy);
            self.ids.remove_geom(geom);
            // A static body without geoms is not listed.
            if body >= self.solver.bodies.first_static()
                && self.solver.proxies.proxies_of(body).next().is_none()
            {
                self.remove_body(body);
            }
        }
        for &index in removed_bodies {
            if let Some(id) = self.ids.bodies[index].filter(|&id| is_body_listed(objects, id)) {
                self.ids.vacant_bodies.leave(index, (id, id.slot()), objects.bodies.list_key(id));
            }
            self.remove_body(index);
        }
    }

    /// Removes the body at `index` from `bodies`, the direct solver and the graph colours.
    fn remove_body(&mut self, index: BodyIndex) {
        self.ids.remove_body(index);
        if index < self.solver.bodies.first_static() {
            self.solver.direct_solver.forget_body(index);
            self.solver.color_usage.remove_body(index);
        }
        self.solver.bodies.remove(index);
    }

    /// Adds a dynamic or kinematic body to `bodies`, the graph colours and the sleep state: at the index `place` if it returns there.
    fn add_body(&mut self, id: BodyId, place: Option<BodyIndex>, objects: &Objects) {
        let body = &objects.bodies[id].body;
        let Some(index) = self.solver.bodies.add_movable(&listed_body(body, true), place) else { return };
        self.ids.add_body(index, id);
        self.solver.color_usage.add_body(index, self.solver.bodies.inverse_mass_inertia[index]);
        self.solver.sleep.add_body(index);
        self.sleep_options.note(id, body);
        self.axis_locks.note(id, body);
        if let Some(space) = &mut self.solver.depth {
            space.add_body(index, id.slot());
            space.import_body(&mut self.solver.bodies, index, id.slot());
        }
    }

    /// Adds the proxies of a geom, from the index `place` on if it returns there, and its body if that is static and not listed yet.
    fn add_geom(&mut self, id: GeomId, place: Option<ProxyIndex>, objects: &Objects) {
        let Some(geom) = objects.geoms.get(id) else { return };
        if self.body_index(geom.body).is_none() {
            let index = self.solver.bodies.add_static(&listed_body(&objects.bodies[geom.body].body, false));
            self.ids.add_body(index, geom.body);
        }
        self.proxy_import(objects).add(id, place);
        let count = self.solver.proxies.position_count();
        self.solver.proxy_flags.resize(count, false);
        self.solver.grid.grow(count);
        self.solver.pairs.grow(count);
        for proxy in self.ids.proxies_of_geom(&self.solver.proxies, id) {
            if let Some(space) = self.solver.depth.as_deref_mut() {
                space.add_proxy(proxy, id.to_bits());
                space.fix_rotation_of_proxy(proxy, &self.solver.proxies, &mut self.solver.bodies);
            }
            self.solver.fat_aabbs().insert(proxy);
            // The new body may form an island for the direct solver.
            self.solver.direct_solver.timer.is_due = true;
        }
    }

    /// Updates the list of geoms that every AABB query tests.
    fn update_always_tested(&mut self, changed: &NewMembers, diff: &MembershipDiff, objects: &Objects) {
        self.always_tested.retain(|tested| !changed.has_geom(tested.geom));
        for &id in diff.added_geoms.iter().chain(&diff.geoms_of_disabled) {
            let is_covered = |geom| self.proxy_covers_geom(id, geom);
            if !objects.geoms.get(id).is_some_and(is_covered) {
                self.always_tested.push(AlwaysTested { list_key: objects.geoms.list_key(id), geom: id });
            }
        }
        self.always_tested.sort_unstable_by_key(|tested| tested.list_key);
    }
}

impl MembershipDiff {
    /// Returns whether a one-way geom exists or is added.
    fn involves_one_way(&self, listed: &Listed<'_>) -> bool {
        let mut new = self.added_geoms.iter().filter_map(|&id| listed.objects.geoms.get(id));
        listed.proxies.one_way_count > 0 || new.any(|geom| geom.one_way.is_some())
    }

    /// Returns whether a sleeping body becomes kinematic or dynamic in place. It would wake its island, and a rebuild does not.
    fn retypes_sleeping(&self, listed: &Listed<'_>, sleep: &SleepState) -> bool {
        let present = self.added_bodies.iter().filter_map(|&id| listed.ids.body_index(id));
        present.filter(|&index| index < listed.bodies.first_static()).any(|index| sleep.is_asleep(index))
    }

    /// Returns the bodies and geoms that were added and removed. `changed`: what has entered or left the simulator's lists.
    /// `world_proxies`: number of proxies of world boxes and the ground. `None` if a movable body has changed its type, or a
    /// body or geom its place in the order.
    fn new(listed: &Listed<'_>, changed: &NewMembers, world_proxies: usize) -> Option<Self> {
        let mut diff = MembershipDiff::default();
        changed.bodies.iter().try_for_each(|&id| diff.compare_body(listed, id))?;
        changed.geoms.iter().try_for_each(|&id| diff.compare_geom(listed, id))?;
        let Objects { bodies, geoms, .. } = listed.objects;
        sort_by_number(&mut diff.added_bodies, |&id| bodies.list_key(id).into());
        sort_by_number(&mut diff.added_geoms, |&id| geoms.list_key(id).into());
        diff.removed_bodies.sort_unstable();
        diff.removed_proxies.sort_unstable();
        diff.find_places(listed);
        (diff.is_complete(listed, world_proxies) && diff.follows_others(listed)).then_some(diff)
    }

    /// Finds out whether a body that has entered or left the simulator's list was added, removed or is disabled. Returns `None`
    /// if it is movable and has changed its type, or has changed its place in the order.
    fn compare_body(&mut self, listed: &Listed<'_>, id: BodyId) -> Option<()> {
        let bodies = &listed.objects.bodies;
        let index = listed.ids.body_index(id);
        let movable = index.filter(|&index| index < listed.bodies.first_static());
        let is_in_list = bodies.lifecycle_state(id).is_some_and(|life| life.is_listed);
        if !is_in_list {
            self.removed_bodies.extend(movable);
            return Some(());
        }
        let entry = bodies.get(id).filter(|_| !bodies.is_disposed(id))?;
        if index.is_some() && listed.has_changed_type(id) == Some(true) {
            self.retyped_bodies.push(id);
        }
        if entry.body.is_integrated() {
            // A kinematic body that becomes dynamic, or the reverse, leaves its place and returns to it.
            let becomes_kinematic = entry.body.is_kinematic();
            let is_retyped =
                index.is_some_and(|index| listed.bodies.is_kinematic(index) != becomes_kinematic);
            self.removed_bodies.extend(movable);
            self.added_bodies.push(id);
            return (movable.is_none() || is_retyped).then_some(());
        }
        self.removed_bodies.extend(movable);
        if !entry.body.enabled() {
            self.disabled_bodies.push(id);
        }
        Some(())
    }

    /// Returns the movable bodies that are removed and return to their places at once, because they become kinematic or dynamic.
    /// None of them [sleeps](Self::retypes_sleeping). Each item is the index of the body and the time for which it has been at
    /// rest (seconds), which it keeps.
    fn kept_rest_times(&self, ids: &IdTable, bodies: &BodySet, sleep: &SleepState) -> Vec<(BodyIndex, f32)> {
        let present = self.added_bodies.iter().filter_map(|&id| ids.body_index(id));
        let movable = present.filter(|&index| index < bodies.first_static());
        movable.map(|index| (index, sleep.rest_time[index])).collect()
    }

    /// Finds the places to which movable bodies and their geoms return.
    fn find_places(&mut self, listed: &Listed<'_>) {
        let Listed { bodies, proxies, ids, objects } = listed;
        let body_key = |at: BodyIndex| body_key_at(listed, at);
        let body_place = |&id: &BodyId| {
            let key = objects.bodies.list_key(id);
            let present = ids.body_index(id).filter(|&index| index < bodies.first_static());
            let place = present.or_else(|| ids.vacant_bodies.place_of((id, id.slot()), key, 1))?;
            fits_between(IndexRange::new(place, 1), key, bodies.last_movable.next(), body_key)
                .then_some(place)
        };
        self.body_places = self.added_bodies.iter().map(body_place).collect();
        let proxy_key = |at: ProxyIndex| proxy_key_at(listed, at);
        let geom_place = |&id: &GeomId| {
            let (geom, key) = (objects.geoms.get(id)?, objects.geoms.list_key(id));
            let count = geom.pieces().len();
            let is_movable = objects.bodies.get(geom.body).is_some_and(|entry| entry.body.is_integrated());
            let pieces = ids.proxies_of_geom(proxies, id);
            let is_present = pieces.len() == count && pieces.start < proxies.first_fixed;
            let vacant = || ids.vacant_proxies.place_of((id, id.slot()), key, count);
            let place = is_present.then_some(pieces.start).or_else(vacant).filter(|_| is_movable)?;
            fits_between(IndexRange::new(place, count), key, proxies.movable_end, proxy_key).then_some(place)
        };
        self.geom_places = self.added_geoms.iter().map(geom_place).collect();
    }

    /// Returns whether the new bodies and geoms without a place to return to follow all others in the order of the simulator's lists.
    /// Geoms of static bodies may have any place, because the order of their proxies has no effect.
    fn follows_others(&self, listed: &Listed<'_>) -> bool {
        let Listed { bodies, proxies, ids, objects } = listed;
        let is_movable = |id: &&GeomId| {
            let body = objects.geoms.get(**id).and_then(|geom| objects.bodies.get(geom.body));
            body.is_some_and(|entry| entry.body.is_integrated())
        };
        let stays = |index: BodyIndex| self.removed_bodies.binary_search(&index).is_err();
        let body_key = |at: BodyIndex| match ids.bodies[at] {
            Some(id) => stays(at).then(|| objects.bodies.list_key(id)),
            None => ids.vacant_bodies.key_at(at),
        };
        let is_left = |at: ProxyIndex| self.removed_proxies.binary_search(&at).is_err();
        let proxy_key = |at: ProxyIndex| proxy_key_at(listed, at).filter(|_| is_left(at));
        let last_body = bodies.movable().rev().find_map(body_key);
        let last_geom = proxies.movable().rev().find_map(proxy_key);
        let mut new_bodies = self.added_bodies.iter().zip(&self.body_places);
        let first_body =
            new_bodies.find(|(_, place)| place.is_none()).map(|(&id, _)| objects.bodies.list_key(id));
        let mut new_geoms = self.added_geoms.iter().zip(&self.geom_places);
        let first_geom = new_geoms
            .find(|(id, place)| place.is_none() && is_movable(id))
            .map(|(&id, _)| objects.geoms.list_key(id));
        first_body.is_none_or(|first| last_body.is_none_or(|last| last < first))
            && first_geom.is_none_or(|first| last_geom.is_none_or(|last| last < first))
    }

    /// Finds out whether a geom that has entered or left the simulator's list was added or removed. Returns `None` if its place
    /// in the order has changed.
    fn compare_geom(&mut self, listed: &Listed<'_>, id: GeomId) -> Option<()> {
        let Objects { bodies, geoms, .. } = listed.objects;
        let pieces = listed.ids.proxies_of_geom(listed.proxies, id);
        let is_in_list = geoms.lifecycle_state(id).is_some_and(|life| life.is_listed);
        if !is_in_list {
            self.removed_proxies.extend(pieces);
            return Some(());
        }
        let geom = geoms.get(id).filter(|_| !geoms.is_disposed(id))?;
        if !pieces.has_ended() && self.retyped_bodies.binary_search(&geom.body).is_err() {
            return None;
        }
        self.removed_proxies.extend(pieces);
        let is_enabled = bodies.get(geom.body).is_some_and(|entry| entry.body.enabled());
        let list = if is_enabled { &mut self.added_geoms } else { &mut self.geoms_of_disabled };
        list.push(id);
        Some(())
    }

    /// Updates the index ranges of awake bodies where bodies and proxies were added or removed.
    fn update_runs(&self, ids: &IdTable, proxies: &Proxies, sleep: &mut SleepState) {
        let added_bodies = self.added_bodies.iter().filter_map(|&id| ids.body_index(id));
        let bodies: Vec<BodyIndex> = self.removed_bodies.iter().copied().chain(added_bodies).collect();
        let added = self.added_geoms.iter().flat_map(|&id| ids.proxies_of_geom(proxies, id));
        let removed = self.removed_proxies.iter().copied();
        let changed: Vec<ProxyIndex> = removed.chain(added).collect();
        sleep.update_runs_at(&bodies, &changed, proxies);
    }

    /// Returns whether each dynamic or kinematic body that was added or removed was so with all of its geoms.
    fn is_complete(&self, listed: &Listed<'_>, world_proxies: usize) -> bool {
        let is_removed = |proxy: ProxyIndex| self.removed_proxies.binary_search(&proxy).is_ok();
        let has_removed_body = |proxy: &ProxyIndex| {
            let body = listed.proxies.body_of(*proxy);
            body >= listed.bodies.first_static() || self.removed_bodies.binary_search(&body).is_ok()
        };
        let Objects { bodies, geoms, .. } = listed.objects;
        let body_of = |id: GeomId| geoms.get(id).map(|geom| geom.body);
        let has_new_or_static_body = |&id: &GeomId| {
            let known = body_of(id).and_then(|body| listed.ids.body_index(body));
            known.is_none_or(|number| {
                number >= listed.bodies.first_static() || self.removed_bodies.binary_search(&number).is_ok()
            })
        };
        let has_left = |&id: &BodyId| {
            let index = listed.ids.body_index(id);
            index.is_none_or(|index| listed.proxies.proxies_of(index).all(is_removed))
        };
        // Proxies of static geoms are listed before those of world boxes, so that no static geom can be appended.
        let is_new_body = |body: BodyId| {
            let key = |&id: &BodyId| bodies.list_key(id);
            self.added_bodies
                .binary_search_by_key(&key(&body), key)
                .is_ok_and(|at| self.added_bodies[at] == body)
        };
        let is_new = |&id: &GeomId| body_of(id).is_some_and(is_new_body);
        if world_proxies > 0 && !self.added_geoms.iter().all(is_new) {
            return false;
        }
        self.removed_bodies.iter().all(|&number| listed.proxies.proxies_of(number).all(is_removed))
            && self.added_bodies.iter().all(has_left)
            && self.removed_proxies.iter().all(has_removed_body)
            && self.added_geoms.iter().all(has_new_or_static_body)
    }

    /// Returns whether the lists have capacity for the additions, and whether enough positions are used after the removals.
    /// Enough means that twice the used positions, [`MIN_EMPTY_POSITIONS_TO_COMPACT`] and the spare capacity are at least all
    /// positions.
    fn has_capacity(&self, listed: &Listed<'_>, grid: &HashGrid) -> bool {
        let Listed { bodies, proxies, .. } = listed;
        let appended = self.added_geoms.iter().zip(&self.geom_places).filter(|(_, place)| place.is_none());
        let geoms = appended.filter_map(|(&id, _)| listed.objects.geoms.get(id));
        let is_movable =
            |body: BodyId| listed.objects.bodies.get(body).is_some_and(|entry| entry.body.is_integrated());
        let (mut pieces, mut movable_pieces) = (0, 0);
        for geom in geoms {
            let count = geom.pieces().len();
            pieces += count;
            movable_pieces += if is_movable(geom.body) { count } else { 0 };
        }
        let appended_bodies = self.body_places.iter().filter(|place| place.is_none()).count();
        let positions = proxies.position_count() - proxies.spare_count();
        let is_full_enough = |live: usize, removed: usize, places: usize| {
            2 * (live - removed) + MIN_EMPTY_POSITIONS_TO_COMPACT + spare_capacity(bodies.poses.len())
                >= places
        };
        bodies.last_movable.position() + appended_bodies < bodies.states.len()
            && movable_pieces <= proxies.spare_count()
            && grid.has_capacity(proxies.position_count() + pieces)
            && is_full_enough(bodies.movable_count, self.removed_bodies.len(), bodies.last_movable.position())
            && is_full_enough(proxies.live_count, self.removed_proxies.len(), positions)
    }
}

/// Returns whether a body is in the simulator's list.
fn is_body_listed(objects: &Objects, id: BodyId) -> bool {
    objects.bodies.lifecycle_state(id).is_some_and(|life| life.is_listed) && !objects.bodies.is_disposed(id)
}

/// Returns whether a geom is in the simulator's list.
fn is_geom_listed(objects: &Objects, id: GeomId) -> bool {
    objects.geoms.lifecycle_state(id).is_some_and(|life| life.is_listed) && !objects.geoms.is_disposed(id)
}

/// Returns the key in the order of the simulator's list of the body at this index, or of the body that has left it; `None` if there is
/// neither.
fn body_key_at(listed: &Listed<'_>, at: BodyIndex) -> Option<u32> {
    match listed.ids.bodies[at] {
        Some(id) => is_body_listed(listed.objects, id).then(|| listed.objects.bodies.list_key(id)),
        None => listed.ids.vacant_bodies.key_at(at),
    }
}

/// Returns the key in the order of the simulator's list of the geom whose proxy has this index, or of the geom that has left it; `None`
/// if there is neither.
fn proxy_key_at(listed: &Listed<'_>, at: ProxyIndex) -> Option<u32> {
    listed.proxies.list_key_of_geom(at).or_else(|| listed.ids.vacant_proxies.key_at(at))
}

#[cfg(test)]
mod tests {
    use crate::math::Vector2;
    use crate::{
        BodyFactory, BodyId, CollisionCategory, GeomFactory, GeomPlacement, Methods, PhysicsSimulator,
    };

    fn add_box(simulator: &mut PhysicsSimulator, at: [f32; 2], is_static: bool) -> BodyId {
        let body = BodyFactory::create_rectangle_body_in(simulator, 32.0, 32.0, 1.0).unwrap();
        simulator[body].set_position(Vector2::new(at[0], at[1]));
        simulator[body].set_is_static(is_static);
        let placement = GeomPlacement::default();
        GeomFactory::create_rectangle_geom_in(simulator, body, 32.0, 32.0, placement).unwrap();
        body
    }

    /// Returns a world of static tiles with boxes on them.
    fn world(has_sleep: bool) -> (PhysicsSimulator, Vec<BodyId>) {
        let mut simulator = PhysicsSimulator::new(Vector2::new(0.0, 320.0)).unwrap();
        simulator.set_methods(Methods::PRECISE).unwrap();
        simulator.set_iterations(4);
        simulator.set_sleep_enabled(has_sleep);
        let place = |at: usize| [32.0 * (at % 20) as f32, 32.0 * (at / 20) as f32];
        let tiles = (0..100).map(|at| add_box(&mut simulator, place(at), true)).collect::<Vec<_>>();
        let boxes = (0..20).map(|at| [64.0 * (at % 10) as f32, -32.0 * (at / 10 + 1) as f32]);
        let boxes: Vec<_> = boxes.map(|at| add_box(&mut simulator, at, false)).collect();
        (simulator, tiles.into_iter().chain(boxes).collect())
    }

    /// Debug builds compare the state after each edit with that after a rebuild, too.
    #[test]
    fn a_world_of_edited_bodies_continues_as_one_that_was_saved_and_loaded() {
        for has_sleep in [false, true] {
            edit_beside_twin(has_sleep, if has_sleep { 40 } else { 1 });
        }
    }

    /// Edits a body every `period` steps in a world and in its twin, which is saved and loaded.
    fn edit_beside_twin(has_sleep: bool, period: usize) {
        let (mut simulator, mut bodies) = world(has_sleep);
        let mut twin = simulator.clone();
        let mut number = 1_u32;
        for step in 0..400 * period.min(8) {
            for simulator in [&mut simulator, &mut twin] {
                simulator.update(1.0 / 60.0);
            }
            assert!(simulator.snapshot() == twin.snapshot(), "step {step}");
            let snapshot = twin.snapshot();
            if step % 3 == 0 {
                twin.restore(&snapshot).unwrap();
            }
            if step % period != 0 {
                continue;
            }
            number = number.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            let at = (number >> 8) as usize % bodies.len();
            let body = bodies[at];
            for simulator in [&mut simulator, &mut twin] {
                let is_static = simulator[body].is_static();
                let is_kinematic = simulator[body].is_kinematic();
                match number >> 29 {
                    0 | 1 => simulator[body].set_is_static(!is_static),
                    2 | 3 => {
                        let is_enabled = simulator[body].enabled();
                        simulator[body].set_enabled(!is_enabled);
                    }
                    4 => {
                        simulator.dispose(body).unwrap();
                        let new = add_box(simulator, [32.0 * (at % 20) as f32, -200.0], is_static);
                        bodies[at] = new;
                    }
                    6 => {
                        let geom = simulator.geoms_of(body)[0];
                        let is_ghost = simulator[geom].collides_with() == CollisionCategory::NONE;
                        let categories =
                            if is_ghost { CollisionCategory::ALL } else { CollisionCategory::NONE };
                        simulator[geom].set_collides_with(categories);
                        simulator[geom].set_collision_categories(categories);
                    }
                    5 if !is_static => simulator[body].set_is_kinematic(!is_kinematic),
                    _ => {}
                }
            }
        }
    }
}
