//! Slopes and sheared platforms.
//!
//! Tolerances: an object that is put on a slope falls freely for one step before the first contact. So speeds along the slope
//! differ from a t by less than g dt = 1 px/s, and positions by that over the time. The path is ahead of the parabola by v dt /
//! 2.

use conformance::fixtures::depth::{
    DT, GRAVITY, SLOP, assert_near, assert_near3, ball, collisions_of, geom_of, place, run, run_until_hit,
    set_platform_surface, set_surface, simulator, solid, throw, velocity, weightless,
};
use twohalf::{
    Axis, BodyId, ContactTarget, DepthProfile, Platform, PlatformId, TwoHalfPhysicsSimulator, Vector2,
    Vector3,
};

/// A slope of 400 x 20 x 200 px whose middle is 200 px high, falling to the right by `angle` rad.
fn slope(simulator: &mut TwoHalfPhysicsSimulator, angle: f32, friction: f32) -> PlatformId {
    let middle = Vector3::new(0.0, 190.0, 0.0);
    let id = Platform::with_rotation(simulator, 400.0, 20.0, 200.0, middle, angle, None).unwrap();
    set_platform_surface(simulator, id, friction, 0.0);
    id
}

/// Down the slope, in X and Y.
fn down(angle: f32) -> Vector3 {
    let sign = angle.signum();
    Vector3::new(sign * angle.cos(), -angle.abs().sin(), 0.0)
}

/// Out of the slope's upper side.
fn out_of(angle: f32) -> Vector3 {
    Vector3::new(angle.sin(), angle.cos(), 0.0)
}

/// Puts the origin of a body over the slope: `along` px down it from its middle and `over` px away from its upper side.
fn put(simulator: &mut TwoHalfPhysicsSimulator, body: BodyId, angle: f32, along: f32, over: f32) {
    let origin = Vector3::new(0.0, 200.0, 0.0) + down(angle) * along + out_of(angle) * (10.0 + over);
    let mut view = simulator.body_mut(body).unwrap();
    view.core_mut().set_position(Vector2::new(origin.x, -origin.y));
}

/// A 40 x 20 x 30 box lying on the slope.
fn box_on(simulator: &mut TwoHalfPhysicsSimulator, angle: f32, along: f32, friction: f32) -> BodyId {
    let body = solid(simulator, [40.0, 20.0, 30.0], [0.0, 0.0, 10.0]);
    set_surface(simulator, body, friction, 0.0);
    simulator.body_mut(body).unwrap().set_rotation(angle);
    put(simulator, body, angle, along, 10.0);
    body
}

/// A ball of radius 15 touching the slope.
fn ball_on(simulator: &mut TwoHalfPhysicsSimulator, angle: f32, along: f32, friction: f32) -> BodyId {
    let body = ball(simulator, 15.0, [0.0, 0.0, 10.0]);
    set_surface(simulator, body, friction, 0.0);
    put(simulator, body, angle, along, 15.0);
    body
}

fn origin(simulator: &TwoHalfPhysicsSimulator, body: BodyId) -> Vector3 {
    simulator.body(body).unwrap().origin3d()
}

/// Releases a body for a second and a half and asserts that it goes down the slope with an acceleration.
#[track_caller]
fn assert_accelerates(simulator: &mut TwoHalfPhysicsSimulator, body: BodyId, angle: f32, acceleration: f32) {
    let (time, start) = (1.5, origin(simulator, body));
    run(simulator, 150);
    let speed = velocity(simulator, body);
    let way = origin(simulator, body) - start;
    let step = GRAVITY * DT;
    assert_near(speed.dot(&down(angle)), acceleration * time, step);
    assert_near(
        way.dot(&down(angle)),
        acceleration * time * time / 2.0,
        (step + acceleration * DT / 2.0) * time,
    );
    assert_near(speed.dot(&out_of(angle)), 0.0, step);
    assert_near(way.dot(&out_of(angle)), 0.0, SLOP + 0.02);
}

