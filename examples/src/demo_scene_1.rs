//! Demo Scene 1 of the thesis, in 2D and in 2.5D: its initial state.

use farseer_core::math::scalar::{cos, sin};
use twohalf::DepthScheme;
use twohalf_render::{Canvas, GroundBackdrop, draw_ground_backdrop};

use crate::{Plane, Result, Stage, Start};

/// Circles above a floor.
///
/// # Errors
/// None with these sizes.
pub fn plane() -> Result<Plane> {
    let mut plane = Plane::new()?;
    for index in 0..12 {
        let i = index as f32;
        let radius = 22.0 + 7.0 * sin(i * 1.7);
        let column = (index * 5) % 12;
        let x = 110.0 + 52.0 * column as f32 + 9.0 * cos(i * 2.3);
        plane.add_circle(radius, [x, 300.0 - 50.0 * i], [40.0 * sin(i * 1.3), 0.0])?;
    }
    Ok(plane)
}

/// Direction of the Z axis in degrees.
const ANGLE: i32 = 62;
/// Z of the horizon in px.
const HORIZON: f32 = 300.0;

const STARTS: &[Start] = &[
    // A stack of crates far behind, with a ball that falls on its edge.
    Start::crate_box([64.0, 56.0], [70.0, 20.0, 215.0], [0.0; 3]),
    Start::crate_box([56.0, 48.0], [74.0, 130.0, 215.0], [0.0; 3]).turned(0.473),
    Start::ball(22.0, [88.0, 330.0, 215.0], [0.0; 3]),
    // Balls at three depths, falling.
    Start::ball(34.0, [150.0, 260.0, 72.0], [0.0; 3]),
    Start::ball(28.0, [330.0, 200.0, 130.0], [15.0, 0.0, 0.0]),
    Start::ball(24.0, [430.0, 320.0, 235.0], [-10.0, 0.0, 0.0]),
    // Two that run into each other at one depth, and one that passes in front of them.
    Start::ball(26.0, [255.0, 0.0, 95.0], [120.0, 160.0, 0.0]),
    Start::ball(26.0, [520.0, 0.0, 95.0], [-120.0, 160.0, 0.0]),
    Start::ball(20.0, [40.0, 30.0, 12.0], [170.0, 140.0, 0.0]),
    // Thrown into the picture and out of it.
    Start::ball(26.0, [580.0, 20.0, 20.0], [-10.0, 300.0, 60.0]),
    Start::ball(24.0, [300.0, 60.0, 270.0], [40.0, 200.0, -70.0]),
    Start::crate_box([44.0, 44.0], [560.0, 0.0, 150.0], [50.0, 240.0, 60.0]).turned(0.44),
    // Crates that fall on a corner and on each other.
    Start::crate_box([90.0, 50.0], [620.0, 180.0, 65.0], [0.0; 3]).turned(-0.362),
    Start::crate_box([50.0, 50.0], [600.0, 330.0, 65.0], [0.0; 3]).turned(-0.21),
    Start::crate_box([70.0, 44.0], [450.0, 120.0, 170.0], [-25.0, 0.0, 0.0]).turned(0.5),
];

/// Balls and crates that fall on a ground with depth.
///
/// # Errors
/// None with these sizes.
pub fn depth(scheme: DepthScheme, wants_debug_view: bool) -> Result<Stage> {
    let mut stage = Stage::new(ANGLE, scheme, wants_debug_view)?;
    for start in STARTS {
        stage.add(start)?;
    }
    stage.begin();
    Ok(stage)
}

/// Draws the background of the scene in 2.5D: the ground, and the sky above its horizon.
///
/// # Errors
/// None with this horizon.
pub fn draw_backdrop(canvas: &mut dyn Canvas) -> Result<()> {
    draw_ground_backdrop(canvas, &GroundBackdrop::new(HORIZON, ANGLE as f32))?;
    Ok(())
}
