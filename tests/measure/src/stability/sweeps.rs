//! Families that are hard for broad phases which keep a sorted list.

use super::parts::{Allowed, SPEED_LIMIT, all, calm, each_reaches, ends_in, never_above, standing};
use super::{Moment, StabilityFamily, reasons};
use crate::scenes::movable;
use crate::scenes::stage::{METRE, Stage};
use crate::watch::{Watch, greatest};
use crate::world::World;
use conformance::scene::Scene;
use farseer_core::math::Vector2;

/// Base of families that run with every broad phase.
const SWEPT: StabilityFamily =
    StabilityFamily { broad_phases_matter: true, seconds: |_| SHORT, ..StabilityFamily::PLAIN };
/// Simulated time of most runs of these families, in s.
const SHORT: f64 = 5.0;

pub(super) const FAMILIES: [StabilityFamily; 3] = [
    StabilityFamily {
        name: "Teleport",
        about: "Ten boxes of 1 m are put from one floor to another one at this distance, and back, ten times a second. \
                They rest where they were put on the second floor at the end. (Floats are 8 px apart at 1e8 px, and \
                64 px at 1e9 px.)",
        parameter: "distance",
        unit: "px",
        values: &[1e3, 3e3, 1e4, 3e4, 1e5, 3e5, 1e6, 1e7, 1e8, 3e8, 1e9],
        quick_values: &[1e3, 1e5, 1e7, 1e9],
        build: |distance, _| two_floors(distance as f32),
        act: put_across,
        judge: rests_on_the_second_floor,
        quantity: "greatest depth of a centre below its resting position",
        ..SWEPT
    },
    StabilityFamily {
        name: "Fast Bodies",
        about: "Eight circles of 1 m fly at a wall that is three times as thick as their displacement in 1/60 s. All \
                arrive, and none gets through. (All speeds are alike except for rounding: floats are coarse where the wall \
                and the bodies are far apart.)",
        parameter: "speed",
        unit: "px/s",
        values: &[1e3, 3e3, 1e4, 3e4, 1e5, 3e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11],
        quick_values: &[1e3, 1e4, 1e6, 1e9, 1e11],
        build: |speed, _| fast_bodies(speed as f32),
        judge: stays_before_the_wall,
        seconds: |_| 2.0,
        quantity: "greatest depth of a centre behind the wall's face, as a fraction of its thickness",
        quantity_unit: "",
        ..SWEPT
    },
    StabilityFamily {
        name: "Equal Coordinates",
        about: "A row of boxes of 1 m, 2 m apart, lies on the floor: equal edges all over. All stand for 5 s. \
                However many there are, nothing is expected to fail.",
        parameter: "boxes",
        values: &[2.0, 4.0, 8.0, 16.0, 32.0, 64.0, 128.0, 256.0, 512.0],
        quick_values: &[2.0, 16.0, 128.0],
        build: |count, _| row(count as usize),
        judge: |_, scene| all(vec![calm(scene, SPEED_LIMIT), standing(scene, SHORT, Allowed::BOXES)]),
        quantity: "greatest displacement",
        ..SWEPT
    },
];

/// Number of boxes that are teleported together.
const BOXES: usize = 10;

fn two_floors(distance: f32) -> Scene {
    let mut stage = Stage::new().with_floor(30.0 * METRE);
    stage.wall([distance, METRE], [30.0 * METRE, 2.0 * METRE]);
    for index in 0..BOXES {
        stage.solid([place_on_floor(index) as f32, -METRE / 2.0], [METRE, METRE]);
    }
    stage.scene_mut().name = format!("{distance}");
    stage.done()
}

/// Returns the position in px along x of a box, relative to the middle of the floor.
fn place_on_floor(index: usize) -> f64 {
    // The distance between neighbours grows a little from box to box, so that no two edges are equal.
    f64::from(METRE) * (index as f64 - 4.5) * (1.5 + 0.01 * index as f64)
}

fn put_across(distance: f64, world: &mut dyn World, moment: Moment) {
    const PERIOD: f64 = 0.1;
    let before = (moment.time / PERIOD).floor();
    let after = ((moment.time + f64::from(moment.dt)) / PERIOD).floor();
    // No box is teleported in the last second, in which the boxes come to rest.
    if after > before && moment.time < SHORT - 1.0 {
        let side = if after % 2.0 == 0.0 { distance } else { 0.0 };
        for index in 0..BOXES {
            // The floors are bodies 0 and 1.
            world.teleport(index + 2, [side + place_on_floor(index), -16.0], 0.0);
            world.set_velocity(index + 2, [0.0; 2], 0.0);
        }
    }
}

fn rests_on_the_second_floor(distance: f64, scene: &Scene) -> Box<dyn Watch> {
    let bodies = movable(scene);
    let shift = move |world: &dyn World| {
        let off = |index: usize| world.body(index + 2).position[0] - distance - place_on_floor(index);
        (0..BOXES).map(|index| off(index).abs()).fold(0.0, f64::max)
    };
    let depth = move |world: &dyn World| greatest(world, &bodies, |body| body.position[1] + 16.0);
    all(vec![
        calm(scene, SPEED_LIMIT),
        ends_in(..16.0, reasons::TOPPLED, shift),
        ends_in(..3.2, reasons::TUNNELLED, depth),
    ])
}

fn fast_bodies(speed: f32) -> Scene {
    let mut stage = Stage::without_gravity();
    let thickness = 3.0 * speed / 60.0;
    let lane = 2.0 * METRE;
    // The walls are higher than they are thick, so that the face is always nearer to a body than the ends.
    stage.wall([thickness / 2.0, 3.5 * lane], [thickness, 16.0 * lane + 2.0 * thickness]);
    for index in 0..8 {
        stage.ball([-100.0 - speed / 60.0 * (index as f32 / 8.0 + 3.0), lane * index as f32], METRE / 2.0);
        stage.last().settings.linear_velocity = Some(Vector2::new(speed, 0.0));
    }
    stage.done()
}

fn stays_before_the_wall(speed: f64, scene: &Scene) -> Box<dyn Watch> {
    let bodies = movable(scene);
    let thickness = 3.0 * speed / 60.0;
    let depth = move |world: &dyn World| greatest(world, &bodies, |body| body.position[0] / thickness);
    // The run is valid only if the body came within its own size of the wall.
    let arrive = each_reaches(scene, -f64::from(METRE), reasons::STUCK, |body| body.position[0]);
    all(vec![calm(scene, 10.0 * speed), arrive, never_above(1.0, reasons::TUNNELLED, depth)])
}

fn row(count: usize) -> Scene {
    let mut stage = Stage::new().with_floor((2 * count + 20) as f32 * METRE);
    for index in 0..count {
        let from_centre = index as f32 - (count - 1) as f32 / 2.0;
        stage.solid([2.0 * METRE * from_centre, -METRE / 2.0], [METRE, METRE]);
    }
    stage.done()
}
