//! Checks of behaviour chapter 04: the simulator. Callbacks are checked with the handlers, the dropped box with
//! chapter 03; those on controllers, joints and springs come with these.

use conformance::fixtures::plane::{self, add_box, add_floor, pairs, simulator, simulator_with, v};
use conformance::units::assert_words;
use farseer_core::{
    Body, BroadPhaseCollider, CollisionCategory, Error, Event, FrictionType, GeomPlacement, Methods,
    NarrowPhaseCollider, PhysicsSimulator, Vertices,
};

#[test]
fn a_new_simulator_has_the_original_settings() {
    let simulator = PhysicsSimulator::default();
    assert_eq!(simulator.gravity(), v(0.0, 0.0));
    assert!(simulator.enabled());
    assert_eq!((simulator.iterations(), simulator.max_contacts_to_detect()), (5, 10));
    assert_eq!((simulator.max_contacts_to_resolve(), simulator.friction_type()), (4, FrictionType::Average));
    assert_eq!((simulator.bias_factor(), simulator.allowed_penetration()), (0.8, 0.05));
    assert_eq!(simulator.broad_phase_collider(), BroadPhaseCollider::SelectiveSweep);
    assert_eq!(simulator.narrow_phase_collider(), NarrowPhaseCollider::DistanceGrid);
}

/// Check 2, as far as bodies and geoms go.
#[test]
fn a_paused_simulator_adds_and_removes_objects() {
    let pauses: [fn(&mut PhysicsSimulator); 3] = [
        |simulator| simulator.update(0.0),
        |simulator| {
            simulator.set_enabled(false);
            simulator.update(0.5);
        },
        PhysicsSimulator::process_added_and_removed,
    ];
    for pause in pauses {
        let mut simulator = simulator(100.0);
        let (body, geom) = add_box(&mut simulator, (10.0, 10.0), v(0.0, 0.0));
        pause(&mut simulator);
        assert_eq!((simulator.body_list(), simulator.geom_list()), (&[body][..], &[geom][..]));
        assert_eq!(
            (simulator[body].position(), simulator[body].linear_velocity()),
            (v(0.0, 0.0), v(0.0, 0.0))
        );
        simulator.remove(body).unwrap();
        simulator.dispose(geom).unwrap();
        pause(&mut simulator);
        assert!(simulator.body_list().is_empty() && simulator.geom_list().is_empty());
        assert!(simulator.body(body).is_some() && simulator.geom(geom).is_none());
    }
}

/// Check 4: disposing does not take a geom out of the simulation by itself.
#[test]
fn a_disposed_geom_is_still_in_the_simulation_until_the_next_update() {
    let mut simulator = simulator(0.0);
    let (body, geom) = add_box(&mut simulator, (10.0, 10.0), v(0.0, 0.0));
    simulator.process_added_and_removed();
    simulator.dispose(body).unwrap();
    let disposed = simulator.geom(geom).unwrap();
    assert!(disposed.is_disposed() && disposed.in_simulation());
}

/// Check 6.
#[test]
fn the_broad_phase_is_chosen_before_geoms_enter() {
    let mut simulator = simulator(0.0);
    let (_, geom) = add_box(&mut simulator, (10.0, 10.0), v(0.0, 0.0));
    assert_eq!(simulator.set_broad_phase_collider(BroadPhaseCollider::BruteForce), Ok(()));
    simulator.process_added_and_removed();
    let refused = simulator.set_broad_phase_collider(BroadPhaseCollider::SweepAndPrune);
    assert_eq!(refused, Err(Error::GeomListNotEmpty));
    assert_eq!(simulator.broad_phase_collider(), BroadPhaseCollider::BruteForce);
    simulator.remove(geom).unwrap();
    simulator.process_added_and_removed();
    assert_eq!(simulator.set_broad_phase_collider(BroadPhaseCollider::SweepAndPrune), Ok(()));
}

