//! Stacks of boxes and of circles, and a heavy box on a light one. All are built a little pressed; height is measured
//! from how they stand when nothing overlaps.

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
/// The boxes of `two_boxes`.
const LIGHT: usize = 1;
const HEAVY_ONE: usize = 2;

/// Half a box out of place is no stack any more.
const STACK: Rest = Rest { seconds: 10.0, ruin: |scene| toppled(scene, BOX / 2.0) };
/// Half of one of its boxes.
const PYRAMID: Rest = Rest { seconds: 5.0, ruin: |scene| toppled(scene, 10.0) };
/// A circle that has left the gap it lay in is a radius away.
const CIRCLES: Rest = Rest { seconds: 5.0, ruin: |scene| toppled(scene, RADIUS) };
/// How deep one sinks into the other is the error, and no failure until it has passed through.
const HEAVY: Rest = Rest { seconds: 5.0, ruin: toppled_or_sunk };

pub(super) fn scenes() -> Vec<ChartScene> {
    let boxes = ChartScene {
        name: "box_stack_penetration",
        about: "Boxes stand on top of each other.",
        // A column of 2000 is 64 m tall, and no scene.
        sizes: &[5, 20, 200],
        build: |count| box_stack(count, PRESS),
        seconds: STACK.seconds,
        watch: |scene| STACK.penetration(scene),
        error: "largest overlap at the end",
        unit: "px",
        // A pixel is seen as touching.
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

/// A light box of 1 kg and a heavy one on it, by the heavy one's mass.
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
            about: "A box of 100 kg stands on one of 1 kg; soft contacts give way by the same amount whatever the step.",
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

/// Each box is put so deep into the one below.
fn box_stack(count: usize, press: f64) -> Scene {
    let mut stage = stage(format!("box_stack_of_{count}")).with_surface(FRICTION, 0.0);
    ground(&mut stage, 640.0, 0.0);
    let mut top = 0.0;
    for index in 0..count {
        // Widths differ a little, so that no two edges lie at exactly the same place (see `conformance::scenes`).
        let width = BOX + 0.2 * f64::from(vary(index, 2));
        top -= BOX - press;
        let place = [0.1 * f64::from(vary(index, 3)), top + BOX / 2.0];
        stage.boxed(place, [width, BOX], 1.0);
    }
    stage.done()
}

/// A box that has shifted by half of itself, or turned by half a right angle, has fallen off. What is lower by its
/// height with respect to what it stood on has passed through.
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

/// Each circle is put so deep into its neighbours.
fn circle_stack(count: usize, press: f64) -> Scene {
    let mut stage = stage(format!("circle_stack_of_{count}")).with_surface(FRICTION, 0.0);
    let rows = rows_of_triangle(count);
    let spacing = 2.0 * RADIUS - press;
    let half = spacing * rows as f64 / 2.0;
    ground(&mut stage, 2.0 * half + 640.0, 0.0);
    for side in [-1.0, 1.0] {
        // One stands a little higher, again so that their edges differ.
        stage.wall([side * (half + BOX / 2.0), -BOX / 2.0 + 0.1 * side], [BOX, BOX]);
    }
    for (row, from_middle) in triangle(rows) {
        let y = press - RADIUS - row as f64 * 0.75_f64.sqrt() * spacing;
        // Corners of the polygons point at all six neighbours.
        stage.disc([spacing * f64::from(from_middle), y], RADIUS, 1.0, 24);
    }
    stage.done()
}
