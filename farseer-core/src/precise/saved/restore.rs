//! Restores a saved state into rebuilt lists.
//!
//! Pairs of removed bodies and geoms are removed in the same order as in [`add_remove`](crate::precise::add_remove), so that
//! both paths give the same bits.

use super::{
    EditPolicy, ImportedState, Saved, SavedManifold, SavedPair, SavedProxy, SavedProxyIndex,
    SavedSleeperIndex, SavedSleepingBody, SavedTouchEvent,
};
use crate::body::BodyId;
use crate::geom::GeomId;
use crate::objects::Objects;
use crate::precise::Precise;
use crate::precise::body_import::velocity_of;
use crate::precise::changed_kinds::ChangedKinds;
use crate::precise::ids::{geom_of, owner_of};
use crate::precise::import::reset_one_way_states;
use crate::precise::sleeping_joints::drop_joints_of_awake;
use crate::storage::order::sort_by_number;
use farseer_precise::broad_phase::pair_finder::order_pair;
use farseer_precise::broad_phase::pairs::OneWayState;
use farseer_precise::broad_phase::pairs::{CachedManifold, UPDATED_BY_SOLVER};
use farseer_precise::broad_phase::proxies::Proxies;
use farseer_precise::constraint_graph::saved_constraint::SavedConstraint;
use farseer_precise::depth::feature_gate::FeatureGate;
use farseer_precise::index::{BodyIndex, IndexedVec, PairIndex, ProxyIndex};
use farseer_precise::narrow_phase::{TouchEvent, TouchKind};

impl From<Saved> for Precise {
    fn from(saved: Saved) -> Self {
        let mut precise = Precise::new(saved.tuning.length_unit);
        let solver = &mut precise.solver;
        solver.set_step_lengths([saved.substep, saved.dt]);
        (solver.friction, solver.max_contacts) = (saved.friction, saved.most_contacts);
        solver.depth = saved.is_in_space.then(FeatureGate::new).flatten();
        precise.changed_kinds = saved.pending_events.changed_kinds();
        precise.loaded = Some(saved);
        precise
    }
}

/// Current index of each saved proxy; `None` if it does not exist any more.
type CurrentProxies = IndexedVec<SavedProxyIndex, Option<ProxyIndex>>;

impl Precise {
    /// Restores the state of all proxies and pairs that still exist. `edits`: when edits made since the save take effect.
    pub(in crate::precise) fn restore(&mut self, saved: &Saved, objects: &Objects, edits: EditPolicy<'_>) {
        self.solver.has_handler_changes =
            saved.has_handled || saved.pairs.iter().any(|pair| pair.is_vetoed || pair.was_vetoed);
        self.solver.clear_pairs();
        self.restore_solver_history(saved);
        self.restore_delta_poses(saved);
        let (current_proxies, edited_proxies) = self.restore_proxies(saved, edits);
        self.restore_sleep(saved, objects, edits);
        let remaining = |pair: &SavedPair| {
            let current = pair.proxies.map(|proxy| current_proxies[proxy]);
            current[0].zip(current[1]).map(|(a, b)| [a, b]).filter(|&now| {
                let [one, other] = now.map(|proxy| geom_of(self.solver.proxies.proxy(proxy)));
                order_pair(&self.solver.proxies, self.solver.depth.as_ref().map(FeatureGate::by_ref), now)
                    == Some(now)
                    && (edits == EditPolicy::Defer || self.may_keep_pair((one, other), objects))
            })
        };
        let stays: Vec<_> = saved.pairs.iter().map(remaining).collect();
        self.restore_touch_events(saved, |at| stays[at].is_none());
        if self.solver.depth.is_none() {
            note_changed_kinds(saved, &stays, &self.solver.proxies, &mut self.changed_kinds);
        }
        let lost = saved.pairs.iter().zip(&stays);
        for (pair, _) in lost.filter(|(pair, stays)| stays.is_none() && pair.constraint.is_some()) {
            self.record_lost_constraint(pair, &current_proxies);
        }
        let mut constraints = Vec::new();
        for at in saved.pair_order_without(|at| stays[at].is_none()) {
            let (pair, Some(now)) = (&saved.pairs[at], stays[at]) else { continue };
            let row = self.restore_pair(now, pair);
            let was_direct = pair.constraint.is_some_and(|row| row.was_direct());
            self.solver.direct_solver.timer.is_due |= was_direct && row.is_none();
            constraints.extend(row);
        }
        self.reset_changed_one_way(saved, &current_proxies);
        edited_proxies.into_iter().for_each(|proxy| self.solver.invalidate_pairs(proxy));
        self.restore_constraints(constraints);
        self.sleep_pairs();
        self.edits.wake_requests.clear();
        self.edits.wake_requests.extend_from_slice(&saved.woken);
        for &body in &saved.wake_requests {
            self.body_of_saved_id(body).into_iter().for_each(|number| self.solver.sleep.request_wake(number));
        }
        self.wake_requested_by_game();
    }

