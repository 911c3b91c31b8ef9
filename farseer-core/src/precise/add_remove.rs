//! Adapter: addition and removal of bodies and geoms without a rebuild of all lists.
//!
//! New bodies and proxies are appended; removed ones leave an empty position. The state is bit-identical to that after a
//! [rebuild](Precise::rebuild), and the cost is proportional to the number of changes, beside one scan of the lists. With
//! one-way geoms everything is rebuilt, because their pair states depend on all bodies and geoms. The module reads the lists of
//! the simulator and writes bodies, proxies, pairs, constraints and sleep.

use super::Precise;
use super::body_import::listed_body;
use super::ids::geom_of;
use super::listed::Listed;
use crate::body::BodyId;
use crate::objects::Objects;
use crate::precise::ids::AlwaysTested;
use crate::precise::sleeping_joints::drop_joints_of_awake;
use crate::precise::solver::broad_phase::hash_grid::HashGrid;
use crate::precise::solver::parameters::broad_phase::MIN_EMPTY_POSITIONS_TO_COMPACT;

/// Bodies and geoms by which the simulator's lists differ from those of the precise set.
struct MembershipDiff {
    /// Indices of removed dynamic and kinematic bodies into `bodies`, ascending.
    removed_bodies: Vec<usize>,
    /// Indices of the proxies of removed geoms, ascending.
    removed_proxies: Vec<u32>,
    /// Ids of new dynamic and kinematic bodies.
    added_bodies: Vec<BodyId>,
    /// Positions of new geoms in the simulator's list, ascending.
    added_geoms: Vec<usize>,
    /// Ids of all disabled bodies.
    disabled_bodies: Vec<BodyId>,
    /// Whether some geom belongs to a disabled or missing body.
    has_geoms_of_disabled: bool,
}

