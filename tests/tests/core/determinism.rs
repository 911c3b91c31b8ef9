//! The same calls give the same bits, in one run after the other and after saving and loading in between.

use conformance::fixtures::plane::{
    Game, add_box, add_floor, lively_scene, methods, pairs, simulator_with, state, v,
};
use farseer_core::{Body, Event, GeomFactory, GeomPlacement, Methods, PhysicsSimulator};

const STEPS: usize = 160;

fn run(mut simulator: PhysicsSimulator) -> Vec<Vec<u32>> {
    let mut game = Game::default();
    (0..STEPS)
        .map(|_| {
            game.step(&mut simulator);
            state(&simulator)
        })
        .collect()
}

fn save(simulator: &PhysicsSimulator) -> String {
    serde_json::to_string(simulator).unwrap()
}

fn load(text: &str) -> PhysicsSimulator {
    serde_json::from_str(text).unwrap_or_else(|error| panic!("a saved simulator is refused: {error}"))
}

#[test]
fn a_lively_scene_is_lively() {
    for methods in methods() {
        let mut simulator = lively_scene(methods, 1);
        let mut game = Game::default();
        let (mut most_pairs, mut most_contacts) = (0, 0);
        for _ in 0..STEPS {
            game.step(&mut simulator);
            most_pairs = most_pairs.max(simulator.arbiter_count());
            most_contacts = most_contacts.max(simulator.contact_count());
        }
        // Of 23 pairs in touch at most, 27 points with the precise set: circles and corners have one.
        assert!(most_pairs >= 15 && most_contacts >= 25, "{methods:?}: {most_pairs} {most_contacts}");
    }
}

#[test]
fn a_scene_run_twice_gives_the_same_bits() {
    for methods in methods() {
        for seed in 0..2 {
            assert_eq!(run(lively_scene(methods, seed)), run(lively_scene(methods, seed)), "{methods:?}");
        }
    }
}

#[test]
fn a_copy_goes_on_with_the_same_bits() {
    for methods in methods() {
        let mut simulator = lively_scene(methods, 2);
        let mut game = Game::default();
        for _ in 0..50 {
            game.step(&mut simulator);
        }
        let (mut copy, mut copied_game) = (simulator.clone(), game.clone());
        for _ in 50..STEPS {
            game.step(&mut simulator);
            copied_game.step(&mut copy);
            assert_eq!(state(&simulator), state(&copy), "{methods:?}");
        }
    }
}

/// The rollback of games: to a state of a few steps ago, although objects were added and removed since.
#[test]
fn going_back_by_clone_from_gives_the_same_bits() {
    for methods in methods() {
        let mut plain = lively_scene(methods, 4);
        let (mut kept, mut back) = (plain.clone(), lively_scene(Default::default(), 5));
        let mut game = Game::default();
        let mut kept_game = game.clone();
        for step in 0..STEPS {
            if step % 9 == 4 {
                kept.clone_from(&plain);
                kept_game = game.clone();
            }
            game.step(&mut plain);
            if step % 9 == 8 {
                back.clone_from(&kept);
                let mut back_game = kept_game.clone();
                (0..5).for_each(|_| back_game.step(&mut back));
                assert_eq!(plain.events(), back.events(), "{methods:?} step {step}");
                assert!(plain.snapshot() == back.snapshot(), "{methods:?} step {step}");
            }
        }
    }
}

/// Saved before every step for a while, so also with removals and additions waiting, and right after disposals.
#[test]
fn a_loaded_simulator_goes_on_with_the_same_bits() {
    for methods in methods() {
        let mut simulator = lively_scene(methods, 3);
        let mut game = Game::default();
        let mut branches: Vec<(PhysicsSimulator, Game)> = Vec::new();
        for step in 0..STEPS {
            if step % 7 == 3 && step < 100 {
                branches.push((load(&save(&simulator)), game.clone()));
            }
            game.step(&mut simulator);
            for (loaded, game) in &mut branches {
                game.step(loaded);
                assert_eq!(state(&simulator), state(loaded), "{methods:?} step {step}");
                assert_eq!(simulator.events(), loaded.events(), "{methods:?} step {step}");
            }
        }
    }
}

