//! Edits, refusals, callbacks, queries, saving and loading.

use conformance::fixtures::plane::{Random, Refuses, faithful_methods};
use farseer_core::{CollisionCategory, Error, Event};

use super::*;

/// A crate that has come to rest on the platform.
fn standing() -> (PhysicsSimulator, GeomId, BodyId, GeomId) {
    let (mut simulator, _, platform) = stage();
    let (body, geom) = add_box(&mut simulator, (20.0, 20.0), v(0.0, -21.0));
    run_for(&mut simulator, 2.0, 60.0);
    assert!(simulator.is_asleep(body));
    (simulator, platform, body, geom)
}

#[test]
fn a_body_on_it_drops_through_while_their_categories_do_not_match() {
    let (mut simulator, platform, body, geom) = standing();
    simulator[platform].set_collision_categories(CollisionCategory::CAT2);
    simulator[platform].set_collides_with(CollisionCategory::NONE);
    run_for(&mut simulator, 0.5, 60.0);
    assert_near(simulator[body].position().y, -20.0, REST, "all categories meet still");
    simulator[geom].set_collision_categories(CollisionCategory::CAT1);
    simulator[geom].set_collides_with(CollisionCategory::CAT1);
    // In a tenth of a second it is 5 px deep, and flies on freely when they meet again.
    run_for(&mut simulator, 0.1, 60.0);
    let (place, speed) = (simulator[body].position(), simulator[body].linear_velocity());
    simulator[geom].set_collides_with(CollisionCategory::ALL);
    let mut alone = empty();
    let (other, _) = add_box(&mut alone, (20.0, 20.0), place);
    alone[other].set_linear_velocity(speed);
    for simulator in [&mut simulator, &mut alone] {
        run_for(simulator, 1.0, 60.0);
    }
    assert!(place.y > -16.0);
    assert_eq!(simulator[body].position(), alone[other].position());
}

#[test]
fn a_refused_body_drops_through_and_a_momentarily_refused_one_stays() {
    let (mut simulator, _, body, _) = standing();
    simulator.update_with(1.0 / 60.0, &mut Refuses::Collisions);
    run_for(&mut simulator, 1.0, 60.0);
    assert_near(simulator[body].position().y, -20.0, REST, "refused in one update");
    for refuses in [Refuses::Collisions, Refuses::Pairs] {
        let (mut simulator, _, body, _) = standing();
        // It wakes in the first one; in the other three it sinks by 900 * 0.05^2 / 2 = 1.1 px.
        (0..4).for_each(|_| simulator.update_with(1.0 / 60.0, &mut refuses.clone()));
        run_for(&mut simulator, 1.0, 60.0);
        assert!(simulator[body].position().y > 300.0, "{refuses:?}");
    }
}

#[test]
fn opening_it_keeps_bodies_on_it_and_closing_it_pushes_out_bodies_in_it() {
    let (mut simulator, platform, body, _) = standing();
    let (inside, _) = add_box(&mut simulator, (20.0, 20.0), v(60.0, -15.0));
    simulator[inside].set_ignore_gravity(true);
    run_for(&mut simulator, 0.5, 60.0);
    assert_eq!(simulator[inside].position(), v(60.0, -15.0));
    for direction in [None, Some(UP), None, Some(UP)] {
        simulator.set_one_way(platform, direction).unwrap();
        run_for(&mut simulator, 0.5, 60.0);
        assert_near(simulator[body].position().y, -20.0, REST, "what stands on it");
        assert!(simulator[inside].position().y < -19.0, "what stood in it");
    }
    simulator.set_one_way(platform, Some(-UP)).unwrap();
    run_for(&mut simulator, 1.0, 60.0);
    assert!(simulator[body].position().y > 300.0, "it holds from below now");
}

#[test]
fn a_body_placed_in_it_passes_and_one_placed_on_it_stands() {
    for rate in RATES {
        for (y, passes) in [(-20.0, false), (-19.5, false), (-19.0, true), (-10.0, true), (0.0, true)] {
            let (mut simulator, _, _) = stage();
            let (body, _) = add_box(&mut simulator, (20.0, 20.0), v(0.0, -300.0));
            run_for(&mut simulator, 0.2, rate);
            simulator[body].set_position(v(0.0, y));
            simulator[body].set_linear_velocity(v(0.0, 0.0));
            run_for(&mut simulator, 1.0, rate);
            assert_eq!(simulator[body].position().y > 300.0, passes, "put at {y}, {rate} Hz");
        }
    }
}

