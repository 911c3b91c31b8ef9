//! Slopes along Z, and platforms that are turned about an upright axis, or turn about it.

use conformance::fixtures::depth::{
    DT, GRAVITY, assert_goes_on_after_loading, place, run, simulator, throw, weightless, with_scheme,
};
use twohalf::{
    BodyId, ContactTarget, DepthScheme, Footprint, Platform, PlatformId, TwoHalfPhysicsSimulator, Vector2,
    Vector3,
};
use twohalf_factories::{Ball, Capsule, Cylinder, Prism, Thing, spawn};

fn precise(test: impl FnOnce()) {
    with_scheme(DepthScheme::Precise, test);
}

fn put(simulator: &mut TwoHalfPhysicsSimulator, thing: Thing, at: [f32; 3]) -> BodyId {
    let body = spawn(simulator, thing.at(at)).unwrap().body;
    let mut view = simulator.body_mut(body).unwrap();
    view.core_mut().set_linear_drag_coefficient(0.0);
    view.core_mut().set_rotational_drag_coefficient(0.0);
    body
}

fn platform(
    simulator: &mut TwoHalfPhysicsSimulator,
    size: [f32; 3],
    at: [f32; 3],
    friction: f32,
) -> PlatformId {
    let [width, height, depth] = size;
    let id = Platform::new(simulator, width, height, depth, at.into(), None).unwrap();
    simulator.platform_mut(id).unwrap().set_friction_coefficient(friction);
    id
}

fn velocity(simulator: &TwoHalfPhysicsSimulator, body: BodyId) -> Vector3 {
    simulator.body(body).unwrap().velocity3d()
}

#[track_caller]
fn assert_near(found: f32, wanted: f32, tolerance: f32) {
    assert!((found - wanted).abs() <= tolerance, "{found}, not {wanted}");
}

fn wedge() -> Footprint {
    Footprint::new(&[[-20.0, -10.0], [20.0, -10.0], [0.0, 20.0]].map(Vector2::from)).unwrap()
}

/// The sliding bodies, in four shapes.
fn sliders() -> [Thing; 4] {
    [
        Cylinder::new(10.0, 40.0),
        Capsule::new(10.0, 40.0),
        Prism::footprint(wedge(), 40.0),
        Prism::new([20.0, 20.0, 20.0]),
    ]
}

#[test]
fn bodies_slide_down_a_slope_along_z_by_the_law_of_friction() {
    precise(|| {
        for thing in sliders() {
            for friction in [0.0, 0.2] {
                let mut simulator = simulator();
                let pitch = 0.4f32;
                let id = platform(&mut simulator, [200.0, 20.0, 800.0], [0.0, 200.0, 500.0], friction);
                simulator.platform_mut(id).unwrap().set_pitch(pitch).unwrap();
                let top = 220.0 + (700.0 + 20.0 - 500.0) * pitch.tan();
                let body = put(&mut simulator, thing.friction(friction), [0.0, top + 0.3, 700.0]);
                run(&mut simulator, 100);
                let before = velocity(&simulator, body).norm();
                run(&mut simulator, 100);
                let v = velocity(&simulator, body);
                let (sin, cos) = pitch.sin_cos();
                assert_near(v.norm() - before, GRAVITY * (sin - friction * cos), 0.3);
                assert_near(v.y / v.z, pitch.tan(), 0.01);
                assert_near(v.x, 0.0, 0.01);
            }
        }
    });
}

#[test]
fn bodies_lie_on_a_slope_along_z_that_is_rough_enough_and_sleep() {
    precise(|| {
        for thing in sliders() {
            let mut simulator = simulator();
            let id = platform(&mut simulator, [200.0, 20.0, 300.0], [0.0, 100.0, 200.0], 0.6);
            simulator.platform_mut(id).unwrap().set_pitch(0.3).unwrap();
            let body = put(&mut simulator, thing.friction(0.6), [0.0, 160.0, 200.0]);
            run(&mut simulator, 300);
            let there = place(&simulator, body);
            run(&mut simulator, 300);
            assert_near((place(&simulator, body) - there).norm(), 0.0, 0.02);
            assert!(simulator.is_asleep(body) && simulator.body(body).unwrap().is_grounded());
        }
    });
}

