//! The thesis' own scheme (thesis 3.5): its behaviour, and its errors beside contacts in three axes.
//!
//! Objects whose depths differ by less than half the smaller depth meet in X and Y, as outlines. All others meet along Z only,
//! when their footprints and their height intervals overlap, without friction.

use conformance::fixtures::depth::{
    DT, GRAVITY, SLOP, assert_near, assert_near3, ball, collisions_of, fix, geom_of, place, platform, run,
    run_until_hit, set_surface, solid, throw, velocity,
};
use twohalf::{Axis, BodyId, DepthProfile, DepthScheme, TwoHalfPhysicsSimulator, Vector2, Vector3};

/// Velocities of a few hundred px/s after a few hundred operations of f32.
const ROUNDING: f32 = 1e-3;

const BOTH: [DepthScheme; 2] = [DepthScheme::Thesis, DepthScheme::Faithful];

fn with(scheme: DepthScheme, gravity: f32) -> TwoHalfPhysicsSimulator {
    let gravity = Vector2::new(0.0, gravity);
    let mut simulator = TwoHalfPhysicsSimulator::with_angle_and_gravity(600, 60, gravity).unwrap();
    simulator.set_depth_scheme(scheme).unwrap();
    simulator
}

/// A box of 40 x 40 x 40 whose middle is at (0, 520, 0), immovable.
fn post(simulator: &mut TwoHalfPhysicsSimulator) -> BodyId {
    let body = solid(simulator, [40.0, 40.0, 40.0], [0.0, 500.0, 0.0]);
    fix(simulator, body);
    body
}

#[test]
fn objects_at_different_depths_pass_each_other() {
    for scheme in BOTH {
        let mut simulator = with(scheme, 0.0);
        post(&mut simulator);
        let body = solid(&mut simulator, [20.0, 20.0, 20.0], [-100.0, 510.0, 30.5]);
        throw(&mut simulator, body, [80.0, 0.0, 0.0]);
        run(&mut simulator, 250);
        assert_eq!(velocity(&simulator, body), Vector3::new(80.0, 0.0, 0.0));
    }
}

#[test]
fn objects_nearer_in_depth_than_half_the_smaller_depth_meet_in_the_plane() {
    for scheme in BOTH {
        let mut simulator = with(scheme, 0.0);
        post(&mut simulator);
        let body = solid(&mut simulator, [20.0, 20.0, 20.0], [-100.0, 510.0, 9.0]);
        throw(&mut simulator, body, [80.0, 0.0, 0.0]);
        let geom = geom_of(&simulator, body);
        let hit = run_until_hit(&mut simulator, geom);
        assert_eq!((hit.axis, hit.normal), (Axis::Plane, Vector3::new(-1.0, 0.0, 0.0)));
    }
}

#[test]
fn objects_farther_apart_in_depth_meet_along_z_even_where_they_come_from_the_side() {
    // 15 px behind the middle of a post of 40 px, without any motion in depth.
    let hits = BOTH.map(|scheme| {
        let mut simulator = with(scheme, 0.0);
        post(&mut simulator);
        let body = solid(&mut simulator, [20.0, 20.0, 20.0], [-100.0, 510.0, 15.0]);
        throw(&mut simulator, body, [80.0, 0.0, 0.0]);
        let geom = geom_of(&simulator, body);
        let hit = run_until_hit(&mut simulator, geom);
        run(&mut simulator, 100);
        (hit.axis, velocity(&simulator, body).x, place(&simulator, body).z)
    });
    let [(thesis_axis, thesis_speed, thesis_z), (axis, speed, z)] = hits;
    // Wrong: it goes on to the right, through the post, and is moved back in depth.
    assert_eq!((thesis_axis, thesis_speed), (Axis::Depth, 80.0));
    assert!(thesis_z > 29.0);
    assert_eq!((axis, z), (Axis::Plane, 15.0));
    // Two points in the plane: five iterations leave less than 1e-4 of the speed.
    assert_near(speed, 0.0, 80.0 * 1e-4);
}