#[test]
fn a_body_asleep_in_it_does_not_touch_it_and_rests_on_its_support() {
    let (mut simulator, _, platform) = stage();
    add_floor(&mut simulator, (400.0, 20.0), v(0.0, 15.0));
    let (body, _) = add_box(&mut simulator, (20.0, 20.0), v(0.0, -5.0));
    run_for(&mut simulator, 2.0, 60.0);
    assert!(simulator.is_asleep(body));
    assert_near(simulator[body].position().y, -5.0, REST, "what sleeps on the floor");
    assert_eq!(simulator.arbiter_count(), 1, "it touches the floor alone");
    // The floor is removed, and the platform is closed: each wakes it.
    simulator.set_one_way(platform, None).unwrap();
    run_for(&mut simulator, 1.0, 60.0);
    assert_near(simulator[body].position().y, -20.0, REST, "what was pushed out");
}

#[test]
fn passing_has_no_events_and_landing_has_events_for_both_sides() {
    let (mut simulator, _, platform) = stage();
    let (body, geom) = add_box(&mut simulator, (20.0, 20.0), v(0.0, 40.0));
    simulator[body].set_linear_velocity(v(0.0, -450.0));
    let mut told = Vec::new();
    for step in 0..120 {
        simulator.update(1.0 / 60.0);
        let touches = simulator.events().iter().filter_map(|event| match *event {
            Event::Collision { this, other, .. } => Some((true, this, other)),
            Event::Separation { this, other } => Some((false, this, other)),
            _ => None,
        });
        told.extend(touches.map(|touch| (step, touch)));
    }
    let [(one, first), (other, second)] = told[..] else { panic!("{told:?}") };
    assert_eq!((first, second), ((true, platform, geom), (true, geom, platform)));
    // It is above the top by 450^2 / 1800 - 60 = 52 px, and lands after 0.5 s + (2 * 52 / 900)^0.5 s.
    assert!(one == other && (49..=51).contains(&one), "step {one}");
}

#[test]
fn a_sensor_reports_one_way_geoms_and_a_one_way_sensor_reports_bodies_from_all_sides() {
    for is_platform in [true, false] {
        let (mut simulator, _, platform) = stage();
        let (body, geom) = add_box(&mut simulator, (20.0, 20.0), v(0.0, 40.0));
        let sensor = if is_platform { platform } else { geom };
        simulator[sensor].set_collision_response_enabled(false);
        simulator[body].set_linear_velocity(v(0.0, -450.0));
        let mut changes = Vec::new();
        for _ in 0..120 {
            simulator.update(1.0 / 60.0);
            changes.extend(simulator.events().iter().filter_map(|event| match *event {
                Event::Collision { this, .. } if this == sensor => Some(true),
                Event::Separation { this, .. } if this == sensor => Some(false),
                _ => None,
            }));
        }
        assert_eq!(changes, [true, false, true, false]);
    }
}

#[test]
fn rays_points_and_boxes_meet_it_from_all_sides() {
    let (mut simulator, _, platform) = stage();
    simulator.update(1.0 / 60.0);
    for from in [v(0.0, -100.0), v(0.0, 100.0), v(-300.0, 0.0), v(300.0, 5.0)] {
        let hit = simulator.ray_cast(from, v(0.0, 0.0)).unwrap();
        assert_eq!(hit.geom, platform);
    }
    assert_eq!(simulator.collide(v(0.0, 0.0)), Some(platform));
}

#[test]
fn the_faithful_set_has_no_one_way_geoms() {
    for methods in faithful_methods() {
        let mut simulator = simulator_with(GRAVITY, methods);
        let (_, geom) = add_floor(&mut simulator, (200.0, 20.0), v(0.0, 0.0));
        let reason = simulator.set_one_way(geom, Some(UP)).unwrap_err().to_string();
        assert!(reason.contains("one-way geoms") && reason.contains("faithful"), "{reason}");
        assert_eq!(simulator.geom(geom).unwrap().one_way(), None);
        simulator.set_one_way(geom, None).unwrap();
    }
    let (mut simulator, body, geom) = stage();
    let refused = Error::NotSupported { what: "one-way geoms", methods: "faithful" };
    let faithful = Methods::default();
    assert_eq!(simulator.set_methods(faithful), Err(refused.clone()));
    simulator.remove(geom).unwrap();
    simulator.update(1.0 / 60.0);
    simulator.set_methods(faithful).unwrap();
    assert_eq!(simulator.add(geom), Err(refused.clone()));
    assert_eq!(simulator.clone_geom(body, geom), Err(Error::MissingDistanceGrid { argument: "geom" }));
    simulator.create_distance_grid(geom).unwrap();
    assert_eq!(simulator.clone_geom(body, geom), Err(refused));
    simulator.set_one_way(geom, None).unwrap();
    simulator.add(geom).unwrap();
}

