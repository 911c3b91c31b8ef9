//! The fixed-step clock, and poses between two updates.

use std::time::Duration;

use conformance::fixtures::plane::{simulator, v};
use farseer_core::{BodyFactory, BodyId, BodyInterpolation, FixedStepClock, PhysicsSimulator};
use proptest::prelude::*;

fn milliseconds(count: u64) -> Duration {
    Duration::from_millis(count)
}

fn clock_of(target: u64) -> FixedStepClock {
    FixedStepClock::new(milliseconds(target)).unwrap()
}

#[test]
fn updates_are_due_when_their_time_has_passed() {
    let mut clock = clock_of(10);
    assert_eq!([4, 5, 1, 25, 5].map(|elapsed| clock.advance(milliseconds(elapsed))), [0, 0, 1, 2, 1]);
}

#[test]
fn the_rest_of_a_frame_is_part_of_the_next_update() {
    let mut clock = clock_of(16);
    clock.advance(milliseconds(20));
    assert_eq!(clock.interpolation(), 0.25);
    clock.reset();
    assert_eq!(clock.interpolation(), 0.0);
}

#[test]
fn a_frame_catches_up_with_a_limited_number_of_updates() {
    let mut clock = clock_of(10);
    clock.set_max_updates(3).unwrap();
    assert_eq!(clock.advance(milliseconds(1004)), 3);
    assert_eq!(clock.interpolation(), 0.4);
    assert_eq!(clock.advance(milliseconds(5)), 0);
}

#[test]
fn a_game_runs_slowly_while_more_than_one_update_is_due() {
    let mut clock = clock_of(10);
    let is_slow = |clock: &mut FixedStepClock, elapsed| {
        clock.advance(milliseconds(elapsed));
        clock.is_running_slowly()
    };
    assert_eq!(
        [10, 19, 1, 20, 3].map(|elapsed| is_slow(&mut clock, elapsed)),
        [false, false, false, true, false]
    );
}

#[test]
fn a_frame_of_any_length_is_survived() {
    let mut clock = FixedStepClock::new(Duration::MAX).unwrap();
    assert_eq!(clock.advance(Duration::MAX), 1);
    let mut clock = FixedStepClock::new(Duration::from_nanos(1)).unwrap();
    clock.set_max_updates(u32::MAX).unwrap();
    assert_eq!(clock.advance(Duration::MAX), u32::MAX);
    assert!(clock.is_running_slowly() && clock.interpolation() == 0.0);
}

#[test]
fn a_clock_without_length_or_updates_is_refused() {
    assert!(FixedStepClock::new(Duration::ZERO).is_err());
    let mut clock = clock_of(10);
    assert!(clock.set_max_updates(0).is_err() && clock.set_target_elapsed_time(Duration::ZERO).is_err());
    assert_eq!(clock, clock_of(10));
}

/// Behaviour chapter 16, section B: 10 ms are not the float nearest to 0.01.
#[test]
fn milliseconds_become_seconds_as_in_the_samples() {
    assert_eq!(FixedStepClock::dt_of_milliseconds(10).to_bits(), 0x3C23_D70B);
    assert_eq!(FixedStepClock::dt_of_milliseconds(16).to_bits(), (16.0_f32 * 0.001).to_bits());
    assert_eq!(FixedStepClock::default().milliseconds_dt(), FixedStepClock::dt_of_milliseconds(16));
    assert_eq!(FixedStepClock::default().dt(), 0.016_666_7);
}

proptest! {
    #[test]
    fn no_time_is_lost_or_counted_twice(frames in prop::collection::vec(0..1_000_000_u64, 1..60)) {
        let target = 16_666_700;
        let mut clock = FixedStepClock::new(Duration::from_nanos(target)).unwrap();
        clock.set_max_updates(u32::MAX).unwrap();
        let updates: u64 = frames.iter().map(|&ns| u64::from(clock.advance(Duration::from_nanos(ns * 100)))).sum();
        let total: u64 = frames.iter().map(|ns| ns * 100).sum();
        prop_assert_eq!(updates, total / target);
        let left = (total % target) as f64 / target as f64;
        // Each of the quotients' operands, and the quotient, is rounded once.
        approx::assert_relative_eq!(f64::from(clock.interpolation()), left, max_relative = 2.0 * f64::from(f32::EPSILON));
    }
}

/// A body without gravity or drag that flies and spins.
fn flying() -> (PhysicsSimulator, BodyId) {
    let mut simulator = simulator(0.0);
    let body = BodyFactory::create_circle_body_in(&mut simulator, 10.0, 1.0).unwrap();
    let flying = &mut simulator[body];
    flying.set_linear_drag_coefficient(0.0);
    flying.set_rotational_drag_coefficient(0.0);
    flying.set_linear_velocity(v(100.0, -50.0));
    flying.set_angular_velocity(20.0);
    (simulator, body)
}

/// Updates, and remembers.
fn step(simulator: &mut PhysicsSimulator, interpolation: &mut BodyInterpolation) {
    simulator.update(0.01);
    interpolation.remember(simulator);
}

