//! Tests that the measures of the chart are correct where bodies should come to rest, and that they report failures.

use crate::common::told::{PrescribedWorld, assert_no_error, chart, flat, starts, watched};
use approx::assert_relative_eq;
use measure::charts::chart_scenes;
use measure::depth::depth_chart_scenes;
use measure::method::{Family, Setting, methods};
use measure::penetration::Shapes;
use measure::watch::{Maximum, failing, last, worst};
use measure::world::{BodyState, World};

/// Names of the scenes of structures, without the measure that ends the full name.
const BUILT: [&str; 5] = ["box_stack", "pyramid", "circle_stack", "card_house", "arch"];

#[test]
fn an_undisturbed_structure_has_no_motion_and_is_lower_by_its_initial_overlap() {
    // Expected errors in percent of the height, which come from the initial overlaps:
    // - box_stack: 5 overlaps of 0.02 px; height 4.5 boxes of 32 px.
    // - pyramid: 3 overlaps of 0.05 px; height 2.5 boxes of 20 px, which differ by up to 0.05 px each.
    // - circle_stack: 0.02 px and twice 0.017 px of 71.4 px. card_house: 0.06 px of 97 px.
    // - arch: stones overlap by 0.02 px, and start 0.02 / (2 sin 18 degrees) = 0.032 px too near to the centre; middle of the
    //   third stone 168 px above it.
    for (name, least, most) in [
        ("box_stack", 0.0694, 0.0695),
        ("pyramid", 0.0, 0.5),
        ("circle_stack", 0.07, 0.08),
        ("card_house", 0.03, 0.07),
        ("arch", 0.0192, 0.0193),
    ] {
        let (error, failed) = watched(&format!("{name}_height"), 0.05, |_, _| {});
        assert_eq!(failed, None);
        assert!((least..most).contains(&error), "{name}: {error}");
        assert_no_error(&format!("{name}_speed"), 0.05, 0.0, |_, _| {});
    }
}

#[test]
fn a_structure_of_full_height_has_no_error_of_height() {
    // The height of the stack is that of the middle of the fifth box of 32 px.
    let start = starts(&(chart("box_stack_height").build)(5));
    assert_no_error("box_stack_height", 0.05, 1e-4, |_, states| {
        for (index, state) in states.iter_mut().enumerate().skip(1) {
            state.position = flat([start[index].position[0], -32.0 * (index as f64 - 0.5)]);
        }
    });
    // Five circles form three rows.
    assert_no_error("circle_stack_height", 0.05, 1e-4, |_, states| {
        let top = states.len() - 1;
        states[top].position[1] = -16.0 - 2.0 * 16.0 * 3.0_f64.sqrt();
    });
}

#[test]
fn structures_are_built_with_at_most_0_15_px_of_overlap() {
    for scene in chart_scenes().into_iter().filter(|scene| scene.name.ends_with("_penetration")) {
        for &size in scene.sizes.iter().filter(|&&size| size < 2000) {
            let built = (scene.build)(size);
            let overlap = Shapes::of(&built).largest_overlap(&PrescribedWorld(starts(&built)));
            // Boxes of a pyramid overlap by up to 0.15 px; their heights differ by 0.1 px.
            assert!(overlap < 0.151, "{} of {size}: {overlap}", scene.name);
        }
    }
}

#[test]
fn structures_are_built_touching_their_support() {
    for name in BUILT {
        let scene = chart(&format!("{name}_penetration"));
        let built = (scene.build)(5);
        let overlap = Shapes::of(&built).largest_overlap(&PrescribedWorld(starts(&built)));
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
        // The heights of the built structures are right to half a percent.
        assert_relative_eq!(error, -500.0 / start[top].position[1], epsilon = 0.51);
        assert_eq!(failed, None);
        assert_eq!(sunk(40.0), (f64::INFINITY, Some("toppled")), "{name}");
    }
}

