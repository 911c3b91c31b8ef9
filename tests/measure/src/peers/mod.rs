//! The same scenes in this engine and in `rapier3d` (behind the feature `peers`), seen alike: for the comparison of
//! what they do.

pub mod closed_forms;
#[cfg(feature = "peers")]
mod comparison;
mod ours;
#[cfg(feature = "peers")]
mod rapier;
mod recording;

#[cfg(feature = "peers")]
pub use comparison::{Both, Check, Crossing, MARGIN, Run, SLOP, alone};
pub use ours::TwoHalf;
#[cfg(feature = "peers")]
pub use rapier::Rapier;
pub use recording::{Hit, Recording};

use crate::world::Met;

/// A pair with the lesser one first.
fn ordered(a: Met, b: Met) -> (Met, Met) {
    if a <= b { (a, b) } else { (b, a) }
}

/// An angle between -pi and pi.
fn wrapped(angle: f64) -> f64 {
    angle - std::f64::consts::TAU * (angle / std::f64::consts::TAU).round()
}
