//! A scene with depth being simulated, in whatever engine.

#[cfg(feature = "peers")]
use crate::peers::Rapier;
use crate::peers::{Engine, State, TwoHalf};

/// A scene with depth in some engine, being stepped. Objects are named by their index in the scene.
pub trait DepthWorld {
    /// Moves everything by a time in s.
    fn step(&mut self, dt: f32);

    /// How an object is now.
    fn object(&self, index: usize) -> State;

    /// How many objects the scene has.
    fn object_count(&self) -> usize;

    /// Height in px of the ground or the platform that is straight below the middle of an object; `None` if there
    /// is none.
    fn height_beneath(&self, index: usize) -> Option<f64>;
}

impl DepthWorld for TwoHalf {
    fn step(&mut self, dt: f32) {
        self.step_by(dt);
    }

    fn object(&self, index: usize) -> State {
        self.state(index)
    }

    fn object_count(&self) -> usize {
        self.object_count()
    }

    fn height_beneath(&self, index: usize) -> Option<f64> {
        self.height_beneath(index)
    }
}

#[cfg(feature = "peers")]
impl DepthWorld for Rapier {
    fn step(&mut self, dt: f32) {
        self.step_by(dt);
    }

    fn object(&self, index: usize) -> State {
        self.state(index)
    }

    fn object_count(&self) -> usize {
        self.object_count()
    }

    fn height_beneath(&self, index: usize) -> Option<f64> {
        self.height_beneath(index)
    }
}
