//! The measures of the chart are right where things should come to rest, and what fails is said to.

mod accuracy_common;

use accuracy_common::{Told, assert_right, chart, starts, watched};
use approx::assert_relative_eq;
use conformance::measure::charts::chart_scenes;
use conformance::measure::error::{Failing, Largest, Last, Watch, Worst};
use conformance::measure::method::{Family, Setting, methods};
use conformance::measure::penetration::Shapes;
use conformance::measure::world::{BodyState, World};

/// Scenes of things that are built to stand, without the measure in the name.
const BUILT: [&str; 5] = ["box_stack", "pyramid", "circle_stack", "card_house", "arch"];

#[test]
fn what_stands_as_it_was_built_has_no_error() {
    for name in BUILT {
        assert_right(&format!("{name}_height"), 0.05, 0.0, |_, _| {});
        assert_right(&format!("{name}_speed"), 0.05, 0.0, |_, _| {});
    }
}

#[test]
fn what_is_built_overlaps_by_as_little_as_everything_forgives() {
    for scene in chart_scenes().into_iter().filter(|scene| scene.name.ends_with("_penetration")) {
        for &size in scene.sizes.iter().filter(|&&size| size < 2000) {
            let built = (scene.build)(size);
            let overlap = Shapes::of(&built).largest_overlap(&Told(starts(&built)));
            // Pyramids press up to 0.15 px; their boxes differ by 0.1 in height.
            assert!(overlap < 0.151, "{} of {size}: {overlap}", scene.name);
        }
    }
}

#[test]
fn what_is_built_touches_what_it_stands_on() {
    for name in BUILT {
        let scene = chart(&format!("{name}_penetration"));
        let built = (scene.build)(5);
        let overlap = Shapes::of(&built).largest_overlap(&Told(starts(&built)));
        assert!(overlap > 0.01, "{name}: {overlap}");
    }
}

#[test]
fn a_top_that_sank_is_an_error_of_height_and_one_that_fell_a_failure() {
    let highest = |states: &[BodyState]| {
        let least = states.iter().map(|state| state.position[1]).fold(f64::INFINITY, f64::min);
        states.iter().position(|state| state.position[1] == least).expect("there is a highest one")
    };
    for name in BUILT {
        let scene = chart(&format!("{name}_height"));
        let start = starts(&(scene.build)(scene.sizes[0]));
        let top = highest(&start);
        let sunk = |by: f64| {
            watched(scene.name, 0.05, |_, states| states[top].position[1] = start[top].position[1] + by)
        };
        let (error, failed) = sunk(5.0);
        assert_relative_eq!(error, 5.0, max_relative = 1e-9);
        assert_eq!(failed, None);
        assert_eq!(sunk(40.0), (f64::INFINITY, Some("toppled")), "{name}");
    }
}

#[test]
fn speed_counts_in_the_last_second_alone() {
    let until = |end: f64| {
        move |time: f64, states: &mut [BodyState]| {
            states[2].velocity = if time < end { [30.0, 40.0] } else { [0.0, 0.0] };
        }
    };
    assert_eq!(watched("box_stack_speed", 0.05, until(8.9)).0, 0.0);
    assert_relative_eq!(watched("box_stack_speed", 0.05, until(9.5)).0, 50.0);
}

#[test]
fn the_speed_of_a_pile_is_the_root_of_the_mean_square_of_what_can_move() {
    let movable = 5.0_f64;
    let (error, _) = watched("ball_pit_speed", 0.05, |_, states| states[4].velocity = [30.0, 40.0]);
    assert_relative_eq!(error, 50.0 / movable.sqrt(), max_relative = 1e-12);
}

#[test]
fn an_overlap_counts_in_the_last_second_alone() {
    let start = starts(&(chart("box_stack_penetration").build)(5));
    let until = |end: f64| {
        let start = &start;
        move |time: f64, states: &mut [BodyState]| {
            let sunk = if time < end { 3.0 } else { 0.0 };
            states[1].position[1] = start[1].position[1] + sunk;
        }
    };
    let error = |end| watched("box_stack_penetration", 0.05, until(end)).0;
    assert_relative_eq!(error(8.9), 0.02, epsilon = 1e-5);
    assert_relative_eq!(error(9.5), 3.02, epsilon = 1e-5);
}

