//! Outlines, depth profiles and platforms that are edited while bodies touch them or sleep on them, and slow belts and
//! platforms.

use conformance::fixtures::depth::{
    assert_goes_on_after_loading, assert_near, geom_of, place, platform, run, set_platform_surface,
    set_surface, simulator, solid, with_scheme,
};
use farseer_core::CollisionCategory;
use farseer_core::shape::Vertices;
use twohalf::{BodyId, DepthProfile, DepthScheme, Footprint, TwoHalfPhysicsSimulator, Vector3};

/// Penetration at rest, px. Measured: at most 0.03.
const AT_REST: f32 = 0.05;
/// A second of updates, and the time after which all has come to rest and sleeps.
const SECOND: usize = 100;
const SETTLED: usize = 2 * SECOND;

fn precise(test: impl FnOnce(TwoHalfPhysicsSimulator)) {
    with_scheme(DepthScheme::Precise, || test(simulator()));
}

#[track_caller]
fn assert_height(simulator: &TwoHalfPhysicsSimulator, body: BodyId, height: f32) {
    assert_near(place(simulator, body).y, height, AT_REST);
}

fn reshape(simulator: &mut TwoHalfPhysicsSimulator, body: BodyId, profile: DepthProfile) {
    let geom = geom_of(simulator, body);
    simulator.set_depth_profile(geom, profile).unwrap();
}

#[test]
fn a_halved_crate_stands_on_the_ground_and_the_load_on_it_sinks() {
    precise(|mut simulator| {
        let below = solid(&mut simulator, [40.0, 40.0, 40.0], [100.0, 0.0, 50.0]);
        let above = solid(&mut simulator, [40.0, 40.0, 40.0], [100.0, 40.0, 50.0]);
        run(&mut simulator, SETTLED);
        assert!(simulator.is_asleep(above));
        let geom = geom_of(&simulator, below);
        simulator.set_vertices(geom, Vertices::create_rectangle(40.0, 20.0).unwrap()).unwrap();
        assert_goes_on_after_loading(&mut simulator, &[below, above]);
        run(&mut simulator, SETTLED);
        assert_height(&simulator, below, 0.0);
        assert_height(&simulator, above, 20.0);
    });
}

#[test]
fn a_crate_that_is_less_deep_falls_off_the_ledge_that_it_reached_and_one_that_is_deeper_lands() {
    precise(|mut simulator| {
        platform(&mut simulator, [200.0, 40.0, 20.0], [0.0, 0.0, 0.0]);
        // It spans Z from 5 to 45, the platform that from -10 to 10.
        let falls = solid(&mut simulator, [20.0, 20.0, 40.0], [-50.0, 40.0, 25.0]);
        let lands = solid(&mut simulator, [20.0, 20.0, 10.0], [50.0, 60.0, 25.0]);
        reshape(&mut simulator, lands, DepthProfile::Prism { depth: 40.0 });
        run(&mut simulator, SETTLED);
        assert_height(&simulator, falls, 40.0);
        assert_height(&simulator, lands, 40.0);
        assert!(simulator.is_asleep(falls));
        reshape(&mut simulator, falls, DepthProfile::Prism { depth: 10.0 });
        run(&mut simulator, SETTLED);
        assert_height(&simulator, falls, 0.0);
        assert_height(&simulator, lands, 40.0);
    });
}

#[test]
fn a_reshaped_upright_body_has_its_new_height_and_footprint() {
    precise(|mut simulator| {
        platform(&mut simulator, [40.0, 40.0, 40.0], [0.0, 0.0, 0.0]);
        let post = solid(&mut simulator, [20.0, 40.0, 20.0], [0.0, 40.0, 25.0]);
        reshape(&mut simulator, post, DepthProfile::Cylinder { radius: 10.0, height: 40.0 });
        let on_it = solid(&mut simulator, [10.0, 10.0, 10.0], [0.0, 80.0, 25.0]);
        run(&mut simulator, SETTLED);
        assert_height(&simulator, on_it, 80.0);
        // Half as high, and still on the platform, whose Z ends at 20.
        reshape(&mut simulator, post, DepthProfile::Cylinder { radius: 10.0, height: 20.0 });
        run(&mut simulator, SETTLED);
        assert_height(&simulator, on_it, 60.0);
        reshape(&mut simulator, post, DepthProfile::Capsule { radius: 10.0, height: 30.0 });
        run(&mut simulator, 1);
        // Slim, it is beside the platform.
        let footprint = Footprint::rectangle(8.0, 8.0).unwrap();
        reshape(&mut simulator, post, DepthProfile::Upright { footprint, height: 20.0 });
        run(&mut simulator, SETTLED);
        assert_height(&simulator, post, 0.0);
        let late = solid(&mut simulator, [4.0, 4.0, 4.0], [0.0, 40.0, 25.0]);
        run(&mut simulator, SETTLED);
        assert!(place(&simulator, late).y < 31.0);
    });
}

