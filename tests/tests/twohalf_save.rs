//! A saved simulator continues with the same bits, and a damaged save is refused.

mod twohalf_common;

use serde_json::{Value, json};
use twohalf::TwoHalfPhysicsSimulator;
use twohalf_common::{DT, busy_scene, run};

#[test]
fn a_loaded_simulator_continues_with_the_same_bits() {
    let (mut simulator, bodies) = busy_scene();
    for steps in [40, 100, 160] {
        run(&mut simulator, steps);
        let text = serde_json::to_string(&simulator).unwrap();
        let mut loaded: TwoHalfPhysicsSimulator = serde_json::from_str(&text).unwrap();
        let mut original = simulator.clone();
        for _ in 0..150 {
            original.update(DT);
            loaded.update(DT);
            for &body in &bodies {
                let [a, b] = [&original, &loaded].map(|simulator| {
                    let view = simulator.body(body).unwrap();
                    let numbers = [view.position3d().x, view.position3d().y, view.position3d().z];
                    (numbers.map(f32::to_bits), view.rotation().to_bits(), view.linear_velocity_z().to_bits())
                });
                assert_eq!(a, b);
            }
        }
        assert_eq!(serde_json::to_string(&original).unwrap(), serde_json::to_string(&loaded).unwrap());
    }
}

#[test]
fn the_busy_scene_has_contacts_of_pairs_and_with_the_ground() {
    let (mut simulator, _) = busy_scene();
    run(&mut simulator, 140);
    let counters = simulator.counters();
    assert!(counters.pairs_touching > 0 && counters.ground_contacts > 0, "{counters:?}");
}

#[test]
fn forces_along_z_that_wait_are_saved() {
    let (mut simulator, bodies) = busy_scene();
    simulator.body_mut(bodies[0]).unwrap().apply_force_z(3.0);
    simulator.body_mut(bodies[0]).unwrap().apply_impulse_z(4.0);
    let text = serde_json::to_string(&simulator).unwrap();
    let mut loaded: TwoHalfPhysicsSimulator = serde_json::from_str(&text).unwrap();
    run(&mut simulator, 1);
    run(&mut loaded, 1);
    let [a, b] = [&simulator, &loaded].map(|s| s.body(bodies[0]).unwrap().linear_velocity_z());
    assert_eq!(a, b);
    assert!(a > 4.0);
}

/// The message with which a save is refused after a change.
fn refusal(change: impl Fn(&mut Value)) -> String {
    let (mut simulator, _) = busy_scene();
    run(&mut simulator, 140);
    let mut saved = serde_json::to_value(&simulator).unwrap();
    change(&mut saved);
    match serde_json::from_value::<TwoHalfPhysicsSimulator>(saved) {
        Ok(_) => String::from("accepted"),
        Err(error) => error.to_string(),
    }
}

#[test]
fn a_save_without_change_is_accepted() {
    assert_eq!(refusal(|_| ()), "accepted");
}

#[test]
fn a_save_with_an_angle_out_of_range_is_refused() {
    let message = refusal(|saved| saved["world"]["projection"]["angle"] = json!(180));
    assert!(message.contains("angle is 180"), "{message}");
}

#[test]
fn a_save_with_an_infinite_z_is_refused() {
    let message = refusal(|saved| saved["world"]["depths"]["bodies"]["entries"][0][1]["z"] = json!(1e300));
    assert!(message.contains("along Z"), "{message}");
}

#[test]
fn a_save_with_a_negative_depth_is_refused() {
    let message = refusal(|saved| {
        saved["world"]["depths"]["profiles"]["entries"][0][1] = json!({ "Prism": { "depth": -1.0 } });
    });
    assert!(message.contains("depth profile"), "{message}");
}

#[test]
fn a_save_whose_entry_lies_in_another_slot_is_refused() {
    let message =
        refusal(|saved| saved["world"]["depths"]["bodies"]["entries"].as_array_mut().unwrap().swap(0, 1));
    assert!(message.contains("damaged"), "{message}");
}

#[test]
fn a_save_in_which_a_body_has_no_depth_is_refused() {
    let message = refusal(|saved| saved["world"]["depths"]["bodies"]["entries"][2] = Value::Null);
    assert!(message.contains("has no depth"), "{message}");
}

#[test]
fn a_save_whose_contact_has_no_points_is_refused() {
    let message = refusal(|saved| saved["world"]["touches"]["touches"][0]["point_count"] = json!(0));
    assert!(message.contains("contacts"), "{message}");
}

#[test]
fn a_save_with_a_damaged_2d_engine_is_refused() {
    let message = refusal(|saved| saved["core"]["body_list"][0] = json!({ "index": 99, "generation": 0 }));
    assert!(message.contains("damaged"), "{message}");
}
