//! Pyramids of square boxes with sides of 1 m.

use super::{count, fall_speed, ground, limits};
use crate::arena::scene::{Body, Form, Kind, Scene, Shape};

/// Half of the side of a box, in metres.
const HALF: f32 = 0.5;

/// Adds a pyramid of boxes with `base` boxes in the lowest row; `left` and `bottom` are the x and y in m of its lower left
/// corner.
fn pyramid(scene: &mut Scene, base: usize, [left, bottom]: [f32; 2]) {
    for row in 0..base {
        for place in row..base {
            let x = left + HALF * (row as f32 + 1.0) + 2.0 * HALF * (place - row) as f32;
            let y = bottom + HALF * (2.0 * row as f32 + 1.0);
            scene.add(Body::dynamic([x, y], vec![Shape::rectangle([HALF; 2], [0.0; 2])]));
        }
    }
}

pub(super) fn large(size: f32) -> Scene {
    let side = size.sqrt();
    let base = count(100, side);
    let (width, height) = (100.0 * side.max(1.0), base as f32);
    let bounds = [[-width, 0.0], [width, 2.0 * height]];
    let mut scene = Scene { sleeps: false, ..Scene::empty(500, limits(bounds, fall_speed(height), 0.1)) };
    let floor = Shape::rectangle([width, 1.0], [0.0; 2]);
    scene.add(Body::immovable(Kind::Static, [0.0, -1.0], vec![floor]));
    pyramid(&mut scene, base, [-HALF * base as f32, 0.0]);
    scene
}

pub(super) fn many(size: f32) -> Scene {
    let (base, rows) = (10, count(20, size.sqrt()));
    let pitch = 2.0 * HALF * (base as f32 + 1.0);
    let width = rows as f32 * pitch;
    let bounds = [[-width, 0.0], [width, rows as f32 * pitch]];
    let mut scene = Scene { sleeps: false, ..Scene::empty(200, limits(bounds, fall_speed(pitch), 0.1)) };
    let shelf = |row: usize| {
        let y = row as f32 * pitch;
        Shape::new(Form::Chain { points: vec![[-0.5 * width, y], [0.5 * width, y]], is_loop: false })
    };
    scene.add(ground((0..rows).map(shelf).collect()));
    for row in 0..rows {
        for column in 0..rows {
            let left = -0.5 * width + column as f32 * pitch + HALF;
            pyramid(&mut scene, base, [left, row as f32 * pitch]);
        }
    }
    scene
}
