//! Surfaces of several parts do not stop bodies that slide, walk or roll along them: walls, slopes, the foot of a slope. Seams
//! of level floors are in `platforms` and `meeting`.

use conformance::fixtures::depth::{
    DT, GRAVITY, SLOP, ball, fix, place, platform, run, set_platform_surface, set_surface, simulator, solid,
    throw, velocity,
};
use twohalf::{BodyId, Platform, TwoHalfPhysicsSimulator, Vector2, Vector3};

/// Number of starting positions per case: the phases of a step at which the seam is crossed.
const PHASES: usize = 25;

/// A box of 40 x 20 x 20 or a ball of radius 10.
fn object(simulator: &mut TwoHalfPhysicsSimulator, is_ball: bool, place: [f32; 3]) -> BodyId {
    match is_ball {
        true => ball(simulator, 10.0, place),
        false => solid(simulator, [40.0, 20.0, 20.0], place),
    }
}

/// Walks along a wall of two platforms or crates side by side, pressing against it, by setting the velocity before every update
/// as games do. Returns the distance along the wall in 3 s at 40 px/s.
fn way_along_wall(is_platform: bool, is_ball: bool, is_front: bool, press: f32, phase: usize) -> f32 {
    let mut simulator = simulator();
    for sign in [-1.0, 1.0] {
        let (size, at) = match is_front {
            true => ([200.0, 80.0, 100.0], [100.0 * sign, 0.0, 100.0]),
            false => ([100.0, 80.0, 200.0], [100.0, 0.0, 100.0 * sign]),
        };
        if is_platform {
            platform(&mut simulator, size, at);
        } else {
            let part = solid(&mut simulator, size, at);
            fix(&mut simulator, part);
        }
    }
    let start = -60.0 - 40.0 * DT * phase as f32 / PHASES as f32;
    let at = match is_front {
        true => [start, 0.0, 35.0],
        false => [if is_ball { 35.0 } else { 25.0 }, 0.0, start],
    };
    let body = object(&mut simulator, is_ball, at);
    // Upright, as figures of games are: at every corner a box would rattle instead.
    simulator.body_mut(body).unwrap().core_mut().set_moment_of_inertia(1e12).unwrap();
    for _ in 0..300 {
        let up = velocity(&simulator, body).y;
        let wanted = if is_front { [40.0, up, press] } else { [press, up, 40.0] };
        throw(&mut simulator, body, wanted);
        simulator.update(DT);
    }
    let end = place(&simulator, body);
    if is_front { end.x - start } else { end.z - start }
}

/// Balls and boxes, along fronts and along sides, pressing more and less.
fn assert_all_walk_along(is_platform: bool) {
    for is_ball in [true, false] {
        for is_front in [true, false] {
            for press in [10.0, 40.0, 100.0] {
                for phase in 0..PHASES {
                    let way = way_along_wall(is_platform, is_ball, is_front, press, phase);
                    // Without friction no force acts along the wall.
                    let case = format!("ball: {is_ball}, front: {is_front}, {press} px/s, phase {phase}");
                    assert!((way - 120.0).abs() < 0.1, "{case}: {way}");
                }
            }
        }
    }
}

#[test]
fn a_figure_pressed_against_a_wall_of_two_platforms_slides_over_the_seam() {
    assert_all_walk_along(true);
}

#[test]
fn a_figure_pressed_against_a_wall_of_two_crates_slides_over_the_seam() {
    assert_all_walk_along(false);
}

/// A platform of 200 x 20 x 200 whose upper side begins at (0, 100) and rises by `angle` to the right.
fn ramp(simulator: &mut TwoHalfPhysicsSimulator, angle: f32) {
    let (sin, cos) = angle.sin_cos();
    let middle = Vector3::new(100.0 * cos + 10.0 * sin, 100.0 + 100.0 * sin - 10.0 * cos, 0.0);
    let position = middle - Vector3::new(0.0, 10.0, 0.0);
    Platform::with_rotation(simulator, 200.0, 20.0, 200.0, position, -angle, None).unwrap();
}

