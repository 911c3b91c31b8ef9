//! Hashes of scenes after so many steps, to be compared between a window and a page.

use examples::Result;

use crate::play::{Player, Set};
use crate::scenes::GalleryScene;
use crate::state;

/// Steps of a scene.
pub const STEPS: u32 = 600;
/// Steps of one with thousands of objects.
const FEW_STEPS: u32 = 60;
/// Objects of which there are thousands.
const MANY: usize = 5000;

/// A line for each half of a scene: its name, what it is computed with, and the hash of its state after [`STEPS`] steps (60 if
/// there are thousands of objects).
///
/// # Errors
/// What the scene fails with.
pub fn lines(scene: &GalleryScene) -> Result<Vec<String>> {
    let mut show = scene.build()?;
    let bodies = |show: &crate::show::Show| {
        show.halves().iter().map(|half| state::counts(half.play().world()).bodies).max().unwrap_or(0)
    };
    let steps = if bodies(&show) > MANY { FEW_STEPS } else { STEPS };
    (0..steps).try_for_each(|_| show.step(Player::Script))?;
    let line = |half: &crate::show::Half| {
        let world = half.play().world();
        let engine = match world {
            crate::play::World::Plane(_) => "2D",
            crate::play::World::Depth(_) => "2.5D",
        };
        let set = if half.set() == Set::Precise { "precise" } else { "faithful" };
        format!("{} {engine} {set} {steps} {:016x}", scene.name, state::hash(world))
    };
    Ok(show.halves().iter().map(line).collect())
}
