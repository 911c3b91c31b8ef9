//! The scenes of the chart: what is built, for how long it runs, and what counts as error.
//!
//! Where size does not matter a scene has its one size. Tolerances are what a game would accept; each says why.
//! No scene is judged by the path that things take in chaos: only by closed forms, invariants and rest.

mod bounce;
mod build;
mod flight;
mod hits;
mod incline;
mod invariants;
mod masonry;
mod piles;
mod resting;
mod settled;
mod signals;
mod springs;
mod stacks;
mod swing;

use super::sweep::Subject;
use super::watch::Watch;
use conformance::scene::Scene;

/// A scene of the chart, with what is measured in it.
pub struct ChartScene<S = Scene> {
    /// Such as `box_stack_height`.
    pub name: &'static str,
    /// One sentence.
    pub about: &'static str,
    /// Numbers of bodies, rounded up to whole rows where there are rows; 0 alone where size does not matter.
    pub sizes: &'static [usize],
    /// Makes the scene of a size.
    pub build: fn(usize) -> S,
    /// Simulated time in s.
    pub seconds: f64,
    /// Makes what watches the scene.
    pub watch: fn(&S) -> Box<dyn Watch>,
    /// What the error is, for the axis.
    pub error: &'static str,
    /// Its unit.
    pub unit: &'static str,
    /// The error a game would accept.
    pub tolerance: f64,
    /// Whether the broad phases are compared too.
    pub broad_phases_matter: bool,
    /// Whether other engines are charted too. Not where the error is the distance to a law that is that of our
    /// integrator alone: what steps in another way is none the worse for not following it.
    pub peers_too: bool,
}

impl<S> ChartScene<S> {
    /// What a chart says of it.
    pub fn subject(&self) -> Subject {
        Subject {
            name: self.name,
            about: self.about,
            sizes: self.sizes.to_vec(),
            error: self.error,
            unit: self.unit,
            tolerance: self.tolerance,
        }
    }
}

copied!(ChartScene);

/// The sizes of a scene that has only one.
const ONE_SIZE: &[usize] = &[0];

/// All scenes of the chart: the one place to add one.
pub fn chart_scenes() -> Vec<ChartScene> {
    let kinds = [
        flight::scenes(),
        bounce::scenes(),
        incline::scenes(),
        swing::scenes(),
        springs::scenes(),
        hits::scenes(),
        stacks::scenes(),
        masonry::scenes(),
        piles::scenes(),
    ];
    kinds.into_iter().flatten().collect()
}
