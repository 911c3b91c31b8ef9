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

#[cfg(test)]
mod tests {
    use crate::math::Vector2;
    use crate::{BodyFactory, BodyId, GeomFactory, GeomPlacement, JointFactory, Methods, PhysicsSimulator};

    /// A hub, which collides with no other body, and boxes that overlap it, each at a place of its own.
    fn hub(boxes: usize) -> (PhysicsSimulator, BodyId, Vec<BodyId>) {
        let mut simulator = PhysicsSimulator::default();
        simulator.set_methods(Methods::PRECISE).unwrap();
        let mut add = |size: f32, x: f32| {
            let body = BodyFactory::create_rectangle_body_in(&mut simulator, size, 4.0, 1.0).unwrap();
            simulator[body].set_position(Vector2::new(x, 0.0));
            let place = GeomPlacement::default();
            let geom = GeomFactory::create_rectangle_geom_in(&mut simulator, body, size, 4.0, place).unwrap();
            simulator[geom].set_collision_response_enabled(false);
            body
        };
        let width = 10.0 * boxes as f32;
        let hub = add(width, 0.5 * width);
        let all = (0..boxes).map(|at| add(4.0, 10.0 * at as f32)).collect();
        (simulator, hub, all)
    }

    #[test]
    fn the_pairs_of_two_bodies_are_found_from_the_one_with_fewer_pairs() {
        let (mut simulator, hub, boxes) = hub(200);
        simulator.update(0.01);
        let precise = simulator.pipeline.precise.as_ref().unwrap();
        let (pairs, proxies) = (&precise.solver.pairs, &precise.solver.proxies);
        let index = |body| precise.ids.body_index(body).unwrap();
        let (hub, one, other) = (index(hub), index(boxes[70]), index(boxes[3]));
        for bodies in [[hub, one], [one, hub]] {
            let between = pairs.pairs_between(proxies, bodies);
            assert_eq!(between.len(), 1);
            assert_eq!(between, pairs.pairs_of_body(proxies, one).collect::<Vec<_>>());
            assert_eq!(pairs.body_with_fewer_pairs(proxies, bodies), one);
        }
        assert!(pairs.pairs_between(proxies, [one, other]).is_empty());
    }

    #[test]
    fn a_flag_at_one_of_many_boxes_on_a_hub_removes_and_finds_one_pair() {
        let (mut simulator, hub, boxes) = hub(200);
        let at = simulator[boxes[70]].position();
        let joint = JointFactory::create_revolute_joint_in(&mut simulator, hub, boxes[70], at).unwrap();
        simulator.update(0.01);
        let count = |simulator: &PhysicsSimulator| simulator.pipeline.precise.as_ref().unwrap().pair_count();
        let all = count(&simulator);
        for (do_collide, expected) in [(false, all - 1), (true, all), (false, all - 1)] {
            simulator.set_joint_bodies_collide(joint, do_collide).unwrap();
            simulator.update(0.01);
            assert_eq!(count(&simulator), expected);
        }
    }
}
