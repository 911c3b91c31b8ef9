//! Membership of the islands of the direct solver: lists their contacts, joints and springs, and the edges of their graphs.

use super::DirectSolver;
use super::constraint::{BodyIndices, FIXED};
use super::island_io::DirectIsland;
use super::island_newton::IslandBody;
use super::lateral_friction::{clear_impulses, is_planar};
use crate::precise::broad_phase::pairs::Pairs;
use crate::precise::broad_phase::proxies::Proxies;
use crate::precise::constraint_graph::{ConstraintGraph, ConstraintHandle, ContactConstraint};
use crate::precise::island::union_find::UnionFind;
use crate::precise::joints::JointSystem;
use crate::precise::joints::springs::SpringRows;
use crate::storage::order::{packed_key, sort_by_number_in};

impl DirectSolver {
    /// Lists the contacts of each island of the direct solver, in ascending order of the creation numbers of their geoms. A
    /// contact that is not planar is left out, and its impulses are set to 0.
    pub(in crate::precise) fn list_contacts(
        &mut self,
        pairs: &Pairs,
        proxies: &Proxies,
        rows: &mut ConstraintGraph,
    ) {
        let DirectSolver { islands, census, keyed_items, sort_keys, .. } = self;
        keyed_items.clear();
        let all = (0..pairs.awake_count)
            .filter(|&pair| pairs.all[pair].constraint.is_some_and(ConstraintHandle::is_in_direct_solver));
        keyed_items.extend(all.map(|pair| {
            let body = proxies.all[pairs.triggers[pair].proxies[1] as usize].body;
            (census.stats_of(body).island_index.unwrap_or(0), pair as u32)
        }));
        // Island by island, and within an island by creation numbers.
        sort_by_number_in(sort_keys, keyed_items, |&(_, pair)| {
            proxies.creation_numbers(pairs.triggers[pair as usize].proxies)
        });
        sort_by_number_in(sort_keys, keyed_items, |&(place, _)| place.into());
        for &(place, pair) in keyed_items.iter() {
            let Some(handle) = pairs.all[pair as usize].constraint else { continue };
            let DirectIsland { system, contact_handles, contact_bodies, .. } = &mut islands[place as usize];
            let contact = &mut rows.direct_constraint_mut(handle).constraint;
            if !is_planar(contact) {
                clear_impulses(contact);
                continue;
            }
            let ContactConstraint { a, b, .. } = *contact;
            let member_of = |body: u32| system.members.binary_search_by_key(&body, |member| member.body);
            let bodies = [a, b].map(|body| member_of(body).map_or(FIXED, |index| index as u32));
            let are_dynamic = bodies.iter().all(|&member| member != FIXED);
            let entry = are_dynamic.then(|| system.factor.block_index(bodies[0], bodies[1]));
            contact_handles.push(handle);
            contact_bodies.push(BodyIndices { bodies, block: entry });
        }
    }

    /// Lists the joints and springs of each island of the direct solver, in the order of the joint list. It is called in 2D
    /// only.
    pub(in crate::precise) fn list_joints(&mut self, joints: &JointSystem, springs: &SpringRows) {
        let DirectSolver { islands, census, history, .. } = self;
        let of_joints = joints.candidates().map(|joint| (joint, false));
        let all = of_joints.chain(springs.candidates().map(|spring| (spring, true)));
        for (joint, is_spring) in all {
            let Some(body) = joint.first_dynamic_body() else { continue };
            if !history.get(body as usize).is_some_and(|entry| entry.is_direct) {
                continue;
            }
            let Some(place) = census.stats_of(body).island_index else { continue };
            let DirectIsland { system, joints, joint_bodies, springs, spring_bodies, .. } =
                &mut islands[place as usize];
            let member_of = |body: u32| system.members.binary_search_by_key(&body, |member| member.body);
            let bodies = joint.bodies.map(|body| member_of(body).map_or(FIXED, |index| index as u32));
            let are_dynamic = bodies.iter().all(|&member| member != FIXED);
            let entry = are_dynamic.then(|| system.factor.block_index(bodies[0], bodies[1]));
            let (list, ends) = if is_spring { (springs, spring_bodies) } else { (joints, joint_bodies) };
            list.push(joint.joint);
            ends.push(BodyIndices { bodies, block: entry });
        }
    }
}

impl DirectIsland {
    /// Clears all lists of the island, and makes `members` its members: pairs of the union-find root and a body index.
    pub(super) fn begin(&mut self, members: &[(u32, u32)]) {
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
}

/// Lists in `edges` the pairs of members that touch, as indices into `members`: smaller index first, in ascending order, each
/// pair once. `members` are pairs of the union-find root and a body index; `order` is scratch of the sorting.
pub(super) fn list_contact_edges(
    members: &[(u32, u32)],
    pairs: &Pairs,
    proxies: &Proxies,
    edges: &mut Vec<[u32; 2]>,
    order: &mut Vec<(u128, u32)>,
) {
    let place = |body: u32| members.binary_search_by_key(&body, |member| member.1).ok();
    edges.clear();
    for (one, &(_, body)) in members.iter().enumerate() {
        for pair in pairs.pairs_of_body(proxies, body as usize) {
            let [a, b] = pairs.triggers[pair].proxies.map(|proxy| proxies.all[proxy as usize].body);
            let other = if a == body { b } else { a };
            if pairs.all[pair].constraint.is_some() && body < other {
                edges.extend(place(other).map(|other| [one as u32, other as u32]));
            }
        }
    }
    sort_by_number_in(order, edges, |&edge| packed_key(edge));
    edges.dedup();
}

/// Lists in `jointed_bodies` the pairs of dynamic bodies that joints and springs connect. Each item is the union-find root of
/// the island and two body indices; items are sorted by root. `order` is scratch of the sorting.
pub(super) fn list_jointed_bodies(
    (joints, springs): (&JointSystem, &SpringRows),
    union_find: &mut UnionFind,
    jointed_bodies: &mut Vec<(u32, [u32; 2])>,
    order: &mut Vec<(u128, u32)>,
) {
    jointed_bodies.clear();
    let all = joints.candidates().chain(springs.candidates());
    let of_two = all.map(|joint| joint.bodies).filter(|[a, b]| *a != 0 && *b != 0);
    jointed_bodies.extend(of_two.map(|bodies| (union_find.find(bodies[0]), bodies)));
    sort_by_number_in(order, jointed_bodies, |&(root, _)| root.into());
}

/// Adds to `edges`, the edges of one island, the pairs of members that joints and springs connect, as indices into `members`.
/// The edges stay sorted, each pair once. `jointed_bodies` is the result of [`list_jointed_bodies`]; `order` is scratch of the
/// sorting.
pub(super) fn add_joint_edges(
    members: &[(u32, u32)],
    jointed_bodies: &[(u32, [u32; 2])],
    edges: &mut Vec<[u32; 2]>,
    order: &mut Vec<(u128, u32)>,
) {
    let root = members[0].0;
    let first = jointed_bodies.partition_point(|&(other, _)| other < root);
    let place = |body: u32| members.binary_search_by_key(&body, |member| member.1).ok();
    for &(_, [a, b]) in jointed_bodies[first..].iter().take_while(|&&(other, _)| other == root) {
        if let (Some(a), Some(b)) = (place(a), place(b)) {
            edges.push([a.min(b) as u32, a.max(b) as u32]);
        }
    }
    sort_by_number_in(order, edges, |&edge| packed_key(edge));
    edges.dedup();
}
