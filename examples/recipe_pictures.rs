//! Draws the pictures of the recipes of `twohalf-factories` into `docs/recipes`, or the folder that is named.
//!
//! `cargo run --release --example recipe_pictures`

use std::path::Path;

use examples::Result;
use examples::recipes::RECIPES;

fn main() -> Result<()> {
    let folder = std::env::args().nth(1).unwrap_or_else(|| "docs/recipes".to_owned());
    for recipe in RECIPES {
        recipe.save(Path::new(&folder))?;
    }
    println!("{} pictures in {folder}", RECIPES.len());
    Ok(())
}
