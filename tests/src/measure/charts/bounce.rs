//! A ball falls on the ground and bounces.

use super::super::closed_forms::apex;
use super::super::error::{Failing, Watch, Worst, in_reach};
use super::super::world::World;
use super::build::{GRAVITY, Surface, ball, ground, scene};
use super::signals::Peaks;
use super::{ChartScene, ONE_SIZE};
use crate::scene::Scene;

/// What the ball falls, in px: for a second.
const HEIGHT: f64 = GRAVITY / 2.0;
const RADIUS: f64 = 16.0;
/// A corner of the polygon points down, so that the ball does not begin to turn.
const EDGES: i32 = 16;
const BALL: usize = 1;
const REACH: f64 = 1e4;

pub(super) fn scenes() -> Vec<ChartScene> {
    let bounce = ChartScene {
        name: "bounce_restitution_1",
        about: "A ball bounces without loss, five times.",
        sizes: ONE_SIZE,
        build: |_| build(1.0),
        seconds: 10.0,
        watch: |_| watch_apexes(1.0, 5),
        error: "error of the height of the bounces",
        unit: "px",
        // A twentieth of the fall: a jump of a ball that a player knows still looks the same.
        tolerance: HEIGHT / 20.0,
        broad_phases_matter: false,
    };
    vec![
        ChartScene {
            name: "bounce_restitution_0",
            about: "A ball falls on the ground and stays there.",
            build: |_| build(0.0),
            seconds: 3.0,
            watch: |_| watch_rest(),
            error: "height above or depth below the ground after the fall",
            // A pixel is seen as resting; more is seen as floating or sunk.
            tolerance: 1.0,
            ..bounce
        },
        ChartScene {
            name: "bounce_restitution_half",
            about: "A ball bounces with half its speed, twice.",
            build: |_| build(0.5),
            seconds: 3.0,
            watch: |_| watch_apexes(0.5, 2),
            ..bounce
        },
        bounce,
        ChartScene {
            name: "bounce_10000_steps",
            about: "A ball bounces without loss for as long as 10,000 steps of 1/60 s take.",
            seconds: 10_000.0 / 60.0,
            watch: |_| watch_energy(),
            error: "gain or loss of height",
            unit: "%",
            // After three minutes of bouncing a game may have a tenth less or more.
            tolerance: 10.0,
            ..bounce
        },
    ]
}

fn build(restitution: f64) -> Scene {
    let mut scene = scene("bounce", "A ball falls on the ground.");
    let surface = Surface { friction: 0.0, restitution };
    ground(&mut scene, 400.0, 0.0, surface);
    ball(&mut scene, RADIUS, 1.0, EDGES, [0.0, -RADIUS - HEIGHT], surface);
    scene
}

/// Height of the ball's lowest point above the ground.
fn height(world: &dyn World) -> f64 {
    -world.body(BALL).position[1] - RADIUS
}

fn watch_apexes(restitution: f64, bounces: i32) -> Box<dyn Watch> {
    let mut peaks = Peaks::default();
    let error = move |_: f64, world: &dyn World| {
        let (bounce, peak) = peaks.take(height(world))?;
        (bounce <= bounces).then(|| (peak - apex(HEIGHT, restitution, bounce)).abs())
    };
    in_reach(Worst::new(error), REACH)
}

fn watch_rest() -> Box<dyn Watch> {
    // The fall takes a second, and landing a step or two.
    let error = |time: f64, world: &dyn World| (time > 1.2).then(|| height(world).abs());
    in_reach(Worst::new(error), REACH)
}

fn watch_energy() -> Box<dyn Watch> {
    let mut peaks = Peaks::default();
    let error = move |_: f64, world: &dyn World| {
        let (_, peak) = peaks.take(height(world))?;
        Some(100.0 * (peak / HEIGHT - 1.0).abs())
    };
    // Energy must never grow. What merely lands a little early or late is an error; twice the height is a failure.
    let verdict = |_: f64, world: &dyn World| (height(world) > 2.0 * HEIGHT).then_some("gained energy");
    Box::new(Failing::new(Worst::new(error), REACH, verdict))
}
