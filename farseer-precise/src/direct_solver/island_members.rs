//! Membership of the islands of the direct solver: lists their bodies, contacts, joints and springs, and the edges of their
//! graphs.

use super::DirectSolver;
use super::constraint::{BodyIndices, FIXED};
use super::island_body::{IslandBody, MemberIndex};
use super::island_history::merged_history;
use super::island_io::DirectIsland;
use super::island_newton::IslandSystem;
use super::island_stats::IslandIndex;
use super::lateral_friction::{clear_impulses, is_planar};
use crate::broad_phase::pairs::Pairs;
use crate::broad_phase::proxies::Proxies;
use crate::constraint_graph::{ConstraintGraph, ContactConstraint};
use crate::index::{BodyIndex, DenseIndex};
use crate::island::sleep::SleepState;
use crate::island::union_find::UnionFind;
use crate::joints::JointSystem;
use crate::joints::indices::CandidateIndex;
use crate::joints::springs::SpringRows;
use crate::parameters::direct::{
    BUSY_ISLAND_PAUSE, FACTOR_PRODUCTS_PER_BODY, JOINTED_FACTOR_PRODUCTS_PER_BODY, RESELECTION_PERIOD,
};
use crate::storage::order::{packed_key, sort_by_number_in};

impl DirectSolver {
    /// In 2.5D: lists the islands anew in this update, unless they list all planar contacts of the direct solver and no other
    /// contacts. The normal of a contact may turn towards the depth axis or back while the contact persists.
    pub(crate) fn check_listed_contacts(&mut self, constraints: &ConstraintGraph) {
        if !self.is_listed || self.timer.is_due {
            return;
        }
        let in_plane =
            constraints.direct_constraints().iter().filter(|row| is_planar(&row.constraint)).count();
        let islands = self.islands.slice(..self.count);
        let listed: usize = islands.iter().map(|island| island.contact_handles.len()).sum();
        let mut handles = islands.iter().flat_map(|island| &island.contact_handles);
        self.is_listed = listed == in_plane
            && handles.all(|&handle| is_planar(&constraints.direct_constraint(handle).constraint));
    }

    /// Lists the awake bodies of the islands that the direct solver gets, up to the body index `last_movable`. With `selects`
    /// solvers are selected anew, otherwise each island keeps its solver. Starts the pauses of islands that the direct solver
    /// gives up, and starts or ends the friction checks of the others.
    pub(crate) fn choose_members(&mut self, selects: bool, sleep: &SleepState, last_movable: BodyIndex) {
        let DirectSolver { census, keyed_bodies, history, has_no_friction_checks, timer, .. } = self;
        keyed_bodies.clear();
        for body in sleep.awake_bodies(last_movable) {
            let root = census.root_of(body);
            let (stats, history) = (&census.stats[root], &mut history[body]);
            let is_wanted =
                if selects { stats.rejection_reason(timer.choice).is_none() } else { history.is_direct };
            keyed_bodies.extend(is_wanted.then_some((root, body)));
            if !selects {
                continue;
            }
            history.formed_by_motion |= stats.moves;
            let is_given_up = stats.joints > 0 && stats.was_paused && !is_wanted;
            if (stats.must_back_off() || is_given_up) && history.pause == 0 {
                history.pause = RESELECTION_PERIOD;
                timer.has_paused = true;
            }
            let is_watched = (!is_wanted || stats.is_on_trial(timer.choice))
                && stats.is_small_cycle()
                && !(stats.moves || stats.formed_by_motion);
            if !is_watched {
                history.friction_checks = 0;
            } else if history.friction_checks == 0 {
                history.begin_friction_checks();
                *has_no_friction_checks = false;
            }
        }
    }

    /// Lists the members of each island of the direct solver, in ascending order, and analyses its matrix.
    /// [`choose_members`](Self::choose_members) has listed the bodies; `selects` is as there. An island whose factorisation has
    /// too much fill-in goes to the iterative solver for a pause of [`BUSY_ISLAND_PAUSE`] updates.
    pub(crate) fn plan_islands(
        &mut self,
        selects: bool,
        pairs: &Pairs,
        proxies: &Proxies,
        (joints, springs): (&JointSystem, &SpringRows),
    ) {
        self.begin_plan(selects, (joints, springs));
        let DirectSolver { islands, count, census, keyed_bodies, history, timer, .. } = self;
        let DirectSolver { edges, jointed_bodies, sort_keys, .. } = self;
        *count = 0;
        for members in keyed_bodies.chunk_by(|one, other| one.0 == other.0) {
            if islands.len() == *count {
                islands.push(DirectIsland::default());
            }
            let stats = &mut census.stats[members[0].0];
            list_contact_edges(members, pairs, proxies, edges, sort_keys);
            if stats.joints > 0 {
                add_joint_edges(members, jointed_bodies, edges, sort_keys);
            }
            let (earlier, island) = islands.split_at_mut(*count);
            island[0].begin(members);
            island[0].is_on_trial = selects && stats.is_on_trial(timer.choice);
            let mut merged = merged_history(members, history);
            if island[0].analyse(edges, stats.joints > 0, earlier.last()) {
                stats.island_index = Some(IslandIndex::new(*count));
                *count += 1;
            } else {
                (merged.is_direct, merged.pause) = (false, BUSY_ISLAND_PAUSE);
                timer.has_paused = true;
            }
            if selects {
                members.iter().for_each(|&(_, body)| history[body] = merged);
            }
        }
    }

