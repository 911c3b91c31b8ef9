//! Drums that turn, and a room in which a blade turns.

use super::{count, fall_speed, ground, limits};
use crate::arena::joint::Joint;
use crate::arena::scene::{Body, Form, Kind, Limits, Point, Scene, Shape};
use std::f32::consts::{PI, TAU};

/// Angular velocity of drums in rad/s: 25 degrees per s.
const SPIN: f32 = PI / 180.0 * 25.0;
/// Centre of a drum in m.
const MIDDLE: Point = [0.0, 10.0];

/// Adds `count` x `count` square boxes around [`MIDDLE`]. `half` is half of a box's side in m. The first box lies `left *
/// count` m from the middle along x and y (`left` < 0); neighbours are `pitch` m apart, measured from centre to centre.
fn fill(scene: &mut Scene, count: usize, half: f32, [left, pitch]: [f32; 2]) {
    let from_left = |place: usize| left * count as f32 + pitch * place as f32;
    for row in 0..count {
        for column in 0..count {
            let place = [MIDDLE[0] + from_left(column), MIDDLE[1] + from_left(row)];
            scene.add(Body::dynamic(place, vec![Shape::rectangle([half; 2], [0.0; 2])]));
        }
    }
}

/// Returns the lowest and highest corner in m of a square around [`MIDDLE`] that reaches `reach` m in each direction.
fn about_middle(reach: f32) -> [Point; 2] {
    [MIDDLE.map(|v| v - reach), MIDDLE.map(|v| v + reach)]
}

pub(super) fn tumbler(size: f32) -> Scene {
    let side = size.sqrt();
    let count = count(45, side);
    // Half of the outer width in m. Walls are 1 m thick. The inner width is 19 m times `side`, or more if the boxes need it.
    let half = (9.5 * side).max(0.2 * count as f32 + 0.2) + 0.5;
    // Speed of a fall across the drum plus the speed of the corners, which are less than `1.5 * half` from the middle.
    let speed = fall_speed(3.0 * half) + 1.5 * half * SPIN;
    let limits = Limits { gap: 0.05, ..limits(about_middle(1.5 * half), speed, 0.125) };
    let mut scene = Scene::empty(750, limits);
    let held = scene.add(ground(Vec::new()));
    let wall = |half: Point, at: Point| Shape::rectangle(half, at).with_density(50.0);
    let walls = vec![
        wall([0.5, half], [half, 0.0]),
        wall([0.5, half], [-half, 0.0]),
        wall([half, 0.5], [0.0, half]),
        wall([half, 0.5], [0.0, -half]),
    ];
    let drum = scene.add(Body::dynamic(MIDDLE, walls));
    // The torque that turns a drum is proportional to weight times width, and so to the cube of `side`.
    let torque = 1e8 * side.max(1.0).powi(3);
    scene.joints.push(Joint { motor: Some([SPIN, torque]), ..Joint::new([held, drum], MIDDLE) });
    fill(&mut scene, count, 0.125, [-0.2, 0.4]);
    scene
}

pub(super) fn washer(size: f32) -> Scene {
    let side = size.sqrt();
    let reach = 18.0 * side;
    let speed = fall_speed(2.0 * reach) + reach * SPIN;
    let mut scene = Scene::empty(500, limits(about_middle(reach + 1.0), speed, 0.15));
    // With fewer plates the drum would not contain the corners of the square of boxes.
    let plates = count(36, side).max(9);
    let step = TAU / plates as f32;
    let at = |radius: f32, angle: f32| [radius * angle.cos(), radius * angle.sin()];
    // A plate between two radii (m, multiplied by `side`) and two angles (rad).
    let plate = |[inner, outer]: [f32; 2], [from, to]: [f32; 2]| {
        let [inner, outer] = [inner, outer].map(|radius| radius * side);
        Shape::new(Form::hull(&[at(inner, from), at(outer, from), at(inner, to), at(outer, to)], 0.0))
    };
    let mut shapes = Vec::new();
    for index in 0..plates {
        let [from, to] = [index, index + 1].map(|index| step * index as f32);
        shapes.push(plate([16.0, 18.0], [from - 0.1 * step, to + 0.1 * step]));
        if index % 9 == 0 {
            shapes.push(plate([14.0, 16.0], [from, to]));
        }
    }
    scene.add(Body {
        spin: SPIN,
        velocity: [0.001, -0.002],
        ..Body::immovable(Kind::Kinematic, MIDDLE, shapes)
    });
    fill(&mut scene, count(90, side), 0.1, [-0.11, 0.21]);
    scene
}

pub(super) fn spinner(size: f32) -> Scene {
    let side = size.sqrt();
    let (radius, corners) = (40.0 * side, count(360, side));
    let bounds = [[-radius - 1.0, -8.0 * side - 1.0], [radius + 1.0, 72.0 * side + 1.0]];
    // Angular velocity of the blade in rad/s, and distance in m from its middle to its tip.
    let (spin, arm) = (5.0, 20.2 * side);
    let speed = fall_speed(2.0 * radius) + 2.0 * spin * arm;
    // A blade of unlimited torque crushes bodies against the room, so overlaps reach the width of a body, 0.7 m.
    let limits = Limits { gap: 0.05, ..limits(bounds, speed, 0.7) };
    let mut scene = Scene { takes_lesser_friction: true, ..Scene::empty(500, limits) };
    let corner = |index: usize| {
        let angle = TAU * index as f32 / corners as f32;
        [radius * angle.cos(), radius * angle.sin() + 32.0 * side]
    };
    // Box2D takes the greater restitution, that of the bodies (0.1). The mean is the same if all shapes have 0.1 in our engine.
    let bouncing = |mut shape: Shape, restitution: f32| {
        (shape.surface[1], shape.mean_surface[1]) = (restitution, 0.1);
        shape
    };
    let room = Shape::new(Form::Chain { points: (0..corners).map(corner).collect(), is_loop: true });
    let room = scene.add(ground(vec![bouncing(room.with_friction(0.1), 0.0)]));
    let middle = [0.0, 12.0 * side];
    let [x, y] = [0.4, 20.0 * side];
    let blade = Shape::new(Form::hull(&[[-x, -y], [x, -y], [x, y], [-x, y]], 0.2)).with_friction(0.0);
    let blade = scene.add(Body::dynamic(middle, vec![bouncing(blade, 0.0)]));
    scene.joints.push(Joint { motor: Some([spin, f32::MAX]), ..Joint::new([room, blade], middle) });
    let [mut x, mut y] = [-23.0 * side, 2.0 * side];
    for index in 0..count(6076, size) {
        let form = match index % 3 {
            0 => Form::Capsule { ends: [[-0.25, 0.0], [0.25, 0.0]], radius: 0.25 },
            1 => Form::Circle { centre: [0.0; 2], radius: 0.35 },
            _ => Form::Box { half: [0.35; 2], centre: [0.0; 2] },
        };
        let shape = bouncing(Shape::new(form).with_friction(0.1).with_density(0.25), 0.1);
        scene.add(Body::dynamic([x, y], vec![shape]));
        x += 0.5;
        if x >= 23.0 * side {
            (x, y) = (-23.0 * side, y + 0.5);
        }
    }
    scene
}
