//! Bodies that are slow are disabled, and woken.

use super::{DT, add_controller};
use conformance::fixtures::plane::{both_sets, simulator_with, v};
use conformance::units::assert_words;
use farseer_core::{Body, BodyId, ControllerId, InactivityController, Methods, PhysicsSimulator};

/// A simulator with an inactivity controller.
fn with_inactivity(methods: Methods) -> (PhysicsSimulator, ControllerId) {
    let mut simulator = simulator_with(0.0, methods);
    let controller = add_controller(&mut simulator, InactivityController::new());
    (simulator, controller)
}

fn add_body(simulator: &mut PhysicsSimulator, x: f32, is_auto_idle: bool) -> BodyId {
    let body = simulator.create_body(Body::new());
    simulator.add(body).unwrap();
    simulator[body].set_position(v(x, 0.0));
    simulator[body].set_is_auto_idle(is_auto_idle);
    body
}

fn bodies_enabled(simulator: &PhysicsSimulator, controller: ControllerId) -> u32 {
    simulator.controller_as::<InactivityController>(controller).unwrap().bodies_enabled()
}

#[test]
fn check_12_a_slow_body_is_disabled_after_a_second() {
    for methods in both_sets() {
        let (mut simulator, controller) = with_inactivity(methods);
        let body = add_body(&mut simulator, 0.0, true);
        simulator[body].set_linear_velocity(v(54.0, 0.0));
        simulator[body].set_linear_drag_coefficient(0.0);
        let idle_time_and_x =
            |simulator: &PhysicsSimulator| vec![v(simulator[body].idle_time(), simulator[body].position().x)];
        for step in 1..=61 {
            simulator.update(DT);
            match step {
                1 => assert_words(&idle_time_and_x(&simulator), "41855556 3f666667"),
                59 => assert_words(&idle_time_and_x(&simulator), "4475d55d 4254666d"),
                60 => {
                    assert_words(&idle_time_and_x(&simulator), "447a0008 4254666d");
                    assert_eq!(simulator[body].linear_velocity(), v(54.0, 0.0));
                    assert_eq!(bodies_enabled(&simulator, controller), 1);
                }
                61 => assert_eq!(bodies_enabled(&simulator, controller), 0),
                _ => {}
            }
            assert_eq!(simulator[body].enabled(), step < 60);
        }
    }
}

#[test]
fn check_13_a_body_woken_by_an_earlier_one_is_tested_in_the_same_pass() {
    for methods in both_sets() {
        let (mut simulator, controller) = with_inactivity(methods);
        add_body(&mut simulator, 100.0, false);
        let a = add_body(&mut simulator, 0.0, true);
        simulator[a].set_enabled(false);
        simulator.update(0.1);
        assert!(simulator[a].enabled());
        assert_eq!(simulator[a].idle_time(), 100.0);
        assert_eq!(bodies_enabled(&simulator, controller), 2);
    }
}

#[test]
fn check_13_a_body_woken_by_a_later_one_is_not() {
    for methods in both_sets() {
        let (mut simulator, controller) = with_inactivity(methods);
        let a = add_body(&mut simulator, 0.0, true);
        add_body(&mut simulator, 100.0, false);
        simulator[a].set_enabled(false);
        simulator.update(0.1);
        assert!(simulator[a].enabled());
        assert_eq!(simulator[a].idle_time(), 0.0);
        assert_eq!(bodies_enabled(&simulator, controller), 1);
    }
}

#[test]
fn check_13_a_body_may_be_disabled_and_woken_in_one_pass() {
    for methods in both_sets() {
        let (mut simulator, controller) = with_inactivity(methods);
        let a = add_body(&mut simulator, 0.0, true);
        add_body(&mut simulator, 0.0, false);
        simulator[a].set_idle_time(950.0);
        simulator.update(0.1);
        assert!(simulator[a].enabled());
        assert_eq!(simulator[a].idle_time(), 0.0);
        assert_eq!(bodies_enabled(&simulator, controller), 2);
    }
}

#[test]
fn check_15_a_disabled_controller_stays_in_the_list_and_a_disposed_one_is_removed() {
    for methods in both_sets() {
        let (mut simulator, controller) = with_inactivity(methods);
        simulator[controller].set_enabled(false);
        simulator.update(DT);
        assert_eq!(simulator.controller_list(), [controller]);
        simulator.dispose(controller).unwrap();
        assert_eq!(simulator.controller_list(), [controller]);
        simulator.update(DT);
        assert!(simulator.controller_list().is_empty());
        assert!(simulator.controller(controller).is_none());
    }
}
