//! The precise set: bodies that joints and springs connect after an edit, awake or asleep.

use conformance::fixtures::plane::{add_level_floor, add_part, precise, run, state, v};
use farseer_core::{BodyId, JointFactory, PhysicsSimulator, SpringFactory};

/// Length units per second squared.
const GRAVITY: f32 = 300.0;
const DT: f32 = 1.0 / 60.0;

/// Connects the bodies A and B.
type Connect = fn(&mut PhysicsSimulator, BodyId, BodyId);

fn connections() -> [(&'static str, Connect); 4] {
    [
        ("weld", |simulator, a, b| {
            JointFactory::create_weld_joint_in(simulator, a, b, v(0.0, 20.0)).unwrap();
        }),
        ("hinge", |simulator, a, b| {
            JointFactory::create_revolute_joint_in(simulator, a, b, v(0.0, 20.0)).unwrap();
        }),
        ("pin", |simulator, a, b| {
            JointFactory::create_pin_joint_in(simulator, a, v(0.0, 0.0), b, v(0.0, 0.0)).unwrap();
        }),
        ("weld and hinge", |simulator, a, b| {
            JointFactory::create_weld_joint_in(simulator, a, b, v(0.0, 20.0)).unwrap();
            JointFactory::create_revolute_joint_in(simulator, a, b, v(0.0, 20.0)).unwrap();
        }),
    ]
}

/// B hangs on A, which does not move, and sleeps.
fn sleeping_pair(
    connect: Connect,
    fix: fn(&mut PhysicsSimulator, BodyId),
) -> (PhysicsSimulator, [BodyId; 2]) {
    let mut simulator = precise(GRAVITY);
    let a = add_part(&mut simulator, v(0.0, 0.0), [20.0, 20.0], 1.0);
    let b = add_part(&mut simulator, v(0.0, 40.0), [20.0, 20.0], 1.0);
    fix(&mut simulator, a);
    connect(&mut simulator, a, b);
    run(&mut simulator, 180);
    assert!(simulator.is_asleep(b));
    (simulator, [a, b])
}

/// Both fall freely for a second, without drag.
fn assert_both_fall(case: &str, simulator: &mut PhysicsSimulator, bodies: [BodyId; 2]) {
    let before = bodies.map(|body| simulator[body].position().y);
    (0..60).for_each(|_| simulator.update(DT));
    for (body, before) in bodies.into_iter().zip(before) {
        let fallen = simulator[body].position().y - before;
        // g t^2 / 2 in closed form, up to g t (t + dt) / 2 with the symplectic Euler method, and a step to wake.
        assert!((145.0..153.0).contains(&fallen), "{case}: fell by {fallen}");
    }
}

#[test]
fn a_static_body_that_becomes_dynamic_wakes_the_bodies_joined_to_it() {
    for (name, connect) in connections() {
        let (mut simulator, bodies) = sleeping_pair(connect, |simulator, a| simulator[a].set_is_static(true));
        simulator[bodies[0]].set_is_static(false);
        assert_both_fall(name, &mut simulator, bodies);
    }
}

#[test]
fn a_kinematic_body_that_becomes_dynamic_wakes_the_bodies_joined_to_it() {
    for (name, connect) in connections() {
        let (mut simulator, bodies) =
            sleeping_pair(connect, |simulator, a| simulator[a].set_is_kinematic(true));
        simulator[bodies[0]].set_is_kinematic(false);
        assert_both_fall(name, &mut simulator, bodies);
    }
}

/// A restored twin goes on with the same bits.
fn assert_twin_goes_on(mut simulator: PhysicsSimulator, edit: impl Fn(&mut PhysicsSimulator)) {
    let mut twin = PhysicsSimulator::default();
    twin.restore(&simulator.snapshot()).unwrap();
    for each in [&mut simulator, &mut twin] {
        edit(each);
        run(each, 30);
    }
    assert!(state(&simulator) == state(&twin));
}

#[test]
fn a_spring_that_is_set_to_another_body_acts_on_that_one() {
    for is_angle in [false, true] {
        let mut simulator = precise(GRAVITY);
        add_level_floor(&mut simulator);
        let bodies = [-100.0, 0.0, 100.0].map(|x| add_part(&mut simulator, v(x, -10.0), [20.0, 20.0], 1.0));
        let [a, b, c] = bodies;
        let origin = v(0.0, 0.0);
        let spring = match is_angle {
            true => SpringFactory::create_angle_spring_in(&mut simulator, a, b, 2000.0, 10.0),
            false => SpringFactory::create_linear_spring_in(&mut simulator, a, origin, b, origin, 20.0, 1.0),
        };
        let spring = spring.unwrap();
        run(&mut simulator, 20);
        simulator[c].set_rotation(0.3);
        simulator[c].set_position(v(130.0, -20.0));
        run(&mut simulator, 2);
        assert_twin_goes_on(simulator, |simulator| simulator.set_spring_body2(spring, c).unwrap());
    }
}

#[test]
fn a_joint_that_is_set_to_another_body_holds_that_one() {
    let mut simulator = precise(GRAVITY);
    add_level_floor(&mut simulator);
    let [a, b, c] = [-100.0, 0.0, 100.0].map(|x| add_part(&mut simulator, v(x, -10.0), [20.0, 20.0], 1.0));
    let origin = v(0.0, 0.0);
    let joint =
        JointFactory::create_slider_joint_in(&mut simulator, a, origin, b, origin, 0.0, 120.0).unwrap();
    run(&mut simulator, 20);
    simulator[c].set_linear_velocity(v(100.0, 0.0));
    assert_twin_goes_on(simulator, |simulator| simulator.set_joint_body2(joint, c).unwrap());
}
