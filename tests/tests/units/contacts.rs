//! Contacts of two geoms and point tests (behaviour chapters 05, 06 and 07) against the record.

use conformance::units::{Case, Fields, assert_words, check, floats, vertices};
use farseer_core::math::Vector2;
use farseer_core::{
    Aabb, Body, BroadPhaseCollider, Contact, Context, EventHandler, GeomId, GeomPlacement,
    NarrowPhaseCollider, PhysicsSimulator,
};
use serde_json::Value;

fn text<'a>(record: &'a Value, key: &str) -> &'a str {
    record[key].as_str().unwrap_or_else(|| panic!("no {key} in {record}"))
}

/// With brute force its answer replaces the test of the AABBs, so that every pair reaches the narrow phase.
struct TakesEveryPair;

impl EventHandler for TakesEveryPair {
    fn handles_broad_phase(&self) -> bool {
        true
    }
    fn on_broad_phase_collision(&mut self, _: &mut Context<'_>, _: GeomId, _: GeomId) -> bool {
        true
    }
}

/// A recorded outline on a body of its own.
fn add_geom(simulator: &mut PhysicsSimulator, record: &Value, grid_size: f32) -> GeomId {
    let body = simulator.create_body(Body::new());
    let [position] = vertices(text(record, "position"))[..] else { panic!("{record}") };
    let [rotation] = floats(text(record, "rotation"))[..] else { panic!("{record}") };
    simulator[body].set_position(position);
    simulator[body].set_rotation(rotation);
    let outline = vertices(text(record, "vertices"));
    let geom = simulator.create_geom(body, outline, GeomPlacement::with_grid_size(grid_size)).unwrap();
    simulator.add(body).unwrap();
    simulator.add(geom).unwrap();
    geom
}

/// Contacts of the narrow phase between two recorded geoms, the first being made first.
struct Pair {
    simulator: PhysicsSimulator,
    geoms: [GeomId; 2],
    /// The ids of the record.
    ids: [u64; 2],
}

impl Pair {
    fn new(method: NarrowPhaseCollider, input: &Fields, first: &str, second: &str) -> Pair {
        let mut simulator = PhysicsSimulator::default();
        simulator.set_narrow_phase_collider(method);
        simulator.set_broad_phase_collider(BroadPhaseCollider::BruteForce).unwrap();
        simulator.set_max_contacts_to_resolve(i32::MAX).unwrap();
        let grid_size = input.f32("collision_grid_size");
        let records = [input.value(first), input.value(second)];
        let geoms = records.map(|record| add_geom(&mut simulator, record, grid_size));
        let ids = records.map(|record| record["id"].as_u64().unwrap());
        Pair { simulator, geoms, ids }
    }

    /// The contacts with at most `limit` looked for, deepest first, with the ids of the record.
    fn contacts(&self, limit: i32) -> Vec<(Contact, [i64; 3])> {
        let mut simulator = self.simulator.clone();
        simulator.set_max_contacts_to_detect(limit);
        assert!(simulator.process_queues(0.01, Some(&mut TakesEveryPair)));
        simulator.find_pairs(Some(&mut TakesEveryPair));
        assert_eq!(simulator.arbiter_count(), 1, "the pair does not reach the narrow phase");
        simulator.collide_pairs(None);
        let Some(arbiter) = simulator.arbiters().next() else { return Vec::new() };
        assert_eq!([arbiter.geom_a(), arbiter.geom_b()], self.geoms);
        let recorded_id = |number: u32| self.ids[number as usize] as i64;
        let named = |contact: Contact| {
            let id = contact.id;
            (contact, [recorded_id(id.geom1), i64::from(id.vertex), recorded_id(id.geom2)])
        };
        arbiter.contacts().map(named).collect()
    }
}

fn expect_contact(contact: &Contact, record: &Value) {
    assert_words(&contact.position, text(record, "position"));
    assert_words(&contact.normal, text(record, "normal"));
    assert_words(&contact.separation, text(record, "separation"));
}

fn recorded_id(record: &Value) -> Vec<i64> {
    record["id"].as_array().unwrap().iter().map(|n| n.as_i64().unwrap()).collect()
}

/// The simulator sorts the contacts of the narrow phase; the record does not.
fn deepest_first(records: &[Value]) -> Vec<&Value> {
    let mut sorted: Vec<&Value> = records.iter().collect();
    let separation = |record: &&Value| floats(text(record, "separation"))[0];
    sorted.sort_by(|a, b| separation(a).partial_cmp(&separation(b)).unwrap());
    sorted
}