    /// Restores touch events that the game has not received, and adds an end event for each touching pair that no longer
    /// exists. Causes are a changed filter, a disabled or removed geom, or other convex pieces.
    fn restore_touch_events(&mut self, saved: &Saved, is_lost: impl Fn(usize) -> bool) {
        self.solver.touch_events.clear();
        self.solver.touch_events.extend(saved.touch_events.iter().map(SavedTouchEvent::event));
        let ended = saved.pairs.iter().enumerate().filter(|&(at, pair)| pair.is_touching && is_lost(at));
        self.solver.touch_events.extend(ended.map(|(_, pair)| {
            let sides = pair.proxies.map(|proxy| &saved.proxies[proxy]);
            let kind = saved_touch_kind(sides);
            TouchEvent::new(sides.map(|proxy| (proxy.number, owner_of(proxy.geom))), false, kind)
        }));
    }

    /// Restores contact constraints, each given by its pair index and saved form.
    fn restore_constraints(&mut self, mut constraints: Vec<(PairIndex, SavedConstraint)>) {
        // Only in the overflow colour the order of constraints influences the bits.
        sort_by_number(&mut constraints, |(_, row): &(PairIndex, SavedConstraint)| row.order().into());
        for (pair, row) in constraints {
            if let Some([_, restitution, _]) = row.surface() {
                self.solver.pairs.state_mut(pair).has_surface_override = true;
                self.solver.has_restitution |= restitution > 0.0;
            }
            let count = self.solver.pairs.manifold(pair).count;
            let (exists, is_disabled) = ([count > 0, count > 1], row.are_points_disabled());
            self.solver.pairs.state_mut(pair).are_points_removed =
                [0, 1].map(|at| exists[at] && is_disabled[at]);
            self.solver.narrow_phase().restore_constraint(pair, &row);
        }
    }

    /// Requests that the bodies of a removed pair wake, since its contact constraint no longer supports them, and that solvers
    /// may be selected anew.
    fn record_lost_constraint(&mut self, pair: &SavedPair, current_proxies: &CurrentProxies) {
        let was_direct = pair.constraint.is_some_and(|row| row.was_direct());
        self.solver.direct_solver.timer.is_due |= was_direct;
        self.solver.direct_solver.timer.may_be_due |= self.solver.depth.is_none();
        for proxy in pair.proxies.iter().filter_map(|&proxy| current_proxies[proxy]) {
            self.solver.sleep.support_removed(self.solver.proxies.body_of(proxy));
        }
    }

    /// Restores the displacements in the last step of dynamic and kinematic bodies.
    fn restore_delta_poses(&mut self, saved: &Saved) {
        for &(body, delta_pose) in &saved.delta_poses {
            if let Some(number) =
                self.body_index(body).filter(|&number| number <= self.solver.bodies.last_movable)
            {
                self.solver.bodies.delta_pose[number] = delta_pose;
            }
        }
    }

    /// Resets the one-way states of the pairs of each proxy whose one-way direction has changed since the save.
    fn reset_changed_one_way(&mut self, saved: &Saved, current_proxies: &CurrentProxies) {
        for (proxy, place) in saved.proxies.iter().zip(current_proxies.iter()) {
            if let Some(place) =
                place.filter(|&now| self.solver.proxies.proxy(now).one_way != proxy.imported.one_way)
            {
                reset_one_way_states(&mut self.solver.pairs, &self.solver.proxies, place);
            }
        }
    }

