//! Belts slide under boxes that were at rest, and friction takes the boxes along.

use super::{DepthChartScene, SIZES};
use crate::scenes::depth::{DepthObject, DepthScene, GRAVITY, Surface};
use crate::watch::{Seen, Watch, watch};
use crate::world::{World, distance};

/// Boxes on a belt.
const LOADS: usize = 5;
/// Of a belt, in the mass of a load.
const BELT_MASS: f32 = 50.0;
/// Of a belt at first, px/s.
const SPEED: f32 = 60.0;
/// Extent of a belt along X, Y and Z in px.
const BELT: [f32; 3] = [300.0, 20.0, 120.0];
/// Of a load.
const LOAD: [f32; 3] = [24.0, 16.0, 20.0];
/// From one load of a belt to the next, px.
const SPACING: f32 = 40.0;
/// From one belt to the next along X and Z, px.
const PITCH: [f32; 2] = [420.0, 200.0];
/// Of a load; the belts and the ground are ice, and the mean counts.
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
    // Boxes 16 px apart never touch, and a sprite that is off by this is not seen to slip.
    tolerance: 2.0,
    broad_phases_matter: false,
    peers_too: true,
};

const ASKEW: DepthChartScene = DepthChartScene {
    name: "conveyor_askew",
    about: "Belts that slide over ice, 0.6 of the way along X and 0.8 into the picture, take along five boxes each by \
            friction, until both have one speed. Boxes turn about Z alone, as sprites do, which turns rapier3d's friction aside from the slip.",
    build: |size| conveyor("conveyor_askew", size, [0.6, 0.8]),
    watch: |scene| against_closed_form(scene, [0.6, 0.8]),
    ..ALONG_X
};

/// `count` boxes on belts. Each belt is followed by its loads.
fn conveyor(name: &str, count: usize, direction: [f32; 2]) -> DepthScene {
    let belts = count.div_ceil(LOADS);
    let side = (belts as f32).sqrt().ceil() as usize;
    let ice = Surface::default();
    let mut scene = DepthScene::empty(format!("{name}_of_{count}"), 300, ice);
    for index in 0..belts {
        let (row, column) = (index / side, index % side);
        // Not all edges of a column at one place.
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

/// How far a belt and its loads have come after a time in s. Friction speeds the loads up and the belt down evenly
/// until they have one speed.
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
            if has_fallen { Seen::Failed("fell off", f64::INFINITY) } else { Seen::Fine(distance(is, place)) }
        };
        starts.iter().enumerate().map(seen).reduce(Seen::and)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn momentum_is_shared_in_the_closed_form() {
        let (early, late) = (ways(2.0), ways(3.0));
        let [belt, load] = [late[0] - early[0], late[1] - early[1]];
        // Both go at one speed, and the momentum is that of the belt at first.
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
