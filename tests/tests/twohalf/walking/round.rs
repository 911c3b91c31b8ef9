//! Figures that are round: cylinders and capsules.

use super::*;

/// Tests of figures of every shape.
const ALL: [fn(); 27] = [
    it_reaches_the_speed_of_the_input_by_its_acceleration_and_keeps_it,
    downhill_it_stays_on_the_floor_in_all_steps_at_the_speed_of_the_input,
    uphill_it_is_as_fast_as_on_level_ground,
    it_stands_on_a_slope_without_sliding,
    it_slides_down_slopes_that_are_too_steep,
    a_lift_carries_it_up_and_down_in_all_steps,
    a_platform_and_a_belt_carry_standing_and_walking_figures,
    a_curb_is_walked_up_without_a_hop_and_without_losing_speed,
    a_curb_is_walked_up_from_a_stand_beside_it,
    an_obstacle_higher_than_a_step_is_a_wall,
    down_a_curb_it_stays_on_the_floor,
    a_figure_pressed_against_a_wall_falls_as_without_it,
    along_a_wall_it_keeps_its_speed,
    it_jumps_to_the_given_height_at_any_step,
    it_may_jump_for_a_while_after_an_edge_and_only_once,
    a_crate_stays_where_a_figure_landed_on_it_and_is_not_dragged_by_walking,
    over_a_row_of_crates_it_does_not_hop,
    it_pushes_light_bodies_and_not_heavy_ones,
    a_blow_throws_it_off_the_floor,
    it_gets_out_of_a_crowd_that_mills_about,
    it_reports_its_ground,
    a_curb_along_z_is_walked_up_too,
    a_low_ceiling_ends_a_jump_and_does_not_hold_the_figure,
    a_figure_that_was_saved_with_the_simulator_goes_on_with_the_same_bits,
    a_released_figure_falls_and_slides_like_any_body,
    invalid_settings_and_inputs_are_refused_without_effect,
    numbers_at_their_limits_are_safe,
];

#[test]
fn a_cylinder_passes_all_tests_of_walking() {
    SHAPE.set(Some(CYLINDER));
    ALL.into_iter().for_each(|test| test());
    SHAPE.set(None);
}

#[test]
fn a_capsule_passes_all_tests_of_walking() {
    SHAPE.set(Some(CAPSULE));
    ALL.into_iter().for_each(|test| test());
    SHAPE.set(None);
}

#[test]
fn round_a_corner_of_a_wall_a_cylinder_slides_and_a_box_does_not() {
    for rate in RATES {
        SHAPE.set(Some(CYLINDER));
        let mut stage = Stage::new(rate, [0.0, 0.0, 12.0]);
        // Its corner is 12 px behind the middle of the figure, and 15 is where it would pass.
        stage.platform([60.0, 80.0, 100.0], [130.0, 0.0, -50.0], 0.0);
        stage.walk(RIGHT, 2.0, |_| {});
        assert!(stage.at().x > 180.0 && stage.at().z > 14.9, "{rate}: {:?}", stage.at());
        SHAPE.set(None);
    }
}

#[test]
fn two_cylinders_that_walk_at_each_other_pass_nineteen_twentieths_aside() {
    for rate in RATES {
        SHAPE.set(Some(DepthProfile::Cylinder { radius: 10.0, height: 60.0 }));
        let mut stage = Stage::new(rate, [0.0, 0.0, 100.0]);
        let other = figure(&mut stage.simulator, [100.0, 0.0, 119.0]);
        let mut walker = CharacterController::new(CharacterSettings::default());
        for _ in 0..(2.0 * rate) as usize {
            let left = MoveInput { x: -150.0, ..STILL };
            stage.simulator.walk(other, &mut walker, left, stage.dt).unwrap();
            stage.step(RIGHT);
        }
        assert!(stage.at().x > 200.0 && place(&stage.simulator, other).x < -100.0, "{rate}");
        // They approach each other at 300 px/s, and overlap for a step.
        let aside = place(&stage.simulator, other).z - stage.at().z;
        assert!((20.0 - 30.0 / rate..21.0).contains(&aside), "{rate}: {aside}");
        SHAPE.set(None);
    }
}

/// A capsule of a radius, 60 px high, on a platform 100 px up whose right side is at X = 0.
fn beside_an_edge(rate: f32, radius: f32, x: f32, height: f32) -> Stage {
    SHAPE.set(Some(DepthProfile::Capsule { radius, height: 60.0 }));
    let mut stage = Stage::new(rate, [x, height, 0.0]);
    SHAPE.set(None);
    stage.platform([400.0, 100.0, 400.0], [-200.0, 0.0, 0.0], 0.0);
    stage
}

