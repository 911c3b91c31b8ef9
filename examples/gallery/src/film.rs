//! Films of scenes, drawn in memory.

use std::path::{Path, PathBuf};

use examples::Result;
use twohalf_render::{Animation, Canvas, Color, ContactSheet, SoftwareCanvas, Text};

use crate::Layers;
use crate::play::Player;
use crate::scenes::GalleryScene;
use crate::show::Show;

/// Frames per second.
const FRAME_RATE: u32 = 20;
/// Number of stills on a contact sheet.
const STILLS: u32 = 9;
/// Sizes that a film may have, px.
const SIZES: std::ops::RangeInclusive<u32> = 100..=4000;

/// Options of a film.
#[derive(Debug, Clone)]
pub struct Film {
    /// Simulated time in s, greater than 0.
    pub seconds: f32,
    /// The file of the animation; the contact sheet goes beside it, with `_stills` in its name.
    pub out: PathBuf,
    /// Largest side in px, 100 to 4000; a scene that is smaller is shown as it is.
    pub largest: u32,
    /// Layers of engine data that are drawn.
    pub layers: Layers,
}

/// The files that were written.
#[derive(Debug, Clone)]
pub struct Filmed {
    /// The animation.
    pub animation: PathBuf,
    /// The stills on one page.
    pub stills: PathBuf,
    /// Frames of the animation.
    pub frames: u32,
}

impl Film {
    /// Steps and draws a scene; after each frame `tell` gets the number of frames that are done and of all.
    ///
    /// # Errors
    /// A time that is not greater than 0 or more than an hour, a size out of range, a file that cannot be written, and an error
    /// of the scene.
    pub fn film(&self, scene: &GalleryScene, mut tell: impl FnMut(u32, u32)) -> Result<Filmed> {
        if !(self.seconds > 0.0 && self.seconds <= 3600.0) {
            return Err(
                format!("{} seconds: greater than 0, at most 3600, can be filmed", self.seconds).into()
            );
        }
        if !SIZES.contains(&self.largest) {
            return Err(format!("{} px: the largest side of a film is 100 to 4000 px", self.largest).into());
        }
        let mut show = scene.build()?;
        let frames = (self.seconds * FRAME_RATE as f32).ceil() as u32;
        let mut canvas = canvas_for(&show, self.largest)?;
        let [width, height] = canvas.size();
        let mut animation = Animation::create(&self.out, width, height, frames, (1000 / FRAME_RATE) as u16)?;
        let mut sheet = ContactSheet::new(3, (width / 300).clamp(1, 64))?;
        for frame in 0..frames {
            draw(&show, &mut canvas, self.layers)?;
            let time = frame as f32 / FRAME_RATE as f32;
            let still = |frame: u32| frame * STILLS / frames;
            if frame == 0 || still(frame) != still(frame - 1) {
                sheet.add(&canvas, format!("t = {time:.2} s"));
            }
            // The upper corners have labels.
            Text::new(format!("t = {time:.2} s"), [6.0, height as f32 - 14.0]).draw(&mut canvas);
            animation.add_frame(&canvas)?;
            tell(frame + 1, frames);
            // Steps that are due by the next frame; rates need not be multiples of that of the frames.
            let due = |frame: u32| u64::from(frame) * u64::from(show.rate()) / u64::from(FRAME_RATE);
            (due(frame)..due(frame + 1)).try_for_each(|_| show.step(Player::Script))?;
        }
        animation.finish()?;
        let stills = beside(&self.out);
        sheet.save_png(&stills)?;
        Ok(Filmed { animation: self.out.clone(), stills, frames })
    }
}

/// A picture of a scene after some seconds, `width` px wide.
///
/// # Errors
/// A width out of range, and an error of the scene.
pub fn picture(scene: &GalleryScene, seconds: f32, width: u32) -> Result<SoftwareCanvas> {
    let mut show = scene.build()?;
    let steps = (seconds * show.rate() as f32) as u32;
    (0..steps).try_for_each(|_| show.step(Player::Script))?;
    let mut canvas = SoftwareCanvas::new(width, width * 5 / 8)?;
    draw(&show, &mut canvas, Layers::default())?;
    Ok(canvas)
}

fn draw(show: &Show, canvas: &mut SoftwareCanvas, layers: Layers) -> Result<()> {
    canvas.clear(Color::BLACK);
    let size = canvas.size().map(|side| side as f32);
    show.draw(canvas, [[0.0; 2], size], layers)
}

/// A canvas of the size of the scene, up to a limit.
fn canvas_for(show: &Show, largest: u32) -> Result<SoftwareCanvas> {
    let [width, height] = show.size();
    let zoom = (largest as f32 / width.max(height)).min(1.0);
    let [width, height] = [width, height].map(|side| (zoom * side).round().max(1.0) as u32);
    Ok(SoftwareCanvas::new(width, height)?)
}

fn beside(out: &Path) -> PathBuf {
    let stem = out.file_stem().map_or_else(|| "film".into(), |stem| stem.to_string_lossy());
    out.with_file_name(format!("{stem}_stills.png"))
}
