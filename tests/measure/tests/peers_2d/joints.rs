//! Tests joints in the peers, and the angles that joints hold or leave free.

use super::{
    G, PASSES, STEP, at, body, disc, in_both, joint, near, period, refusals, run, scene, settings, weightless,
};
use conformance::scene::*;
use measure::engines::peers_2d::box2d_methods;
use measure::method::Setting;
use measure::world::masses;
use std::f64::consts::TAU;

/// Returns a scene with a bar that hangs from a joint at (0, 0), and the period of its small swings in s. The bar hangs 160 px
/// down and 0.1 rad aside.
fn pendulum() -> (Scene, f64) {
    let mut scene = scene();
    let (x, y) = (160.0 * 0.1_f64.sin(), 160.0 * 0.1_f64.cos());
    body(&mut scene, BodyShape::Rectangle { width: 200.0, height: 100.0, mass: 2.0 }, [x as f32, y as f32]);
    let mass = masses(&scene)[0];
    let inertia = mass.inertia + mass.mass * 160.0 * 160.0;
    let small = TAU * (inertia / (mass.mass * G * 160.0)).sqrt();
    // The correction of the period is the first term of its series in the amplitude.
    (scene, small * (1.0 + 0.1 * 0.1 / 16.0))
}

#[test]
fn a_pendulum_has_its_period() {
    let (mut scene, expected) = pendulum();
    joint(&mut scene, JointKind::FixedRevolute { body: 0, anchor: at(0.0, 0.0) });
    in_both(&scene, |name, world| {
        near(name, period(world, 20.0, |world| world.body(0).position[0]), expected, 2e-3 * expected);
    });
}

#[test]
fn a_revolute_joint_to_a_static_body_is_one_to_the_world() {
    let (mut scene, expected) = pendulum();
    disc(&mut scene, [-70.0, 30.0]);
    scene.bodies[1].is_static = Some(true);
    scene.bodies[1].rotation = Some(1.0);
    joint(&mut scene, JointKind::Revolute { body1: 1, body2: 0, anchor: at(0.0, 0.0) });
    in_both(&scene, |name, world| {
        near(name, period(world, 20.0, |world| world.body(0).position[0]), expected, 2e-3 * expected);
    });
}

#[test]
fn a_bob_on_a_pin_joint_has_its_period_and_keeps_its_distance() {
    let mut scene = scene();
    disc(&mut scene, [0.0, -20.0]);
    scene.bodies[0].is_static = Some(true);
    let (x, y) = (160.0 * 0.1_f64.sin(), 160.0 * 0.1_f64.cos());
    disc(&mut scene, [x as f32, y as f32]);
    let anchor1 = at(0.0, 20.0);
    joint(&mut scene, JointKind::Pin { body1: 0, body2: 1, anchor1, anchor2: at(0.0, 0.0) });
    let expected = TAU * (160.0 / G).sqrt() * (1.0 + 0.1 * 0.1 / 16.0);
    in_both(&scene, |name, world| {
        near(name, period(world, 20.0, |world| world.body(1).position[0]), expected, 2e-3 * expected);
        let [x, y] = world.body(1).position_in_plane();
        near(name, x.hypot(y), 160.0, 0.1);
    });
}

#[test]
fn a_slider_joint_from_zero_on_is_a_rope() {
    let mut scene = scene();
    disc(&mut scene, [0.0, 0.0]);
    scene.bodies[0].is_static = Some(true);
    disc(&mut scene, [0.0, 20.0]);
    let (anchor1, anchor2) = (at(0.0, 0.0), at(0.0, 0.0));
    joint(&mut scene, JointKind::Slider { body1: 0, body2: 1, anchor1, anchor2, min: 0.0, max: 100.0 });
    in_both(&scene, |name, world| {
        run(world, 0.5);
        near(name, world.body(1).position[1], 20.0 + G * 0.125, G * f64::from(STEP));
        run(world, 5.0);
        near(name, world.body(1).position[1], 100.0, 0.1);
    });
}

