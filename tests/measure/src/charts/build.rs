//! What the scenes of the charts have in common.

use crate::scenes::stage::Stage;
use conformance::scene::Scene;
use farseer_core::math::Vector2;

/// Gravity in px/s²: 10 m/s² where 32 px are a metre.
pub(super) const GRAVITY: f64 = crate::scenes::stage::GRAVITY as f64;

/// How deep things that rest on each other are put into each other at the start, in px: so that they touch in
/// the first step, and less than every engine leaves alone.
pub(super) const PRESS: f64 = 0.02;

/// An empty scene under gravity, without drag.
pub(super) fn stage(name: impl Into<String>) -> Stage {
    Stage::new().named(name).without_drag()
}

/// An empty scene without gravity and drag.
pub(super) fn weightless(name: impl Into<String>) -> Stage {
    Stage::without_gravity().named(name).without_drag()
}

/// Adds a static slab 40 px thick whose upper side goes through the origin at an angle, down to the right.
pub(super) fn ground(stage: &mut Stage, length: f64, angle: f64) {
    const THICKNESS: f64 = 40.0;
    stage.wall(on_slope(angle, 0.0, -THICKNESS / 2.0), [length, THICKNESS]);
    stage.last().rotation = Some(angle as f32);
    // Left alone, the grid's cells are made from the box around the turned slab, and come out as coarse as it is thick.
    stage.last_geom().collision_grid_size = Some(4.0);
}

/// The place that lies so far down a slope through the origin and so far above it.
pub(super) fn on_slope(angle: f64, down: f64, above: f64) -> [f64; 2] {
    let (sine, cosine) = angle.sin_cos();
    [down * cosine + above * sine, down * sine - above * cosine]
}

/// The number of rows of a triangle with 1, 2, 3, ... things in its rows that holds at least so many.
pub(super) fn rows_of_triangle(count: usize) -> usize {
    (1..).find(|rows| rows * (rows + 1) / 2 >= count).unwrap_or(1)
}

/// Where a body of a scene starts, in px.
pub(super) fn start(scene: &Scene, index: usize) -> [f64; 2] {
    let position = scene.bodies[index].position.unwrap_or_else(Vector2::zeros);
    [f64::from(position.x), f64::from(position.y)]
}
