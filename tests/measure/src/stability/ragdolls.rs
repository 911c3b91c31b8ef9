//! The family of ragdolls: a doll of limbs with limited joints is thrown on the floor.

use super::parts::{all, calm, ends_in, joined};
use super::{StabilityFamily, reasons};
use crate::scenes::movable;
use crate::scenes::stage::{METRE, Stage};
use crate::watch::{Watch, greatest, mean_speed};
use conformance::scene::{JointKind, Scene};
use farseer_core::math::Vector2;

pub(super) const FAMILIES: [StabilityFamily; 1] = [StabilityFamily {
    name: "Ragdoll",
    about: "A doll of 10 limbs, 1.8 m high, is thrown on the floor. It stays above it; from 6.4 s to 8 s no joint is open by \
            over a tenth of a metre, and at the end the doll is at rest: not faster than 0.2 m/s.",
    parameter: "speed",
    unit: "px/s",
    values: &[0.0, 100.0, 200.0, 400.0, 800.0, 1600.0, 3200.0],
    quick_values: &[0.0, 400.0, 1600.0],
    build: |speed, _| doll(speed as f32),
    judge: lies_in_one_piece,
    seconds: |_| SECONDS,
    quantity: "widest gap of a joint in the last fifth",
    ..StabilityFamily::PLAIN
}];

/// Simulated time of a run in s.
const SECONDS: f64 = 8.0;

/// Limbs of the doll: x and y of the upper left corner, then width and height, in cm. The origin is on the middle line at the
/// crown of the head, y down.
pub(crate) const LIMBS: [([f32; 2], [f32; 2]); 10] = [
    ([-11.0, 0.0], [22.0, 28.0]),
    ([-20.0, 30.0], [40.0, 58.0]),
    // Upper arms and forearms.
    ([-32.0, 32.0], [10.0, 32.0]),
    ([22.0, 32.0], [10.0, 32.0]),
    ([-32.0, 66.0], [10.0, 34.0]),
    ([22.0, 66.0], [10.0, 34.0]),
    // Thighs and lower legs.
    ([-18.0, 90.0], [16.0, 42.0]),
    ([2.0, 90.0], [16.0, 42.0]),
    ([-17.0, 134.0], [14.0, 46.0]),
    ([3.0, 134.0], [14.0, 46.0]),
];

/// Joints of the doll: indices of two limbs, the common point in cm in the coordinates of `LIMBS`, and the lower and upper
/// limit of the relative angle in radians.
pub(crate) const JOINTS: [(usize, usize, [f32; 2], [f32; 2]); 9] = [
    (1, 0, [0.0, 29.0], [-0.5, 0.5]),
    (1, 2, [-27.0, 33.0], [-0.5, 2.0]),
    (1, 3, [27.0, 33.0], [-2.0, 0.5]),
    (2, 4, [-27.0, 65.0], [-0.1, 1.5]),
    (3, 5, [27.0, 65.0], [-1.5, 0.1]),
    (1, 6, [-10.0, 89.0], [-0.5, 1.0]),
    (1, 7, [10.0, 89.0], [-1.0, 0.5]),
    (6, 8, [-10.0, 133.0], [-1.2, 0.1]),
    (7, 9, [10.0, 133.0], [-0.1, 1.2]),
];

/// Returns a doll in the air that lies on its back, turned by 20 degrees. It is thrown down, and a little to the right, at
/// `speed` px/s.
fn doll(speed: f32) -> Scene {
    let mut stage = Stage::new().with_floor(400.0 * METRE);
    let angle = 1.9_f32;
    let place = |[x, y]: [f32; 2]| {
        // Rotated about the doll's middle, which is 2 m above the floor.
        let (x, y) = (x * METRE / 100.0, (y - 90.0) * METRE / 100.0);
        [x * angle.cos() - y * angle.sin(), x * angle.sin() + y * angle.cos() - 2.0 * METRE]
    };
    for ([x, y], [width, height]) in LIMBS {
        let middle = place([x + width / 2.0, y + height / 2.0]);
        stage.solid(middle, [width * METRE / 100.0, height * METRE / 100.0]);
        stage.last().rotation = Some(angle);
        stage.last().settings.linear_velocity = Some(Vector2::new(0.2 * speed, speed));
        // Limbs of the doll do not collide with each other.
        stage.last_geom().settings.collision_group = Some(1);
    }
    for (one, two, point, [lower_limit, upper_limit]) in JOINTS {
        // The floor is body 0.
        let (body1, body2) = (one + 1, two + 1);
        stage.hinge(body1, body2, place(point));
        stage.joint(JointKind::AngleLimit { body1, body2, lower_limit, upper_limit });
    }
    stage.done()
}

fn lies_in_one_piece(_: f64, scene: &Scene) -> Box<dyn Watch> {
    let (bodies, others) = (movable(scene), movable(scene));
    all(vec![
        // The doll starts with up to the speed of the fastest throw.
        calm(scene, 6400.0),
        ends_in(..0.0, reasons::TUNNELLED, move |world| greatest(world, &others, |body| body.position[1])),
        ends_in(..6.4, reasons::CREPT, move |world| mean_speed(world, &bodies)),
        joined(scene, SECONDS, 3.2, reasons::STRETCHED),
    ])
}