/// Makes steps until a body is beyond an X, or a second and a half longer than 20 px/s take for 40 px.
fn run_to(simulator: &mut TwoHalfPhysicsSimulator, body: BodyId, x: f32) {
    for _ in 0..350 {
        if place(simulator, body).x >= x {
            return;
        }
        simulator.update(DT);
    }
}

#[test]
pub(crate) fn a_box_slides_from_a_level_platform_onto_a_slope() {
    for speed in [20.0, 50.0, 100.0, 200.0_f32] {
        for angle in [0.05, 0.1, 0.2, 0.3_f32] {
            for phase in 0..PHASES {
                let mut simulator = simulator();
                platform(&mut simulator, [200.0, 20.0, 200.0], [-100.0, 80.0, 0.0]);
                ramp(&mut simulator, angle);
                let start = -40.0 - speed * DT * phase as f32 / PHASES as f32;
                let body = solid(&mut simulator, [40.0, 20.0, 20.0], [start, 102.0, 0.0]);
                run(&mut simulator, 100);
                throw(&mut simulator, body, [speed, 0.0, 0.0]);
                // Its leading corner is at most two steps beyond the foot.
                run_to(&mut simulator, body, -20.0 + speed * DT);
                // A corner that meets the slope without friction loses at most v sin a along the slope's normal.
                let least = speed * angle.cos().powi(2);
                let after = velocity(&simulator, body).x;
                assert!(after > least - 0.01 * speed, "{speed} px/s, {angle} rad, phase {phase}: {after}");
            }
        }
    }
}

#[test]
pub(crate) fn a_ball_rolls_from_a_level_platform_onto_a_slope() {
    for speed in [20.0, 50.0, 100.0, 200.0_f32] {
        for angle in [0.05, 0.1, 0.2, 0.3_f32] {
            for phase in 0..PHASES {
                let mut simulator = simulator();
                platform(&mut simulator, [200.0, 20.0, 200.0], [-100.0, 80.0, 0.0]);
                ramp(&mut simulator, angle);
                let start = -30.0 - speed * DT * phase as f32 / PHASES as f32;
                let body = ball(&mut simulator, 10.0, [start, 102.0, 0.0]);
                run(&mut simulator, 100);
                throw(&mut simulator, body, [speed, 0.0, 0.0]);
                run_to(&mut simulator, body, speed * DT);
                // It loses at most v sin a along the slope's normal, and g sin a going up, from where it touches the
                // slope, r tan(a / 2) before the foot.
                let steps = 3.0 + 10.0 * (angle / 2.0).tan() / (speed * angle.cos().powi(2) * DT);
                let least = speed * angle.cos().powi(2) - steps * GRAVITY * DT * angle.sin();
                let after = velocity(&simulator, body).x;
                assert!(after > least - 0.01 * speed, "{speed} px/s, {angle} rad, phase {phase}: {after}");
            }
        }
    }
}

