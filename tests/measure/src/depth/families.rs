//! Where methods fail in depth: families of scenes with a parameter that goes from easy to hard.
//!
//! In most families each of several objects does the same thing by itself, in a lane of its own: a ball and a box, or
//! at several phases of a step. All must do it.

mod above;
mod crowds;
mod edges;
mod gaps;
mod heads;
mod hits;
mod landings;
mod lanes;
mod shadows;
mod steps;

use super::DepthWatch;
use crate::depth_scenes::DepthScene;

/// Scenes of one kind, from easy to hard.
#[derive(Debug, Clone, Copy)]
pub struct DepthFamily {
    /// Such as "Land".
    pub name: &'static str,
    /// What there is, and what must happen.
    pub about: &'static str,
    /// What is varied.
    pub parameter: &'static str,
    /// Its unit; empty for a number of things.
    pub unit: &'static str,
    /// Its values, from easy to hard.
    pub values: &'static [f64],
    /// Some of them.
    pub quick_values: &'static [f64],
    /// Makes the scene for a value.
    pub build: fn(f64) -> DepthScene,
    /// Length of a run in s.
    pub seconds: fn(f64) -> f64,
    /// Makes what says how it went.
    pub judge: fn(f64) -> Box<DepthWatch>,
    /// What the judge measures.
    pub quantity: &'static str,
    /// Its unit.
    pub quantity_unit: &'static str,
}

/// All families: the one place to add one.
pub fn depth_families() -> Vec<DepthFamily> {
    [
        &landings::FAMILIES[..],
        &heads::FAMILIES,
        &edges::FAMILIES,
        &steps::FAMILIES,
        &gaps::FAMILIES,
        &shadows::FAMILIES,
        &above::FAMILIES,
        &hits::FAMILIES,
        &crowds::FAMILIES,
    ]
    .concat()
}
