//! Laws of physics that do not depend on bits: momentum, energy, friction.

use conformance::fixtures::plane::{Random, add_box, add_circle, add_floor, both_sets, simulator_with, v};
use farseer_core::math::Vector2;
use farseer_core::{BodyId, Methods, PhysicsSimulator};

fn without_drag(simulator: &mut PhysicsSimulator, body: BodyId) {
    simulator[body].set_linear_drag_coefficient(0.0);
    simulator[body].set_rotational_drag_coefficient(0.0);
}

/// Two bodies of random shape and mass on a collision course, without gravity and drag.
fn collision_course(methods: Methods, seed: u64) -> (PhysicsSimulator, [BodyId; 2]) {
    let mut random = Random::new(seed);
    let mut simulator = simulator_with(0.0, methods);
    let bodies = [-1.0, 1.0].map(|side| {
        let position = v(side * 40.0, random.between(-8.0, 8.0));
        let (body, geom) = if random.below(2) == 0 {
            add_circle(&mut simulator, random.between(10.0, 20.0), 16, position)
        } else {
            let size = (random.between(15.0, 35.0), random.between(15.0, 35.0));
            add_box(&mut simulator, size, position)
        };
        simulator[body].set_mass(random.between(0.5, 4.0)).unwrap();
        simulator[body].set_rotation(random.between(0.0, 3.0));
        simulator[body]
            .set_linear_velocity(v(side * random.between(-90.0, -50.0), random.between(-5.0, 5.0)));
        simulator[body].set_angular_velocity(random.between(-2.0, 2.0));
        simulator[geom].set_restitution_coefficient(random.between(0.0, 1.0));
        simulator[geom].set_friction_coefficient(random.between(0.0, 1.0));
        without_drag(&mut simulator, body);
        body
    });
    (simulator, bodies)
}

/// In double precision, so that summing adds no error of its own.
fn momentum(simulator: &PhysicsSimulator, bodies: &[BodyId]) -> [f64; 2] {
    let sum = |component: fn(Vector2) -> f32| {
        let of = |&body: &BodyId| {
            f64::from(simulator[body].mass()) * f64::from(component(simulator[body].linear_velocity()))
        };
        bodies.iter().map(of).sum::<f64>()
    };
    [sum(|v| v.x), sum(|v| v.y)]
}

/// Bound of the change of momentum per update, in mass units * length units/s.
///
/// Every impulse is rounded three times on each side (times the normal, times 1/m, and the sum) by half an ulp of the result.
/// Masses are 4 at most, velocities stay below 512, so one impulse changes the momentum by at most 2 sides * 3 roundings * 4 *
/// 512 * 2^-24. An update has 2 * 4 contacts * 6 iterations of them. 1/m itself is off by half an ulp, which adds as much
/// again.
const MOMENTUM_ERROR_PER_UPDATE: f64 = 2.0 * (2.0 * 3.0 * 4.0 * 512.0 / 16_777_216.0) * (8.0 * 6.0);

#[test]
fn two_free_bodies_that_collide_keep_their_momentum() {
    for methods in both_sets() {
        let mut collided = 0;
        for seed in 0..40 {
            let (mut simulator, bodies) = collision_course(methods, seed);
            let mut before = momentum(&simulator, &bodies);
            let mut touched = false;
            for step in 0..120 {
                simulator.update(0.01);
                touched |= simulator.contact_count() > 0;
                let after = momentum(&simulator, &bodies);
                for (a, b) in before.iter().zip(after) {
                    let error = (a - b).abs();
                    assert!(
                        error < MOMENTUM_ERROR_PER_UPDATE,
                        "{methods:?} seed {seed} step {step}: {error}"
                    );
                }
                before = after;
            }
            collided += u32::from(touched);
        }
        assert!(collided > 30, "{methods:?}: only {collided} pairs met");
    }
}

#[test]
fn momentum_is_exchanged_in_a_collision() {
    for methods in both_sets() {
        let (mut simulator, [a, b]) = collision_course(methods, 1);
        let before = simulator[a].linear_velocity().x;
        for _ in 0..120 {
            simulator.update(0.01);
        }
        assert!((simulator[a].linear_velocity().x - before).abs() > 10.0, "{methods:?}");
        assert!(simulator[a].linear_velocity().x <= simulator[b].linear_velocity().x, "{methods:?}");
    }
}