#[test]
fn methods_reflect_the_broad_and_narrow_phase() {
    for methods in plane::faithful_methods() {
        let Methods::Faithful { broad, narrow } = methods else { unreachable!() };
        let (mut at_once, mut one_by_one) = (simulator(0.0), simulator(0.0));
        at_once.set_methods(methods).unwrap();
        one_by_one.set_broad_phase_collider(broad).unwrap();
        one_by_one.set_narrow_phase_collider(narrow);
        for simulator in [at_once, one_by_one] {
            assert_eq!(simulator.methods(), methods);
            assert_eq!(simulator.broad_phase_collider(), broad);
            assert_eq!(simulator.narrow_phase_collider(), narrow);
        }
    }
}

#[test]
fn refused_methods_change_no_state() {
    let narrow = NarrowPhaseCollider::Sat;
    let broad = BroadPhaseCollider::SpatialHash { cell_size: f32::NAN, auto_adjust_cell_size: true };
    let mut empty = simulator(0.0);
    assert!(matches!(
        empty.set_methods(Methods::Faithful { broad, narrow }),
        Err(Error::InvalidArgument { argument: "cell_size", .. })
    ));
    assert_eq!(empty.methods(), Methods::default());

    let mut simulator = simulator(0.0);
    add_box(&mut simulator, (10.0, 10.0), v(0.0, 0.0));
    simulator.process_added_and_removed();
    let methods = Methods::Faithful { broad: BroadPhaseCollider::default(), narrow };
    assert_eq!(simulator.set_methods(methods), Err(Error::GeomListNotEmpty));
    assert_eq!(simulator.methods(), Methods::default());
}

/// Twice a box of finite corners may be wider than any number.
#[test]
fn a_cell_size_that_was_adjusted_beyond_numbers_is_saved() {
    let mut simulator = simulator(0.0);
    simulator.set_broad_phase_collider(BroadPhaseCollider::SPATIAL_HASH).unwrap();
    simulator.set_narrow_phase_collider(NarrowPhaseCollider::Sat);
    let body = simulator.create_body(Body::new());
    let wide = Vertices::create_rectangle(3e38, 10.0).unwrap();
    let geom = simulator.create_geom(body, wide, GeomPlacement::default()).unwrap();
    simulator.add(body).unwrap();
    simulator.add(geom).unwrap();
    simulator.update(0.01);
    let infinite = BroadPhaseCollider::SpatialHash { cell_size: f32::INFINITY, auto_adjust_cell_size: true };
    assert_eq!(simulator.broad_phase_collider(), infinite);
    let text = serde_json::to_string(&simulator).unwrap();
    let loaded: PhysicsSimulator = serde_json::from_str(&text).unwrap();
    assert_eq!(loaded.broad_phase_collider(), infinite);
}

/// Check 9.
#[test]
fn points_find_the_geoms_in_list_order() {
    for methods in plane::both_sets() {
        let mut simulator = simulator_with(0.0, methods);
        let (_, p) = add_box(&mut simulator, (10.0, 10.0), v(0.0, 0.0));
        let (_, q) = add_box(&mut simulator, (10.0, 10.0), v(3.0, 0.0));
        assert_eq!(simulator.collide(v(1.0, 1.0)), None);
        simulator.process_added_and_removed();
        assert_eq!(simulator.collide(v(1.0, 1.0)), Some(p));
        assert_eq!(simulator.collide_all(v(1.0, 1.0)), [p, q]);
        assert_eq!(simulator.collide(v(7.0, 1.0)), Some(q));
        assert_eq!(simulator.collide(v(50.0, 50.0)), None);
    }
}

#[test]
fn points_find_a_geom_where_its_edited_body_is() {
    for methods in plane::both_sets() {
        let mut simulator = simulator_with(0.0, methods);
        let (body, geom) = add_box(&mut simulator, (10.0, 10.0), v(0.0, 0.0));
        simulator.process_added_and_removed();
        simulator[body].set_position(v(100.0, 0.0));
        assert_eq!(simulator.collide(v(1.0, 1.0)), None);
        assert_eq!(simulator.collide(v(101.0, 1.0)), Some(geom));
    }
}

