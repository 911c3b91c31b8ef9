//! Ragdolls whose joints have limits: one that is thrown on the floor, and a pile in a pit.

use super::JointScene;
use crate::joints::assembly::{Assembly, JointKind};
use crate::stability::ragdolls::{JOINTS, LIMBS};

/// Factor from cm in the description of a ragdoll to px: 32 px are 1 m.
const SCALE: f32 = 0.32;
/// Angle in rad with which a ragdoll begins, clockwise on the screen.
const ANGLE: f32 = 1.9;
/// Speed downwards in px/s with which a ragdoll begins.
const SPEED: f32 = 100.0;

pub(super) fn scenes() -> Vec<JointScene> {
    vec![one(), pile(20)]
}

fn one() -> JointScene {
    let mut assembly = Assembly::with_floor(320.0, 0.5);
    add(&mut assembly, [0.0, -64.0], ANGLE, [20.0, SPEED], 1);
    JointScene::new("ragdolls 1", assembly)
}

fn pile(count: usize) -> JointScene {
    let mut assembly = Assembly::with_floor(320.0, 0.5);
    for x in [-120.0, 120.0] {
        assembly.wall([x, -200.0], [32.0, 400.0]);
    }
    for index in 0..count {
        let at = [40.0 * (index % 3) as f32 - 40.0, -64.0 - 40.0 * index as f32];
        add(&mut assembly, at, ANGLE + index as f32, [0.0, SPEED], index as i32 + 1);
    }
    JointScene::new(format!("ragdolls {count}"), assembly)
}

/// Adds a ragdoll of limbs of 1 kg per square metre, which do not collide with each other. `at` is the position of the hips
/// in px, `angle` in rad, `velocity` in px/s.
fn add(assembly: &mut Assembly, at: [f32; 2], angle: f32, velocity: [f32; 2], group: i32) {
    let (sine, cosine) = angle.sin_cos();
    // Maps a point in cm (y from the crown of the head down) to the world in px; the ragdoll is rotated about its hips.
    let place = |[x, y]: [f32; 2]| {
        let (x, y) = (SCALE * x, SCALE * (y - 90.0));
        [x * cosine - y * sine + at[0], x * sine + y * cosine + at[1]]
    };
    let first = assembly.bodies.len();
    for ([x, y], [width, height]) in LIMBS {
        let size = [SCALE * width, SCALE * height];
        let middle = place([x + width / 2.0, y + height / 2.0]);
        let limb = assembly.rectangle(middle, size, width * height * 1e-4, group);
        assembly.bodies[limb].angle = angle;
        assembly.bodies[limb].velocity = velocity;
    }
    for (one, two, point, limits) in JOINTS {
        let kind = JointKind::Hinge { anchor: place(point), limits: Some(limits), motor: None };
        assembly.joint(first + one, first + two, kind);
    }
}