#[test]
fn a_ball_rolls_down_a_slope_along_z_like_down_one_along_x() {
    precise(|| {
        let (sin, _) = 0.3f32.sin_cos();
        let mut simulator = simulator();
        let id = platform(&mut simulator, [200.0, 20.0, 900.0], [0.0, 300.0, 500.0], 1.0);
        simulator.platform_mut(id).unwrap().set_pitch(0.3).unwrap();
        let top = 320.0 + 200.0 * 0.3f32.tan();
        let ball = put(&mut simulator, Ball::new(10.0).friction(1.0), [0.0, top + 1.0, 700.0]);
        run(&mut simulator, 100);
        let before = velocity(&simulator, ball).norm();
        run(&mut simulator, 100);
        // A solid ball has 5/7 of it.
        assert_near(velocity(&simulator, ball).norm() - before, GRAVITY * sin * 5.0 / 7.0, 0.3);
    });
}

#[test]
fn a_slope_that_leads_aslant_is_slid_down_along_its_steepest_line() {
    precise(|| {
        for thing in [Cylinder::new(10.0, 40.0), Capsule::new(10.0, 40.0), Prism::footprint(wedge(), 40.0)] {
            let mut simulator = simulator();
            let id = platform(&mut simulator, [800.0, 20.0, 800.0], [0.0, 400.0, 500.0], 0.0);
            let mut slope = simulator.platform_mut(id).unwrap();
            slope.set_rotation(0.3).unwrap();
            slope.set_pitch(0.3).unwrap();
            let top = simulator.surface_beneath(Vector3::new(0.0, 900.0, 500.0)).unwrap();
            let body = put(&mut simulator, thing.friction(0.0), [0.0, top.height + 12.0, 500.0]);
            run(&mut simulator, 200);
            let v = velocity(&simulator, body);
            // The steepest line is the direction of gravity along the surface.
            let down = Vector3::new(0.0, -1.0, 0.0);
            let steepest = (down - top.normal * top.normal.dot(&down)).normalize();
            assert!(v.norm() > 30.0);
            assert_near((v.normalize() - steepest).norm(), 0.0, 0.02);
        }
    });
}

#[test]
fn a_cylinder_half_over_the_side_of_a_slope_stands_on_it_and_past_the_side_does_not() {
    precise(|| {
        let mut simulator = simulator();
        let id = platform(&mut simulator, [100.0, 20.0, 200.0], [0.0, 50.0, 200.0], 1.0);
        simulator.platform_mut(id).unwrap().set_pitch(0.3).unwrap();
        let on = put(&mut simulator, Cylinder::new(10.0, 40.0).friction(1.0), [58.0, 75.0, 200.0]);
        let off = put(&mut simulator, Cylinder::new(10.0, 40.0).friction(1.0), [-60.5, 75.0, 200.0]);
        run(&mut simulator, 300);
        // The highest point beneath it is where its rim crosses the side, 6 behind its middle.
        assert_near(place(&simulator, on).y, 70.0 + 6.0 * 0.3f32.tan(), 0.05);
        assert_near(place(&simulator, off).y, 0.0, 0.05);
    });
}

#[test]
fn the_side_of_a_turned_platform_deflects_a_body_that_slides_along_it() {
    precise(|| {
        for thing in [Cylinder::new(10.0, 20.0), Capsule::new(10.0, 20.0), Ball::new(10.0)] {
            let mut simulator = weightless();
            let id = platform(&mut simulator, [200.0, 100.0, 20.0], [0.0, 0.0, 100.0], 0.0);
            simulator.platform_mut(id).unwrap().set_yaw(0.6).unwrap();
            let body = put(&mut simulator, thing.friction(0.0), [0.0, 30.0, 20.0]);
            throw(&mut simulator, body, [0.0, 0.0, 100.0]);
            run(&mut simulator, 90);
            // The velocity component along the side remains, the component against it is lost.
            let (sin, cos) = 0.6f32.sin_cos();
            let v = velocity(&simulator, body);
            assert_near(v.x, 100.0 * sin * cos, 0.5);
            assert_near(v.z, 100.0 * sin * sin, 0.5);
            assert_near(v.y, 0.0, 0.01);
        }
    });
}

