//! Families of steps and values that a game should not pass to an engine, but does.

use super::parts::{Allowed, SPEED_LIMIT, all, calm, ends_in, standing};
use super::stacks::{BOXES, vertical_stack};
use super::{Moment, SECONDS, StabilityFamily, reasons};
use crate::scenes::stage::{METRE, Stage};
use crate::watch::Watch;
use crate::world::World;
use conformance::scene::Scene;

/// Base of families with a column of 3 boxes that has come to rest before the event.
const COLUMN: StabilityFamily = StabilityFamily { build: |_, _| vertical_stack(3), ..BOXES };

pub(super) const FAMILIES: [StabilityFamily; 6] = [
    StabilityFamily {
        name: "Step Spike",
        about: "A column of 3 boxes of 1 m stands, though one step meanwhile is this long.",
        parameter: "length of the step",
        unit: "s",
        values: &[0.02, 0.05, 0.1, 0.25, 0.5, 1.0, 2.0],
        quick_values: &[0.05, 0.25, 1.0],
        dt: |length, moment| if is_at(moment, 2.0) { length as f32 } else { moment.dt },
        ..COLUMN
    },
    StabilityFamily {
        name: "Step Spike, falling",
        about: "A ball of 1 m falls from 3 m on a floor of 1 m. One step, half a second after its start, is this long. \
                It ends on the floor.",
        parameter: "length of the step",
        unit: "s",
        values: &[0.02, 0.05, 0.1, 0.15, 0.2, 0.25, 0.5, 1.0],
        quick_values: &[0.05, 0.25, 1.0],
        build: |_, _| falling(),
        dt: |length, moment| if is_at(moment, 0.5) { length as f32 } else { moment.dt },
        judge: ends_on_the_floor,
        seconds: |_| 5.0,
        quantity: "height of its centre above its resting position",
        ..StabilityFamily::PLAIN
    },
    StabilityFamily {
        name: "Zero Steps",
        about: "A column of 3 boxes of 1 m stands, though some steps in it have no length. However many they are, \
                nothing is expected to fail.",
        parameter: "number of such steps",
        values: &[1.0, 2.0, 5.0, 10.0, 60.0],
        quick_values: &[1.0, 60.0],
        dt: |count, moment| if is_among(moment, 2.0, count) { 0.0 } else { moment.dt },
        ..COLUMN
    },
    StabilityFamily {
        name: "Tiny Steps",
        about: "A column of 3 boxes of 1 m stands, though 60 steps in it are this long, down to the least float there is. \
                However short they are, nothing is expected to fail.",
        parameter: "length of the steps",
        unit: "s",
        values: &[1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-9, 1e-12, 1e-20, 1e-38, 1e-45],
        quick_values: &[1e-3, 1e-7, 1e-45],
        dt: |length, moment| if is_among(moment, 2.0, 60.0) { length as f32 } else { moment.dt },
        ..COLUMN
    },
    StabilityFamily {
        name: "Huge Impulse",
        about: "A box on top of a column of 3 gets an impulse upwards and to the side. Everything stays finite, and the \
                other two stand. Up to the largest of floats, 3.4e38, nothing is expected to fail.",
        parameter: "impulse on 1 kg",
        unit: "kg px/s",
        values: &[1e3, 1e4, 1e6, 1e9, 1e12, 1e20, 1e30, 1e38],
        quick_values: &[1e3, 1e9, 1e38],
        act: |impulse, world, moment| {
            if is_at(moment, 2.0) {
                world.apply_impulse(TOP, [impulse, -impulse]);
            }
        },
        judge: others_stand,
        quantity: "greatest displacement of the others",
        ..COLUMN
    },
    StabilityFamily {
        name: "Not a Number",
        about: "The middle box of a column of 3 is given: 1 a velocity that is not a number, 2 an infinite velocity, \
                3 a position that is not a number, 4 an impulse that is not a number, 5 an infinite angular \
                velocity, 6 an infinite position. Everything stays finite, and the column stands.",
        parameter: "input",
        values: &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0],
        quick_values: &[1.0, 3.0],
        act: hand_in,
        ..COLUMN
    },
];

/// `MIDDLE`: index of the middle box of the column. `TOP`: index of the uppermost box. The floor is body 0.
const MIDDLE: usize = 2;
const TOP: usize = 3;

/// Returns whether `time` (s) is within the step `moment`.
fn is_at(moment: Moment, time: f64) -> bool {
    moment.step == (time / f64::from(moment.dt)).round() as u32
}

/// Returns whether the step `moment` is one of the `count` steps from `time` (s) on.
fn is_among(moment: Moment, time: f64, count: f64) -> bool {
    let first = (time / f64::from(moment.dt)).round() as u32;
    (first..first + count as u32).contains(&moment.step)
}

fn falling() -> Scene {
    let mut stage = Stage::new();
    stage.wall([0.0, METRE / 2.0], [20.0 * METRE, METRE]);
    stage.ball([0.0, -3.0 * METRE], METRE / 2.0);
    stage.done()
}

fn ends_on_the_floor(_: f64, scene: &Scene) -> Box<dyn Watch> {
    let height = |world: &dyn World| -f64::from(METRE) / 2.0 - world.body(1).position[1];
    all(vec![
        calm(scene, SPEED_LIMIT),
        ends_in(-3.2.., reasons::TUNNELLED, height),
        ends_in(..3.2, reasons::BLEW_UP, height),
    ])
}

fn others_stand(_: f64, scene: &Scene) -> Box<dyn Watch> {
    let mut others = scene.clone();
    others.bodies.truncate(TOP);
    // The speed of the pushed body is not limited, only finite.
    let finite = calm(scene, f64::INFINITY);
    all(vec![finite, calm(&others, SPEED_LIMIT), standing(&others, SECONDS, Allowed::BOXES)])
}

fn hand_in(what: f64, world: &mut dyn World, moment: Moment) {
    if !is_at(moment, 2.0) {
        return;
    }
    let infinite = [f64::INFINITY, 0.0];
    match what as u32 {
        1 => world.set_velocity(MIDDLE, [f64::NAN; 2], 0.0),
        2 => world.set_velocity(MIDDLE, infinite, 0.0),
        3 => world.teleport(MIDDLE, [f64::NAN; 2], 0.0),
        4 => world.apply_impulse(MIDDLE, [f64::NAN; 2]),
        5 => world.set_velocity(MIDDLE, [0.0; 2], f64::INFINITY),
        _ => world.teleport(MIDDLE, infinite, 0.0),
    }
}
