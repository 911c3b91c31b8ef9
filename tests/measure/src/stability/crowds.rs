//! Families of many circles in too little space.

use super::Moment;
use super::StabilityFamily;
use super::parts::{SPEED_LIMIT, all, calm, ends_in, never_above};
use super::reasons;
use crate::scenes::movable;
use crate::scenes::stage::{METRE, Stage};
use crate::watch::{Watch, greatest, mean_speed};
use crate::world::{World, distance, masses};
use conformance::scene::Scene;
use conformance::scenes::circles_in_a_pit;
use std::f64::consts::PI;

/// Greatest fraction of the plane that circles of one size can cover, dimensionless.
const DENSEST: f64 = 0.9069;

pub(super) const FAMILIES: [StabilityFamily; 3] = [
    StabilityFamily {
        name: "Circle Pit",
        about: "Circles of radius 9 to 11 px fall into a pit and lie no lower than circles can after 10 s. Gravity \
                150 px/s², friction 0.5, restitution 0.1.",
        parameter: "circles",
        values: &[20.0, 50.0, 100.0, 200.0, 500.0, 1000.0],
        quick_values: &[20.0, 100.0, 200.0],
        build: |count, _| circles_in_a_pit(count as usize),
        judge: pile_is_high,
        quantity: "height of the centre of mass, as a share of the least possible",
        quantity_unit: "",
        ..StabilityFamily::PLAIN
    },
    StabilityFamily {
        name: "Confined",
        about: "Rows of circles of 1 m are pressed into a closed box of 10 m without gravity. They stay in it, and \
                are at rest after 5 s: not faster than 0.1 m/s.",
        parameter: "circles per row",
        values: &[6.0, 8.0, 9.0, 10.0, 11.0, 12.0, 13.0, 15.0],
        quick_values: &[8.0, 10.0, 12.0],
        build: |count, _| confined(count as usize),
        judge: crowd_is_at_rest,
        seconds: |_| 5.0,
        quantity: "mean speed at the end",
        quantity_unit: "px/s",
        ..StabilityFamily::PLAIN
    },
    StabilityFamily {
        name: "Rush",
        about: "Circles of 1 m are drawn to a point by 10 m/s² and lie around it after 10 s: as wide as circles have \
                to, and none thrown out. More circles than these would take too long; with these nothing is expected to \
                fail.",
        parameter: "circles",
        values: &[10.0, 25.0, 50.0, 100.0, 200.0, 400.0],
        quick_values: &[10.0, 100.0],
        build: |count, _| rush(count as usize),
        act: draw_to_the_middle,
        judge: crowd_lies_around_the_middle,
        quantity: "mean distance from the point, as a share of the least possible",
        quantity_unit: "",
        ..StabilityFamily::PLAIN
    },
];

/// Half the inner extent of the box along x and y, in px.
const ROOM: f32 = 5.0 * METRE;

fn confined(count: usize) -> Scene {
    let mut stage = Stage::without_gravity();
    let thickness = 4.0 * METRE;
    for side in [-1.0, 1.0] {
        let place = side * (ROOM + thickness / 2.0);
        stage.wall([place, 0.0], [thickness, 2.0 * ROOM + 2.0 * thickness]);
        stage.wall([0.0, place], [2.0 * ROOM, thickness]);
    }
    let spacing = (2.0 * ROOM - METRE) / (count - 1) as f32;
    let place = |index: usize| -ROOM + METRE / 2.0 + spacing * index as f32;
    for index in 0..count * count {
        stage.ball([place(index % count), place(index / count)], METRE / 2.0);
    }
    stage.done()
}

fn crowd_is_at_rest(_: f64, scene: &Scene) -> Box<dyn Watch> {
    let (bodies, others) = (movable(scene), movable(scene));
    let outermost = move |world: &dyn World| {
        greatest(world, &others, |body| body.position[0].abs().max(body.position[1].abs()))
    };
    all(vec![
        calm(scene, SPEED_LIMIT),
        never_above(f64::from(ROOM), reasons::TUNNELLED, outermost),
        ends_in(..3.2, reasons::CREPT, move |world| mean_speed(world, &bodies)),
    ])
}

fn pile_is_high(_: f64, scene: &Scene) -> Box<dyn Watch> {
    let bodies = movable(scene);
    let areas: Vec<f64> = masses(scene).iter().map(|body| body.inertia / body.mass * 2.0 * PI).collect();
    let area: f64 = bodies.iter().map(|&index| areas[index]).sum();
    // The walls are bodies 1 and 2, 40 px wide.
    let wall = |index: usize| scene.bodies[index].position.map_or(0.0, |place| f64::from(place.x));
    let width = wall(2) - wall(1) - 40.0;
    let least = area / (DENSEST * width) / 2.0;
    let share = move |world: &dyn World| {
        let moment: f64 = bodies.iter().map(|&index| -areas[index] * world.body(index).position[1]).sum();
        moment / area / least
    };
    all(vec![calm(scene, SPEED_LIMIT), ends_in(0.95.., reasons::SANK, share)])
}

fn rush(count: usize) -> Scene {
    let mut stage = Stage::without_gravity();
    // The circles start on a spiral whose turns are 1.2 m apart.
    for index in 0..count {
        let turn = (4.0 * std::f32::consts::PI * (index + 1) as f32).sqrt();
        let radius = 1.2 * METRE * turn / std::f32::consts::TAU + METRE;
        stage.ball([radius * turn.cos(), radius * turn.sin()], METRE / 2.0);
    }
    stage.done()
}

/// Distance from the middle beyond which a circle counts as thrown out, as a ratio to the least possible mean distance. The
/// outermost circle of a round crowd is at a ratio of 1.5, or 2 in a small crowd.
const THROWN: f64 = 4.0;

/// Acceleration of the circles towards the middle in px/s².
const PULL: f64 = 320.0;

fn draw_to_the_middle(_: f64, world: &mut dyn World, moment: Moment) {
    let mass = PI / 4.0;
    for index in 0..world.body_count() {
        let [x, y] = world.body(index).position_in_plane();
        // The force is weaker within half a metre of the middle, where the direction would otherwise turn from step to step.
        let distance = x.hypot(y).max(f64::from(METRE) / 2.0);
        let impulse = -mass * PULL * f64::from(moment.dt) / distance;
        world.apply_impulse(index, [impulse * x, impulse * y]);
    }
}

fn crowd_lies_around_the_middle(count: f64, scene: &Scene) -> Box<dyn Watch> {
    let (bodies, others) = (movable(scene), movable(scene));
    // In a full disc, the mean distance of points from the middle is two thirds of the radius.
    let least = 2.0 / 3.0 * f64::from(METRE) / 2.0 * (count / DENSEST).sqrt();
    let farthest = move |world: &dyn World| {
        greatest(world, &others, |body| distance(body.position_in_plane(), [0.0; 2])) / least
    };
    let share = move |world: &dyn World| {
        let places = bodies.iter().map(|&index| world.body(index).position_in_plane());
        places.map(|place| distance(place, [0.0; 2])).sum::<f64>() / bodies.len() as f64 / least
    };
    all(vec![
        calm(scene, SPEED_LIMIT),
        ends_in(..THROWN, reasons::BLEW_UP, farthest),
        ends_in(0.95.., reasons::SANK, share),
    ])
}
