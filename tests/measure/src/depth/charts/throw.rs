//! A ball is thrown up, to the right and into the picture.

use super::DepthChartScene;
use crate::scenes::depth::{DepthScene, GRAVITY, throw_in_x_and_z};
use crate::watch::{Seen, Watch, watch};
use crate::world::{World, distance};

/// The ball lands where it started, in Y, after this time in s: 2 v / g.
const LANDING: f64 = 2.0;

pub(super) const SCENES: [DepthChartScene; 3] = [FLIGHT, STEPPED, LANDED];

const FLIGHT: DepthChartScene = DepthChartScene {
    name: "throw_in_depth",
    about: "A ball is thrown up, to the right and into the picture; its flight against the parabola.",
    sizes: &[0],
    build: |_| throw_in_x_and_z(),
    // The rest of the way is through the contact with the ground.
    seconds: 0.95 * LANDING,
    watch: |scene| against(scene, 0.0),
    error: "largest distance from the parabola",
    unit: "px",
    // A throw that aims at something 20 px wide still meets it.
    tolerance: 2.0,
    broad_phases_matter: false,
    peers_too: true,
};

const STEPPED: DepthChartScene = DepthChartScene {
    name: "throw_in_depth_stepped",
    about: "A ball is thrown up, to the right and into the picture; its flight against the law of the steps: in each, velocity changes first and moves the ball then.",
    watch: against_steps,
    error: "largest distance from the law of the steps",
    // Rounding, and no more.
    tolerance: 0.01,
    peers_too: false,
    ..FLIGHT
};

const LANDED: DepthChartScene = DepthChartScene {
    name: "throw_in_depth_landing",
    about: "A ball is thrown up, to the right and into the picture; it lands after 2 s without a bounce and rolls on with two thirds of its speed.",
    seconds: 2.0 * LANDING,
    watch: |scene| against(scene, 1.75 * LANDING),
    error: "distance from where it rolls",
    tolerance: 2.0,
    ..FLIGHT
};

/// The distance of the first object from its closed form, from a time in s on.
fn against(scene: &DepthScene, from: f64) -> Box<dyn Watch> {
    let thrown = &scene.objects[0];
    let (start, velocity) = (thrown.position.map(f64::from), thrown.velocity.map(f64::from));
    watch(move |time, world: &dyn World| {
        let place = place(start, velocity, time);
        let is = world.body(0).position;
        (time >= from).then(|| Seen::Fine(distance(is, place)))
    })
}

/// The distance of the first object from where steps of the lengths that were made bring it.
fn against_steps(scene: &DepthScene) -> Box<dyn Watch> {
    let thrown = &scene.objects[0];
    let (mut place, mut velocity) = (thrown.position.map(f64::from), thrown.velocity.map(f64::from));
    let mut last = 0.0;
    watch(move |time, world: &dyn World| {
        let dt = time - last;
        last = time;
        velocity[1] -= f64::from(GRAVITY) * dt;
        for (place, velocity) in place.iter_mut().zip(velocity) {
            *place += velocity * dt;
        }
        Some(Seen::Fine(distance(world.body(0).position, place)))
    })
}

/// Where the ball is: it flies, and rolls at once when it lands, since the ground holds it fast enough. A rolling
/// disc has two thirds of the speed that it slid with.
fn place(start: [f64; 3], velocity: [f64; 3], time: f64) -> [f64; 3] {
    let flight = time.min(LANDING);
    let along = flight + 2.0 / 3.0 * (time - flight);
    let height = velocity[1] * flight - 0.5 * f64::from(GRAVITY) * flight * flight;
    [start[0] + velocity[0] * along, start[1] + height, start[2] + velocity[2] * along]
}