#[test]
pub(crate) fn a_box_slides_down_a_slope_with_g_times_sine_less_friction_times_cosine() {
    for angle in [0.3, -0.3, 0.6_f32] {
        for friction in [0.0, 0.1, 0.25] {
            let mut simulator = simulator();
            slope(&mut simulator, angle, friction);
            let body = box_on(&mut simulator, angle, -150.0, friction);
            let expected = GRAVITY * (angle.abs().sin() - friction * angle.cos());
            assert_accelerates(&mut simulator, body, angle, expected);
            assert_eq!(place(&simulator, body).z, 10.0);
            // It stays flat on the slope.
            let turned = (simulator.body(body).unwrap().rotation() - angle).sin();
            assert_near(turned, 0.0, 0.005);
        }
    }
}

#[test]
pub(crate) fn a_box_sticks_to_a_slope_below_the_friction_angle() {
    for angle in [0.3, -0.3, 0.6_f32] {
        let friction = angle.abs().tan() * 1.2;
        let mut simulator = simulator();
        slope(&mut simulator, angle, friction);
        let body = box_on(&mut simulator, angle, 0.0, friction);
        run(&mut simulator, 100);
        let settled = origin(&simulator, body);
        run(&mut simulator, 1000);
        // Ten seconds; it may creep by a slop.
        assert_near3(origin(&simulator, body), settled.into(), SLOP);
    }
}

#[test]
pub(crate) fn a_box_above_the_friction_angle_does_not_stick() {
    let (angle, friction) = (0.3_f32, 0.3_f32.tan() * 0.9);
    let mut simulator = simulator();
    slope(&mut simulator, angle, friction);
    let body = box_on(&mut simulator, angle, 0.0, friction);
    assert_accelerates(&mut simulator, body, angle, GRAVITY * (angle.sin() - friction * angle.cos()));
    assert!(velocity(&simulator, body).norm() > 3.0);
}

#[test]
pub(crate) fn a_ball_rolls_down_a_slope_with_g_times_sine_over_1_plus_its_inertia() {
    for angle in [0.3, -0.3, 0.5_f32] {
        for inertia in [0.5, 0.4, 1.0] {
            let mut simulator = simulator();
            slope(&mut simulator, angle, 0.6);
            let body = ball_on(&mut simulator, angle, -150.0, 0.6);
            let mut view = simulator.body_mut(body).unwrap();
            view.core_mut().set_moment_of_inertia(inertia * 15.0 * 15.0).unwrap();
            let expected = GRAVITY * angle.abs().sin() / (1.0 + inertia);
            assert_accelerates(&mut simulator, body, angle, expected);
            // It rolls: its rim runs as fast as it does.
            let speed = velocity(&simulator, body).dot(&down(angle));
            let rim = simulator.body(body).unwrap().angular_velocity() * 15.0 * angle.signum();
            assert_near(rim, speed, GRAVITY * DT);
        }
    }
}

#[test]
pub(crate) fn a_ball_without_friction_slides_down_a_slope_without_turning() {
    let mut simulator = simulator();
    slope(&mut simulator, 0.4, 0.0);
    let body = ball_on(&mut simulator, 0.4, -150.0, 0.0);
    assert_accelerates(&mut simulator, body, 0.4, GRAVITY * 0.4_f32.sin());
    // The normal leads through its middle but for rounding.
    assert_near(simulator.body(body).unwrap().angular_velocity(), 0.0, 1e-5);
}

