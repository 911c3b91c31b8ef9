//! Tests that the measures of the chart's scenes with depth are correct, and that the errors of the 2.5D engine do not change.
//! The tests measure no time.

use crate::common::depth::{Changed, faithful, thesis};
use approx::assert_relative_eq;
use measure::depth::{DepthChartScene, DepthMethod, PLANE_SCENE, depth_chart_scenes, plane_methods};
use measure::method::{Effort, Setting};
use measure::stability::reasons::NOT_FINITE;
use measure::trials::trials;
use measure::world::{BodyState, World};

const USUAL: Setting = Setting::fixed(1.0 / 60.0, 5);

fn scene(name: &str) -> DepthChartScene {
    let found = depth_chart_scenes().into_iter().find(|scene| scene.name == name);
    found.unwrap_or_else(|| panic!("there is no scene {name}"))
}

/// Returns the error of a chart scene of a `size`, in its own unit, and its failure. The watch sees the world that `of` makes
/// of the simulated one.
fn measured<W: World + 'static>(
    chart: &DepthChartScene,
    size: usize,
    method: &DepthMethod,
    setting: Setting,
    of: impl FnOnce(Box<dyn World>) -> W,
) -> (f64, Option<&'static str>) {
    let scene = (chart.build)(size);
    let mut world = of((method.build)(&scene, setting).unwrap());
    let mut watch = (chart.watch)(&scene);
    watch.observe(0.0, &world);
    let steps = (chart.seconds / f64::from(setting.dt.mean())).round() as usize;
    let mut time = 0.0;
    for dt in setting.dt.steps().take(steps) {
        world.step(dt);
        time += f64::from(dt);
        watch.observe(time, &world);
    }
    (watch.error(), watch.failed())
}

/// Returns the error of a run in the unit of its scene. Panics if the run fails.
#[track_caller]
fn error(name: &str, size: usize, method: &DepthMethod, setting: Setting) -> f64 {
    let (error, failed) = measured(&scene(name), size, method, setting, same);
    assert_eq!(failed, None, "{name} of {size}");
    error
}

fn same(world: Box<dyn World>) -> Changed<impl Fn(usize, BodyState) -> BodyState> {
    Changed { world, change: |_, state| state }
}

#[test]
fn a_throw_in_depth_is_behind_the_parabola_by_half_a_step_of_gravity() {
    for dt in [1.0 / 30.0, 1.0 / 60.0, 0.016, 0.01, 1.0 / 240.0] {
        // The largest error is g t dt / 2, at the last step of the flight.
        let setting = Setting::fixed(dt, 5);
        let end = (scene("throw_in_depth").seconds / f64::from(dt)).round() * f64::from(dt);
        let expected = 100.0 * end * f64::from(dt) / 2.0;
        assert_relative_eq!(error("throw_in_depth", 0, &faithful(), setting), expected, epsilon = 5e-3);
    }
}

#[test]
fn a_throw_in_depth_follows_the_law_of_the_steps_however_long_they_are() {
    for setting in
        [Setting::fixed(1.0 / 30.0, 5), USUAL, Setting::fixed(1.0 / 240.0, 5), Setting::jitter(0.016, 5)]
    {
        // The error is rounding: positions of up to 200 px are rounded in each step.
        let error = error("throw_in_depth_stepped", 0, &faithful(), setting);
        assert!(error < 5e-3, "{setting:?}: {error}");
    }
}

#[test]
fn a_ball_that_was_thrown_rolls_on_where_it_should() {
    for setting in [USUAL, Setting::fixed(0.01, 5), Setting::fixed(1.0 / 240.0, 5)] {
        // The error is the slop of the solver, 0.05 px, and rounding.
        let error = error("throw_in_depth_landing", 0, &faithful(), setting);
        assert!(error < 0.06, "{setting:?}: {error}");
    }
}

#[test]
fn conveyors_take_their_loads_along_as_friction_says() {
    for name in ["conveyor", "conveyor_askew"] {
        for size in [5, 20] {
            // The error is at most the path of one step at 60 px/s.
            let error = error(name, size, &faithful(), USUAL);
            assert!(error > 0.0 && error < 1.0, "{name} of {size}: {error}");
        }
    }
}

