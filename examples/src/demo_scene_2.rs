//! Demo Scene 2 of the thesis, in 2D and in 2.5D: its initial state.

use farseer_core::math::scalar::sin;
use twohalf::DepthScheme;
use twohalf_render::{Canvas, Color, GroundBackdrop, draw_ground_backdrop};

use crate::{Plane, Result, Stage, Start, draw_hills};

/// Tilt of the slope in rad.
const TILT: f32 = 0.347;

/// A level platform at the left, a slope next to it, and objects that fall on them.
///
/// # Errors
/// None with these sizes.
pub fn plane() -> Result<Plane> {
    let mut plane = Plane::new()?;
    plane.add_platform([200.0, 28.0], [130.0, 270.0], 0.0)?;
    plane.add_platform([340.0, 24.0], [393.0, 335.0], TILT)?;
    for index in 0..8 {
        let i = index as f32;
        let radius = 20.0 + 6.0 * sin(i * 1.7);
        let x = 90.0 + 48.0 * i;
        plane.add_circle(radius, [x, 150.0 - 70.0 * (index % 4) as f32], [30.0 * sin(i * 1.3), 0.0])?;
    }
    let boxes = [([50.0, 40.0], [70.0, 90.0]), ([44.0, 44.0], [300.0, 60.0]), ([70.0, 36.0], [480.0, 200.0])];
    for (size, position) in boxes {
        plane.add_box(size, position, [0.0; 2])?;
    }
    for row in 0..3 {
        plane.add_box([44.0, 40.0], [690.0, 428.0 - 41.0 * row as f32], [0.0; 2])?;
    }
    Ok(plane)
}

/// Direction of the Z axis in degrees.
const ANGLE: i32 = 62;
/// Z of the horizon in px.
const HORIZON: f32 = 300.0;

const STARTS: &[Start] = &[
    // On the raised platform: balls that stay, that roll to the slope and down, off the front edge, off the left one.
    Start::ball(20.0, [150.0, 200.0, 180.0], [0.0; 3]),
    Start::ball(24.0, [95.0, 240.0, 130.0], [75.0, 0.0, 0.0]),
    Start::ball(17.0, [150.0, 190.0, 85.0], [0.0, 0.0, -45.0]),
    Start::ball(16.0, [80.0, 300.0, 165.0], [-40.0, 0.0, 0.0]),
    // Crates on it: one flat, one that tips over the left edge.
    Start::crate_box([54.0, 40.0], [80.0, 170.0, 80.0], [0.0; 3]),
    Start::crate_box([60.0, 34.0], [12.0, 230.0, 120.0], [0.0; 3]),
    // On the slope: balls that roll down, a crate that slides down, one that stays.
    Start::ball(22.0, [420.0, 160.0, 170.0], [0.0; 3]),
    Start::ball(18.0, [390.0, 230.0, 80.0], [0.0; 3]),
    Start::crate_box([44.0, 36.0], [260.0, 150.0, 85.0], [0.0; 3]).turned(TILT).with_friction(0.0),
    Start::crate_box([40.0, 36.0], [320.0, 180.0, 183.0], [0.0; 3]).turned(TILT).with_friction(0.9),
    // Thrown up the slope, rolls back.
    Start::ball(20.0, [660.0, 60.0, 120.0], [-300.0, 250.0, 0.0]),
    // Under the raised platform, against the front of the slope, and behind both.
    Start::ball(22.0, [20.0, 0.0, 110.0], [75.0, 0.0, 8.0]),
    Start::ball(20.0, [440.0, 0.0, 5.0], [0.0, 0.0, 80.0]),
    Start::ball(18.0, [200.0, 0.0, 245.0], [120.0, 0.0, 0.0]),
    // A stack of crates at the right, for objects that come down.
    Start::crate_box([50.0, 44.0], [590.0, 0.0, 165.0], [0.0; 3]),
    Start::crate_box([44.0, 40.0], [594.0, 44.0, 165.0], [0.0; 3]),
    Start::crate_box([46.0, 46.0], [680.0, 120.0, 60.0], [0.0; 3]).turned(0.4),
];

/// A raised level platform at the left, a slope next to it down to the ground, a hedge at the horizon, and falling objects.
///
/// # Errors
/// None with these sizes.
pub fn depth(scheme: DepthScheme, wants_debug_view: bool) -> Result<Stage> {
    let mut stage = Stage::new(ANGLE, scheme, wants_debug_view)?;
    stage.add_platform([190.0, 26.0, 150.0], [115.0, 112.0, 130.0], 0.0, Color::rgb(150, 122, 96))?;
    stage.add_platform([340.0, 22.0, 150.0], [369.0, 57.0, 130.0], TILT, Color::rgb(128, 138, 150))?;
    stage.add_platform([1100.0, 30.0, 20.0], [240.0, 0.0, HORIZON + 10.0], 0.0, Color::rgb(82, 128, 74))?;
    for start in STARTS {
        stage.add(start)?;
    }
    stage.begin();
    Ok(stage)
}

/// Draws the background of the scene in 2.5D: the ground, and the sky with hills above its horizon.
///
/// # Errors
/// None with this horizon.
pub fn draw_backdrop(canvas: &mut dyn Canvas) -> Result<()> {
    draw_ground_backdrop(canvas, &GroundBackdrop::new(HORIZON, ANGLE as f32))?;
    draw_hills(canvas, HORIZON);
    Ok(())
}
