//! Families that repeat a scene far from the origin, where floats are coarse.

use super::StabilityFamily;
use super::chains::{bridge, stays_joined};
use super::stacks::{BOXES, pyramid};

/// Distances of the scene from the origin in px.
const PLACES: &[f64] = &[0.0, 1e3, 1e4, 1e5, 1e6, 3e6, 1e7, 3e7, 1e8, 3e8, 1e9];
const QUICK_PLACES: &[f64] = &[0.0, 1e4, 1e6, 1e7, 1e9];

pub(super) const FAMILIES: [StabilityFamily; 2] = [
    StabilityFamily {
        name: "Far Pyramid",
        about: "A pyramid of 3 boxes of 1 m at the base stands for 10 s, however far it is from the origin. \
                (Floats are 8 px apart at 1e8 px. At 3e8 px they are 32 px apart, and a grid whose cell is a share of the \
                box's extent there may have no cell left: such a scene is refused.)",
        parameter: "distance",
        unit: "px",
        values: PLACES,
        quick_values: QUICK_PLACES,
        build: |place, _| pyramid(3, place as f32),
        ..BOXES
    },
    StabilityFamily {
        name: "Far Chain",
        about: "A bridge of 5 planks hangs for 10 s, however far it is from the origin; in the last 2 s no joint is open \
                by over a tenth of a metre.",
        parameter: "distance",
        unit: "px",
        values: PLACES,
        quick_values: QUICK_PLACES,
        build: |place, _| bridge(5, place as f32),
        judge: stays_joined,
        quantity: "widest gap of a joint in the last fifth",
        ..StabilityFamily::PLAIN
    },
];
