//! Writes the state of the precise set to [`Saved`].

use serde::ser::SerializeSeq;
use serde::{Serialize, Serializer};

use super::pending_events::SavedPendingEvents;
use super::{
    ImportedState, Saved, SavedManifold, SavedPair, SavedProxy, SavedProxyIndex, SavedSleeperIndex,
    SavedSleepingBody, SavedTouchEvent,
};
use crate::body::BodyId;
use crate::precise::Precise;
use crate::precise::ids::{IdTable, geom_of};
use crate::storage::order::{packed_key, sort_by_number};
use farseer_precise::broad_phase::pairs::CachedManifold;
use farseer_precise::broad_phase::proxies::{Proxies, Proxy};
use farseer_precise::constraint_graph::saved_constraint::SavedConstraint;
use farseer_precise::depth::interface::DepthInterval;
use farseer_precise::depth::state::DepthState;
use farseer_precise::direct_solver::IslandHistory;
use farseer_precise::index::{BodyIndex, DenseIndex, IndexedVec, PairIndex, ProxyIndex};
use farseer_precise::island::sleep::SleepState;
use farseer_precise::narrow_phase::TouchEvent;

impl Precise {
    /// Returns the state to save: the current state or, between loading and the next rebuild, the loaded one.
    pub(in crate::precise) fn save(&self) -> Saved {
        match &self.loaded {
            Some(loaded) => loaded.clone(),
            None => saved_with(self, |saved_indices| saved_pairs(self, &saved_indices).collect()),
        }
    }

    /// Returns the touch events in the order of creation numbers. The order of the events in memory depends on how pairs were
    /// removed.
    fn save_touch_events(&self) -> Vec<SavedTouchEvent> {
        let mut changes = self.solver.touch_events.clone();
        sort_by_number(&mut changes, TouchEvent::sort_key);
        changes.iter().map(SavedTouchEvent::of).collect()
    }

