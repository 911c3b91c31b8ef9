//! Motion of single bodies against closed forms. Tolerances come from the integrator (symplectic Euler: a
//! position is ahead of the parabola by v dt / 2) and from the ground, which is noticed at the end of a step.

use conformance::fixtures::depth::{
    DT, GRAVITY, ball, crate_box, place, run, set_surface, simulator, throw, weightless,
};
use twohalf::{BodyId, Platform, TwoHalfPhysicsSimulator, Vector2, Vector3};

/// Time until a body's lowest point is at or below the ground.
fn time_to_land(simulator: &mut TwoHalfPhysicsSimulator, body: BodyId) -> f32 {
    for step in 1..10_000 {
        simulator.update(DT);
        if place(simulator, body).y <= 0.0 {
            return step as f32 * DT;
        }
    }
    panic!("the body does not land");
}

#[track_caller]
fn assert_near(value: f32, expected: f32, tolerance: f32) {
    assert!((value - expected).abs() <= tolerance, "{value} is not within {tolerance} of {expected}");
}

#[test]
pub(crate) fn a_fall_from_a_height_takes_the_square_root_of_2h_over_g() {
    let mut simulator = simulator();
    let body = ball(&mut simulator, 10.0, [0.0, 100.0, 50.0]);
    let expected = (2.0 * 100.0 / GRAVITY).sqrt();
    assert_near(time_to_land(&mut simulator, body), expected, DT);
}

#[test]
fn a_bounce_reaches_the_square_of_the_restitution_times_the_height() {
    for (make, restitution) in [(0, 0.8_f32), (0, 0.5), (1, 0.8)] {
        let mut simulator = simulator();
        let body = match make {
            0 => ball(&mut simulator, 10.0, [0.0, 200.0, 0.0]),
            _ => crate_box(&mut simulator, [30.0, 20.0], [0.0, 200.0, 0.0]),
        };
        set_surface(&mut simulator, body, 0.3, restitution);
        time_to_land(&mut simulator, body);
        let mut top = f32::MIN;
        loop {
            simulator.update(DT);
            top = top.max(place(&simulator, body).y);
            if simulator.body(body).unwrap().linear_velocity().y > 0.0 {
                break;
            }
        }
        // The speed of the impact is known within 1.5 g dt, the position within the depth v dt below the ground.
        let speed = (2.0 * GRAVITY * 200.0).sqrt();
        assert_near(top, restitution * restitution * 200.0, 1.6 * speed * DT + 0.05);
    }
}

#[test]
pub(crate) fn a_throw_upward_and_into_the_picture_lands_after_2v_over_g_at_the_range() {
    let mut simulator = simulator();
    let body = ball(&mut simulator, 10.0, [30.0, 0.0, 40.0]);
    throw(&mut simulator, body, [50.0, 100.0, 60.0]);
    let time = time_to_land(&mut simulator, body);
    assert_near(time, 2.0 * 100.0 / GRAVITY, 1.5 * DT);
    let landed = place(&simulator, body);
    assert_near(landed.x, 30.0 + 50.0 * 2.0, 50.0 * 1.5 * DT);
    assert_near(landed.z, 40.0 + 60.0 * 2.0, 60.0 * 1.5 * DT);
}

#[test]
pub(crate) fn a_sliding_box_stops_after_v_squared_over_2_mu_g_in_every_direction() {
    for direction in [[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0], [0.6, 0.8], [0.8, -0.6]] {
        let mut simulator = simulator();
        let body = crate_box(&mut simulator, [60.0, 20.0], [0.0, 0.0, 0.0]);
        set_surface(&mut simulator, body, 0.4, 0.0);
        throw(&mut simulator, body, [100.0 * direction[0], 0.0, 100.0 * direction[1]]);
        run(&mut simulator, 500);
        let stopped = place(&simulator, body);
        let distance = stopped.x * direction[0] + stopped.z * direction[1];
        let aside = stopped.x * direction[1] - stopped.z * direction[0];
        assert_near(distance, 100.0 * 100.0 / (2.0 * 0.4 * GRAVITY), 1.5 * 100.0 * DT);
        assert_near(aside, 0.0, 1.0);
        let body = simulator.body(body).unwrap();
        assert_near(body.linear_velocity_z(), 0.0, 1e-3);
        assert_near(body.linear_velocity().x, 0.0, 1e-3);
    }
}