#[test]
fn a_turned_platform_collides_at_its_new_pose_alone() {
    precise(|mut simulator| {
        let id = platform(&mut simulator, [200.0, 40.0, 200.0], [200.0, 100.0, 150.0]);
        let old = solid(&mut simulator, [20.0, 20.0, 20.0], [285.0, 140.0, 235.0]);
        run(&mut simulator, SETTLED);
        assert!(simulator.is_asleep(old));
        simulator.platform_mut(id).unwrap().set_yaw(std::f32::consts::FRAC_PI_4).unwrap();
        let new = solid(&mut simulator, [10.0, 10.0, 10.0], [325.0, 160.0, 150.0]);
        assert_goes_on_after_loading(&mut simulator, &[old, new]);
        run(&mut simulator, SETTLED);
        assert_height(&simulator, old, 0.0);
        assert_height(&simulator, new, 140.0);
        // And back.
        simulator.platform_mut(id).unwrap().set_yaw(0.0).unwrap();
        run(&mut simulator, SETTLED);
        assert_height(&simulator, new, 0.0);
    });
}

#[test]
fn bodies_asleep_on_a_platform_slide_when_it_becomes_a_slope_along_z() {
    precise(|mut simulator| {
        let id = platform(&mut simulator, [200.0, 40.0, 200.0], [0.0, 0.0, 0.0]);
        let body = solid(&mut simulator, [20.0, 20.0, 20.0], [0.0, 40.0, 0.0]);
        run(&mut simulator, SETTLED);
        assert!(simulator.is_asleep(body));
        simulator.platform_mut(id).unwrap().set_pitch(0.3).unwrap();
        run(&mut simulator, SECOND);
        let slid = place(&simulator, body);
        assert!(slid.z.abs() > 5.0, "{slid:?}");
        simulator.platform_mut(id).unwrap().set_pitch(0.0).unwrap();
        simulator.body_mut(body).unwrap().set_position3d(Vector3::new(0.0, 60.0, 0.0));
        simulator.body_mut(body).unwrap().set_velocity3d(Vector3::zeros());
        run(&mut simulator, SETTLED);
        assert_height(&simulator, body, 40.0);
    });
}

#[test]
fn a_platform_that_is_teleported_or_collides_again_moves_sleeping_bodies() {
    precise(|mut simulator| {
        let id = platform(&mut simulator, [200.0, 10.0, 200.0], [0.0, 0.0, 0.0]);
        let body = solid(&mut simulator, [20.0, 20.0, 20.0], [0.0, 10.0, 0.0]);
        run(&mut simulator, SETTLED);
        let mut view = simulator.platform_mut(id).unwrap();
        view.set_collides_with(CollisionCategory::NONE);
        view.set_collision_categories(CollisionCategory::NONE);
        run(&mut simulator, SETTLED);
        assert_height(&simulator, body, 0.0);
        assert!(simulator.is_asleep(body));
        // It is in the platform, and nearer to the top than to the bottom of that.
        simulator.platform_mut(id).unwrap().set_collision_categories(CollisionCategory::ALL);
        run(&mut simulator, SETTLED);
        assert_height(&simulator, body, 10.0);
        simulator.platform_mut(id).unwrap().set_position3d(Vector3::new(0.0, -5.0, 0.0)).unwrap();
        run(&mut simulator, SETTLED);
        assert_height(&simulator, body, 5.0);
    });
}

#[test]
fn slow_belts_and_platforms_carry_bodies_at_their_speed() {
    precise(|mut simulator| {
        let belt = platform(&mut simulator, [200.0, 40.0, 200.0], [0.0, 0.0, 0.0]);
        let lift = platform(&mut simulator, [200.0, 40.0, 200.0], [300.0, 0.0, 0.0]);
        [belt, lift].into_iter().for_each(|id| set_platform_surface(&mut simulator, id, 0.5, 0.0));
        let [on_belt, on_lift] =
            [0.0, 300.0].map(|x| solid(&mut simulator, [20.0, 20.0, 20.0], [x, 40.0, 0.0]));
        [on_belt, on_lift].into_iter().for_each(|body| set_surface(&mut simulator, body, 0.5, 0.0));
        run(&mut simulator, SETTLED);
        assert!(simulator.is_asleep(on_belt) && simulator.is_asleep(on_lift));
        simulator.platform_mut(belt).unwrap().set_surface_speed(0.2, 0.1).unwrap();
        simulator.platform_mut(lift).unwrap().set_velocity(Vector3::new(0.1, 0.2, -0.1)).unwrap();
        run(&mut simulator, 20 * SECOND);
        let (on_belt, on_lift) = (place(&simulator, on_belt), place(&simulator, on_lift));
        // Of displacements of 4 and 2 px. Measured: within 0.02 px.
        for (moved, expected) in [
            (on_belt - Vector3::new(0.0, 40.0, 0.0), [4.0, 0.0, 2.0]),
            (on_lift - Vector3::new(300.0, 40.0, 0.0), [2.0, 4.0, -2.0]),
        ] {
            let error = (moved - Vector3::from(expected)).norm();
            assert!(error < 0.08, "{moved:?} instead of {expected:?}");
        }
    });
}