#[test]
fn shorter_steps_bring_the_loads_of_a_conveyor_nearer_to_where_they_should_be() {
    for name in ["conveyor", "conveyor_askew"] {
        let [long, short] =
            [60.0, 240.0].map(|rate: f32| error(name, 5, &faithful(), Setting::fixed(1.0 / rate, 5)));
        assert!(short < long / 3.0, "{name}: {long} and {short}");
    }
}

#[test]
fn the_thesis_scheme_loses_the_loads_of_a_conveyor_that_moves_into_the_picture_and_no_others() {
    // In the thesis scheme a body is thrown off once it has slid by half of its own depth along the depth axis.
    let (_, failed) = measured(&scene("conveyor_askew"), 5, &thesis(), USUAL, same);
    assert_eq!(failed, Some("fell off"));
    let [ours, theirs] = [faithful(), thesis()].map(|method| error("conveyor", 5, &method, USUAL));
    assert_eq!(ours, theirs);
}

#[test]
fn the_balls_of_a_pit_come_to_lie_beside_each_other() {
    for name in ["ball_pit_penetration", "ball_pit_speed"] {
        for size in [5, 20, 200] {
            let error = error(name, size, &faithful(), USUAL);
            assert!(error < scene(name).tolerance, "{name} of {size}: {error}");
        }
    }
}

#[test]
fn the_balls_of_a_pit_overlap_more_with_the_thesis_scheme() {
    let [ours, theirs] =
        [faithful(), thesis()].map(|method| error("ball_pit_penetration", 200, &method, USUAL));
    assert!(theirs > 2.0 * ours, "{ours} and {theirs}");
}

#[test]
fn measures_of_position_report_a_known_displacement() {
    for name in ["throw_in_depth", "throw_in_depth_stepped", "throw_in_depth_landing", "conveyor"] {
        for axis in 0..3 {
            let moved = |world| Changed {
                world,
                change: move |_, mut state: BodyState| {
                    state.position[axis] += 50.0;
                    state
                },
            };
            let chart = scene(name);
            let (error, failed) = measured(&chart, chart.sizes[0], &faithful(), USUAL, moved);
            // The error of the engine itself may add to the displacement of 50 px.
            assert_eq!(failed, None, "{name}");
            assert!((48.0..52.0).contains(&error), "{name}, axis {axis}: {error}");
        }
    }
}

#[test]
fn the_pit_detects_a_ball_in_the_ground_and_one_outside() {
    let chart = scene("ball_pit_penetration");
    let moved = |by: f64| {
        move |world| Changed {
            world,
            change: move |index, mut state: BodyState| {
                if index == 0 {
                    state.position[1] = by;
                }
                state
            },
        }
    };
    let (error, failed) = measured(&chart, 5, &faithful(), USUAL, moved(-3.0));
    assert_eq!(failed, None);
    assert!(error >= 3.0, "{error}");
    let (_, failed) = measured(&chart, 5, &faithful(), USUAL, moved(-30.0));
    assert_eq!(failed, Some("left the pit"));
}

#[test]
fn the_pit_measures_the_speed_of_the_balls() {
    let faster = |world| Changed {
        world,
        change: |_, mut state: BodyState| {
            state.velocity[2] += 7.0;
            state
        },
    };
    let (error, failed) = measured(&scene("ball_pit_speed"), 5, &faithful(), USUAL, faster);
    assert_eq!(failed, None);
    assert_relative_eq!(error, 7.0, epsilon = 0.5);
}

#[test]
fn a_non_finite_state_fails_in_every_scene() {
    for chart in depth_chart_scenes() {
        let broken = |world| Changed {
            world,
            change: |_, mut state: BodyState| {
                state.position[0] = f64::NAN;
                state
            },
        };
        let (_, failed) = measured(&chart, chart.sizes[0], &faithful(), USUAL, broken);
        assert_eq!(failed, Some(NOT_FINITE), "{}", chart.name);
    }
}

#[test]
fn with_all_bodies_at_one_depth_2_5d_equals_2d_to_the_bit() {
    for trial in trials(&[PLANE_SCENE], &plane_methods(), Effort::Quick) {
        let mut run = (trial.start)().unwrap_or_else(|error| panic!("{error}"));
        let dt = trial.setting.dt.mean();
        run.observe(0.0);
        for step in 1..=120 {
            run.world.step(dt);
            run.observe(f64::from(step) * f64::from(dt));
        }
        let watch = &run.watches[0].1;
        assert_eq!((watch.error(), watch.failed()), (0.0, None), "{} circles, {}", trial.size, trial.method);
    }
}
