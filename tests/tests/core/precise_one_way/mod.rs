//! Geoms that are open but from one side, at 30 to 240 steps per second. Gravity 900 px/s² along y, which is down.

mod edited;
mod moving;
mod shapes;
mod ways;

use conformance::fixtures::plane::{add_box, add_circle, add_floor, body_bits, simulator_with, v};
use farseer_core::math::Vector2;
use farseer_core::shape::Vertices;
use farseer_core::{BodyFactory, BodyId, GeomFactory, GeomId, GeomPlacement, Methods, PhysicsSimulator};

const RATES: [f32; 4] = [30.0, 60.0, 120.0, 240.0];
const GRAVITY: f32 = 900.0;
/// Half of the platform's height in px, and so the height of its top: its middle is the origin.
const HALF: f32 = 10.0;
/// Greatest penetration of a resting body in its support, px.
const REST: f32 = 0.05;
const UP: Vector2 = Vector2::new(0.0, -1.0);

type Adder = fn(&mut PhysicsSimulator, Vector2) -> (BodyId, GeomId);

/// Functions that add each shape, and the height of its origin above its floor.
const THINGS: [(&str, Adder, f32); 5] = [
    ("crate", |simulator, place| add_box(simulator, (20.0, 20.0), place), 10.0),
    ("ball", |simulator, place| add_circle(simulator, 10.0, 12, place), 10.0),
    ("capsule", add_capsule, 20.0),
    // Its centroid is 8 px above the soles of its legs: (60 * 15 + 2 * 10 * 10 * 5) / 80.
    ("table", add_table, 12.5),
    ("figure", add_figure, 30.0),
];

/// A capsule that stands, with locked rotation.
fn add_capsule(simulator: &mut PhysicsSimulator, position: Vector2) -> (BodyId, GeomId) {
    let body = BodyFactory::create_capsule_body_in(simulator, 40.0, 8.0, 1.0).unwrap();
    simulator[body].set_position(position);
    simulator[body].set_moment_of_inertia(f32::MAX).unwrap();
    let placement = GeomPlacement::default();
    let geom = GeomFactory::create_capsule_geom_in(simulator, body, 40.0, 8.0, 6, placement).unwrap();
    (body, geom)
}

/// A plate on two legs, in one concave outline.
fn add_table(simulator: &mut PhysicsSimulator, position: Vector2) -> (BodyId, GeomId) {
    let corners = [(-30, 0), (30, 0), (30, 20), (20, 20), (20, 10), (-20, 10), (-20, 20), (-30, 20)];
    let mut outline: Vertices = corners.into_iter().map(|(x, y)| v(x as f32, y as f32)).collect();
    let body = BodyFactory::create_polygon_body_in(simulator, &outline, 1.0).unwrap();
    simulator[body].set_position(position);
    let placement = GeomPlacement { collision_grid_size: 2.0, ..GeomPlacement::default() };
    let geom = GeomFactory::create_polygon_geom_in(simulator, body, &mut outline, placement).unwrap();
    (body, geom)
}

/// A chest on a foot with a gap between them, in two geoms, that cannot turn: 60 px high.
fn add_figure(simulator: &mut PhysicsSimulator, position: Vector2) -> (BodyId, GeomId) {
    let body = BodyFactory::create_rectangle_body_in(simulator, 20.0, 60.0, 1.0).unwrap();
    simulator[body].set_position(position);
    simulator[body].set_moment_of_inertia(f32::MAX).unwrap();
    let at = |y: f32| GeomPlacement { offset: v(0.0, y), ..GeomPlacement::default() };
    GeomFactory::create_circle_geom_in(simulator, body, 10.0, 12, at(20.0)).unwrap();
    let chest = GeomFactory::create_rectangle_geom_in(simulator, body, 20.0, 35.0, at(-12.5)).unwrap();
    (body, chest)
}

fn empty() -> PhysicsSimulator {
    simulator_with(GRAVITY, Methods::PRECISE)
}

/// A simulator with a platform of 200 x 20 px in its middle.
fn stage() -> (PhysicsSimulator, BodyId, GeomId) {
    let mut simulator = empty();
    let (body, geom) = add_floor(&mut simulator, (200.0, 2.0 * HALF), v(0.0, 0.0));
    simulator.set_one_way(geom, Some(UP)).unwrap();
    (simulator, body, geom)
}

fn run_for(simulator: &mut PhysicsSimulator, seconds: f32, rate: f32) {
    (0..(seconds * rate).round() as usize).for_each(|_| simulator.update(1.0 / rate));
}

fn assert_near(value: f32, expected: f32, tolerance: f32, what: &str) {
    assert!((value - expected).abs() <= tolerance, "{what}: {value} is not {expected}");
}

/// Asserts that a body stands at a height.
fn assert_stands(
    simulator: &PhysicsSimulator,
    body: BodyId,
    (name, height): (&str, f32),
    top: f32,
    rate: f32,
) {
    let what = format!("{name} at {rate} Hz");
    assert_near(simulator[body].position().y, -top - height, REST, &what);
    assert!(simulator[body].linear_velocity().norm() < 0.5, "{what} moves");
}

/// Asserts that a body moves, to the last bit, as without any obstacle, and that no callback is called.
fn assert_flies_free(
    stage: impl Fn() -> PhysicsSimulator,
    add: Adder,
    (place, velocity): (Vector2, Vector2),
    seconds: f32,
) {
    for rate in RATES {
        let (mut with, mut without) = (stage(), empty());
        let [body, alone] = [&mut with, &mut without].map(|simulator| {
            let (body, _) = add(simulator, place);
            simulator[body].set_linear_velocity(velocity);
            body
        });
        for step in 0..(seconds * rate) as usize {
            with.update(1.0 / rate);
            without.update(1.0 / rate);
            assert_eq!(with.arbiter_count(), 0, "step {step} at {rate} Hz");
            let what = format!("{place} {velocity} in step {step} at {rate} Hz");
            assert_eq!(body_bits(&with[body]), body_bits(&without[alone]), "{what}");
        }
    }
}
