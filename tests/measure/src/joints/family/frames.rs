//! Closed loops of joints: grids, girders, wheels of plates, and joints that contradict each other.

use super::JointScene;
use crate::joints::assembly::{Assembly, JointKind};
use std::f32::consts::FRAC_PI_2;

/// Distance in px between the nodes of a grid.
const MESH: f32 = 32.0;
/// Half of the width, and the height, of a triangle of a girder, in px.
const TRIANGLE: [f32; 2] = [20.0, 35.0];

pub(super) fn scenes() -> Vec<JointScene> {
    let large = |nodes| JointScene { is_large: true, ..grid(nodes).lasting(1.5) };
    vec![
        grid(4),
        grid(8),
        grid(15),
        grid(25),
        large(50),
        large(100),
        girder(10, 1.0, true),
        girder(14, 1.0, true),
        girder(30, 1.0, true),
        girder(4, 100.0, false),
        girder(4, 1000.0, false),
        girder(30, 1.0, false),
        windmill(),
        legs_on_one_pin(),
        thousand_legger(),
        contradicting_rods(),
    ]
}

/// Returns a square grid of circles, each joined by hinges to its neighbours, that hangs by its two upper corners.
fn grid(nodes: usize) -> JointScene {
    let mut assembly = Assembly::new(320.0, 0.5);
    let at = |index: usize| MESH * index as f32;
    for index in 0..nodes * nodes {
        assembly.circle([at(index % nodes), at(index / nodes)], 8.0, 1.0, 1);
    }
    for index in 0..nodes * nodes {
        let (column, row) = (index % nodes, index / nodes);
        if column + 1 < nodes {
            assembly.hinge(index, index + 1, [at(column) + MESH / 2.0, at(row)]);
        }
        if row + 1 < nodes {
            assembly.hinge(index, index + nodes, [at(column), at(row) + MESH / 2.0]);
        }
    }
    for corner in [0, nodes - 1] {
        let place = [at(corner), 0.0];
        let post = assembly.post(place);
        assembly.hinge(post, corner, place);
    }
    JointScene::new(format!("joint grid {nodes}x{nodes}"), assembly)
}

/// Returns a girder of triangles between two fixed nodes. It consists of rods, or of bars on hinges if `has_bars`. The
/// middle lower node has a mass of `load` kg.
fn girder(triangles: usize, load: f32, has_bars: bool) -> JointScene {
    let mut assembly = Assembly::new(900.0, 0.5);
    let [half, height] = TRIANGLE;
    // Even nodes are below, odd ones above.
    for node in 0..=2 * triangles {
        assembly.circle([half * node as f32, -height * (node % 2) as f32], 5.0, 1.0, 1);
    }
    for node in 0..2 * triangles {
        for end in [node + 1, node + 2] {
            match end {
                end if end > 2 * triangles => {}
                end if has_bars => bar(&mut assembly, node, end),
                end => assembly.rod(node, end),
            }
        }
    }
    for end in [0, 2 * triangles] {
        assembly.bodies[end].is_static = true;
    }
    let middle = 2 * (triangles / 2);
    assembly.bodies[middle].mass = load;
    assembly.bodies[middle].inertia = 12.5 * load;
    let of = if has_bars { "bars" } else { "rods" };
    JointScene::new(format!("girder {triangles} {of} load {load}"), assembly).watching(middle)
}

/// Adds a bar of 0.5 kg on hinges between two nodes.
fn bar(assembly: &mut Assembly, node: usize, end: usize) {
    let [[x1, y1], [x2, y2]] = [node, end].map(|node| assembly.bodies[node].position);
    let (dx, dy) = (x2 - x1, y2 - y1);
    let bar = assembly.rectangle([(x1 + x2) / 2.0, (y1 + y2) / 2.0], [dx.hypot(dy), 4.0], 0.5, 1);
    assembly.bodies[bar].angle = dy.atan2(dx);
    assembly.hinge(node, bar, [x1, y1]);
    assembly.hinge(end, bar, [x2, y2]);
}

/// Returns four plates that are welded to a hub and overlap each other.
fn windmill() -> JointScene {
    let mut assembly = Assembly::new(0.0, 0.5);
    let hub = assembly.circle([0.0, 0.0], 50.0, 10.0, 0);
    for index in 0..4 {
        let (sine, cosine) = (FRAC_PI_2 * index as f32).sin_cos();
        let plate = assembly.rectangle([150.0 * cosine, 150.0 * sine], [200.0, 110.0], 4.0, 0);
        assembly.bodies[plate].angle = FRAC_PI_2 * index as f32;
        assembly.bodies[plate].friction = 0.1;
        assembly.weld(hub, plate, [50.0 * cosine, 50.0 * sine]);
    }
    JointScene::new("windmill", assembly).watching(hub)
}

/// Returns a bar and two legs on one common hinge; all three overlap.
fn legs_on_one_pin() -> JointScene {
    let mut assembly = Assembly::new(0.0, 0.5);
    let bar = assembly.rectangle([0.0, 0.0], [320.0, 64.0], 10.0, 0);
    for _ in 0..2 {
        let leg = assembly.rectangle([0.0, 16.0], [16.0, 80.0], 3.0, 0);
        assembly.hinge(bar, leg, [0.0, -24.0]);
    }
    JointScene::new("bar and two legs on one pin", assembly).lasting(20.0)
}

/// Returns a body on ten legs of two limbs each. All bodies collide, and many overlap.
fn thousand_legger() -> JointScene {
    let mut assembly = Assembly::with_floor(900.0, 0.5);
    let body = assembly.rectangle([0.0, -110.0], [320.0, 40.0], 10.0, 0);
    for index in 0..10 {
        let x = -128.0 + 64.0 * (index / 2) as f32;
        let thigh = assembly.rectangle([x, -75.0], [12.0, 50.0], 1.0, 0);
        assembly.hinge(body, thigh, [x, -100.0]);
        let shank = assembly.rectangle([x, -27.0], [10.0, 54.0], 1.0, 0);
        assembly.hinge(thigh, shank, [x, -52.0]);
    }
    JointScene::new("thousand-legger of 10 legs on the floor", assembly)
}

/// Returns a circle midway between two posts, with two rods that are half as long as the distance to each post: they cannot
/// both hold.
fn contradicting_rods() -> JointScene {
    let mut assembly = Assembly::new(0.0, 0.5);
    let posts = [-100.0, 100.0].map(|x| assembly.post([x, 0.0]));
    let circle = assembly.circle([0.0, 0.0], 10.0, 1.0, 0);
    for post in posts {
        assembly.joint(post, circle, JointKind::Rod { length: 50.0 });
    }
    JointScene::new("contradicting rods", assembly).lasting(4.0).watching(circle)
}
