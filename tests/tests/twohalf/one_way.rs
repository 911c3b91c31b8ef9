//! Platforms that are open from below and from their sides, at 30 to 240 steps per second. Gravity 900 px/s².

use conformance::fixtures::depth::{
    assert_near, assert_near3, ball, place, platform, set_surface, solid, throw, velocity, with_scheme,
};
use twohalf::{
    BodyId, CharacterController, CharacterSettings, DepthScheme, MoveInput, Platform, PlatformId,
    TwoHalfPhysicsSimulator, Vector2, Vector3,
};

const RATES: [f32; 4] = [30.0, 60.0, 120.0, 240.0];
const GRAVITY: f32 = 900.0;
/// Heights of the platform's underside and of its top in px.
const UNDER: f32 = 100.0;
const TOP: f32 = 120.0;
/// Greatest penetration of a resting body in its support, px.
const REST: f32 = 0.05;

fn stage() -> (TwoHalfPhysicsSimulator, PlatformId) {
    let mut simulator = TwoHalfPhysicsSimulator::with_gravity(600, Vector2::new(0.0, GRAVITY)).unwrap();
    let made = platform(&mut simulator, [200.0, TOP - UNDER, 200.0], [0.0, UNDER, 0.0]);
    simulator.platform_mut(made).unwrap().set_one_way(true).unwrap();
    (simulator, made)
}

fn crate_box(simulator: &mut TwoHalfPhysicsSimulator, at: [f32; 3]) -> BodyId {
    let body = solid(simulator, [20.0, 20.0, 20.0], at);
    set_surface(simulator, body, 0.5, 0.0);
    body
}

fn run_for(simulator: &mut TwoHalfPhysicsSimulator, seconds: f32, rate: f32) {
    (0..(seconds * rate).round() as usize).for_each(|_| simulator.update(1.0 / rate));
}

/// Asserts that a body moves as without any obstacle.
fn assert_flies_free(at: [f32; 3], velocity_of: [f32; 3], seconds: f32) {
    for rate in RATES {
        let fly = |is_there: bool| {
            let (mut simulator, made) = stage();
            simulator.platform_mut(made).unwrap().set_collision_response_enabled(is_there);
            let body = crate_box(&mut simulator, at);
            throw(&mut simulator, body, velocity_of);
            run_for(&mut simulator, seconds, rate);
            (place(&simulator, body), velocity(&simulator, body))
        };
        assert_eq!(fly(true), fly(false), "{rate} Hz");
    }
}

#[test]
fn a_falling_body_lands_on_the_top_from_any_height() {
    for (rate, height) in
        RATES.into_iter().flat_map(|rate| [0.0, 1.0, 30.0, 300.0, 3000.0].map(|it| (rate, it)))
    {
        let (mut simulator, _) = stage();
        let boxed = crate_box(&mut simulator, [-50.0, TOP + height, 0.0]);
        let round = ball(&mut simulator, 10.0, [50.0, TOP + height, 0.0]);
        run_for(&mut simulator, 4.0, rate);
        for body in [boxed, round] {
            assert_near(place(&simulator, body).y, TOP, REST);
        }
    }
}

#[test]
fn a_body_faster_than_one_platform_thickness_per_step_lands_on_it() {
    for rate in RATES {
        let (mut simulator, _) = stage();
        let body = crate_box(&mut simulator, [0.0, 400.0, 0.0]);
        throw(&mut simulator, body, [0.0, -20_000.0, 0.0]);
        run_for(&mut simulator, 2.0, rate);
        assert_near(place(&simulator, body).y, TOP, REST);
    }
}

#[test]
fn a_body_that_rises_from_below_flies_through_undisturbed() {
    // By 450^2 / 1800 = 112 px it rises above the top, and is still above at the time of the test.
    assert_flies_free([0.0, 20.0, 0.0], [0.0, 450.0, 0.0], 0.5);
    // At this speed a closed platform would stop it.
    assert_flies_free([0.0, 20.0, 0.0], [0.0, 20_000.0, 0.0], 0.5);
}

#[test]
fn a_body_that_has_risen_through_it_lands_on_it() {
    for rate in RATES {
        let (mut simulator, _) = stage();
        let boxed = crate_box(&mut simulator, [-50.0, 20.0, 0.0]);
        let round = ball(&mut simulator, 10.0, [50.0, 20.0, 0.0]);
        for body in [boxed, round] {
            throw(&mut simulator, body, [0.0, 500.0, 0.0]);
        }
        run_for(&mut simulator, 3.0, rate);
        for body in [boxed, round] {
            assert_near(place(&simulator, body).y, TOP, REST);
        }
    }
}

