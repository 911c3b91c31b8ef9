//! Tests that bodies at rest sleep in the peers if sleep is enabled.

use super::{STEP, body, floor, geom, in_both, run, scene};
use conformance::scene::*;
use measure::method::methods;
use measure::sleep::pushes::run_pushes;
use measure::sleep::sleepers;
use measure::world::World;

/// Runs `check` in each of the two engines on a box that has lain on a floor for two seconds.
fn with_box(sleeps: bool, check: impl Fn(&str, &mut dyn World, usize)) {
    let mut scene = scene();
    floor(&mut scene, 0.5, 0.0);
    let (width, height) = (32.0, 32.0);
    let index = body(&mut scene, BodyShape::Rectangle { width, height, mass: 1.0 }, [0.0, -16.0]);
    geom(&mut scene, GeomShape::Rectangle { width, height }, 0.5, 0.0);
    in_both(&scene, |name, world| {
        if sleeps {
            world.set_sleep_enabled(true);
        }
        run(world, 2.0);
        check(name, world, index);
    });
}

#[test]
fn bodies_at_rest_sleep_if_sleep_is_enabled() {
    with_box(true, |name, world, index| assert!(world.is_asleep(index), "{name}"));
}

#[test]
fn bodies_at_rest_stay_awake_by_default() {
    with_box(false, |name, world, index| assert!(!world.is_asleep(index), "{name}"));
}

#[test]
fn disabling_sleep_wakes_all_bodies_for_good() {
    with_box(true, |name, world, index| {
        world.set_sleep_enabled(false);
        world.step(STEP);
        assert!(!world.is_asleep(index), "{name}");
        run(world, 2.0);
        assert!(!world.is_asleep(index), "{name}");
    });
}

#[test]
fn an_impulse_wakes_a_sleeping_body() {
    with_box(true, |name, world, index| {
        world.apply_impulse(index, [32.0, 0.0]);
        world.step(STEP);
        assert!(!world.is_asleep(index), "{name}");
    });
}

#[test]
fn a_pyramid_that_is_pushed_at_its_foot_rests_no_later_than_in_the_slower_of_both() {
    let figures = run_pushes(&sleepers(methods())).expect("all have boxes");
    for of_push in figures.chunk_by(|one, other| one.push == other.push) {
        let rests = |is_ours: bool| {
            let of = of_push.iter().filter(move |figures| (figures.method == "Precise") == is_ours);
            of.map(|figures| figures.at_rest_again_after_s.expect("it rests")).fold(0.0, f64::max)
        };
        let (ours, slower) = (rests(true), rests(false));
        assert!(ours <= slower, "{} m/s: {ours} s, {slower} s", of_push[0].push);
    }
}
