//! Bodies that fall into a yard or a silo and form heaps, and a wall of boxes that a heavy box smashes.

use super::{count, fall_speed, ground, limits, yard};
use crate::arena::scene::{Action, Body, Form, Kind, Limits, Scene, Shape};
use std::f32::consts::PI;

pub(super) fn junkyard(size: f32) -> Scene {
    let side = size.sqrt();
    let (half, height) = (count(80, side) as i32, count(50, side));
    let (columns, rows) = (count(200, side), count(40, side));
    let reach = half as f32 + 0.5;
    // The wall moves at up to 12 m/s times `side`.
    let speed = fall_speed(15.0 + rows as f32) + 12.0 * side;
    let mut scene = Scene::empty(800, limits([[-reach, 0.0], [reach, 1000.0]], speed, 0.25));
    scene.add(ground(yard(half, height)));
    let (radius, turn) = (0.25, PI * (5.0_f32.sqrt() - 1.0));
    let corners =
        [0.0, 1.0, 2.0, 3.0, 4.0].map(|i: f32| [radius * (turn * i).cos(), radius * (turn * i).sin()]);
    let mut aside = -0.1;
    for column in 0..columns {
        let x = 1.5 * (2.0 * column as f32 - columns as f32) * radius;
        for row in 0..rows {
            let shape = Shape::new(Form::hull(&corners, 0.0));
            scene.add(Body::dynamic([x + aside, 4.0 * row as f32 * radius + 15.0], vec![shape]));
            aside = -aside;
        }
    }
    let wall = Shape::rectangle([2.0, 4.0], [0.0, 4.0]);
    let wall = scene.add(Body::immovable(Kind::Kinematic, [0.0; 2], vec![wall]));
    let to = move |step: usize| [60.0 * side * (0.2 * step as f32 / 60.0).sin(), 0.0];
    scene.script = Some(Box::new(move |step| vec![Action::Move { body: wall, to: to(step) }]));
    scene
}

pub(super) fn compounds(size: f32) -> Scene {
    let side = size.sqrt();
    // Walls are 1 m thick. Half of the inner width is 39.5 m times `side`; otherwise a small silo would overflow.
    let (half, height) = ((39.5 * side + 0.5).ceil() as i32, count(100, side));
    let (columns, rows) = (count(20, side), count(150, side));
    let reach = half as f32 + 0.5;
    let (pitch, extra) = (2.0, 0.25);
    let speed = fall_speed(5.0 + (pitch + extra) * rows as f32);
    let mut scene = Scene::empty(500, limits([[-reach, 0.0], [reach, 1e6]], speed, 0.25));
    let mut shapes = yard(half, height);
    shapes.push(Shape::new(Form::Chain { points: vec![[-800.0, -80.0], [800.0, -80.0]], is_loop: false }));
    scene.add(ground(shapes));
    let triangle = |corners: [[f32; 2]; 3]| Shape::new(Form::hull(&corners, 0.0)).with_friction(0.5);
    let mut aside = 0.25;
    for column in 0..columns {
        let x = (column as f32 - 0.5 * columns as f32) * pitch + 1.0;
        for row in 0..rows {
            let y = row as f32 * (pitch + extra) + 5.575;
            let left = triangle([[-1.0, 0.0], [0.5, 1.0], [0.0, 2.0]]);
            let right = triangle([[1.0, 0.0], [-0.5, 1.0], [0.0, 2.0]]);
            scene.add(Body::dynamic([x + aside, y], vec![left, right]));
            aside = -aside;
        }
    }
    scene
}

pub(super) fn smash(size: f32) -> Scene {
    let side = size.sqrt();
    let (columns, rows) = (count(120, side), count(80, side));
    // If two bodies collide elastically, the light one flies off at up to twice the speed of the heavy one.
    let limits = Limits { bounds: None, speed: 80.0, overlap: 0.2, gap: 0.0 };
    let mut scene = Scene { gravity: [0.0; 2], ..Scene::empty(300, limits) };
    let ram = Shape::rectangle([4.0 * side; 2], [0.0; 2]).with_density(8.0);
    scene.add(Body { velocity: [40.0, 0.0], ..Body::dynamic([-20.0, 0.0], vec![ram]) });
    let width = 0.4;
    for column in 0..columns {
        for row in 0..rows {
            let place = [column as f32 * width + 30.0, (row as f32 - rows as f32 / 2.0) * width];
            let brick = Body::dynamic(place, vec![Shape::rectangle([0.5 * width; 2], [0.0; 2])]);
            scene.add(Body { is_asleep: true, ..brick });
        }
    }
    scene
}