#[test]
pub(crate) fn a_ball_that_rolls_across_a_slope_keeps_its_velocity_in_depth() {
    let angle = 0.3_f32;
    let mut simulator = simulator();
    slope(&mut simulator, angle, 0.8);
    let body = ball_on(&mut simulator, angle, -150.0, 0.8);
    // Rolling along Z: normal x velocity / radius, in the frame with y down.
    let (normal, along) = (Vector3::new(angle.sin(), -angle.cos(), 0.0), Vector3::new(0.0, 0.0, 30.0));
    let mut view = simulator.body_mut(body).unwrap();
    view.set_linear_velocity_z(30.0);
    view.set_angular_velocity3d(normal.cross(&along) / 15.0);
    assert_accelerates(&mut simulator, body, angle, GRAVITY * angle.sin() / 1.5);
    // The forces have no component along Z; five iterations per step leave a small one.
    assert_near(velocity(&simulator, body).z, 30.0, 0.05);
}

#[test]
pub(crate) fn friction_on_a_slope_turns_a_sliding_box_down_and_slows_it_along_z() {
    // Full sliding: the friction mu N is against the velocity, so along Z it begins with mu g cos a.
    let (angle, friction) = (0.3_f32, 0.2);
    let mut simulator = simulator();
    slope(&mut simulator, angle, friction);
    let body = box_on(&mut simulator, angle, -100.0, friction);
    throw(&mut simulator, body, [0.0, 0.0, 150.0]);
    run(&mut simulator, 20);
    let before = velocity(&simulator, body).z;
    run(&mut simulator, 10);
    // It slides down at less than 9 px/s beside 140, so the share along Z is less by up to half of the square of that.
    let lost = friction * GRAVITY * angle.cos() * 0.1;
    assert_near(velocity(&simulator, body).z, before - lost, 0.01 * lost);
    assert!(velocity(&simulator, body).dot(&down(angle)) > 2.0);
}

#[test]
pub(crate) fn a_box_walks_off_a_slope_along_z() {
    let mut simulator = simulator();
    slope(&mut simulator, 0.3, 2.0);
    let body = box_on(&mut simulator, 0.3, 0.0, 2.0);
    run(&mut simulator, 50);
    simulator.body_mut(body).unwrap().set_position3d(Vector3::new(0.0, 300.0, 120.0));
    // It falls for four seconds, bounces on a corner, and has toppled flat after less than seven.
    run(&mut simulator, 500);
    assert_near(place(&simulator, body).y, 0.0, SLOP + 0.1);
}

/// A sheared platform of 100 x 40 x 80 in a simulator whose Z axis is at 60 degrees. It has X from -50 to 50 and Z from 20 to
/// 100 about its middle, top at 60. `angle` is that of its edges in depth.
fn sheared(simulator: &mut TwoHalfPhysicsSimulator, angle: i32) -> PlatformId {
    let position = Vector3::new(0.0, 20.0, 60.0);
    Platform::with_rotation_and_angle(simulator, 100.0, 40.0, 80.0, position, 0.0, None, angle).unwrap()
}

/// Shift in X per px of depth.
fn shear_of(angle: i32) -> f32 {
    let cot = |angle: i32| f64::from(angle).to_radians().tan().recip();
    (cot(angle) - cot(60)) as f32
}

const ANGLES: [i32; 4] = [90, 120, 45, 60];

/// A point of the top of a sheared platform from its drawn corners: `across` and `deep` from -1 to 1.
fn on_top(simulator: &TwoHalfPhysicsSimulator, id: PlatformId, across: f32, deep: f32) -> Vector3 {
    let corners = simulator.platform(id).unwrap().corners();
    let [front_left, front_right, back_left, back_right] = [corners[0], corners[1], corners[4], corners[5]];
    let at = |left: Vector3, right: Vector3| left + (right - left) * (across * 0.5 + 0.5);
    let (front, back) = (at(front_left, front_right), at(back_left, back_right));
    front + (back - front) * (deep * 0.5 + 0.5)
}

