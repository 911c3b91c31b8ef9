//! Families of springs that are stiffer than an explicit method can follow.

use super::parts::{all, calm, never_above};
use super::{StabilityFamily, reasons};
use crate::scenes::stage::{METRE, Stage};
use crate::watch::Watch;
use crate::world::World;
use conformance::scene::{Scene, SpringKind, SpringSettings, SpringSpec};
use farseer_core::math::Vector2;

/// Values of k dt² / m (k: stiffness, m: mass), dimensionless. Position and velocity change once per step. At 4 a swing
/// reverses completely from step to step, and beyond 4 it grows. Below 4 the amplitude is 1 / sqrt(1 - k dt² / 4m) times the
/// exact one: 6.3 times at 3.9.
const STIFFNESS: &[f64] = &[0.01, 0.1, 0.5, 1.0, 2.0, 3.0, 3.9, 4.1, 5.0, 8.0, 16.0, 100.0];
const QUICK_STIFFNESS: &[f64] = &[0.1, 1.0, 3.9, 4.1, 16.0];

const SWINGS: StabilityFamily = StabilityFamily {
    parameter: "k dt² / m",
    values: STIFFNESS,
    quick_values: QUICK_STIFFNESS,
    judge: |_, scene| swing_stays_small(scene, |world| (world.body(0).position[0] - REST).abs(), STRETCH),
    quantity: "greatest swing",
    ..StabilityFamily::PLAIN
};

pub(super) const FAMILIES: [StabilityFamily; 3] = [
    StabilityFamily {
        name: "Stiff Spring",
        about: "A mass of 1 kg on a spring without damping, stretched by 1 m, swings for 10 s and never ten times as far. \
                Only growth is judged: a swing that has died holds as well.",
        build: |stiffness, dt| linear(stiffness / squared(dt), 0.0),
        ..SWINGS
    },
    StabilityFamily {
        name: "Stiff Damper",
        about: "A mass of 1 kg on a spring of k dt² / m = 0.1 with damping, stretched by 1 m, swings for 10 s and never ten \
                times as far. Only growth is judged: a mass that hardly moves holds as well.",
        parameter: "c dt / m",
        values: &[0.01, 0.1, 0.5, 1.0, 1.5, 1.9, 2.0, 2.5, 4.0, 10.0],
        quick_values: &[0.1, 1.0, 1.9, 2.5],
        build: |damping, dt| linear(0.1 / squared(dt), damping / f64::from(dt)),
        ..SWINGS
    },
    StabilityFamily {
        name: "Stiff Angle Spring",
        about: "A box of 1 m on a spring that holds its angle, without damping, turned by 0.5 rad, swings for 10 s and \
                never ten times as far. Only growth is judged: a swing that has died holds as well.",
        parameter: "k dt² / I",
        build: |stiffness, dt| angular(stiffness * f64::from(INERTIA) / squared(dt)),
        judge: |_, scene| swing_stays_small(scene, |world| world.body(0).angle.abs(), f64::from(TURN)),
        quantity_unit: "rad",
        ..SWINGS
    },
];

/// Rest length of the linear spring, in px.
const REST: f64 = 100.0 * METRE as f64;
/// Initial extension of the linear spring beyond its rest length, in px.
const STRETCH: f64 = METRE as f64;
/// Initial rotation of the box on the angular spring, in radians.
const TURN: f32 = 0.5;
/// Moment of inertia of a square box of 1 m and 1 kg, in kg px².
const INERTIA: f32 = METRE * METRE / 6.0;

fn squared(dt: f32) -> f64 {
    f64::from(dt).powi(2)
}

/// Returns a scene of a mass on a linear spring to the origin.
fn linear(stiffness: f64, damping: f64) -> Scene {
    let mut stage = Stage::without_gravity();
    stage.ghost([(REST + STRETCH) as f32, 0.0], [METRE, METRE], 1.0);
    let origin = Vector2::zeros();
    let kind = SpringKind::FixedLinear { body: 0, body_attach_point: origin, world_attach_point: origin };
    let settings = SpringSettings { rest_length: Some(REST as f32), ..SpringSettings::default() };
    with_spring(stage, kind, settings, stiffness, damping)
}

/// Returns a scene of a box on an angular spring.
fn angular(stiffness: f64) -> Scene {
    let mut stage = Stage::without_gravity();
    stage.ghost([0.0, 0.0], [METRE, METRE], 1.0);
    stage.last().rotation = Some(TURN);
    let settings = SpringSettings { target_angle: Some(0.0), ..SpringSettings::default() };
    with_spring(stage, SpringKind::FixedAngle { body: 0 }, settings, stiffness, 0.0)
}

fn with_spring(mut stage: Stage, kind: SpringKind, settings: SpringSettings, k: f64, c: f64) -> Scene {
    stage.scene_mut().springs.push(SpringSpec {
        kind,
        spring_constant: k as f32,
        damping_constant: c as f32,
        settings,
        in_simulation: true,
    });
    stage.done()
}

fn swing_stays_small(scene: &Scene, swing: fn(&dyn World) -> f64, first: f64) -> Box<dyn Watch> {
    // The speed is not limited: a stiff spring may be fast.
    all(vec![calm(scene, f64::INFINITY), never_above(10.0 * first, reasons::BLEW_UP, swing)])
}