#[test]
pub(crate) fn without_friction_a_box_slides_on_with_its_velocity() {
    let mut simulator = simulator();
    let body = crate_box(&mut simulator, [60.0, 20.0], [0.0, 0.0, 0.0]);
    throw(&mut simulator, body, [30.0, 0.0, 40.0]);
    run(&mut simulator, 300);
    assert_near(simulator.body(body).unwrap().linear_velocity().x, 30.0, 1e-3);
    assert_eq!(simulator.body(body).unwrap().linear_velocity_z(), 40.0);
}

#[test]
pub(crate) fn a_ball_thrown_flat_ends_up_rolling_at_two_thirds_of_its_speed() {
    for direction in [[1.0, 0.0], [0.0, 1.0], [0.6, -0.8]] {
        let mut simulator = simulator();
        let body = ball(&mut simulator, 20.0, [0.0, 0.0, 0.0]);
        set_surface(&mut simulator, body, 0.3, 0.0);
        throw(&mut simulator, body, [90.0 * direction[0], 0.0, 90.0 * direction[1]]);
        run(&mut simulator, 400);
        let body = simulator.body(body).unwrap();
        // A disc has half of m r² as its moment of inertia.
        assert_near(body.linear_velocity().x, 60.0 * direction[0], 0.05);
        assert_near(body.linear_velocity_z(), 60.0 * direction[1], 0.05);
        assert_near(body.angular_velocity() * 20.0, 60.0 * direction[0], 0.05);
        assert_near(body.angular_velocity_x() * 20.0, -60.0 * direction[1], 0.05);
    }
}

#[test]
fn a_box_dropped_flat_comes_to_rest_without_rocking() {
    let mut simulator = simulator();
    let body = crate_box(&mut simulator, [60.0, 40.0], [0.0, 50.0, 25.0]);
    set_surface(&mut simulator, body, 0.5, 0.0);
    for _ in 0..500 {
        simulator.update(DT);
        assert_near(simulator.body(body).unwrap().rotation().sin(), 0.0, 1e-4);
    }
    let view = simulator.body(body).unwrap();
    assert_near(view.linear_velocity().norm(), 0.0, 1e-2);
    // The slop of the solver is an overlap of 0.05.
    assert_near(view.position3d().y, 0.0, 0.06);
}

#[test]
pub(crate) fn a_box_dropped_askew_comes_to_rest_on_a_side() {
    let mut simulator = simulator();
    let body = crate_box(&mut simulator, [60.0, 40.0], [0.0, 50.0, 0.0]);
    set_surface(&mut simulator, body, 0.5, 0.2);
    simulator.body_mut(body).unwrap().set_rotation(0.3);
    run(&mut simulator, 1500);
    let view = simulator.body(body).unwrap();
    assert_near((2.0 * view.rotation()).sin(), 0.0, 5e-3);
    // The velocity of a step of gravity bounces in the next one.
    assert_near(view.linear_velocity().norm(), 0.0, 0.2 * GRAVITY * DT + 0.01);
    assert_near(view.position3d().y, 0.0, 0.1);
}

#[test]
pub(crate) fn a_body_without_an_object_geom_falls_through_the_ground() {
    let mut simulator = simulator();
    let body = simulator.create_body(twohalf::farseer_core::Body::new());
    simulator.add(body).unwrap();
    run(&mut simulator, 300);
    assert!(place(&simulator, body).y < -400.0);
}

#[test]
pub(crate) fn an_object_geom_holds_the_body_only_while_its_collisions_have_a_response() {
    let mut simulator = simulator();
    let body = ball(&mut simulator, 10.0, [0.0, 0.0, 0.0]);
    run(&mut simulator, 50);
    assert_near(place(&simulator, body).y, 0.0, 0.1);
    let geom = simulator.body(body).unwrap().ground().object_geom().unwrap();
    simulator.geom_mut(geom).unwrap().set_collision_response_enabled(false);
    run(&mut simulator, 100);
    assert!(place(&simulator, body).y < -40.0);
}

#[test]
pub(crate) fn an_object_geom_that_was_removed_does_not_hold_the_body() {
    let mut simulator = simulator();
    let body = ball(&mut simulator, 10.0, [0.0, 0.0, 0.0]);
    let geom = simulator.body(body).unwrap().ground().object_geom().unwrap();
    simulator.remove(geom).unwrap();
    run(&mut simulator, 100);
    assert!(place(&simulator, body).y < -40.0);
}