/// Check 11. A step of NaN is refused here.
#[test]
fn a_negative_step_runs_backwards() {
    let mut simulator = simulator(10.0);
    let body = simulator.create_body(Body::new());
    simulator.add(body).unwrap();
    simulator.update(-0.1);
    assert_eq!(simulator[body].linear_velocity(), v(0.0, -1.0));
    assert_words(&simulator[body].position(), "00000000 3dcccccd");
    simulator.update(f32::NAN);
    assert_words(&simulator[body].position(), "00000000 3dcccccd");
}

/// Check 12, with the body disabled between the forces and the solver, where the original's controllers act.
#[test]
fn a_body_disabled_within_an_update_keeps_its_bias_velocity() {
    let mut simulator = simulator(100.0);
    add_floor(&mut simulator, (200.0, 20.0), v(0.0, 100.0));
    let (body, _) = add_box(&mut simulator, (20.0, 20.0), v(3.0, 81.0));
    assert!(simulator.process_queues(0.01, None));
    simulator.find_pairs(None);
    simulator.collide_pairs(None);
    simulator[body].set_enabled(false);
    simulator.apply_forces(0.01, 0.0, None);
    simulator.pre_step(1.0 / 0.01);
    (0..simulator.iterations()).for_each(|_| simulator.solve_iteration(None));
    simulator.integrate(0.01, None);
    let bias = |simulator: &PhysicsSimulator| simulator[body].get_velocity_bias_at_world_offset(v(0.0, 0.0));
    assert_eq!(simulator[body].linear_velocity(), v(0.0, 0.0));
    assert_words(&bias(&simulator), "00000000 c29800cb");
    simulator.update(0.01);
    assert_eq!(simulator.arbiter_count(), 0);
    simulator[body].reset_dynamics();
    assert_words(&bias(&simulator), "00000000 c29800cb");
    simulator[body].set_position(v(3.0, -500.0));
    simulator[body].set_ignore_gravity(true);
    simulator[body].set_enabled(true);
    simulator.update(0.01);
    assert_words(&simulator[body].position(), "40400000 c3fa6148");
    assert_eq!(simulator[body].linear_velocity(), v(0.0, 0.0));
}

/// Check 13.
#[test]
fn the_geom_of_a_removed_body_goes_on_colliding() {
    let mut simulator = simulator(100.0);
    add_floor(&mut simulator, (200.0, 20.0), v(0.0, 100.0));
    let (x, _) = add_box(&mut simulator, (20.0, 20.0), v(3.0, 85.0));
    let (y, _) = add_box(&mut simulator, (20.0, 20.0), v(3.0, 60.0));
    (0..5).for_each(|_| simulator.update(0.01));
    simulator.remove(x).unwrap();
    (0..40).for_each(|_| simulator.update(0.01));
    assert_words(&simulator[x].position(), "403fff19 42a019a7");
    assert_words(&simulator[x].linear_velocity(), "be4ba741 b8133710");
    let bias = simulator[x].get_velocity_bias_at_world_offset(v(0.0, 0.0));
    assert_words(&bias, "bc880a20 bc07db85");
    assert_words(&simulator[y].position(), "4041fe31 427040bf");
    assert_eq!(simulator.arbiter_count(), 2);
}

