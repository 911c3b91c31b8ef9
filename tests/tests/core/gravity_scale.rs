//! The gravity scale of a body, with both sets of methods.

use approx::assert_abs_diff_eq;
use conformance::fixtures::plane::{add_box, add_floor, simulator, v};
use farseer_core::{Body, BodyId, Event, Methods, PhysicsSimulator};

const DT: f32 = 1.0 / 60.0;
const GRAVITY: f32 = 320.0;

/// An empty simulator with each set.
fn both() -> [PhysicsSimulator; 2] {
    [Methods::default(), Methods::PRECISE].map(|methods| {
        let mut simulator = simulator(GRAVITY);
        simulator.set_methods(methods).unwrap();
        simulator
    })
}

/// A box at the origin that no drag slows.
fn add_free_box(simulator: &mut PhysicsSimulator) -> BodyId {
    let (body, _) = add_box(simulator, (20.0, 20.0), v(0.0, 0.0));
    simulator[body].set_linear_drag_coefficient(0.0);
    body
}

fn run(simulator: &mut PhysicsSimulator, steps: usize) {
    (0..steps).for_each(|_| simulator.update(DT));
}

#[test]
fn a_body_falls_with_its_gravity_scale() {
    for mut simulator in both() {
        for scale in [0.5_f32, 2.0, -1.0, 0.0] {
            let body = add_free_box(&mut simulator);
            simulator[body].set_gravity_scale(scale);
            simulator[body].set_position(v(1000.0 * scale, 0.0));
            run(&mut simulator, 60);
            // 60 roundings of numbers below 1,024.
            assert_abs_diff_eq!(simulator[body].linear_velocity().y, scale * GRAVITY, epsilon = 0.002);
            simulator.dispose(body).unwrap();
        }
    }
}

#[test]
fn a_gravity_scale_of_zero_equals_ignoring_gravity() {
    for mut simulator in both() {
        let (scaled, ignoring) = (add_free_box(&mut simulator), add_free_box(&mut simulator));
        simulator[scaled].set_gravity_scale(0.0);
        simulator[ignoring].set_ignore_gravity(true);
        simulator[ignoring].set_position(v(500.0, 0.0));
        for body in [scaled, ignoring] {
            simulator[body].set_linear_velocity(v(7.0, -3.0));
        }
        run(&mut simulator, 60);
        assert_eq!(simulator[scaled].linear_velocity(), simulator[ignoring].linear_velocity());
        assert_eq!(simulator[scaled].position().y, simulator[ignoring].position().y);
    }
}

#[test]
fn ignoring_gravity_counts_more_than_a_scale() {
    for mut simulator in both() {
        let body = add_free_box(&mut simulator);
        simulator[body].set_gravity_scale(3.0);
        simulator[body].set_ignore_gravity(true);
        run(&mut simulator, 30);
        assert_eq!(simulator[body].position(), v(0.0, 0.0));
    }
}

#[test]
fn a_non_finite_gravity_scale_is_refused_and_reported() {
    for mut simulator in both() {
        let body = add_free_box(&mut simulator);
        simulator[body].set_gravity_scale(0.25);
        for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            simulator[body].set_gravity_scale(bad);
            assert_eq!(simulator[body].gravity_scale(), 0.25);
            simulator.update(DT);
            let told = Event::RejectedInput { object: Some(body.into()), argument: "gravity_scale" };
            assert!(simulator.events().contains(&told), "{bad}");
        }
    }
}

#[test]
fn a_scale_is_copied_cloned_and_saved() {
    let mut body = Body::new();
    assert_eq!(body.gravity_scale(), 1.0);
    body.set_gravity_scale(-2.5);
    assert_eq!(Body::copy_of(&body).gravity_scale(), -2.5);
    assert_eq!(body.clone().gravity_scale(), -2.5);
    let saved = serde_json::to_string(&body).unwrap();
    assert_eq!(serde_json::from_str::<Body>(&saved).unwrap().gravity_scale(), -2.5);
}

#[test]
fn a_body_without_gravity_does_not_touch_a_floor_below_it() {
    let [_, mut precise] = both();
    add_floor(&mut precise, (400.0, 20.0), v(0.0, 10.0));
    // Gravity would bring it 0.089 px further in a step.
    let (body, _) = add_box(&mut precise, (20.0, 20.0), v(0.0, -10.05));
    precise[body].set_gravity_scale(0.0);
    run(&mut precise, 5);
    assert_eq!(precise.arbiter_count(), 0);
    precise[body].set_gravity_scale(1.0);
    run(&mut precise, 1);
    assert_eq!(precise.arbiter_count(), 1);
}
