//! Tests shapes, friction and restitution in the peers.

use super::{G, STEP, at, body, disc, floor, geom, in_both, near, run, scene, settings, weightless};
use conformance::scene::*;
use std::f64::consts::PI;

#[test]
fn restitution_is_the_mean_of_both() {
    let mut scene = scene();
    floor(&mut scene, 0.0, 1.0);
    let ball = disc(&mut scene, [0.0, -16.0 - 160.0]);
    geom(&mut scene, GeomShape::Circle { radius: 16.0, edges: 3 }, 0.0, 0.0);
    in_both(&scene, |name, world| {
        let fall = (2.0 * 160.0 / G).sqrt();
        run(world, fall * 1.2);
        let mut top = f64::INFINITY;
        for _ in 0..240 {
            world.step(STEP);
            top = top.min(world.body(ball).position[1]);
        }
        // The impact is up to a step early or late, and the height changes by the path of that step.
        near(name, top, -16.0 - 160.0 / 4.0, 2.0 * G * fall * f64::from(STEP));
    });
}

/// Asserts that a box with an initial speed of 200 px/s slides by v^2 / (2 mu g), where mu is `friction`. `rule` combines the
/// two friction coefficients, 0.9 and 0.1.
fn slides(rule: Option<Friction>, friction: f64) {
    let mut scene = scene();
    scene.simulator.solver.friction_type = rule;
    floor(&mut scene, 0.9, 0.0);
    let (width, height) = (64.0, 16.0);
    let index = body(&mut scene, BodyShape::Rectangle { width, height, mass: 1.0 }, [0.0, -8.0]);
    settings(&mut scene).linear_velocity = Some(at(200.0, 0.0));
    geom(&mut scene, GeomShape::Rectangle { width, height }, 0.1, 0.0);
    in_both(&scene, |name, world| {
        let (time, distance) = (200.0 / (friction * G), 200.0 * 200.0 / (2.0 * friction * G));
        run(world, time + 0.5);
        near(name, world.body(index).position[0], distance, 0.04 * distance);
        near(name, world.body(index).velocity[0], 0.0, 0.5);
    });
}

#[test]
fn friction_is_the_mean_of_both() {
    slides(None, 0.5);
}

#[test]
fn friction_is_the_lesser_one_if_the_scene_says_so() {
    slides(Some(Friction::Minimum), 0.1);
}

#[test]
fn a_circle_is_a_circle_however_few_edges_it_has() {
    let mut scene = scene();
    floor(&mut scene, 0.5, 0.0);
    let ball = disc(&mut scene, [0.0, -20.0]);
    geom(&mut scene, GeomShape::Circle { radius: 16.0, edges: 3 }, 0.5, 0.0);
    settings(&mut scene).angular_velocity = Some(1.0);
    in_both(&scene, |name, world| {
        run(world, 2.0);
        // Friction makes the disc roll: its velocity is its angular velocity times the radius of its shape.
        near(name, world.body(ball).position[1], -16.0, 0.2);
        near(name, world.body(ball).velocity[0], world.body(ball).angular_velocity * 16.0, 0.5);
    });
}

#[test]
fn a_geom_is_at_its_offset() {
    let mut scene = scene();
    floor(&mut scene, 0.5, 0.0);
    let index = body(&mut scene, BodyShape::Rectangle { width: 64.0, height: 32.0, mass: 1.0 }, [0.0, -60.0]);
    // The geom is turned by a right angle, so its width of 20 px is vertical. The body comes to lie turned: its point at x = 40
    // is 40 px below the centre.
    let box_ = geom(&mut scene, GeomShape::Rectangle { width: 20.0, height: 64.0 }, 0.5, 0.0);
    box_.offset = Some(at(40.0, 0.0));
    box_.rotation_offset = Some((PI / 2.0) as f32);
    in_both(&scene, |name, world| {
        run(world, 2.0);
        near(name, world.body(index).position[1], -50.0, 0.2);
        near(name, world.body(index).angle, 0.0, 0.01);
    });
}

#[test]
fn a_notch_is_hollow() {
    let mut scene = scene();
    // The outline is a channel: 40 px wide, its bottom at y = -20, its walls up to y = -80.
    let points = [
        (-60.0, 0.0),
        (-60.0, -80.0),
        (-20.0, -80.0),
        (-20.0, -20.0),
        (20.0, -20.0),
        (20.0, -80.0),
        (60.0, -80.0),
        (60.0, 0.0),
    ];
    let points = points.map(|(x, y)| at(x, y)).to_vec();
    body(&mut scene, BodyShape::Explicit { mass: 1.0, moment_of_inertia: 1.0 }, [0.0, 0.0]);
    scene.bodies[0].is_static = Some(true);
    let outline = Outline { form: OutlineForm::Points { points }, subdivide: Some(7.0) };
    geom(&mut scene, GeomShape::Raw { outline }, 0.5, 0.0);
    let ball = disc(&mut scene, [0.0, -120.0]);
    geom(&mut scene, GeomShape::Circle { radius: 16.0, edges: 16 }, 0.5, 0.0);
    in_both(&scene, |name, world| {
        run(world, 3.0);
        near(name, world.body(ball).position[1], -36.0, 0.3);
    });
}

#[test]
fn polygons_of_many_corners_keep_their_height() {
    let mut scene = scene();
    floor(&mut scene, 0.5, 0.0);
    let outline = Outline { form: OutlineForm::Circle { radius: 64.0, edges: 20 }, subdivide: None };
    let index = body(&mut scene, BodyShape::Polygon { outline: outline.clone(), mass: 1.0 }, [0.0, -70.0]);
    settings(&mut scene).rotational_drag = Some(100_000.0);
    geom(&mut scene, GeomShape::Polygon { outline }, 0.5, 0.0);
    in_both(&scene, |name, world| {
        run(world, 4.0);
        // The polygon lies on an edge or balances on a corner.
        let height = -world.body(index).position[1];
        let edge = 64.0 * (PI / 20.0).cos();
        assert!((edge - 0.5..64.5).contains(&height), "{name}: {height}");
    });
}

#[test]
fn shapes_of_one_group_do_not_collide() {
    let mut scene = weightless();
    for (x, group) in [(0.0, 7), (100.0, 7), (1000.0, 7), (1100.0, -7), (2000.0, 0), (2100.0, 0)] {
        disc(&mut scene, [x, 0.0]);
        let speed = if x % 1000.0 == 0.0 { 100.0 } else { 0.0 };
        settings(&mut scene).linear_velocity = Some(at(speed, 0.0));
        let shape = GeomShape::Circle { radius: 16.0, edges: 16 };
        geom(&mut scene, shape, 0.0, 0.0).settings.collision_group = Some(group);
    }
    in_both(&scene, |name, world| {
        run(world, 3.0);
        near(name, world.body(0).velocity[0], 100.0, 1e-3);
        near(name, world.body(1).velocity[0], 0.0, 1e-3);
        for hit in [2, 4] {
            near(name, world.body(hit).velocity[0], 50.0, 1.0);
            near(name, world.body(hit + 1).velocity[0], 50.0, 1.0);
        }
    });
}
