//! Tests free motion in the peers, and that it is the same in a second run.

use super::{G, PASSES, STEP, at, disc, geom, in_both, near, peers, run, scene, settings, weightless};
use conformance::scene::*;
use measure::world::masses;

#[test]
fn a_body_falls_by_half_g_t_squared() {
    let mut scene = scene();
    disc(&mut scene, [10.0, -50.0]);
    in_both(&scene, |name, world| {
        run(world, 2.0);
        let body = world.body(0);
        near(name, body.velocity[1], G * 2.0, 1e-3 * G);
        // The fall is a sum of the velocities at the ends of steps, which exceeds the parabola.
        near(name, body.position[1], -50.0 + G * 2.0, G * f64::from(STEP));
        near(name, body.position[0], 10.0, 1e-6);
    });
}

#[test]
fn linear_drag_ends_a_fall_at_its_terminal_speed() {
    let mut scene = scene();
    disc(&mut scene, [0.0, 0.0]);
    settings(&mut scene).linear_drag = Some(3.0);
    in_both(&scene, |name, world| {
        run(world, 1.0);
        let terminal = G * 2.0 / 3.0;
        let share = (-3.0_f64 / 2.0).exp();
        near(name, world.body(0).velocity[1], terminal * (1.0 - share), 3.0 * G * f64::from(STEP) / 2.0);
        run(world, 19.0);
        near(name, world.body(0).velocity[1], terminal, 3.0 * G * f64::from(STEP) / 2.0);
    });
}

#[test]
fn rotational_drag_brakes_with_the_square_of_the_angular_velocity() {
    let mut scene = weightless();
    for (x, rotational_drag) in [(0.0, Some(40.0)), (100.0, Some(0.0)), (200.0, None)] {
        disc(&mut scene, [x, 0.0]);
        settings(&mut scene).rotational_drag = rotational_drag;
        settings(&mut scene).angular_velocity = Some(-8.0);
    }
    let inertia = masses(&scene)[0].inertia;
    in_both(&scene, |name, world| {
        run(world, 3.0);
        let expected = -8.0 / (1.0 + 40.0 * 8.0 * 3.0 / inertia);
        near(name, world.body(0).angular_velocity, expected, 0.01);
        // The default drag coefficient of 0.001 would change the velocity by 4e-4 rad/s here. The peers get no drag in its
        // place.
        near(name, world.body(1).angular_velocity, -8.0, 1e-5);
        near(name, world.body(2).angular_velocity, -8.0, 1e-5);
    });
}

#[test]
fn angles_count_full_turns() {
    let mut scene = weightless();
    disc(&mut scene, [0.0, 0.0]);
    settings(&mut scene).angular_velocity = Some(30.0);
    scene.bodies[0].rotation = Some(20.0);
    in_both(&scene, |name, world| {
        for step in 1..=480 {
            world.step(STEP);
            // The engines advance a unit rotation along its tangent and normalize it. The angle of a substep is too small by (w
            // h)^3 / 3.
            let lack = (30.0 * f64::from(STEP) / f64::from(PASSES)).powi(3) / 3.0;
            let tolerance = f64::from(step) * f64::from(PASSES) * lack * 1.1 + 1e-4;
            near(name, world.body(0).angle, 20.0 + 30.0 * f64::from(step) * f64::from(STEP), tolerance);
        }
    });
}

#[test]
fn an_impulse_changes_the_velocity_by_itself_over_the_mass() {
    let mut scene = weightless();
    disc(&mut scene, [0.0, 0.0]);
    // The shape with an offset does not affect the mass or the centre of mass, which are the body's own.
    geom(&mut scene, GeomShape::Rectangle { width: 100.0, height: 100.0 }, 0.5, 0.0).offset =
        Some(at(9.0, 0.0));
    in_both(&scene, |name, world| {
        world.apply_impulse(0, [30.0, -8.0]);
        world.step(STEP);
        let body = world.body(0);
        near(name, body.velocity[0], 15.0, 1e-4);
        near(name, body.velocity[1], -4.0, 1e-4);
        near(name, body.angular_velocity, 0.0, 1e-6);
    });
}

#[test]
fn velocities_and_positions_can_be_set() {
    let mut scene = weightless();
    disc(&mut scene, [0.0, 0.0]);
    in_both(&scene, |name, world| {
        world.teleport(0, [640.0, -320.0], 9.0);
        world.set_velocity(0, [32.0, 0.0], -2.0);
        run(world, 1.0);
        let body = world.body(0);
        near(name, body.position[0], 672.0, 1e-2);
        near(name, body.position[1], -320.0, 1e-3);
        near(name, body.angle, 7.0, 1e-3);
    });
}

#[test]
fn a_run_is_the_same_every_time() {
    let scene = conformance::scenes::circles_in_a_pit(50);
    for peer in peers() {
        let states = || {
            let mut world = (peer.build)(&scene, peer.recommended).unwrap();
            run(&mut *world, 2.0);
            (0..world.body_count()).map(|index| world.body(index)).collect::<Vec<_>>()
        };
        let first = states();
        assert!(first.iter().all(|body| body.is_finite()), "{}", peer.name);
        assert_eq!(first, states(), "{}", peer.name);
    }
}
