//! A small pinball table: flippers on springs, bumpers, lights that are sensors, a ramp that is another collision category, and
//! a score. A script plays it by the position of the ball.
//!
//! `cargo run --release --example pinball` writes an animation and a page of stills.

use std::path::Path;

use examples::pinball::{self, Pinball, RATE, TABLE};
use examples::{Recorder, Result};
use twohalf_render::{Canvas, SoftwareCanvas};

/// Folder of the pictures, relative to the working directory.
const FOLDER: &str = "target/pinball";
const SECONDS: u32 = 24;

fn main() -> Result<()> {
    let mut table = Pinball::new()?;
    let recorder = Recorder {
        name: "pinball",
        size: TABLE.map(|side| side as u32),
        shrink: 2,
        steps_per_second: RATE,
        seconds: SECONDS,
        stills: &[0.5, 1.5, 4.0, 8.0, 14.0, 23.9],
    };
    let mut backdrop = SoftwareCanvas::new(recorder.size[0], recorder.size[1])?;
    backdrop.clear(pinball::FELT);
    let summary =
        recorder.film(Path::new(FOLDER), &mut table, &backdrop, pinball::play, |table, canvas| {
            pinball::draw(table, canvas);
            Ok(())
        })?;
    let game = table.game();
    println!(
        "{} updates, {:.1} us each; {} points, {} times over the ramp, {} balls left\n  animation: {}\n  stills:    {}",
        summary.steps,
        summary.mean_step.as_secs_f64() * 1e6,
        game.score,
        game.ramps,
        game.balls,
        summary.animation.display(),
        summary.contact_sheet.display(),
    );
    Ok(())
}