    /// Restores the timer of the solver selection and the history of each dynamic body.
    fn restore_solver_history(&mut self, saved: &Saved) {
        self.solver.direct_solver.timer = saved.reselection_timer;
        for &(body, history) in &saved.solver_history {
            match self.body_index(body).filter(|&number| self.solver.bodies.is_dynamic(number)) {
                Some(number) => self.solver.direct_solver.set_history(number, history),
                None => self.solver.direct_solver.timer.is_due |= history.is_direct,
            }
        }
    }

    /// Sets the velocity that a body was given since the save, which the narrow phase uses. A hinged box has no body with this
    /// id.
    fn restore_edited_velocity(&mut self, number: BodyIndex, id: BodyId, objects: &Objects) {
        if let Some(space) = &self.solver.depth {
            space.import_hinge_velocity(&mut self.solver.bodies, number);
        }
        let Some(entry) = objects.bodies.get(id) else { return };
        self.solver.bodies.set_velocity(number, velocity_of(&entry.body));
        if let Some(space) = &mut self.solver.depth {
            space.import_body(&mut self.solver.bodies, number, id.slot());
        }
    }

    /// Restores rest times, sleeping joints, and the sleeping bodies that may go on sleeping. An edited body wakes the other
    /// bodies of its island.
    fn restore_sleep(&mut self, saved: &Saved, objects: &Objects, edits: EditPolicy<'_>) {
        self.solver.sleep.gravity = saved.gravity;
        // Bodies that wake before the next step need the velocity change by gravity, to find which bodies support others.
        self.solver.gravity_delta = saved.gravity.map(|part| part * saved.dt);
        for &(body, rest_time) in &saved.rest_times {
            if let Some(number) =
                self.body_of_saved_id(body).filter(|&number| number <= self.solver.bodies.last_movable)
            {
                self.solver.sleep.rest_time[number] = rest_time;
            }
        }
        // By index of the first body of an island: the last of its bodies that sleeps again.
        let mut ring_member =
            IndexedVec::<SavedSleeperIndex, _>::of_copies(None, saved.sleeping_bodies.len());
        for &SavedSleepingBody { body, first, pose, supported_acceleration, constants, is_newly_asleep } in
            &saved.sleeping_bodies
        {
            let may_sleep = |&number: &BodyIndex| {
                let is_hinged = || self.solver.depth.as_ref().is_some_and(|space| space.is_hinged(number));
                (self.solver.bodies.is_dynamic(number) || is_hinged()) && !self.solver.sleep.is_asleep(number)
            };
            let Some(number) = self.body_of_saved_id(body).filter(may_sleep) else { continue };
            self.solver.bodies.put_to_rest(number, 1.0);
            self.solver.sleep.sleep_body(number, ring_member[first], supported_acceleration);
            ring_member[first] = Some(number);
            self.solver.sleep.newly_asleep.extend(is_newly_asleep.then_some(number));
            // Forces may have been applied since the save.
            self.solver.sleep.record_force(number);
            let may_hinge_stay =
                self.solver.depth.as_ref().is_some_and(|space| space.may_hinge_stay_asleep(number));
            if self.pose_of(number) != pose
                || self.constants_of(number) != constants
                || !(self.is_at_rest(body, objects, edits) || may_hinge_stay)
            {
                self.solver.sleep.request_wake(number);
                self.restore_edited_velocity(number, body, objects);
            }
        }
        self.sleeping_joints.clone_from(&saved.joints);
        drop_joints_of_awake(&mut self.sleeping_joints, &self.ids, &self.solver.sleep);
        self.solver.sleep.update_runs(&self.solver.proxies);
    }

