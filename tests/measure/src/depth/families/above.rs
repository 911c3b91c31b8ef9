//! The family in which a figure is thrown over another figure and must not touch it.

use super::lanes::{ICE, at, each, largest, scene};
use super::{DepthFamily, PLAIN};
use crate::scenes::depth::{DepthObject, DepthScene, GRAVITY};
use crate::stability::reasons::TOUCHED;
use crate::watch::{Observation, Watch};
use crate::world::BodyState;

/// Directions of the throw as components along X and Z (dimensionless): positive X, positive Z, negative X, negative Z.
const WAYS: [[f32; 2]; 4] = [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]];
/// `TIME`: time in s at which the thrown figure is highest. `WAY`: horizontal distance in px that it has then flown; it is
/// over the middle of the other figure.
const TIME: f32 = 1.2;
const WAY: f32 = 100.0;
/// `THROWN`: extent of the thrown figure, px. `OTHER`: extent along X and Z of the figure that stands, px.
const THROWN: f32 = 20.0;
const OTHER: f32 = 30.0;

pub(super) const FAMILIES: [DepthFamily; 1] = [OVER];

const OVER: DepthFamily = DepthFamily {
    name: "Throw over someone",
    about: "Boxes are thrown over others, along X and along Z, and must not touch them: the parabola passes the \
            nearest edge at a distance that gets less.",
    parameter: "distance",
    unit: "px",
    values: &[20.0, 10.0, 5.0, 3.0, 2.0, 1.5, 1.0, 0.5, 0.2, 0.1],
    quick_values: &[20.0, 5.0, 2.0, 0.5],
    build: |value, _| thrown_over(value),
    // The thrown figure lands after 2 * TIME.
    seconds: |_| 1.9 * f64::from(TIME),
    judge: |_, _| flies_on(),
    quantity: "largest change of speed",
    quantity_unit: "px/s",
    ..PLAIN
};

/// Returns the height in px of the thrown figure's lowest point, relative to the start, when it leaves the last edge of the
/// standing figure.
fn lowest_over_edge() -> f32 {
    let highest = GRAVITY * TIME * TIME / 2.0;
    // Time from above the middle of the standing figure until the two figures no longer overlap along the path.
    let time = (THROWN + OTHER) / 2.0 / WAY * TIME;
    highest - GRAVITY * time * time / 2.0
}

fn thrown_over(distance: f64) -> DepthScene {
    let height = lowest_over_edge() - distance as f32;
    let mut scene = scene("throw_over");
    for (lane, [x, z]) in WAYS.into_iter().enumerate() {
        let thrown = DepthObject::new_box([THROWN; 3], at(lane, [-WAY * x, 0.0, -WAY * z]));
        let speed = WAY / TIME;
        scene.objects.push(thrown.with_velocity([speed * x, GRAVITY * TIME, speed * z]).with_surface(ICE));
    }
    (0..WAYS.len()).fold(scene, |scene, lane| {
        scene.with(DepthObject::new_box([OTHER, height, OTHER], at(lane, [0.0; 3])))
    })
}

fn flies_on() -> Box<dyn Watch> {
    each(WAYS.len(), |time, lane, _, state: BodyState| {
        let speed = f64::from(WAY / TIME);
        let [x, z] = WAYS[lane].map(f64::from);
        let up = f64::from(GRAVITY) * (f64::from(TIME) - time);
        let [is_x, is_up, is_z] = state.velocity;
        let change = largest([is_x - speed * x, is_up - up, is_z - speed * z]);
        // A touch of the upper edge changes the vertical speed by some 30 px/s; a touch of the side takes all of the horizontal
        // 83 px/s.
        if change > 5.0 { Observation::Failed(TOUCHED, change) } else { Observation::Fine(change) }
    })
}
