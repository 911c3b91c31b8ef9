//! Large worlds: a pile that falls, stacks that fall asleep, and static tiles.

use super::{count, fall_speed, ground, limits};
use crate::arena::scene::{Body, Form, Kind, Scene, Shape};

/// Number of bodies at size 1.
const BODIES: usize = 100_000;
/// Number of bodies above each other in the pile.
const ROWS: usize = 40;
/// Number of boxes of a stack.
const STOREYS: usize = 10;

/// Returns a static floor with two walls; `half` and `height` are half the inner width and the height of the walls in m.
fn bin(half: f32, height: f32) -> Body {
    ground(vec![
        Shape::rectangle([half + 2.0, 1.0], [0.0, -1.0]),
        Shape::rectangle([1.0, 0.5 * height], [-half - 1.0, 0.5 * height]),
        Shape::rectangle([1.0, 0.5 * height], [half + 1.0, 0.5 * height]),
    ])
}

pub(super) fn pile(size: f32) -> Scene {
    let bodies = count(BODIES, size);
    let columns = bodies.div_ceil(ROWS);
    let half = 0.25 * columns as f32 + 1.0;
    let mut scene =
        Scene::empty(300, limits([[-half, 0.0], [half, 1e3]], fall_speed(0.55 * ROWS as f32), 0.1));
    scene.add(bin(half, 60.0));
    for index in 0..bodies {
        let (column, row) = (index / ROWS, index % ROWS);
        let x = 0.5 * (column as f32 - 0.5 * columns as f32) + if row % 2 == 0 { 0.05 } else { -0.05 };
        let form = match (7 * index + row) % 3 {
            0 => Form::Capsule { ends: [[-0.1, 0.0], [0.1, 0.0]], radius: 0.15 },
            1 => Form::Circle { centre: [0.0; 2], radius: 0.2 },
            _ => Form::Box { half: [0.2; 2], centre: [0.0; 2] },
        };
        scene.add(Body::dynamic([x, 0.5 + 0.55 * row as f32], vec![Shape::new(form)]));
    }
    scene
}

pub(super) fn stacks(size: f32) -> Scene {
    let stacks = count(BODIES / STOREYS, size);
    let half = 0.5 * stacks as f32 + 2.0;
    let mut scene = Scene::empty(300, limits([[-half, 0.0], [half, 10.0]], 1.0, 0.02));
    scene.add(bin(half, 1.0));
    for stack in 0..stacks {
        let x = stack as f32 - 0.5 * stacks as f32;
        for row in 0..STOREYS {
            let place = [x, 0.2 + 0.4 * row as f32];
            scene.add(Body::dynamic(place, vec![Shape::rectangle([0.2; 2], [0.0; 2])]));
        }
    }
    scene
}

pub(super) fn tiles(size: f32) -> Scene {
    let (tiles, rows) = (count(BODIES, size), 50);
    let mut scene = Scene::empty(100, limits([[-1e6; 2], [1e6; 2]], 100.0, 0.1));
    for index in 0..tiles {
        let place = [(index / rows) as f32, 3.0 * (index % rows) as f32];
        scene.add(Body::immovable(Kind::Static, place, vec![Shape::rectangle([0.25; 2], [0.0; 2])]));
    }
    scene
}
