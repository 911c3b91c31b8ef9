//! Cylinders, capsules and prisms on end.

use conformance::fixtures::depth::{
    DT, GRAVITY, assert_goes_on_after_loading, place, run, throw, with_scheme,
};
use conformance::fixtures::depth::{simulator, weightless};
use twohalf::{
    BodyId, ContactTarget, DepthProfile, DepthScheme, Footprint, Platform, TwoHalfPhysicsSimulator, Vector2,
    Vector3,
};
use twohalf_factories::{Ball, Capsule, Cylinder, Prism, Thing, spawn};

fn precise(test: impl FnOnce()) {
    with_scheme(DepthScheme::Precise, test);
}

/// An upright body without drag.
fn put(simulator: &mut TwoHalfPhysicsSimulator, thing: Thing, at: [f32; 3]) -> BodyId {
    let body = spawn(simulator, thing.at(at)).unwrap().body;
    let mut view = simulator.body_mut(body).unwrap();
    view.core_mut().set_linear_drag_coefficient(0.0);
    view.core_mut().set_rotational_drag_coefficient(0.0);
    body
}

fn velocity(simulator: &TwoHalfPhysicsSimulator, body: BodyId) -> Vector3 {
    simulator.body(body).unwrap().velocity3d()
}

/// Adds the objects to the lists without any motion.
fn let_enter(simulator: &mut TwoHalfPhysicsSimulator) {
    simulator.set_enabled(false);
    simulator.update(DT);
}

fn wedge() -> Footprint {
    Footprint::new(&[[-20.0, -10.0], [20.0, -10.0], [0.0, 20.0]].map(Vector2::from)).unwrap()
}

#[track_caller]
fn assert_near(found: f32, wanted: f32, tolerance: f32) {
    assert!((found - wanted).abs() <= tolerance, "{found}, not {wanted}");
}

/// All kinds of upright bodies.
fn things() -> [Thing; 3] {
    [Cylinder::new(10.0, 40.0), Capsule::new(10.0, 40.0), Prism::footprint(wedge(), 40.0)]
}

#[test]
fn upright_bodies_fall_on_the_ground_and_sleep() {
    precise(|| {
        for thing in things() {
            let mut simulator = simulator();
            let body = put(&mut simulator, thing, [0.0, 50.0, 100.0]);
            run(&mut simulator, 90);
            // sqrt(2 h / g) is one second.
            assert_near(velocity(&simulator, body).y, -GRAVITY * 0.9, 0.1);
            run(&mut simulator, 200);
            assert_near(place(&simulator, body).y, 0.0, 0.05);
            assert!(simulator.body(body).unwrap().is_grounded() && simulator.is_asleep(body));
        }
    });
}

#[test]
fn upright_bodies_stand_on_the_edge_of_a_platform_and_fall_past_it() {
    precise(|| {
        for thing in things() {
            for (z, stands) in [(109.0, true), (121.0, false), (91.0, true)] {
                let mut simulator = simulator();
                let position = Vector3::new(0.0, 0.0, 80.0);
                Platform::new(&mut simulator, 200.0, 30.0, 60.0, position, None).unwrap();
                let body = put(&mut simulator, thing, [5.0, 32.0, z]);
                run(&mut simulator, 300);
                let [x, y, _]: [f32; 3] = place(&simulator, body).into();
                // The rounded end of a capsule slides off an edge that is not under its middle.
                let is_capsule = thing == Capsule::new(10.0, 40.0);
                let stands = stands && (!is_capsule || z <= 110.0);
                assert_near(y, if stands { 30.0 } else { 0.0 }, 0.05);
                assert_near(x, 5.0, 0.01);
            }
        }
    });
}

