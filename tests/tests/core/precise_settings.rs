//! The precise set: the meaning of each setting, line by line of the table of `Methods::Precise`.

use approx::assert_abs_diff_eq;
use conformance::fixtures::plane::{add_box, add_floor, simulator, v};
use farseer_core::{
    Aabb, BodyId, Error, Event, FrictionType, GeomId, InactivityController, Limits, Methods,
    NarrowPhaseCollider, PhysicsSimulator,
};

const DT: f32 = 1.0 / 60.0;
const GRAVITY: f32 = 320.0;

/// A box of 32 px that lies on a floor whose surface is at y = 0.
fn box_on_floor() -> (PhysicsSimulator, BodyId, GeomId) {
    let mut simulator = simulator(GRAVITY);
    simulator.set_methods(Methods::PRECISE).unwrap();
    simulator.set_iterations(4);
    add_floor(&mut simulator, (4000.0, 20.0), v(0.0, 10.0));
    let (body, geom) = add_box(&mut simulator, (32.0, 32.0), v(0.0, -16.0));
    (simulator, body, geom)
}

fn run(simulator: &mut PhysicsSimulator, steps: usize) {
    (0..steps).for_each(|_| simulator.update(DT));
}

fn contact_count(simulator: &PhysicsSimulator) -> usize {
    simulator.arbiters().map(|arbiter| arbiter.contacts().count()).sum()
}

#[test]
fn no_body_moves_while_the_simulator_is_disabled() {
    let (mut simulator, body, _) = box_on_floor();
    simulator[body].set_position(v(0.0, -100.0));
    simulator.set_enabled(false);
    run(&mut simulator, 10);
    assert_eq!(simulator[body].position(), v(0.0, -100.0));
}

#[test]
fn iterations_are_substeps_within_the_limits_and_one_at_least() {
    let (mut simulator, ..) = box_on_floor();
    simulator.set_limits(Limits { iterations: 6, ..simulator.limits() });
    for (iterations, substeps) in [(-3, 1), (0, 1), (4, 4), (100, 6)] {
        simulator.set_iterations(iterations);
        simulator.update(DT);
        assert_eq!(simulator.counters().passes, substeps);
    }
}

#[test]
fn another_friction_type_counts_at_once() {
    let (mut simulator, body, geom) = box_on_floor();
    simulator[body].set_linear_drag_coefficient(0.0);
    let floor = simulator.geoms().next().unwrap();
    simulator[floor].set_friction_coefficient(0.0);
    simulator[geom].set_friction_coefficient(0.5);
    run(&mut simulator, 10);
    simulator[body].set_linear_velocity(v(200.0, 0.0));
    simulator.set_friction_type(FrictionType::Minimum);
    run(&mut simulator, 30);
    assert_abs_diff_eq!(simulator[body].linear_velocity().x, 200.0, epsilon = 0.01);
    simulator.set_friction_type(FrictionType::Average);
    run(&mut simulator, 30);
    // Half a second of an average of 0.25. Measured: 0.00044 px/s.
    assert_abs_diff_eq!(simulator[body].linear_velocity().x, 200.0 - 0.25 * GRAVITY * 0.5, epsilon = 0.001);
}

#[test]
fn bias_factor_and_allowed_penetration_are_refused_and_keep_their_values() {
    let mut simulator = simulator(GRAVITY);
    simulator.set_bias_factor(0.3).unwrap();
    simulator.set_allowed_penetration(0.01).unwrap();
    simulator.set_methods(Methods::PRECISE).unwrap();
    let not_supported = |what| Err(Error::NotSupported { what, methods: "precise" });
    assert_eq!(simulator.set_bias_factor(0.8), not_supported("bias factor"));
    assert_eq!(simulator.set_allowed_penetration(0.05), not_supported("allowed penetration"));
    assert!(simulator.set_bias_factor(0.3).is_ok() && simulator.set_allowed_penetration(0.01).is_ok());
    simulator.set_methods(Methods::default()).unwrap();
    assert_eq!((simulator.bias_factor(), simulator.allowed_penetration()), (0.3, 0.01));
    assert!(simulator.set_bias_factor(0.8).is_ok() && simulator.set_allowed_penetration(0.05).is_ok());
}

#[test]
fn two_pieces_have_as_many_contacts_as_both_limits_allow() {
    type Set = fn(&mut PhysicsSimulator, i32);
    let setters: [Set; 2] = [
        |simulator, count| simulator.set_max_contacts_to_detect(count),
        |simulator, count| simulator.set_max_contacts_to_resolve(count).unwrap(),
    ];
    for set in setters {
        let (mut simulator, ..) = box_on_floor();
        for (most, count) in [(10, 2), (1, 1), (2, 2), (0, 0), (3, 2)] {
            set(&mut simulator, most);
            simulator.update(DT);
            assert_eq!(contact_count(&simulator), count, "{most}");
        }
    }
}

#[test]
fn the_deepest_contact_is_the_one_that_is_kept() {
    let (mut simulator, body, _) = box_on_floor();
    simulator.set_max_contacts_to_detect(1);
    for (rotation, side) in [(0.01, 1.0), (-0.01, -1.0)] {
        simulator[body].set_rotation(rotation);
        simulator[body].set_position(v(0.0, -16.0));
        simulator.update(DT);
        let contact = simulator.arbiters().next().unwrap().contacts().next().unwrap();
        // The middle between the corner and the floor, in the frame of the turned box. Measured: 0.135 px.
        assert_abs_diff_eq!(contact.position.x, side * 16.0, epsilon = 0.15);
    }
}