/// Columns of equal boxes: on each axis many intervals begin and end at the same values, in every update.
fn tied_scene(methods: Methods) -> PhysicsSimulator {
    let mut simulator = simulator_with(100.0, methods);
    add_floor(&mut simulator, (1000.0, 20.0), v(0.0, 100.0));
    for i in 0..30 {
        let (column, row) = ((i % 6) as f32, (i / 6) as f32);
        add_box(&mut simulator, (20.0, 20.0), v(column * 30.0 - 75.0, 80.0 - row * 20.0));
    }
    simulator
}

#[test]
fn a_loaded_simulator_goes_on_with_the_same_bits_where_intervals_tie() {
    for methods in methods() {
        let mut simulator = tied_scene(methods);
        let mut branches: Vec<PhysicsSimulator> = Vec::new();
        for step in 0..60 {
            if step % 10 == 1 {
                branches.push(load(&save(&simulator)));
            }
            if step == 30 {
                let body = simulator.body_list()[9];
                for simulator in branches.iter_mut().chain([&mut simulator]) {
                    simulator.dispose(body).unwrap();
                }
            }
            simulator.update(0.01);
            for loaded in &mut branches {
                loaded.update(0.01);
                assert_eq!(state(&simulator), state(loaded), "{methods:?} step {step}");
            }
        }
    }
}

#[test]
fn a_loaded_simulator_is_saved_as_the_same_text() {
    for methods in methods() {
        let mut simulator = lively_scene(methods, 4);
        let mut game = Game::default();
        for _ in 0..80 {
            game.step(&mut simulator);
        }
        let text = save(&simulator);
        assert_eq!(save(&load(&text)), text, "{methods:?}");
    }
}

#[test]
fn pending_edits_are_saved() {
    for methods in methods() {
        let mut simulator = simulator_with(10.0, methods);
        let (_, a) = add_box(&mut simulator, (10.0, 10.0), v(0.0, 0.0));
        let (b, _) = add_box(&mut simulator, (10.0, 10.0), v(8.0, 1.0));
        simulator.update(0.01);
        add_box(&mut simulator, (10.0, 10.0), v(4.0, 9.0));
        simulator.remove(a).unwrap();
        simulator[b].apply_force(v(5.0, 6.0));
        simulator[b].apply_impulse(v(7.0, 8.0));
        simulator[b].set_position(v(9.0, 2.0));
        let mut loaded = load(&save(&simulator));
        for _ in 0..5 {
            simulator.update(0.01);
            loaded.update(0.01);
            assert_eq!(state(&simulator), state(&loaded));
            assert_eq!(pairs(&simulator), pairs(&loaded));
            assert_eq!(simulator.events(), loaded.events());
        }
    }
}

#[test]
fn pending_events_are_reported_after_loading() {
    let mut simulator = simulator_with(10.0, Default::default());
    let (disposed, _) = add_box(&mut simulator, (10.0, 10.0), v(0.0, 0.0));
    let (body, geom) = add_box(&mut simulator, (10.0, 10.0), v(50.0, 0.0));
    simulator.update(0.01);
    simulator.dispose(disposed).unwrap();
    simulator[body].set_angular_velocity(f32::NAN);
    simulator[geom].set_friction_coefficient(f32::NAN);
    simulator[body].set_position(v(51.0, 0.0));
    // Lets the geoms follow now, so that the movement is reported later.
    let outline = simulator.geom(geom).unwrap().local_vertices().clone();
    simulator.set_vertices(geom, outline).unwrap();
    let mut loaded = load(&save(&simulator));
    simulator.update(0.01);
    loaded.update(0.01);
    let has_moved = Event::BodyUpdated { body };
    let is_notice = |event: &&Event| {
        matches!(event, Event::BodyDisposed { .. } | Event::RejectedInput { .. }) || **event == has_moved
    };
    assert_eq!(
        simulator.events().iter().filter(is_notice).count(),
        5,
        "told of twice: moved, and integrated"
    );
    assert_eq!(loaded.events(), simulator.events());
    assert_eq!(state(&loaded), state(&simulator));
    assert!(loaded.body(disposed).is_none());
}

