//! Calls of handlers, their order, and the matching events.

use conformance::fixtures::plane::{
    Game, add_box, both_sets, faithful_methods, lively_scene, methods, simulator, simulator_with, state, v,
};
use farseer_core::{BodyId, Event, ObjectId, PhysicsSimulator};

use super::{Log, collision, told};

/// The precise set calls handlers in every update, and has events for begins and ends.
#[test]
fn events_equal_the_calls_of_a_handler() {
    for methods in faithful_methods() {
        for (refuses_collisions, asks_broad_phase, refuses_pairs) in
            [(false, false, false), (true, false, false), (false, true, false), (false, true, true)]
        {
            let mut simulator = lively_scene(methods, 6);
            let mut log = Log { refuses_collisions, asks_broad_phase, refuses_pairs, ..Log::default() };
            for step in 0..80 {
                if step % 20 == 10 {
                    let (body, geom) = (simulator.body_list()[6], simulator.geom_list()[9]);
                    simulator[body].set_position(v(0.0, -100.0));
                    simulator.remove(geom).unwrap();
                    let body = simulator.body_list()[7];
                    simulator.dispose(body).unwrap();
                }
                let told = told(&mut simulator, &mut log);
                assert_eq!(simulator.events(), told, "{methods:?} step {step}");
            }
        }
    }
}

#[test]
fn a_handler_without_edits_changes_no_bit() {
    for methods in methods() {
        let (mut plain, mut watched) = (lively_scene(methods, 7), lively_scene(methods, 7));
        let mut log = Log::default();
        for _ in 0..80 {
            plain.update(0.01);
            watched.update_with(0.01, &mut log);
            assert_eq!(state(&plain), state(&watched), "{methods:?}");
            assert_eq!(plain.events(), watched.events(), "{methods:?}");
        }
    }
}

/// Behaviour chapter 03, check 2.
#[test]
fn boxes_that_overlap_without_contact_separate_in_every_update() {
    let mut simulator = simulator(0.0);
    let (_, a) = add_box(&mut simulator, (10.0, 10.0), v(0.0, 0.0));
    let (body, b) = add_box(&mut simulator, (10.0, 10.0), v(11.0, 11.0));
    simulator[body].set_rotation(std::f32::consts::FRAC_PI_4);
    let mut log = Log::default();
    simulator.process_added_and_removed();
    for _ in 0..3 {
        let expected = [Event::Separation { this: a, other: b }, Event::Separation { this: b, other: a }];
        assert_eq!(told(&mut simulator, &mut log), expected);
        assert_eq!(simulator.arbiter_count(), 0);
    }
}

/// Behaviour chapter 03, check 3.
#[test]
fn both_sides_of_a_collision_get_callbacks_in_every_update() {
    let mut simulator = simulator(0.0);
    let (_, a) = add_box(&mut simulator, (10.0, 10.0), v(0.0, 0.0));
    let (_, b) = add_box(&mut simulator, (10.0, 10.0), v(9.0, 0.0));
    simulator.process_added_and_removed();
    let mut log = Log::default();
    for _ in 0..12 {
        let collisions: Vec<Event> = told(&mut simulator, &mut log)
            .into_iter()
            .filter(|event| !matches!(event, Event::BodyUpdated { .. }))
            .collect();
        assert_eq!(collisions, [collision(a, b, 4, false), collision(b, a, 4, false)]);
    }
}

/// Behaviour chapter 04, check 1 and 4, as far as bodies and geoms go.
#[test]
fn geoms_enter_before_bodies_and_leave_before_bodies() {
    for methods in both_sets() {
        let mut simulator = simulator_with(0.0, methods);
        let (body, geom) = add_box(&mut simulator, (10.0, 10.0), v(0.0, 0.0));
        let mut log = Log::default();
        let added = |object: ObjectId| Event::Added { object };
        assert_eq!(told(&mut simulator, &mut log)[1..], [added(geom.into()), added(body.into())]);
        simulator.dispose(body).unwrap();
        let removed = |object: ObjectId| Event::Removed { object };
        let expected = [Event::BodyDisposed { body }, removed(geom.into()), removed(body.into())];
        assert_eq!(told(&mut simulator, &mut log), expected);
    }
}

