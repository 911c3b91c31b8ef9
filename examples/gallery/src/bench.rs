//! How long steps and pictures take.

use std::time::{Duration, Instant};

use examples::Result;
use twohalf_render::{Canvas, Color, SoftwareCanvas};

use crate::Layers;
use crate::play::Player;
use crate::scenes::GalleryScene;
use crate::state;

/// Frames per second of a game.
const FRAME_RATE: f64 = 60.0;
/// Number of pictures that are timed.
const PICTURES: u32 = 5;

/// Measurements of a scene.
#[derive(Debug, Clone)]
pub struct Figures {
    /// Its name.
    pub name: String,
    /// Number of bodies in all halves of the show.
    pub bodies: usize,
    /// Mean ms of a step.
    pub step: f64,
    /// Ms of the steps of a frame at 60 frames per second.
    pub frame: f64,
    /// Mean ms of a picture drawn in memory, 800 px wide.
    pub picture: f64,
}

/// Steps a scene for a number of simulated seconds, and draws it.
///
/// # Errors
/// An error of the scene.
pub fn bench(scene: &GalleryScene, seconds: f32) -> Result<Figures> {
    let mut show = scene.build()?;
    let steps = (seconds * show.rate() as f32).max(1.0) as u32;
    let start = Instant::now();
    (0..steps).try_for_each(|_| show.step(Player::Script))?;
    let step = ms(start.elapsed()) / f64::from(steps);
    let mut canvas = SoftwareCanvas::new(800, 500)?;
    let start = Instant::now();
    for _ in 0..PICTURES {
        canvas.clear(Color::BLACK);
        show.draw(&mut canvas, [[0.0; 2], [800.0, 500.0]], Layers::default())?;
    }
    let picture = ms(start.elapsed()) / f64::from(PICTURES);
    let bodies = show.halves().iter().map(|half| state::counts(half.play().world()).bodies).sum();
    let frame = step * f64::from(show.rate()) / FRAME_RATE;
    Ok(Figures { name: scene.name.clone(), bodies, step, frame, picture })
}

fn ms(time: Duration) -> f64 {
    time.as_secs_f64() * 1e3
}