#[test]
fn two_cylinders_that_come_at_each_other_nineteen_twentieths_aside_slide_past() {
    precise(|| {
        let mut simulator = weightless();
        let one = put(&mut simulator, Cylinder::new(10.0, 40.0).friction(0.0), [-50.0, 0.0, 100.0]);
        let other = put(&mut simulator, Cylinder::new(10.0, 40.0).friction(0.0), [50.0, 0.0, 119.0]);
        throw(&mut simulator, one, [100.0, 0.0, 0.0]);
        throw(&mut simulator, other, [-100.0, 0.0, 0.0]);
        run(&mut simulator, 200);
        // At the contact the normal has sine 19/20: the velocity component along it is lost, the rest remains.
        let (cosine, sine) = ((1.0f32 - 0.95 * 0.95).sqrt(), 0.95);
        let [v, w] = [one, other].map(|body| velocity(&simulator, body));
        assert_near(v.x, 100.0 * sine * sine, 0.5);
        assert_near(v.z, -100.0 * sine * cosine, 0.5);
        assert_near(w.x, -v.x, 1e-3);
        assert_near(w.z, -v.z, 1e-3);
        assert!(place(&simulator, one).x > 50.0);
    });
}

#[test]
fn cylinders_that_pass_a_tenth_of_a_pixel_apart_do_not_touch() {
    precise(|| {
        let mut simulator = weightless();
        let one = put(&mut simulator, Cylinder::new(10.0, 40.0), [-50.0, 0.0, 100.0]);
        let other = put(&mut simulator, Cylinder::new(10.0, 40.0), [50.0, 0.0, 120.1]);
        throw(&mut simulator, one, [100.0, 0.0, 0.0]);
        throw(&mut simulator, other, [-100.0, 0.0, 0.0]);
        run(&mut simulator, 200);
        assert_eq!(velocity(&simulator, one), Vector3::new(100.0, 0.0, 0.0));
    });
}

#[test]
fn a_cylinder_slides_down_a_slope_by_the_law_of_friction() {
    precise(|| {
        for thing in things() {
            for friction in [0.0, 0.2] {
                let mut simulator = simulator();
                let tilt = 0.4f32;
                let id = Platform::with_rotation(
                    &mut simulator,
                    800.0,
                    20.0,
                    200.0,
                    Vector3::new(0.0, 200.0, 100.0),
                    tilt,
                    None,
                );
                let id = id.unwrap();
                simulator.platform_mut(id).unwrap().set_friction_coefficient(friction);
                let body = put(&mut simulator, thing.friction(friction), [-200.0, 0.0, 100.0]);
                let top = 210.0 + 200.0 * tilt.tan() + 10.0 / tilt.cos();
                simulator.body_mut(body).unwrap().set_position3d(Vector3::new(
                    -200.0,
                    top + 20.0 * tilt.tan() + 0.5,
                    100.0,
                ));
                run(&mut simulator, 100);
                let before = velocity(&simulator, body).norm();
                run(&mut simulator, 100);
                let gained = velocity(&simulator, body).norm() - before;
                let (sin, cos) = tilt.sin_cos();
                assert_near(gained, GRAVITY * (sin - friction * cos), 0.3);
            }
        }
    });
}

#[test]
fn bodies_stand_on_upright_bodies_and_these_on_them() {
    precise(|| {
        let crates = Prism::new([40.0, 30.0, 40.0]);
        for (thing, height) in [(Cylinder::new(10.0, 40.0), 40.0), (Prism::footprint(wedge(), 40.0), 40.0)] {
            let mut simulator = simulator();
            let lower = put(&mut simulator, crates.friction(0.5), [0.0, 0.0, 100.0]);
            let middle = put(&mut simulator, thing.friction(0.5), [3.0, 30.5, 104.0]);
            let upper = put(&mut simulator, crates.friction(0.5), [0.0, 31.0 + height, 100.0]);
            run(&mut simulator, 400);
            assert_near(place(&simulator, lower).y, 0.0, 0.1);
            assert_near(place(&simulator, middle).y, 30.0, 0.2);
            assert_near(place(&simulator, upper).y, 30.0 + height, 0.3);
            assert_near(simulator.body(upper).unwrap().rotation().sin(), 0.0, 0.01);
            assert!([lower, middle, upper].iter().all(|&body| simulator.is_asleep(body)));
        }
    });
}

