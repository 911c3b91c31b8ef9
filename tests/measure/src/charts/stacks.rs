//! Charts of stacks of boxes and of circles, and of a heavy box on a light one. All are built with a slight overlap; height
//! errors are relative to the state without overlaps.

use super::super::world::World;
use super::ChartScene;
use super::build::{PRESS, ground, rows_of_triangle, stage, start};
use super::resting::height_of_boxes;
use super::settled::{Rest, RuinCheck, built_height, charts_of_rest, toppled};
use crate::scenes::movable;
use conformance::scene::Scene;
use conformance::scenes::{pyramid, triangle, vary};

const BOX: f64 = 32.0;
const RADIUS: f64 = 16.0;
const FRICTION: f64 = 0.5;
/// `LIGHT`: index of the light box in `two_boxes`. `HEAVY_ONE`: index of the heavy box.
const LIGHT: usize = 1;
const HEAVY_ONE: usize = 2;

/// Duration and condition of failure of a stack: a box is half its width away from its start.
const STACK: Rest = Rest { seconds: 10.0, ruin: |scene| toppled(scene, BOX / 2.0) };
/// Duration and condition of failure of a pyramid: a box is 10 px, half its width, away from its start.
const PYRAMID: Rest = Rest { seconds: 5.0, ruin: |scene| toppled(scene, 10.0) };
/// Duration and condition of failure of a stack of circles: a circle is a radius away from its start, outside of the gap in
/// which it lay.
const CIRCLES: Rest = Rest { seconds: 5.0, ruin: |scene| toppled(scene, RADIUS) };
/// Duration and condition of failure of a heavy box on a light one. The overlap is the error; the run fails only if a box has
/// toppled or passed through the other.
const HEAVY: Rest = Rest { seconds: 5.0, ruin: toppled_or_sunk };

pub(super) fn scenes() -> Vec<ChartScene> {
    let boxes = ChartScene {
        name: "box_stack_penetration",
        about: "Boxes stand on top of each other.",
        // A column of 2000 boxes would be 64 m tall, which no game has.
        sizes: &[5, 20, 200],
        build: |count| box_stack(count, PRESS),
        seconds: STACK.seconds,
        watch: |scene| STACK.penetration(scene),
        error: "largest overlap at the end",
        unit: "px",
        // 1 px: a gap of a pixel looks like a contact.
        tolerance: 1.0,
        broad_phases_matter: false,
        peers_too: true,
    };
    let pyramids = ChartScene {
        name: "pyramid_penetration",
        about: "A pyramid of boxes stands.",
        sizes: &[5, 20, 200, 2000],
        build: |count| pyramid(rows_of_triangle(count)),
        seconds: PYRAMID.seconds,
        watch: |scene| PYRAMID.penetration(scene),
        broad_phases_matter: true,
        ..boxes
    };
    let circles = ChartScene {
        name: "circle_stack_penetration",
        about: "Circles lie in rows, each in the gaps of the row below, between two stops.",
        sizes: &[5, 20, 200, 2000],
        build: |count| circle_stack(count, PRESS),
        seconds: CIRCLES.seconds,
        watch: |scene| CIRCLES.penetration(scene),
        ..boxes
    };
    let mut scenes = Vec::new();
    scenes.extend(charts_of_rest(
        boxes,
        ("box_stack_height", |scene| {
            STACK.height(scene, built_height(&box_stack(movable(scene).len(), 0.0)))
        }),
        ("box_stack_speed", |scene| STACK.speed(scene)),
    ));
    scenes.extend(charts_of_rest(
        pyramids,
        ("pyramid_height", |scene| PYRAMID.height(scene, height_of_boxes(scene))),
        ("pyramid_speed", |scene| PYRAMID.speed(scene)),
    ));
    scenes.extend(charts_of_rest(
        circles,
        ("circle_stack_height", |scene| {
            CIRCLES.height(scene, built_height(&circle_stack(movable(scene).len(), 0.0)))
        }),
        ("circle_stack_speed", |scene| CIRCLES.speed(scene)),
    ));
    scenes.extend(heavy_on_light(boxes));
    scenes
}

