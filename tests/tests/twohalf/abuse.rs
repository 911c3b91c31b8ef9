//! Extreme values and edits at odd moments: no call panics, and no number becomes infinite or NaN.

use conformance::fixtures::depth::{busy_scene, run, set_surface, throw};
use twohalf::farseer_core::Body;
use twohalf::{BodyId, Collision, Context, Event, EventHandler, TwoHalfPhysicsSimulator, Vector2};

#[track_caller]
fn assert_finite(simulator: &TwoHalfPhysicsSimulator, bodies: &[BodyId]) {
    for view in bodies.iter().filter_map(|&body| simulator.body(body)) {
        let (place, velocity) = (view.position3d(), view.linear_velocity());
        let numbers = [place.x, place.y, place.z, velocity.x, velocity.y, view.linear_velocity_z()];
        let spins = [view.rotation(), view.angular_velocity(), view.angular_velocity_x()];
        assert!(numbers.iter().chain(&spins).all(|number| number.is_finite()), "{numbers:?}, {spins:?}");
    }
}

#[test]
pub(crate) fn extreme_velocities_disable_bodies_and_keep_all_numbers_finite() {
    let mut disabled = 0;
    for speed in [1e10, 1e20, 1e30, 3e38] {
        let (mut simulator, bodies) = busy_scene();
        throw(&mut simulator, bodies[0], [speed, -speed, speed]);
        throw(&mut simulator, bodies[1], [0.0, -speed, -speed]);
        for _ in 0..200 {
            simulator.update(0.01);
            let is_failure = |event: &&Event| matches!(event, Event::NotFinite { disabled: true, .. });
            disabled += simulator.events().iter().filter(is_failure).count();
            assert_finite(&simulator, &bodies);
        }
    }
    assert!(disabled > 0);
}

#[test]
pub(crate) fn extreme_gravity_forces_and_coefficients_keep_all_numbers_finite() {
    for value in [1e-38, 1e20, 3e38, -3e38] {
        let (mut simulator, bodies) = busy_scene();
        simulator.set_gravity(Vector2::new(value, value)).unwrap();
        for &body in &bodies {
            set_surface(&mut simulator, body, value, value);
            simulator.body_mut(body).unwrap().apply_force_z(value);
            simulator.body_mut(body).unwrap().apply_impulse_z(-value);
        }
        for _ in 0..100 {
            simulator.update(0.01);
            assert_finite(&simulator, &bodies);
        }
    }
}

#[test]
pub(crate) fn negative_masses_and_steps_keep_all_numbers_finite() {
    let (mut simulator, bodies) = busy_scene();
    simulator.body_mut(bodies[0]).unwrap().core_mut().set_mass(-1.0).unwrap();
    for dt in [0.01, -0.01, 0.0, 10.0, -10.0, 1e-38, 1e30] {
        for _ in 0..30 {
            simulator.update(dt);
            assert_finite(&simulator, &bodies);
        }
    }
}

/// Disposes of every touching body, and adds none.
struct Disposer;

impl EventHandler for Disposer {
    fn on_collision(&mut self, context: &mut Context<'_>, collision: &Collision) -> bool {
        if let Some(body) = context.geom(collision.this).map(|geom| geom.body()) {
            context.dispose(body).unwrap();
        }
        true
    }
}

#[test]
pub(crate) fn bodies_that_are_disposed_during_a_callback_are_gone_after_the_next_update() {
    let (mut simulator, bodies) = busy_scene();
    for _ in 0..300 {
        simulator.update_with(0.01, &mut Disposer);
    }
    let left = bodies.iter().filter(|&&body| simulator.body(body).is_some()).count();
    assert!(left < bodies.len());
    assert_eq!(simulator.body_list().len(), left);
    // Their slots serve new bodies, which begin without the state of the old ones.
    let fresh: Vec<BodyId> = (left..bodies.len()).map(|_| simulator.create_body(Body::new())).collect();
    for &body in &fresh {
        let view = simulator.body(body).unwrap();
        assert_eq!((view.position3d().z, view.linear_velocity_z()), (0.0, 0.0));
    }
    run(&mut simulator, 50);
}