#[test]
fn a_direction_is_normalised_and_must_not_be_zero() {
    let (mut simulator, body, geom) = stage();
    for scale in [1e-30, 1e-3, 7.0, 1e30] {
        simulator.set_one_way(geom, Some(v(3.0, -4.0) * scale)).unwrap();
        let direction = simulator.geom(geom).unwrap().one_way().unwrap();
        assert!((direction - v(0.6, -0.8)).norm() < 1e-7, "{direction}");
    }
    simulator.set_one_way(geom, Some(v(3.0, -4.0))).unwrap();
    for refused in [v(0.0, 0.0), v(f32::NAN, 1.0), v(0.0, f32::INFINITY)] {
        assert!(matches!(
            simulator.set_one_way(geom, Some(refused)),
            Err(Error::InvalidArgument { argument: "direction", .. })
        ));
        assert_eq!(simulator.geom(geom).unwrap().one_way(), Some(v(0.6, -0.8)));
    }
    let copy = simulator.clone_geom(body, geom).unwrap();
    assert_eq!(simulator.geom(copy).unwrap().one_way(), Some(v(0.6, -0.8)));
    simulator.dispose(geom).unwrap();
    simulator.update(1.0 / 60.0);
    assert_eq!(simulator.set_one_way(geom, None), Err(Error::StaleId { argument: "geom" }));
}

/// Bodies that are thrown at one-way geoms of all kinds, some of which move.
fn lively() -> PhysicsSimulator {
    let (mut simulator, _, _) = stage();
    let (lift, of_lift) = add_box(&mut simulator, (120.0, 12.0), v(-180.0, 20.0));
    simulator[lift].set_is_kinematic(true);
    simulator[lift].set_angular_velocity(0.7);
    let (raft, of_raft) = add_box(&mut simulator, (100.0, 10.0), v(180.0, -60.0));
    simulator[raft].set_ignore_gravity(true);
    simulator[raft].set_mass(20.0).unwrap();
    for geom in [of_lift, of_raft] {
        simulator.set_one_way(geom, Some(UP)).unwrap();
    }
    add_floor(&mut simulator, (800.0, 20.0), v(0.0, 160.0));
    for number in 0..15 {
        let (_, add, _) = THINGS[number % THINGS.len()];
        let (_, geom) =
            add(&mut simulator, v(number as f32 * 35.0 - 240.0, 100.0 - 20.0 * (number % 3) as f32));
        simulator[geom].set_restitution_coefficient(0.3);
    }
    simulator
}

/// Steps, throws a body, and now and then edits a direction or moves a geom.
fn play(simulator: &mut PhysicsSimulator, random: &mut Random, step: usize) {
    let bodies = simulator.body_list().to_vec();
    if bodies.len() > 4 {
        let thrown = bodies[4 + random.below(bodies.len() - 4)];
        simulator[thrown]
            .set_linear_velocity(v(random.between(-200.0, 200.0), random.between(-700.0, 100.0)));
        if step % 17 == 16 {
            simulator[thrown].set_position(v(random.between(-200.0, 200.0), random.between(-60.0, 60.0)));
        }
    }
    let geoms = simulator.geom_list().to_vec();
    if step % 23 == 22 {
        let direction = random.pick(&[None, Some(UP), Some(v(1.0, 0.0)), Some(v(0.3, 1.0))]);
        simulator.set_one_way(random.pick(&geoms[..geoms.len().min(6)]), direction).unwrap();
    }
    if step % 41 == 40 {
        let changed = random.pick(&geoms);
        let responds = simulator[changed].collision_response_enabled();
        simulator[changed].set_collision_response_enabled(!responds);
    }
    if step % 31 == 30 {
        add_box(simulator, (14.0, 14.0), v(random.between(-200.0, 200.0), -30.0));
    }
    if step % 61 == 60 && bodies.len() > 10 {
        simulator.dispose(bodies[random.below(bodies.len())]).unwrap();
    }
    simulator.update(1.0 / 60.0);
}

#[test]
fn loaded_or_cloned_in_any_step_it_goes_on_with_the_same_bits_and_events() {
    for seed in [1, 16, 29] {
        let (mut plain, mut loaded, mut cloned) = (lively(), lively(), lively());
        let mut randoms = [0; 3].map(|_| Random::new(seed));
        for step in 0..600 {
            for (simulator, random) in [&mut plain, &mut loaded, &mut cloned].into_iter().zip(&mut randoms) {
                play(simulator, random, step);
            }
            assert_eq!(plain.events(), loaded.events(), "seed {seed}, step {step}");
            assert!(plain.snapshot() == loaded.snapshot(), "seed {seed}, step {step}");
            assert!(plain.snapshot() == cloned.snapshot(), "seed {seed}, step {step}");
            let mut next = simulator_with(1.0, Methods::default());
            next.restore(&loaded.snapshot()).unwrap();
            (loaded, cloned) = (next, cloned.clone());
        }
    }
}
