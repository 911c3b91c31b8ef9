//! The precise set: slowly driven bodies do not fall asleep, and stalled ones do.

use farseer_core::math::Vector2;
use farseer_core::{
    BodyFactory, BodyId, GeomFactory, GeomPlacement, JointFactory, JointId, JointLimits, JointMotor, Methods,
    PhysicsSimulator, SpringFactory,
};

const DT: f32 = 1.0 / 60.0;

fn v(x: f32, y: f32) -> Vector2 {
    Vector2::new(x, y)
}

fn precise(gravity: f32) -> PhysicsSimulator {
    let mut simulator = PhysicsSimulator::new(v(0.0, gravity)).unwrap();
    simulator.set_methods(Methods::PRECISE).unwrap();
    simulator.set_iterations(4);
    simulator
}

fn add_box(simulator: &mut PhysicsSimulator, at: Vector2, [width, height]: [f32; 2]) -> BodyId {
    let body = BodyFactory::create_rectangle_body_in(simulator, width, height, 1.0).unwrap();
    simulator[body].set_position(at);
    simulator[body].set_linear_drag_coefficient(0.0);
    simulator[body].set_rotational_drag_coefficient(0.0);
    let placement = GeomPlacement::default();
    let geom = GeomFactory::create_rectangle_geom_in(simulator, body, width, height, placement).unwrap();
    simulator[geom].set_friction_coefficient(0.5);
    body
}

fn add_static(simulator: &mut PhysicsSimulator, at: Vector2, size: [f32; 2]) -> BodyId {
    let body = add_box(simulator, at, size);
    simulator[body].set_is_static(true);
    body
}

/// A static body without a geom.
fn add_post(simulator: &mut PhysicsSimulator, at: Vector2) -> BodyId {
    let body = BodyFactory::create_body_in(simulator, 1.0, 1.0).unwrap();
    simulator[body].set_position(at);
    simulator[body].set_is_static(true);
    body
}

fn run(simulator: &mut PhysicsSimulator, seconds: f32) {
    run_by(simulator, seconds, DT);
}

fn run_by(simulator: &mut PhysicsSimulator, seconds: f32, dt: f32) {
    (0..(seconds / dt).round() as usize).for_each(|_| simulator.update(dt));
}

/// A lever of 40 px that hangs on a post by its left end, horizontally, with a motor.
fn lever(simulator: &mut PhysicsSimulator, speed: f32, greatest_effort: f32) -> (BodyId, JointId) {
    let post = add_post(simulator, v(0.0, 0.0));
    let lever = add_box(simulator, v(20.0, 0.0), [40.0, 8.0]);
    let joint = JointFactory::create_revolute_joint_in(simulator, post, lever, v(0.0, 0.0)).unwrap();
    simulator.set_joint_motor(joint, Some(JointMotor { speed, greatest_effort })).unwrap();
    (lever, joint)
}

#[test]
fn a_slow_motor_turns_as_far_as_its_speed_says() {
    for (speed, dt) in [(0.05, DT), (-0.002, DT), (0.05, 1.0 / 30.0), (0.05, 1.0 / 120.0)] {
        let mut simulator = precise(900.0);
        let (_, joint) = lever(&mut simulator, speed, 1e6);
        run_by(&mut simulator, 10.0, dt);
        let turned = simulator.joint_travel(joint).unwrap();
        // Measured: within 1e-3 of it.
        assert!((turned / (10.0 * speed) - 1.0).abs() < 0.005, "{turned} of {}", 10.0 * speed);
    }
}

#[test]
fn the_body_of_a_motor_at_its_limit_or_too_weak_sleeps() {
    let mut simulator = precise(900.0);
    let (at_rest, _) = lever(&mut simulator, 0.0, 1e6);
    run(&mut simulator, 3.0);
    assert!(simulator.is_asleep(at_rest));

    let mut simulator = precise(900.0);
    let (at_limit, joint) = lever(&mut simulator, 0.05, 1e6);
    simulator.set_joint_limits(joint, Some(JointLimits { lower: -0.1, upper: 0.1 })).unwrap();
    run(&mut simulator, 6.0);
    assert!((simulator.joint_travel(joint).unwrap() - 0.1).abs() < 1e-3);
    assert!(simulator.is_asleep(at_limit));
    // An edit of the motor wakes it.
    simulator.set_joint_motor(joint, Some(JointMotor { speed: -0.01, greatest_effort: 1e6 })).unwrap();
    run(&mut simulator, 10.0);
    assert!(simulator.joint_travel(joint).unwrap().abs() < 2e-3);

    // Its left end is down on a block, and loads that.
    let mut simulator = precise(900.0);
    let (blocked, joint) = lever(&mut simulator, 0.5, 3e4);
    add_static(&mut simulator, v(35.0, 20.0), [10.0, 20.0]);
    run(&mut simulator, 6.0);
    assert!(simulator.joint_travel(joint).unwrap() < 0.25);
    assert!(simulator.is_asleep(blocked), "{:?}", simulator.why_awake(blocked));
}