#[test]
fn a_body_that_comes_from_the_front_collides_along_z_with_both() {
    for scheme in BOTH {
        let mut simulator = with(scheme, 0.0);
        post(&mut simulator);
        let body = solid(&mut simulator, [20.0, 20.0, 20.0], [5.0, 510.0, -80.0]);
        throw(&mut simulator, body, [0.0, 0.0, 80.0]);
        let geom = geom_of(&simulator, body);
        let hit = run_until_hit(&mut simulator, geom);
        assert_eq!((hit.axis, hit.normal), (Axis::Depth, Vector3::new(0.0, 0.0, -1.0)));
        run(&mut simulator, 20);
        assert_near3(velocity(&simulator, body), [0.0, 0.0, 0.0], ROUNDING);
    }
}

#[test]
fn outlines_collide_along_z_if_only_their_boxes_overlap() {
    let speeds = BOTH.map(|scheme| {
        let mut simulator = with(scheme, 0.0);
        let bars = [0.0, 40.0].map(|x| solid(&mut simulator, [100.0, 10.0, 10.0], [x, 500.0, -2.0 * x]));
        for body in bars {
            let mut view = simulator.body_mut(body).unwrap();
            view.set_rotation(std::f32::consts::FRAC_PI_4);
            let place = view.position3d();
            view.set_position3d(Vector3::new(place.x, 500.0, place.z));
        }
        throw(&mut simulator, bars[1], [0.0, 0.0, 80.0]);
        run(&mut simulator, 200);
        velocity(&simulator, bars[1]).z
    });
    // Wrong: the slanted bars are 28 px apart, and the one pushes the other.
    assert_eq!(speeds, [40.0, 80.0]);
}

#[test]
fn it_throws_a_body_that_lands_on_the_front_half_of_another_off_in_depth() {
    let ends = BOTH.map(|scheme| {
        let mut simulator = with(scheme, GRAVITY);
        let below = solid(&mut simulator, [80.0, 60.0, 60.0], [0.0, 0.0, 0.0]);
        fix(&mut simulator, below);
        let body = solid(&mut simulator, [40.0, 20.0, 20.0], [0.0, 80.0, -15.0]);
        run(&mut simulator, 300);
        place(&simulator, body)
    });
    // Wrong: it falls through the crate and is moved out to the front.
    assert!(ends[0].y < 1.0 && ends[0].z < -39.0, "{:?}", ends[0]);
    assert_near3(ends[1], [0.0, 60.0, -15.0], SLOP + 0.05);
}

#[test]
fn it_takes_the_axis_from_the_depths_and_throws_a_figure_off_at_the_edge_of_a_crate() {
    let ends = BOTH.map(|scheme| {
        let mut simulator = with(scheme, GRAVITY);
        let below = solid(&mut simulator, [80.0, 60.0, 60.0], [0.0, 0.0, 0.0]);
        fix(&mut simulator, below);
        let body = solid(&mut simulator, [40.0, 20.0, 20.0], [0.0, 60.0, 0.0]);
        run(&mut simulator, 20);
        throw(&mut simulator, body, [0.0, 0.0, -30.0]);
        run(&mut simulator, 50);
        place(&simulator, body)
    });
    // 15 px to the front all of its depth is over the crate still.
    assert!(ends[0].z < -39.0, "{:?}", ends[0]);
    assert_near3(ends[1], [0.0, 60.0, -15.0], SLOP + 0.05);
}

#[test]
fn it_meets_balls_from_the_front_as_boxes() {
    let normals = BOTH.map(|scheme| {
        let mut simulator = with(scheme, 0.0);
        post(&mut simulator);
        // 9 of 15 px beyond the upright edge.
        let body = ball(&mut simulator, 15.0, [29.0, 505.0, -80.0]);
        throw(&mut simulator, body, [0.0, 0.0, 80.0]);
        let geom = geom_of(&simulator, body);
        run_until_hit(&mut simulator, geom).normal
    });
    assert_eq!(normals[0], Vector3::new(0.0, 0.0, -1.0));
    // A step of 0.8 px of 15.
    assert_near3(normals[1], [0.6, 0.0, -0.8], 0.8 / 15.0);
}

