//! Scenes made by programs, shared by tests, benchmarks and charts.
//!
//! Lengths are pixels: boxes of about 20, circles of radius about 10, gravity 150 px/s² downwards, steps of 0.01 s. Sizes and
//! positions vary slightly from one body to the next, so that no two edges coincide exactly (which the default broad phase of
//! the original cannot order, behaviour chapter 08). They vary by a fixed sequence and not by chance: a scene is always and
//! everywhere the same.

use crate::scene::{BodyShape, BodySpec, GeomShape, GeomSpec, Scene};
use farseer_core::math::Vector2;

/// Gravity of the scenes in px/s².
const GRAVITY: f32 = 150.0;
/// Number of edges of a circle's outline.
const EDGES: i32 = 12;

/// A pyramid of boxes on a floor: `base` boxes in the lowest row, one less in each row above, `base * (base +
/// 1) / 2` of them in all (210 for a base of 20).
pub fn pyramid(base: usize) -> Scene {
    const SIZE: f32 = 20.0;
    let mut scene = Scene::empty(&format!("pyramid_of_{base}"), "Pyramid of boxes.");
    scene.tags = vec!["pyramid".to_owned()];
    scene.simulator.gravity = Some(Vector2::new(0.0, GRAVITY));
    let floor_width = (base as f32 + 8.0) * 1.1 * SIZE;
    wall(&mut scene, Vector2::new(0.0, 20.0), floor_width, 40.0);
    for (index, (row, from_centre)) in triangle(base).enumerate() {
        let height = SIZE + 0.05 * vary(index, 1);
        let width = SIZE + 0.5 * vary(index, 2);
        let x = 1.1 * SIZE * from_centre + 0.2 * vary(index, 3);
        // Each row overlaps the one below slightly, so that all touch in the first step.
        let y = -(SIZE - 0.05) * (row as f32 + 0.5);
        let body = add(&mut scene, BodyShape::Rectangle { width, height, mass: 1.0 }, Vector2::new(x, y));
        add_geom(&mut scene, body, GeomShape::Rectangle { width, height }, 0.7, 0.0);
    }
    scene
}

/// Rows of a triangle, the longest first, each with one position less than the one before: the row of every position, and its
/// distance to the right of the middle, in positions.
pub fn triangle(rows: usize) -> impl Iterator<Item = (usize, f32)> {
    (0..rows).flat_map(move |row| {
        let middle = (rows - row - 1) as f32 / 2.0;
        (0..rows - row).map(move |column| (row, column as f32 - middle))
    })
}

/// `count` circles in a grid that fall into a pit of a floor and two walls.
pub fn circles_in_a_pit(count: usize) -> Scene {
    const SPACING: f32 = 24.0;
    let mut scene = Scene::empty(
        &format!("{count}_circles_in_a_pit"),
        "Circles that fall into a pit of three static walls.",
    );
    scene.tags = vec!["pile".to_owned()];
    scene.simulator.gravity = Some(Vector2::new(0.0, GRAVITY));
    let columns = (count as f32).sqrt().ceil().max(1.0) as usize;
    let rows = count.div_ceil(columns);
    let width = SPACING * (columns as f32 + 1.0);
    let height = SPACING * (rows as f32 + 2.0);
    wall(&mut scene, Vector2::new(0.0, 20.0), width + 80.3, 40.0);
    wall(&mut scene, Vector2::new(-width / 2.0 - 20.0, -height / 2.0 - 0.1), 40.1, height);
    wall(&mut scene, Vector2::new(width / 2.0 + 20.0, -height / 2.0 + 0.1), 40.2, height + 0.3);
    for index in 0..count {
        let (row, column) = (index / columns, index % columns);
        let radius = 10.0 + vary(index, 1);
        let x = SPACING * (column as f32 - (columns - 1) as f32 / 2.0) + vary(index, 2);
        let y = -SPACING * (row as f32 + 0.75) + 0.5 * vary(index, 3);
        let body = add(&mut scene, BodyShape::Circle { radius, mass: 1.0 }, Vector2::new(x, y));
        add_geom(&mut scene, body, GeomShape::Circle { radius, edges: EDGES }, 0.5, 0.1);
    }
    scene
}

/// A number between -1 and 1 that differs for every index (up to rounding): multiples of an irrational number, less their
/// integer part.
pub fn vary(index: usize, sequence: u32) -> f32 {
    let step = match sequence {
        1 => 0.618_033_988_749_895,
        2 => 0.754_877_666_246_693,
        _ => 0.569_840_290_998_053,
    };
    (((index + 1) as f64 * step).fract() * 2.0 - 1.0) as f32
}

/// Adds a static rectangle.
fn wall(scene: &mut Scene, position: Vector2, width: f32, height: f32) {
    let body = add(scene, BodyShape::Rectangle { width, height, mass: 1.0 }, position);
    scene.bodies[body].is_static = Some(true);
    add_geom(scene, body, GeomShape::Rectangle { width, height }, 0.5, 0.1);
}

/// Adds a body; returns its index.
fn add(scene: &mut Scene, shape: BodyShape, position: Vector2) -> usize {
    scene.bodies.push(BodySpec { position: Some(position), ..BodySpec::new(shape) });
    scene.bodies.len() - 1
}

fn add_geom(scene: &mut Scene, body: usize, shape: GeomShape, friction: f32, restitution: f32) {
    let mut geom = GeomSpec::new(body, shape);
    geom.settings.friction = Some(friction);
    geom.settings.restitution = Some(restitution);
    scene.geoms.push(geom);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pyramid_of_base_20_has_210_boxes_and_a_floor() {
        let scene = pyramid(20);
        assert_eq!((scene.bodies.len(), scene.geoms.len()), (211, 211));
    }

    #[test]
    fn a_pit_has_three_walls_and_its_circles() {
        let scene = circles_in_a_pit(1000);
        let statics = scene.bodies.iter().filter(|body| body.is_static == Some(true)).count();
        assert_eq!((statics, scene.bodies.len()), (3, 1003));
    }

    #[test]
    fn no_two_boxes_of_a_pyramid_have_the_same_edges() {
        let scene = pyramid(20);
        let mut edges: Vec<u32> = scene.bodies.iter().map(left_edge).collect();
        edges.sort_unstable();
        edges.dedup();
        assert_eq!(edges.len(), scene.bodies.len());
    }

    fn left_edge(body: &BodySpec) -> u32 {
        match (&body.shape, body.position) {
            (BodyShape::Rectangle { width, .. }, Some(position)) => (position.x - width / 2.0).to_bits(),
            other => panic!("{other:?} is not a placed rectangle"),
        }
    }

    #[test]
    fn the_circles_of_a_pit_start_apart() {
        let scene = circles_in_a_pit(200);
        let circles: Vec<(Vector2, f32)> = scene.bodies.iter().filter_map(circle).collect();
        for (index, (place, radius)) in circles.iter().enumerate() {
            for (other, other_radius) in &circles[..index] {
                assert!((place - other).norm() > radius + other_radius);
            }
        }
    }

    fn circle(body: &BodySpec) -> Option<(Vector2, f32)> {
        match body.shape {
            BodyShape::Circle { radius, .. } => Some((body.position?, radius)),
            _ => None,
        }
    }
}
