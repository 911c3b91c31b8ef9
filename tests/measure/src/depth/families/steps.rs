//! The families "step up": balls roll up a low step if they are fast enough; boxes are stopped by it.

use super::lanes::{each, object, platform, scene};
use super::{DepthFamily, PLAIN};
use crate::scenes::depth::DepthScene;
use crate::stability::reasons::{CLIMBED, STUCK};
use crate::watch::{Observation, Watch};

/// Speed of balls and boxes towards the step, px/s.
const SPEED: f64 = 60.0;
/// Directions of motion as components along X and Z (dimensionless): to the right, to the left, into the picture and out of it.
const DIRECTIONS: [[f32; 2]; 4] = [[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0]];
/// Half the extent of the step along X and Z, px.
const HALF: f32 = 200.0;
/// Distance along the path from an object's start to the step, px.
const WAY: f32 = 40.3;
/// Interval of time in s, before the step is reached, in which objects must be on their straight path.
const BEFORE: std::ops::Range<f64> = 0.25..0.3;
/// Simulated time in s. By the end a ball is on the step, or has rolled far back.
const SECONDS: f64 = 3.0;

pub(super) const FAMILIES: [DepthFamily; 3] = [UP, STOPPED, BOXES];

const UP: DepthFamily = DepthFamily {
    name: "Step up",
    about: "Balls of radius 10 px slide at 60 px/s over ice against a step and must climb it: up to 4.82 px they are \
            fast enough, if the step takes the part of their speed that points to its edge.",
    parameter: "height of the step",
    unit: "px",
    values: &[0.1, 0.5, 1.0, 2.0, 3.0, 4.0, 4.4, 4.7, 4.8],
    quick_values: &[0.5, 2.0, 4.0, 4.7],
    build: |height, _| against_step(true, height as f32),
    seconds: |_| SECONDS,
    judge: |height, _| must(true, true, height),
    quantity: "height missing at the end",
    ..PLAIN
};

const STOPPED: DepthFamily = DepthFamily {
    name: "Step that stops a ball",
    about: "Balls of radius 10 px slide at 60 px/s over ice against a step that is too high to climb at that speed, and \
            must be stopped.",
    values: &[12.0, 9.5, 8.0, 7.0, 6.0, 5.5, 5.2, 5.0, 4.9, 4.84],
    quick_values: &[12.0, 8.0, 6.0, 5.0],
    judge: |height, _| must(true, false, height),
    quantity: "height at the end",
    ..UP
};

const BOXES: DepthFamily = DepthFamily {
    name: "Step that stops a box",
    about: "Boxes slide at 60 px/s into the picture and out of it against a step that gets lower, and must be stopped.",
    values: &[20.0, 10.0, 5.0, 2.0, 1.0, 0.5, 0.2, 0.1, 0.05, 0.02],
    quick_values: &[20.0, 2.0, 0.5, 0.1],
    build: |height, _| against_step(false, height as f32),
    judge: |height, _| must(false, false, height),
    quantity: "height at the end",
    ..UP
};

/// Returns the directions from which objects move to the step: four for balls, into and out of the picture for boxes. Along
/// X a box may tip over the step.
fn directions(is_ball: bool) -> &'static [[f32; 2]] {
    if is_ball { &DIRECTIONS } else { &DIRECTIONS[2..] }
}

fn against_step(is_ball: bool, height: f32) -> DepthScene {
    let directions = directions(is_ball).iter().enumerate();
    directions.fold(scene("step_up"), |scene, (lane, &[x, z])| {
        let start = -HALF - WAY;
        let comer = object(is_ball, lane, [start * x, 0.0, start * z]);
        let speed = SPEED as f32;
        scene.with(comer.with_velocity([speed * x, 0.0, speed * z])).with_platform(platform(
            [2.0 * HALF, height, 2.0 * HALF],
            lane,
            [0.0; 3],
        ))
    })
}

fn must(is_ball: bool, climb: bool, height: f64) -> Box<dyn Watch> {
    let directions = directions(is_ball);
    each(directions.len(), move |time, lane, [x, y, z], _| {
        let [along_x, along_z] = directions[lane].map(f64::from);
        let along = x * along_x + z * along_z;
        if BEFORE.contains(&time) && (along + f64::from(HALF + WAY) - SPEED * time).abs() > 1.0 {
            return Observation::Failed(STUCK, y.abs());
        }
        let is_over = along > -f64::from(HALF);
        match (climb, is_over) {
            (true, true) => Observation::Ends((height - y).abs()),
            (true, false) => Observation::Open(STUCK, (height - y).abs()),
            (false, true) => Observation::Open(CLIMBED, y),
            (false, false) => Observation::Ends(y.abs()),
        }
    })
}

#[cfg(test)]
mod tests {
    use super::super::lanes::RADIUS;
    use super::*;
    use crate::scenes::depth::GRAVITY;

    /// Returns the greatest height in px of a step that a ball can climb. The ball keeps the component of its velocity
    /// along the tangent at the step's edge, and that component must lift the ball.
    fn highest_step() -> f64 {
        let radius = f64::from(RADIUS);
        let is_enough = |height: f64| {
            let speed = SPEED * (1.0 - height / radius);
            speed * speed / 2.0 > f64::from(GRAVITY) * height
        };
        let (mut low, mut high) = (0.0, radius);
        for _ in 0..60 {
            let middle = (low + high) / 2.0;
            if is_enough(middle) { low = middle } else { high = middle }
        }
        low
    }

    #[test]
    fn the_steps_to_climb_are_lower_than_the_ball_can_and_the_others_higher() {
        let highest = highest_step();
        assert!((highest - 4.82).abs() < 0.005, "{highest}");
        assert!(UP.values.iter().all(|&height| height < highest));
        assert!(STOPPED.values.iter().all(|&height| height > highest));
    }
}
