//! Heavy loads on light bodies: welds, sliders and springs on the floor, beams and cantilevers.

use super::{JointScene, chains};
use crate::joints::assembly::Assembly;

/// Gravity in most of these scenes, in px/s², downwards.
const GRAVITY: f32 = 900.0;

pub(super) fn scenes() -> Vec<JointScene> {
    let mut scenes = Vec::new();
    scenes.extend([2.0, 10.0, 30.0, 100.0].map(welded));
    scenes.extend([1.0, 8.0, 20.0].map(torso));
    scenes.extend([10.0, 30.0].map(splayed_legs));
    scenes.extend([1.0, 30.0, 100.0].map(beam));
    scenes.extend([10.0, 50.0, 150.0].map(slider));
    scenes.extend([
        spring(50.0, 20_000.0, 1000.0),
        spring(150.0, 60_000.0, 3000.0),
        spring(10.0, 4000.0, 0.0),
        tower(5),
        tower(20),
        cantilever(5, 1.0),
        cantilever(10, 10.0),
        chains::pallet(),
        standing_man(),
    ]);
    scenes
}

/// Returns a box of `mass` kg, welded to a plate of 1 kg on the floor.
fn welded(mass: f32) -> JointScene {
    let mut assembly = Assembly::with_floor(GRAVITY, 0.5);
    let plate = assembly.rectangle([0.0, -5.0], [60.0, 10.0], 1.0, 1);
    let load = assembly.rectangle([0.0, -30.0], [40.0, 40.0], mass, 1);
    assembly.weld(plate, load, [0.0, -10.0]);
    JointScene::new(format!("weld {mass} on plate 1"), assembly).watching(load)
}

/// Returns a box of `mass` kg, welded to a leg of 1 kg on a foot of 1 kg.
fn torso(mass: f32) -> JointScene {
    let mut assembly = Assembly::with_floor(GRAVITY, 0.8);
    let foot = assembly.rectangle([0.0, -5.0], [80.0, 10.0], 1.0, 1);
    let leg = assembly.rectangle([0.0, -30.0], [16.0, 40.0], 1.0, 1);
    let torso = assembly.rectangle([0.0, -70.0], [40.0, 40.0], mass, 1);
    assembly.weld(foot, leg, [0.0, -10.0]);
    assembly.weld(leg, torso, [0.0, -50.0]);
    JointScene::new(format!("torso {mass} on leg and foot"), assembly).watching(torso)
}

/// Returns a box of `mass` kg, welded to two legs of 1 kg that are inclined outwards by 0.9 rad from the horizontal.
fn splayed_legs(mass: f32) -> JointScene {
    let mut assembly = Assembly::with_floor(GRAVITY, 0.5);
    let load = assembly.rectangle([0.0, -50.0], [60.0, 20.0], mass, 1);
    for side in [-1.0, 1.0] {
        let leg = assembly.rectangle([side * 42.0, -32.5], [50.0, 6.0], 1.0, 1);
        assembly.bodies[leg].angle = side * 0.9;
        assembly.bodies[leg].friction = 1.0;
        assembly.weld(load, leg, [side * 28.0, -50.0]);
    }
    JointScene::new(format!("splayed legs under {mass}"), assembly).watching(load)
}

/// Returns a beam of seven boxes, welded side by side, on two walls; the middle box has a mass of `mass` kg, all others 1
/// kg.
fn beam(mass: f32) -> JointScene {
    let mut assembly = Assembly::new(GRAVITY, 0.5);
    for x in [-100.0, 100.0] {
        assembly.wall([x, -20.0], [30.0, 40.0]);
    }
    let boxes = [1.0, 1.0, 1.0, mass, 1.0, 1.0, 1.0];
    for (index, mass) in boxes.into_iter().enumerate() {
        let x = -105.0 + 35.0 * index as f32;
        let body = assembly.rectangle([x, -50.0], [35.0, 20.0], mass, 1);
        if index > 0 {
            assembly.weld(body - 1, body, [x - 17.5, -50.0]);
        }
    }
    // The walls are bodies 0 and 1.
    JointScene::new(format!("welded beam, middle {mass}"), assembly).watching(5)
}