/// Two slopes in one line, side by side along X or along Z, and an object that slides over their seam. Returns the greatest
/// deviation from their common plane, and the greatest loss of speed per step.
fn over_slopes(is_ball: bool, friction: f32, along_z: bool, phase: usize) -> [f32; 2] {
    let angle = 0.3_f32;
    let mut simulator = simulator();
    let (down, out) =
        (Vector3::new(angle.cos(), -angle.sin(), 0.0), Vector3::new(angle.sin(), angle.cos(), 0.0));
    let middle = Vector3::new(0.0, 300.0, 0.0);
    for sign in [-100.0, 100.0] {
        let beside = if along_z { Vector3::new(0.0, 0.0, sign) } else { down * sign };
        let position = middle + beside - Vector3::new(0.0, 10.0, 0.0);
        let width = if along_z { 800.0 } else { 200.0 };
        let part =
            Platform::with_rotation(&mut simulator, width, 20.0, 200.0, position, angle, None).unwrap();
        set_platform_surface(&mut simulator, part, friction, 0.0);
    }
    let before = 60.0 + 0.5 * phase as f32 / PHASES as f32;
    let start = middle + out * 20.0 - if along_z { Vector3::new(0.0, 0.0, before) } else { down * before };
    let body = object(&mut simulator, is_ball, [0.0, 0.0, start.z]);
    set_surface(&mut simulator, body, friction, 0.0);
    let mut view = simulator.body_mut(body).unwrap();
    view.set_rotation(if is_ball { 0.0 } else { angle });
    view.core_mut().set_position(Vector2::new(start.x, -start.y));
    view.set_linear_velocity_z(if along_z { 40.0 } else { 0.0 });
    let (mut off, mut lost, mut speed) = (0.0_f32, 0.0_f32, 0.0);
    for step in 0..250 {
        simulator.update(DT);
        let from_middle = simulator.body(body).unwrap().origin3d() - middle;
        let now = velocity(&simulator, body).dot(&down);
        // It falls freely in the first step.
        if step > 3 {
            off = off.max((from_middle.dot(&out) - 20.0).abs());
            lost = lost.max(speed - now);
        }
        speed = now;
        if !along_z && from_middle.dot(&down) > 80.0 {
            break;
        }
    }
    [off, lost]
}

#[test]
pub(crate) fn two_slopes_in_one_line_are_one_slope() {
    for (is_ball, friction) in [(true, 0.0), (true, 0.5), (false, 0.0), (false, 0.1)] {
        for along_z in [true, false] {
            for phase in 0..PHASES {
                let [off, lost] = over_slopes(is_ball, friction, along_z, phase);
                assert!(
                    off < SLOP + 0.02 && lost < 0.1,
                    "ball: {is_ball}, {friction}, {along_z}: {off} {lost}"
                );
            }
        }
    }
}

#[test]
pub(crate) fn a_figure_that_stops_pressing_and_jumps_lands_in_front_of_the_wall() {
    for is_platform in [true, false] {
        for is_ball in [true, false] {
            for [x, z] in [[0.0, 1.0], [0.0, -1.0], [1.0, 0.0], [-1.0, 0.0]] {
                let mut simulator = simulator();
                if is_platform {
                    platform(&mut simulator, [80.0, 40.0, 80.0], [0.0, 0.0, 0.0]);
                } else {
                    let block = solid(&mut simulator, [80.0, 40.0, 80.0], [0.0, 0.0, 0.0]);
                    fix(&mut simulator, block);
                }
                let half = if x != 0.0 && !is_ball { 20.0 } else { 10.0 };
                let away = 40.0 + half + 15.3;
                let body = object(&mut simulator, is_ball, [-x * away, 0.0, -z * away]);
                for _ in 0..80 {
                    let up = velocity(&simulator, body).y;
                    throw(&mut simulator, body, [40.0 * x, up, 40.0 * z]);
                    simulator.update(DT);
                }
                // Against the wall, overlapping by the slop at most. It jumps 84 px, the wall is 40 px high.
                throw(&mut simulator, body, [0.0, 130.0, 0.0]);
                run(&mut simulator, 300);
                let end = place(&simulator, body);
                assert!(end.y < 1.0, "platform: {is_platform}, ball: {is_ball}, {x} {z}: {end:?}");
            }
        }
    }
}

/// A floor of 8 x 8 platforms or crates of 50 x 50 px, its top at 40 px, about the origin.
fn mosaic(simulator: &mut TwoHalfPhysicsSimulator, is_platform: bool) {
    for column in 0..8 {
        for row in 0..8 {
            let at = [50.0 * column as f32 - 175.0, 0.0, 50.0 * row as f32 - 175.0];
            if is_platform {
                platform(simulator, [50.0, 40.0, 50.0], at);
            } else {
                let tile = solid(simulator, [50.0, 40.0, 50.0], at);
                fix(simulator, tile);
            }
        }
    }
}

