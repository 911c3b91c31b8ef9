//! Positions of bodies between two updates.

use conformance::fixtures::depth::{ball, platform, run, simulator, throw, weightless};
use twohalf::{Drawable, InterpolatedPose3D, Interpolation3D, PlatformId, TwoHalfPhysicsSimulator, Vector3};

/// The interpolation of two updates of 0.01 s.
fn remembered(simulator: &mut TwoHalfPhysicsSimulator) -> Interpolation3D {
    let mut interpolation = Interpolation3D::new();
    for _ in 0..2 {
        run(simulator, 1);
        interpolation.remember(simulator);
    }
    interpolation
}

#[track_caller]
fn assert_place(pose: Option<InterpolatedPose3D>, expected: [f32; 3]) {
    let place = pose.unwrap().place;
    // Three steps and a product, of numbers up to 100.
    assert!((place - Vector3::from(expected)).norm() < 1e-4, "{place:?} {expected:?}");
}

#[test]
fn a_body_is_interpolated_between_two_updates_along_all_axes() {
    let mut simulator = weightless();
    let body = ball(&mut simulator, 10.0, [50.0, 60.0, 70.0]);
    simulator.update(0.0);
    throw(&mut simulator, body, [100.0, 200.0, -400.0]);
    let interpolation = remembered(&mut simulator);
    // Its origin is a radius above its lowest point.
    for (fraction, steps) in [(0.0, 1.0), (0.25, 1.25), (1.0, 2.0), (-3.0, 1.0), (7.0, 2.0), (f32::NAN, 2.0)]
    {
        let expected = [50.0 + steps, 70.0 + 2.0 * steps, 70.0 - 4.0 * steps];
        assert_place(interpolation.pose(Drawable::Body(body), fraction), expected);
    }
}

/// A platform 100 px up that rises by 1 px per update.
fn lift(simulator: &mut TwoHalfPhysicsSimulator) -> PlatformId {
    let lift = platform(simulator, [60.0, 10.0, 60.0], [0.0, 100.0, 30.0]);
    simulator.set_depth_scheme(twohalf::DepthScheme::Precise).unwrap();
    simulator.platform_mut(lift).unwrap().set_velocity(Vector3::new(0.0, 100.0, 0.0)).unwrap();
    lift
}

#[test]
fn a_platform_is_interpolated_between_two_updates() {
    let mut simulator = simulator();
    let lift = lift(&mut simulator);
    let first = simulator.platform(lift).unwrap().position3d();
    let interpolation = remembered(&mut simulator);
    let expected = first + Vector3::new(0.0, 1.5, 0.0);
    assert_place(interpolation.pose(Drawable::Platform(lift), 0.5), expected.into());
}

#[test]
fn a_platform_that_rotates_is_interpolated_along_the_shorter_arc() {
    let mut simulator = simulator();
    let lift = lift(&mut simulator);
    simulator.platform_mut(lift).unwrap().set_yaw(std::f32::consts::TAU - 0.004).unwrap();
    simulator.platform_mut(lift).unwrap().set_angular_velocity(0.4).unwrap();
    // A full turn counts as none from the first of these updates on.
    let interpolation = remembered(&mut simulator);
    let turned = interpolation.pose(Drawable::Platform(lift), 0.25).unwrap().yaw;
    assert!((turned - 0.001).abs() < 1e-5, "{turned}");
}

#[test]
fn rotations_are_interpolated_along_the_shorter_arc() {
    let mut simulator = weightless();
    let body = ball(&mut simulator, 10.0, [50.0, 60.0, 70.0]);
    simulator.update(0.0);
    let mut interpolation = Interpolation3D::new();
    for rotation in [0.1, std::f32::consts::TAU - 0.1] {
        simulator.body_mut(body).unwrap().set_rotation(rotation);
        interpolation.remember(&simulator);
    }
    let turned = interpolation.pose(Drawable::Body(body), 0.75).unwrap().rotation;
    assert!((turned + 0.05).abs() < 1e-5, "{turned}");
}

#[test]
fn teleported_and_new_bodies_are_drawn_at_their_pose_and_removed_ones_are_not() {
    let mut simulator = weightless();
    let lift = lift(&mut simulator);
    let bodies = [0, 1, 2].map(|at| ball(&mut simulator, 10.0, [100.0 * at as f32, 0.0, 70.0]));
    simulator.update(0.0);
    let mut interpolation = Interpolation3D::new();
    let [jumping, gliding, gone] = bodies.map(Drawable::Body);
    interpolation.remember(&simulator);
    interpolation.mark_teleport(jumping);
    for (body, x) in [(bodies[0], 500.0), (bodies[1], 900.0)] {
        simulator.body_mut(body).unwrap().set_position3d(Vector3::new(x, 0.0, 70.0));
    }
    simulator.remove(bodies[2]).unwrap();
    simulator.remove_platform(lift).unwrap();
    let new = ball(&mut simulator, 10.0, [700.0, 0.0, 70.0]);
    run(&mut simulator, 1);
    interpolation.remember(&simulator);
    assert_place(interpolation.pose(jumping, 0.5), [500.0, 10.0, 70.0]);
    assert_place(interpolation.pose(gliding, 0.5), [500.0, 10.0, 70.0]);
    assert_place(interpolation.pose(Drawable::Body(new), 0.5), [700.0, 10.0, 70.0]);
    assert_eq!([gone, Drawable::Platform(lift)].map(|thing| interpolation.pose(thing, 0.5)), [None; 2]);
    // It jumped once.
    simulator.body_mut(bodies[0]).unwrap().set_position3d(Vector3::new(600.0, 0.0, 70.0));
    run(&mut simulator, 1);
    interpolation.remember(&simulator);
    assert_place(interpolation.pose(jumping, 0.5), [550.0, 10.0, 70.0]);
    interpolation.clear();
    assert_eq!(interpolation.pose(jumping, 0.5), None);
}