#[test]
pub(crate) fn an_object_geom_that_is_undone_does_not_hold_the_body_until_it_is_set_again() {
    let mut simulator = simulator();
    let body = ball(&mut simulator, 10.0, [0.0, 0.0, 0.0]);
    let geom = simulator.body(body).unwrap().ground().object_geom().unwrap();
    run(&mut simulator, 200);
    let mut view = simulator.body_mut(body).unwrap();
    let before = view.origin3d();
    view.ground_mut().clear_object_geom();
    // It stays where it is, and is where its origin is.
    assert_eq!((view.origin3d(), view.position3d()), (before, before));
    assert_eq!((view.ground().object_geom(), view.ground().shadow_image()), (None, None));
    run(&mut simulator, 100);
    // Falls for one second.
    assert_near(place(&simulator, body).y - before.y, -0.5 * GRAVITY, 1.5);
    let mut view = simulator.body_mut(body).unwrap();
    view.set_velocity3d(Vector3::zeros());
    view.ground_mut().set_object_geom(geom, None).unwrap();
    view.set_position3d(Vector3::new(0.0, 5.0, 0.0));
    run(&mut simulator, 200);
    assert_near(place(&simulator, body).y, 0.0, 0.1);
}

#[test]
pub(crate) fn an_object_geom_that_is_undone_is_undone_after_loading_too() {
    let mut simulator = simulator();
    let bodies = [0.0, 50.0].map(|x| ball(&mut simulator, 10.0, [x, 0.0, 0.0]));
    run(&mut simulator, 200);
    simulator.body_mut(bodies[0]).unwrap().ground_mut().clear_object_geom();
    let mut loaded = self::simulator();
    loaded.restore(&simulator.snapshot()).unwrap();
    let mut read: TwoHalfPhysicsSimulator =
        serde_json::from_str(&serde_json::to_string(&simulator).unwrap()).unwrap();
    for other in [&mut loaded, &mut read] {
        assert_eq!(other.body(bodies[0]).unwrap().ground().object_geom(), None);
        let mut kept = simulator.clone();
        run(other, 50);
        run(&mut kept, 50);
        for body in bodies {
            assert_eq!(place(other, body), place(&kept, body));
        }
    }
    run(&mut simulator, 50);
    assert!(place(&simulator, bodies[0]).y < -2.0 && place(&simulator, bodies[1]).y > -0.1);
}

#[test]
fn a_force_along_z_accelerates_by_force_over_mass_for_one_update() {
    let mut simulator = weightless();
    let body = ball(&mut simulator, 10.0, [0.0, 0.0, 0.0]);
    simulator.body_mut(body).unwrap().core_mut().set_mass(4.0).unwrap();
    simulator.body_mut(body).unwrap().apply_force_z(800.0);
    run(&mut simulator, 2);
    assert_near(simulator.body(body).unwrap().linear_velocity_z(), 800.0 / 4.0 * DT, 1e-5);
    assert_near(place(&simulator, body).z, 2.0 * 800.0 / 4.0 * DT * DT, 1e-5);
}

#[test]
pub(crate) fn an_impulse_along_z_changes_the_velocity_by_impulse_over_mass_at_the_next_update() {
    let mut simulator = weightless();
    let body = ball(&mut simulator, 10.0, [0.0, 0.0, 0.0]);
    simulator.body_mut(body).unwrap().core_mut().set_mass(4.0).unwrap();
    simulator.body_mut(body).unwrap().apply_impulse_z(20.0);
    assert_eq!(simulator.body(body).unwrap().linear_velocity_z(), 0.0);
    run(&mut simulator, 2);
    assert_eq!(simulator.body(body).unwrap().linear_velocity_z(), 5.0);
}

