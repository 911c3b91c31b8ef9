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

use crate::scenes::depth::DepthScene;
use crate::stability::StabilityFamily;

/// Scenes with depth of one kind, from easy to hard.
pub type DepthFamily = StabilityFamily<DepthScene>;

/// What all of them have in common: they end with the first step after their time.
const PLAIN: DepthFamily = DepthFamily { whole: f64::ceil, ..DepthFamily::PLAIN };

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