#[test]
pub(crate) fn the_edges_of_a_sheared_platform_run_at_its_angle_on_the_screen() {
    for angle in ANGLES {
        let mut simulator = simulator();
        let id = sheared(&mut simulator, angle);
        let corners = simulator.platform(id).unwrap().corners();
        for corner in 0..4 {
            let [front, back] =
                [corners[corner], corners[corner + 4]].map(|at| simulator.projection().to_screen(at));
            let along = back - front;
            let drawn = f64::from(-along.y).atan2(f64::from(along.x)).to_degrees();
            assert!((drawn - f64::from(angle)).abs() < 1e-4, "{drawn} is not {angle}");
        }
    }
}

#[test]
pub(crate) fn objects_stand_everywhere_on_the_top_of_a_sheared_platform_as_it_is_drawn() {
    for angle in ANGLES {
        for across in [-0.9, 0.0, 0.9] {
            for deep in [-0.9, 0.0, 0.9] {
                for is_ball in [true, false] {
                    let mut simulator = simulator();
                    let id = sheared(&mut simulator, angle);
                    let at = on_top(&simulator, id, across, deep) + Vector3::new(0.0, 5.0, 0.0);
                    let body = match is_ball {
                        true => ball(&mut simulator, 5.0, at.into()),
                        false => solid(&mut simulator, [10.0, 10.0, 4.0], at.into()),
                    };
                    run(&mut simulator, 150);
                    let end = place(&simulator, body);
                    assert_near3(end, [at.x, 60.0, at.z], SLOP + 0.05);
                }
            }
        }
    }
}

#[test]
pub(crate) fn objects_fall_beside_the_slanted_edges_of_a_sheared_platform() {
    for angle in ANGLES {
        for sign in [-1.0, 1.0] {
            for deep in [-0.8, 0.0, 0.8] {
                for is_ball in [true, false] {
                    let mut simulator = simulator();
                    let id = sheared(&mut simulator, angle);
                    // Half of 10 px and half of the depth of 4 px along the slanted edge are beyond it, and a little.
                    let beside = 5.0 + 2.0 * shear_of(angle).abs() + 1.0;
                    let stretch = (1.0 + shear_of(angle).powi(2)).sqrt();
                    let beside = beside.max(5.0 * stretch + 1.0);
                    let at = on_top(&simulator, id, sign, deep) + Vector3::new(sign * beside, 5.0, 0.0);
                    let body = match is_ball {
                        true => ball(&mut simulator, 5.0, at.into()),
                        false => solid(&mut simulator, [10.0, 10.0, 4.0], at.into()),
                    };
                    run(&mut simulator, 250);
                    assert_near3(place(&simulator, body), [at.x, 0.0, at.z], SLOP + 0.05);
                }
            }
        }
    }
}

#[test]
pub(crate) fn a_ball_rolls_off_the_slanted_edge_of_a_sheared_platform() {
    for sign in [-1.0, 1.0] {
        let mut simulator = simulator();
        sheared(&mut simulator, 90);
        let body = ball(&mut simulator, 5.0, [0.0, 60.0, 60.0]);
        throw(&mut simulator, body, [sign * 40.0, 0.0, 0.0]);
        let mut is_over = true;
        for _ in 0..400 {
            simulator.update(DT);
            let at = place(&simulator, body);
            is_over &= (at.x - shear_of(90) * (at.z - 60.0)) * sign < 50.0;
            if is_over {
                assert_near(at.y, 60.0, SLOP + 0.05);
            }
        }
        assert_near(place(&simulator, body).y, 0.0, SLOP + 0.05);
    }
}

/// The right side's normal of a sheared platform: (1, 0, -k) made a unit vector; the left side's is against it.
fn side_normal(angle: i32, sign: f32) -> Vector3 {
    let shear = shear_of(angle);
    Vector3::new(sign, 0.0, -sign * shear) / (1.0 + shear * shear).sqrt()
}