#[test]
fn upright_bodies_push_crates_along_both_axes() {
    precise(|| {
        for thing in things() {
            for way in [[100.0, 0.0, 0.0], [0.0, 0.0, 100.0]] {
                let mut simulator = weightless();
                let pushed = put(&mut simulator, Prism::new([40.0, 40.0, 40.0]).friction(0.0), [0.0; 3]);
                let [x, _, z] = way.map(|part: f32| -part.signum() * part.abs().min(60.0));
                let body = put(&mut simulator, thing.friction(0.0), [x, 0.0, z]);
                throw(&mut simulator, body, way);
                run(&mut simulator, 100);
                // Inelastic, and of one mass: both go on with half the speed.
                let [v, w] = [body, pushed].map(|body| velocity(&simulator, body));
                assert_near((v - w).norm(), 0.0, 0.5);
                assert_near(v.x + v.z, 50.0, 0.5);
            }
        }
    });
}

/// A side that leans by rounding alone is held at both its ends.
#[test]
fn a_crate_that_may_tip_stays_upright_and_outside_of_a_round_body_that_it_hits() {
    precise(|| {
        for thing in [Cylinder::new(12.5, 60.0), Capsule::new(12.5, 60.0)] {
            let mut simulator = simulator();
            let post = put(&mut simulator, thing.mass(70.0).friction(0.0), [0.0, 0.0, 50.0]);
            let crate_body = put(&mut simulator, Prism::new([30.0; 3]).mass(5.0), [40.0, 0.0, 50.0]);
            run(&mut simulator, 30);
            throw(&mut simulator, crate_body, [-300.0, 0.0, 0.0]);
            for _ in 0..100 {
                run(&mut simulator, 1);
                // Half a crate and the radius; a step is 3 px.
                let apart = place(&simulator, crate_body).x - place(&simulator, post).x;
                assert!(apart > 27.5 - 1.5, "{thing:?}: {apart}");
                let leaning = simulator.core()[crate_body].rotation().sin();
                assert!(leaning.abs() < 0.03, "{thing:?}: {leaning}");
            }
            assert!(velocity(&simulator, post).x < -10.0, "{thing:?}");
        }
    });
}

#[test]
fn a_ball_bounces_off_a_cylinder_along_the_line_of_their_middles() {
    precise(|| {
        let mut simulator = weightless();
        let post = put(&mut simulator, Cylinder::new(20.0, 80.0), [0.0, 0.0, 100.0]);
        simulator.body_mut(post).unwrap().set_is_static(true);
        let ball = put(&mut simulator, Ball::new(10.0).friction(0.0).restitution(1.0), [-100.0, 20.0, 118.0]);
        let geom = simulator.body(post).unwrap().ground().object_geom().unwrap();
        simulator.geom_mut(geom).unwrap().set_restitution_coefficient(1.0);
        simulator.geom_mut(geom).unwrap().set_friction_coefficient(0.0);
        throw(&mut simulator, ball, [100.0, 0.0, 0.0]);
        run(&mut simulator, 200);
        // The normal has sine 18/30: the velocity is turned by twice the angle to it.
        let sine = 0.6f32;
        let v = velocity(&simulator, ball);
        assert_near(v.x, -100.0 * (1.0 - 2.0 * sine * sine), 1.0);
        assert_near(v.z, 200.0 * sine * 0.8, 1.0);
        assert_near(v.y, 0.0, 0.01);
    });
}

