//! The measures of the chart are right where something rolls, and so is the law of a polygon that does.

use crate::common::told::{assert_right, chart, flat, starts, watched};
use approx::assert_relative_eq;
use measure::closed_forms::{RollingPolygon, rolling_acceleration};
use std::f64::consts::PI;

/// Gravity of the scenes in px/s², as the scenes have it.
const GRAVITY: f64 = 320.0;

/// Where a body on a slope is after it came a way down.
fn down_slope(start: [f64; 2], angle: f64, way: f64) -> [f64; 2] {
    [start[0] + way * angle.cos(), start[1] + way * angle.sin()]
}

#[test]
fn what_rolls_by_the_law_has_no_error_and_what_slides_instead_half_as_much_again() {
    let angle = PI / 9.0;
    let start = starts(&(chart("roll_circle").build)(0))[1].place();
    // A disc rolls with two thirds of the acceleration with which it slides.
    let rolling = 2.0 / 3.0 * GRAVITY * angle.sin();
    assert_right("roll_circle", 0.01, 1e-6, |time, states| {
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

/// A polygon of the mass and inertia of a disc of 1 kg and 16 px, that stands on a corner.
fn polygon(corners: u32, slope: f64) -> RollingPolygon {
    let (radius, mass, inertia, gravity) = (16.0, 1.0, 128.0, GRAVITY);
    RollingPolygon { corners, radius, mass, inertia, gravity, slope, foot: 0.0, lean: 0.0, rate: 0.0 }
}

#[test]
fn a_polygon_that_rolls_by_the_law_has_no_error_and_one_that_comes_a_tenth_too_far_has_that_error() {
    let slope = PI / 30.0;
    let start = starts(&(chart("roll_polygon").build)(0))[1].place();
    // Steps of the law are finer than those of the scene: how often it is asked makes a difference of rounding only.
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
fn what_rolls_as_a_circle_has_not_rolled_as_a_polygon() {
    let slope = PI / 30.0;
    let start = starts(&(chart("roll_polygon").build)(0))[1].place();
    let rolling = rolling_acceleration(GRAVITY, slope, 1.0, 16.0, 128.0);
    let (error, _) = watched("roll_polygon", 0.01, |time, states| {
        states[1].position = flat(down_slope(start, slope, rolling * time * time / 2.0));
    });
    assert!(error > 50.0, "{error}");
}

#[test]
fn a_polygon_keeps_its_energy_from_corner_to_corner_and_loses_the_share_of_its_motion_that_law_says() {
    let mut polygon = polygon(16, PI / 30.0);
    let (foot, energy) = (polygon.foot, polygon.energy());
    let mut before = polygon;
    while polygon.foot == foot {
        before = polygon;
        assert_relative_eq!(polygon.energy(), energy, max_relative = 1e-6);
        polygon.roll(1e-4);
    }
    // (I + m r^2 cos(2 pi / n)) / (I + m r^2); in a step of 1e-4 s the rate itself changes by less than 1e-3.
    let kept = (128.0 + 256.0 * (PI / 8.0).cos()) / (128.0 + 256.0);
    assert_relative_eq!(polygon.rate / before.rate, kept, max_relative = 1e-3);
    // An edge farther.
    assert_relative_eq!(polygon.foot, 32.0 * (PI / 16.0).sin());
}

#[test]
fn a_polygon_comes_to_roll_at_the_rate_at_which_corners_cost_what_the_slope_gives() {
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
    // From corner to corner it falls by an edge times the sine of the slope, and of its energy keeps a share.
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
    // What corners cost goes with their distance: it halves, nearly, when there are twice as many.
    assert!(most > 0.0 && most < 0.01, "{most}");
    assert_relative_eq!(some / more, 2.0, max_relative = 0.1);
    assert_relative_eq!(more / most, 2.0, max_relative = 0.1);
}

#[test]
fn a_polygon_at_rest_is_carried_by_its_corner() {
    let mut level = polygon(16, 0.0);
    // Straight above its corner, and on the level, nothing turns it.
    assert_relative_eq!(level.push()[1], GRAVITY);
    assert_relative_eq!(level.push()[0], 0.0);
    // Turning about the corner takes m w^2 r from what carries it.
    level.rate = 2.0;
    assert_relative_eq!(level.push()[1], GRAVITY - 64.0);
}
