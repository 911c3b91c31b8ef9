//! The families "gap": objects slide over a gap between two platforms. They must fall into a wide gap and cross a narrow
//! one.

use super::lanes::{REST, each, largest, object, platform, scene};
use super::{DepthFamily, PLAIN};
use crate::scenes::depth::DepthScene;
use crate::stability::reasons::{CLIMBED, SANK, STUCK, STUMBLED};
use crate::watch::{Observation, Watch};
use crate::world::BodyState;

/// Height of the platforms' upper faces above the ground, px.
const TOP: f32 = 60.0;
/// Extent of one platform along the path, px.
const LENGTH: f32 = 200.0;
/// Directions of motion as components along X and Z (dimensionless): along X and along Z.
const WAYS: [[f32; 2]; 2] = [[1.0, 0.0], [0.0, 1.0]];
/// Distance along the path from an object's start to the middle of the gap, px.
const TO_MIDDLE: f32 = 80.0;

pub(super) const FAMILIES: [DepthFamily; 3] = [HOLE, NARROW, SEAM];

const HOLE: DepthFamily = DepthFamily {
    name: "Hole between platforms",
    about: "A box of 20 px in depth slides into the picture at 50 px/s and must fall into a hole that gets narrower.",
    parameter: "width of the hole",
    unit: "px",
    values: &[100.0, 60.0, 40.0, 30.0, 26.0, 24.0, 23.0, 22.0, 21.0],
    quick_values: &[100.0, 40.0, 26.0, 22.0],
    build: |gap, _| crossing(&[(false, 1)], 50.0, gap as f32),
    seconds: |_| 5.0,
    judge: |_, _| {
        each(1, |_, _, [_, y, _], _| match y {
            _ if y < REST => Observation::Ends(y.abs()),
            _ if y > f64::from(TOP) / 2.0 => Observation::Open(CLIMBED, y),
            _ => Observation::Open(STUCK, y),
        })
    },
    quantity: "height at the end",
    ..PLAIN
};

const NARROW: DepthFamily = DepthFamily {
    name: "Narrow gap between platforms",
    about: "Boxes slide at 50 px/s over a gap that is narrower than the boxes, along X and along Z, and must slide \
            on as if there were none.",
    parameter: "width of the gap",
    unit: "px",
    values: &[0.0, 1.0, 2.0, 4.0, 8.0, 12.0, 16.0, 19.0],
    quick_values: &[0.0, 2.0, 8.0, 16.0],
    build: |gap, _| crossing(&[(false, 0), (false, 1)], 50.0, gap as f32),
    seconds: |_| f64::from(2.0 * TO_MIDDLE) / 50.0,
    judge: |_, _| crosses(&[(false, 0), (false, 1)], 50.0),
    quantity: "largest distance from the platforms' height",
    ..PLAIN
};

const LANES: [(bool, usize); 4] = [(false, 0), (false, 1), (true, 0), (true, 1)];

const SEAM: DepthFamily = DepthFamily {
    name: "Seam of platforms, fast",
    about: "Balls and boxes slide over the seam of two platforms, along X and along Z, and must slide on undisturbed.",
    parameter: "speed",
    unit: "px/s",
    values: &[10.0, 30.0, 100.0, 300.0, 1e3, 3e3, 1e4],
    quick_values: &[10.0, 100.0, 1e3, 1e4],
    build: |speed, _| crossing(&LANES, speed, 0.0),
    seconds: |speed| f64::from(2.0 * TO_MIDDLE) / speed,
    judge: |speed, _| crosses(&LANES, speed),
    ..NARROW
};

/// Returns a scene with a gap of `gap` px between two platforms in each lane, and an object that slides towards it at
/// `speed` px/s. An entry of `lanes` is whether the object is a ball, and its direction as an index into `WAYS`.
fn crossing(lanes: &[(bool, usize)], speed: f64, gap: f32) -> DepthScene {
    let lanes = lanes.iter().enumerate();
    lanes.fold(scene("gap"), |mut scene, (lane, &(is_ball, way))| {
        let ([x, z], speed) = (WAYS[way], speed as f32);
        let comer = object(is_ball, lane, [-TO_MIDDLE * x, TOP, -TO_MIDDLE * z]);
        for side in [-1.0, 1.0] {
            let middle = side * (LENGTH + gap) / 2.0;
            let place = [middle * x, 0.0, middle * z];
            scene.platforms.push(platform([LENGTH, TOP, LENGTH], lane, place));
        }
        scene.with(comer.with_velocity([speed * x, 0.0, speed * z]))
    })
}

fn crosses(lanes: &'static [(bool, usize)], speed: f64) -> Box<dyn Watch> {
    each(lanes.len(), move |_, lane, [_, y, _], state: BodyState| {
        let [along_x, along_z] = WAYS[lanes[lane].1].map(f64::from);
        let change = [state.velocity[0] - speed * along_x, state.velocity[2] - speed * along_z];
        let wrong = (y - f64::from(TOP)).abs();
        if largest(change) > 1e-2 * speed || state.angle.abs() > 0.01 {
            Observation::Failed(STUMBLED, wrong)
        } else if wrong > REST {
            Observation::Failed(SANK, wrong)
        } else {
            Observation::Fine(wrong)
        }
    })
}
