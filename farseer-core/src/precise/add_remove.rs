//! Adapter: addition and removal of bodies and geoms without a rebuild of all lists.
//!
//! New bodies and proxies are appended; removed ones leave an empty position. A body that becomes static or movable, enabled or
//! disabled, is removed and added. The state is bit-identical to that after a
//! [rebuild](Precise::rebuild). The cost is proportional to the number of changes, but for joints, which are imported anew, and
//! geoms that every query tests. With one-way geoms everything is rebuilt,
//! because their pair states depend on all bodies and geoms. The module reads the lists of the simulator and writes bodies,
//! proxies, pairs, constraints and sleep.

use super::Precise;
use super::body_import::listed_body;
use super::ids::{IdTable, geom_of};
use super::listed::Listed;
use crate::body::BodyId;
use crate::geom::GeomId;
use crate::objects::{NewMembers, Objects};
use crate::precise::ids::AlwaysTested;
use crate::precise::sleeping_joints::drop_joints_of_awake;
use crate::storage::order::sort_by_number;
use farseer_precise::bodies::spare_capacity;
use farseer_precise::broad_phase::hash_grid::HashGrid;
use farseer_precise::broad_phase::proxies::Proxies;
use farseer_precise::island::sleep::SleepState;
use farseer_precise::parameters::broad_phase::MIN_EMPTY_POSITIONS_TO_COMPACT;

