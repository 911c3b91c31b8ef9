//! Intervals that grow with the load.

use super::add_controller;
use conformance::fixtures::plane::simulator;
use conformance::units::assert_words;
use farseer_core::ScalingController;

fn scaling() -> ScalingController {
    ScalingController::new(0.02, 0.05).unwrap()
}

#[test]
fn check_14_time_is_collected_until_the_interval_is_full() {
    let mut scaling = scaling();
    assert_eq!(scaling.get_update_interval(0.015), 0.0);
    assert_words(&scaling.get_update_interval(0.015), "3cf5c28f");
    assert_words(&scaling.get_update_interval(0.02), "3ca3d70a");
}

#[test]
fn check_14_the_penalty_rises_and_falls_as_recorded() {
    let mut scaling = scaling();
    for word in [
        "3ccccccc", "3cf5c28f", "3d0f5c29", "3d23d70a", "3d3851eb", "3d4ccccc", "3d6147ad", "3d75c28e",
        "3d851eb8", "3d8f5c28", "3d8f5c28", "3d8f5c28",
    ] {
        scaling.increase_update_interval();
        assert_words(&scaling.update_interval(), word);
    }
    for word in ["3d8a3d70", "3d851eb7", "3d7ffffd", "3d75c28c", "3d6b851b", "3d6147aa"] {
        scaling.decrease_update_interval();
        assert_words(&scaling.update_interval(), word);
    }
    scaling.set_maximum_update_interval(0.01).unwrap();
    assert_eq!(scaling.maximum_update_interval(), 0.05);
    scaling.set_maximum_update_interval(0.03).unwrap();
    assert_eq!(scaling.maximum_update_interval(), 0.03);
    scaling.set_update_interval(0.1).unwrap();
    assert_eq!(scaling.maximum_update_interval(), 0.1);
    assert_words(&scaling.update_interval(), "3e0a3d70");
}

#[test]
fn check_14_without_collecting_time_is_handed_on() {
    let mut disabled = scaling();
    disabled.set_enabled(false);
    assert_eq!(disabled.get_update_interval(0.001), 0.001);
    let mut without_base = ScalingController::new(0.0, 0.05).unwrap();
    assert_eq!(without_base.get_update_interval(0.001), 0.001);
}

#[test]
fn check_14_updates_raise_and_lower_the_interval_as_recorded() {
    let mut simulator = simulator(0.0);
    let controller = add_controller(&mut simulator, scaling());
    for (dt_real, word) in [
        (0.2, "3ca3d70a"),
        (0.2, "3ccccccc"),
        (0.2, "3ccccccc"),
        (0.2, "3ccccccc"),
        (0.0, "3cb851eb"),
        (0.0, "3cb851eb"),
    ] {
        simulator.update_with_real_time(0.01, dt_real, None);
        let scaling: &ScalingController = simulator.controller_as(controller).unwrap();
        assert_words(&scaling.update_interval(), word);
    }
}
