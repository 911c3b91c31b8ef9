//! Somebody is thrown over somebody else.

use super::lanes::{ICE, at, each, largest, scene};
use super::{DepthFamily, PLAIN};
use crate::scenes::depth::{DepthObject, DepthScene, GRAVITY};
use crate::stability::reasons::TOUCHED;
use crate::watch::{Seen, Watch};
use crate::world::BodyState;

/// Along X, along Z, and back.
const WAYS: [[f32; 2]; 4] = [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]];
/// Time in s and place in px, from the start, of the highest point: over the middle of the other.
const TIME: f32 = 1.2;
const WAY: f32 = 100.0;
/// Extent of the one who is thrown, and of the other along X and Z, px.
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
    // It lands after twice the time.
    seconds: |_| 1.9 * f64::from(TIME),
    judge: |_, _| flies_on(),
    quantity: "largest change of speed",
    quantity_unit: "px/s",
    ..PLAIN
};

/// Height of the lowest point of the one who is thrown over the outermost edges of the other.
fn lowest_over_edge() -> f32 {
    let highest = GRAVITY * TIME * TIME / 2.0;
    // From the middle until the one has gone by the other.
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
        // A touch on the upper edge takes some 30 px/s of its fall, one at the side all of its 83 px/s.
        if change > 5.0 { Seen::Failed(TOUCHED, change) } else { Seen::Fine(change) }
    })
}
