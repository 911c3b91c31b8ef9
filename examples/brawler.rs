//! A small beat-'em-up: walk, jump, punch, lift and throw, past a hole, a ball on a rope, a belt, a pond, a lift, a door and a
//! press, against thugs who chase.
//!
//! `cargo run --release --example brawler` lets a script play it, and writes an animation and a page of stills.

use std::path::Path;

use examples::brawler::{Brawler, Paint, RATE, SIZE, script};
use examples::{Recorder, Result};
use twohalf_render::SoftwareCanvas;

fn main() -> Result<()> {
    let mut game = Brawler::new()?;
    let recorder = Recorder {
        name: "brawler",
        size: SIZE,
        shrink: 2,
        steps_per_second: RATE,
        seconds: 27,
        stills: &[1.4, 4.3, 5.6, 6.8, 9.7, 17.6, 18.3, 20.8, 23.6],
    };
    let (look, sky) = (Paint::new()?, SoftwareCanvas::new(SIZE[0], SIZE[1])?);
    let step = |game: &mut Brawler| game.step(script(game));
    let folder = Path::new("target/brawler");
    let summary = recorder.film(folder, &mut game, &sky, step, |game, canvas| look.draw(game, canvas))?;
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
