//! Tests that `rapier2d` and Box2D simulate a scene with its own parameters. A difference between engines is then a property of
//! the engines, and not an error of the translation.
//!
//! `cargo test -p measure --features peers --test peers_2d`.
//!
//! Both engines divide a step into short ones. Falls and swings have errors of first order in these. Tolerances follow from
//! this, or were measured where a comment says so.

mod assemblies;
mod contacts;
mod joints;
mod limits;
mod motion;
mod sleep;
mod springs;

use conformance::scene::*;
use farseer_core::math::Vector2;
use measure::engines::peers_2d::{box2d_methods, rapier_methods};
use measure::method::{Method, Setting};
use measure::world::World;

/// Gravity, px/s².
const G: f64 = 320.0;
/// Length of a step, s. Each step has `PASSES` substeps.
const STEP: f32 = 1.0 / 240.0;
const PASSES: u32 = 4;

fn peers() -> Vec<Method> {
    rapier_methods().into_iter().chain(box2d_methods()).collect()
}

/// Runs `check` on a scene in each of the two engines.
fn in_both(scene: &Scene, check: impl Fn(&str, &mut dyn World)) {
    for peer in peers() {
        let world = (peer.build)(scene, Setting::fixed(STEP, PASSES));
        let mut world = world.unwrap_or_else(|reason| panic!("{}: {reason}", peer.name));
        check(peer.name, &mut *world);
    }
}

/// Returns the error of each of the two engines for a scene; `None` if the engine accepts it.
fn refusals(scene: &Scene) -> [Option<String>; 2] {
    let [rapier, box2d] = [&rapier_methods()[0], &box2d_methods()[0]]
        .map(|peer| (peer.build)(scene, Setting::fixed(STEP, PASSES)).err());
    [rapier, box2d]
}

fn run(world: &mut dyn World, seconds: f64) {
    for _ in 0..(seconds / f64::from(STEP)).round() as usize {
        world.step(STEP);
    }
}

#[track_caller]
fn near(name: &str, value: f64, expected: f64, tolerance: f64) {
    assert!((value - expected).abs() <= tolerance, "{name}: {value}, not {expected} within {tolerance}");
}

fn weightless() -> Scene {
    Scene::empty("peers", "What a peer makes of it.")
}

fn scene() -> Scene {
    let mut scene = weightless();
    scene.simulator.gravity = Some(Vector2::new(0.0, G as f32));
    scene
}

/// Adds a body without drag to a scene, at a position in px. Returns its index.
fn body(scene: &mut Scene, shape: BodyShape, position: [f32; 2]) -> usize {
    let settings =
        BodySettings { linear_drag: Some(0.0), rotational_drag: Some(0.0), ..BodySettings::default() };
    let position = Some(Vector2::from(position));
    scene.bodies.push(BodySpec { position, settings, ..BodySpec::new(shape) });
    scene.bodies.len() - 1
}

fn disc(scene: &mut Scene, position: [f32; 2]) -> usize {
    body(scene, BodyShape::Circle { radius: 16.0, mass: 2.0 }, position)
}

fn settings(scene: &mut Scene) -> &mut BodySettings {
    &mut scene.bodies.last_mut().expect("a body was added").settings
}

fn geom(scene: &mut Scene, shape: GeomShape, friction: f32, restitution: f32) -> &mut GeomSpec {
    let mut geom = GeomSpec::new(scene.bodies.len() - 1, shape);
    geom.settings.friction = Some(friction);
    geom.settings.restitution = Some(restitution);
    scene.geoms.push(geom);
    scene.geoms.last_mut().expect("it was just added")
}

/// Adds a floor to a scene, whose surface is at y = 0. Returns the index of its body.
fn floor(scene: &mut Scene, friction: f32, restitution: f32) -> usize {
    let (width, height) = (2000.0, 64.0);
    let index = body(scene, BodyShape::Rectangle { width, height, mass: 1.0 }, [0.0, 32.0]);
    scene.bodies[index].is_static = Some(true);
    geom(scene, GeomShape::Rectangle { width, height }, friction, restitution);
    index
}

fn joint(scene: &mut Scene, kind: JointKind) -> &mut JointSpec {
    scene.joints.push(JointSpec { kind, settings: JointSettings::default(), in_simulation: true });
    scene.joints.last_mut().expect("it was just added")
}

fn spring(
    scene: &mut Scene,
    kind: SpringKind,
    spring_constant: f32,
    damping_constant: f32,
) -> &mut SpringSpec {
    let settings = SpringSettings::default();
    scene.springs.push(SpringSpec { kind, spring_constant, damping_constant, settings, in_simulation: true });
    scene.springs.last_mut().expect("it was just added")
}

fn at(x: f32, y: f32) -> Vector2 {
    Vector2::new(x, y)
}

/// Returns the mean period, in s, with which `measure` oscillates about 0, by its upward zero crossings in a run of `seconds`.
fn period(world: &mut dyn World, seconds: f64, measure: impl Fn(&dyn World) -> f64) -> f64 {
    let mut crossings = Vec::new();
    let mut before = measure(world);
    for step in 0..(seconds / f64::from(STEP)) as usize {
        world.step(STEP);
        let now = measure(world);
        if before < 0.0 && now >= 0.0 {
            crossings.push((step as f64 + before / (before - now)) * f64::from(STEP));
        }
        before = now;
    }
    assert!(crossings.len() > 2, "it swung {} times", crossings.len());
    (crossings[crossings.len() - 1] - crossings[0]) / (crossings.len() - 1) as f64
}
