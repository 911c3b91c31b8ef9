//! Families of friction at its limit.

use super::parts::{SPEED_LIMIT, all, calm, ends_in};
use super::{StabilityFamily, reasons};
use crate::scenes::stage::{GRAVITY, METRE, Stage};
use crate::watch::Watch;
use crate::world::{World, distance};
use conformance::scene::Scene;

pub(super) const FAMILIES: [StabilityFamily; 2] = [
    StabilityFamily {
        name: "Friction Ramp",
        about: "A box of 2 m by 1 m on a slope of 0.25 rad does not slide, since friction is greater than the slope: it \
                moves by less than half a px in 10 s.",
        parameter: "friction, as a share of the slope",
        values: &[4.0, 2.0, 1.5, 1.2, 1.1, 1.05, 1.02, 1.01, 1.005, 1.002, 1.001, 1.0005, 1.0001],
        quick_values: &[2.0, 1.05, 1.001],
        build: |share, _| ramp(share as f32),
        judge: sticks,
        quantity: "distance moved",
        ..StabilityFamily::PLAIN
    },
    StabilityFamily {
        name: "Friction Ramp, sliding",
        about: "A box of 2 m by 1 m on a slope of 0.25 rad, with friction less than the slope, slides in 2 s as far as the \
                difference makes it, to a tenth.",
        parameter: "friction, as a share of the slope",
        values: &[0.0, 0.25, 0.5, 0.75, 0.8, 0.9, 0.95, 0.98],
        quick_values: &[0.0, 0.5, 0.9],
        build: |share, _| ramp(share as f32),
        judge: slides,
        seconds: |_| SLIDING,
        quantity: "distance, as a fraction of the expected one",
        quantity_unit: "",
        ..StabilityFamily::PLAIN
    },
];

/// Angle of the slope in radians.
const SLOPE: f32 = 0.25;
/// Duration of sliding in s.
const SLIDING: f64 = 2.0;

/// Returns a scene of a box on a slope that falls to the right. `share` is the friction coefficient divided by the tangent of
/// the slope, dimensionless.
fn ramp(share: f32) -> Scene {
    let mut stage = Stage::new().with_friction(share * SLOPE.tan());
    let normal = [SLOPE.sin(), -SLOPE.cos()];
    let thickness = 2.0 * METRE;
    // The surface of the slope goes through the origin.
    stage.wall([-normal[0] * thickness / 2.0, -normal[1] * thickness / 2.0], [60.0 * METRE, thickness]);
    stage.last().rotation = Some(SLOPE);
    let height = METRE / 2.0;
    let start = -20.0 * METRE;
    let along = [SLOPE.cos() * start, SLOPE.sin() * start];
    stage.solid([along[0] + normal[0] * height, along[1] + normal[1] * height], [2.0 * METRE, METRE]);
    stage.last().rotation = Some(SLOPE);
    stage.done()
}

/// Returns a measure of the world: the distance in px of the box from its start.
fn moved(scene: &Scene) -> impl Fn(&dyn World) -> f64 + 'static {
    let start = scene.bodies[1].position.map_or([0.0; 2], |place| [f64::from(place.x), f64::from(place.y)]);
    move |world| distance(start, world.body(1).position_in_plane())
}

fn sticks(_: f64, scene: &Scene) -> Box<dyn Watch> {
    all(vec![calm(scene, SPEED_LIMIT), ends_in(..0.5, reasons::CREPT, moved(scene))])
}

fn slides(share: f64, scene: &Scene) -> Box<dyn Watch> {
    let slope = f64::from(SLOPE);
    let right = f64::from(GRAVITY) * slope.sin() * (1.0 - share) * SLIDING * SLIDING / 2.0;
    let moved = moved(scene);
    let part = move |world: &dyn World| moved(world) / right;
    all(vec![calm(scene, SPEED_LIMIT), ends_in(0.9..=1.1, reasons::STUCK, part)])
}
