//! Families of fast bodies and thin walls.

use super::parts::{all, calm, each_reaches, never_above};
use super::{StabilityFamily, reasons};
use crate::scenes::movable;
use crate::scenes::stage::{METRE, Stage};
use crate::watch::{Watch, greatest};
use crate::world::World;
use conformance::scene::Scene;
use farseer_core::math::Vector2;

/// Speeds of the bullets or planks in px/s, from easy to hard.
const SPEEDS: &[f64] = &[100.0, 200.0, 400.0, 800.0, 1600.0, 3200.0, 6400.0, 12_800.0, 25_600.0];
const QUICK_SPEEDS: &[f64] = &[200.0, 800.0, 3200.0, 12_800.0];

const BULLET: StabilityFamily = StabilityFamily {
    parameter: "speed",
    unit: "px/s",
    values: SPEEDS,
    quick_values: QUICK_SPEEDS,
    judge: stays_before_the_wall,
    seconds: |_| 4.0,
    quantity: "greatest depth of a bullet's centre behind the wall's face",
    ..StabilityFamily::PLAIN
};

pub(super) const FAMILIES: [StabilityFamily; 6] = [
    StabilityFamily {
        name: "Bullet Circle, wall of 4 px",
        about: "Eight circles of 8 px fly at a wall of 4 px, each from a little farther. All arrive, and none gets through.",
        build: |speed, _| bullets(speed as f32, 4.0, true),
        ..BULLET
    },
    StabilityFamily {
        name: "Bullet Circle, wall of 32 px",
        about: "Eight circles of 8 px fly at a wall of 32 px, each from a little farther. All arrive, and none gets through.",
        build: |speed, _| bullets(speed as f32, 32.0, true),
        ..BULLET
    },
    StabilityFamily {
        name: "Bullet Box, wall of 4 px",
        about: "Eight squares of 8 px fly at a wall of 4 px, each from a little farther. All arrive, and none gets through.",
        build: |speed, _| bullets(speed as f32, 4.0, false),
        ..BULLET
    },
    StabilityFamily {
        name: "Bullet Box, wall of 32 px",
        about: "Eight squares of 8 px fly at a wall of 32 px, each from a little farther. All arrive, and none gets through.",
        build: |speed, _| bullets(speed as f32, 32.0, false),
        ..BULLET
    },
    StabilityFamily {
        name: "Bullet, thin wall",
        about: "Eight circles of 8 px fly at 800 px/s at a wall, each from a little farther. All arrive, and none gets through.",
        parameter: "thickness of the wall",
        unit: "px",
        values: &[64.0, 32.0, 16.0, 8.0, 4.0, 2.0, 1.0],
        quick_values: &[64.0, 16.0, 4.0, 1.0],
        build: |thickness, _| bullets(800.0, thickness as f32, true),
        ..BULLET
    },
    StabilityFamily {
        name: "Spinning Plank",
        about: "A plank of 64 px by 2 px falls from 3 m onto a floor of 16 px while it spins. It arrives, and stays above it.",
        parameter: "spin",
        unit: "rad/s",
        values: &[0.0, 3.0, 10.0, 30.0, 100.0, 300.0, 1000.0],
        quick_values: &[0.0, 10.0, 100.0, 300.0],
        build: |spin, _| spinning(spin as f32),
        judge: stays_above_the_floor,
        quantity: "greatest depth of its centre below the floor's surface",
        ..BULLET
    },
];

/// Half the extent of a bullet along x and y, in px.
const HALF: f32 = 4.0;

/// Returns a scene of eight bullets that fly to the right at `speed` px/s against a wall whose left face is x = 0. `thickness`
/// is that of the wall in px.
fn bullets(speed: f32, thickness: f32, are_circles: bool) -> Scene {
    let mut stage = Stage::without_gravity();
    let lane = METRE;
    stage.wall([thickness / 2.0, 3.5 * lane], [thickness, 10.0 * lane]);
    for index in 0..8 {
        // Each bullet starts farther away than the one before, by an eighth of the motion in a step of 1/60 s, so that bullets
        // hit the wall at different times within a step.
        let place = [-100.0 - speed / 60.0 * index as f32 / 8.0, lane * index as f32];
        if are_circles {
            stage.ball(place, HALF);
        } else {
            stage.solid(place, [2.0 * HALF, 2.0 * HALF]);
        }
        stage.last().settings.linear_velocity = Some(Vector2::new(speed, 0.0));
    }
    stage.done()
}

fn stays_before_the_wall(_: f64, scene: &Scene) -> Box<dyn Watch> {
    let bodies = movable(scene);
    // The wall is body 0. A bullet whose centre has passed the centre of the wall is pushed out on the far side.
    let middle = scene.bodies[0].position.map_or(0.0, |place| f64::from(place.x));
    let depth = move |world: &dyn World| greatest(world, &bodies, |body| body.position[0]);
    // The run is valid only if every bullet came within its own size of the wall.
    let arrive = each_reaches(scene, -2.0 * f64::from(HALF), reasons::STUCK, |body| body.position[0]);
    all(vec![calm(scene, 1e6), arrive, never_above(middle, reasons::TUNNELLED, depth)])
}

/// Length and thickness of the plank in px.
const PLANK: [f32; 2] = [2.0 * METRE, 2.0];

fn spinning(spin: f32) -> Scene {
    let mut stage = Stage::new();
    stage.wall([0.0, 8.0], [400.0 * METRE, 16.0]);
    stage.solid([0.0, -3.0 * METRE], PLANK);
    stage.last().settings.angular_velocity = Some(spin);
    stage.last().rotation = Some(0.5);
    stage.done()
}

fn stays_above_the_floor(_: f64, scene: &Scene) -> Box<dyn Watch> {
    let bodies = movable(scene);
    let edge = 200.0 * f64::from(METRE);
    // A plank that left the floor over its edge did not tunnel and is not counted.
    let depth = move |world: &dyn World| {
        greatest(world, &bodies, |body| if body.position[0].abs() < edge { body.position[1] } else { 0.0 })
    };
    let arrive = each_reaches(scene, -f64::from(PLANK[0]), reasons::STUCK, |body| body.position[1]);
    all(vec![calm(scene, 1e6), arrive, never_above(8.0, reasons::TUNNELLED, depth)])
}