#[test]
fn a_geom_with_a_matrix_of_its_own_is_saved() {
    use farseer_core::math::Matrix;
    let mut simulator = simulator_with(10.0, Default::default());
    let (_, geom) = add_box(&mut simulator, (10.0, 10.0), v(0.0, 0.0));
    simulator.update(0.01);
    #[rustfmt::skip]
    let sheared = Matrix::new(
        1.0, 0.5, 0.0, 0.0,
        0.0, 2.0, 0.0, 0.0,
        0.0, 0.0, 1.0, 0.0,
        3.0, 4.0, 0.0, 1.0,
    );
    simulator.set_matrix(geom, &sheared).unwrap();
    let loaded = load(&save(&simulator));
    assert_eq!(loaded.geom(geom).unwrap().matrix(), sheared);
    assert_eq!(loaded.geom(geom).unwrap().world_vertices(), simulator.geom(geom).unwrap().world_vertices());
}

#[test]
fn geoms_go_on_sharing_a_grid_after_loading() {
    let mut simulator = simulator_with(10.0, Default::default());
    let (body, geom) = add_box(&mut simulator, (10.0, 10.0), v(0.0, 0.0));
    let copy = simulator.clone_geom(body, geom).unwrap();
    let loaded = load(&save(&simulator));
    let grid = |simulator: &PhysicsSimulator, geom| -> *const farseer_core::DistanceGrid {
        simulator.geom(geom).unwrap().distance_grid().unwrap()
    };
    assert_eq!(grid(&simulator, geom), grid(&simulator, copy));
    assert_eq!(grid(&loaded, geom), grid(&loaded, copy));
}

/// Numbers that a game can reach without any call being refused.
#[test]
fn a_simulator_with_extreme_numbers_is_loaded_again() {
    for methods in methods() {
        let mut simulator = simulator_with(10.0, methods);
        let (a, geom_a) = add_box(&mut simulator, (10.0, 10.0), v(0.0, 0.0));
        let (_, geom_b) = add_box(&mut simulator, (10.0, 10.0), v(8.0, 1.0));
        let far = simulator.create_body(Body::new());
        simulator[far].set_position(v(3.3e38, 0.0));
        let placement = GeomPlacement::with_grid_size(1e36);
        GeomFactory::create_rectangle_geom_in(&mut simulator, far, 1e37, 1e37, placement).unwrap();
        simulator.add(far).unwrap();
        simulator[geom_a].set_friction_coefficient(3e38);
        simulator[geom_b].set_friction_coefficient(3e38);
        simulator[a].set_angular_velocity(1e12);
        simulator[far].set_enabled(false);
        for step in 0..5 {
            simulator.update(0.01);
            let text = save(&simulator);
            let loaded = serde_json::from_str::<PhysicsSimulator>(&text);
            assert!(loaded.is_ok(), "{methods:?} step {step}: {:?}", loaded.err());
        }
    }
}

/// With sweep and prune a geom that is added while another is removed can be paired with the removed one.
#[test]
fn a_simulator_with_a_pair_of_a_disposed_geom_is_loaded_again() {
    for methods in methods() {
        let mut simulator = simulator_with(0.0, methods);
        let (_, removed) = add_box(&mut simulator, (10.0, 10.0), v(0.0, 0.0));
        add_box(&mut simulator, (10.0, 10.0), v(100.0, 0.0));
        simulator.update(0.01);
        simulator.remove(removed).unwrap();
        add_box(&mut simulator, (10.0, 10.0), v(8.0, 1.0));
        simulator.update(0.01);
        simulator.dispose(removed).unwrap();
        simulator.update(0.01);
        let text = save(&simulator);
        assert!(serde_json::from_str::<PhysicsSimulator>(&text).is_ok(), "{methods:?}");
    }
}
