//! Hits of free discs: a row of them, and one that is not met in the middle.

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
/// Between the discs of the cradle, in px. Box2D and rapier take what is nearer than 0.64 px (0.02 m) for touching, and
/// so would pass a hit on through the whole row at once. A hair wider, and hits come one after another.
const GAP: f64 = 1.0;
/// Of the discs of the cradle where they are polygons.
const EDGES: i32 = 16;
const REACH: f64 = 1e4;
/// Of the oblique hit: how far below the path of the first disc the second one lies, and what is lost.
const OFFSET: f64 = 16.0;
const RESTITUTION: f64 = 0.8;
const HEAVY: f64 = 2.0;

const TOUCHING: &str =
    "Four discs lie in a row and touch; a fifth hits the row. Who moves on is not decided by law.";

pub(super) fn scenes() -> Vec<ChartScene> {
    let cradle = ChartScene {
        name: "newtons_cradle",
        about: "Four discs lie in a row, a pixel apart; a fifth hits the row. Only the last one may move on.",
        sizes: &[5],
        build: build_cradle,
        seconds: 1.0,
        watch: watch_who_moves,
        error: "largest error of a velocity",
        unit: "% of the speed of the hit",
        // Those that should rest may creep visibly slower than the one that flies off.
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
        // A tenth of the speed is 6 degrees of direction: a player of billiards would notice twice that.
        tolerance: 10.0,
        ..cradle
    };
    let momentum = ChartScene {
        name: "newtons_cradle_momentum",
        watch: |scene| watch_momentum(scene, SPEED),
        error: "change of momentum",
        unit: "%",
        // It is exact in every sound method; more than rounding is a fault.
        tolerance: 0.1,
        ..cradle
    };
    let energy = ChartScene {
        name: "newtons_cradle_energy",
        watch: |scene| watch_energy(scene, SPEED * SPEED / 2.0),
        error: "error of the energy after the hit",
        unit: "%",
        // A tenth of the energy is a twentieth of the speed.
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

/// Discs apart. Those that are polygons meet with their flat sides: where corners meet, the way they push is luck.
fn build_cradle(count: usize) -> Scene {
    let mut scene = row(count, GAP);
    let half_an_edge = std::f32::consts::PI / EDGES as f32;
    scene.bodies.iter_mut().for_each(|body| body.rotation = Some(half_an_edge));
    scene
}

/// Of discs that touch, more than one way of moving on keeps energy and momentum: they are judged by these alone.
fn build_touching(count: usize) -> Scene {
    row(count, -PRESS)
}

/// A row of discs; the first one starts two discs away and arrives after a third of a second.
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
    // So that it arrives between two steps, whatever the step.
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

/// The largest difference of a velocity to the one it should have, in percent of the speed of the hit.
fn velocity_error(world: &dyn World, law: impl Fn(usize) -> [f64; 2]) -> f64 {
    let off = |index: usize| {
        let (velocity, law) = (world.body(index).velocity, law(index));
        (velocity[0] - law[0]).hypot(velocity[1] - law[1])
    };
    100.0 / SPEED * (0..world.body_count()).map(off).fold(0.0, f64::max)
}

fn watch_who_moves(scene: &Scene) -> Box<dyn Watch> {
    let end = scene.bodies.len() - 1;
    let law = move |index: usize| if index == end { [SPEED, 0.0] } else { [0.0, 0.0] };
    in_reach(last(move |_, world| Some(velocity_error(world, law))), REACH)
}

fn watch_oblique(_: &Scene) -> Box<dyn Watch> {
    let law = velocities_of_oblique();
    in_reach(last(move |_, world| Some(velocity_error(world, |index| law[index]))), REACH)
}

/// Momentum comes from the first body alone, of mass 1.
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
