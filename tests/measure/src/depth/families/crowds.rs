//! From one object to ten thousand.

use super::lanes::largest;
use super::{DepthFamily, PLAIN};
use crate::scenes::depth::{DepthPlatform, DepthScene, DepthShape, GRAVITY, traffic};
use crate::stability::reasons::{BLEW_UP, LEFT, SANK};
use crate::watch::{Seen, Watch, watch};
use crate::world::World;

/// Objects from which on a run is short.
const MANY: f64 = 1000.0;

pub(super) const FAMILIES: [DepthFamily; 1] = [TRAFFIC];

const TRAFFIC: DepthFamily = DepthFamily {
    name: "Crowd",
    about: "Balls, boxes and polygons move around on a field with platforms and walls and keep meeting each other. Nothing \
            may sink into the ground, leave the field or become faster than anything there could make it.",
    parameter: "number of objects",
    unit: "",
    values: &[1.0, 5.0, 20.0, 200.0, 1e3, 2e3, 1e4],
    quick_values: &[1.0, 20.0, 200.0, 1e3],
    build: |count, _| crowd(count as usize),
    // All have landed after 2 s.
    seconds: |count| if count < MANY { 6.0 } else { 2.0 },
    judge: |value, _| all_stay(value),
    quantity: "largest depth in the ground",
    ..PLAIN
};

/// Traffic with platforms as its walls: they are the same for all methods.
fn crowd(count: usize) -> DepthScene {
    let mut scene = traffic(count);
    for wall in scene.objects.split_off(count) {
        if let DepthShape::Box { size } = wall.shape {
            scene.platforms.push(DepthPlatform::new(size, wall.position, wall.surface));
        }
    }
    scene
}

/// Thickness of the walls, px.
const WALL: f64 = 60.0;

fn all_stay(count: f64) -> Box<dyn Watch> {
    let count = count as usize;
    let scene = traffic(count);
    let wall = f64::from(scene.objects[count + 1].position[0]) - WALL / 2.0;
    // The fastest falls 140 px and goes at 90 px/s along X and Z. A heavier one may pass on a little more.
    let fastest = 1.5 * (2.0 * f64::from(GRAVITY) * 140.0 + 2.0 * 90.0_f64.powi(2)).sqrt();
    // Of the smallest objects, whose radius is 8 px: beyond this their middle is outside.
    let deepest = 8.0;
    watch(move |_, world: &dyn World| {
        let mut lowest = 0.0_f64;
        for index in 0..count {
            let state = world.body(index);
            let [x, y, z] = state.position;
            lowest = lowest.min(y);
            if largest([x, z]) > wall {
                return Some(Seen::Failed(LEFT, -lowest));
            }
            if y < -deepest {
                return Some(Seen::Failed(SANK, -lowest));
            }
            if state.speed() > fastest {
                return Some(Seen::Failed(BLEW_UP, -lowest));
            }
        }
        Some(Seen::Fine(-lowest))
    })
}