/// Returns a box of `mass` kg that rests on a plate of 1 kg; a slider lets it move relative to the plate along y alone.
fn slider(mass: f32) -> JointScene {
    let mut assembly = Assembly::with_floor(GRAVITY, 0.5);
    let plate = assembly.rectangle([0.0, -5.0], [60.0, 10.0], 1.0, 0);
    let load = assembly.rectangle([0.0, -30.0], [40.0, 40.0], mass, 0);
    assembly.slider(plate, load, [0.0, -10.0], [0.0, 1.0]);
    JointScene::new(format!("slider {mass} on plate 1"), assembly).watching(load)
}

/// Returns a box of `mass` kg that a spring carries above a plate of 1 kg; a slider lets it move relative to the plate along
/// y alone. `stiffness` in kg/s², `damping` in kg/s.
fn spring(mass: f32, stiffness: f32, damping: f32) -> JointScene {
    let mut assembly = Assembly::with_floor(GRAVITY, 0.5);
    let plate = assembly.rectangle([0.0, -5.0], [60.0, 10.0], 1.0, 0);
    let load = assembly.rectangle([0.0, -105.0], [40.0, 40.0], mass, 0);
    // The large moments of inertia keep both bodies from toppling.
    for body in [plate, load] {
        assembly.bodies[body].inertia = 1e9;
    }
    assembly.spring(plate, [0.0, 0.0], load, stiffness, damping);
    assembly.slider(plate, load, [0.0, -5.0], [0.0, 1.0]);
    let sag = mass * GRAVITY / stiffness;
    let name = format!("spring k {stiffness} c {damping}: {mass} on plate 1");
    JointScene::new(name, assembly).watching_at(load, [0.0, -105.0 + sag])
}

/// Returns a tower of welded boxes of 1 kg on the floor.
fn tower(boxes: usize) -> JointScene {
    let mut assembly = Assembly::with_floor(320.0, 0.5);
    for index in 0..boxes {
        let y = -32.0 * index as f32;
        let body = assembly.rectangle([0.0, y - 16.0], [32.0, 32.0], 1.0, 1);
        if index > 0 {
            assembly.weld(body - 1, body, [0.0, y]);
        }
    }
    JointScene::new(format!("tower of {boxes} welded boxes"), assembly).watching(boxes)
}

/// Returns a cantilever: boxes of 1 kg, welded side by side to a post; the last box has a mass of `tip` kg.
fn cantilever(boxes: usize, tip: f32) -> JointScene {
    let mut assembly = Assembly::new(320.0, 0.5);
    let mut last = assembly.post([0.0, 0.0]);
    for index in 0..boxes {
        let x = 32.0 * index as f32;
        let mass = if index + 1 == boxes { tip } else { 1.0 };
        let body = assembly.rectangle([x + 16.0, 0.0], [32.0, 16.0], mass, 1);
        assembly.weld(last, body, [x, 0.0]);
        last = body;
    }
    JointScene::new(format!("cantilever {boxes} welds, tip {tip}"), assembly).watching(last)
}

/// Returns a figure of eight welded bodies that stands on two feet.
fn standing_man() -> JointScene {
    let mut assembly = Assembly::with_floor(GRAVITY, 0.9);
    let torso = assembly.rectangle([0.0, -95.0], [30.0, 50.0], 8.0, 1);
    let head = assembly.circle([0.0, -130.0], 12.0, 1.5, 1);
    assembly.weld(torso, head, [0.0, -120.0]);
    for x in [-10.0, 10.0] {
        let thigh = assembly.rectangle([x, -55.0], [12.0, 34.0], 2.0, 1);
        assembly.weld(torso, thigh, [x, -70.0]);
        let shank = assembly.rectangle([x, -24.0], [10.0, 32.0], 1.5, 1);
        assembly.weld(thigh, shank, [x, -40.0]);
        let foot = assembly.rectangle([1.4 * x, -4.0], [24.0, 8.0], 0.5, 1);
        assembly.weld(shank, foot, [x, -8.0]);
    }
    JointScene::new("man of welds stands", assembly).watching(torso)
}
