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

/// What an object can meet.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Met {
    /// Another object, by its index in the scene.
    Object(usize),
    /// The plane Y = 0.
    Ground,
    /// A platform, by its index in the scene.
    Platform(usize),
}

/// Where an object is, and how it moves. In double precision, since it is for measuring.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct State {
    /// X and Z of the origin and Y of the lowest point, px.
    pub position: [f64; 3],
    /// Velocity of the origin along X, up and along Z, px/s.
    pub velocity: [f64; 3],
    /// Rotation about the depth axis in rad, clockwise on the screen, between -pi and pi.
    pub rotation: f64,
}

impl State {
    /// Speed in px/s.
    pub fn speed(&self) -> f64 {
        self.velocity.iter().map(|part| part * part).sum::<f64>().sqrt()
    }

    /// Whether every part is finite.
    pub fn is_finite(&self) -> bool {
        self.position.iter().chain(&self.velocity).chain([&self.rotation]).all(|part| part.is_finite())
    }
}

/// An engine with a scene in it.
pub trait Engine {
    /// Moves everything by the scene's step.
    fn step(&mut self);

    /// How an object is now.
    fn state(&self, object: usize) -> State;

    /// Appends the pairs that pushed each other in the last step, each with the lesser one first.
    fn touching(&self, pairs: &mut Vec<(Met, Met)>);
}

/// A pair with the lesser one first.
fn ordered(a: Met, b: Met) -> (Met, Met) {
    if a <= b { (a, b) } else { (b, a) }
}

/// An angle between -pi and pi.
fn wrapped(angle: f64) -> f64 {
    angle - std::f64::consts::TAU * (angle / std::f64::consts::TAU).round()
}
