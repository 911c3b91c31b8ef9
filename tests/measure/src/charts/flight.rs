//! Charts of thrown bodies without contacts.

use super::super::closed_forms::{SteppedThrow, thrown};
use super::super::watch::{Watch, in_reach, worst};
use super::super::world::{World, distance};
use super::build::{GRAVITY, stage, start};
use super::{ChartScene, ONE_SIZE};
use crate::scenes::stage::vector;
use conformance::scene::Scene;

const SECONDS: f64 = 2.0;
const VELOCITY: [f64; 2] = [200.0, -300.0];
const MASS: f64 = 2.0;
/// Coefficients of linear drag (force per velocity) of the two bodies in kg/s.
const DRAG: [f64; 2] = [0.0, 1.0];

pub(super) fn scenes() -> Vec<ChartScene> {
    let continuous = ChartScene {
        name: "throw_continuous_law",
        about: "Two throws, one with linear drag, against the exact law of motion.",
        sizes: ONE_SIZE,
        build,
        seconds: SECONDS,
        watch: watch_continuous,
        error: "distance from the continuous law",
        unit: "px",
        // 8 px is half the radius of the ball: a throw that was aimed by the exact law still hits.
        tolerance: 8.0,
        broad_phases_matter: false,
        peers_too: true,
    };
    let discrete = ChartScene {
        name: "throw_discrete_law",
        about: "Two throws, one with linear drag, against semi-implicit Euler steps as the original takes them.",
        watch: watch_discrete,
        error: "distance from the discrete law",
        // An engine follows the law exactly, up to rounding, or not at all; a hundredth of a pixel is invisible.
        tolerance: 0.01,
        // Other engines integrate and damp in other ways, and do not follow this law.
        peers_too: false,
        ..continuous
    };
    vec![continuous, discrete]
}

fn build(_: usize) -> Scene {
    let mut stage = stage("throw").with_surface(0.0, 0.0);
    for (index, drag) in DRAG.into_iter().enumerate() {
        // The bodies are so far apart that they do not meet.
        stage.disc([0.0, 1000.0 * index as f64], 16.0, MASS, 12);
        stage.last().settings.linear_velocity = Some(vector(VELOCITY));
        stage.last().settings.linear_drag = Some(drag as f32);
    }
    stage.done()
}

fn watch_continuous(scene: &Scene) -> Box<dyn Watch> {
    let starts = [0, 1].map(|index| start(scene, index));
    let error = move |time: f64, world: &dyn World| {
        let off = |index: usize| {
            let law = thrown(starts[index], VELOCITY, GRAVITY, DRAG[index] / MASS, time);
            distance(world.body(index).position_in_plane(), law)
        };
        Some(off(0).max(off(1)))
    };
    in_reach(worst(error), 1e4)
}

fn watch_discrete(scene: &Scene) -> Box<dyn Watch> {
    let law = |index: usize| SteppedThrow {
        position: start(scene, index),
        velocity: VELOCITY,
        gravity: GRAVITY,
        rate: DRAG[index] / MASS,
    };
    let mut laws = [law(0), law(1)];
    let mut before = 0.0;
    let error = move |time: f64, world: &dyn World| {
        laws.iter_mut().for_each(|law| law.step(time - before));
        before = time;
        let off = |index: usize| distance(world.body(index).position_in_plane(), laws[index].position);
        Some(off(0).max(off(1)))
    };
    in_reach(worst(error), 1e4)
}
