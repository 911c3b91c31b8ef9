//! The same scene far from the origin, where floats are coarse.

use super::chains::bridge;
use super::parts::{SPEED_LIMIT, all, calm, joined};
use super::stacks::{BOXES, pyramid};
use super::{StabilityFamily, reasons};

/// Places in px.
const PLACES: &[f64] = &[0.0, 1e3, 1e4, 1e5, 1e6, 3e6, 1e7];
const QUICK_PLACES: &[f64] = &[0.0, 1e4, 1e6, 1e7];

pub(super) const FAMILIES: [StabilityFamily; 2] = [
    StabilityFamily {
        name: "Far Pyramid",
        about: "A pyramid of 3 boxes of 1 m at the base stands for 10 s, however far it is from the origin.",
        parameter: "distance",
        unit: "px",
        values: PLACES,
        quick_values: QUICK_PLACES,
        build: |place, _| pyramid(3, place as f32),
        ..BOXES
    },
    StabilityFamily {
        name: "Far Chain",
        about: "A bridge of 5 planks hangs for 10 s, however far it is from the origin; no joint is open by over a \
                tenth of a metre.",
        parameter: "distance",
        unit: "px",
        values: PLACES,
        quick_values: QUICK_PLACES,
        build: |place, _| bridge(5, place as f32),
        judge: |_, scene| all(vec![calm(scene, SPEED_LIMIT), joined(scene, 3.2, reasons::STRETCHED)]),
        quantity: "widest gap of a joint at the end",
        ..StabilityFamily::PLAIN
    },
];