/// Returns the charts of a heavy box on a light one of 1 kg, for several masses of the heavy box. `like` gives all other values
/// of a chart.
fn heavy_on_light(like: ChartScene) -> [ChartScene; 4] {
    let ten = ChartScene {
        name: "heavy_on_light_10",
        about: "A box of 10 kg stands on one of 1 kg.",
        sizes: super::ONE_SIZE,
        build: |_| two_boxes(10.0),
        seconds: HEAVY.seconds,
        watch: |scene| HEAVY.penetration(scene),
        ..like
    };
    [
        ten,
        ChartScene {
            name: "heavy_on_light_100",
            about: "A box of 100 kg stands on one of 1 kg; the penetration of soft contacts does not vanish with finer steps.",
            build: |_| two_boxes(100.0),
            ..ten
        },
        ChartScene {
            name: "heavy_on_light_1000",
            about: "A box of 1,000 kg stands on one of 1 kg. Boxes are 32 px: an overlap of 30 px is one in the other.",
            build: |_| two_boxes(1000.0),
            ..ten
        },
        ChartScene {
            name: "heavy_on_light_10000",
            about: "A box of 10,000 kg stands on one of 1 kg. Boxes are 32 px: an overlap of 30 px is one in the other.",
            build: |_| two_boxes(10_000.0),
            ..ten
        },
    ]
}

/// Returns a stack of `count` boxes. Each overlaps the one below by `press` px.
fn box_stack(count: usize, press: f64) -> Scene {
    let mut stage = stage(format!("box_stack_of_{count}")).with_surface(FRICTION, 0.0);
    ground(&mut stage, 640.0, 0.0);
    let mut top = 0.0;
    for index in 0..count {
        // The widths differ a little, so that no two edges coincide exactly (see `conformance::scenes`).
        let width = BOX + 0.2 * f64::from(vary(index, 2));
        top -= BOX - press;
        let place = [0.1 * f64::from(vary(index, 3)), top + BOX / 2.0];
        stage.boxed(place, [width, BOX], 1.0);
    }
    stage.done()
}

/// Returns the condition of failure of a stack: a box has toppled or passed through. It has toppled if it has moved half its
/// width sideways or turned by 45 degrees. It has passed through if it is lower by its height relative to the box below.
fn toppled_or_sunk(scene: &Scene) -> RuinCheck {
    const HALF_A_RIGHT_ANGLE: f64 = std::f64::consts::FRAC_PI_4;
    let places = [LIGHT, HEAVY_ONE].map(|index| start(scene, index)[0]);
    Box::new(move |world: &dyn World| {
        let boxes = [LIGHT, HEAVY_ONE].map(|index| world.body(index));
        let is_off = |index: usize| {
            let aside = boxes[index].position[0] - places[index];
            aside.abs() > BOX / 2.0 || boxes[index].angle.abs() > HALF_A_RIGHT_ANGLE
        };
        let [light, heavy] = [boxes[0].position[1], boxes[1].position[1]];
        if is_off(0) || is_off(1) {
            Some("toppled")
        } else if light > BOX / 2.0 || heavy > light {
            Some("sank")
        } else {
            None
        }
    })
}

fn two_boxes(ratio: f64) -> Scene {
    let mut stage = stage("heavy_on_light").with_surface(FRICTION, 0.0);
    ground(&mut stage, 640.0, 0.0);
    stage.boxed([0.0, PRESS - BOX / 2.0], [BOX, BOX], 1.0);
    stage.boxed([0.05, 2.0 * PRESS - 1.5 * BOX], [BOX + 0.2, BOX], ratio);
    stage.done()
}

/// Returns a stack of `count` circles in rows. Each overlaps its neighbours by `press` px.
fn circle_stack(count: usize, press: f64) -> Scene {
    let mut stage = stage(format!("circle_stack_of_{count}")).with_surface(FRICTION, 0.0);
    let rows = rows_of_triangle(count);
    let spacing = 2.0 * RADIUS - press;
    let half = spacing * rows as f64 / 2.0;
    ground(&mut stage, 2.0 * half + 640.0, 0.0);
    for side in [-1.0, 1.0] {
        // One side wall stands a little higher, so that the edges of the two do not coincide.
        stage.wall([side * (half + BOX / 2.0), -BOX / 2.0 + 0.1 * side], [BOX, BOX]);
    }
    for (row, from_middle) in triangle(rows) {
        let y = press - RADIUS - row as f64 * 0.75_f64.sqrt() * spacing;
        // Corners of the polygons point at all six neighbours.
        stage.disc([spacing * f64::from(from_middle), y], RADIUS, 1.0, 24);
    }
    stage.done()
}
