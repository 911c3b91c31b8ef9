//! Tests that limits, motors and sliders of joint scenes act in the peers as in our engine.

use super::{PASSES, STEP, near, run};
use measure::joints::assembly::{Assembly, Form, JointKind};
use measure::joints::engines::{SETTING, engines};
use measure::joints::family::family;
use measure::method::Setting;
use measure::world::World;

/// Gravity, px/s².
const G: f32 = 320.0;

/// Runs `check` on an assembly in each of the three engines: ours, `rapier2d` and Box2D.
fn in_all(assembly: &Assembly, check: impl Fn(&str, &mut dyn World)) {
    let engines = engines();
    assert_eq!(engines.len(), 3);
    for engine in engines {
        let world = (engine.build)(assembly, Setting::fixed(STEP, PASSES));
        let mut world = world.unwrap_or_else(|reason| panic!("{}: {reason}", engine.name));
        check(engine.name, &mut *world);
    }
}

#[test]
fn every_scene_is_built_in_every_engine() {
    for scene in family().iter().filter(|scene| !scene.is_large) {
        for engine in engines() {
            let world = (engine.build)(&scene.assembly, SETTING);
            let count = world.map(|world| world.body_count());
            assert_eq!(count, Ok(scene.assembly.bodies.len()), "{}, {}", scene.name, engine.name);
        }
    }
}

#[test]
fn limits_of_a_hinge_count_from_the_angle_at_the_start() {
    let mut assembly = Assembly::new(G, 0.5);
    let post = assembly.post([0.0, 0.0]);
    assembly.bodies[post].angle = 0.7;
    let bar = assembly.rectangle([40.0, 0.0], [80.0, 20.0], 1.0, 1);
    assembly.bodies[bar].angle = -1.0;
    let kind = JointKind::Hinge { anchor: [0.0, 0.0], limits: Some([-0.2, 0.4]), motor: None };
    assembly.joint(post, bar, kind);
    in_all(&assembly, |name, world| {
        run(world, 4.0);
        near(name, world.body(bar).angle, -1.0 + 0.4, 0.01);
        near(
            name,
            world.body(bar).position_in_plane()[0].hypot(world.body(bar).position_in_plane()[1]),
            40.0,
            0.05,
        );
    });
}

#[test]
fn a_motor_of_a_hinge_speeds_up_by_its_torque_until_it_has_its_speed() {
    let mut assembly = Assembly::new(0.0, 0.5);
    let post = assembly.post([0.0, 0.0]);
    let wheel = assembly.body([0.0, 0.0], Form::Circle(20.0), 2.0, 1);
    // The moment of inertia is 400 kg px², so the motor accelerates by 2 rad/s².
    let kind = JointKind::Hinge { anchor: [0.0, 0.0], limits: None, motor: Some([5.0, 800.0]) };
    assembly.joint(post, wheel, kind);
    in_all(&assembly, |name, world| {
        run(world, 1.0);
        near(name, world.body(wheel).angular_velocity, 2.0, 0.02);
        run(world, 3.0);
        near(name, world.body(wheel).angular_velocity, 5.0, 0.02);
    });
}

#[test]
fn a_slider_falls_along_its_axis_and_does_not_turn() {
    let mut assembly = Assembly::new(G, 0.5);
    let post = assembly.post([0.0, 0.0]);
    assembly.bodies[post].angle = -0.4;
    let load = assembly.rectangle([30.0, 0.0], [20.0, 10.0], 1.0, 1);
    assembly.bodies[load].angle = 1.1;
    // The axis descends at 30 degrees: the acceleration along it is half of gravity.
    let axis = [0.75_f32.sqrt(), 0.5];
    assembly.slider(post, load, [0.0, 0.0], axis);
    in_all(&assembly, |name, world| {
        run(world, 1.0);
        let [x, y] = world.body(load).position_in_plane();
        let [ax, ay] = axis.map(f64::from);
        near(name, (x - 30.0) * ax + y * ay, 80.0, 160.0 * f64::from(STEP));
        near(name, (x - 30.0) * ay - y * ax, 0.0, 0.05);
        near(name, world.body(load).angle, 1.1, 0.01);
    });
}