/// Behaviour chapter 04, check 3.
#[test]
fn objects_removed_and_added_again_end_up_removed() {
    for methods in both_sets() {
        let mut simulator = simulator_with(0.0, methods);
        let (_, geom) = add_box(&mut simulator, (10.0, 10.0), v(0.0, 0.0));
        simulator.process_added_and_removed();
        simulator.remove(geom).unwrap();
        simulator.add(geom).unwrap();
        simulator.update(0.0);
        assert_eq!(simulator.events(), [Event::Removed { object: geom.into() }]);
        assert!(simulator.geom_list().is_empty() && !simulator.geom(geom).unwrap().in_simulation());
        simulator.remove(geom).unwrap();
        simulator.remove(geom).unwrap();
        simulator.update(0.0);
        assert_eq!(simulator.events(), [Event::Removed { object: geom.into() }; 2]);
        simulator.add(geom).unwrap();
        simulator.add(geom).unwrap();
        simulator.update(0.0);
        assert_eq!(simulator.geom_list(), [geom]);
    }
}

#[test]
fn edited_bodies_are_reported_in_the_order_of_their_edits() {
    for methods in both_sets() {
        let mut simulator = simulator_with(0.0, methods);
        let bodies: Vec<BodyId> =
            (0..3).map(|i| add_box(&mut simulator, (10.0, 10.0), v(i as f32 * 50.0, 0.0)).0).collect();
        simulator.update(0.01);
        for &body in &bodies {
            simulator[body].set_position(v(0.0, 100.0));
        }
        simulator.update(0.0);
        let expected: Vec<Event> = bodies.iter().map(|&body| Event::BodyUpdated { body }).collect();
        assert_eq!(simulator.events(), expected);
    }
}

/// Behaviour chapter 02, check 10. The precise set reports the bodies that have moved, and no others.
#[test]
fn bodies_are_reported_from_their_first_movement_on() {
    let mut simulator = simulator(0.0);
    let (body, _) = add_box(&mut simulator, (10.0, 10.0), v(0.0, 0.0));
    simulator.update(0.01);
    let count = |simulator: &PhysicsSimulator| {
        simulator.events().iter().filter(|&&event| event == Event::BodyUpdated { body }).count()
    };
    let mut told = 0;
    let mut step = |simulator: &mut PhysicsSimulator| {
        simulator.update(0.01);
        told += count(simulator);
        told
    };
    assert_eq!([step(&mut simulator), step(&mut simulator)], [0, 0]);
    simulator[body].set_linear_velocity(v(1.0, 0.0));
    assert_eq!(step(&mut simulator), 1);
    simulator[body].set_linear_velocity(v(0.0, 0.0));
    assert_eq!([step(&mut simulator), step(&mut simulator)], [2, 3]);
    simulator[body].reset_dynamics();
    // Once for the reset, which the original reports at once, and once for the update.
    assert_eq!(step(&mut simulator), 5);
}

/// Behaviour chapter 02, check 13.
#[test]
fn a_body_disposed_twice_is_reported_twice() {
    for methods in both_sets() {
        let mut simulator = simulator_with(0.0, methods);
        let (body, _) = add_box(&mut simulator, (10.0, 10.0), v(0.0, 0.0));
        simulator.update(0.01);
        simulator.dispose(body).unwrap();
        simulator.dispose(body).unwrap();
        simulator.update(0.01);
        let told = simulator.events().iter().filter(|&&event| event == Event::BodyDisposed { body }).count();
        assert_eq!(told, 2);
    }
}

#[test]
fn events_of_the_last_update_are_gone_after_the_next() {
    for methods in both_sets() {
        let mut simulator = lively_scene(methods, 9);
        let mut game = Game::default();
        for _ in 0..50 {
            game.step(&mut simulator);
        }
        assert!(!simulator.events().is_empty());
        simulator.set_enabled(false);
        simulator.update(0.01);
        assert_eq!(simulator.events(), []);
    }
}