#[test]
fn no_upright_body_tunnels_through_a_static_one_at_any_speed() {
    precise(|| {
        for thing in things() {
            let mut simulator = weightless();
            let wall = Vector3::new(0.0, 0.0, 0.0);
            Platform::new(&mut simulator, 4.0, 100.0, 400.0, wall, None).unwrap();
            let post = put(&mut simulator, Cylinder::new(2.0, 100.0), [300.0, 0.0, 150.0]);
            simulator.body_mut(post).unwrap().set_is_static(true);
            let body = put(&mut simulator, thing, [-200.0, 20.0, 10.0]);
            throw(&mut simulator, body, [20_000.0, 0.0, 0.0]);
            let other = put(&mut simulator, thing, [300.0, 20.0, -100.0]);
            throw(&mut simulator, other, [0.0, 0.0, 20_000.0]);
            run(&mut simulator, 20);
            assert!(place(&simulator, body).x < 0.0);
            assert!(place(&simulator, other).z < 150.0);
        }
    });
}

#[test]
fn upright_bodies_do_not_rotate() {
    precise(|| {
        for thing in things() {
            let mut simulator = simulator();
            Platform::new(&mut simulator, 100.0, 30.0, 60.0, Vector3::new(0.0, 0.0, 100.0), None).unwrap();
            let body = put(&mut simulator, thing.friction(0.8), [-40.0, 60.0, 100.0]);
            simulator.body_mut(body).unwrap().apply_torque(1e6);
            simulator.body_mut(body).unwrap().set_angular_velocity(5.0);
            throw(&mut simulator, body, [80.0, 0.0, 10.0]);
            run(&mut simulator, 600);
            assert_eq!(simulator.body(body).unwrap().rotation(), 0.0);
            // Turned by hand, it stands as it stood.
            let before = place(&simulator, body);
            simulator.body_mut(body).unwrap().set_rotation(1.0);
            run(&mut simulator, 100);
            let way = place(&simulator, body) - before;
            assert!(way.norm() < 0.1, "{thing:?}: {way:?} from {before:?}");
        }
    });
}

#[test]
fn a_wedge_deflects_a_body_that_slides_along_its_side() {
    precise(|| {
        let mut simulator = weightless();
        let post = put(&mut simulator, Prism::footprint(wedge(), 80.0).friction(0.0), [0.0, 0.0, 100.0]);
        simulator.body_mut(post).unwrap().set_is_static(true);
        let body = put(&mut simulator, Cylinder::new(5.0, 20.0).friction(0.0), [-60.0, 10.0, 105.0]);
        throw(&mut simulator, body, [100.0, 0.0, 0.0]);
        run(&mut simulator, 80);
        // Its left side goes 20 to the right and 30 to the back: the velocity component along it remains.
        let along = Vector3::new(20.0, 0.0, 30.0).normalize();
        let kept = along * 100.0 * along.x;
        assert_near((velocity(&simulator, body) - kept).norm(), 0.0, 1.0);
    });
}

#[test]
fn collisions_of_all_shapes_keep_momentum_along_every_axis() {
    precise(|| {
        for seed in 0..6u32 {
            let mut simulator = weightless();
            let mut state = seed.wrapping_mul(2_654_435_761).wrapping_add(12345);
            let mut random = |low: f32, high: f32| {
                state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                low + (high - low) * ((state >> 8) as f32 / 16_777_216.0)
            };
            let mut bodies = Vec::new();
            for at in 0..24 {
                let thing = match at % 6 {
                    0 => Prism::new([20.0, 20.0, 20.0]),
                    1 => Ball::new(10.0),
                    2 | 3 => Cylinder::new(10.0, 30.0),
                    4 => Capsule::new(8.0, 40.0),
                    _ => Prism::footprint(wedge(), 20.0),
                };
                let thing = thing.mass(random(0.5, 4.0)).friction(0.3).restitution(0.3);
                let home = [random(0.0, 160.0), 200.0 + random(0.0, 80.0), random(0.0, 160.0)];
                let body = put(&mut simulator, thing, home);
                throw(&mut simulator, body, [random(-99.0, 99.0), random(-40.0, 40.0), random(-99.0, 99.0)]);
                bodies.push(body);
            }
            let momentum = |simulator: &TwoHalfPhysicsSimulator| {
                bodies.iter().fold(Vector3::zeros(), |sum, &body| {
                    let view = simulator.body(body).unwrap();
                    sum + view.velocity3d() * view.mass()
                })
            };
            let before = momentum(&simulator);
            for _ in 0..100 {
                run(&mut simulator, 1);
                let lost = momentum(&simulator) - before;
                assert!(lost.amax() < 0.05, "seed {seed}: {lost:?} of {before:?}");
            }
        }
    });
}