#[test]
fn what_is_not_finite_fails_everywhere() {
    for scene in chart_scenes() {
        let built = (scene.build)(scene.sizes[0]);
        let mut watch = (scene.watch)(&built);
        let mut world = Told(starts(&built));
        watch.see(0.0, &world);
        let last = world.0.len() - 1;
        world.0[last].velocity[0] = f64::NAN;
        watch.see(scene.seconds, &world);
        assert_eq!(watch.failed(), Some("not finite"), "{}", scene.name);
        assert_eq!(watch.error(), f64::INFINITY, "{}", scene.name);
    }
}

#[test]
fn what_leaves_the_scene_fails_everywhere_and_does_not_come_back() {
    for scene in chart_scenes() {
        let built = (scene.build)(scene.sizes[0]);
        let mut watch = (scene.watch)(&built);
        let mut world = Told(starts(&built));
        let last = world.0.len() - 1;
        let start = world.0[last].position;
        world.teleport(last, [1e6, 0.0], 0.0);
        watch.see(0.1, &world);
        world.teleport(last, start, 0.0);
        watch.see(scene.seconds, &world);
        assert_eq!(watch.failed(), Some("flew off"), "{}", scene.name);
    }
}

#[test]
fn the_largest_of_nothing_is_nan_and_nan_counts_as_infinite() {
    let mut largest = Largest::default();
    assert!(largest.get().is_nan());
    for value in [1.0, 3.0, -2.0] {
        largest.take(value);
    }
    assert_eq!(largest.get(), 3.0);
    largest.take(f64::NAN);
    largest.take(4.0);
    assert_eq!(largest.get(), f64::INFINITY);
}

#[test]
fn one_watch_keeps_the_worst_and_another_the_last() {
    let world = Told(Vec::new());
    let value = |time: f64, _: &dyn World| (time < 3.0).then_some(10.0 - 2.0 * time);
    let mut worst = Worst::new(value);
    let mut last = Last::new(value);
    for time in 0..5 {
        worst.see(f64::from(time), &world);
        last.see(f64::from(time), &world);
    }
    assert_eq!((worst.error(), last.error()), (10.0, 6.0));
}

#[test]
fn the_first_failure_is_the_one_that_is_told() {
    let world = Told(Vec::new());
    let verdict = |time: f64, _: &dyn World| match time as i32 {
        0 => None,
        1 => Some("first"),
        _ => Some("second"),
    };
    let mut watch = Failing::new(Worst::new(|_, _| Some(0.0)), 1.0, verdict);
    watch.see(0.0, &world);
    assert_eq!((watch.error(), watch.failed()), (0.0, None));
    watch.see(1.0, &world);
    watch.see(2.0, &world);
    assert_eq!((watch.error(), watch.failed()), (f64::INFINITY, Some("first")));
}

#[test]
fn every_scene_of_the_chart_has_a_name_of_its_own_and_says_what_it_measures() {
    let scenes = chart_scenes();
    let mut names: Vec<_> = scenes.iter().map(|scene| scene.name).collect();
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), scenes.len());
    for scene in scenes {
        assert!(scene.tolerance > 0.0 && scene.seconds > 0.0 && !scene.sizes.is_empty(), "{}", scene.name);
        assert!(
            scene.about.ends_with('.') && !scene.error.is_empty() && !scene.unit.is_empty(),
            "{}",
            scene.name
        );
    }
}

#[test]
fn every_scene_of_the_chart_begins_well_with_every_method_of_ours() {
    for scene in chart_scenes() {
        let built = (scene.build)(scene.sizes[0]);
        for method in methods() {
            let Ok(mut world) = (method.build)(&built, Setting::fixed(1.0 / 240.0, 40)) else {
                assert!(method.family != Family::Ours, "{}", scene.name);
                continue;
            };
            let mut watch = (scene.watch)(&built);
            watch.see(0.0, &*world);
            for step in 1..=24 {
                world.step(1.0 / 240.0);
                watch.see(f64::from(step) / 240.0, &*world);
            }
            let failed = watch.failed().filter(|failed| *failed != "nothing to measure");
            assert_eq!(failed, None, "{} with {}", scene.name, method.name);
        }
    }
}
