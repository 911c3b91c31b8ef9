//! Which contacts and joints the islands have that are solved as a whole.

use super::Direct;
use super::constraint::{Ends, FIXED};
use super::depth::{is_in_plane, unload};
use super::whole::Whole;
use crate::precise::Precise;
use crate::precise::islands::Islands;
use crate::precise::joints::Joints;
use crate::precise::joints::springs::Springs;
use crate::precise::pairs::Pairs;
use crate::precise::proxies::Proxies;
use crate::precise::rows::{Home, Lane};
use crate::storage::order::{joined, sort_within};

impl Precise {
    /// The contacts of each island, in the order of creation numbers.
    pub(super) fn list_contacts(&mut self) {
        let Precise { direct, pairs, proxies, rows, .. } = self;
        let Direct { islands, unions, census, found, order, .. } = direct;
        found.clear();
        let all = (0..pairs.awake).filter(|&pair| pairs.all[pair].home.is_some_and(Home::is_direct));
        found.extend(all.map(|pair| {
            let body = proxies.all[pairs.watched[pair].proxies[1] as usize].body;
            (census[unions.find(body) as usize].place.unwrap_or(0), pair as u32)
        }));
        // Island by island, in each in the order of creation numbers.
        sort_within(order, found, |&(_, pair)| {
            proxies.creation_numbers(pairs.watched[pair as usize].proxies)
        });
        sort_within(order, found, |&(place, _)| place.into());
        for &(place, pair) in found.iter() {
            let Some(home) = pairs.all[pair as usize].home else { continue };
            let Whole { island, homes, ends, .. } = &mut islands[place as usize];
            let lane = &mut rows.direct_mut(home).lane;
            if !is_in_plane(lane) {
                unload(lane);
                continue;
            }
            let Lane { a, b, .. } = *lane;
            let seat = |body: u32| island.members.binary_search_by_key(&body, |member| member.number);
            let bodies = [a, b].map(|body| seat(body).map_or(FIXED, |seat| seat as u32));
            let gives_way = bodies.iter().all(|&member| member != FIXED);
            let entry = gives_way.then(|| island.factor.entry(bodies[0], bodies[1]));
            homes.push(home);
            ends.push(Ends { bodies, entry });
        }
    }

    /// The joints of each island, and its springs, in their order.
    pub(super) fn list_joints(&mut self) {
        let Precise { direct, joints, springs, space, .. } = self;
        let Direct { islands, unions, census, wear, .. } = direct;
        let of_joints = joints.candidates().map(|joint| (joint, false));
        let all = of_joints.chain(springs.candidates().map(|spring| (spring, true)));
        for (joint, is_spring) in all.filter(|_| space.is_none()) {
            let Some(body) = joint.a_body() else { continue };
            if !wear.get(body as usize).is_some_and(|wear| wear.is_direct) {
                continue;
            }
            let Some(place) = census[unions.find(body) as usize].place else { continue };
            let Whole { island, joints, joint_ends, springs, spring_ends, .. } = &mut islands[place as usize];
            let seat = |body: u32| island.members.binary_search_by_key(&body, |member| member.number);
            let bodies = joint.bodies.map(|body| seat(body).map_or(FIXED, |seat| seat as u32));
            let gives_way = bodies.iter().all(|&member| member != FIXED);
            let entry = gives_way.then(|| island.factor.entry(bodies[0], bodies[1]));
            let (list, ends) = if is_spring { (springs, spring_ends) } else { (joints, joint_ends) };
            list.push(joint.joint);
            ends.push(Ends { bodies, entry });
        }
    }
}

/// Which of these bodies touch each other, as places in their list.
pub(super) fn list_edges(
    members: &[(u32, u32)],
    pairs: &Pairs,
    proxies: &Proxies,
    edges: &mut Vec<[u32; 2]>,
    order: &mut Vec<(u128, u32)>,
) {
    let place = |body: u32| members.binary_search_by_key(&body, |member| member.1).ok();
    edges.clear();
    for (one, &(_, body)) in members.iter().enumerate() {
        for pair in pairs.of_body(proxies, body as usize) {
            let [a, b] = pairs.watched[pair].proxies.map(|proxy| proxies.all[proxy as usize].body);
            let other = if a == body { b } else { a };
            if pairs.all[pair].home.is_some() && body < other {
                edges.extend(place(other).map(|other| [one as u32, other as u32]));
            }
        }
    }
    sort_within(order, edges, |&edge| joined(edge));
    edges.dedup();
}

/// The bodies that joints in the plane and springs tie together, by the roots of their islands.
pub(super) fn list_joined(
    (joints, springs): (&Joints, &Springs),
    unions: &mut Islands,
    joined_bodies: &mut Vec<(u32, [u32; 2])>,
    order: &mut Vec<(u128, u32)>,
) {
    joined_bodies.clear();
    let all = joints.candidates().chain(springs.candidates());
    let of_two = all.map(|joint| joint.bodies).filter(|[a, b]| *a != 0 && *b != 0);
    joined_bodies.extend(of_two.map(|bodies| (unions.find(bodies[0]), bodies)));
    sort_within(order, joined_bodies, |&(root, _)| root.into());
}

/// Adds which of these bodies joints tie together, as places in their list.
pub(super) fn add_edges_of_joints(
    members: &[(u32, u32)],
    joined_bodies: &[(u32, [u32; 2])],
    edges: &mut Vec<[u32; 2]>,
    order: &mut Vec<(u128, u32)>,
) {
    let root = members[0].0;
    let first = joined_bodies.partition_point(|&(other, _)| other < root);
    let place = |body: u32| members.binary_search_by_key(&body, |member| member.1).ok();
    for &(_, [a, b]) in joined_bodies[first..].iter().take_while(|&&(other, _)| other == root) {
        if let (Some(a), Some(b)) = (place(a), place(b)) {
            edges.push([a.min(b) as u32, a.max(b) as u32]);
        }
    }
    sort_within(order, edges, |&edge| joined(edge));
    edges.dedup();
}
