//! Shared code of the example programs.

pub mod brawler;
pub mod demo_scene_1;
pub mod demo_scene_2;
pub mod pinball;
mod plane;
pub mod recipes;
mod recorder;
mod sample_film;
mod sample_picture;
mod scenery;
mod stage;

pub use plane::Plane;
pub use recorder::{Recorder, Summary};
pub use sample_film::SampleFilm;
pub use sample_picture::{draw_joint, draw_sample, draw_spring};
pub use scenery::draw_hills;
pub use stage::{Shape, Stage, Start};

use twohalf_render::{Color, RenderError, Sprite, SpriteBatch, Texture2D};

/// Result with any error of an example.
pub type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

/// Steps per second of all scenes.
pub const RATE: u32 = 120;
/// Size of the pictures in px.
pub const SIZE: [u32; 2] = [800, 500];
/// Downward, px/s².
pub const GRAVITY: f32 = 500.0;

/// Whether the program was started with `--debug`.
///
/// # Errors
/// Any other argument.
pub fn wants_debug_view() -> Result<bool> {
    let mut wants = false;
    for argument in std::env::args().skip(1) {
        if argument != "--debug" {
            return Err(format!("unknown argument {argument}; there is only --debug").into());
        }
        wants = true;
    }
    Ok(wants)
}

/// The paint of an object.
#[derive(Debug, Clone)]
pub struct Look {
    /// The picture that turns with the object.
    pub texture: Texture2D,
    /// Light on its surface that does not turn with it.
    pub light: Option<Texture2D>,
}

impl Look {
    /// A beach ball of this radius in px.
    ///
    /// # Errors
    /// A radius out of range.
    pub fn ball(radius: f32, color: Color) -> std::result::Result<Self, RenderError> {
        let diameter = (2.0 * radius).round() as u32;
        Ok(Look { texture: Texture2D::ball(diameter, color)?, light: Some(Texture2D::ball_light(diameter)?) })
    }

    /// A crate of this width and height in px.
    ///
    /// # Errors
    /// A size out of range.
    pub fn crate_box(width: f32, height: f32, color: Color) -> std::result::Result<Self, RenderError> {
        let texture = Texture2D::crate_box(width.round() as u32, height.round() as u32, color)?;
        Ok(Look { texture, light: None })
    }

    /// Adds the light of an object that is drawn at a position, after the object itself.
    pub fn draw_light(&self, batch: &mut SpriteBatch, position: [f32; 2], layer_depth: f32) {
        if let Some(light) = &self.light {
            batch.draw(Sprite { layer_depth, ..Sprite::centered(light, position) });
        }
    }
}

/// Red, blue, green, yellow, violet and so on, by number.
pub fn palette(index: usize) -> Color {
    const COLORS: [Color; 6] = [
        Color::rgb(206, 52, 46),
        Color::rgb(42, 110, 190),
        Color::rgb(40, 150, 80),
        Color::rgb(226, 160, 36),
        Color::rgb(134, 70, 160),
        Color::rgb(30, 150, 160),
    ];
    COLORS[index % COLORS.len()]
}

/// A colour of wood, by number.
pub fn wood(index: usize) -> Color {
    const WOODS: [Color; 3] = [Color::rgb(186, 130, 70), Color::rgb(160, 100, 52), Color::rgb(204, 154, 96)];
    WOODS[index % WOODS.len()]
}

/// The result of a film, in words.
pub fn report(
    title: &str,
    summary: &Summary,
    bodies: usize,
    most_contacts: usize,
    at_the_end: &str,
) -> String {
    format!(
        "{title}\n  {} steps of 1/{RATE} s, {bodies} bodies, up to {most_contacts} contact points at a time, \
         {:.1} us per step\n  {at_the_end}\n  animation: {}\n  stills:    {}",
        summary.steps,
        summary.mean_step.as_secs_f64() * 1e6,
        summary.animation.display(),
        summary.contact_sheet.display(),
    )
}
