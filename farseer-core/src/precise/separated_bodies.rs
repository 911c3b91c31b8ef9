//! Adapter: bodies that do not collide with each other because of a joint between them.
//!
//! The pairs of bodies follow from the enabled joints in the simulator's list. After an edit of joints the list is built anew
//! and compared with the former one. The contacts of a pair that is new in the list are removed, and the broad phase searches
//! the geoms of a pair that has left the list.

use super::Precise;
use super::ids::IdTable;
use crate::geom::filter::BodyPair;
use crate::objects::Objects;
use farseer_precise::Solver;
use farseer_precise::index::BodyIndex;

/// Brings the pairs of bodies that do not collide up to date with the joints, if joints were edited since the last call. Both
/// bodies of a changed pair wake. Called after the import of edits, so that the lists have all bodies.
pub(crate) fn separate_joined_bodies(precise: &mut Precise, objects: &mut Objects) {
    if !precise.joint_table.take_unseparated() {
        return;
    }
    let now = separated_bodies(objects);
    let before = &mut objects.separated_bodies;
    if now == *before {
        return;
    }
    let Precise { solver, ids, .. } = precise;
    let is_new = |list: &[BodyPair], pair: &BodyPair| list.binary_search(pair).is_err();
    now.iter().filter(|pair| is_new(before, pair)).for_each(|&pair| separate(solver, ids, pair));
    before.iter().filter(|pair| is_new(&now, pair)).for_each(|&pair| rejoin(solver, ids, pair));
    *before = now;
    precise.wake_up();
}

/// Returns the pairs of bodies that the enabled joints in the simulator's list keep from colliding, sorted, each once.
fn separated_bodies(objects: &Objects) -> Vec<BodyPair> {
    let joints = (0..objects.joints.list().len()).filter_map(|at| objects.joints.at(at));
    let mut pairs: Vec<BodyPair> = joints.filter_map(|(_, joint)| joint.separated_bodies()).collect();
    pairs.sort_unstable();
    pairs.dedup();
    pairs
}

/// Removes the pairs of proxies of two bodies. Touching ones get an event.
fn separate(solver: &mut Solver, ids: &IdTable, bodies: BodyPair) {
    let Some(bodies) = wake_both(solver, ids, bodies) else { return };
    let between = solver.pairs.pairs_between(&solver.proxies, bodies);
    solver.narrow_phase().remove_pairs(between);
}

/// Makes the broad phase search the pairs of two bodies, which may collide again: those of the body with fewer pairs.
fn rejoin(solver: &mut Solver, ids: &IdTable, bodies: BodyPair) {
    let Some(bodies) = wake_both(solver, ids, bodies) else { return };
    let body = solver.pairs.body_with_fewer_pairs(&solver.proxies, bodies);
    let proxies: Vec<_> = solver.proxies.proxies_of(body).collect();
    proxies.into_iter().for_each(|proxy| solver.proxies.search_pairs_of(proxy));
}

/// Requests that two bodies wake, and returns their indices; `None` if one of them is not simulated.
fn wake_both(solver: &mut Solver, ids: &IdTable, (one, other): BodyPair) -> Option<[BodyIndex; 2]> {
    let bodies = [ids.body_index(one)?, ids.body_index(other)?];
    bodies.into_iter().for_each(|body| solver.sleep.request_wake(body));
    Some(bodies)
}
