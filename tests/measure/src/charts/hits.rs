//! Charts of hits of free discs: a row of discs (a cradle), and an oblique hit of two discs.

use super::super::closed_forms::{after_hit, normal_of_oblique_hit};
use super::super::watch::{Watch, in_reach, last, worst};
use super::super::world::{World, masses};
use super::build::{PRESS, weightless};
use super::invariants::{energy, momentum};
use super::{ChartScene, ONE_SIZE};
use crate::scenes::stage::vector;
use conformance::scene::Scene;

const RADIUS: f64 = 16.0;
const SPEED: f64 = 200.0;
/// Gap between the discs of the cradle, in px. Box2D and rapier treat shapes nearer than 0.64 px (0.02 m) as touching, and
/// would transmit an impact through the row at once. With a slightly wider gap, impacts happen one after another.
const GAP: f64 = 1.0;
/// Number of edges of a disc of the cradle, in engines where discs are polygons.
const EDGES: i32 = 16;
const REACH: f64 = 1e4;
/// `OFFSET`: distance in px of the second disc's centre from the path of the first, in the oblique hit. `RESTITUTION`:
/// coefficient of restitution of that hit. `HEAVY`: mass of the second disc in kg.
const OFFSET: f64 = 16.0;
const RESTITUTION: f64 = 0.8;
const HEAVY: f64 = 2.0;

const TOUCHING: &str =
    "Four discs lie in a row and touch; a fifth hits the row. No impact law decides which discs move on.";

pub(super) fn scenes() -> Vec<ChartScene> {
    let cradle = ChartScene {
        name: "newtons_cradle",
        about: "Four discs lie in a row, a pixel apart; a fifth hits the row. Only the last one may move on.",
        sizes: &[5],
        build: build_cradle,
        seconds: 1.0,
        watch: watch_last_disc_alone,
        error: "largest error of a velocity",
        unit: "% of the speed of the hit",
        // The discs that should rest may creep visibly slower than the one that flies off.
        tolerance: 20.0,
        broad_phases_matter: false,
        peers_too: true,
    };
    let oblique = ChartScene {
        name: "oblique_hit",
        about: "A disc hits one of twice its mass, 30 degrees off its middle.",
        sizes: ONE_SIZE,
        build: |_| build_oblique(),
        watch: watch_oblique,
        error: "largest error of a velocity",
        // A tenth of the speed is 6 degrees of direction: a player of billiards would notice 12 degrees.
        tolerance: 10.0,
        ..cradle
    };
    let momentum = ChartScene {
        name: "newtons_cradle_momentum",
        watch: |scene| watch_momentum(scene, SPEED),
        error: "change of momentum",
        unit: "%",
        // Every sound method conserves momentum exactly, up to rounding.
        tolerance: 0.1,
        ..cradle
    };
    let energy = ChartScene {
        name: "newtons_cradle_energy",
        watch: |scene| watch_energy(scene, SPEED * SPEED / 2.0),
        error: "error of the energy after the hit",
        unit: "%",
        // An error of a tenth of the energy is an error of a twentieth of the speed.
        tolerance: 10.0,
        ..cradle
    };
    vec![
        cradle,
        momentum,
        energy,
        ChartScene {
            name: "newtons_cradle_touching_momentum",
            about: TOUCHING,
            build: build_touching,
            ..momentum
        },
        ChartScene {
            name: "newtons_cradle_touching_energy",
            about: TOUCHING,
            build: build_touching,
            ..energy
        },
        oblique,
        ChartScene {
            name: "oblique_hit_momentum",
            watch: |scene| watch_momentum(scene, SPEED),
            error: "change of momentum",
            unit: "%",
            tolerance: 0.1,
            ..oblique
        },
        ChartScene {
            name: "oblique_hit_energy",
            watch: |scene| watch_energy(scene, oblique_energy()),
            error: "error of the energy after the hit",
            unit: "%",
            tolerance: 10.0,
            ..oblique
        },
    ]
}

