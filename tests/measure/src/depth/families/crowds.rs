//! The family "crowd": traffic of 1 to 10,000 objects, none of which may leave the field.

use super::lanes::largest;
use super::{DepthFamily, PLAIN};
use crate::scenes::depth::{DepthPlatform, DepthScene, DepthShape, GRAVITY, traffic};
use crate::stability::reasons::{BLEW_UP, LEFT, SANK};
use crate::watch::{Observation, Watch, watch};
use crate::world::World;

/// Number of objects from which on a run is short (2 s instead of 6 s).
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
    // All objects have landed after 2 s.
    seconds: |count| if count < MANY { 6.0 } else { 2.0 },
    judge: |value, _| all_stay(value),
    quantity: "largest depth in the ground",
    ..PLAIN
};

/// Returns the scene [`traffic`](crate::scenes::depth::traffic) with platforms as walls: platforms are equal for all
/// methods.
fn crowd(count: usize) -> DepthScene {
    let mut scene = traffic(count);
    for wall in scene.objects.split_off(count) {
        if let DepthShape::Box { size } = wall.shape {
            scene.platforms.push(DepthPlatform::new(size, wall.position, wall.surface));
        }
    }
    scene
}

/// Thickness of the walls around the field, px.
const WALL: f64 = 60.0;

fn all_stay(count: f64) -> Box<dyn Watch> {
    let count = count as usize;
    let scene = traffic(count);
    let wall = f64::from(scene.objects[count + 1].position[0]) - WALL / 2.0;
    // The fastest object falls 140 px and moves at 90 px/s along X and Z. The factor 1.5 allows for speed passed on by a
    // heavier object.
    let fastest = 1.5 * (2.0 * f64::from(GRAVITY) * 140.0 + 2.0 * 90.0_f64.powi(2)).sqrt();
    // Radius of the smallest objects, 8 px: an object that has sunk deeper has its centre below the ground.
    let deepest = 8.0;
    watch(move |_, world: &dyn World| {
        let mut lowest = 0.0_f64;
        for index in 0..count {
            let state = world.body(index);
            let [x, y, z] = state.position;
            lowest = lowest.min(y);
            if largest([x, z]) > wall {
                return Some(Observation::Failed(LEFT, -lowest));
            }
            if y < -deepest {
                return Some(Observation::Failed(SANK, -lowest));
            }
            if state.speed() > fastest {
                return Some(Observation::Failed(BLEW_UP, -lowest));
            }
        }
        Some(Observation::Fine(-lowest))
    })
}
