//! User data of objects, by id.

use conformance::fixtures::plane::simulator;
use farseer_core::{Body, BodyId, SecondaryMap};

#[test]
fn absent_keys_have_no_value_and_zero_is_a_value() {
    let mut simulator = simulator(0.0);
    let (known, unknown) = (simulator.create_body(Body::new()), simulator.create_body(Body::new()));
    let mut table = SecondaryMap::new();
    assert_eq!(table.insert(known, 0), None);
    assert_eq!((table.get(known), table.get(unknown), table.len()), (Some(&0), None, 1));
}

#[test]
fn a_stale_id_does_not_find_the_value_of_the_next_object_in_its_slot() {
    let mut simulator = simulator(0.0);
    let old = simulator.create_body(Body::new());
    let mut table = SecondaryMap::new();
    table.insert(old, "old");
    simulator.dispose(old).unwrap();
    simulator.update(0.01);
    let new = simulator.create_body(Body::new());
    assert_eq!(new.slot(), old.slot());
    assert_eq!(table.get(new), None, "what came after it does not find what was known of it either");
    assert_eq!(table.insert(new, "new"), None);
    assert_eq!(table.get(old), None);
    assert_eq!(table.get_mut(old), None);
    assert_eq!(table.remove(old), None);
    assert_eq!(table.remove(new), Some("new"));
}

#[test]
fn only_the_values_of_disposed_objects_are_removed() {
    let mut simulator = simulator(0.0);
    let bodies: Vec<BodyId> = (0..4).map(|_| simulator.create_body(Body::new())).collect();
    let mut table: SecondaryMap<BodyId, usize> = SecondaryMap::new();
    for (at, &body) in bodies.iter().enumerate() {
        table.insert(body, at);
    }
    simulator.dispose(bodies[2]).unwrap();
    simulator.dispose(bodies[0]).unwrap();
    simulator.update(0.01);
    simulator.dispose(bodies[1]).unwrap();
    table.forget_disposed(&simulator);
    assert_eq!(table.iter().collect::<Vec<_>>(), [(bodies[3], &3)]);
}

#[test]
fn a_table_is_the_same_after_it_was_saved_and_loaded() {
    let mut simulator = simulator(0.0);
    let bodies = [(); 3].map(|()| simulator.create_body(Body::new()));
    let mut table = SecondaryMap::new();
    table.insert(bodies[2], "third".to_owned());
    table.insert(bodies[0], "first".to_owned());
    let text = serde_json::to_string(&table).unwrap();
    let loaded: SecondaryMap<BodyId, String> = serde_json::from_str(&text).unwrap();
    assert!(loaded.iter().eq(table.iter()));
}

#[test]
#[should_panic(expected = "nothing is known of Body(BodyId { index: 1, generation: 0 })")]
fn an_index_without_a_value_panics_and_names_the_object() {
    let mut simulator = simulator(0.0);
    let bodies = [(); 2].map(|()| simulator.create_body(Body::new()));
    let mut table = SecondaryMap::new();
    table.insert(bodies[0], 1);
    let _ = table[bodies[1]];
}

#[test]
#[should_panic(expected = "BodyId { index: 0, generation: 0 } is stale: what it named was disposed")]
fn indexing_by_a_stale_id_panics_and_names_it() {
    let mut simulator = simulator(0.0);
    let body = simulator.create_body(Body::new());
    simulator.dispose(body).unwrap();
    simulator.update(0.01);
    simulator[body].set_mass(2.0).ok();
}
