//! Hashes of scenes after so many steps, to be compared between a window and a page.

use examples::Result;

use crate::play::{Player, World};
use crate::scenes::GalleryScene;
use crate::show::{Half, Show};
use crate::state;

/// Steps of a scene.
const STEPS: u32 = 600;
/// Steps of one with thousands of objects, and how many these are.
const FEW_STEPS: u32 = 60;
const MANY: usize = 5000;

/// What became of half a scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Hashed {
    /// `2D` or `2.5D`.
    pub engine: &'static str,
    /// The name of the set of methods.
    pub set: &'static str,
    /// Steps that were made: 600, or 60 if there are thousands of objects.
    pub steps: u32,
    /// The hash of its state.
    pub hash: u64,
}

impl Hashed {
    /// In words, after the name of the scene and the number of its half.
    pub fn line(&self, scene: &str, half: usize) -> String {
        let Hashed { engine, set, steps, hash } = self;
        format!("{scene} {half} {hash:016x} {engine} {set} {steps}")
    }
}

/// Plays a scene, and hashes its halves.
///
/// # Errors
/// What the scene fails with.
pub fn of(scene: &GalleryScene) -> Result<Vec<Hashed>> {
    let mut show = scene.build()?;
    let steps = if most_bodies(&show) > MANY { FEW_STEPS } else { STEPS };
    (0..steps).try_for_each(|_| show.step(Player::Script))?;
    let hashed = |half: &Half| {
        let world = half.play().world();
        let engine = match world {
            World::Plane(_) => "2D",
            World::Depth(_) => "2.5D",
        };
        Hashed { engine, set: half.set().name(), steps, hash: state::hash(world) }
    };
    Ok(show.halves().iter().map(hashed).collect())
}

fn most_bodies(show: &Show) -> usize {
    show.halves().iter().map(|half| state::counts(half.play().world()).bodies).max().unwrap_or(0)
}
