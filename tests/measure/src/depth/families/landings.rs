//! The families "Land": objects fall on a platform and must stay there.

use super::lanes::{REST, each, largest, object, platform, scene};
use super::{DepthFamily, PLAIN};
use crate::scenes::depth::DepthScene;
use crate::stability::reasons::{ASIDE, BOUNCED, MISSED, SANK, TUNNELLED};
use crate::watch::{Observation, Watch};

/// Height of the platform's upper face above the ground, px.
const TOP: f32 = 60.0;
/// Number of balls, and of boxes. Each starts a quarter of 1/60 s of fall farther above the platform than the one before,
/// so that they land at four phases of a step.
const PHASES: usize = 4;
/// Duration of the fall of the first object in s.
const FALL: f64 = 0.2;

pub(super) const FAMILIES: [DepthFamily; 3] = [FAST, THIN, EDGE];

const FAST: DepthFamily = DepthFamily {
    name: "Land, fast",
    about: "Balls and boxes fall on a platform 40 px thick, at four phases of a step, and must lie on it.",
    parameter: "speed of the fall",
    unit: "px/s",
    values: &[30.0, 100.0, 300.0, 1e3, 1.6e3, 2.4e3, 3.6e3, 5e3, 1e4, 3e4],
    quick_values: &[100.0, 1e3, 2.4e3, 1e4],
    build: |speed, _| falling(speed, 40.0),
    seconds: |_| 4.0,
    judge: |_, _| lie_on_top(2 * PHASES),
    quantity: "largest distance from its expected resting position",
    ..PLAIN
};

const THIN: DepthFamily = DepthFamily {
    name: "Land, thin platform",
    about: "Balls and boxes fall at 600 px/s on a platform that gets thinner, at four phases of a step, and must lie \
            on it.",
    parameter: "thickness of the platform",
    unit: "px",
    values: &[40.0, 20.0, 10.0, 5.0, 2.0, 1.0, 0.5, 0.1],
    quick_values: &[40.0, 10.0, 2.0, 0.1],
    build: |thickness, _| falling(600.0, thickness as f32),
    ..FAST
};

const EDGE: DepthFamily = DepthFamily {
    name: "Land, over the edge",
    about: "Boxes fall at 300 px/s with little of them over the front or the back of a platform, and must lie there: \
            they do not tip in depth.",
    parameter: "box extent over the platform",
    unit: "px",
    values: &[10.0, 5.0, 2.0, 1.0, 0.5, 0.2, 0.1, 0.05, 0.02],
    quick_values: &[10.0, 2.0, 0.5, 0.1],
    build: |value, _| over_edge(value),
    judge: |_, _| lie_on_top_beside(2),
    ..FAST
};

fn falling(speed: f64, thickness: f32) -> DepthScene {
    (0..2 * PHASES).fold(scene("land"), |scene, lane| {
        let time = FALL + (lane % PHASES) as f64 / (60.0 * PHASES as f64);
        let above = (speed * time) as f32;
        let thrown = object(lane < PHASES, lane, [0.0, TOP + above, 0.0]);
        scene.with(thrown.with_velocity([0.0, -speed as f32, 0.0])).with_platform(platform(
            [200.0, thickness, 100.0],
            lane,
            [0.0, TOP - thickness, 0.0],
        ))
    })
}

fn over_edge(part: f64) -> DepthScene {
    (0..2).fold(scene("land_over_edge"), |scene, lane| {
        let side = if lane == 0 { -1.0 } else { 1.0 };
        // Half the platform's extent along Z (50 px), plus half the box's (10 px), less the overlap.
        let z = side * (50.0 + 10.0 - part as f32);
        let thrown = object(false, lane, [0.0, TOP + 60.0, z]);
        scene.with(thrown.with_velocity([0.0, -300.0, 0.0])).with_platform(platform(
            [200.0, 40.0, 100.0],
            lane,
            [0.0, TOP - 40.0, 0.0],
        ))
    })
}

fn lie_on_top(count: usize) -> Box<dyn Watch> {
    each(count, |_, _, [x, y, z], _| lying(y, largest([x, z]), TUNNELLED))
}

/// Returns a watch of `count` objects that must lie on a platform, at any Z.
fn lie_on_top_beside(count: usize) -> Box<dyn Watch> {
    each(count, |_, _, [x, y, _], _| lying(y, x.abs(), MISSED))
}

/// Returns the observation of an object whose lowest point is at height `y` px and which is `beside` px from its target.
/// `below_is` is the reason of the failure if the object is below the platform's upper face.
fn lying(y: f64, beside: f64, below_is: &'static str) -> Observation {
    let below = f64::from(TOP) - y;
    let wrong = beside.max(below.abs());
    if below > f64::from(TOP) / 2.0 {
        Observation::Open(below_is, wrong)
    } else if below < -1.0 {
        Observation::Open(BOUNCED, wrong)
    } else if below > REST {
        Observation::Open(SANK, wrong)
    } else if wrong > 1.0 {
        Observation::Open(ASIDE, wrong)
    } else {
        Observation::Ends(wrong)
    }
}
