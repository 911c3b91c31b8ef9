//! Tests features that the peers lack, refuse or limit.

use super::{at, body, disc, floor, geom, in_both, joint, near, refusals, run, scene, settings, weightless};
use conformance::scene::*;

#[test]
fn features_that_no_peer_has_are_refused_with_a_reason() {
    type Change = fn(&mut Scene);
    let changes: [(Change, &str); 7] = [
        (|scene| settings(scene).quadratic_drag_enabled = Some(true), "no quadratic drag"),
        (|scene| scene.bodies[0].is_static = Some(true), "no static bodies with a velocity"),
        (|scene| settings(scene).enabled = Some(false), "no bodies that do not take part"),
        (|scene| scene.geoms[0].settings.sensor = Some(true), "no sensors"),
        (|scene| scene.geoms[0].ignore = vec![0], "no geoms that ignore others"),
        (|scene| scene.joints[0].settings.breakpoint = Some(3.0), "no joints that break by their error"),
        (|scene| scene.joints[0].settings.softness = Some(0.1), "no soft joints"),
    ];
    let mut scene = scene();
    disc(&mut scene, [0.0, 0.0]);
    settings(&mut scene).linear_velocity = Some(at(1.0, 0.0));
    geom(&mut scene, GeomShape::Circle { radius: 16.0, edges: 8 }, 0.5, 0.0);
    joint(&mut scene, JointKind::FixedRevolute { body: 0, anchor: at(0.0, 0.0) });
    assert_eq!(refusals(&scene), [None, None]);
    for (change, reason) in changes {
        let mut scene = scene.clone();
        change(&mut scene);
        let reason = Some(reason.to_owned());
        assert_eq!(refusals(&scene), [reason.clone(), reason]);
    }
}

#[test]
fn box2d_has_angle_limits_in_revolute_joints_alone() {
    let mut scene = scene();
    disc(&mut scene, [0.0, 0.0]);
    joint(&mut scene, JointKind::FixedAngleLimit { body: 0, lower_limit: -1.0, upper_limit: 1.0 });
    let reason = "no angle limits without a revolute joint".to_owned();
    assert_eq!(refusals(&scene), [None, Some(reason)]);
}

#[test]
fn a_bullet_does_not_pass_a_thin_static_wall() {
    let mut scene = weightless();
    let (width, height) = (4.0, 400.0);
    body(&mut scene, BodyShape::Rectangle { width, height, mass: 1.0 }, [500.0, 0.0]);
    scene.bodies[0].is_static = Some(true);
    geom(&mut scene, GeomShape::Rectangle { width, height }, 0.5, 0.0);
    body(&mut scene, BodyShape::Circle { radius: 4.0, mass: 1.0 }, [0.0, 0.0]);
    settings(&mut scene).linear_velocity = Some(at(6000.0, 0.0));
    geom(&mut scene, GeomShape::Circle { radius: 4.0, edges: 8 }, 0.5, 0.0);
    in_both(&scene, |name, world| {
        run(world, 0.5);
        near(name, world.body(1).position[0], 494.0, 1.0);
    });
}

#[test]
fn speeds_above_the_limit_of_the_peers_are_refused_and_lower_ones_are_kept() {
    let thrown = |speed: f32| {
        let mut scene = weightless();
        disc(&mut scene, [0.0, 0.0]);
        settings(&mut scene).linear_velocity = Some(at(speed, 0.0));
        scene
    };
    let refused = Some("no speeds over 12800 px/s".to_owned());
    assert_eq!(refusals(&thrown(12_801.0)), [refused.clone(), refused]);
    in_both(&thrown(12_799.0), |name, world| {
        run(world, 0.1);
        near(name, world.body(0).velocity[0], 12_799.0, 1.0);
    });
}

#[test]
fn impulses_accelerate_no_body_beyond_400_m_per_second() {
    let mut scene = weightless();
    disc(&mut scene, [0.0, 0.0]);
    in_both(&scene, |name, world| {
        world.apply_impulse(0, [1e6, 0.0]);
        run(world, 0.1);
        near(name, world.body(0).velocity[0], 400.0 * 32.0, 1.0);
    });
}

#[test]
fn box2d_has_no_restitution_below_1_m_per_second() {
    for (speed, after) in [(31.0, [-31.0, 0.0]), (33.0, [-33.0, -33.0])] {
        let mut scene = weightless();
        floor(&mut scene, 0.0, 1.0);
        let ball = disc(&mut scene, [0.0, -20.0]);
        settings(&mut scene).linear_velocity = Some(at(0.0, speed));
        geom(&mut scene, GeomShape::Circle { radius: 16.0, edges: 16 }, 0.0, 1.0);
        in_both(&scene, |name, world| {
            run(world, 1.0);
            near(name, world.body(ball).velocity[1], after[usize::from(name == "Box2D 3")], 0.5);
        });
    }
}

#[test]
fn a_nan_velocity_affects_only_its_body() {
    let mut scene = scene();
    disc(&mut scene, [0.0, 0.0]);
    geom(&mut scene, GeomShape::Circle { radius: 16.0, edges: 8 }, 0.5, 0.0);
    in_both(&scene, |name, world| {
        world.set_velocity(0, [f64::NAN, 0.0], 0.0);
        run(world, 0.5);
        let body = world.body(0);
        // Box2D refuses the edit and goes on without it.
        assert!(name != "Box2D 3" || body.is_finite(), "{body:?}");
    });
}
