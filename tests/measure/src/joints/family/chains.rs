//! Pendulums, chains, bridges, and chains stretched beyond their length.

use super::{JointScene, Pull};
use crate::joints::assembly::{Assembly, Form};
use std::f32::consts::FRAC_PI_2;

/// Length and thickness of a chain link in px.
const LINK: [f32; 2] = [16.0, 4.0];
/// Length and thickness of a plank in px.
const PLANK: [f32; 2] = [24.0, 6.0];

pub(super) fn scenes() -> Vec<JointScene> {
    let level = |links, ball| chain(links, ball, true);
    vec![
        pendulum(1.0),
        level(5, 0.0),
        level(20, 0.0),
        level(200, 0.0),
        JointScene { is_large: true, ..level(2000, 0.0).lasting(4.0) },
        spinner(),
        level(20, 10.0),
        level(20, 100.0),
        level(20, 1000.0),
        chain(20, 1000.0, false),
        bridge(20, 0, 1.0),
        bridge(20, 3, 1.0),
        bridge(20, 3, 20.0),
        bridge(100, 5, 5.0),
        falling(20),
        falling(200),
        stretched(5.0),
        stretched(20.0),
        stretched(60.0),
    ]
}

/// Returns a pendulum: a box of 1 kg on an arm of 64 px, released at `angle` rad from the vertical.
fn pendulum(angle: f32) -> JointScene {
    let mut assembly = Assembly::new(320.0, 0.5);
    let post = assembly.post([0.0, 0.0]);
    let bob = assembly.rectangle([64.0 * angle.sin(), 64.0 * angle.cos()], [8.0, 8.0], 1.0, 1);
    assembly.bodies[bob].angle = -angle;
    assembly.hinge(post, bob, [0.0, 0.0]);
    JointScene::new(format!("pendulum {angle}"), assembly)
}

/// Returns a chain of links of 1 kg that hangs from a post; it starts level or hanging down. If `ball` > 0, a ball of that
/// mass in kg is at the end.
fn chain(links: usize, ball: f32, is_level: bool) -> JointScene {
    let mut assembly = Assembly::new(320.0, 0.5);
    let along = |way: f32| if is_level { [way, 0.0] } else { [0.0, way] };
    let mut last = assembly.post([0.0, 0.0]);
    for index in 0..links {
        let start = LINK[0] * index as f32;
        let link = assembly.body(along(start + LINK[0] / 2.0), Form::None, 1.0, 0);
        assembly.bodies[link].inertia = Form::Rectangle(LINK).inertia(1.0);
        assembly.hinge(last, link, along(start));
        last = link;
    }
    if ball > 0.0 {
        let end = LINK[0] * links as f32;
        let body = assembly.circle(along(end + 16.0), 16.0, ball, 1);
        assembly.hinge(last, body, along(end));
    }
    let load = if ball > 0.0 { format!("ball {ball} on ") } else { String::new() };
    let hung = if is_level { "" } else { " hung" };
    JointScene::new(format!("{load}chain {links}{hung}"), assembly)
}

/// Returns six links without gravity that rotate about their common centre like one rigid body, at 20 rad/s.
fn spinner() -> JointScene {
    let mut assembly = Assembly::new(0.0, 0.5);
    for index in 0..6 {
        let x = 32.0 * index as f32;
        let link = assembly.rectangle([x, 0.0], [32.0, 8.0], 1.0, 1);
        assembly.bodies[link].velocity = [0.0, 20.0 * (x - 80.0)];
        assembly.bodies[link].angular_velocity = 20.0;
        if index > 0 {
            assembly.hinge(link - 1, link, [x - 16.0, 0.0]);
        }
    }
    JointScene::new("free chain of 6 spins at 20 rad/s", assembly)
}

/// Returns a bridge of planks of 1 kg between two posts, and `loads` boxes of `mass` kg each that fall on it.
fn bridge(planks: usize, loads: usize, mass: f32) -> JointScene {
    let mut assembly = Assembly::new(320.0, 0.5);
    let mut last = assembly.post([0.0, 0.0]);
    for index in 0..planks {
        let start = PLANK[0] * index as f32;
        let plank = assembly.rectangle([start + PLANK[0] / 2.0, 0.0], PLANK, 1.0, 1);
        assembly.hinge(last, plank, [start, 0.0]);
        last = plank;
    }
    let length = PLANK[0] * planks as f32;
    let post = assembly.post([length, 0.0]);
    assembly.hinge(last, post, [length, 0.0]);
    for index in 0..loads {
        let x = length * (index as f32 + 0.5) / loads as f32;
        assembly.rectangle([x, -40.0], [20.0, 20.0], mass, 0);
    }
    JointScene::new(format!("bridge {planks} with {loads} of {mass}"), assembly)
}

/// Returns a level chain that falls on the floor.
fn falling(links: usize) -> JointScene {
    let mut assembly = Assembly::with_floor(320.0, 0.5);
    for index in 0..links {
        let x = LINK[0] * index as f32;
        let link = assembly.rectangle([x, -100.0], LINK, 1.0, 1);
        if index > 0 {
            assembly.hinge(link - 1, link, [x - LINK[0] / 2.0, -100.0]);
        }
    }
    JointScene::new(format!("chain {links} falls on the floor"), assembly)
}

/// Returns a chain of ten circles between two posts, one of which is moved until the chain is stretched by `elongation` px.
fn stretched(elongation: f32) -> JointScene {
    let mut assembly = Assembly::new(900.0, 0.5);
    let mut last = assembly.post([0.0, 0.0]);
    for index in 0..10 {
        let start = 20.0 * index as f32;
        let link = assembly.circle([start + 10.0, 0.0], 6.0, 1.0, 1);
        assembly.hinge(last, link, [start, 0.0]);
        last = link;
    }
    let body = assembly.post([200.0, 0.0]);
    assembly.hinge(last, body, [200.0, 0.0]);
    let scene = JointScene::new(format!("chain stretched by {elongation} for 5 s, then loose"), assembly);
    JointScene { pull: Some(Pull { body, elongation }), ..scene.lasting(8.5) }
}

/// Returns a load of 50 kg on a pallet of 1 kg on the floor, and a taut chain from the load to a post above.
pub(super) fn pallet() -> JointScene {
    let mut assembly = Assembly::with_floor(900.0, 0.5);
    let mut last = assembly.post([0.0, -160.0]);
    for index in 0..7 {
        let y = -160.0 + 20.0 * index as f32;
        let link = assembly.rectangle([0.0, y + 10.0], [20.0, 3.0], 0.5, 1);
        assembly.bodies[link].angle = FRAC_PI_2;
        assembly.hinge(last, link, [0.0, y]);
        last = link;
    }
    let pallet = assembly.rectangle([0.0, -5.0], [80.0, 10.0], 1.0, 1);
    let load = assembly.rectangle([0.0, -20.0], [40.0, 20.0], 50.0, 1);
    assembly.weld(pallet, load, [0.0, -10.0]);
    assembly.hinge(last, load, [0.0, -20.0]);
    JointScene::new("load 50 on pallet, taut chain", assembly).watching(load)
}