    /// Returns the displacements in the last step of bodies with geoms, if there are one-way geoms: x, y (length units),
    /// rotation (radians), z (length units). Bodies without geoms are left out, since an edit of such a body's pose would not
    /// be detected.
    fn save_delta_poses(&self) -> impl Iterator<Item = (BodyId, [f32; 4])> + '_ {
        let has_one_way = self.solver.proxies.one_way_count > 0;
        let bodies = self.solver.bodies.movable().filter(move |_| has_one_way);
        let delta_poses = bodies.map(|number| (number, self.solver.bodies.delta_pose[number]));
        let ways = delta_poses.filter(|&(number, delta_pose)| {
            delta_pose != [0.0; 4] && self.solver.proxies.proxies_of(number).next().is_some()
        });
        ways.filter_map(|(number, way)| Some((self.ids.bodies[number]?, way)))
    }

    /// Returns the times for which awake bodies have been at rest, in seconds; zeros are left out.
    fn save_rest_times(&self) -> impl Iterator<Item = (BodyId, f32)> + '_ {
        let solver = &self.solver;
        let at_rest = solver
            .sleep
            .awake_bodies(solver.bodies.last_movable)
            .filter(|&number| solver.sleep.rest_time[number] > 0.0);
        at_rest.filter_map(|number| Some((self.saved_body_id(number)?, solver.sleep.rest_time[number])))
    }

    /// Returns the histories of the solver selection that differ from the default, by body.
    fn save_solver_history(&self) -> impl Iterator<Item = (BodyId, IslandHistory)> + '_ {
        let histories =
            self.solver.bodies.movable().map(|number| (number, self.solver.direct_solver.history[number]));
        let changed = histories.filter(|&(_, history)| history != IslandHistory::default());
        changed.filter_map(|(number, history)| Some((self.ids.bodies[number]?, history)))
    }

    /// Returns all sleeping bodies, in the order of their indices.
    fn save_sleeping_bodies(&self) -> Vec<SavedSleepingBody> {
        let solver = &self.solver;
        let mut sleepers = Vec::with_capacity(solver.sleep.count);
        let count = solver.bodies.states.len();
        let mut places = IndexedVec::<BodyIndex, _>::of_copies(SavedSleeperIndex::default(), count);
        let mut are_fresh = IndexedVec::<BodyIndex, _>::of_copies(false, count);
        solver.sleep.newly_asleep.iter().for_each(|&body| are_fresh[body] = true);
        let first_of_rings = solver.sleep.first_of_rings();
        for number in solver.bodies.movable().filter(|&number| solver.sleep.is_asleep(number)) {
            let Some(body) = self.saved_body_id(number) else { continue };
            places[number] = SavedSleeperIndex::new(sleepers.len());
            let first = places[first_of_rings[number]];
            sleepers.push(SavedSleepingBody {
                body,
                first,
                pose: self.pose_of(number),
                supported_acceleration: solver.sleep.supported_acceleration[number],
                constants: self.constants_of(number),
                is_newly_asleep: are_fresh[number],
            });
        }
        sleepers
    }

    /// Returns the reciprocals of mass (1/mass units) and moment of inertia (1/(mass units * length units^2)) of a body, its
    /// gravity scale (dimensionless), and its locked axes: 1 for x plus 2 for y.
    pub(super) fn constants_of(&self, number: BodyIndex) -> [f32; 4] {
        let [mass, inertia] = self.solver.bodies.inverse_mass_inertia[number];
        let [x, y] = self.ids.bodies[number].map_or([false; 2], |body| self.axis_locks.axes_of(body));
        let locks = f32::from(u8::from(x) + 2 * u8::from(y));
        [mass, inertia, self.solver.bodies.gravity_scales[number], locks]
    }

    /// Returns the pose of a body in the world frame: x, y (length units), rotation (radians), z (length units).
    pub(super) fn pose_of(&self, number: BodyIndex) -> [f32; 4] {
        let ([x, y, ..], rotation) = (self.solver.bodies.poses[number], self.solver.bodies.rotations[number]);
        [x, y, rotation, self.solver.depth.as_ref().map_or(0.0, |space| space.z_positions[number])]
    }

    /// Returns the properties of a proxy and its body by which a later edit is detected.
    pub(super) fn imported_state_of(&self, proxy: ProxyIndex) -> ImportedState {
        let Proxy {
            body,
            friction,
            restitution,
            surface,
            surface_velocity,
            filter,
            responds,
            events,
            one_way,
            fingerprint,
            ..
        } = *self.solver.proxies.proxy(proxy);
        let ([mass, inertia], [vx, vy, spin, vz]) =
            (self.solver.bodies.inverse_mass_inertia[body], surface_velocity);
        let [is, with, group, enabled, ignores] = filter;
        ImportedState {
            pose: self.pose_of(body),
            contact_properties: [mass, inertia, vx, vy, spin, vz, friction, restitution],
            surface,
            filter: [is, with, group, enabled, ignores, i32::from(responds) | i32::from(events) << 1],
            one_way,
            fingerprint,
        }
    }

    /// Returns the saved form of a pair. `saved_indices`: index of each proxy into `Saved::proxies`.
    fn save_pair(
        &self,
        pair: PairIndex,
        saved_indices: &IndexedVec<ProxyIndex, SavedProxyIndex>,
    ) -> SavedPair {
        let (watch, state) = (*self.solver.pairs.trigger(pair), *self.solver.pairs.state(pair));
        let manifold = self.solver.pairs.manifold(pair);
        SavedPair {
            proxies: watch.proxies.map(|proxy| saved_indices[proxy]),
            motion_at_check: watch.motion_at_check,
            motion_tolerance: watch.motion_tolerance,
            is_touching: state.is_touching,
            is_vetoed: state.is_vetoed,
            was_vetoed: state.was_vetoed,
            one_way_state: state.one_way_state,
            manifold: SavedManifold::of(manifold),
            constraint: state
                .constraint
                .map(|handle| SavedConstraint::of(&self.solver.constraints, &state, handle, manifold.count)),
        }
    }
}

/// Returns the current state. `pairs` makes the saved pairs from the index of each proxy into `Saved::proxies`.
pub(super) fn saved_with<Pairs>(
    precise: &Precise,
    pairs: impl FnOnce(IndexedVec<ProxyIndex, SavedProxyIndex>) -> Pairs,
) -> Saved<Pairs> {
    let solver = &precise.solver;
    let order = saved_proxy_order(&solver.proxies);
    let mut saved_indices =
        IndexedVec::of_copies(SavedProxyIndex::default(), solver.proxies.position_count());
    (0..).zip(&order).for_each(|(index, &at)| saved_indices[at] = SavedProxyIndex(index));
    let [substep, dt] = solver.step_lengths();
    Saved {
        tuning: solver.parameters,
        substep,
        dt,
        has_handled: solver.has_handler_changes,
        friction: solver.friction,
        most_contacts: solver.max_contacts,
        proxies: save_proxies(&solver.proxies, solver.depth.as_deref(), &order, |at| {
            precise.imported_state_of(at)
        }),
        pairs: pairs(saved_indices),
        awake_pair_count: solver.pairs.awake_count() as u32,
        gravity: solver.sleep.gravity,
        rest_times: precise.save_rest_times().collect(),
        sleeping_bodies: precise.save_sleeping_bodies(),
        joints: precise.sleeping_joints.clone(),
        solver_history: precise.save_solver_history().collect(),
        reselection_timer: solver.direct_solver.timer,
        is_in_space: solver.depth.is_some(),
        delta_poses: precise.save_delta_poses().collect(),
        woken: precise.edits.wake_requests.clone(),
        wake_requests: wake_requests(&precise.ids, &solver.sleep).collect(),
        touch_events: precise.save_touch_events(),
        pending_events: SavedPendingEvents::of(&precise.changed_kinds, &precise.sleep_events, |body| {
            precise.is_asleep(body)
        }),
    }
}