#[test]
fn upright_bodies_go_on_with_the_same_bits_after_loading() {
    precise(|| {
        let mut simulator = simulator();
        Platform::with_rotation(&mut simulator, 300.0, 20.0, 150.0, Vector3::new(0.0, 0.0, 80.0), 0.2, None)
            .unwrap();
        let bodies: Vec<BodyId> = (0..9)
            .map(|at| {
                let thing = things()[at % 3].friction(0.3);
                put(&mut simulator, thing, [-40.0 + 9.0 * at as f32, 60.0 + 20.0 * at as f32, 100.0])
            })
            .collect();
        assert_goes_on_after_loading(&mut simulator, &bodies);
    });
}

#[test]
fn rays_enter_upright_bodies_at_their_surface() {
    precise(|| {
        let mut simulator = simulator();
        let cylinder = put(&mut simulator, Cylinder::new(10.0, 40.0), [0.0, 0.0, 100.0]);
        let capsule = put(&mut simulator, Capsule::new(10.0, 40.0), [100.0, 0.0, 100.0]);
        let prism = put(&mut simulator, Prism::footprint(wedge(), 40.0), [200.0, 0.0, 100.0]);
        let_enter(&mut simulator);
        let hit = |from: [f32; 3], to: [f32; 3]| {
            simulator.ray_cast3d(from.into(), to.into(), |partner| partner != ContactTarget::Ground)
        };
        let at_side = hit([-50.0, 20.0, 106.0], [50.0, 20.0, 106.0]).unwrap();
        assert_near(at_side.point.x, -8.0, 1e-3);
        assert_near(at_side.normal.x, -0.8, 1e-4);
        assert_near(at_side.normal.z, 0.6, 1e-4);
        assert_near(hit([3.0, 90.0, 100.0], [3.0, -5.0, 100.0]).unwrap().point.y, 40.0, 1e-3);
        // At the round end: 30 + sqrt(100 - 36).
        assert_near(hit([106.0, 90.0, 100.0], [106.0, -5.0, 100.0]).unwrap().point.y, 38.0, 1e-3);
        assert_near(hit([50.0, 12.0, 100.0], [150.0, 12.0, 100.0]).unwrap().point.x, 90.0, 1e-3);
        assert!(hit([109.9, 39.9, 0.0], [109.9, 39.9, 200.0]).is_none());
        assert_near(hit([200.0, 10.0, 0.0], [200.0, 10.0, 200.0]).unwrap().point.z, 90.0, 1e-3);
        assert!(hit([216.0, 10.0, 105.0], [260.0, 10.0, 105.0]).is_none());
        let geom = |body: BodyId| simulator.body(body).unwrap().ground().object_geom().unwrap();
        let sides = [cylinder, capsule, prism].map(|body| simulator.geom(geom(body)).unwrap().virtual_geom());
        assert_eq!(
            sides.map(|side| (side.is_round, side.has_top)),
            [(true, true), (true, false), (false, true)]
        );
        assert_eq!((sides[2].front, sides[2].back), (90.0, 120.0));
    });
}