#[test]
pub(crate) fn drag_slows_along_z_as_along_x() {
    for quadratic in [false, true] {
        let mut simulator = weightless();
        let body = crate_box(&mut simulator, [20.0, 20.0], [0.0, 500.0, 0.0]);
        let mut view = simulator.body_mut(body).unwrap();
        view.core_mut().set_linear_drag_coefficient(0.4);
        view.core_mut().set_is_quadratic_drag_enabled(quadratic);
        view.core_mut().set_quadratic_drag_coefficient(0.3);
        let other = ball(&mut simulator, 10.0, [500.0, 500.0, 0.0]);
        let core = simulator.body(body).unwrap().core().clone();
        *simulator.body_mut(other).unwrap().core_mut() = core;
        simulator.body_mut(other).unwrap().set_position3d(Vector3::new(0.0, 0.0, 500.0));
        throw(&mut simulator, body, [70.0, 0.0, 0.0]);
        throw(&mut simulator, other, [0.0, 0.0, 70.0]);
        run(&mut simulator, 100);
        let along_x = simulator.body(body).unwrap().linear_velocity().x;
        assert!(along_x < 60.0);
        assert_near(simulator.body(other).unwrap().linear_velocity_z(), along_x, 1e-4);
    }
}

#[test]
pub(crate) fn static_and_disabled_bodies_do_not_move_along_z() {
    let mut simulator = weightless();
    let fixed = ball(&mut simulator, 10.0, [0.0, 0.0, 7.0]);
    simulator.body_mut(fixed).unwrap().set_is_static(true);
    let disabled = ball(&mut simulator, 10.0, [100.0, 0.0, 7.0]);
    simulator.body_mut(disabled).unwrap().set_enabled(false);
    for body in [fixed, disabled] {
        throw(&mut simulator, body, [0.0, 0.0, 50.0]);
        simulator.body_mut(body).unwrap().apply_force_z(1000.0);
    }
    run(&mut simulator, 10);
    assert_eq!(place(&simulator, fixed).z, 7.0);
    assert_eq!(place(&simulator, disabled).z, 7.0);
}

#[test]
pub(crate) fn no_body_moves_along_z_while_the_simulator_is_disabled() {
    let mut simulator = simulator();
    let body = ball(&mut simulator, 10.0, [0.0, 100.0, 0.0]);
    throw(&mut simulator, body, [0.0, 0.0, 50.0]);
    simulator.set_enabled(false);
    run(&mut simulator, 10);
    assert_eq!(place(&simulator, body), Vector3::new(0.0, 100.0, 0.0));
}

#[test]
pub(crate) fn a_bouncy_box_comes_to_rest_on_the_ground() {
    let mut simulator = simulator();
    let body = crate_box(&mut simulator, [40.0, 20.0], [0.0, 30.0, 0.0]);
    set_surface(&mut simulator, body, 0.5, 0.6);
    run(&mut simulator, 1000);
    for _ in 0..200 {
        simulator.update(DT);
        let body = simulator.body(body).unwrap();
        assert!(body.is_grounded());
        // The slop is 0.05 px of overlap; above, it falls by the motion of gravity in one step.
        assert!((-0.06..0.02).contains(&body.position3d().y), "{}", body.position3d());
        assert!(body.velocity3d().norm() <= 1.001 * GRAVITY * DT, "{}", body.velocity3d());
    }
}

#[test]
pub(crate) fn a_bouncy_box_does_not_creep_down_a_slope_below_its_friction_angle() {
    let mut simulator = simulator();
    let tilt = 0.3_f32;
    let slope = Vector3::new(0.0, 100.0, 0.0);
    let slope = Platform::with_rotation(&mut simulator, 400.0, 20.0, 80.0, slope, tilt, None).unwrap();
    let mut slope = simulator.platform_mut(slope).unwrap();
    slope.set_friction_coefficient(0.5);
    slope.set_restitution_coefficient(0.5);
    let body = crate_box(&mut simulator, [40.0, 20.0], [0.0, 0.0, 0.0]);
    set_surface(&mut simulator, body, 0.5, 0.5);
    let mut view = simulator.body_mut(body).unwrap();
    view.set_rotation(tilt);
    // Its middle lies half its height and half the platform's over the platform's middle at Y = 110.
    let rise = 20.0;
    let origin = Vector2::new(rise * tilt.sin(), -(110.0 + rise * tilt.cos()));
    view.core_mut().set_position(origin);
    run(&mut simulator, 200);
    let settled = simulator.body(body).unwrap().origin3d();
    run(&mut simulator, 1000);
    let later = simulator.body(body).unwrap().origin3d();
    assert!((later - settled).norm() < 1e-2, "{settled} to {later}");
}