#[test]
fn a_body_that_turns_back_below_the_top_falls_undisturbed() {
    // Its highest points are 2, 10, 19 and 99 px above 100, the last with its soles 1 px below the top.
    for speed in [0.5, 4.3, 10.0, 14.0f32].map(|rise: f32| (2.0 * GRAVITY * (UNDER - 20.0 + rise)).sqrt()) {
        assert_flies_free([0.0, 20.0, 0.0], [0.0, speed, 0.0], 0.7);
    }
}

#[test]
fn a_body_from_its_sides_front_or_back_passes_through() {
    for way in [[300.0, 0.0, 0.0], [-300.0, 0.0, 0.0], [0.0, 0.0, 300.0], [200.0, 0.0, -200.0]] {
        // Its soles rise to 5.5 px below the top, from outside to inside.
        let at = [-0.45 * way[0], 109.0, -0.45 * way[2]];
        assert_flies_free(at, [way[0], 100.0, way[2]], 0.4);
    }
}

#[test]
fn a_tilted_one_is_open_from_below_and_closed_from_above() {
    for rate in RATES {
        let mut simulator = TwoHalfPhysicsSimulator::with_gravity(600, Vector2::new(0.0, GRAVITY)).unwrap();
        let at = Vector3::new(0.0, UNDER, 0.0);
        let made = Platform::with_rotation(&mut simulator, 400.0, 20.0, 200.0, at, 0.3, None).unwrap();
        simulator.platform_mut(made).unwrap().set_one_way(true).unwrap();
        let body = ball(&mut simulator, 10.0, [0.0, 20.0, 0.0]);
        throw(&mut simulator, body, [0.0, 550.0, 0.0]);
        // Up for 0.61 s to 188 px, and down again to the top, at about 120 px, by 1 s.
        run_for(&mut simulator, 1.3, rate);
        // The top is 10 px from the middle of the platform, and so is the middle of the ball from the top.
        let (sin, cos) = 0.3f32.sin_cos();
        let middle = place(&simulator, body) + Vector3::new(0.0, 10.0 - 110.0, 0.0);
        assert_near(middle.x * sin + middle.y * cos, 20.0, 0.1);
    }
}

#[test]
fn a_lift_carries_bodies_on_it_and_rises_through_bodies_above_it() {
    for rate in RATES {
        let (mut simulator, made) = stage();
        let rider = crate_box(&mut simulator, [0.0, TOP, 0.0]);
        run_for(&mut simulator, 0.2, rate);
        simulator.platform_mut(made).unwrap().set_velocity(Vector3::new(0.0, 60.0, 0.0)).unwrap();
        run_for(&mut simulator, 1.0, rate);
        assert_near(place(&simulator, rider).y, TOP + 60.0, 0.2);
        simulator.platform_mut(made).unwrap().set_velocity(Vector3::new(0.0, -60.0, 0.0)).unwrap();
        run_for(&mut simulator, 1.0, rate);
        assert_near(place(&simulator, rider).y, TOP, 0.2);
    }
}

#[test]
fn a_sinking_platform_passes_through_bodies_below_it() {
    for rate in RATES {
        let (mut simulator, made) = stage();
        let below = crate_box(&mut simulator, [0.0, 0.0, 0.0]);
        run_for(&mut simulator, 0.2, rate);
        let before = place(&simulator, below);
        simulator.platform_mut(made).unwrap().set_velocity(Vector3::new(0.0, -60.0, 0.0)).unwrap();
        run_for(&mut simulator, 3.0, rate);
        assert_near3(place(&simulator, below), before.into(), REST);
    }
}

#[test]
fn a_figure_jumps_up_through_it_and_stands_on_it() {
    for rate in RATES {
        let (mut simulator, _) = stage();
        let figure = solid(&mut simulator, [30.0, 60.0, 20.0], [0.0; 3]);
        let mut view = simulator.body_mut(figure).unwrap();
        view.core_mut().set_moment_of_inertia(1e20).unwrap();
        let mut walker = CharacterController::new(CharacterSettings {
            jump_height: 140.0,
            ..CharacterSettings::default()
        });
        let mut step = |simulator: &mut TwoHalfPhysicsSimulator, jump: bool| {
            simulator.walk(figure, &mut walker, MoveInput { x: 0.0, z: 0.0, jump }, 1.0 / rate).unwrap();
            simulator.update(1.0 / rate);
            walker.is_grounded()
        };
        (0..10).for_each(|_| _ = step(&mut simulator, false));
        step(&mut simulator, true);
        let mut highest = 0.0f32;
        for _ in 0..(2.0 * rate) as usize {
            step(&mut simulator, false);
            highest = highest.max(place(&simulator, figure).y);
        }
        // As exact as jumps without an obstacle.
        assert_near(highest, 140.0, 0.03 * 140.0);
        assert!(step(&mut simulator, false));
        assert_near(place(&simulator, figure).y, TOP, 0.2);
    }
}

