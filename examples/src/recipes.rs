//! The recipes of `twohalf-factories` as pictures: the same scenes, three moments of each.

mod scenes;
mod stage;

use std::path::Path;

use twohalf_render::{Canvas, Color, SoftwareCanvas, Sprite, SpriteBatch, Texture2D, draw_text};

use crate::Result;
use stage::RecipeStage;

/// Steps per second.
const RATE: f32 = 120.0;
/// Width and height of a moment's picture, px, and the gap between two.
const MOMENT: [u32; 2] = [216, 150];
const GAP: u32 = 4;

/// Makes a step of so many seconds.
type Step = Box<dyn FnMut(&mut RecipeStage, f32) -> Result<()>>;

/// A recipe of the documentation, and its picture.
pub struct Recipe {
    /// The anchor of its heading in the documentation, and the name of its picture.
    pub name: &'static str,
    /// Times of the three moments in s, ascending, with their captions.
    moments: [(f32, &'static str); 3],
    /// X of the middle of the picture in px.
    middle: f32,
    make: fn(&mut RecipeStage) -> Result<Step>,
}

/// All of them, in the order of the documentation.
pub const RECIPES: &[Recipe] = scenes::ALL;

impl Recipe {
    /// Plays it, and draws three moments side by side.
    ///
    /// # Errors
    /// A refusal of the engine: none with these scenes.
    pub fn draw(&self) -> Result<SoftwareCanvas> {
        let mut stage = RecipeStage::new(self.middle)?;
        let mut step = (self.make)(&mut stage)?;
        // Created objects enter.
        stage.simulator.update(0.0);
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

    /// Writes its picture into a folder, with fewer shades, so that the file is small.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn save(&self, folder: &Path) -> Result<()> {
        let picture = self.draw()?;
        let shades = picture.rgba8().into_iter().map(|channel| channel | 0b111).collect();
        let picture = Texture2D::from_rgba8(picture.width(), picture.height(), shades)?;
        Ok(picture.save_png(folder.join(format!("{}.png", self.name)))?)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The anchors of the headings of a page.
    fn anchors(page: &str) -> Vec<String> {
        let headings =
            page.lines().filter_map(|line| line.strip_prefix("# ")).filter(|line| !line.contains("= "));
        let letters = |heading: &str| {
            heading.chars().filter(|c| c.is_alphanumeric() || " -_".contains(*c)).collect::<String>()
        };
        headings.map(|heading| letters(heading).to_lowercase().replace(' ', "-")).collect()
    }

    #[test]
    fn every_recipe_of_the_documentation_has_a_small_picture_and_is_on_the_page_of_pictures() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
        let read = |name: &str| std::fs::read_to_string(root.join(name)).unwrap();
        let is_heading = |anchor: &String| RECIPES.iter().any(|recipe| recipe.name == anchor);
        let mut found = Vec::new();
        for page in ["recipes.md", "recipes_of_figures.md"] {
            let text = read(&format!("twohalf-factories/src/{page}"));
            // Lines of code that are hidden in the documentation begin as headings do.
            let parts = text.split("```").step_by(2).collect::<Vec<_>>().join("\n");
            found.extend(anchors(&parts));
        }
        found.extend(["a-camera-that-follows".to_owned()]);
        let missing: Vec<&String> = found.iter().filter(|anchor| !is_heading(anchor)).collect();
        assert!(missing.is_empty() && found.len() == RECIPES.len(), "{missing:?} of {found:?}");
        assert!(
            anchors(&read("twohalf-render/src/lib.rs").replace("//! ", "")).contains(&found[found.len() - 1])
        );
        let page = read("docs/recipes/README.md");
        for recipe in RECIPES {
            let size =
                std::fs::metadata(root.join(format!("docs/recipes/{}.png", recipe.name))).unwrap().len();
            assert!(size > 1_000 && size < 20_000, "{}: {size}", recipe.name);
            assert!(page.contains(&format!("({}.png)", recipe.name)), "{}", recipe.name);
        }
    }

    #[test]
    fn the_pictures_are_those_that_the_scenes_give() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/recipes");
        for recipe in RECIPES {
            let kept = Texture2D::load_png(root.join(format!("{}.png", recipe.name))).unwrap();
            let drawn = recipe.draw().unwrap();
            let shades: Vec<u8> = drawn.rgba8().into_iter().map(|channel| channel | 0b111).collect();
            let far = |(a, b): (&u8, &u8)| a.abs_diff(*b) > 24;
            let differing = kept.rgba8().iter().zip(&shades).filter(|pair| far(*pair)).count();
            // A changed picture is to be drawn again: `cargo run --release --example recipe_pictures`.
            assert!(
                differing < shades.len() / 50,
                "{}: {differing} of {} numbers",
                recipe.name,
                shades.len()
            );
        }
    }
}
