//! Building blocks that the charts' scenes share.

use crate::scenes::stage::Stage;
use conformance::scene::Scene;
use farseer_core::math::Vector2;

/// Acceleration of gravity in px/s², downwards: 10 m/s², where 32 px are a metre.
pub(super) const GRAVITY: f64 = crate::scenes::stage::GRAVITY as f64;

/// Initial overlap in px of bodies that rest on each other, so that they touch in the first step. It is less than the slop of
/// every engine.
pub(super) const PRESS: f64 = 0.02;

/// Returns an empty scene with gravity and without drag.
pub(super) fn stage(name: impl Into<String>) -> Stage {
    Stage::new().named(name).without_drag()
}

/// Returns an empty scene without gravity and without drag.
pub(super) fn weightless(name: impl Into<String>) -> Stage {
    Stage::without_gravity().named(name).without_drag()
}

/// Adds a static slab 40 px thick, `length` px long. Its upper side goes through the origin and falls to the right at `angle`
/// radians.
pub(super) fn ground(stage: &mut Stage, length: f64, angle: f64) {
    const THICKNESS: f64 = 40.0;
    stage.wall(on_slope(angle, 0.0, -THICKNESS / 2.0), [length, THICKNESS]);
    stage.last().rotation = Some(angle as f32);
    // By default, the cells of the distance grid are sized by the bounding box of the rotated slab, and would be as coarse as
    // the slab is thick.
    stage.last_geom().collision_grid_size = Some(4.0);
}

/// Returns the position in px that is `down` px along a slope through the origin and `above` px from the slope, along the
/// normal. `angle` is the slope in radians, falling to the right.
pub(super) fn on_slope(angle: f64, down: f64, above: f64) -> [f64; 2] {
    let (sine, cosine) = angle.sin_cos();
    [down * cosine + above * sine, down * sine - above * cosine]
}

/// Returns the least number of rows of a triangle, with 1, 2, 3, ... bodies in its rows, that holds at least `count` bodies.
pub(super) fn rows_of_triangle(count: usize) -> usize {
    (1..).find(|rows| rows * (rows + 1) / 2 >= count).unwrap_or(1)
}

/// Returns the initial position (x, y) of a body of a scene in px.
pub(super) fn start(scene: &Scene, index: usize) -> [f64; 2] {
    let position = scene.bodies[index].position.unwrap_or_else(Vector2::zeros);
    [f64::from(position.x), f64::from(position.y)]
}