#[test]
fn a_figure_walks_through_it_without_resistance() {
    for rate in RATES {
        let walk = |is_there: bool| {
            let mut simulator =
                TwoHalfPhysicsSimulator::with_gravity(600, Vector2::new(0.0, GRAVITY)).unwrap();
            let made = platform(&mut simulator, [20.0, 20.0, 200.0], [100.0, 10.0, 0.0]);
            let mut view = simulator.platform_mut(made).unwrap();
            view.set_one_way(true).unwrap();
            view.set_collision_response_enabled(is_there);
            let figure = solid(&mut simulator, [30.0, 60.0, 20.0], [0.0; 3]);
            simulator.body_mut(figure).unwrap().core_mut().set_moment_of_inertia(1e20).unwrap();
            let mut walker = CharacterController::new(CharacterSettings::default());
            for _ in 0..rate as usize {
                let wish = MoveInput { x: 200.0, z: 0.0, jump: false };
                simulator.walk(figure, &mut walker, wish, 1.0 / rate).unwrap();
                simulator.update(1.0 / rate);
            }
            place(&simulator, figure)
        };
        assert_eq!(walk(true), walk(false), "{rate} Hz");
        assert!(walk(true).x > 130.0);
    }
}

#[test]
fn a_body_on_it_drops_through_while_collisions_with_it_are_off() {
    let (mut simulator, _) = stage();
    let body = crate_box(&mut simulator, [0.0, TOP, 0.0]);
    run_for(&mut simulator, 0.5, 60.0);
    let geom = simulator.body(body).unwrap().ground().object_geom().unwrap();
    simulator.geom_mut(geom).unwrap().set_collision_enabled(false);
    run_for(&mut simulator, 0.1, 60.0);
    simulator.geom_mut(geom).unwrap().set_collision_enabled(true);
    run_for(&mut simulator, 1.0, 60.0);
    assert_near(place(&simulator, body).y, 0.0, REST);
}

#[test]
fn when_closed_it_pushes_out_bodies_inside_and_when_opened_it_keeps_bodies_on_it() {
    let (mut simulator, made) = stage();
    let body = crate_box(&mut simulator, [0.0, TOP, 0.0]);
    for is_one_way in [false, true, false, true] {
        simulator.platform_mut(made).unwrap().set_one_way(is_one_way).unwrap();
        run_for(&mut simulator, 0.5, 60.0);
        assert_near(place(&simulator, body).y, TOP, REST);
    }
}

#[test]
fn saved_and_loaded_amid_a_jump_it_goes_on_with_the_same_bits() {
    let (mut simulator, made) = stage();
    let body = crate_box(&mut simulator, [0.0, 20.0, 0.0]);
    throw(&mut simulator, body, [30.0, 500.0, 10.0]);
    for _ in 0..60 {
        simulator.update(1.0 / 60.0);
        let (mut loaded, _) = stage();
        loaded.restore(&simulator.snapshot()).unwrap();
        assert!(loaded.platform(made).unwrap().is_one_way());
        let mut goes_on = simulator.clone();
        for simulator in [&mut loaded, &mut goes_on] {
            run_for(simulator, 1.0, 60.0);
        }
        assert_eq!(place(&loaded, body), place(&goes_on, body));
    }
}

#[test]
fn the_other_schemes_have_none() {
    for scheme in [DepthScheme::Faithful, DepthScheme::Thesis] {
        with_scheme(scheme, || {
            let mut simulator = conformance::fixtures::depth::simulator();
            let made = platform(&mut simulator, [200.0, 20.0, 200.0], [0.0, 100.0, 0.0]);
            let refused = simulator.platform_mut(made).unwrap().set_one_way(true);
            let reason = refused.unwrap_err().to_string();
            assert!(reason.contains("one-way platforms"), "{reason}");
            assert!(!simulator.platform(made).unwrap().is_one_way());
        });
    }
}
