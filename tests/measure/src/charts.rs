//! Scenes of the chart: bodies, duration and measure of error of each.
//!
//! A scene whose number of bodies has no influence has one size. A tolerance is an error that a game would accept; each
//! scene states the reason. Errors are distances from closed forms, from invariants and from rest, never from a chaotic
//! path.

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

/// A scene of the chart, with the quantity that is measured as its error.
pub struct ChartScene<S = Scene> {
    /// Name of the scene, such as `box_stack_height`.
    pub name: &'static str,
    /// Description of the scene in one sentence.
    pub about: &'static str,
    /// Numbers of bodies with which the scene is run, rounded up to full rows where there are rows; 0 alone where size does
    /// not matter.
    pub sizes: &'static [usize],
    /// Builds the scene; the argument is the number of bodies.
    pub build: fn(usize) -> S,
    /// Simulated time of a run in s.
    pub seconds: f64,
    /// Creates the watch that measures the error in the scene.
    pub watch: fn(&S) -> Box<dyn Watch>,
    /// Name of the measured error, for the axis of the chart.
    pub error: &'static str,
    /// Unit of the error; empty for a count.
    pub unit: &'static str,
    /// Greatest error that a game would accept: a length, a percentage or a number, in the unit that the field `unit` names.
    pub tolerance: f64,
    /// Whether the scene is also run with methods that differ in the broad phase alone.
    pub broad_phases_matter: bool,
    /// Whether other engines are charted too. They are not if the error is the distance from the discrete law of our
    /// integrator: other integrators need not follow that law.
    pub peers_too: bool,
}

impl<S> ChartScene<S> {
    /// Returns the title, axis labels, sizes and tolerance of the chart of this scene.
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

/// Sizes of a scene whose number of bodies does not matter.
const ONE_SIZE: &[usize] = &[0];

/// Returns all 2D scenes of the chart, in order. New scenes are added here.
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