#[test]
pub(crate) fn the_slanted_sides_of_a_sheared_platform_throw_balls_and_boxes_back_along_x_and_z() {
    for angle in ANGLES {
        for sign in [-1.0, 1.0] {
            for is_ball in [true, false] {
                let mut simulator = weightless();
                let id = sheared(&mut simulator, angle);
                set_platform_surface(&mut simulator, id, 0.0, 1.0);
                let body = match is_ball {
                    true => ball(&mut simulator, 5.0, [sign * 120.3, 34.0, 61.0]),
                    false => solid(&mut simulator, [10.0, 10.0, 8.0], [sign * 120.3, 34.0, 61.0]),
                };
                set_surface(&mut simulator, body, 0.0, 1.0);
                throw(&mut simulator, body, [-sign * 70.0, 0.0, 0.0]);
                let geom = geom_of(&simulator, body);
                let hit = run_until_hit(&mut simulator, geom);
                let normal = side_normal(angle, sign);
                // The side's normal is computed once in f32.
                assert!(
                    (hit.normal - normal).norm() < 1e-5,
                    "{angle}, ball: {is_ball}: {:?} {normal:?}",
                    hit.normal
                );
                assert_eq!(hit.axis, if angle == 60 { Axis::Plane } else { Axis::Oblique });
                run(&mut simulator, 20);
                let before = Vector3::new(-sign * 70.0, 0.0, 0.0);
                let expected = before - normal * (2.0 * before.dot(&normal));
                assert_near3(velocity(&simulator, body), expected.into(), 0.01);
            }
        }
    }
}

#[test]
fn a_ball_stops_at_the_slanted_side_where_it_is_drawn() {
    for angle in ANGLES {
        for sign in [-1.0, 1.0] {
            let mut simulator = weightless();
            let id = sheared(&mut simulator, angle);
            let body = ball(&mut simulator, 5.0, [sign * 120.3, 34.0, 61.0]);
            throw(&mut simulator, body, [-sign * 70.0, 0.0, 0.0]);
            let geom = geom_of(&simulator, body);
            run_until_hit(&mut simulator, geom);
            assert_eq!(collisions_of(&simulator, geom)[0].partner, ContactTarget::Platform(id));
            // The distance of its middle from the side's plane is within a step of its radius.
            let away = (origin(&simulator, body) - Vector3::new(0.0, 40.0, 60.0))
                .dot(&side_normal(angle, sign))
                - 50.0 / (1.0 + shear_of(angle).powi(2)).sqrt();
            assert!(away <= 5.0 && away > 5.0 - 2.0 * 70.0 * DT, "{away}");
        }
    }
}

#[test]
pub(crate) fn the_front_of_a_sheared_platform_is_where_its_front_corners_are() {
    // At 120 degrees the front is 40 * 1.1547 px to the right of the middle.
    let shift = -40.0 * shear_of(120);
    for (x, is_hit) in
        [(shift - 50.0, true), (shift + 50.0, true), (shift - 66.0, false), (shift + 66.0, false)]
    {
        let mut simulator = weightless();
        sheared(&mut simulator, 120);
        let body = solid(&mut simulator, [10.0, 10.0, 4.0], [x, 34.0, -20.3]);
        throw(&mut simulator, body, [0.0, 0.0, 50.0]);
        run(&mut simulator, 80);
        let speed = velocity(&simulator, body).z;
        // Missing the front it meets a slanted side only deeper than this, on one of the two.
        assert_eq!(speed == 0.0, is_hit, "{x}: {speed}");
    }
}

#[test]
pub(crate) fn a_thin_platform_carries_a_sheet_without_depth() {
    let mut simulator = simulator();
    sheared(&mut simulator, 90);
    let body = solid(&mut simulator, [10.0, 10.0, 4.0], [0.0, 70.0, 60.0]);
    let geom = geom_of(&simulator, body);
    simulator.set_depth_profile(geom, DepthProfile::Prism { depth: 0.0 }).unwrap();
    run(&mut simulator, 150);
    assert_near3(place(&simulator, body), [0.0, 60.0, 60.0], SLOP + 0.05);
}