#[test]
fn bodies_lie_on_a_turned_platform_where_it_is_and_nowhere_else() {
    precise(|| {
        for thing in sliders().into_iter().chain([Ball::new(10.0)]) {
            let mut simulator = simulator();
            let id = platform(&mut simulator, [200.0, 30.0, 40.0], [0.0, 0.0, 200.0], 1.0);
            simulator.platform_mut(id).unwrap().set_yaw(std::f32::consts::FRAC_PI_4).unwrap();
            // Along it, and where it would be if it were not turned.
            let on = put(&mut simulator, thing.friction(1.0), [40.0, 35.0, 240.0]);
            let off = put(&mut simulator, thing.friction(1.0), [-70.0, 35.0, 200.0]);
            run(&mut simulator, 300);
            assert_near(place(&simulator, on).y, 30.0, 0.1);
            assert_near(place(&simulator, off).y, 0.0, 0.1);
            assert!(simulator.is_asleep(on));
        }
    });
}

#[test]
fn a_rotating_platform_carries_the_bodies_on_it_around() {
    precise(|| {
        for thing in sliders() {
            let mut simulator = simulator();
            let id = platform(&mut simulator, [300.0, 20.0, 300.0], [0.0, 0.0, 200.0], 2.0);
            let turning = 0.6;
            let body = put(&mut simulator, thing.friction(2.0), [80.0, 20.0, 200.0]);
            run(&mut simulator, 30);
            simulator.platform_mut(id).unwrap().set_angular_velocity(turning).unwrap();
            let middle = Vector3::new(0.0, 20.0, 200.0);
            for _ in 0..300 {
                run(&mut simulator, 1);
            }
            let out = place(&simulator, body) - middle;
            let v = velocity(&simulator, body);
            // v = omega x r, and it stays as far out as it was; an edged one is carried where its middle of pressure is.
            assert_near((v - Vector3::new(-turning * out.z, 0.0, turning * out.x)).norm(), 0.0, 1.0);
            assert_near(Vector2::new(out.x, out.z).norm(), 80.0, 2.5);
            assert_near(simulator.platform(id).unwrap().yaw(), turning * 300.0 * DT, 1e-3);
            assert!(!simulator.is_asleep(body));
        }
    });
}

#[test]
fn a_rotating_platform_sweeps_bodies_in_its_path() {
    precise(|| {
        for thing in sliders().into_iter().chain([Ball::new(10.0)]) {
            let mut simulator = weightless();
            let id = platform(&mut simulator, [200.0, 60.0, 10.0], [0.0, 0.0, 200.0], 0.0);
            let body = put(&mut simulator, thing.friction(0.0), [60.0, 10.0, 220.0]);
            simulator.platform_mut(id).unwrap().set_angular_velocity(1.0).unwrap();
            let mut fastest = 0.0f32;
            for _ in 0..60 {
                run(&mut simulator, 1);
                fastest = fastest.max(velocity(&simulator, body).z);
                assert!(!is_inside(&simulator, id, place(&simulator, body) + Vector3::new(0.0, 10.0, 0.0)));
            }
            // Between the speeds of the side at the point of the hit, 50 out, and at its end, where it slides off.
            assert!((45.0..115.0).contains(&fastest), "{thing:?}: {fastest}");
        }
    });
}

fn is_inside(simulator: &TwoHalfPhysicsSimulator, id: PlatformId, point: Vector3) -> bool {
    let surface = simulator.platform(id).unwrap();
    let (sin, cos) = surface.yaw().sin_cos();
    let out = point - surface.position3d();
    let (along, across) = (cos * out.x + sin * out.z, cos * out.z - sin * out.x);
    along.abs() < 0.5 * surface.width() && across.abs() < 0.5 * surface.depth()
}