#[test]
fn poses_run_from_the_last_update_but_one_to_the_last() {
    let (mut simulator, body) = flying();
    let mut interpolation = BodyInterpolation::new();
    step(&mut simulator, &mut interpolation);
    let before = (simulator[body].position(), simulator[body].total_rotation());
    step(&mut simulator, &mut interpolation);
    let after = (simulator[body].position(), simulator[body].total_rotation());
    let pose = |fraction| {
        let pose = interpolation.pose(body, fraction).unwrap();
        (pose.position, pose.rotation)
    };
    assert_eq!((pose(0.0), pose(1.0)), (before, after));
    // Half of a sum of two floats, rounded once.
    let half = |a: f32, b: f32| ((f64::from(a) + f64::from(b)) / 2.0) as f32;
    let middle = v(half(before.0.x, after.0.x), half(before.0.y, after.0.y));
    assert_eq!(pose(0.5), (middle, half(before.1, after.1)));
    assert_eq!((pose(-1.0), pose(2.0), pose(f32::NAN)), (before, after, after));
}

/// 20 rad/s for 0.01 s.
#[test]
fn a_full_turn_is_no_jump() {
    let (mut simulator, body) = flying();
    let mut interpolation = BodyInterpolation::new();
    let mut last = 0.0;
    for update in 0..100 {
        step(&mut simulator, &mut interpolation);
        let rotation = interpolation.pose(body, 0.5).unwrap().rotation;
        if update > 1 {
            approx::assert_abs_diff_eq!(rotation - last, 0.2, epsilon = 1e-5);
        }
        last = rotation;
    }
    assert!(simulator[body].revolutions() > 2);
}

/// The interpolated rotations of a body whose angle the game sets before every update: those after the first update, at 0, a
/// third, a half and all of the interval.
fn set_rotations(angles: &[f32]) -> Vec<f32> {
    let mut simulator = simulator(0.0);
    let body = BodyFactory::create_circle_body_in(&mut simulator, 10.0, 1.0).unwrap();
    let mut interpolation = BodyInterpolation::new();
    let mut rotations = Vec::new();
    for &angle in angles {
        simulator[body].set_rotation(angle);
        step(&mut simulator, &mut interpolation);
        rotations.extend(
            [0.0, 0.333, 0.5, 1.0].map(|fraction| interpolation.pose(body, fraction).unwrap().rotation),
        );
    }
    rotations
}

/// Difference of two angles, up to full turns. Totals here are below 32, where floats are 2e-6 apart.
fn assert_same_direction(angle: f32, other: f32) {
    use std::f64::consts::TAU;
    let turns = f64::from(angle - other) / TAU;
    approx::assert_abs_diff_eq!((turns - turns.round()) * TAU, 0.0, epsilon = 1e-5);
}

/// Setting a negative angle takes a full turn off the total every time.
#[test]
fn a_body_set_to_the_same_angle_in_every_update_has_a_constant_pose() {
    for rotation in set_rotations(&[-0.5; 4]) {
        assert_same_direction(rotation, -0.5);
    }
}

#[test]
fn a_body_that_is_set_to_an_angle_turns_the_short_way() {
    let rotations = set_rotations(&[3.1, -3.1]);
    assert_same_direction(rotations[4], 3.1);
    assert_same_direction(rotations[6], std::f32::consts::PI);
    assert_same_direction(rotations[7], -3.1);
}

#[test]
fn a_teleported_body_is_not_interpolated_and_others_are() {
    let (mut simulator, body) = flying();
    let mut interpolation = BodyInterpolation::new();
    let x = |interpolation: &BodyInterpolation| interpolation.pose(body, 0.5).unwrap().position.x;
    step(&mut simulator, &mut interpolation);
    simulator[body].set_position(v(1000.0, 0.0));
    step(&mut simulator, &mut interpolation);
    approx::assert_abs_diff_eq!(x(&interpolation), (1.0 + 1001.0) / 2.0, epsilon = 1e-3);
    simulator[body].set_position(v(5000.0, 0.0));
    interpolation.mark_teleport(body);
    step(&mut simulator, &mut interpolation);
    assert_eq!(x(&interpolation), simulator[body].position().x);
    step(&mut simulator, &mut interpolation);
    approx::assert_abs_diff_eq!(x(&interpolation), 5001.5, epsilon = 1e-2);
}

#[test]
fn a_new_body_is_drawn_where_it_is() {
    let (mut simulator, body) = flying();
    let mut interpolation = BodyInterpolation::new();
    assert_eq!(interpolation.pose(body, 0.5), None);
    step(&mut simulator, &mut interpolation);
    assert_eq!(interpolation.pose(body, 0.0).unwrap().position, simulator[body].position());
}

#[test]
fn a_removed_body_has_no_pose_and_returns_without_interpolation() {
    let (mut simulator, body) = flying();
    let mut interpolation = BodyInterpolation::new();
    step(&mut simulator, &mut interpolation);
    simulator.remove(body).unwrap();
    step(&mut simulator, &mut interpolation);
    assert_eq!(interpolation.pose(body, 0.5), None);
    simulator[body].set_position(v(700.0, 0.0));
    simulator.add(body).unwrap();
    step(&mut simulator, &mut interpolation);
    assert_eq!(interpolation.pose(body, 0.0).unwrap().position, simulator[body].position());
}

#[test]
fn a_reused_slot_does_not_inherit_a_pose() {
    let (mut simulator, body) = flying();
    let mut interpolation = BodyInterpolation::new();
    step(&mut simulator, &mut interpolation);
    simulator.dispose(body).unwrap();
    simulator.process_added_and_removed();
    let heir = BodyFactory::create_circle_body_in(&mut simulator, 10.0, 1.0).unwrap();
    assert_eq!(heir.slot(), body.slot());
    step(&mut simulator, &mut interpolation);
    assert_eq!(interpolation.pose(body, 0.5), None);
    assert_eq!(interpolation.pose(heir, 0.0).unwrap().position, v(0.0, 0.0));
}