    /// Restores all proxies. Returns the current index of each saved proxy (`None` if it no longer exists), and the indices of
    /// the proxies whose contacts must be computed anew.
    ///
    /// A proxy whose body has changed its type counts as a new proxy.
    fn restore_proxies(&mut self, saved: &Saved, edits: EditPolicy<'_>) -> (CurrentProxies, Vec<ProxyIndex>) {
        let mut is_known = IndexedVec::of_copies(false, self.solver.proxies.position_count());
        let mut current_proxies = CurrentProxies::default();
        let mut edited = Vec::new();
        for proxy in saved.proxies.iter() {
            let proxy_index = self
                .proxy_of(proxy.geom, proxy.piece)
                .filter(|&place| self.solver.proxies.proxy(place).body_type == proxy.body_type)
                .filter(|&place| !std::mem::replace(&mut is_known[place], true));
            if let Some(place) = proxy_index {
                edited.extend(self.restore_proxy(place, proxy, edits).then_some(place));
            }
            current_proxies.push(proxy_index);
        }
        for at in self.solver.proxies.indices().filter(|&at| !is_known[at]) {
            if !self.solver.proxies.proxy(at).is_empty() {
                self.solver.fat_aabbs().insert(at);
                // A new body may form an island for the direct solver.
                self.solver.direct_solver.timer.is_due = true;
            }
        }
        (current_proxies, edited)
    }

    /// Restores travel and fat AABB of a proxy. Returns whether a property that its contacts depend on has changed since the
    /// save.
    fn restore_proxy(&mut self, proxy_index: ProxyIndex, saved: &SavedProxy, edits: EditPolicy<'_>) -> bool {
        let (then, mut now) = (saved.imported, self.imported_state_of(proxy_index));
        if edits == EditPolicy::Defer && then.filter != now.filter {
            let [filter @ .., responds] = then.filter;
            let proxy = self.solver.proxies.proxy_mut(proxy_index);
            (proxy.filter, proxy.responds) = (filter, responds & 1 != 0);
            self.edits.geoms.push(geom_of(proxy));
            self.solver.proxies.set_events(proxy_index, (responds >> 1) as u8);
            now.filter = then.filter;
        }
        if edits == EditPolicy::Defer {
            restore_former_surface(&mut self.solver.proxies, &mut self.edits.geoms, proxy_index, &then);
        }
        self.solver.proxies.set_travel(proxy_index, saved.travel);
        self.solver.fat_aabbs().insert_saved(proxy_index, saved.fat_aabb, saved.depth_interval);
        let has_moved = then.pose != now.pose;
        // The saved AABB and manifolds belong to the former shape.
        let is_reshaped = then.fingerprint != now.fingerprint;
        if has_moved {
            self.solver.bodies.clear_delta_pose(self.solver.proxies.body_of(proxy_index));
        }
        // Queries before the next update find the proxy where the last update left it.
        if edits != EditPolicy::Defer && (has_moved || is_reshaped) {
            self.solver.fat_aabbs().teleport(proxy_index);
        }
        if saved.is_refitted || has_moved || is_reshaped || then.filter != now.filter {
            self.solver.proxies.search_pairs_of(proxy_index);
        }
        has_moved
            || is_reshaped
            || then.contact_properties != now.contact_properties
            || then.surface != now.surface
            || then.filter != now.filter
            || then.one_way != now.one_way
    }

    /// Restores a pair with its manifold. Returns the pair index and the saved constraint; `None` if the pair has no constraint
    /// or is restored already.
    ///
    /// A pair that responds now and did not before, or the reverse, is updated in the next step.
    fn restore_pair(
        &mut self,
        proxies: [ProxyIndex; 2],
        saved: &SavedPair,
    ) -> Option<(PairIndex, SavedConstraint)> {
        if self.solver.pairs.contains(proxies) {
            return None;
        }
        let pair = self.solver.narrow_phase().add_pair(proxies);
        let responds = self.solver.pairs.state(pair).responds;
        *self.solver.pairs.manifold_mut(pair) = saved.manifold.cached();
        self.solver.pairs.restore_motion(pair, saved.motion_at_check, saved.motion_tolerance);
        self.solver.pairs.state_mut(pair).is_vetoed = saved.is_vetoed;
        self.solver.pairs.state_mut(pair).was_vetoed = saved.was_vetoed;
        if self.solver.pairs.state(pair).one_way_state != OneWayState::Closed
            && saved.one_way_state != OneWayState::Closed
        {
            self.solver.pairs.state_mut(pair).one_way_state = saved.one_way_state;
        }
        self.solver.pairs.set_touching(pair, saved.is_touching);
        let constraint = saved.constraint.filter(|_| responds);
        // A disabled pair is updated in the next step in any case.
        let has_constraint = constraint.is_some() || saved.is_vetoed;
        if saved.motion_tolerance == UPDATED_BY_SOLVER
            && !(has_constraint && self.solver.narrow_phase().is_circle_pair(pair))
        {
            self.solver.pairs.recheck(pair);
        }
        let row = constraint?;
        row.restore_rolling(&mut self.solver.pairs, pair);
        Some((pair, row))
    }
}

