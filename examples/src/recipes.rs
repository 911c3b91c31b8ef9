//! The recipes of `twohalf-factories` as pictures: the same scenes, three moments of each.

mod scenes;
mod stage;

use std::path::Path;

use twohalf_render::{Canvas, Color, SoftwareCanvas, Sprite, SpriteBatch, draw_text};

use crate::Result;
use stage::RecipeStage;

/// Steps per second.
const RATE: f32 = 120.0;
/// Width and height of a moment, px, and what is between two.
const MOMENT: [u32; 2] = [216, 150];
const GAP: u32 = 4;

/// What lets a scene go on by a step of so many seconds.
type Step = Box<dyn FnMut(&mut RecipeStage, f32) -> Result<()>>;

/// A recipe of the documentation, and its picture.
pub struct Recipe {
    /// The anchor of its heading in the documentation, and the name of its picture.
    pub name: &'static str,
    /// When the moments are that are shown, s, ascending, and what is said to them.
    moments: [(f32, &'static str); 3],
    /// X of the middle of the picture.
    middle: f32,
    make: fn(&mut RecipeStage) -> Result<Step>,
}

/// All of them, in the order of the documentation.
pub const RECIPES: &[Recipe] = scenes::ALL;

impl Recipe {
    /// Plays it, and draws three moments side by side.
    ///
    /// # Errors
    /// What the engine refuses: nothing, with these scenes.
    pub fn draw(&self) -> Result<SoftwareCanvas> {
        let mut stage = RecipeStage::new(self.middle)?;
        let mut step = (self.make)(&mut stage)?;
        let mut picture = SoftwareCanvas::new(3 * MOMENT[0] + 2 * GAP, MOMENT[1])?;
        picture.clear(Color::WHITE);
        let mut steps = 0;
        for (at, (seconds, caption)) in self.moments.into_iter().enumerate() {
            while (steps as f32) < seconds * RATE {
                step(&mut stage, 1.0 / RATE)?;
                steps += 1;
            }
            let mut moment = SoftwareCanvas::new(MOMENT[0], MOMENT[1])?;
            stage.draw(&mut moment)?;
            draw_text(&mut moment, caption, [6.0, 6.0], 1, Color::rgb(40, 44, 60));
            let left = (at as u32 * (MOMENT[0] + GAP)) as f32;
            let mut batch = SpriteBatch::begin();
            batch.draw(Sprite { origin: [0.0; 2], ..Sprite::new(&moment.to_texture()?, [left, 0.0]) });
            batch.end(&mut picture);
        }
        Ok(picture)
    }

    /// Writes its picture into a folder.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn save(&self, folder: &Path) -> Result<()> {
        Ok(self.draw()?.save_png(folder.join(format!("{}.png", self.name)))?)
    }
}