#[test]
fn a_slow_prismatic_motor_moves_its_body_and_the_load_on_it() {
    let mut simulator = precise(900.0);
    let post = add_post(&mut simulator, v(0.0, 0.0));
    let table = add_box(&mut simulator, v(0.0, 0.0), [80.0, 10.0]);
    let joint =
        JointFactory::create_prismatic_joint_in(&mut simulator, post, table, v(0.0, 0.0), v(0.0, -1.0))
            .unwrap();
    simulator.set_joint_motor(joint, Some(JointMotor { speed: 0.5, greatest_effort: 1e6 })).unwrap();
    let on_it = add_box(&mut simulator, v(0.0, -15.0), [20.0, 20.0]);
    run(&mut simulator, 20.0);
    assert!((simulator[table].position().y + 10.0).abs() < 0.1, "{}", simulator[table].position().y);
    assert!((simulator[on_it].position().y + 25.0).abs() < 0.1);
}

/// A floor with its top at y = 0 and a surface velocity, and a box of 20 on it.
fn on_belt(speed: f32) -> (PhysicsSimulator, BodyId, BodyId) {
    let mut simulator = precise(900.0);
    let belt = add_static(&mut simulator, v(0.0, 20.0), [800.0, 40.0]);
    simulator[belt].set_linear_velocity(v(speed, 0.0));
    let body = add_box(&mut simulator, v(0.0, -10.0), [20.0, 20.0]);
    (simulator, belt, body)
}

#[test]
fn a_slow_belt_carries_a_stack_as_far_as_its_speed_says() {
    for (speed, dt) in [(1.0, DT), (-0.1, DT), (1.0, 1.0 / 30.0), (1.0, 1.0 / 120.0)] {
        let (mut simulator, _, body) = on_belt(speed);
        let high = add_box(&mut simulator, v(0.0, -30.0), [20.0, 20.0]);
        run_by(&mut simulator, 20.0, dt);
        for body in [body, high] {
            let carried = simulator[body].position().x;
            assert!((carried / (20.0 * speed) - 1.0).abs() < 0.02, "{carried} of {}", 20.0 * speed);
        }
    }
}

#[test]
fn a_slowly_starting_belt_wakes_its_load_and_a_stopped_one_does_not_keep_it_awake() {
    let (mut simulator, belt, body) = on_belt(0.0);
    run(&mut simulator, 2.0);
    assert!(simulator.is_asleep(body));
    simulator[belt].set_linear_velocity(v(1.0, 0.0));
    run(&mut simulator, 10.0);
    assert!((simulator[body].position().x - 10.0).abs() < 0.2, "{}", simulator[body].position().x);
    simulator[belt].set_linear_velocity(v(0.0, 0.0));
    run(&mut simulator, 2.0);
    assert!(simulator.is_asleep(body));
}

#[test]
fn a_wall_on_a_belt_holds_back_a_body_that_then_sleeps() {
    let (mut simulator, _, body) = on_belt(1.0);
    add_static(&mut simulator, v(25.0, -20.0), [20.0, 40.0]);
    run(&mut simulator, 10.0);
    assert!((simulator[body].position().x - 5.0).abs() < 0.1);
    assert!(simulator.is_asleep(body), "{:?}", simulator.why_awake(body));
}

#[test]
fn a_slow_kinematic_body_carries_the_bodies_on_it_and_joined_to_it() {
    let mut simulator = precise(900.0);
    let lift = add_box(&mut simulator, v(0.0, 5.0), [100.0, 10.0]);
    simulator[lift].set_is_kinematic(true);
    let on_it = add_box(&mut simulator, v(0.0, -10.0), [20.0, 20.0]);
    let pinned = add_box(&mut simulator, v(0.0, 60.0), [20.0, 20.0]);
    JointFactory::create_pin_joint_in(&mut simulator, lift, v(0.0, 0.0), pinned, v(0.0, 0.0)).unwrap();
    let sprung = add_box(&mut simulator, v(200.0, 90.0), [20.0, 20.0]);
    let hook = add_box(&mut simulator, v(200.0, 5.0), [10.0, 10.0]);
    simulator[hook].set_is_kinematic(true);
    SpringFactory::create_linear_spring_in(&mut simulator, hook, v(0.0, 0.0), sprung, v(0.0, 0.0), 20.0, 4.0)
        .unwrap();
    run(&mut simulator, 12.0);
    let bodies = [on_it, pinned, sprung];
    assert!(bodies.iter().all(|&body| simulator.is_asleep(body)));
    let before = bodies.map(|body| simulator[body].position().y);
    [lift, hook].into_iter().for_each(|body| simulator[body].set_linear_velocity(v(0.0, -0.5)));
    run(&mut simulator, 20.0);
    for (body, before) in bodies.into_iter().zip(before) {
        let moved = simulator[body].position().y - before;
        // Measured: within 0.01 px; the sprung body fell asleep 0.2 px from its equilibrium.
        assert!((moved + 10.0).abs() < 0.3, "{moved}");
        assert!(!simulator.is_asleep(body));
    }
}
