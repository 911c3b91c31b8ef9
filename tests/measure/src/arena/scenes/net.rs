//! A square net of discs on hinges, held at the middle of its upper side.

use super::{count, fall_speed};
use crate::arena::joint::Joint;
use crate::arena::scene::{Body, Form, Kind, Limits, Scene, Shape};

pub(super) fn joint_grid(size: f32) -> Scene {
    let side = count(100, size.sqrt());
    // Greatest gap of a hinge in m: twice that of Box2D, but at least 0.05 m. Box2D's gaps were 0.022 and 0.089 m with 25 and
    // 50 discs along a side, since the hinges of the held discs carry a weight proportional to the square of the side.
    let gap = (7e-5 * (side * side) as f32).max(0.05);
    let limits = Limits { bounds: None, speed: fall_speed(2.0 * side as f32), overlap: 0.0, gap };
    let mut scene = Scene { sleeps: false, ..Scene::empty(500, limits) };
    // Discs do not collide with other discs.
    let disc = || Shape::new(Form::Circle { centre: [0.0; 2], radius: 0.4 }).with_filter(2, !2, 0);
    for column in 0..side {
        for row in 0..side {
            let (x, y) = (column as f32, -(row as f32));
            let is_held = row == 0 && column.abs_diff(side / 2) <= 3;
            let index = scene.add(match is_held {
                true => Body::immovable(Kind::Static, [x, y], vec![disc()]),
                false => Body::dynamic([x, y], vec![disc()]),
            });
            if row > 0 {
                scene.joints.push(Joint::new([index - 1, index], [x, y + 0.5]));
            }
            if column > 0 {
                scene.joints.push(Joint::new([index - side, index], [x - 0.5, y]));
            }
        }
    }
    scene
}
