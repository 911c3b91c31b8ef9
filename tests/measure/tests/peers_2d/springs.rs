//! Tests that springs in the peers swing with the frequency of their stiffness and the masses.

use super::{at, body, disc, in_both, joint, near, period, run, settings, spring, weightless};
use conformance::scene::*;
use measure::world::{World, masses};
use std::f64::consts::TAU;

#[test]
fn a_spring_swings_with_its_frequency() {
    let mut scene = weightless();
    disc(&mut scene, [130.0, 0.0]);
    let (body_attach_point, world_attach_point) = (at(0.0, 0.0), at(0.0, 0.0));
    let kind = SpringKind::FixedLinear { body: 0, body_attach_point, world_attach_point };
    spring(&mut scene, kind, 50.0, 0.0).settings.rest_length = Some(100.0);
    in_both(&scene, |name, world| {
        let expected = TAU / (50.0_f64 / 2.0).sqrt();
        near(name, period(world, 6.0, |world| world.body(0).position[0] - 100.0), expected, 2e-3 * expected);
    });
}

#[test]
fn damping_reduces_the_amplitude_of_a_spring() {
    let mut scene = weightless();
    disc(&mut scene, [130.0, 0.0]);
    let (body_attach_point, world_attach_point) = (at(0.0, 0.0), at(0.0, 0.0));
    let kind = SpringKind::FixedLinear { body: 0, body_attach_point, world_attach_point };
    spring(&mut scene, kind, 50.0, 1.0).settings.rest_length = Some(100.0);
    in_both(&scene, |name, world| {
        let (rate, frequency) = (1.0 / 4.0, (25.0_f64 - 1.0 / 16.0).sqrt());
        // Implicit steps of length h damp as well: by k h / 2, 2.6 % of the damping d of the spring with four substeps a step.
        let cycles = 3.0 * TAU / frequency;
        run(world, cycles);
        let expected = 30.0 * (-rate * cycles).exp();
        near(name, world.body(0).position[0] - 100.0, expected, 0.05 * 30.0);
    });
}

#[test]
fn a_spring_between_two_bodies_swings_with_their_reduced_mass() {
    let mut scene = weightless();
    disc(&mut scene, [0.0, 0.0]);
    body(&mut scene, BodyShape::Circle { radius: 16.0, mass: 6.0 }, [0.0, 130.0]);
    let (attach_point1, attach_point2) = (at(0.0, 0.0), at(0.0, 0.0));
    let kind = SpringKind::Linear { body1: 0, body2: 1, attach_point1, attach_point2 };
    spring(&mut scene, kind, 50.0, 0.0).settings.rest_length = Some(100.0);
    in_both(&scene, |name, world| {
        let expected = TAU / (50.0_f64 * (1.0 / 2.0 + 1.0 / 6.0)).sqrt();
        let stretch = |world: &dyn World| world.body(1).position[1] - world.body(0).position[1] - 100.0;
        near(name, period(world, 6.0, stretch), expected, 2e-3 * expected);
    });
}

#[test]
fn a_spring_on_the_rim_turns_a_body_with_its_lever() {
    let mut scene = weightless();
    disc(&mut scene, [0.0, 0.0]);
    joint(&mut scene, JointKind::FixedRevolute { body: 0, anchor: at(0.0, 0.0) });
    // The other end of the spring is far below the body, so that its direction hardly changes.
    let (body_attach_point, world_attach_point) = (at(12.0, 0.0), at(12.0, 3200.0));
    let kind = SpringKind::FixedLinear { body: 0, body_attach_point, world_attach_point };
    spring(&mut scene, kind, 30.0, 0.0);
    settings(&mut scene).angular_velocity = Some(0.3);
    let inertia = masses(&scene)[0].inertia;
    in_both(&scene, |name, world| {
        let expected = TAU / (30.0 * 12.0 * 12.0 / inertia).sqrt();
        near(name, period(world, 8.0, |world| world.body(0).angle), expected, 5e-3 * expected);
    });
}

#[test]
fn a_spring_on_the_rim_of_a_free_body_has_a_smaller_effective_mass() {
    let mut scene = weightless();
    disc(&mut scene, [0.0, 0.0]);
    let (body_attach_point, world_attach_point) = (at(12.0, 0.0), at(12.0, 3200.0));
    let kind = SpringKind::FixedLinear { body: 0, body_attach_point, world_attach_point };
    spring(&mut scene, kind, 30.0, 0.0);
    let inertia = masses(&scene)[0].inertia;
    in_both(&scene, |name, world| {
        // The initial velocities excite only the mode in which the point of attachment moves.
        let mobility = 1.0 / 2.0 + 12.0 * 12.0 / inertia;
        world.set_velocity(0, [0.0, 3.0 / 2.0], 3.0 * 12.0 / inertia);
        let expected = TAU / (30.0 * mobility).sqrt();
        near(name, period(world, 8.0, |world| world.body(0).position[1]), expected, 5e-3 * expected);
    });
}

#[test]
fn an_angle_spring_swings_with_its_frequency_and_damps() {
    let mut scene = weightless();
    disc(&mut scene, [0.0, 0.0]);
    disc(&mut scene, [100.0, 0.0]);
    spring(&mut scene, SpringKind::FixedAngle { body: 0 }, 8000.0, 0.0).settings.target_angle = Some(0.5);
    spring(&mut scene, SpringKind::FixedAngle { body: 1 }, 2000.0, 300.0).settings.torque_multiplier =
        Some(-4.0);
    settings(&mut scene).angular_velocity = Some(2.0);
    let inertia = masses(&scene)[0].inertia;
    in_both(&scene, |name, world| {
        let expected = TAU / (8000.0 / inertia).sqrt();
        near(name, period(world, 6.0, |world| world.body(0).angle - 0.5), expected, 2e-3 * expected);
    });
    in_both(&scene, |name, world| {
        let (rate, frequency) = (1200.0 / inertia / 2.0, (8000.0 / inertia).sqrt());
        let frequency = (frequency * frequency - rate * rate).sqrt();
        let time = TAU / frequency / 4.0;
        run(world, time);
        let expected = 2.0 / frequency * (-rate * time).exp() * (frequency * time).sin();
        near(name, world.body(1).angle, expected, 0.03 * expected);
    });
}

#[test]
fn an_angle_spring_between_two_bodies_swings_with_both_inertias() {
    let mut scene = weightless();
    disc(&mut scene, [0.0, 0.0]);
    body(&mut scene, BodyShape::Circle { radius: 16.0, mass: 6.0 }, [100.0, 0.0]);
    spring(&mut scene, SpringKind::Angle { body1: 0, body2: 1 }, 8000.0, 0.0);
    settings(&mut scene).angular_velocity = Some(3.0);
    let masses = masses(&scene);
    in_both(&scene, |name, world| {
        let expected = TAU / (8000.0 / masses[0].inertia + 8000.0 / masses[1].inertia).sqrt();
        let twist = |world: &dyn World| world.body(1).angle - world.body(0).angle;
        near(name, period(world, 6.0, twist), expected, 2e-3 * expected);
    });
}