#[test]
fn overlaps_of_upright_bodies_are_those_of_their_shapes() {
    precise(|| {
        let mut simulator = weightless();
        let one = put(&mut simulator, Cylinder::new(10.0, 40.0), [0.0, 0.0, 100.0]);
        let corner = put(&mut simulator, Prism::new([10.0, 10.0, 10.0]), [13.0, 0.0, 113.0]);
        let ball = put(&mut simulator, Ball::new(5.0), [0.0, 42.0, 100.0]);
        let beside = put(&mut simulator, Cylinder::new(10.0, 40.0), [-14.0, 0.0, 86.0]);
        let_enter(&mut simulator);
        let geom = |body: BodyId| simulator.body(body).unwrap().ground().object_geom().unwrap();
        let overlaps = |body: BodyId| simulator.overlaps_of(geom(body), |_| true);
        // The corner is 8 sqrt 2 from the middle, the ball 2 above the top, the other one 14 sqrt 2 aside.
        assert_eq!(overlaps(one), [geom(beside)]);
        assert_eq!(overlaps(beside), [geom(one)]);
        assert!(overlaps(corner).is_empty() && overlaps(ball).is_empty());
    });
}

#[test]
fn only_the_precise_set_supports_upright_shapes() {
    let profile = DepthProfile::Cylinder { radius: 10.0, height: 40.0 };
    for scheme in [DepthScheme::Faithful, DepthScheme::Thesis] {
        with_scheme(scheme, || {
            let mut simulator = simulator();
            let made = spawn(&mut simulator, Prism::new([20.0, 40.0, 20.0])).unwrap();
            assert!(simulator.set_depth_profile(made.geom, profile).is_err());
            assert!(spawn(&mut simulator, Cylinder::new(10.0, 40.0)).is_err());
            simulator.update(DT);
            assert_eq!(simulator.core().bodies().count(), 1);
        });
    }
    precise(|| {
        let mut simulator = simulator();
        let made = spawn(&mut simulator, Cylinder::new(10.0, 40.0)).unwrap();
        assert_eq!(simulator.depth_profile(made.geom), Some(profile));
        assert!(simulator.set_depth_scheme(DepthScheme::Faithful).is_err());
        for wrong in [
            DepthProfile::Cylinder { radius: 0.0, height: 40.0 },
            DepthProfile::Cylinder { radius: 10.0, height: f32::NAN },
            DepthProfile::Capsule { radius: 10.0, height: 19.0 },
            DepthProfile::Upright { footprint: wedge(), height: -1.0 },
        ] {
            assert!(simulator.set_depth_profile(made.geom, wrong).is_err(), "{wrong:?}");
        }
        assert!((0..10).all(|_| {
            simulator.update(DT);
            place(&simulator, made.body).y.is_finite()
        }));
    });
}

#[test]
fn the_top_of_an_upright_body_is_a_surface_over_its_footprint_and_a_capsule_has_none() {
    precise(|| {
        for (thing, over, beside) in [
            (Cylinder::new(10.0, 40.0), [7.0, 7.0], [7.2, 7.2]),
            (Prism::footprint(wedge(), 40.0), [5.0, 12.0], [5.0, 13.0]),
        ] {
            let mut simulator = weightless();
            let body = put(&mut simulator, thing, [100.0, 20.0, 50.0]);
            let_enter(&mut simulator);
            let beneath = |[x, z]: [f32; 2]| {
                simulator.surface_beneath(Vector3::new(100.0 + x, 90.0, 50.0 + z)).unwrap()
            };
            let geom = simulator.body(body).unwrap().ground().object_geom().unwrap();
            assert_eq!(beneath(over).partner, ContactTarget::Geom(geom));
            assert_near(beneath(over).height, 60.0, 1e-4);
            assert_eq!(beneath(beside).partner, ContactTarget::Ground);
        }
        let mut simulator = weightless();
        put(&mut simulator, Capsule::new(10.0, 40.0), [0.0, 20.0, 0.0]);
        let_enter(&mut simulator);
        assert_eq!(
            simulator.surface_beneath(Vector3::new(0.0, 90.0, 0.0)).unwrap().partner,
            ContactTarget::Ground
        );
    });
}
