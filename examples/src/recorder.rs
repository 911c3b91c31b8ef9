//! Films a simulation: steps it, takes frames for an animation and stills for a contact sheet.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use twohalf_render::{Animation, Canvas, ContactSheet, SoftwareCanvas, Transform, View, draw_caption};

use crate::Result;

/// Frames per second of the animations.
const FRAME_RATE: u32 = 20;
/// Height of the text of [`draw_caption`], px.
const CAPTION: f32 = 32.0;

/// Films a simulation.
#[derive(Debug)]
pub struct Recorder {
    /// Begins the names of the files.
    pub name: &'static str,
    /// Width and height of the pictures in px.
    pub size: [u32; 2],
    /// How many times smaller the stills are, 1 or more.
    pub shrink: u32,
    /// Simulated steps per second.
    pub steps_per_second: u32,
    /// Length of the film in s.
    pub seconds: u32,
    /// Times in s of the stills, ascending.
    pub stills: &'static [f32],
}

/// Result of a film.
#[derive(Debug)]
pub struct Summary {
    /// The animation.
    pub animation: PathBuf,
    /// The stills on one page.
    pub contact_sheet: PathBuf,
    /// Number of steps.
    pub steps: u32,
    /// Mean time a step took.
    pub mean_step: Duration,
}

impl Recorder {
    /// Steps and draws a scene, and writes its animation and contact sheet into a folder. Every picture begins with `backdrop`.
    ///
    /// # Errors
    /// A file that cannot be written, or an error of `step` or `draw`.
    pub fn film<S>(
        &self,
        folder: &Path,
        scene: &mut S,
        backdrop: &SoftwareCanvas,
        step: impl Fn(&mut S) -> Result<()>,
        draw: impl Fn(&S, &mut dyn Canvas) -> Result<()>,
    ) -> Result<Summary> {
        let animation_path = folder.join(format!("{}.png", self.name));
        let sheet_path = folder.join(format!("{}_stills.png", self.name));
        let [width, height] = self.size;
        let frames = self.seconds * FRAME_RATE;
        let steps_per_frame = self.steps_per_second / FRAME_RATE;
        let mut animation =
            Animation::create(&animation_path, width, height, frames, (1000 / FRAME_RATE) as u16)?;
        let mut sheet = ContactSheet::new(3, self.shrink)?;
        let mut stills = self.stills.iter().peekable();
        let mut stepping = Duration::ZERO;
        for frame in 0..frames {
            let time = frame as f32 / FRAME_RATE as f32;
            let mut canvas = backdrop.clone();
            draw(scene, &mut canvas)?;
            if stills.next_if(|&&due| due <= time).is_some() {
                sheet.add(&canvas, format!("t = {time:.2} s"));
            }
            // In the lower left corner: games show their score at the top.
            let below = Transform::translation([0.0, height as f32 - CAPTION]);
            draw_caption(&mut View::new(&mut canvas).camera(&below), &format!("t = {time:.2} s"));
            animation.add_frame(&canvas)?;
            if frame % FRAME_RATE == 0 {
                eprint!("\r{}: {time:.0} of {} s", self.name, self.seconds);
                std::io::stderr().flush()?;
            }
            let start = Instant::now();
            (0..steps_per_frame).try_for_each(|_| step(scene))?;
            stepping += start.elapsed();
        }
        eprintln!("\r{}: {} s filmed", self.name, self.seconds);
        animation.finish()?;
        sheet.save_png(&sheet_path)?;
        let steps = frames * steps_per_frame;
        Ok(Summary {
            animation: animation_path,
            contact_sheet: sheet_path,
            steps,
            mean_step: stepping / steps,
        })
    }
}