#[test]
fn a_capsule_lies_on_a_slope_with_its_round_end() {
    for (degrees, rate) in [10.0, 25.0, 45.0f32].into_iter().flat_map(|it| RATES.map(|rate| (it, rate))) {
        SHAPE.set(Some(CAPSULE));
        let slope = degrees.to_radians();
        let mut stage = Stage::new(rate, [300.0, 520.0 - 300.0 * slope.tan(), 0.0]);
        SHAPE.set(None);
        stage.slope(degrees);
        stage.walk(STILL, 1.0, |_| {});
        let below = 500.0 - stage.at().x * slope.tan();
        // Its lowest point is not where it touches.
        assert_near(stage.soles() - below, 15.0 / slope.cos() - 15.0, 0.1);
        assert!(stage.walker.is_grounded());
    }
}

#[test]
fn a_capsule_sinks_over_an_edge_by_its_roundness_and_falls_where_that_is_too_steep() {
    for (radius, rate) in [8.0, 15.0, 30.0].into_iter().flat_map(|it| RATES.map(|rate| (it, rate))) {
        let mut stage = beside_an_edge(rate, radius, -40.0, 100.0);
        // The position with a slope of 50 degrees.
        let steep = radius * 50f32.to_radians().sin();
        let mut before = stage.at();
        stage.walk(MoveInput { x: 60.0, ..STILL }, 2.0, |stage| {
            let at = stage.at();
            assert!(at.y <= before.y + 0.01 || at.y < 1.0, "{radius} {rate}: {at:?}");
            let past = at.x.max(0.0);
            if past < steep - 60.0 / rate {
                let round = (radius * radius - past * past).sqrt();
                // In a step it goes straight on from its contact.
                let straight = (60.0 / rate) * (60.0 / rate) / (2.0 * radius * 0.64f32.powi(3));
                let above = at.y - 100.0 - (round - radius);
                assert!((-0.1..0.1 + straight).contains(&above), "{radius} {rate}: {at:?} {above}");
                assert!(stage.walker.is_grounded());
            }
            if past > steep + 120.0 / rate {
                assert!(!stage.walker.is_grounded() || at.y < 1.0, "{radius} {rate}: {at:?}");
            }
            before = at;
        });
        assert_near(stage.soles(), 0.0, 0.1);
    }
}

#[test]
fn past_an_edge_a_capsule_stands_where_it_would_on_a_slope_and_slides_off_where_it_would_not() {
    for rate in RATES {
        // 40 and 60 degrees past it.
        let [stands, slides] = [40f32, 60.0].map(|degrees| {
            let (sin, cos) = degrees.to_radians().sin_cos();
            let mut stage = beside_an_edge(rate, 15.0, 15.0 * sin, 100.0 - 15.0 * (1.0 - cos) + 5.0);
            stage.walk(STILL, 2.0, |_| {});
            (stage.at(), stage.walker.is_grounded())
        });
        assert!(stands.1 && slides.1, "{rate}: {stands:?} {slides:?}");
        // The edge turns its fall aside for a step.
        assert_near(stands.0.x, 15.0 * 40f32.to_radians().sin(), 1.0);
        assert_near(stands.0.y, 85.0 + (225.0 - stands.0.x * stands.0.x).sqrt(), 0.1);
        assert_near(slides.0.y, 0.0, 0.1);
    }
}

/// A capsule whose radius is less than a step walks up that all the same, and a thick one hops as little.
#[test]
fn capsules_of_all_radii_walk_up_and_down_a_curb() {
    let curbs = [0.5, 3.0, 7.0];
    for (radius, height) in [6.0, 15.0, 30.0].into_iter().flat_map(|it| curbs.map(|height| (it, height))) {
        for rate in RATES {
            SHAPE.set(Some(DepthProfile::Capsule { radius, height: 60.0 }));
            let mut stage = Stage::new(rate, [0.0; 3]);
            SHAPE.set(None);
            stage.platform([100.0, height, 400.0], [150.0, 0.0, 0.0], 0.0);
            stage.walk(RIGHT, 0.2, |_| {});
            stage.walk(RIGHT, 2.0, |stage| {
                let (at, speed) = (stage.at(), velocity(&stage.simulator, stage.figure).x);
                assert!(stage.walker.is_grounded(), "{radius} {height} {rate}: {at:?}");
                assert!(at.y <= height + 0.2, "{radius} {height} {rate}: {at:?}");
                // A figure that comes down lands, with friction on the object below.
                assert!(speed > 140.0 || at.x > 200.0, "{radius} {height} {rate}: {speed} {at:?}");
                if (100.0..200.0).contains(&at.x) {
                    assert!(at.y > height - 0.1, "{radius} {height} {rate}: {at:?}");
                }
            });
            assert_near(stage.soles(), 0.0, 0.1);
        }
    }
}