#[test]
pub(crate) fn a_figure_that_walks_over_a_floor_of_many_platforms_is_not_stopped_by_seams() {
    for is_ball in [true, false] {
        for speed in [13.0, 47.0, 151.0_f32] {
            let mut simulator = simulator();
            mosaic(&mut simulator, true);
            let body = object(&mut simulator, is_ball, [3.0, 41.0, 7.0]);
            run(&mut simulator, 50);
            let turns = (60.0 / speed / DT) as usize;
            for turn in 0..16 {
                // Directions all around, so that it comes back.
                let (sin, cos) = (std::f32::consts::TAU * (turn * 3 % 16) as f32 / 16.0 + 0.1).sin_cos();
                for _ in 0..turns {
                    let before = place(&simulator, body);
                    let up = velocity(&simulator, body).y;
                    throw(&mut simulator, body, [speed * cos, up, speed * sin]);
                    simulator.update(DT);
                    let at = place(&simulator, body);
                    let way = Vector3::new(at.x - before.x, 0.0, at.z - before.z);
                    let wanted = Vector3::new(cos, 0.0, sin) * (speed * DT);
                    assert!(
                        (way - wanted).norm() < 0.01,
                        "ball: {is_ball}, {speed} at {at:?}: {way:?} {wanted:?}"
                    );
                    assert!((at.y - 40.0).abs() < SLOP + 0.02, "ball: {is_ball}, {speed}: {at:?}");
                }
            }
        }
    }
}

#[test]
pub(crate) fn a_figure_that_walks_in_depth_over_a_floor_of_many_crates_is_not_stopped_by_seams() {
    for is_ball in [true, false] {
        for speed in [13.0, 47.0, 151.0_f32] {
            let mut simulator = simulator();
            mosaic(&mut simulator, false);
            // Over a column, or over the seam of two.
            for x in [-175.0, 3.0] {
                let body = object(&mut simulator, is_ball, [x, 41.0, -150.0]);
                run(&mut simulator, 50);
                let start = place(&simulator, body);
                for _ in 0..(300.0 / speed / DT) as usize {
                    let speeds = velocity(&simulator, body);
                    throw(&mut simulator, body, [speeds.x, speeds.y, speed]);
                    simulator.update(DT);
                    let at = place(&simulator, body);
                    assert!((at.y - 40.0).abs() < SLOP + 0.02, "ball: {is_ball}, {speed}: {at:?}");
                }
                let end = place(&simulator, body);
                assert!(
                    (end.z - start.z - 300.0).abs() < speed * DT + 0.1,
                    "ball: {is_ball}, {speed}, {x}: {end:?}"
                );
                assert!((end.x - start.x).abs() < 0.1, "ball: {is_ball}, {speed}, {x}: {end:?}");
            }
        }
    }
}

#[test]
pub(crate) fn the_edge_of_a_seam_under_a_rolling_ball_has_no_impulse() {
    let mut simulator = simulator();
    for sign in [-1.0, 1.0] {
        platform(&mut simulator, [200.0, 20.0, 200.0], [100.0 * sign, 0.0, 0.0]);
    }
    let body = ball(&mut simulator, 10.0, [-20.0, 21.0, 0.0]);
    run(&mut simulator, 100);
    throw(&mut simulator, body, [20.0, 0.0, 0.0]);
    let mut together = 0;
    for _ in 0..200 {
        simulator.update(DT);
        let impulses: Vec<f32> = simulator.contacts().map(|contact| contact.normal_impulse).collect();
        together += usize::from(impulses.len() == 2);
        // A resting ball of mass 1 is carried by the impulse of gravity in a step.
        let carried: f32 = impulses.iter().sum();
        assert!((carried - GRAVITY * DT).abs() < 0.02 * GRAVITY * DT, "{impulses:?}");
    }
    assert!(together > 0);
}
