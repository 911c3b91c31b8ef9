//! Belts slide under boxes that were at rest, and friction carries the boxes.

use super::{DepthChartScene, SIZES};
use crate::scenes::depth::{DepthObject, DepthScene, GRAVITY, Surface};
use crate::watch::{Observation, Watch, watch};
use crate::world::{World, distance};

/// Number of boxes (loads) on one belt.
const LOADS: usize = 5;
/// Mass of a belt divided by that of a load, dimensionless.
const BELT_MASS: f32 = 50.0;
/// Initial speed of a belt, px/s; loads start at rest.
const SPEED: f32 = 60.0;
/// Extent of a belt along X, Y and Z in px.
const BELT: [f32; 3] = [300.0, 20.0, 120.0];
/// Extent of a load along X, Y and Z in px.
const LOAD: [f32; 3] = [24.0, 16.0, 20.0];
/// Distance along X from one load to the next on a belt, px.
const SPACING: f32 = 40.0;
/// Distances from one belt to the next along X and along Z, px.
const PITCH: [f32; 2] = [420.0, 200.0];
/// Friction coefficient of a load. Belts and ground have none, so the mean of load and belt, half of this, acts between
/// them.
const FRICTION: f32 = 0.8;

pub(super) const SCENES: [DepthChartScene; 2] = [ALONG_X, ASKEW];

const ALONG_X: DepthChartScene = DepthChartScene {
    name: "conveyor",
    about: "Belts that slide over ice along X take along five boxes each, by friction, until both have one speed.",
    sizes: SIZES,
    build: |size| conveyor("conveyor", size, [1.0, 0.0]),
    seconds: 3.0,
    watch: |scene| against_closed_form(scene, [1.0, 0.0]),
    error: "largest distance from the closed form",
    unit: "px",
    // Boxes 16 px apart never touch, and an error of 2 px does not look like slip.
    tolerance: 2.0,
    broad_phases_matter: false,
    peers_too: true,
};

const ASKEW: DepthChartScene = DepthChartScene {
    name: "conveyor_askew",
    about: "Belts that slide over ice obliquely, in the direction (0.6, 0, 0.8), take along five boxes each by friction, \
            until both have one speed. Boxes turn about Z alone, as sprites do, which deflects rapier3d's friction from the slip.",
    build: |size| conveyor("conveyor_askew", size, [0.6, 0.8]),
    watch: |scene| against_closed_form(scene, [0.6, 0.8]),
    ..ALONG_X
};

/// Returns a scene of `count` boxes on belts that slide in the direction `direction` (X, Z). In the list of objects each
/// belt is followed by its loads.
fn conveyor(name: &str, count: usize, direction: [f32; 2]) -> DepthScene {
    let belts = count.div_ceil(LOADS);
    let side = (belts as f32).sqrt().ceil() as usize;
    let ice = Surface::default();
    let mut scene = DepthScene::empty(format!("{name}_of_{count}"), 300, ice);
    for index in 0..belts {
        let (row, column) = (index / side, index % side);
        // A shift per row, so that the edges of the belts in a column do not all coincide.
        let x = PITCH[0] * column as f32 + 0.37 * row as f32;
        let z = PITCH[1] * row as f32;
        let velocity = [SPEED * direction[0], 0.0, SPEED * direction[1]];
        let belt = DepthObject::new_box(BELT, [x, 0.0, z]).with_mass(BELT_MASS);
        scene.objects.push(belt.with_velocity(velocity));
        for load in 0..LOADS {
            let from_middle = SPACING * (load as f32 - (LOADS - 1) as f32 / 2.0);
            let rough = Surface { friction: FRICTION, restitution: 0.0 };
            let load = DepthObject::new_box(LOAD, [x + from_middle, BELT[1], z]);
            scene.objects.push(load.with_surface(rough));
        }
    }
    scene
}

/// Returns the distances in px that a belt and a load have moved `time` s after the start. Friction accelerates the loads
/// and slows the belt uniformly until their speeds are equal.
fn ways(time: f64) -> [f64; 2] {
    let speed = f64::from(SPEED);
    let of_load = f64::from(FRICTION) / 2.0 * f64::from(GRAVITY);
    let of_belt = of_load * LOADS as f64 / f64::from(BELT_MASS);
    let sliding = time.min(speed / (of_load + of_belt));
    let common = of_load * sliding;
    let after = common * (time - sliding);
    let belt = speed * sliding - of_belt * sliding * sliding / 2.0;
    [belt + after, of_load * sliding * sliding / 2.0 + after]
}

fn against_closed_form(scene: &DepthScene, direction: [f64; 2]) -> Box<dyn Watch> {
    let starts: Vec<[f64; 3]> = scene.objects.iter().map(|object| object.position.map(f64::from)).collect();
    watch(move |time, world: &dyn World| {
        let [belt, load] = ways(time);
        let seen = |(index, start): (usize, &[f64; 3])| {
            let is_belt = index.is_multiple_of(LOADS + 1);
            let way = if is_belt { belt } else { load };
            let place = [start[0] + way * direction[0], start[1], start[2] + way * direction[1]];
            let is = world.body(index).position;
            let has_fallen = !is_belt && is[1] < f64::from(BELT[1]) / 2.0;
            if has_fallen {
                Observation::Failed("fell off", f64::INFINITY)
            } else {
                Observation::Fine(distance(is, place))
            }
        };
        starts.iter().enumerate().map(seen).reduce(Observation::and)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn momentum_is_shared_in_the_closed_form() {
        let (early, late) = (ways(2.0), ways(3.0));
        let [belt, load] = [late[0] - early[0], late[1] - early[1]];
        // Belt and loads have one speed, and the total momentum is the initial momentum of the belt.
        assert!((belt - load).abs() < 1e-9);
        assert!((belt * 55.0 - 60.0 * 50.0).abs() < 1e-9);
    }

    #[test]
    fn the_closed_form_has_no_jump_when_the_sliding_ends() {
        let end = 60.0 / 44.0;
        let (before, after) = (ways(end - 1e-9), ways(end + 1e-9));
        assert!((0..2).all(|index| (before[index] - after[index]).abs() < 1e-6));
    }
}
