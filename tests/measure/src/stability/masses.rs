//! Families of heavy bodies on light ones.

use super::StabilityFamily;
use super::stacks::{BOXES, stands};
use crate::scenes::stage::{METRE, Stage};
use conformance::scene::Scene;

/// Mass of the heavy body divided by that of the light one, dimensionless.
const RATIOS: &[f64] = &[1.0, 3.0, 10.0, 30.0, 100.0, 300.0, 1000.0, 10_000.0];
const QUICK_RATIOS: &[f64] = &[1.0, 10.0, 100.0, 1000.0];

const RATIO: StabilityFamily = StabilityFamily {
    parameter: "mass ratio",
    values: RATIOS,
    quick_values: QUICK_RATIOS,
    judge: stands,
    ..BOXES
};

pub(super) const FAMILIES: [StabilityFamily; 3] = [
    StabilityFamily {
        name: "High Mass Ratio 1",
        about: "A pyramid of 3 boxes of 1 m at the base with a heavy box on top stands for 10 s: nothing ends lower or \
                higher than it began by over a tenth of its height above the floor, nor leaves \
                its place, turns or creeps.",
        build: |ratio, _| heavy_top(ratio as f32),
        ..RATIO
    },
    StabilityFamily {
        name: "High Mass Ratio 2",
        about: "A heavy box of 4 m stands on two light boxes of 1 m for 10 s: nothing ends lower or higher than it began \
                by over a tenth of its height above the floor, nor leaves \
                its place, turns or creeps.",
        build: |ratio, _| heavy_table(ratio as f32),
        ..RATIO
    },
    StabilityFamily {
        name: "High Mass Ratio 3",
        about: "A heavy box of 4 m stands on the tips of two light triangles of 1 m for 10 s: nothing ends lower or \
                higher than it began by over a tenth of its height above the floor, nor leaves \
                its place, turns or creeps.",
        build: |ratio, _| heavy_on_tips(ratio as f32),
        ..RATIO
    },
];

fn heavy_top(ratio: f32) -> Scene {
    let mut stage = Stage::new().with_floor(20.0 * METRE);
    let size = [METRE, METRE];
    for (row, places) in [&[-1.1_f32, 0.0, 1.1][..], &[-0.55, 0.55]].into_iter().enumerate() {
        for place in places {
            stage.boxed([place * METRE, -METRE * (row as f32 + 0.5)], size, 1.0);
        }
    }
    stage.boxed([0.0, -2.5 * METRE], size, ratio);
    stage.done()
}

fn heavy_table(ratio: f32) -> Scene {
    let mut stage = Stage::new().with_floor(20.0 * METRE);
    for side in [-1.5, 1.5] {
        stage.boxed([side * METRE, -0.5 * METRE], [METRE, METRE], 1.0);
    }
    stage.boxed([0.0, -3.0 * METRE], [4.0 * METRE, 4.0 * METRE], ratio);
    stage.done()
}

fn heavy_on_tips(ratio: f32) -> Scene {
    let mut stage = Stage::new().with_floor(20.0 * METRE);
    let half = METRE / 2.0;
    for middle in [-1.5 * METRE, 1.5 * METRE] {
        stage.polygon(&[[middle - half, 0.0], [middle + half, 0.0], [middle, -METRE]], 1.0);
    }
    stage.boxed([0.0, -3.0 * METRE], [4.0 * METRE, 4.0 * METRE], ratio);
    stage.done()
}