#[test]
fn a_capsule_may_stop_on_its_way_over_a_curb_and_go_back_or_on() {
    for rate in RATES {
        // From where its side is over the curb until its middle is.
        for stop in [87.0, 90.0, 94.0, 98.0] {
            for (wish, least) in [(RIGHT, 150.0), (MoveInput { x: -150.0, ..STILL }, -50.0)] {
                SHAPE.set(Some(CAPSULE));
                let mut stage = Stage::new(rate, [60.0, 0.0, 0.0]);
                SHAPE.set(None);
                stage.platform([400.0, 7.0, 400.0], [300.0, 0.0, 0.0], 0.0);
                while stage.at().x < stop {
                    stage.step(MoveInput { x: 40.0, ..STILL });
                }
                stage.walk(STILL, 0.2, |_| {});
                let there = stage.at();
                stage.walk(STILL, 0.5, |stage| assert!(stage.walker.is_grounded(), "{rate} {stop}"));
                assert_near((stage.at() - there).norm(), 0.0, 0.1);
                stage.walk(wish, 1.2, |_| {});
                let at = stage.at();
                assert!(if wish.x > 0.0 { at.x > least } else { at.x < least }, "{rate} {stop}: {at:?}");
                assert_near(at.y, if wish.x > 0.0 { 7.0 } else { 0.0 }, 0.1);
            }
        }
    }
}

/// Up a ramp, over its ridge, and down another one.
#[test]
fn a_capsule_walks_over_a_ridge_without_leaving_the_floor() {
    for (degrees, rate) in [15.0, 30.0, 42.0f32].into_iter().flat_map(|it| RATES.map(|rate| (it, rate))) {
        SHAPE.set(Some(CAPSULE));
        let mut stage = Stage::new(rate, [0.0; 3]);
        SHAPE.set(None);
        let slope = degrees.to_radians();
        let (sin, cos) = slope.sin_cos();
        // Ramps 200 px long and 20 thick that begin on the ground at X = 100 and meet over the end of the first.
        let (length, thick) = (200.0, 20.0);
        let ridge = 100.0 + length * cos;
        for (side, tilt) in [(-1.0, -slope), (1.0, slope)] {
            let middle = [
                ridge + side * (0.5 * length * cos - 0.5 * thick * sin),
                0.5 * length * sin - 0.5 * thick * cos,
            ];
            stage.platform([length, thick, 400.0], [middle[0], middle[1] - 0.5 * thick, 0.0], tilt);
        }
        stage.walk(RIGHT, 0.2, |_| {});
        let (mut before, mut highest) = (stage.at(), 0.0f32);
        stage.walk(RIGHT, (2.0 * length * cos + 200.0) / 150.0, |stage| {
            let (at, speed) = (stage.at(), velocity(&stage.simulator, stage.figure).x);
            assert!(stage.walker.is_grounded(), "{degrees} {rate}: {at:?}");
            // At 30 steps per second the corner of the steepest other ramp takes 22 of it for a step.
            assert!(speed > 125.0, "{degrees} {rate}: {speed} {at:?}");
            // No hop beyond the slope, its clearance at edges, and the motion straight on over the ridge in a step.
            let way = 150.0 / rate;
            let step = way * slope.tan() + way * way / (30.0 * cos.powi(3));
            assert!((at.y - before.y).abs() < step + 0.3, "{degrees} {rate}: {before:?} {at:?}");
            (before, highest) = (at, highest.max(at.y));
        });
        // Its lowest point is on the ridge, or it passes over it within half a step.
        assert!(
            (-0.1..0.5 * 150.0 / rate * slope.tan() + 0.2).contains(&(highest - length * sin)),
            "{degrees} {rate}: {highest}"
        );
        assert_near(stage.soles(), 0.0, 0.1);
    }
}