#[test]
fn a_platform_is_turned_to_an_angle_to_the_last_bit() {
    precise(|| {
        let mut simulator = simulator();
        let id = platform(&mut simulator, [100.0, 20.0, 40.0], [0.0, 0.0, 200.0], 0.0);
        simulator.platform_mut(id).unwrap().turn_to(0.7).unwrap();
        run(&mut simulator, 1);
        assert_eq!(simulator.platform(id).unwrap().yaw(), 0.7);
        assert_near(simulator.platform(id).unwrap().angular_velocity(), 0.7 / DT, 1e-3);
        run(&mut simulator, 1);
        assert_eq!(simulator.platform(id).unwrap().angular_velocity(), 0.0);
        assert_eq!(simulator.platform(id).unwrap().yaw(), 0.7);
        let corner = simulator.platform(id).unwrap().corners()[1];
        // The front right one: (50, -20), turned by 0.7.
        let (sin, cos) = 0.7f32.sin_cos();
        assert_near(corner.x, 50.0 * cos + 20.0 * sin, 1e-3);
        assert_near(corner.z - 200.0, 50.0 * sin - 20.0 * cos, 1e-3);
    });
}

#[test]
fn a_platform_turned_by_an_angle_beyond_the_range_of_the_sine_keeps_its_size() {
    precise(|| {
        let mut simulator = weightless();
        let id = platform(&mut simulator, [60.0, 20.0, 40.0], [0.0, 10.0, 0.0], 0.0);
        simulator.platform_mut(id).unwrap().turn_to(1e20).unwrap();
        for _ in 0..2 {
            simulator.update(DT);
            let view = simulator.platform(id).unwrap();
            let [across, along] = [1, 4].map(|corner| (view.corners()[corner] - view.corners()[0]).norm());
            assert_near(across, 60.0, 1e-4);
            assert_near(along, 40.0, 1e-4);
        }
        assert_eq!(simulator.platform(id).unwrap().yaw(), 1e20);
    });
}

#[test]
fn no_body_falls_through_a_slope_along_z_at_any_speed() {
    precise(|| {
        for thing in sliders().into_iter().chain([Ball::new(10.0)]) {
            for speed in [300.0, 3000.0, 30_000.0] {
                let mut simulator = simulator();
                let id = platform(&mut simulator, [200.0, 5.0, 300.0], [0.0, 100.0, 200.0], 0.5);
                simulator.platform_mut(id).unwrap().set_pitch(0.6).unwrap();
                let body = put(&mut simulator, thing, [0.0, 400.0, 200.0]);
                throw(&mut simulator, body, [0.0, -speed, 0.0]);
                let lowest = (0..150).fold(f32::MAX, |lowest, _| {
                    run(&mut simulator, 1);
                    let at = place(&simulator, body);
                    let above = at.y - (105.0 + (at.z - 200.0) * 0.6f32.tan());
                    // Off its lower end it falls.
                    if at.z > 60.0 { lowest.min(above) } else { lowest }
                });
                assert!(lowest > -2.0, "{thing:?} at {speed}: {lowest}");
            }
        }
    });
}

#[test]
fn rays_and_surfaces_know_turned_platforms_and_slopes_along_z() {
    precise(|| {
        let mut simulator = simulator();
        let slope = platform(&mut simulator, [100.0, 20.0, 100.0], [0.0, 30.0, 100.0], 0.0);
        simulator.platform_mut(slope).unwrap().set_pitch(0.5).unwrap();
        let turned = platform(&mut simulator, [100.0, 20.0, 10.0], [300.0, 0.0, 100.0], 0.0);
        simulator.platform_mut(turned).unwrap().set_yaw(std::f32::consts::FRAC_PI_2).unwrap();
        let surface = simulator.surface_beneath(Vector3::new(0.0, 200.0, 140.0)).unwrap();
        assert_near(surface.height, 50.0 + 40.0 * 0.5f32.tan(), 1e-3);
        assert_near(surface.normal.z, -(0.5f32.sin()), 1e-5);
        let hit =
            |from: [f32; 3], to: [f32; 3]| simulator.ray_cast3d(from.into(), to.into(), |_| true).unwrap();
        assert_near(hit([0.0, 200.0, 140.0], [0.0, 0.0, 140.0]).point.y, surface.height, 1e-3);
        let side = hit([200.0, 10.0, 140.0], [400.0, 10.0, 140.0]);
        assert_eq!(side.partner, ContactTarget::Platform(turned));
        assert_near(side.point.x, 295.0, 1e-3);
        let low = Vector3::new(294.0, 0.0, 145.0);
        assert_eq!(simulator.platforms_in_box(low, low + Vector3::new(2.0, 5.0, 2.0), |_| true), [turned]);
    });
}

