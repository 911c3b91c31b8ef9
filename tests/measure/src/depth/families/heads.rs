//! The family "Head Bump": objects are thrown up against the underside of a platform and fall back.

use super::lanes::{REST, each, largest, object, platform, scene};
use super::{DepthFamily, PLAIN};
use crate::scenes::depth::DepthScene;
use crate::stability::reasons::{ASIDE, STUCK, TUNNELLED};
use crate::watch::Observation;

/// Height of the platform's underside above the ground, px.
const UNDERSIDE: f32 = 400.0;
/// Extent of balls and boxes along Y, px.
const HEIGHT: f32 = 20.0;
/// Number of balls, and of boxes. Each starts a quarter of 1/60 s of flight farther below the underside than the one
/// before, so that they hit at four phases of a step.
const PHASES: usize = 4;

pub(super) const FAMILIES: [DepthFamily; 2] = [FAST, THIN];

const FAST: DepthFamily = DepthFamily {
    name: "Head Bump, fast",
    about: "Balls and boxes are thrown up against the underside of a platform 30 px thick, at four phases of a step, and must \
            come back down.",
    parameter: "speed",
    unit: "px/s",
    values: &[150.0, 300.0, 600.0, 1e3, 1.6e3, 2.4e3, 3.6e3, 5e3, 1e4],
    quick_values: &[150.0, 1e3, 2.4e3, 1e4],
    build: |speed, _| thrown_up(speed, 30.0),
    // An object that is stopped at the underside, without a bounce, is back on the ground after 2.8 s.
    seconds: |_| 4.0,
    judge: |_, _| {
        each(2 * PHASES, |_, _, [x, y, z], _| {
            let wrong = largest([x - 10.0, y, z + 10.0]);
            if y > f64::from(UNDERSIDE) {
                Observation::Failed(TUNNELLED, wrong)
            } else if y > REST {
                Observation::Open(STUCK, wrong)
            } else if wrong > 1.0 {
                Observation::Open(ASIDE, wrong)
            } else {
                Observation::Ends(wrong)
            }
        })
    },
    quantity: "largest distance from the ground below",
    ..PLAIN
};

const THIN: DepthFamily = DepthFamily {
    name: "Head Bump, thin platform",
    about: "Balls and boxes are thrown up at 600 px/s against the underside of a platform that gets thinner, and \
            must come back down.",
    parameter: "thickness of the platform",
    unit: "px",
    values: &[40.0, 20.0, 10.0, 5.0, 2.0, 1.0, 0.5, 0.1],
    quick_values: &[40.0, 10.0, 2.0, 0.1],
    build: |thickness, _| thrown_up(600.0, thickness as f32),
    ..FAST
};

fn thrown_up(speed: f64, thickness: f32) -> DepthScene {
    (0..2 * PHASES).fold(scene("head_bump"), |scene, lane| {
        let time = (1.0 + (lane % PHASES) as f64 / PHASES as f64) / 60.0;
        let height = UNDERSIDE - HEIGHT - (speed * time) as f32;
        let thrown = object(lane < PHASES, lane, [10.0, height, -10.0]);
        scene.with(thrown.with_velocity([0.0, speed as f32, 0.0])).with_platform(platform(
            [200.0, thickness, 100.0],
            lane,
            [0.0, UNDERSIDE, 0.0],
        ))
    })
}
