//! Families of boxes and circles on top of each other.

use super::parts::{Allowed, SPEED_LIMIT, all, calm, standing};
use super::{SECONDS, StabilityFamily};
use crate::scenes::stage::{METRE, Stage};
use crate::watch::Watch;
use conformance::scene::Scene;

pub(super) const FAMILIES: [StabilityFamily; 3] = [
    StabilityFamily {
        name: "Vertical Stack",
        about: "A column of boxes of 1 m stands for 10 s: no box ends lower or higher than it began by over a tenth of its \
                height above the floor, nor by over half a box. Nor does any leave its place, turn or creep.",
        parameter: "boxes",
        values: &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 10.0, 12.0, 15.0, 20.0, 30.0, 40.0],
        quick_values: &[1.0, 3.0, 5.0, 10.0, 20.0, 40.0],
        build: |count, _| vertical_stack(count as usize),
        ..BOXES
    },
    StabilityFamily {
        name: "Pyramid",
        about: "A pyramid of boxes of 1 m, each row with one less than that below, stands for 10 s: no box ends lower \
                or higher than it began by over a tenth of its height above the floor, nor by over half a box. Nor does any leave its place, turn or creep.",
        parameter: "boxes in the lowest row",
        values: &[2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 15.0, 20.0],
        quick_values: &[2.0, 3.0, 5.0, 10.0],
        build: |base, _| pyramid(base as usize, 0.0),
        ..BOXES
    },
    StabilityFamily {
        name: "Circle Stack",
        about: "A column of circles of 1 m, one exactly above the other, stands for 10 s: none ends lower or higher than \
                it began by over a tenth of its height above the floor, nor by over half a circle. Nor does any leave its \
                place or creep.",
        parameter: "circles",
        values: &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 15.0, 20.0],
        quick_values: &[1.0, 2.0, 5.0, 10.0],
        build: |count, _| circle_stack(count as usize),
        ..BOXES
    },
];

/// Base of families with boxes of 1 m that must stay where they are.
pub(super) const BOXES: StabilityFamily =
    StabilityFamily { quantity: "greatest displacement", judge: stands, ..StabilityFamily::PLAIN };

/// Returns a watch of boxes of 1 m that must stay where they are for [`SECONDS`](super::SECONDS).
pub(super) fn stands(_: f64, scene: &Scene) -> Box<dyn Watch> {
    let standing = standing(scene, SECONDS, Allowed::BOXES);
    all(vec![calm(scene, SPEED_LIMIT), standing])
}

pub(super) fn vertical_stack(count: usize) -> Scene {
    let mut stage = Stage::new().with_floor(20.0 * METRE);
    for row in 0..count {
        stage.solid([0.0, -METRE * (row as f32 + 0.5)], [METRE, METRE]);
    }
    stage.done()
}

/// Returns a pyramid with `base` boxes in the lowest row, whose middle is at x = `centre` px.
pub(crate) fn pyramid(base: usize, centre: f32) -> Scene {
    /// Distance in px from centre to centre of neighbouring boxes in a row: the gap is a tenth of a box.
    const SPACING: f32 = 1.1 * METRE;
    let mut stage = Stage::new();
    stage.wall([centre, METRE], [(base + 10) as f32 * SPACING, 2.0 * METRE]);
    stage.pyramid(base, centre, [SPACING, METRE]);
    stage.done()
}

fn circle_stack(count: usize) -> Scene {
    let mut stage = Stage::new().with_floor(20.0 * METRE);
    for row in 0..count {
        stage.ball([0.0, -METRE * (row as f32 + 0.5)], METRE / 2.0);
    }
    stage.done()
}