#[test]
fn features_of_level_platforms_are_refused_to_others() {
    precise(|| {
        let mut simulator = simulator();
        let id = platform(&mut simulator, [100.0, 20.0, 40.0], [0.0, 0.0, 200.0], 0.0);
        let mut view = simulator.platform_mut(id).unwrap();
        assert!(view.set_pitch(1.5).is_err() && view.set_pitch(f32::NAN).is_err());
        view.set_pitch(0.2).unwrap();
        assert!(view.set_yaw(0.1).is_err() && view.set_angular_velocity(1.0).is_err());
        assert!(view.turn_to(0.1).is_err());
        view.set_pitch(0.0).unwrap();
        view.set_yaw(0.1).unwrap();
        assert!(view.set_rotation(0.1).is_err() && view.set_pitch(0.1).is_err());
        view.set_angular_velocity(1.0).unwrap();
        assert!(view.set_surface_speed(5.0, 0.0).is_err());
        assert!(view.set_angular_velocity(f32::INFINITY).is_err() && view.turn_to(f32::NAN).is_err());
        view.turn_to(0.2).unwrap();
        view.set_angular_velocity(0.0).unwrap();
        view.turn_to(0.1).unwrap();
        assert!(view.set_surface_speed(5.0, 0.0).is_err());
        view.set_angular_velocity(0.0).unwrap();
        view.set_surface_speed(5.0, 0.0).unwrap();
        assert!(view.set_angular_velocity(1.0).is_err());
        assert_eq!(view.yaw(), 0.1);
        assert!(simulator.set_depth_scheme(DepthScheme::Faithful).is_err());
    });
    let mut simulator = simulator();
    let id = platform(&mut simulator, [100.0, 20.0, 40.0], [0.0, 0.0, 200.0], 0.0);
    let mut view = simulator.platform_mut(id).unwrap();
    assert!(view.set_pitch(0.1).is_err() && view.set_yaw(0.1).is_err());
    assert!(view.set_angular_velocity(0.1).is_err() && view.turn_to(0.1).is_err());
}

#[test]
fn a_platform_does_not_turn_where_some_angle_would_have_infinite_corners() {
    precise(|| {
        let mut simulator = simulator();
        // As built, it reaches along X; turned by a quarter it would reach beyond the range of an f32 along Z.
        let id = platform(&mut simulator, [f32::MAX, 10.0, 10.0], [0.0, 0.0, -f32::MAX], 0.0);
        let mut view = simulator.platform_mut(id).unwrap();
        assert!(view.set_angular_velocity(1.0).is_err() && view.turn_to(1.5).is_err());
        assert!(view.set_yaw(1.5).is_err());
        assert_eq!(view.angular_velocity(), 0.0);
    });
}

#[test]
fn turning_platforms_and_slopes_go_on_with_the_same_bits_after_loading() {
    precise(|| {
        let mut simulator = simulator();
        let table = platform(&mut simulator, [300.0, 20.0, 300.0], [0.0, 0.0, 200.0], 0.5);
        simulator.platform_mut(table).unwrap().set_angular_velocity(0.8).unwrap();
        let slope = platform(&mut simulator, [300.0, 20.0, 300.0], [300.0, 60.0, 200.0], 0.2);
        simulator.platform_mut(slope).unwrap().set_pitch(0.3).unwrap();
        let things = sliders().into_iter().chain([Ball::new(10.0)]).cycle().take(10).enumerate();
        let bodies: Vec<BodyId> = things
            .map(|(at, thing)| {
                let home = [60.0 * (at % 2) as f32 + 40.0 * at as f32, 130.0, 150.0 + 12.0 * at as f32];
                put(&mut simulator, thing.friction(0.4), home)
            })
            .collect();
        assert_goes_on_after_loading(&mut simulator, &bodies);
    });
}
