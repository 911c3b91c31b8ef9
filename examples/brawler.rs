//! A small beat-'em-up: walk, jump, punch, lift and throw, past a hole, a ball on a rope, a belt, a pond, a lift, a door and a press,
//! against thugs who chase.
//!
//! `cargo run --release --example brawler` lets a script play it, and writes an animation and a page of stills.

use std::path::Path;

use examples::brawler::{Brawler, Paint, RATE, SIZE, script};
use examples::{Recorder, Result};
use twohalf_render::SoftwareCanvas;

/// Where the pictures go, seen from where the program was started.
const FOLDER: &str = "target/brawler";

fn main() -> Result<()> {
    let mut game = Brawler::new()?;
    let recorder = Recorder {
        name: "brawler",
        size: SIZE,
        shrink: 2,
        steps_per_second: RATE,
        seconds: 27,
        stills: &[1.4, 4.1, 4.8, 6.2, 9.7, 17.6, 18.8, 23.0, 24.2],
    };
    let look = Paint::new()?;
    let sky = SoftwareCanvas::new(SIZE[0], SIZE[1])?;
    let step = |game: &mut Brawler| game.step(script(game));
    let summary =
        recorder.film(Path::new(FOLDER), &mut game, &sky, step, |game, canvas| look.draw(game, canvas))?;
    println!(
        "{} updates, {:.1} us each; {} points\n  animation: {}\n  stills:    {}",
        summary.steps,
        summary.mean_step.as_secs_f64() * 1e6,
        game.state.score,
        summary.animation.display(),
        summary.contact_sheet.display(),
    );
    Ok(())
}