    /// Sorts the listed bodies by island, lists the pairs of bodies that joints and springs connect, and with `selects` forgets
    /// which bodies the direct solver had.
    fn begin_plan(&mut self, selects: bool, holds: (&JointSystem, &SpringRows)) {
        let DirectSolver { census, keyed_bodies, jointed_bodies, sort_keys, history, .. } = self;
        sort_by_number_in(sort_keys, keyed_bodies, |&(root, body)| packed_key([root.0, body.0]));
        if selects {
            history.iter_mut().for_each(|entry| entry.is_direct = false);
        }
        jointed_bodies.clear();
        if census.has_joints() {
            list_jointed_bodies(holds, &mut census.union_find, jointed_bodies, sort_keys);
        }
    }

    /// Lists the contacts of each island of the direct solver, in ascending order of the creation numbers of their geoms. A
    /// contact that is not planar is left out, and its impulses are set to 0.
    pub(crate) fn list_contacts(&mut self, pairs: &Pairs, proxies: &Proxies, rows: &mut ConstraintGraph) {
        let DirectSolver { islands, census, keyed_pairs, sort_keys, .. } = self;
        keyed_pairs.clear();
        let all = pairs
            .awake()
            .filter(|&pair| pairs.constraint(pair).is_some_and(|(_, handle)| handle.is_in_direct_solver()));
        keyed_pairs.extend(all.map(|pair| {
            let [_, (body, _)] = pairs.bodies_of(proxies, pair);
            let island = census.stats_of(BodyIndex::new(body.position())).island_index;
            (island.unwrap_or_default(), pair)
        }));
        // Island by island, and within an island by creation numbers.
        sort_by_number_in(sort_keys, keyed_pairs, |&(_, pair)| pairs.creation_numbers(proxies, pair));
        sort_by_number_in(sort_keys, keyed_pairs, |&(island, _)| island.0.into());
        for &(island, pair) in keyed_pairs.iter() {
            let Some((_, handle)) = pairs.constraint(pair) else { continue };
            let DirectIsland { system, contact_handles, contact_bodies, .. } = &mut islands[island];
            let contact = &mut rows.direct_constraint_mut(handle).constraint;
            if !is_planar(contact) {
                clear_impulses(contact);
                continue;
            }
            let ContactConstraint { a, b, .. } = *contact;
            let member_of =
                |body: BodyIndex| system.members.binary_search_by_key(&body, |member| member.body);
            let bodies = [a, b].map(|body| member_of(BodyIndex(body.0)).map_or(FIXED, MemberIndex::new));
            let are_dynamic = bodies.iter().all(|&member| member != FIXED);
            let entry = are_dynamic.then(|| system.factor.block_index(bodies[0], bodies[1]));
            contact_handles.push(handle);
            contact_bodies.push(BodyIndices { bodies, block: entry });
        }
    }

    /// Lists the joints and springs of each island of the direct solver, in the order of the joint list. It is called in 2D
    /// only.
    pub(crate) fn list_joints(&mut self, joints: &JointSystem, springs: &SpringRows) {
        let DirectSolver { islands, census, history, .. } = self;
        for joint in joints.candidates().chain(springs.candidates()) {
            let Some(body) = joint.first_dynamic_body() else { continue };
            if !history.at(body).is_some_and(|entry| entry.is_direct) {
                continue;
            }
            let Some(island) = census.stats_of(body).island_index else { continue };
            let DirectIsland { system, joints, joint_bodies, springs, spring_bodies, .. } =
                &mut islands[island];
            let member_of =
                |body: BodyIndex| system.members.binary_search_by_key(&body, |member| member.body);
            let bodies = joint.bodies.map(|body| member_of(body).map_or(FIXED, MemberIndex::new));
            let are_dynamic = bodies.iter().all(|&member| member != FIXED);
            let entry = are_dynamic.then(|| system.factor.block_index(bodies[0], bodies[1]));
            let ends = BodyIndices { bodies, block: entry };
            match joint.index {
                CandidateIndex::Joint(index) => {
                    joints.push(index);
                    joint_bodies.push(ends);
                }
                CandidateIndex::Spring(index) => {
                    springs.push(index);
                    spring_bodies.push(ends);
                }
            }
        }
    }
}

