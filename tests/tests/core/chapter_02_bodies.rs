//! Checks of behaviour chapter 02: bodies.

use conformance::fixtures::plane::{self, v};
use conformance::units::assert_words;
use farseer_core::{Body, BodyId, PhysicsSimulator};

fn simulator_with_body(gravity: f32, body: Body) -> (PhysicsSimulator, BodyId) {
    let mut simulator = plane::simulator(gravity);
    let body = simulator.create_body(body);
    simulator.add(body).unwrap();
    (simulator, body)
}

fn expect_rotation(body: &Body, rotation: &str, revolutions: i32, total: &str) {
    assert_words(&body.rotation(), rotation);
    assert_eq!(body.revolutions(), revolutions);
    assert_words(&body.total_rotation(), total);
}

/// Check 1. Infinity, which the original accepts, is refused here.
#[test]
fn a_rotation_is_brought_into_one_turn() {
    let hex = |word| f32::from_bits(word);
    for (input, rotation, revolutions, total) in [
        (-0.0, "80000000", 0, "00000000"),
        (7.0, "3f378128", 1, "40e00000"),
        (-1.0, "40a90fdb", -1, "bf800000"),
        (-1e-9, "40c90fdb", -1, "00000000"),
        (hex(0x40c9_0fdb), "00000000", 1, "40c90fdb"),
        (-hex(0x40c9_0fdb), "40c90fdb", -2, "c0c90fdb"),
        (100.0, "40b81230", 15, "42c80000"),
        (-100.0, "3f07ed80", -16, "c2c80000"),
        (hex(0x41fb_53d1), "b6000000", 5, "41fb53d1"),
        (hex(0xc196_cbe4), "40c90fdc", -4, "c196cbe4"),
        (1e6, "40bc0000", 159_154, "49742400"),
        (1e11, "51d365b2", i32::MIN, "51ba43b7"),
        (-1e11, "d1d365b2", i32::MAX, "d1ba43b7"),
    ] {
        let mut body = Body::new();
        body.set_rotation(input);
        expect_rotation(&body, rotation, revolutions, total);
    }
}

/// Check 2.
#[test]
fn revolutions_add_up_when_the_rotation_is_set() {
    let mut body = Body::new();
    body.set_rotation(20.0);
    assert_words(&body.rotation(), "3f9341c0");
    assert_eq!(body.revolutions(), 3);
    body.set_rotation(0.0);
    expect_rotation(&body, "00000000", 3, "4196cbe4");
    body.set_rotation(-0.5);
    expect_rotation(&body, "40b90fdb", 2, "4192cbe4");
}

fn body_of_check_3() -> Body {
    let mut body = Body::new();
    body.set_mass(2.0).unwrap();
    body.set_moment_of_inertia(3.0).unwrap();
    body.set_position(v(1.0, 2.0));
    body.set_rotation(0.3);
    body.set_linear_velocity(v(10.0, -20.0));
    body.set_angular_velocity(2.0);
    body
}

/// Checks 3 and 4.
#[test]
fn forces_impulses_and_drag_move_a_body() {
    let (mut simulator, body) = simulator_with_body(100.0, body_of_check_3());
    simulator[body].apply_force_at_local_point(v(5.0, 6.0), v(0.5, 0.25));
    assert_words(&simulator[body].torque(), "3efac188");
    assert_eq!(simulator[body].force(), v(5.0, 6.0));
    simulator[body].apply_impulse(v(3.0, -1.0));
    simulator[body].apply_angular_impulse(0.7);
    assert_words(&simulator[body].angular_velocity(), "400eeeef");
    simulator.update(0.01);
    let moved = &simulator[body];
    assert_words(&moved.position(), "3f8ec07e 3fe7141b");
    assert_words(&moved.linear_velocity(), "4138662a c19bc25a");
    assert_words(&moved.angular_velocity(), "400f0969");
    assert_words(&moved.rotation(), "3ea50aff");
    assert_eq!((moved.force(), moved.torque()), (v(0.0, 0.0), 0.0));

    simulator[body].set_is_quadratic_drag_enabled(true);
    simulator.update(0.01);
    let moved = &simulator[body];
    assert_words(&moved.position(), "3f9d80ee 3fcf6ff5");
    assert_words(&moved.linear_velocity(), "41386577 c193c1ec");
    assert_words(&moved.angular_velocity(), "400f0923");
    assert_words(&moved.rotation(), "3eb07c5e");

    (0..1000).for_each(|_| simulator.update(0.01));
    let moved = &simulator[body];
    assert_words(&moved.position(), "42d89e8a 459631af");
    assert_words(&moved.linear_velocity(), "41111d98 44742f00");
    assert_words(&moved.angular_velocity(), "400dfa5a");
    expect_rotation(moved, "4070bc3a", 3, "41b4e36b");
}

/// Check 5.
#[test]
fn points_and_velocities_are_converted() {
    let mut body = Body::new();
    body.set_position(v(10.1, -3.7));
    body.set_rotation(0.77);
    body.set_linear_velocity(v(1.5, 2.5));
    body.set_angular_velocity(-1.25);
    let (local, world) = (v(1.3, -0.6), v(12.0, -3.0));
    assert_words(&body.get_world_position(local), "41373728 c04e7307");
    assert_words(&body.get_local_position(world), "3fecf836 bf51f353");
    assert_words(&body.get_velocity_at_local_point(local), "4005f038 3f4fb0e8");
    assert_words(&body.get_velocity_at_world_point(world), "40180000 3e000020");
    assert_eq!(body.get_velocity_at_world_offset(world), v(-2.25, -12.5));
    assert_words(&body.x_vector_in_world_coordinates(), "3f37c8ff 3f3235eb");
    assert_words(&body.y_vector_in_world_coordinates(), "bf3235eb 3f37c8ff");
    body.apply_force_at_world_point(v(3.0, 4.0), world);
    assert_words(&body.torque(), "40affffc");
}