/// Bodies and geoms by which the simulator's lists differ from those of the precise set.
#[derive(Default)]
struct MembershipDiff {
    /// Indices of removed dynamic and kinematic bodies into `bodies`, ascending.
    removed_bodies: Vec<usize>,
    /// Indices of the proxies of removed geoms, ascending.
    removed_proxies: Vec<u32>,
    /// Ids of new dynamic and kinematic bodies, in the order of the simulator's list.
    added_bodies: Vec<BodyId>,
    /// Ids of new geoms, in the order of the simulator's list.
    added_geoms: Vec<GeomId>,
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
            .filter(|diff| !diff.involves_one_way(&listed) && diff.has_capacity(&listed, &self.solver.grid));
        let Some(members) = diff else { return false };
        // As a rebuild does: a handler may have caused the import in the middle of an update, and only one of two worlds with
        // equal snapshots may have the capacity to do without a rebuild.
        self.solver.rolling_contacts.clear();
        self.remove_members(&members);
        for &id in &members.added_bodies {
            self.add_body(id, objects);
        }
        for &id in &members.added_geoms {
            self.add_geom(id, objects);
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

    /// Removes the proxies of removed geoms with their pairs and constraints, and the removed bodies.
    fn remove_members(&mut self, diff: &MembershipDiff) {
        let MembershipDiff { removed_bodies, removed_proxies, .. } = diff;
        // A removed body wakes nothing later.
        removed_bodies.iter().for_each(|&number| self.solver.sleep.remove_body(number));
        let pairs = removed_proxies.iter().flat_map(|&proxy| self.solver.pairs.pairs_of(proxy));
        let mut pairs: Vec<usize> = pairs.collect();
        // Descending order keeps the remaining indices valid.
        pairs.sort_unstable();
        pairs.dedup();
        for pair in pairs.into_iter().rev() {
            if self.solver.pairs.all[pair].constraint.is_some() {
                self.solver
                    .sleep
                    .support_of_pair_removed(self.solver.pairs.bodies_of(&self.solver.proxies, pair));
            }
            self.solver.narrow_phase().end_touch_event(pair);
            self.solver.narrow_phase().delete_pair(pair);
        }
        self.solver.proxies.refitted.retain(|proxy| removed_proxies.binary_search(proxy).is_err());
        // The list of a body begins with its newest proxy, so that descending order finds each at the head.
        for &proxy in removed_proxies.iter().rev() {
            let removed = &self.solver.proxies.all[proxy as usize];
            let (geom, body) = (geom_of(removed), removed.body as usize);
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
        removed_bodies.iter().for_each(|&number| self.remove_body(number));
    }

    /// Removes the body at `index` from `bodies`, the direct solver and the graph colours.
    fn remove_body(&mut self, index: usize) {
        self.ids.remove_body(index);
        if index < self.solver.bodies.first_static() {
            self.solver.direct_solver.forget_body(index);
            self.solver.color_usage.remove_body(index);
        }
        self.solver.bodies.remove(index);
    }

    /// Appends a dynamic or kinematic body to `bodies`, the graph colours and the sleep state.
    fn add_body(&mut self, id: BodyId, objects: &Objects) {
        let body = &objects.bodies[id].body;
        let Some(index) = self.solver.bodies.add_movable(&listed_body(body, true)) else { return };
        self.ids.add_body(index, id);
        self.solver.color_usage.add_body(index, self.solver.bodies.inverse_mass_inertia[index]);
        self.solver.sleep.add_body(index);
        if let Some(space) = &mut self.solver.depth {
            space.add_body(index, id.slot());
            space.import_body(&mut self.solver.bodies, index, id.slot());
        }
    }

    /// Appends the proxies of a geom, and its body if that is static and not listed yet.
    fn add_geom(&mut self, id: GeomId, objects: &Objects) {
        let Some(geom) = objects.geoms.get(id) else { return };
        if self.body_index(geom.body).is_none() {
            let index = self.solver.bodies.add_static(&listed_body(&objects.bodies[geom.body].body, false));
            self.ids.add_body(index, geom.body);
        }
        self.proxy_import(objects).add(id);
        let count = self.solver.proxies.all.len();
        self.solver.proxy_flags.resize(count, false);
        self.solver.grid.grow(count);
        self.solver.pairs.grow(count);
        for proxy in self.ids.proxies_of_geom(&self.solver.proxies, id) {
            if let Some(space) = self.solver.depth.as_deref_mut() {
                space.add_proxy(proxy, id.to_bits());
                space.fix_rotation_of_proxy(proxy as u32, &self.solver.proxies, &mut self.solver.bodies);
            }
            self.solver.fat_aabbs().insert(proxy as u32);
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
    }
}

impl MembershipDiff {
    /// Returns whether a one-way geom exists or is added.
    fn involves_one_way(&self, listed: &Listed<'_>) -> bool {
        let mut new = self.added_geoms.iter().filter_map(|&id| listed.objects.geoms.get(id));
        listed.proxies.one_way_count > 0 || new.any(|geom| geom.one_way.is_some())
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
            self.added_bodies.push(id);
            return movable.is_none().then_some(());
        }
        self.removed_bodies.extend(movable);
        if !entry.body.enabled() {
            self.disabled_bodies.push(id);
        }
        Some(())
    }

    /// Returns whether the new bodies and geoms follow all others in the order of the simulator's lists. Geoms of static bodies
    /// may have any place, because the order of their proxies has no effect.
    fn follows_others(&self, listed: &Listed<'_>) -> bool {
        let Listed { bodies, proxies, ids, objects } = listed;
        let is_movable = |id: &&GeomId| {
            let body = objects.geoms.get(**id).and_then(|geom| objects.bodies.get(geom.body));
            body.is_some_and(|entry| entry.body.is_integrated())
        };
        let stays = |index: &usize| self.removed_bodies.binary_search(index).is_err();
        let last_body = (1..=bodies.last_movable)
            .rev()
            .filter(stays)
            .find_map(|index| ids.bodies[index])
            .map(|id| objects.bodies.list_key(id));
        let is_left = |at: usize| self.removed_proxies.binary_search(&(at as u32)).is_err();
        let last_geom = proxies.last_movable(is_left).map(|proxy| proxy.list_key);
        let first_body = self.added_bodies.first().map(|&id| objects.bodies.list_key(id));
        let first_geom = self.added_geoms.iter().find(is_movable).map(|&id| objects.geoms.list_key(id));
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
            self.removed_proxies.extend(pieces.map(|at| at as u32));
            return Some(());
        }
        let geom = geoms.get(id).filter(|_| !geoms.is_disposed(id))?;
        if !pieces.is_empty() && self.retyped_bodies.binary_search(&geom.body).is_err() {
            return None;
        }
        self.removed_proxies.extend(pieces.map(|at| at as u32));
        let is_enabled = bodies.get(geom.body).is_some_and(|entry| entry.body.enabled());
        let list = if is_enabled { &mut self.added_geoms } else { &mut self.geoms_of_disabled };
        list.push(id);
        Some(())
    }

    /// Updates the index ranges of awake bodies where bodies and proxies were added or removed.
    fn update_runs(&self, ids: &IdTable, proxies: &Proxies, sleep: &mut SleepState) {
        let added_bodies = self.added_bodies.iter().filter_map(|&id| ids.body_index(id));
        let bodies: Vec<usize> = self.removed_bodies.iter().copied().chain(added_bodies).collect();
        let added = self.added_geoms.iter().flat_map(|&id| ids.proxies_of_geom(proxies, id));
        let removed = self.removed_proxies.iter().map(|&proxy| proxy as usize);
        let changed: Vec<usize> = removed.chain(added).collect();
        sleep.update_runs_at(&bodies, &changed, proxies);
    }

    /// Returns whether each dynamic or kinematic body that was added or removed was so with all of its geoms.
    fn is_complete(&self, listed: &Listed<'_>, world_proxies: usize) -> bool {
        let is_removed = |proxy: u32| self.removed_proxies.binary_search(&proxy).is_ok();
        let has_removed_body = |proxy: &u32| {
            let body = listed.proxies.all[*proxy as usize].body as usize;
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
        let pieces = self.added_geoms.iter().filter_map(|&id| listed.objects.geoms.get(id));
        let pieces: usize = pieces.map(|geom| geom.pieces().len()).sum();
        let positions = proxies.all.len() - (proxies.first_fixed - proxies.movable_end);
        let is_full_enough = |live: usize, removed: usize, places: usize| {
            2 * (live - removed) + MIN_EMPTY_POSITIONS_TO_COMPACT + spare_capacity(bodies.poses.len())
                >= places
        };
        bodies.last_movable + self.added_bodies.len() < bodies.first_static()
            && proxies.movable_end + pieces <= proxies.first_fixed
            && grid.has_capacity(proxies.all.len() + pieces)
            && is_full_enough(bodies.movable_count, self.removed_bodies.len(), bodies.last_movable)
            && is_full_enough(proxies.live_count, self.removed_proxies.len(), positions)
    }
}

#[cfg(test)]
mod tests {
    use crate::math::Vector2;
    use crate::{BodyFactory, BodyId, GeomFactory, GeomPlacement, Methods, PhysicsSimulator};

    fn add_box(simulator: &mut PhysicsSimulator, at: [f32; 2], is_static: bool) -> BodyId {
        let body = BodyFactory::create_rectangle_body_in(simulator, 32.0, 32.0, 1.0).unwrap();
        simulator[body].set_position(Vector2::new(at[0], at[1]));
        simulator[body].set_is_static(is_static);
        let placement = GeomPlacement::default();
        GeomFactory::create_rectangle_geom_in(simulator, body, 32.0, 32.0, placement).unwrap();
        body
    }

    /// Returns a world of static tiles with boxes on them.
    fn world() -> (PhysicsSimulator, Vec<BodyId>) {
        let mut simulator = PhysicsSimulator::new(Vector2::new(0.0, 320.0)).unwrap();
        simulator.set_methods(Methods::PRECISE).unwrap();
        simulator.set_iterations(4);
        let place = |at: usize| [32.0 * (at % 20) as f32, 32.0 * (at / 20) as f32];
        let tiles = (0..100).map(|at| add_box(&mut simulator, place(at), true)).collect::<Vec<_>>();
        let boxes = (0..20).map(|at| [64.0 * (at % 10) as f32, -32.0 * (at / 10 + 1) as f32]);
        let boxes: Vec<_> = boxes.map(|at| add_box(&mut simulator, at, false)).collect();
        (simulator, tiles.into_iter().chain(boxes).collect())
    }

    /// Debug builds compare the state after each edit with that after a rebuild, too.
    #[test]
    fn a_world_of_edited_bodies_continues_as_one_that_was_saved_and_loaded() {
        let (mut simulator, mut bodies) = world();
        let mut twin = simulator.clone();
        let mut number = 1_u32;
        for step in 0..400 {
            for simulator in [&mut simulator, &mut twin] {
                simulator.update(1.0 / 60.0);
            }
            assert!(simulator.snapshot() == twin.snapshot(), "step {step}");
            let snapshot = twin.snapshot();
            if step % 3 == 0 {
                twin.restore(&snapshot).unwrap();
            }
            number = number.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            let at = (number >> 8) as usize % bodies.len();
            let body = bodies[at];
            for simulator in [&mut simulator, &mut twin] {
                let is_static = simulator[body].is_static();
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
                    _ => {}
                }
            }
        }
    }
}