/// Iterates over the saved forms of all pairs. `saved_indices`: index of each proxy into `Saved::proxies`.
fn saved_pairs<'a>(
    precise: &'a Precise,
    saved_indices: &'a IndexedVec<ProxyIndex, SavedProxyIndex>,
) -> impl Iterator<Item = SavedPair> + 'a {
    precise.solver.pairs.indices().map(|pair| precise.save_pair(pair, saved_indices))
}

/// All pairs, to be serialised one by one: a list of their saved forms would be the greatest part of the memory that a
/// snapshot needs.
pub(super) struct PairStream<'a> {
    pub(super) precise: &'a Precise,
    /// Index of each proxy into `Saved::proxies`.
    pub(super) saved_indices: IndexedVec<ProxyIndex, SavedProxyIndex>,
}

impl Serialize for PairStream<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut pairs = serializer.serialize_seq(Some(self.precise.solver.pairs.indices().count()))?;
        saved_pairs(self.precise, &self.saved_indices).try_for_each(|pair| pairs.serialize_element(&pair))?;
        pairs.end()
    }
}

impl SavedManifold {
    /// Returns the saved form of a manifold.
    fn of(manifold: &CachedManifold) -> Self {
        let CachedManifold {
            rotations,
            relative_pose,
            normal,
            count,
            anchors,
            separations,
            features,
            arm_lead_angle,
            depth,
        } = *manifold;
        SavedManifold {
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

/// Returns the saved form of the proxies, in this `order`. `imported` returns the properties of a proxy by which a later edit is
/// detected.
fn save_proxies(
    proxies: &Proxies,
    depth: Option<&DepthState>,
    order: &[ProxyIndex],
    imported: impl Fn(ProxyIndex) -> ImportedState,
) -> IndexedVec<SavedProxyIndex, SavedProxy> {
    let mut has_escaped = IndexedVec::of_copies(false, proxies.position_count());
    proxies.refitted().iter().for_each(|&proxy| has_escaped[proxy] = true);
    let save = |&at: &ProxyIndex| {
        let proxy = proxies.proxy(at);
        SavedProxy {
            geom: geom_of(proxy),
            number: proxy.creation_number,
            piece: proxy.piece,
            body_type: proxy.body_type,
            fat_aabb: *proxies.fat_aabb_of(at),
            depth_interval: depth.map_or(DepthInterval::default(), |space| space.interval(at)),
            travel: proxies.travel_of(at),
            is_refitted: has_escaped[at],
            imported: imported(at),
        }
    };
    order.iter().map(save).collect()
}

/// Returns the indices of all proxies in the order in which a rebuild would list them. Only those of static bodies may be listed in
/// another order, after bodies have become static.
fn saved_proxy_order(proxies: &Proxies) -> Vec<ProxyIndex> {
    let proxy = |at: ProxyIndex| proxies.proxy(at);
    let mut order: Vec<ProxyIndex> = proxies.indices().filter(|&at| !proxy(at).is_empty()).collect();
    let first = order.partition_point(|&at| at < proxies.first_fixed);
    let end = first + order[first..].iter().take_while(|&&at| !proxy(at).is_world).count();
    let key = |&at: &ProxyIndex| packed_key([proxy(at).list_key, proxy(at).piece]);
    let fixed = &mut order[first..end];
    if !fixed.is_sorted_by_key(key) {
        sort_by_number(fixed, key);
    }
    order
}

/// Iterates over the ids of the bodies that wake at the next import, without those that the game has woken.
fn wake_requests<'a>(ids: &'a IdTable, sleep: &'a SleepState) -> impl Iterator<Item = BodyId> + 'a {
    sleep.wake_requests.iter().filter_map(|&body| *ids.bodies.at(body)?)
}
