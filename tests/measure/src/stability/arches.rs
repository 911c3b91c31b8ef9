//! The family of arches: an arch stands by friction and pressure alone.

use super::parts::{Allowed, SPEED_LIMIT, all, calm, standing};
use super::stacks::BOXES;
use super::{SECONDS, StabilityFamily};
use crate::scenes::stage::{METRE, Stage};
use crate::watch::Watch;
use conformance::scene::{Outline, OutlineForm, Scene};
use farseer_core::math::Vector2;
use std::f32::consts::PI;

pub(super) const FAMILIES: [StabilityFamily; 1] = [StabilityFamily {
    name: "Arch",
    about: "Half a ring of equal stones, radius 4 m to 5.5 m, stands on the floor for 10 s: no stone ends lower or higher \
            than it began by over a tenth of its height above the floor, nor by over half a metre, nor leaves its place, turns or creeps. Friction 0.7. (It is \
            nearly three times as thick as a half ring has to be, 0.107 of its middle radius, to stand at all.)",
    parameter: "stones",
    values: &[3.0, 5.0, 7.0, 9.0, 11.0, 15.0, 21.0, 31.0],
    quick_values: &[3.0, 7.0, 11.0, 21.0],
    build: |stones, _| arch(stones as usize),
    judge: arch_stands,
    ..BOXES
}];

fn arch(stones: usize) -> Scene {
    const INNER: f32 = 4.0 * METRE;
    const OUTER: f32 = 5.5 * METRE;
    let mut stage = Stage::new().with_friction(0.7).with_floor(20.0 * METRE);
    let at = |radius: f32, joint: usize| {
        let angle = PI * joint as f32 / stones as f32;
        [-radius * angle.cos(), -radius * angle.sin()]
    };
    for stone in 0..stones {
        let points = [at(INNER, stone), at(OUTER, stone), at(OUTER, stone + 1), at(INNER, stone + 1)];
        let area = (PI / stones as f32).sin() * (OUTER * OUTER - INNER * INNER) / 2.0;
        let points = points.map(|[x, y]| Vector2::new(x, y)).to_vec();
        // Distance grids test the vertices of one stone in the other, so the edges are subdivided.
        let outline = Outline { form: OutlineForm::Points { points }, subdivide: Some(METRE / 4.0) };
        stage.outlined(outline, area / (METRE * METRE));
    }
    stage.done()
}

fn arch_stands(_: f64, scene: &Scene) -> Box<dyn Watch> {
    // A shift by half the arch's thickness, a rotation of 10 degrees.
    let allowed = Allowed { shift: 24.0, turn: 0.175, creep: 1.6 };
    all(vec![calm(scene, SPEED_LIMIT), standing(scene, SECONDS, allowed)])
}