/// Returns error, in px, and failure of the scene with a heavy box on a light one. `change` alters both states in each step.
fn of_two_boxes(change: impl Fn(&mut BodyState, &mut BodyState)) -> (f64, Option<&'static str>) {
    let start = starts(&(chart("heavy_on_light_1000").build)(0));
    watched("heavy_on_light_1000", 0.05, |_, states| {
        let [_, light, heavy] = states else { panic!("a ground and two boxes") };
        (*light, *heavy) = (start[1], start[2]);
        change(light, heavy);
    })
}

#[test]
fn a_box_that_sinks_into_a_lighter_one_is_an_error_until_it_has_passed_through() {
    for depth in [3.0, 20.0, 31.0] {
        let (error, failed) = of_two_boxes(|_, heavy| heavy.position[1] += depth);
        assert_eq!(failed, None, "{depth}");
        // The boxes overlap by 0.02 px at the start.
        assert_relative_eq!(error, depth + 0.02, epsilon = 1e-4);
    }
    assert_eq!(of_two_boxes(|_, heavy| heavy.position[1] += 33.0), (f64::INFINITY, Some("sank")));
}

#[test]
fn a_light_box_pressed_into_the_ground_is_an_error_until_it_is_completely_inside() {
    let pressed = |by: f64| {
        of_two_boxes(|light, heavy| {
            light.position[1] += by;
            heavy.position[1] += by;
        })
    };
    let (error, failed) = pressed(19.0);
    assert_eq!(failed, None);
    assert_relative_eq!(error, 19.02, epsilon = 1e-4);
    assert_eq!(pressed(33.0), (f64::INFINITY, Some("sank")));
}

#[test]
fn a_heavy_box_topples_by_shifting_aside_or_turning() {
    assert_eq!(of_two_boxes(|_, heavy| heavy.position[0] -= 15.0).1, None);
    assert_eq!(of_two_boxes(|_, heavy| heavy.position[0] -= 17.0).1, Some("toppled"));
    assert_eq!(of_two_boxes(|light, _| light.position[0] += 17.0).1, Some("toppled"));
    assert_eq!(of_two_boxes(|_, heavy| heavy.angle = 0.7).1, None);
    assert_eq!(of_two_boxes(|_, heavy| heavy.angle = -0.8).1, Some("toppled"));
    assert_eq!(of_two_boxes(|light, _| light.angle = 0.8).1, Some("toppled"));
}

#[test]
fn a_body_outside_of_the_pit_is_lost() {
    for name in ["ball_pit_penetration", "ball_pit_speed", "box_pile_penetration", "box_pile_speed"] {
        // The pit of five bodies has three columns: the space between its walls is 96 px wide.
        let put = |place: [f64; 2]| watched(name, 0.05, |_, states| states[5].position = flat(place));
        for outside in [[49.0, -10.0], [-49.0, -10.0], [60.0, -300.0], [0.0, 1.0], [0.0, 1500.0]] {
            assert_eq!(put(outside), (f64::INFINITY, Some("lost")), "{name} at {outside:?}");
        }
        for inside in [[47.0, -10.0], [-47.0, -10.0], [0.0, -1.0], [0.0, -300.0]] {
            assert_eq!(put(inside).1, None, "{name} at {inside:?}");
        }
    }
}

#[test]
fn speed_counts_in_the_last_second_alone() {
    let until = |end: f64| {
        move |time: f64, states: &mut [BodyState]| {
            states[2].velocity = flat(if time < end { [30.0, 40.0] } else { [0.0, 0.0] });
        }
    };
    assert_eq!(watched("box_stack_speed", 0.05, until(8.9)).0, 0.0);
    assert_relative_eq!(watched("box_stack_speed", 0.05, until(9.5)).0, 50.0);
}

