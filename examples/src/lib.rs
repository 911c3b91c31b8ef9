//! Shared code of the example programs.

mod recorder;

pub use recorder::{Recorder, Summary};

use twohalf_render::{Color, RenderError, Sprite, SpriteBatch, Texture2D};

/// What an example can fail with.
pub type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

/// The paint of an object.
#[derive(Debug, Clone)]
pub struct Look {
    /// The picture that turns with the object.
    pub texture: Texture2D,
    /// Light that lies on it and does not turn.
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
