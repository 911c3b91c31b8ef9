//! The family "shadow": a ball flies over plates, and its shadow must lie on the highest surface below it.

use super::lanes::{ICE, RADIUS, scene};
use super::{DepthFamily, PLAIN};
use crate::scenes::depth::{DepthObject, DepthPlatform, DepthScene};
use crate::stability::reasons::MISPLACED;
use crate::watch::{Observation, Watch, watch};
use crate::world::World;

/// Number of plates side by side along the ball's path.
const PLATES: usize = 5;
/// Extent of a plate along X, px.
const WIDTH: f32 = 100.0;
/// Speed of the ball along X, px/s.
const SPEED: f32 = 200.0;

pub(super) const FAMILIES: [DepthFamily; 2] = [THIN, SUNK];

const THIN: DepthFamily = DepthFamily {
    name: "Shadow on the highest support",
    about: "A ball flies over a row of plates of different heights, some over others. Its shadow must lie on the \
            highest one beneath it at every step, and on the ground beside them.",
    parameter: "thickness of the plates",
    unit: "px",
    values: &[20.0, 5.0, 1.0, 0.1, 0.01, 1e-3, 1e-4],
    quick_values: &[20.0, 1.0, 1e-2, 1e-4],
    build: |value, _| plates(value),
    seconds: |_| f64::from(WIDTH * (PLATES + 1) as f32 / SPEED),
    judge: |value, _| on_plates(value),
    quantity: "largest distance from the right height",
    ..PLAIN
};

/// Returns the height in px of the upper face of a plate. Above each plate but the last lies a second one, 30 px higher and
/// narrower.
fn top_of(plate: usize) -> f32 {
    20.0 + 17.0 * (plate * 3 % PLATES) as f32
}

fn plates(thickness: f64) -> DepthScene {
    let ball = DepthObject::ball(RADIUS, [-0.7 * WIDTH, 200.0, 0.0]).with_velocity([SPEED, 0.0, 0.0]);
    let thickness = thickness as f32;
    (0..PLATES).fold(scene("shadow").weightless().with(ball), |scene, plate| {
        let x = WIDTH * plate as f32;
        let at = |width, top| DepthPlatform::new([width, thickness, 60.0], [x, top - thickness, 0.0], ICE);
        let scene = scene.with_platform(at(WIDTH, top_of(plate)));
        if plate + 1 == PLATES { scene } else { scene.with_platform(at(WIDTH / 2.0, top_of(plate) + 30.0)) }
    })
}

/// Returns the height in px of the highest surface below the ball at `x` px; `None` near an edge of a plate.
fn right_height(x: f64) -> Option<f64> {
    let width = f64::from(WIDTH);
    let plate = (x / width + 0.5).floor();
    let beside = (x - plate * width).abs();
    let is_near_edge = [0.25, 0.5].iter().any(|part| (beside - part * width).abs() < 0.01);
    if is_near_edge {
        return None;
    }
    if plate < 0.0 || plate >= PLATES as f64 {
        return Some(0.0);
    }
    let plate = plate as usize;
    let is_under_upper = beside < 0.25 * width && plate + 1 < PLATES;
    Some(f64::from(top_of(plate)) + if is_under_upper { 30.0 } else { 0.0 })
}

fn on_plates(_: f64) -> Box<dyn Watch> {
    watch(|time, world: &dyn World| {
        // Engines may find the surfaces below an object only in their first step.
        let right = right_height(world.body(0).position[0]).filter(|_| time > 0.0)?;
        Some(seen(world.height_beneath(0), right))
    })
}

fn seen(height: Option<f64>, right: f64) -> Observation {
    let wrong = height.map_or(f64::INFINITY, |height| (height - right).abs());
    if wrong > 0.01 { Observation::Failed(MISPLACED, wrong) } else { Observation::Fine(wrong) }
}

const SUNK: DepthFamily = DepthFamily {
    name: "Shadow of somebody sunk in",
    about: "A ball of radius 10 px is stuck in a platform; its shadow must still lie on the platform.",
    parameter: "depth in the platform",
    unit: "px",
    values: &[0.0, 0.05, 0.2, 1.0, 5.0, 9.0, 9.9, 10.1, 11.0, 15.0],
    quick_values: &[0.0, 1.0, 9.0, 11.0],
    build: |depth, _| {
        let ball = DepthObject::ball(RADIUS, [0.0, 60.0 - depth as f32, 0.0]).fixed();
        scene("shadow_of_sunk").with(ball).with_platform(DepthPlatform::new(
            [200.0, 40.0, 100.0],
            [0.0, 20.0, 0.0],
            ICE,
        ))
    },
    seconds: |_| 0.1,
    judge: |_, _| watch(|time, world| (time > 0.0).then(|| seen(world.height_beneath(0), 60.0))),
    ..THIN
};

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_right_height_is_that_of_the_highest_plate() {
        assert_eq!(right_height(-60.0), Some(0.0));
        assert_eq!(right_height(-40.0), Some(20.0));
        assert_eq!(right_height(10.0), Some(50.0));
        assert_eq!(right_height(400.0), Some(f64::from(top_of(4))));
        assert_eq!(right_height(50.0), None);
    }
}
