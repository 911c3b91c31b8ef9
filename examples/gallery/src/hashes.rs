//! Hashes of scenes after a number of steps, for comparison between a window and a page.

use examples::Result;

use crate::play::{Player, World};
use crate::scenes::GalleryScene;
use crate::show::Half;
use crate::state;

/// Steps of a scene.
const STEPS: u32 = 600;
/// Steps of one with thousands of objects, and how many these are.
const FEW_STEPS: u32 = 60;
const MANY: usize = 5000;

/// Hash of half a scene with a set of methods.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Hashed {
    /// `2D` or `2.5D`.
    pub engine: &'static str,
    /// The name of the set.
    pub set: &'static str,
    /// Steps that were made: 600, or 60 if there are thousands of objects.
    pub steps: u32,
    /// The hash of its state.
    pub hash: u64,
}

impl Hashed {
    /// In words, after the name of the scene and a number.
    pub fn line(&self, scene: &str, number: usize) -> String {
        let Hashed { engine, set, steps, hash } = self;
        format!("{scene} {number} {hash:016x} {engine} {set} {steps}")
    }
}

/// Plays each half of a scene from its start with each set that it has, but none twice, and hashes its state.
///
/// # Errors
/// An error of the scene.
pub fn of(scene: &GalleryScene) -> Result<Vec<Hashed>> {
    let mut all: Vec<Hashed> = Vec::new();
    for half in scene.build()?.halves() {
        for mut half in half.with_each_set()? {
            let (engine, set) = (engine_of(&half), half.set().name());
            if all.iter().any(|hashed| (hashed.engine, hashed.set) == (engine, set)) {
                continue;
            }
            let bodies = state::counts(half.play().world()).bodies;
            let steps = if bodies > MANY { FEW_STEPS } else { STEPS };
            (0..steps).try_for_each(|_| half.step(Player::Script))?;
            all.push(Hashed { engine, set, steps, hash: state::hash(half.play().world()) });
        }
    }
    Ok(all)
}

fn engine_of(half: &Half) -> &'static str {
    match half.play().world() {
        World::Plane(_) => "2D",
        World::Depth(_) => "2.5D",
    }
}