/// Restores the surface that a proxy had at the save. Its geom is added to the `edited` ones if that was another surface, so that
/// the next update imports the present one.
fn restore_former_surface(
    proxies: &mut Proxies,
    edited: &mut Vec<GeomId>,
    proxy_index: ProxyIndex,
    then: &ImportedState,
) {
    let ([.., friction, restitution], surface) = (then.contact_properties, then.surface);
    let proxy = proxies.proxy_mut(proxy_index);
    if ([proxy.friction, proxy.restitution], proxy.surface) != ([friction, restitution], surface) {
        (proxy.friction, proxy.restitution) = (friction, restitution);
        edited.push(geom_of(proxy));
        proxies.set_surface(proxy_index, surface);
    }
}

/// Notes the pairs that touch and whose typed event has another kind now: one of the geoms was made a sensor or an ordinary geom,
/// or wants other events. `stays`: current proxies of each saved pair that still exists.
fn note_changed_kinds(
    saved: &Saved,
    stays: &[Option<[ProxyIndex; 2]>],
    proxies: &Proxies,
    changed: &mut ChangedKinds,
) {
    for (pair, now) in saved.pairs.iter().zip(stays).filter(|(pair, _)| pair.is_touching) {
        let Some(now) = now.map(|now| now.map(|proxy| proxies.proxy(proxy))) else { continue };
        let before = saved_touch_kind(pair.proxies.map(|proxy| &saved.proxies[proxy]));
        let after = TouchKind::of_proxies(now);
        if before != after {
            changed.note(now.map(|proxy| (proxy.creation_number, geom_of(proxy))), before, after);
        }
    }
}

/// Returns the kind of the typed event of two saved proxies.
fn saved_touch_kind(sides: [&SavedProxy; 2]) -> TouchKind {
    let [a, b] = sides.map(|proxy| proxy.imported.filter[5]);
    TouchKind::of(sides.map(|side| (side.number, side.imported.filter[5] & 1 != 0)), ((a | b) >> 1) as u8)
}

impl SavedManifold {
    /// Returns the manifold as the narrow phase keeps it.
    fn cached(&self) -> CachedManifold {
        let SavedManifold {
            rotations,
            relative_pose,
            normal,
            count,
            anchors,
            separations,
            features,
            arm_lead_angle,
            depth,
        } = *self;
        CachedManifold {
            rotations,
            relative_pose,
            normal,
            count,
            anchors,
            separations,
            features,
            arm_lead_angle,
            depth,
        }
    }
}

impl Saved {
    /// Adds a sleeping body to the bodies that wake after the rebuild. Has no effect on an awake body.
    pub(in crate::precise) fn wake(&mut self, body: BodyId) {
        if self.sleeping_bodies.iter().any(|sleeper| sleeper.body == body) && !self.woken.contains(&body) {
            self.woken.push(body);
        }
    }

    /// Returns the indices of the remaining pairs in the order that results if the lost pairs are removed one by one, the last
    /// first.
    fn pair_order_without(&self, is_lost: impl Fn(usize) -> bool) -> Vec<usize> {
        let mut order: Vec<usize> = (0..self.pairs.len()).collect();
        let mut awake = (self.awake_pair_count as usize).min(order.len());
        for lost in (0..self.pairs.len()).rev().filter(|&at| is_lost(at)) {
            if lost < awake {
                awake -= 1;
                order.swap(lost, awake);
                order.swap_remove(awake);
            } else {
                order.swap_remove(lost);
            }
        }
        order
    }
}
