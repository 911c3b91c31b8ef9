//! Tests that the measures of the chart are correct for rolling bodies, and that the law of a rolling polygon is.

use crate::common::told::{assert_no_error, chart, flat, starts, watched};
use approx::assert_relative_eq;
use measure::closed_forms::{RollingPolygon, rolling_acceleration};
use std::f64::consts::PI;

/// Gravity of the scenes, px/s².
const GRAVITY: f64 = 320.0;

/// Returns the position of a body, in px, that has moved from `start` down a slope by the distance `way`. `angle` in radians.
fn down_slope(start: [f64; 2], angle: f64, way: f64) -> [f64; 2] {
    [start[0] + way * angle.cos(), start[1] + way * angle.sin()]
}

#[test]
fn rolling_by_the_law_has_no_error_and_sliding_is_half_as_fast_again() {
    let angle = PI / 9.0;
    let start = starts(&(chart("roll_circle").build)(0))[1].position_in_plane();
    // A rolling disc has two thirds of the acceleration of a body that slides without friction.
    let rolling = 2.0 / 3.0 * GRAVITY * angle.sin();
    assert_no_error("roll_circle", 0.01, 1e-6, |time, states| {
        states[1].position = flat(down_slope(start, angle, rolling * time * time / 2.0));
    });
    let (error, _) = watched("roll_circle", 0.01, |time, states| {
        states[1].position = flat(down_slope(start, angle, 1.5 * rolling * time * time / 2.0));
    });
    assert_relative_eq!(error, 50.0, max_relative = 1e-6);
    assert_relative_eq!(
        rolling_acceleration(GRAVITY, angle, 2.0, 3.0, 9.0),
        2.0 / 3.0 * GRAVITY * angle.sin()
    );
}

/// Returns a polygon that stands on a corner. It has the mass and inertia of a disc of 1 kg with a radius of 16 px. `slope` in
/// radians.
fn polygon(corners: u32, slope: f64) -> RollingPolygon {
    let (radius, mass, inertia, gravity) = (16.0, 1.0, 128.0, GRAVITY);
    RollingPolygon { corners, radius, mass, inertia, gravity, slope, foot: 0.0, lean: 0.0, rate: 0.0 }
}

#[test]
fn a_polygon_that_rolls_by_the_law_has_no_error_and_one_that_comes_a_tenth_too_far_has_that_error() {
    let slope = PI / 30.0;
    let start = starts(&(chart("roll_polygon").build)(0))[1].position_in_plane();
    // The law uses finer steps than the scene: how often it is called makes a difference of rounding only.
    let error = |share: f64| {
        let mut law = polygon(16, slope);
        watched("roll_polygon", 0.01, |_, states| {
            law.roll(0.01);
            states[1].position = flat(down_slope(start, slope, share * law.way()));
        })
        .0
    };
    assert!(error(1.0) < 1e-6, "{}", error(1.0));
    assert_relative_eq!(error(1.1), 10.0, max_relative = 1e-6);
}

#[test]
fn a_circle_does_not_roll_by_the_law_of_a_polygon() {
    let slope = PI / 30.0;
    let start = starts(&(chart("roll_polygon").build)(0))[1].position_in_plane();
    let rolling = rolling_acceleration(GRAVITY, slope, 1.0, 16.0, 128.0);
    let (error, _) = watched("roll_polygon", 0.01, |time, states| {
        states[1].position = flat(down_slope(start, slope, rolling * time * time / 2.0));
    });
    assert!(error > 50.0, "{error}");
}

#[test]
fn a_polygon_keeps_its_energy_between_corners_and_loses_the_lawful_share_at_each() {
    let mut polygon = polygon(16, PI / 30.0);
    let (foot, energy) = (polygon.foot, polygon.energy());
    let mut before = polygon;
    while polygon.foot == foot {
        before = polygon;
        assert_relative_eq!(polygon.energy(), energy, max_relative = 1e-6);
        polygon.roll(1e-4);
    }
    // An impact at a corner keeps (I + m r^2 cos(2 pi / n)) / (I + m r^2) of the angular velocity. Between impacts it changes
    // by less than 1e-3 of itself in a step of 1e-4 s.
    let kept = (128.0 + 256.0 * (PI / 8.0).cos()) / (128.0 + 256.0);
    assert_relative_eq!(polygon.rate / before.rate, kept, max_relative = 1e-3);
    // The foot has advanced by the length of an edge.
    assert_relative_eq!(polygon.foot, 32.0 * (PI / 16.0).sin());
}

#[test]
fn the_terminal_rate_of_a_polygon_balances_corner_losses_and_the_slope() {
    let slope = PI / 30.0;
    let mut polygon = polygon(16, slope);
    polygon.roll(30.0);
    let (mut foot, mut fastest) = (polygon.foot, 0.0_f64);
    for _ in 0..3 {
        while polygon.foot == foot {
            fastest = fastest.max(polygon.rate);
            polygon.roll(1e-5);
        }
        foot = polygon.foot;
    }
    // From corner to corner the polygon descends by the length of an edge times the sine of the slope. Each impact keeps the
    // fraction `kept` of the angular velocity.
    let kept = (128.0 + 256.0 * (PI / 8.0).cos()) / 384.0_f64;
    let gain = 2.0 * GRAVITY * 32.0 * (PI / 16.0).sin() * slope.sin() / 384.0;
    assert_relative_eq!(fastest, (gain / (1.0 - kept * kept)).sqrt(), max_relative = 1e-4);
}

#[test]
fn a_polygon_of_many_corners_rolls_nearly_as_a_circle() {
    let slope = PI / 30.0;
    let way = 12.5 * rolling_acceleration(GRAVITY, slope, 1.0, 16.0, 128.0);
    let lost = |corners: u32| {
        let mut polygon = polygon(corners, slope);
        polygon.roll(5.0);
        1.0 - polygon.way() / way
    };
    let [some, more, most] = [500, 1000, 2000].map(lost);
    // The loss at corners is proportional to their distance: it nearly halves when the number of corners doubles.
    assert!(most > 0.0 && most < 0.01, "{most}");
    assert_relative_eq!(some / more, 2.0, max_relative = 0.1);
    assert_relative_eq!(more / most, 2.0, max_relative = 0.1);
}

#[test]
fn a_polygon_at_rest_is_carried_by_its_corner() {
    let mut level = polygon(16, 0.0);
    // Straight above its corner and on level ground, the polygon has no torque.
    assert_relative_eq!(level.push()[1], GRAVITY);
    assert_relative_eq!(level.push()[0], 0.0);
    // The rotation about the corner reduces the supporting force by m w^2 r.
    level.rate = 2.0;
    assert_relative_eq!(level.push()[1], GRAVITY - 64.0);
}