#[test]
fn the_speed_of_a_pile_is_the_rms_of_its_dynamic_bodies() {
    let movable = 5.0_f64;
    let (error, _) = watched("ball_pit_speed", 0.05, |_, states| states[4].velocity = flat([30.0, 40.0]));
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
fn a_non_finite_state_fails_every_watch() {
    for scene in chart_scenes() {
        let built = (scene.build)(scene.sizes[0]);
        let mut watch = (scene.watch)(&built);
        let mut world = PrescribedWorld(starts(&built));
        watch.observe(0.0, &world);
        let last = world.0.len() - 1;
        world.0[last].velocity[0] = f64::NAN;
        watch.observe(scene.seconds, &world);
        assert_eq!(watch.failed(), Some("not finite"), "{}", scene.name);
        assert_eq!(watch.error(), f64::INFINITY, "{}", scene.name);
    }
}

#[test]
fn a_body_that_leaves_the_scene_fails_every_watch_for_good() {
    for scene in chart_scenes() {
        let built = (scene.build)(scene.sizes[0]);
        let mut watch = (scene.watch)(&built);
        let mut world = PrescribedWorld(starts(&built));
        let last = world.0.len() - 1;
        let start = world.0[last].position_in_plane();
        world.teleport(last, [1e6, 0.0], 0.0);
        watch.observe(0.1, &world);
        world.teleport(last, start, 0.0);
        watch.observe(scene.seconds, &world);
        assert_eq!(watch.failed(), Some("flew off"), "{}", scene.name);
    }
}

#[test]
fn the_maximum_of_no_numbers_is_nan_and_nan_counts_as_infinite() {
    let mut largest = Maximum::default();
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
    let world = PrescribedWorld(Vec::new());
    let value = |time: f64, _: &dyn World| (time < 3.0).then_some(10.0 - 2.0 * time);
    let mut worst = worst(value);
    let mut last = last(value);
    for time in 0..5 {
        worst.observe(f64::from(time), &world);
        last.observe(f64::from(time), &world);
    }
    assert_eq!((worst.error(), last.error()), (10.0, 6.0));
}

#[test]
fn the_first_failure_is_the_one_reported() {
    let world = PrescribedWorld(Vec::new());
    let verdict = |time: f64, _: &dyn World| match time as i32 {
        0 => None,
        1 => Some("first"),
        _ => Some("second"),
    };
    let mut watch = failing(worst(|_, _| Some(0.0)), 1.0, verdict);
    watch.observe(0.0, &world);
    assert_eq!((watch.error(), watch.failed()), (0.0, None));
    watch.observe(1.0, &world);
    watch.observe(2.0, &world);
    assert_eq!((watch.error(), watch.failed()), (f64::INFINITY, Some("first")));
}

#[test]
fn every_scene_of_the_chart_has_a_unique_name_and_names_its_quantity() {
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
fn other_engines_are_charted_everywhere_but_against_the_laws_of_our_own_steps() {
    let ours_alone: Vec<_> =
        chart_scenes().into_iter().filter(|scene| !scene.peers_too).map(|scene| scene.name).collect();
    assert_eq!(ours_alone, ["throw_discrete_law"]);
    let in_depth: Vec<_> =
        depth_chart_scenes().into_iter().filter(|scene| !scene.peers_too).map(|scene| scene.name).collect();
    assert_eq!(in_depth, ["throw_in_depth_stepped"]);
}

#[test]
fn every_scene_of_the_chart_starts_without_failure_with_every_method_of_ours() {
    for scene in chart_scenes() {
        let built = (scene.build)(scene.sizes[0]);
        for method in methods() {
            let Ok(mut world) = (method.build)(&built, Setting::fixed(1.0 / 240.0, 40)) else {
                assert!(method.family != Family::Ours, "{} with {}", scene.name, method.name);
                continue;
            };
            let mut watch = (scene.watch)(&built);
            watch.observe(0.0, &*world);
            for step in 1..=24 {
                world.step(1.0 / 240.0);
                watch.observe(f64::from(step) / 240.0, &*world);
            }
            let failed = watch.failed().filter(|failed| *failed != "nothing to measure");
            assert_eq!(failed, None, "{} with {}", scene.name, method.name);
        }
    }
}
