//! Demo Scene 1 of the thesis (4.1), both ways: objects that fall on a floor in 2D with Farseer's engine, and on
//! a ground with depth, each with its shadow, in 2.5D.
//!
//! `cargo run --release --example demo_scene_1` writes an animation and a page of stills of each; with `-- --debug` the
//! debug view is drawn over the pictures in 2.5D.

use std::path::{Path, PathBuf};

use examples::{Plane, RATE, Recorder, Result, SIZE, Stage, Start, report, wants_debug_view};
use twohalf_render::{GroundBackdrop, SoftwareCanvas, draw_ground_backdrop};

/// Where the pictures go, seen from where the program was started.
const FOLDER: &str = "target/demo_scene_1";

fn main() -> Result<()> {
    let wants_debug_view = wants_debug_view()?;
    let folder = PathBuf::from(FOLDER);
    let plane = film_2d(&folder)?;
    let depth = film_2_5d(&folder, wants_debug_view)?;
    println!("{plane}\n\n{depth}");
    Ok(())
}

/// Circles above a floor.
fn plane() -> Result<Plane> {
    let mut plane = Plane::new()?;
    for index in 0..12 {
        let i = index as f32;
        let radius = 22.0 + 7.0 * (i * 1.7).sin();
        let column = (index * 5) % 12;
        let x = 110.0 + 52.0 * column as f32 + 9.0 * (i * 2.3).cos();
        plane.add_circle(radius, [x, 300.0 - 50.0 * i], [40.0 * (i * 1.3).sin(), 0.0])?;
    }
    Ok(plane)
}

fn film_2d(folder: &Path) -> Result<String> {
    let mut scene = plane()?;
    let mut backdrop = SoftwareCanvas::new(SIZE[0], SIZE[1])?;
    scene.draw_backdrop(&mut backdrop);
    let recorder = Recorder {
        name: "demo_scene_1_2d",
        size: SIZE,
        shrink: 2,
        steps_per_second: RATE,
        seconds: 6,
        stills: &[0.0, 0.6, 1.2, 1.8, 3.0, 5.9],
    };
    let step = |scene: &mut Plane| {
        scene.step();
        Ok(())
    };
    let summary = recorder.film(folder, &mut scene, &backdrop, step, |scene, canvas| {
        scene.draw(canvas);
        Ok(())
    })?;
    let (lying, all) = scene.on_the_floor();
    let end = format!("{lying} of {all} circles on the floor at the end");
    Ok(report("2D, the Farseer engine:", &summary, scene.bodies(), scene.most_contacts(), &end))
}

/// Direction of the Z axis in degrees.
const ANGLE: i32 = 62;
/// Z of the horizon.
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

fn depth(wants_debug_view: bool) -> Result<Stage> {
    let mut stage = Stage::new(ANGLE, wants_debug_view)?;
    for start in STARTS {
        stage.add(start)?;
    }
    stage.begin();
    Ok(stage)
}

fn film_2_5d(folder: &Path, wants_debug_view: bool) -> Result<String> {
    let mut backdrop = SoftwareCanvas::new(SIZE[0], SIZE[1])?;
    draw_ground_backdrop(&mut backdrop, &GroundBackdrop::new(HORIZON, ANGLE as f32))?;
    let recorder = Recorder {
        name: "demo_scene_1_2_5d",
        size: SIZE,
        shrink: 2,
        steps_per_second: RATE,
        seconds: 5,
        stills: &[0.0, 0.5, 1.0, 1.5, 2.5, 4.9],
    };
    let mut stage = depth(wants_debug_view)?;
    let step = |stage: &mut Stage| {
        stage.step();
        Ok(())
    };
    let summary = recorder.film(folder, &mut stage, &backdrop, step, |stage, canvas| {
        stage.draw(canvas);
        Ok(())
    })?;
    let [on_ground, _, all] = stage.at_rest();
    let end = format!("{on_ground} of {all} objects lie on the ground at the end, others on top of these");
    Ok(report("2.5D:", &summary, all, stage.most_contacts(), &end))
}