/// Returns a row of `count` discs with gaps. Polygons meet with flat sides: if corners met, the direction of the impulse would
/// be chance.
fn build_cradle(count: usize) -> Scene {
    let mut scene = row(count, GAP);
    let half_an_edge = std::f32::consts::PI / EDGES as f32;
    scene.bodies.iter_mut().for_each(|body| body.rotation = Some(half_an_edge));
    scene
}

/// Returns a row of `count` touching discs. Their motion after the hit is not determined by energy and momentum, so the charts
/// compare energy and momentum alone.
fn build_touching(count: usize) -> Scene {
    row(count, -PRESS)
}

/// Returns a row of `count` discs with gaps of `gap` px. The first disc starts two diameters away and hits the row after a
/// third of a second.
fn row(count: usize, gap: f64) -> Scene {
    let mut stage = weightless("newtons_cradle").with_surface(0.0, 1.0);
    for index in 0..count {
        let away = if index == 0 { 4.0 * RADIUS } else { 0.0 };
        let x = index as f64 * (2.0 * RADIUS + gap) - away;
        // Corners of the polygons point along the row.
        stage.disc([x, 0.0], RADIUS, 1.0, EDGES);
    }
    stage.scene_mut().bodies[0].settings.linear_velocity = Some(vector([SPEED, 0.0]));
    stage.done()
}

fn build_oblique() -> Scene {
    let mut stage = weightless("oblique_hit").with_surface(0.0, RESTITUTION);
    // With this start the disc arrives between two steps, for every step length.
    stage.disc([-81.7, 0.0], RADIUS, 1.0, 32);
    stage.disc([0.0, OFFSET], RADIUS, HEAVY, 32);
    stage.scene_mut().bodies[0].settings.linear_velocity = Some(vector([SPEED, 0.0]));
    stage.done()
}

fn velocities_of_oblique() -> [[f64; 2]; 2] {
    let normal = normal_of_oblique_hit(OFFSET, 2.0 * RADIUS);
    after_hit(([SPEED, 0.0], 1.0), ([0.0, 0.0], HEAVY), RESTITUTION, normal)
}

fn oblique_energy() -> f64 {
    let [a, b] = velocities_of_oblique().map(|velocity| velocity[0].powi(2) + velocity[1].powi(2));
    (a + HEAVY * b) / 2.0
}

/// Returns the largest difference of a velocity from the velocity by the closed form `law`, in percent of the speed of the
/// first disc.
fn velocity_error(world: &dyn World, law: impl Fn(usize) -> [f64; 2]) -> f64 {
    let off = |index: usize| {
        let (velocity, law) = (world.body(index).velocity, law(index));
        (velocity[0] - law[0]).hypot(velocity[1] - law[1])
    };
    100.0 / SPEED * (0..world.body_count()).map(off).fold(0.0, f64::max)
}

fn watch_last_disc_alone(scene: &Scene) -> Box<dyn Watch> {
    let end = scene.bodies.len() - 1;
    let law = move |index: usize| if index == end { [SPEED, 0.0] } else { [0.0, 0.0] };
    in_reach(last(move |_, world| Some(velocity_error(world, law))), REACH)
}

fn watch_oblique(_: &Scene) -> Box<dyn Watch> {
    let law = velocities_of_oblique();
    in_reach(last(move |_, world| Some(velocity_error(world, |index| law[index]))), REACH)
}

/// Returns a watch of the error of momentum, relative to the momentum of the first disc (1 kg at `speed` px/s), in percent.
fn watch_momentum(scene: &Scene, speed: f64) -> Box<dyn Watch> {
    let masses = masses(scene);
    let error = move |_: f64, world: &dyn World| {
        let [x, y] = momentum(&masses, world);
        Some(100.0 * (x - speed).hypot(y) / speed)
    };
    in_reach(worst(error), REACH)
}

fn watch_energy(scene: &Scene, after: f64) -> Box<dyn Watch> {
    let masses = masses(scene);
    let error =
        move |_: f64, world: &dyn World| Some(100.0 * (energy(&masses, 0.0, world) / after - 1.0).abs());
    in_reach(last(error), REACH)
}