fn expect_contacts(pair: &Pair, limit: i32, records: &[Value]) {
    let found = pair.contacts(limit);
    let expected = deepest_first(records);
    let ids = |list: &[&Value]| list.iter().map(|record| recorded_id(record)).collect::<Vec<_>>();
    let found_ids: Vec<Vec<i64>> = found.iter().map(|(_, id)| id.to_vec()).collect();
    assert_eq!(found_ids, ids(&expected));
    for ((contact, _), record) in found.iter().zip(expected) {
        expect_contact(contact, record);
    }
}

fn contacts_are_as_recorded(file: &str, method: NarrowPhaseCollider) {
    check(file, "Collide", |case| {
        let limit = case.input.integer("max_contacts_to_detect");
        for (key, first, second) in [("a_then_b", "a", "b"), ("b_then_a", "b", "a")] {
            let pair = Pair::new(method, &case.input, first, second);
            expect_contacts(&pair, limit, case.output.value(key).as_array().unwrap());
        }
        let mut pair = Pair::new(method, &case.input, "a", "b");
        pair.simulator.process_added_and_removed();
        let [a, b] = pair.geoms;
        let [box_a, box_b] = [a, b].map(|geom| pair.simulator.geom(geom).unwrap().aabb());
        case.expect_bool("aabb_overlap", Aabb::intersect(&box_a, &box_b));
        case.expect_bool("geom_collide", pair.simulator.geom_collides_with_geom(a, b));
    });
}

#[test]
fn grid_contacts_are_as_recorded() {
    contacts_are_as_recorded("contacts_distance_grid", NarrowPhaseCollider::DistanceGrid);
}

#[test]
fn sat_contacts_are_as_recorded() {
    contacts_are_as_recorded("contacts_sat", NarrowPhaseCollider::Sat);
}

/// The limit stops the search, so the contact that a limit of k + 1 adds is the k-th one.
#[test]
fn grid_contacts_are_found_in_the_recorded_order() {
    check("contacts_distance_grid", "Collide", |case| {
        for (key, first, second) in [("a_then_b", "a", "b"), ("b_then_a", "b", "a")] {
            let pair = Pair::new(NarrowPhaseCollider::DistanceGrid, &case.input, first, second);
            let records = case.output.value(key).as_array().unwrap();
            for limit in 0..=records.len() {
                expect_contacts(&pair, limit as i32, &records[..limit]);
            }
        }
        // Compared elsewhere.
        case.output.value("aabb_overlap");
        case.output.value("geom_collide");
    });
}

fn expect_point_tests(case: &Case, method: NarrowPhaseCollider) {
    let mut simulator = PhysicsSimulator::default();
    simulator.set_narrow_phase_collider(method);
    let body = simulator.create_body(Body::new());
    simulator[body].set_position(case.input.vector("position"));
    simulator[body].set_rotation(case.input.f32("rotation"));
    let placement = GeomPlacement {
        offset: case.input.vector("offset"),
        rotation_offset: case.input.f32("rotation_offset"),
        collision_grid_size: case.input.f32("collision_grid_size"),
    };
    let id = simulator.create_geom(body, case.input.vertices("vertices"), placement).unwrap();
    let geom = simulator.geom(id).unwrap();
    case.expect("geom_position", &geom.position());
    case.expect("geom_rotation", &geom.rotation());
    case.expect("world_vertices", &*geom.world_vertices());
    assert_words(&[geom.aabb().min, geom.aabb().max][..], case.output.text("aabb"));
    for query in case.output.value("queries").as_array().unwrap() {
        let [point] = vertices(text(query, "point"))[..] else { panic!("{query}") };
        let inside = simulator.geom_collides_with_point(id, point);
        assert_eq!(inside, query["inside"].as_bool().unwrap(), "{query}");
    }
    let point: Vector2 = case.input.vector("transform_point");
    case.expect("world_position_of_point", &geom.get_world_position(point));
    case.expect("local_of_point", &geom.transform_to_local_coordinates(point));
    let normal = case.input.vector("transform_normal");
    case.expect("world_of_normal", &geom.transform_normal_to_world(normal));
}

#[test]
fn points_are_tested_against_grids_as_recorded() {
    check("contacts_distance_grid", "PointCollide", |case| {
        expect_point_tests(case, NarrowPhaseCollider::DistanceGrid);
    });
}

#[test]
fn points_are_tested_against_outlines_as_recorded() {
    check("contacts_sat", "PointCollide", |case| expect_point_tests(case, NarrowPhaseCollider::Sat));
}