/// A ball that falls on a floor, with restitution 1 on both.
///
/// Only position correction raises the ball without velocity. It moves the ball by at most the depth of an overlap; with speed
/// s that is s * dt at most per bounce. Velocity is integrated before position, which keeps the energy below that of the exact
/// parabola.
#[test]
fn a_perfectly_elastic_ball_gains_no_more_energy_than_position_correction_gives() {
    const GRAVITY: f32 = 100.0;
    const DT: f32 = 0.01;
    for methods in both_sets() {
        let mut simulator = simulator_with(GRAVITY, methods);
        let (_, floor) = add_floor(&mut simulator, (400.0, 40.0), v(0.0, 120.0));
        let (body, ball) = add_circle(&mut simulator, 10.0, 32, v(0.0, 0.0));
        without_drag(&mut simulator, body);
        simulator[floor].set_restitution_coefficient(1.0);
        simulator[ball].set_restitution_coefficient(1.0);
        let energy = |simulator: &PhysicsSimulator| {
            let (position, velocity) = (simulator[body].position(), simulator[body].linear_velocity());
            0.5 * velocity.y * velocity.y - GRAVITY * position.y
        };
        let start = energy(&simulator);
        let (mut bounces, mut allowed) = (0, 0.0);
        for step in 0..2000 {
            let speed_before = simulator[body].linear_velocity().y;
            simulator.update(DT);
            let speed_after = simulator[body].linear_velocity().y;
            let turned = speed_before > 0.0 && speed_after < 0.0;
            bounces += u32::from(turned);
            // Within a bounce: the overlap that is corrected, and gravity during the updates of the bounce.
            if simulator.contact_count() > 0 {
                allowed += GRAVITY * (speed_before.abs() + GRAVITY * DT) * DT * 2.0;
            }
            // Free flight: position and velocity are half a step apart, which shows as an energy that wavers.
            let wavers = 0.5 * GRAVITY * DT * speed_after.abs();
            let gained = energy(&simulator) - start - allowed - wavers;
            assert!(gained < 1.0, "{methods:?} step {step}: gained {gained} after {bounces} bounces");
        }
        assert!(bounces >= 3, "{methods:?}: {bounces} bounces");
    }
}

#[test]
fn a_ball_without_restitution_stays_on_the_floor() {
    for methods in both_sets() {
        let mut simulator = simulator_with(100.0, methods);
        add_floor(&mut simulator, (400.0, 40.0), v(0.0, 120.0));
        let (body, _) = add_circle(&mut simulator, 10.0, 32, v(0.0, 0.0));
        for _ in 0..400 {
            simulator.update(0.01);
        }
        let position = simulator[body].position();
        assert!((position.y - 90.0).abs() < 0.5, "{methods:?}: {position:?}");
        assert!(simulator[body].linear_velocity().y.abs() < 1.5);
    }
}

/// A box on a floor under a gravity that pulls sideways as well: how far it slides in 2 s.
fn slide(methods: Methods, friction: f32, slope: f32) -> f32 {
    let mut simulator = simulator_with(0.0, methods);
    simulator.set_gravity(v(100.0 * slope, 100.0)).unwrap();
    let (_, floor) = add_floor(&mut simulator, (4000.0, 40.0), v(0.0, 120.0));
    let (body, geom) = add_box(&mut simulator, (40.0, 20.0), v(0.0, 90.0));
    simulator[floor].set_friction_coefficient(friction);
    simulator[geom].set_friction_coefficient(friction);
    for _ in 0..200 {
        simulator.update(0.01);
    }
    simulator[body].position().x
}

#[test]
fn a_box_rests_where_friction_exceeds_the_slope() {
    for methods in both_sets() {
        let distance = slide(methods, 0.5, 0.3);
        assert!(distance.abs() < 1.0, "{methods:?}: {distance}");
    }
}

#[test]
fn a_box_slides_where_the_slope_exceeds_friction() {
    for methods in both_sets() {
        // (0.5 - 0.2) * 100 over 2 s: 60; and 100 without friction.
        let (rough, smooth) = (slide(methods, 0.2, 0.5), slide(methods, 0.0, 0.5));
        assert!((rough - 60.0).abs() < 6.0, "{methods:?}: {rough}");
        assert!((smooth - 100.0).abs() < 3.0, "{methods:?}: {smooth}");
    }
}

#[test]
fn a_moving_static_floor_carries_a_box_along() {
    for methods in both_sets() {
        let mut simulator = simulator_with(100.0, methods);
        let (belt, floor) = add_floor(&mut simulator, (4000.0, 40.0), v(0.0, 120.0));
        simulator[belt].set_linear_velocity(v(20.0, 0.0));
        let (body, geom) = add_box(&mut simulator, (40.0, 20.0), v(0.0, 90.0));
        simulator[floor].set_friction_coefficient(1.0);
        simulator[geom].set_friction_coefficient(1.0);
        for _ in 0..200 {
            simulator.update(0.01);
        }
        assert!((simulator[body].linear_velocity().x - 20.0).abs() < 1.0, "{methods:?}");
        assert_eq!(simulator[belt].position(), v(0.0, 120.0));
    }
}