#[test]
fn box2d_has_minimum_distances_and_rapier_refuses_them() {
    let mut scene = scene();
    disc(&mut scene, [0.0, 0.0]);
    scene.bodies[0].is_static = Some(true);
    disc(&mut scene, [0.0, -60.0]);
    let (anchor1, anchor2) = (at(0.0, 0.0), at(0.0, 0.0));
    joint(&mut scene, JointKind::Slider { body1: 0, body2: 1, anchor1, anchor2, min: 40.0, max: 100.0 });
    let [rapier, box2d] = refusals(&scene);
    assert_eq!((rapier.as_deref(), box2d), (Some("no joints with a least distance"), None));
    let mut world = (box2d_methods()[0].build)(&scene, Setting::fixed(STEP, PASSES)).unwrap();
    run(&mut *world, 1.0);
    near("Box2D", world.body(1).position[1], -40.0, 0.2);
}

#[test]
fn welded_bodies_move_as_one() {
    let mut scene = weightless();
    disc(&mut scene, [0.0, 0.0]);
    disc(&mut scene, [64.0, 0.0]);
    scene.bodies[1].rotation = Some(0.5);
    joint(&mut scene, JointKind::Weld { body1: 0, body2: 1, anchor: at(32.0, 10.0) });
    in_both(&scene, |name, world| {
        world.apply_impulse(0, [0.0, 64.0]);
        run(world, 4.0);
        let (one, two) = (world.body(0), world.body(1));
        near(name, two.angle - one.angle, 0.5, 0.01);
        near(name, (two.position[0] - one.position[0]).hypot(two.position[1] - one.position[1]), 64.0, 0.3);
        near(name, one.velocity[1] + two.velocity[1], 32.0, 0.01);
        assert!(one.angle.abs() > 0.5, "{name}: they turned by {}", one.angle);
    });
}

#[test]
fn an_angle_joint_constrains_the_angle_alone() {
    let mut scene = weightless();
    disc(&mut scene, [0.0, 0.0]);
    disc(&mut scene, [100.0, 0.0]);
    scene.bodies[1].rotation = Some(0.3);
    joint(&mut scene, JointKind::Angle { body1: 0, body2: 1 }).settings.target_angle = Some(0.3);
    settings(&mut scene).angular_velocity = Some(4.0);
    settings(&mut scene).linear_velocity = Some(at(10.0, 0.0));
    in_both(&scene, |name, world| {
        run(world, 2.0);
        let (one, two) = (world.body(0), world.body(1));
        near(name, two.angle - one.angle, 0.3, 0.02);
        // The common angular momentum of both bodies is kept.
        near(name, one.angular_velocity, 2.0, 0.02);
        near(name, two.position[0], 120.0, 0.05);
        near(name, one.position[0], 0.0, 0.01);
    });
}

#[test]
fn a_fixed_angle_joint_turns_a_body_to_its_angle() {
    let mut scene = weightless();
    disc(&mut scene, [0.0, 0.0]);
    joint(&mut scene, JointKind::FixedAngle { body: 0 }).settings.target_angle = Some(1.0);
    in_both(&scene, |name, world| {
        run(world, 3.0);
        near(name, world.body(0).angle, 1.0, 0.02);
    });
}

#[test]
fn angle_limits_stop_a_revolute_joint() {
    let mut scene = scene();
    disc(&mut scene, [0.0, 0.0]);
    scene.bodies[0].is_static = Some(true);
    body(&mut scene, BodyShape::Rectangle { width: 80.0, height: 20.0, mass: 1.0 }, [40.0, 0.0]);
    joint(&mut scene, JointKind::Revolute { body1: 0, body2: 1, anchor: at(0.0, 0.0) });
    let limits = (-0.2, 0.4);
    joint(
        &mut scene,
        JointKind::AngleLimit { body1: 0, body2: 1, lower_limit: limits.0, upper_limit: limits.1 },
    );
    in_both(&scene, |name, world| {
        run(world, 4.0);
        near(name, world.body(1).angle, 0.4, 0.01);
    });
}