impl DirectIsland {
    /// Clears all lists of the island, and makes `members` its members: pairs of the union-find root and a body index.
    pub(super) fn begin(&mut self, members: &[(BodyIndex, BodyIndex)]) {
        self.contact_handles.clear();
        self.contact_bodies.clear();
        self.joints.clear();
        self.joint_bodies.clear();
        self.springs.clear();
        self.spring_bodies.clear();
        self.has_impulse_sum = false;
        self.resting_bodies.clear();
        let members = members.iter().map(|&(_, body)| IslandBody { body, ..IslandBody::default() });
        self.system.members.clear();
        self.system.members.extend(members);
    }

    /// Analyses the matrix of the island, in which `edges` connect the members. Returns whether its factorisation has little
    /// enough fill-in. `similar` is another island, whose analysis serves if its graph is equal.
    fn analyse(&mut self, edges: &[[MemberIndex; 2]], has_joints: bool, similar: Option<&Self>) -> bool {
        let IslandSystem { members, factor, .. } = &mut self.system;
        let products_per_body =
            if has_joints { JOINTED_FACTOR_PRODUCTS_PER_BODY } else { FACTOR_PRODUCTS_PER_BODY };
        let similar = similar.map(|other| &other.system.factor);
        factor.analyse(members.len(), edges, products_per_body * members.len(), similar)
    }
}

/// Lists in `edges` the pairs of members that touch, as indices into `members`: smaller index first, in ascending order, each
/// pair once. `members` are pairs of the union-find root and a body index; `order` is scratch of the sorting.
pub(super) fn list_contact_edges(
    members: &[(BodyIndex, BodyIndex)],
    pairs: &Pairs,
    proxies: &Proxies,
    edges: &mut Vec<[MemberIndex; 2]>,
    order: &mut Vec<(u128, u32)>,
) {
    let place = |body: BodyIndex| members.binary_search_by_key(&body, |member| member.1).ok();
    edges.clear();
    for (one, &(_, body)) in members.iter().enumerate() {
        for pair in pairs.pairs_of_body(proxies, body) {
            let [a, b] = pairs.bodies_of(proxies, pair).map(|(body, _)| BodyIndex::new(body.position()));
            let other = if a == body { b } else { a };
            if pairs.has_constraint(pair) && body < other {
                edges.extend(place(other).map(|other| [one, other].map(MemberIndex::new)));
            }
        }
    }
    sort_by_number_in(order, edges, |edge| packed_key(edge.map(|member| member.0)));
    edges.dedup();
}

/// Lists in `jointed_bodies` the pairs of dynamic bodies that joints and springs connect. Each item is the union-find root of
/// the island and two body indices; items are sorted by root. `order` is scratch of the sorting.
pub(super) fn list_jointed_bodies(
    (joints, springs): (&JointSystem, &SpringRows),
    union_find: &mut UnionFind<BodyIndex>,
    jointed_bodies: &mut Vec<(BodyIndex, [BodyIndex; 2])>,
    order: &mut Vec<(u128, u32)>,
) {
    jointed_bodies.clear();
    let all = joints.candidates().chain(springs.candidates());
    let of_two = all.filter_map(|joint| joint.dynamic_pair());
    jointed_bodies.extend(of_two.map(|bodies| (BodyIndex(union_find.find(bodies[0]).0), bodies)));
    sort_by_number_in(order, jointed_bodies, |&(root, _)| root.0.into());
}

/// Adds to `edges`, the edges of one island, the pairs of members that joints and springs connect, as indices into `members`.
/// The edges stay sorted, each pair once. `jointed_bodies` is the result of [`list_jointed_bodies`]; `order` is scratch of the
/// sorting.
pub(super) fn add_joint_edges(
    members: &[(BodyIndex, BodyIndex)],
    jointed_bodies: &[(BodyIndex, [BodyIndex; 2])],
    edges: &mut Vec<[MemberIndex; 2]>,
    order: &mut Vec<(u128, u32)>,
) {
    let root = members[0].0;
    let first = jointed_bodies.partition_point(|&(other, _)| other < root);
    let place = |body: BodyIndex| members.binary_search_by_key(&body, |member| member.1).ok();
    for &(_, [a, b]) in jointed_bodies[first..].iter().take_while(|&&(other, _)| other == root) {
        if let (Some(a), Some(b)) = (place(a), place(b)) {
            edges.push([a.min(b), a.max(b)].map(MemberIndex::new));
        }
    }
    sort_by_number_in(order, edges, |edge| packed_key(edge.map(|member| member.0)));
    edges.dedup();
}
