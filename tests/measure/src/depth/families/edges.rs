//! Families in which objects slide off each edge of a platform, and in which objects slide under a platform.

use super::lanes::{REST, STRAIGHT, each, largest, object, platform, scene};
use super::{DepthFamily, PLAIN};
use crate::scenes::depth::DepthScene;
use crate::stability::reasons::{ASIDE, BOUNCED, SANK, STUCK, TOUCHED};
use crate::watch::{Observation, Watch};
use crate::world::BodyState;

pub(super) const FAMILIES: [DepthFamily; 4] = [WALK_OFF, WALK_OFF_LOW, PASS_UNDER, PASS_UNDER_FAST];

/// Directions of motion as components along X and Z (dimensionless): to the right, to the left, into the picture and out of it.
const DIRECTIONS: [[f32; 2]; 4] = [[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0]];
/// Half the extent of a platform along X and along Z, px.
const HALF: [f32; 2] = [100.0, 50.0];
/// Distance along the path from an object's start to the edge of the platform, px.
const WAY: f32 = 40.0;

const WALK_OFF: DepthFamily = DepthFamily {
    name: "Walk off each edge, fast",
    about: "Balls and boxes slide over each of the four edges of a platform 60 px high. They must stay at its height \
            while their middle is over it, and end up on the ground beyond it.",
    parameter: "speed",
    unit: "px/s",
    values: &[10.0, 30.0, 100.0, 300.0, 1e3, 3e3, 1e4],
    quick_values: &[10.0, 100.0, 1e3, 1e4],
    build: |speed, _| walking(speed, 60.0),
    // Time to leave the platform completely, to tip over, and to fall.
    seconds: |speed| 100.0 / speed + 6.0,
    judge: |_, _| walks_off(60.0),
    quantity: "largest distance from the platform's height, or from the ground",
    ..PLAIN
};

const WALK_OFF_LOW: DepthFamily = DepthFamily {
    name: "Walk off each edge, low platform",
    about: "Balls and boxes slide at 50 px/s over each of the four edges of a platform that gets lower, and end up on the \
            ground beyond it.",
    parameter: "height of the platform",
    unit: "px",
    values: &[60.0, 30.0, 10.0, 5.0, 2.0, 1.0, 0.5, 0.2, 0.1],
    quick_values: &[60.0, 10.0, 2.0, 0.5],
    build: |height, _| walking(50.0, height as f32),
    seconds: |_| 8.0,
    judge: |value, _| walks_off(value),
    ..WALK_OFF
};

fn walking(speed: f64, height: f32) -> DepthScene {
    (0..8).fold(scene("walk_off"), |scene, lane| {
        let ([x, z], edge) = (DIRECTIONS[lane % 4], edge_of(lane) - WAY);
        let walker = object(lane < 4, lane, [x * edge, height, z * edge]);
        let speed = speed as f32;
        scene.with(walker.with_velocity([x * speed, 0.0, z * speed])).with_platform(platform(
            [2.0 * HALF[0], height, 2.0 * HALF[1]],
            lane,
            [0.0; 3],
        ))
    })
}

/// Returns the distance in px from the middle of the platform to the edge over which the object of this lane leaves.
fn edge_of(lane: usize) -> f32 {
    if lane % 4 < 2 { HALF[0] } else { HALF[1] }
}

fn walks_off(height: f64) -> Box<dyn Watch> {
    each(8, move |_, lane, [x, y, z], state: BodyState| {
        let [along_x, along_z] = DIRECTIONS[lane % 4].map(f64::from);
        let beyond = x * along_x + z * along_z - f64::from(edge_of(lane));
        let aside = (x * along_z).abs() + (z * along_x).abs();
        let upright = state.angle.abs() < 0.01;
        if beyond < 0.0 && upright && height - y > REST.min(height / 2.0) {
            return Observation::Failed(SANK, height - y);
        }
        if aside > 1.0 {
            return Observation::Failed(ASIDE, aside);
        }
        if y > height + 1.0 {
            return Observation::Open(BOUNCED, y);
        }
        if beyond < 10.0 || y > 2.0 * REST.min(height / 2.0) {
            Observation::Open(STUCK, y.abs())
        } else {
            Observation::Ends(y.abs())
        }
    })
}

/// Directions of motion under a platform, as components along X and Z (dimensionless): along X, along Z, and oblique.
const WAYS_UNDER: [[f32; 2]; 3] = [[1.0, 0.0], [0.0, 1.0], [-0.6, 0.8]];
/// Extent of balls and boxes along Y, px.
const HEIGHT: f32 = 20.0;
/// Distance along the path from an object's start to the middle of the platform that it passes under, px.
const TO_MIDDLE: f32 = 160.0;

const PASS_UNDER: DepthFamily = DepthFamily {
    name: "Pass under",
    about: "Balls and boxes slide at 100 px/s under a platform, along X, along Z and obliquely, and must not be touched.",
    parameter: "gap over the head",
    unit: "px",
    values: &[10.0, 5.0, 2.0, 1.0, 0.5, 0.2, 0.1, 0.05, 0.02, 0.0],
    quick_values: &[10.0, 2.0, 0.5, 0.1, 0.0],
    build: |gap, _| passing(100.0, gap as f32),
    seconds: |_| f64::from(2.0 * TO_MIDDLE) / 100.0,
    judge: |_, _| passes(100.0),
    quantity: "largest displacement aside, up or down",
    ..PLAIN
};

const PASS_UNDER_FAST: DepthFamily = DepthFamily {
    name: "Pass under, fast",
    about: "Balls and boxes slide under a platform 1 px over their heads, along X, along Z and obliquely, and must not be touched.",
    parameter: "speed",
    unit: "px/s",
    values: &[30.0, 100.0, 300.0, 1e3, 3e3, 1e4],
    quick_values: &[100.0, 1e3, 1e4],
    build: |speed, _| passing(speed, 1.0),
    seconds: |speed| f64::from(2.0 * TO_MIDDLE) / speed,
    judge: |value, _| passes(value),
    ..PASS_UNDER
};

fn passing(speed: f64, gap: f32) -> DepthScene {
    (0..6).fold(scene("pass_under"), |scene, lane| {
        let ([x, z], speed) = (WAYS_UNDER[lane % 3], speed as f32);
        let walker = object(lane < 3, lane, [-TO_MIDDLE * x, 0.0, -TO_MIDDLE * z]);
        scene.with(walker.with_velocity([x * speed, 0.0, z * speed])).with_platform(platform(
            [100.0, 30.0, 100.0],
            lane,
            [0.0, HEIGHT + gap, 0.0],
        ))
    })
}

fn passes(speed: f64) -> Box<dyn Watch> {
    each(6, move |_, lane, [x, y, z], state: BodyState| {
        let [along_x, along_z] = WAYS_UNDER[lane % 3].map(f64::from);
        let [change_x, change_z] = [state.velocity[0] - speed * along_x, state.velocity[2] - speed * along_z];
        let aside = x * along_z - z * along_x;
        let wrong = largest([aside, y]);
        if largest([change_x, change_z]) > 1e-3 * speed {
            Observation::Failed(TOUCHED, wrong)
        } else if aside.abs() > STRAIGHT || y.abs() > REST {
            Observation::Failed(ASIDE, wrong)
        } else {
            Observation::Fine(wrong)
        }
    })
}