#[test]
fn it_has_no_friction_in_depth_so_a_body_keeps_its_spin_at_a_front() {
    let spins = BOTH.map(|scheme| {
        let mut simulator = with(scheme, 0.0);
        let wall = post(&mut simulator);
        let body = solid(&mut simulator, [30.0, 30.0, 20.0], [0.0, 505.0, -30.0]);
        for body in [wall, body] {
            set_surface(&mut simulator, body, 0.5, 0.0);
        }
        simulator.body_mut(body).unwrap().set_angular_velocity(3.0);
        for _ in 0..200 {
            simulator.body_mut(body).unwrap().apply_force_z(100.0);
            simulator.update(DT);
        }
        simulator.body(body).unwrap().angular_velocity()
    });
    assert_eq!(spins[0], 3.0);
    assert_near(spins[1], 0.0, ROUNDING);
}

#[test]
fn thin_objects_that_are_fast_in_depth_can_miss_each_other_with_both() {
    for scheme in BOTH {
        let mut simulator = with(scheme, 0.0);
        post(&mut simulator);
        let body = solid(&mut simulator, [20.0, 20.0, 10.0], [0.0, 510.0, -60.0]);
        // 120 px per step, 50 px of depth together.
        throw(&mut simulator, body, [0.0, 0.0, 12_000.0]);
        run(&mut simulator, 5);
        assert_eq!(velocity(&simulator, body).z, 12_000.0);
    }
}

#[test]
fn ground_and_platforms_are_the_same_with_both() {
    let ends = BOTH.map(|scheme| {
        let mut simulator = with(scheme, GRAVITY);
        platform(&mut simulator, [200.0, 40.0, 100.0], [0.0, 20.0, 0.0]);
        let on_platform = solid(&mut simulator, [40.0, 20.0, 20.0], [0.0, 100.0, -55.0]);
        let on_ground = ball(&mut simulator, 10.0, [300.0, 100.0, 0.0]);
        for body in [on_platform, on_ground] {
            set_surface(&mut simulator, body, 0.3, 0.3);
        }
        throw(&mut simulator, on_ground, [30.0, 0.0, 40.0]);
        run(&mut simulator, 400);
        [on_platform, on_ground].map(|body| place(&simulator, body))
    });
    assert_eq!(ends[0], ends[1]);
}

#[test]
fn a_wide_profile_makes_the_plane_the_axis_again() {
    // Half the smaller depth counts: two deep objects meet in the plane farther apart.
    let mut simulator = with(DepthScheme::Thesis, 0.0);
    let wall = post(&mut simulator);
    let body = solid(&mut simulator, [20.0, 20.0, 20.0], [-100.0, 510.0, 15.0]);
    let geoms = [wall, body].map(|body| geom_of(&simulator, body));
    for geom in geoms {
        simulator.set_depth_profile(geom, DepthProfile::Prism { depth: 40.0 }).unwrap();
    }
    throw(&mut simulator, body, [80.0, 0.0, 0.0]);
    let hit = run_until_hit(&mut simulator, geoms[1]);
    assert_eq!(hit.axis, Axis::Plane);
    run(&mut simulator, 1);
    assert!(collisions_of(&simulator, geoms[1]).iter().all(|collision| collision.axis == Axis::Plane));
}

#[test]
fn objects_made_before_another_scheme_was_chosen_meet_with_it() {
    for scheme in BOTH {
        let mut simulator =
            TwoHalfPhysicsSimulator::with_angle_and_gravity(600, 60, Vector2::new(0.0, 100.0)).unwrap();
        let below = solid(&mut simulator, [300.0, 20.0, 20.0], [0.0, 0.0, 0.0]);
        let above = solid(&mut simulator, [24.0, 16.0, 16.0], [0.0, 20.0, 0.0]);
        simulator.set_depth_scheme(scheme).unwrap();
        (0..60).for_each(|_| simulator.update(0.01));
        let height = |body: BodyId| simulator.body(body).unwrap().position3d().y;
        // Without contacts it falls 18 px.
        assert!(height(above) - height(below) > 19.0, "{scheme:?}: {}", height(above));
    }
}
