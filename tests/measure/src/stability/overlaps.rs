//! Families of bodies that begin with an overlap, or that lose the load which pressed them together.

use super::parts::{SPEED_LIMIT, all, calm, ends_in, never_above};
use super::{Moment, StabilityFamily, reasons};
use crate::penetration::Shapes;
use crate::scenes::movable;
use crate::scenes::stage::{METRE, Stage};
use crate::watch::{Watch, greatest};
use crate::world::World;
use conformance::scene::Scene;

pub(super) const FAMILIES: [StabilityFamily; 2] = [
    StabilityFamily {
        name: "Overlap Recovery",
        about: "A pyramid of 4 boxes of 1 m at the base begins with overlaps in both directions. It comes apart \
                without throwing anything: nothing gets over a metre higher than the pyramid without overlap is. After \
                5 s nothing lies below the floor, and no two boxes overlap by over a tenth of one.",
        parameter: "overlap, as a share of a box",
        values: &[0.01, 0.02, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.7, 0.9],
        quick_values: &[0.01, 0.05, 0.2, 0.5],
        build: |overlap, _| overlapping(overlap as f32),
        judge: comes_apart,
        seconds: |_| 5.0,
        quantity: "greatest speed",
        quantity_unit: "px/s",
        ..StabilityFamily::PLAIN
    },
    StabilityFamily {
        name: "Warm Start Energy",
        about: "A heavy box lies on a light one of 1 m for 2 s and is then taken away. The light one stays on the \
                floor: it rises by less than a tenth of a metre.",
        parameter: "mass ratio",
        values: &[1.0, 3.0, 10.0, 30.0, 100.0, 300.0, 1000.0, 10_000.0],
        quick_values: &[1.0, 10.0, 100.0, 1000.0],
        build: |ratio, _| pressed(ratio as f32),
        act: take_the_heavy_one_away,
        judge: the_light_one_stays,
        seconds: |_| 4.0,
        quantity: "greatest rise",
        ..StabilityFamily::PLAIN
    },
];

/// Greatest overlap in px at the end of a run that is no failure: a tenth of a box, which a player sees.
const OVERLAP_LEFT: f64 = 3.2;

const BASE: usize = 4;

fn overlapping(overlap: f32) -> Scene {
    let mut stage = Stage::new().with_floor(40.0 * METRE);
    let spacing = METRE * (1.0 - overlap);
    stage.pyramid(BASE, 0.0, [spacing; 2]);
    stage.done()
}

fn comes_apart(_: f64, scene: &Scene) -> Box<dyn Watch> {
    let (bodies, others, shapes) = (movable(scene), movable(scene), Shapes::of(scene));
    let limit = f64::from(METRE) * (BASE as f64 - 0.5 + 1.0);
    let highest = move |world: &dyn World| greatest(world, &bodies, |body| -body.position[1]);
    let lowest = move |world: &dyn World| greatest(world, &others, |body| body.position[1]);
    all(vec![
        calm(scene, SPEED_LIMIT),
        never_above(limit, reasons::BLEW_UP, highest),
        ends_in(..0.0, reasons::TUNNELLED, lowest),
        ends_in(..OVERLAP_LEFT, reasons::SANK, move |world| shapes.largest_overlap(world)),
        // Repeated as the last watch, so that the greatest speed is the measured value.
        calm(scene, SPEED_LIMIT),
    ])
}

/// `LIGHT`: index of the light body. `HEAVY`: index of the heavy body.
const LIGHT: usize = 1;
const HEAVY: usize = 2;

fn pressed(ratio: f32) -> Scene {
    let mut stage = Stage::new().with_floor(80.0 * METRE);
    stage.boxed([0.0, -0.5 * METRE], [METRE, METRE], 1.0);
    stage.boxed([0.0, -1.5 * METRE], [METRE, METRE], ratio);
    stage.done()
}

fn take_the_heavy_one_away(_: f64, world: &mut dyn World, moment: Moment) {
    let dt = f64::from(moment.dt);
    if moment.time < 2.0 && moment.time + dt >= 2.0 {
        world.teleport(HEAVY, [1000.0, -0.5 * f64::from(METRE)], 0.0);
        world.set_velocity(HEAVY, [0.0, 0.0], 0.0);
    }
}

fn the_light_one_stays(_: f64, scene: &Scene) -> Box<dyn Watch> {
    let rise = |world: &dyn World| -0.5 * f64::from(METRE) - world.body(LIGHT).position[1];
    let depth = |world: &dyn World| world.body(LIGHT).position[1];
    all(vec![
        calm(scene, SPEED_LIMIT),
        ends_in(..-0.4 * f64::from(METRE), reasons::SANK, depth),
        never_above(0.1 * f64::from(METRE), reasons::BLEW_UP, rise),
    ])
}