/// Section 2: an object of the same kind may be queued twice, and leaves once.
#[test]
fn objects_enter_their_lists_in_the_order_of_addition() {
    for methods in plane::both_sets() {
        let mut simulator = simulator_with(0.0, methods);
        let objects: Vec<_> =
            (0..4).map(|i| add_box(&mut simulator, (10.0, 10.0), v(i as f32 * 50.0, 0.0))).collect();
        simulator.update(0.01);
        let (bodies, geoms): (Vec<_>, Vec<_>) = objects.iter().copied().unzip();
        assert_eq!((simulator.body_list(), simulator.geom_list()), (&bodies[..], &geoms[..]));
        simulator.remove(bodies[1]).unwrap();
        simulator.remove(geoms[2]).unwrap();
        simulator.update(0.01);
        assert_eq!(simulator.body_list(), [bodies[0], bodies[2], bodies[3]]);
        assert_eq!(simulator.geom_list(), [geoms[0], geoms[1], geoms[3]]);
        // The precise set has no iteration count.
        if let Methods::Faithful { .. } = methods {
            let collision_id = |&geom: &farseer_core::GeomId| simulator.geom(geom).unwrap().collision_id();
            assert!(simulator.geom_list().iter().map(collision_id).eq([0, 1, 2]));
        }
    }
}

#[test]
fn a_body_is_not_moved_before_it_is_added() {
    let mut simulator = simulator(100.0);
    let body = simulator.create_body(Body::new());
    simulator.update(0.01);
    assert_eq!(simulator[body].linear_velocity(), v(0.0, 0.0));
    assert_eq!(simulator.events(), []);
    simulator.add(body).unwrap();
    simulator.update(0.01);
    assert_eq!(simulator.events(), [Event::Added { object: body.into() }, Event::BodyUpdated { body }]);
}

#[test]
fn adding_a_body_does_not_add_its_geoms() {
    for methods in plane::both_sets() {
        let mut simulator = simulator_with(0.0, methods);
        let body = simulator.create_body(Body::new());
        let outline = farseer_core::Vertices::create_rectangle(10.0, 10.0).unwrap();
        simulator.create_geom(body, outline, Default::default()).unwrap();
        simulator.add(body).unwrap();
        add_box(&mut simulator, (10.0, 10.0), v(8.0, 1.0));
        simulator.update(0.01);
        assert_eq!(pairs(&simulator), []);
        assert_eq!(simulator.geom_list().len(), 1);
    }
}

/// Section 9.
#[test]
fn categories_are_bits() {
    for number in 1..=31 {
        assert_eq!(CollisionCategory::cat(number).unwrap().bits(), 1 << (number - 1));
    }
    assert!(CollisionCategory::cat(0).is_err() && CollisionCategory::cat(32).is_err());
    assert_eq!((CollisionCategory::NONE.bits(), CollisionCategory::ALL.bits()), (0, 0x7FFF_FFFF));
    let cat = |number| CollisionCategory::cat(number).unwrap();
    assert_eq!((cat(1) | cat(3)).bits(), 5);
    assert_eq!(((cat(1) | cat(3)) & cat(3)).bits(), 4);
    assert_eq!(!CollisionCategory::NONE, CollisionCategory::ALL);
}

/// One direction of agreement is enough.
#[test]
fn geoms_collide_if_either_one_wants_to() {
    let touching = |methods: Methods, collides: [CollisionCategory; 2]| {
        let mut simulator = simulator_with(0.0, methods);
        let cats = [1, 2].map(|number| CollisionCategory::cat(number).unwrap());
        for i in 0..2 {
            let (_, geom) = add_box(&mut simulator, (10.0, 10.0), v(9.0 * i as f32, 1.0 * i as f32));
            simulator[geom].set_collision_categories(cats[i]);
            simulator[geom].set_collides_with(collides[i]);
        }
        simulator.update(0.01);
        simulator.arbiter_count() == 1
    };
    let (none, all) = (CollisionCategory::NONE, CollisionCategory::ALL);
    for methods in plane::both_sets() {
        let touching = |collides| touching(methods, collides);
        assert_eq!([touching([all, all]), touching([all, none]), touching([none, all])], [true; 3]);
        assert!(!touching([none, none]));
        assert!(!touching([CollisionCategory::CAT1, CollisionCategory::CAT2]));
    }
}