/// Check 6.
#[test]
fn drag_slows_a_body() {
    let (mut simulator, body) = simulator_with_body(0.0, Body::new());
    let edited = &mut simulator[body];
    edited.set_mass(2.0).unwrap();
    edited.set_linear_velocity(v(30.0, -40.0));
    edited.set_is_quadratic_drag_enabled(true);
    edited.set_quadratic_drag_coefficient(0.1);
    edited.set_linear_drag_coefficient(0.5);
    edited.set_angular_velocity(-3.0);
    edited.set_rotational_drag_coefficient(0.25);
    simulator.update(0.1);
    let moved = &simulator[body];
    assert_eq!(moved.linear_velocity(), v(29.0, -38.75));
    assert_words(&moved.angular_velocity(), "c031999a");
    assert_words(&moved.position(), "4039999a c0780000");
    expect_rotation(moved, "40c02e93", -1, "be8e1480");
}

/// Check 7.
#[test]
fn a_body_turns_back_and_forth_over_zero() {
    let (mut simulator, body) = simulator_with_body(0.0, Body::new());
    simulator[body].set_linear_drag_coefficient(0.0);
    simulator[body].set_rotational_drag_coefficient(0.0);
    simulator[body].set_angular_velocity(-0.05);
    simulator.update(1.0 / 60.0);
    expect_rotation(&simulator[body], "40c90907", -1, "ba5a8000");
    simulator[body].set_angular_velocity(0.05);
    simulator.update(1.0 / 60.0);
    expect_rotation(&simulator[body], "00000000", 0, "00000000");
}

/// Check 8.
#[test]
fn forces_on_a_static_body_act_when_it_becomes_dynamic() {
    let (mut simulator, body) = simulator_with_body(10.0, Body::new());
    simulator[body].set_is_static(true);
    simulator[body].apply_force(v(100.0, 0.0));
    simulator[body].apply_impulse(v(7.0, 0.0));
    simulator[body].set_linear_velocity(v(1.0, 0.0));
    (0..3).for_each(|_| simulator.update(0.01));
    assert_eq!((simulator[body].position(), simulator[body].force()), (v(0.0, 0.0), v(100.0, 0.0)));
    simulator[body].set_is_static(false);
    simulator.update(0.01);
    assert_words(&simulator[body].linear_velocity(), "410fffac 3dcccccc");
    assert_words(&simulator[body].position(), "3db85180 3a83126e");
    assert_eq!(simulator[body].force(), v(0.0, 0.0));
}

/// Check 9. NaN, which the original accepts, is refused here.
#[test]
fn masses_of_zero_are_refused_and_negative_ones_are_not() {
    let mut body = Body::new();
    assert!(body.set_mass(0.0).is_err());
    assert!(body.set_moment_of_inertia(0.0).is_err() && body.set_moment_of_inertia(-2.0).is_err());
    assert!(body.set_mass(f32::NAN).is_err() && body.set_moment_of_inertia(f32::NAN).is_err());
    assert_eq!((body.mass(), body.moment_of_inertia()), (1.0, 1.0));
    body.set_mass(-2.0).unwrap();
    assert_eq!(body.inverse_mass(), -0.5);
}

/// Check 11.
#[test]
fn negative_zero_velocities_become_positive() {
    let (mut simulator, body) = simulator_with_body(0.0, Body::new());
    simulator[body].set_linear_velocity(v(-0.0, -0.0));
    simulator[body].set_angular_velocity(-0.0);
    simulator.update(0.01);
    assert_words(&simulator[body].linear_velocity(), "00000000 00000000");
    assert_words(&simulator[body].angular_velocity(), "00000000");
}

/// Check 12.
#[test]
fn a_copy_takes_properties_over_and_motion_not() {
    let mut body = Body::new();
    body.set_mass(4.0).unwrap();
    body.set_moment_of_inertia(5.0).unwrap();
    body.set_is_static(true);
    body.set_position(v(1.0, 1.0));
    body.set_linear_velocity(v(2.0, 2.0));
    body.set_is_auto_idle(true);
    body.set_minimum_velocity(3.0);
    body.set_tag(77);
    let mut copy = Body::copy_of(&body);
    assert!(copy.is_static());
    assert_eq!((copy.mass(), copy.inverse_mass(), copy.moment_of_inertia()), (4.0, 0.0, 5.0));
    assert_eq!((copy.position(), copy.linear_velocity()), (v(0.0, 0.0), v(0.0, 0.0)));
    assert_eq!((copy.is_auto_idle(), copy.minimum_velocity(), copy.tag()), (false, 55.0, 77));
    copy.set_is_static(false);
    assert_eq!((copy.inverse_mass(), copy.inverse_moment_of_inertia()), (0.25, 0.2));
}

/// Check 13.
#[test]
fn a_body_moves_from_its_minimum_velocity_on() {
    let mut body = Body::new();
    body.set_linear_velocity(v(55.0, 0.0));
    assert!(body.moves());
    body.set_linear_velocity(v(54.99, 0.0));
    assert!(!body.moves());
}
