//! A chart's scene: a ball is thrown up, to the right and into the picture.

use super::DepthChartScene;
use crate::scenes::depth::{DepthScene, GRAVITY, throw_in_x_and_z};
use crate::watch::{Observation, Watch, watch};
use crate::world::{World, distance};

/// Time in s after which the ball is back at the height of its start: 2 v / g, with v the upward speed.
const LANDING: f64 = 2.0;

pub(super) const SCENES: [DepthChartScene; 3] = [FLIGHT, STEPPED, LANDED];

const FLIGHT: DepthChartScene = DepthChartScene {
    name: "throw_in_depth",
    about: "A ball is thrown up, to the right and into the picture; its flight against the parabola.",
    sizes: &[0],
    build: |_| throw_in_x_and_z(),
    // The last twentieth of the flight is left out, so that the contact with the ground has no effect.
    seconds: 0.95 * LANDING,
    watch: |scene| against(scene, 0.0),
    error: "largest distance from the parabola",
    unit: "px",
    // A throw at a target 20 px wide still hits it.
    tolerance: 2.0,
    broad_phases_matter: false,
    peers_too: true,
};

const STEPPED: DepthChartScene = DepthChartScene {
    name: "throw_in_depth_stepped",
    about: "A ball is thrown up, to the right and into the picture; its flight against the discrete law: semi-implicit Euler steps.",
    watch: against_steps,
    error: "largest distance from the discrete law",
    // The error is that of rounding alone.
    tolerance: 0.01,
    peers_too: false,
    ..FLIGHT
};

const LANDED: DepthChartScene = DepthChartScene {
    name: "throw_in_depth_landing",
    about: "A ball is thrown up, to the right and into the picture; it lands after 2 s without a bounce and rolls on with two thirds of its speed.",
    seconds: 2.0 * LANDING,
    watch: |scene| against(scene, 1.75 * LANDING),
    error: "distance from its expected rolling position",
    tolerance: 2.0,
    ..FLIGHT
};

/// Returns a watch of the distance in px of the first object from its path by the closed form (`place`), from the time
/// `from` in s on.
fn against(scene: &DepthScene, from: f64) -> Box<dyn Watch> {
    let thrown = &scene.objects[0];
    let (start, velocity) = (thrown.position.map(f64::from), thrown.velocity.map(f64::from));
    watch(move |time, world: &dyn World| {
        let place = place(start, velocity, time);
        let is = world.body(0).position;
        (time >= from).then(|| Observation::Fine(distance(is, place)))
    })
}

/// Returns a watch of the distance in px of the first object from the path that semi-implicit Euler steps give, with the
/// step lengths of the run.
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
        Some(Observation::Fine(distance(world.body(0).position, place)))
    })
}

/// Returns the position of the ball in px (X, Y, Z) at `time` s by the closed form. It flies for `LANDING` s, then rolls:
/// friction turns sliding into rolling at the landing. A rolling disc has two thirds of the speed with which it slid.
fn place(start: [f64; 3], velocity: [f64; 3], time: f64) -> [f64; 3] {
    let flight = time.min(LANDING);
    let along = flight + 2.0 / 3.0 * (time - flight);
    let height = velocity[1] * flight - 0.5 * f64::from(GRAVITY) * flight * flight;
    [start[0] + velocity[0] * along, start[1] + height, start[2] + velocity[2] * along]
}