#[test]
fn bodies_with_a_contact_limit_of_zero_fall_through_each_other() {
    let (mut simulator, body, _) = box_on_floor();
    simulator.set_max_contacts_to_detect(0);
    run(&mut simulator, 30);
    assert!(simulator[body].position().y > 10.0);
}

#[test]
fn a_limit_of_contacts_is_kept_by_a_save() {
    let (mut plain, ..) = box_on_floor();
    plain.set_max_contacts_to_detect(1);
    run(&mut plain, 3);
    let mut loaded = simulator(1.0);
    loaded.restore(&plain.snapshot()).unwrap();
    for simulator in [&mut plain, &mut loaded] {
        simulator.set_max_contacts_to_detect(10);
        simulator.update(DT);
        assert_eq!(contact_count(simulator), 2);
    }
    assert!(plain.snapshot() == loaded.snapshot());
}

#[test]
fn a_narrow_phase_is_refused_and_reported() {
    let (mut simulator, ..) = box_on_floor();
    simulator.set_narrow_phase_collider(NarrowPhaseCollider::DistanceGrid);
    let refused = Event::RejectedInput { object: None, argument: "narrow_phase" };
    assert_eq!(simulator.events().last(), Some(&refused));
    assert_eq!(simulator.methods(), Methods::PRECISE);
}

#[test]
fn distance_grids_are_made_and_kept_and_not_used() {
    let (mut simulator, body, geom) = box_on_floor();
    assert!(simulator.geom(geom).unwrap().distance_grid().is_none());
    simulator.create_distance_grid(geom).unwrap();
    let mut without = simulator.clone();
    without.remove_distance_grid(geom).unwrap();
    for simulator in [&mut simulator, &mut without] {
        run(simulator, 30);
    }
    assert_eq!(simulator[body].position(), without[body].position());
    simulator.set_methods(Methods::default()).unwrap();
    assert!(simulator.geom(geom).unwrap().distance_grid().is_some());
}

#[test]
fn a_box_of_a_disc_is_for_queries_alone() {
    let (mut simulator, body, geom) = box_on_floor();
    simulator[body].set_position(v(0.0, -300.0));
    simulator.set_box_radius(geom, Some(400.0)).unwrap();
    simulator.update(DT);
    assert_eq!(simulator.query_aabb(&Aabb::new(v(300.0, -500.0), v(310.0, -490.0))), [geom]);
    assert_eq!(simulator.arbiter_count(), 0);
}

#[test]
fn a_matrix_of_the_user_is_for_queries_alone() {
    let (mut simulator, body, geom) = box_on_floor();
    run(&mut simulator, 60);
    let rests_at = simulator[body].position();
    let mut matrix = simulator.geom(geom).unwrap().matrix();
    (matrix.m41, matrix.m42) = (1000.0, -1000.0);
    simulator.set_matrix(geom, &matrix).unwrap();
    assert_eq!(simulator.collide(v(1000.0, -1000.0)), Some(geom));
    run(&mut simulator, 60);
    // Measured: 0.00036 px.
    assert_abs_diff_eq!(simulator[body].position(), rests_at, epsilon = 5e-4);
}

#[test]
fn no_impulse_acts_on_a_body_of_negative_mass() {
    let (mut simulator, body, _) = box_on_floor();
    simulator[body].set_mass(-1.0).unwrap();
    simulator[body].set_ignore_gravity(true);
    add_box(&mut simulator, (20.0, 20.0), v(0.0, -60.0));
    run(&mut simulator, 120);
    assert_abs_diff_eq!(simulator[body].position(), v(0.0, -16.0), epsilon = 1e-5);
}

#[test]
fn the_greatest_moment_of_inertia_keeps_a_body_from_turning() {
    let (mut simulator, body, _) = box_on_floor();
    simulator[body].set_moment_of_inertia(f32::MAX).unwrap();
    simulator[body].set_rotation(0.3);
    simulator[body].set_position(v(0.0, -100.0));
    run(&mut simulator, 120);
    assert_eq!(simulator[body].rotation(), 0.3);
    assert!(simulator[body].position().y > -25.0);
}

#[test]
fn bodies_disabled_and_enabled_by_an_inactivity_controller_leave_and_join_the_simulation() {
    let (mut simulator, body, _) = box_on_floor();
    let mut controller = InactivityController::new();
    controller.set_max_idle_time(100.0).unwrap();
    let controller = simulator.create_controller(controller).unwrap();
    simulator.add(controller).unwrap();
    simulator[body].set_is_auto_idle(true);
    run(&mut simulator, 30);
    assert!(!simulator[body].enabled());
    assert_eq!(simulator.arbiter_count(), 0);
    let (waking, _) = add_box(&mut simulator, (20.0, 20.0), v(60.0, -10.0));
    simulator[waking].set_linear_velocity(v(100.0, 0.0));
    run(&mut simulator, 2);
    assert!(simulator[body].enabled());
    run(&mut simulator, 1);
    assert_eq!(simulator.arbiter_count(), 2);
}
