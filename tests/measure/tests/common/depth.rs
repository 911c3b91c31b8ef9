//! Worlds with known errors, for tests that measures and judges find these errors.

use measure::depth::{DepthMethod, depth_methods};
use measure::scenes::depth::DepthScene;
use measure::world::{BodyState, World};

/// Returns the 2.5D method of this workspace with a name.
pub(crate) fn method(name: &str) -> DepthMethod {
    let found = depth_methods().into_iter().find(|method| method.name == name);
    found.unwrap_or_else(|| panic!("there is no method {name}"))
}

pub(crate) fn faithful() -> DepthMethod {
    method("2.5D, faithful")
}

pub(crate) fn thesis() -> DepthMethod {
    method("2.5D, thesis")
}

/// A world whose bodies have the states of another one, each altered by the function `change`.
pub(crate) struct Changed<F> {
    pub(crate) world: Box<dyn World>,
    pub(crate) change: F,
}

impl<F: Fn(usize, BodyState) -> BodyState> World for Changed<F> {
    fn step(&mut self, dt: f32) {
        self.world.step(dt);
    }

    fn body(&self, index: usize) -> BodyState {
        (self.change)(index, self.world.body(index))
    }

    fn body_count(&self) -> usize {
        self.world.body_count()
    }

    fn height_beneath(&self, index: usize) -> Option<f64> {
        self.world.height_beneath(index)
    }
}

/// A world whose objects never move. No object has a surface beneath it. Holds the state of each object.
pub(crate) struct Frozen(Vec<BodyState>);

impl Frozen {
    pub(crate) fn new(scene: &DepthScene) -> Self {
        let state = |place: [f32; 3]| BodyState { position: place.map(f64::from), ..BodyState::default() };
        Frozen(scene.objects.iter().map(|object| state(object.position)).collect())
    }
}

impl World for Frozen {
    fn step(&mut self, _: f32) {}

    fn body(&self, index: usize) -> BodyState {
        self.0[index]
    }

    fn body_count(&self) -> usize {
        self.0.len()
    }
}