impl Precise {
    /// Applies additions and removals of bodies and geoms to the lists. Returns whether that was possible. If it returns false,
    /// nothing is changed and a rebuild is needed: there are other changes, too, or the lists have no capacity left.
    pub(super) fn apply_add_remove(&mut self, objects: &Objects) -> bool {
        let listed = self.listed(objects);
        let world_proxies = self.solver.depth.as_ref().map_or(0, |space| space.world_proxy_count());
        let diff = MembershipDiff::new(&listed, world_proxies)
            .filter(|diff| !diff.involves_one_way(&listed) && diff.has_capacity(&listed, &self.solver.grid));
        let Some(members) = diff else { return false };
        self.remove_members(&members);
        for &id in &members.added_bodies {
            self.add_body(id, objects);
        }
        for &at in &members.added_geoms {
            self.add_geom(at, objects);
        }
        for &id in &members.added_bodies {
            if let Some(index) = self.body_index(id) {
                self.compute_extents(index, objects);
            }
        }
        self.update_list_positions(&members, objects);
        self.edits.disabled_bodies = members.disabled_bodies;
        self.invalidate_joints();
        drop_joints_of_awake(&mut self.sleeping_joints, &self.ids, &self.solver.sleep);
        self.solver.sleep.update_runs(&self.solver.proxies);
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
        for &proxy in removed_proxies {
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

    /// Appends the proxies of a geom, and its body if that is static and not listed yet. `at`: position of the geom in the
    /// simulator's list of geoms.
    fn add_geom(&mut self, at: usize, objects: &Objects) {
        let Some((id, geom)) = objects.geoms.at(at) else { return };
        if self.body_index(geom.body).is_none() {
            let index = self.solver.bodies.add_static(&listed_body(&objects.bodies[geom.body].body, false));
            self.ids.add_body(index, geom.body);
        }
        self.proxy_import(objects).add(at);
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

    /// Updates `list_index` of the proxies of all geoms whose position in the simulator's list may have shifted. Updates also
    /// the list of geoms that every AABB query tests.
    fn update_list_positions(&mut self, diff: &MembershipDiff, objects: &Objects) {
        let is_always_tested =
            |at: usize| objects.geoms.at(at).is_none_or(|(id, geom)| !self.proxy_covers_geom(id, geom));
        let added_always_tested: Vec<usize> =
            diff.added_geoms.iter().copied().filter(|&at| is_always_tested(at)).collect();
        let known = std::mem::take(&mut self.always_tested);
        let is_listed = |loose: &&AlwaysTested| {
            objects.geoms.lifecycle_state(loose.geom).is_some_and(|life| life.is_listed)
        };
        let mut known = known.iter().filter(is_listed).peekable();
        let is_shifted =
            !diff.removed_proxies.is_empty() || known.peek().is_some() || diff.has_geoms_of_disabled;
        let first = if is_shifted { 0 } else { diff.added_geoms.first().copied().unwrap_or(usize::MAX) };
        for (at, &geom) in objects.geoms.list().iter().enumerate().skip(first) {
            let list_index = at as u32;
            let pieces = self.ids.proxies_of_geom(&self.solver.proxies, geom);
            let was_always_tested = known.next_if(|loose| loose.geom == geom).is_some();
            if was_always_tested || pieces.is_empty() || added_always_tested.binary_search(&at).is_ok() {
                self.always_tested.push(AlwaysTested { list_index, geom });
            }
            self.solver.proxies.all[pieces].iter_mut().for_each(|proxy| proxy.list_index = list_index);
        }
    }
}

impl MembershipDiff {
    /// Returns whether a one-way geom exists or is added.
    fn involves_one_way(&self, listed: &Listed<'_>) -> bool {
        let new = || self.added_geoms.iter().filter_map(|&at| listed.objects.geoms.at(at));
        listed.proxies.one_way_count > 0 || new().any(|(_, geom)| geom.one_way.is_some())
    }

    /// Returns the bodies and geoms that were added and removed. `world_proxies`: number of proxies of world boxes and the
    /// ground. `None` if the remaining bodies or geoms have changed their
    /// type or order.
    fn new(listed: &Listed<'_>, world_proxies: usize) -> Option<Self> {
        let mut diff = MembershipDiff {
            removed_bodies: Vec::new(),
            removed_proxies: Vec::new(),
            added_bodies: Vec::new(),
            added_geoms: Vec::new(),
            disabled_bodies: Vec::new(),
            has_geoms_of_disabled: false,
        };
        diff.compare_bodies(listed)?;
        diff.compare_geoms(listed, world_proxies)?;
        diff.is_complete(listed, world_proxies).then_some(diff)
    }

    /// Finds removed, added and disabled bodies. Returns `None` if the remaining bodies have changed their type or order.
    fn compare_bodies(&mut self, listed: &Listed<'_>) -> Option<()> {
        let bodies = &listed.bodies;
        let (mut last, mut known_count) = (0, 0);
        for (at, &id) in listed.objects.bodies.list().iter().enumerate() {
            let index = listed.ids.body_index(id);
            if let Some(number) = index.filter(|&number| number < bodies.first_static()) {
                if number <= last || !self.added_bodies.is_empty() {
                    return None;
                }
                (last, known_count) = (number, known_count + 1);
                continue;
            }
            let (_, entry) = listed.objects.bodies.at(at)?;
            if entry.body.is_integrated() {
                if index.is_some() {
                    return None;
                }
                self.added_bodies.push(id);
            } else if !entry.body.enabled() {
                self.disabled_bodies.push(id);
            }
        }
        if known_count < bodies.movable_count {
            let is_removed = |&number: &usize| {
                let is_listed =
                    |id| listed.objects.bodies.lifecycle_state(id).is_some_and(|life| life.is_listed);
                listed.ids.bodies[number].is_some_and(|id| !is_listed(id))
            };
            self.removed_bodies.extend((1..=bodies.last_movable).filter(is_removed));
        }
        (known_count + self.removed_bodies.len() == bodies.movable_count).then_some(())
    }

    /// Finds removed proxies and added geoms. Returns `None` if the order of the remaining geoms has changed.
    fn compare_geoms(&mut self, listed: &Listed<'_>, world_proxies: usize) -> Option<()> {
        let proxies = &listed.proxies;
        let (mut last, mut known_count) = ([0; 2], 0);
        for (at, &id) in listed.objects.geoms.list().iter().enumerate() {
            let pieces = listed.ids.proxies_of_geom(proxies, id);
            if pieces.is_empty() {
                let (_, geom) = listed.objects.geoms.at(at)?;
                let is_enabled =
                    listed.objects.bodies.get(geom.body).is_some_and(|entry| entry.body.enabled());
                self.added_geoms.extend(is_enabled.then_some(at));
                self.has_geoms_of_disabled |= !is_enabled;
                continue;
            }
            let last = &mut last[usize::from(pieces.start >= proxies.first_fixed)];
            if pieces.start < *last || !self.added_geoms.is_empty() {
                return None;
            }
            (*last, known_count) = (pieces.end, known_count + pieces.len());
        }
        let live = proxies.live_count - world_proxies;
        if known_count < live {
            let is_removed = |&at: &usize| {
                let proxy = &proxies.all[at];
                let is_listed = proxy.is_world
                    || listed
                        .objects
                        .geoms
                        .lifecycle_state(geom_of(proxy))
                        .is_some_and(|life| life.is_listed);
                !(proxy.is_empty() || is_listed)
            };
            self.removed_proxies.extend((0..proxies.all.len()).filter(is_removed).map(|at| at as u32));
        }
        (known_count + self.removed_proxies.len() == live).then_some(())
    }

    /// Returns whether each dynamic or kinematic body that was added or removed was so with all of its geoms.
    fn is_complete(&self, listed: &Listed<'_>, world_proxies: usize) -> bool {
        let is_removed = |proxy: u32| self.removed_proxies.binary_search(&proxy).is_ok();
        let has_removed_body = |proxy: &u32| {
            let body = listed.proxies.all[*proxy as usize].body as usize;
            body >= listed.bodies.first_static() || self.removed_bodies.binary_search(&body).is_ok()
        };
        let has_new_or_static_body = |&at: &usize| {
            let body = listed.objects.geoms.at(at).map(|(_, geom)| geom.body);
            let known = body.and_then(|body| listed.ids.body_index(body));
            known.is_none_or(|number| number >= listed.bodies.first_static())
        };
        // Proxies of static geoms are listed before those of world boxes, so that no static geom can be appended.
        let is_new = |&at: &usize| {
            listed.objects.geoms.at(at).is_some_and(|(_, geom)| self.added_bodies.contains(&geom.body))
        };
        if world_proxies > 0 && !self.added_geoms.iter().all(is_new) {
            return false;
        }
        self.removed_bodies.iter().all(|&number| listed.proxies.proxies_of(number).all(is_removed))
            && self.removed_proxies.iter().all(has_removed_body)
            && self.added_geoms.iter().all(has_new_or_static_body)
    }

    /// Returns whether the lists have capacity for the additions, and whether enough positions are used after the removals.
    /// Enough means that twice the used positions plus [`MIN_EMPTY_POSITIONS_TO_COMPACT`] are at least all positions.
    fn has_capacity(&self, listed: &Listed<'_>, grid: &HashGrid) -> bool {
        let Listed { bodies, proxies, .. } = listed;
        let pieces = self.added_geoms.iter().filter_map(|&at| listed.objects.geoms.at(at));
        let pieces: usize = pieces.map(|(_, geom)| geom.pieces().len()).sum();
        let positions = proxies.all.len() - (proxies.first_fixed - proxies.movable_end);
        let is_full_enough = |live: usize, removed: usize, places: usize| {
            2 * (live - removed) + MIN_EMPTY_POSITIONS_TO_COMPACT >= places
        };
        bodies.last_movable + self.added_bodies.len() < bodies.first_static()
            && proxies.movable_end + pieces <= proxies.first_fixed
            && grid.has_capacity(proxies.all.len() + pieces)
            && is_full_enough(bodies.movable_count, self.removed_bodies.len(), bodies.last_movable)
            && is_full_enough(proxies.live_count, self.removed_proxies.len(), positions)
    }
}
