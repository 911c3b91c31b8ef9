//! Limits of the 2.5D methods. A family is a list of scenes that differ in one parameter, which goes from easy to hard.
//!
//! Most families have several lanes: strips of the ground, each with one object that no other object meets. Lanes repeat
//! the test with a ball and a box, in several directions or at several phases of a step. A run succeeds if the object of
//! every lane does.

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

/// A family of 2.5D scenes: they differ in one parameter, which goes from easy to hard until methods fail.
pub type DepthFamily = StabilityFamily<DepthScene>;

/// Values that 2.5D families share. A run ends with the first step at or after its duration: the number of steps is rounded
/// up.
const PLAIN: DepthFamily = DepthFamily { whole: f64::ceil, ..DepthFamily::PLAIN };

/// Returns all families of 2.5D scenes, in the order of the stability map. New families are added here.
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
