//! Demo Scene 2 of the thesis (4.2), both ways: objects that fall on two platforms, one raised and level, one a slope next to
//! it. It runs in 2D with Farseer's engine, and in 2.5D, where the platforms have depth and shadows.
//!
//! `cargo run --release --example demo_scene_2` writes an animation and a page of stills of each; with `-- --debug` the debug
//! view is drawn over the pictures in 2.5D.

use std::path::{Path, PathBuf};

use examples::{Plane, RATE, Recorder, Result, SIZE, Stage, demo_scene_2, report, wants_debug_view};
use twohalf::DepthScheme;
use twohalf_render::SoftwareCanvas;

/// Folder of the pictures, relative to the working directory.
const FOLDER: &str = "target/demo_scene_2";

fn main() -> Result<()> {
    let wants_debug_view = wants_debug_view()?;
    let folder = PathBuf::from(FOLDER);
    let plane = film_2d(&folder)?;
    let depth = film_2_5d(&folder, wants_debug_view)?;
    println!("{plane}\n\n{depth}");
    Ok(())
}

fn film_2d(folder: &Path) -> Result<String> {
    let mut scene = demo_scene_2::plane()?;
    let mut backdrop = SoftwareCanvas::new(SIZE[0], SIZE[1])?;
    scene.draw_backdrop(&mut backdrop);
    let recorder = Recorder {
        name: "demo_scene_2_2d",
        size: SIZE,
        shrink: 2,
        steps_per_second: RATE,
        seconds: 6,
        stills: &[0.0, 0.7, 1.4, 2.1, 3.5, 5.9],
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
    let end =
        format!("{lying} of {all} objects on the floor at the end, others on platforms or on top of these");
    Ok(report("2D, the Farseer engine:", &summary, scene.bodies(), scene.most_contacts(), &end))
}

fn film_2_5d(folder: &Path, wants_debug_view: bool) -> Result<String> {
    let mut backdrop = SoftwareCanvas::new(SIZE[0], SIZE[1])?;
    demo_scene_2::draw_backdrop(&mut backdrop)?;
    let recorder = Recorder {
        name: "demo_scene_2_2_5d",
        size: SIZE,
        shrink: 2,
        steps_per_second: RATE,
        seconds: 6,
        stills: &[0.0, 0.6, 1.2, 1.8, 3.0, 5.9],
    };
    let mut stage = demo_scene_2::depth(DepthScheme::default(), wants_debug_view)?;
    let step = |stage: &mut Stage| {
        stage.step();
        Ok(())
    };
    let summary = recorder.film(folder, &mut stage, &backdrop, step, |stage, canvas| {
        stage.draw(canvas);
        Ok(())
    })?;
    let [on_ground, on_platforms, all] = stage.at_rest();
    let end =
        format!("of {all} objects {on_ground} lie on the ground at the end, {on_platforms} on a platform");
    Ok(report("2.5D:", &summary, all, stage.most_contacts(), &end))
}
