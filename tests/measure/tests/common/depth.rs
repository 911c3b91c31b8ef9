//! Worlds that are not as they should be, to show measures and judges what they should see.

use measure::depth::{DepthMethod, DepthWorld, depth_methods};
use measure::depth_scenes::DepthScene;
use measure::peers::State;

/// A method of this workspace.
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

/// A world that shows another one, changed.
pub(crate) struct Changed<F> {
    pub(crate) world: Box<dyn DepthWorld>,
    pub(crate) change: F,
}

impl<F: Fn(usize, State) -> State> DepthWorld for Changed<F> {
    fn step(&mut self, dt: f32) {
        self.world.step(dt);
    }

    fn object(&self, index: usize) -> State {
        (self.change)(index, self.world.object(index))
    }

    fn object_count(&self) -> usize {
        self.world.object_count()
    }

    fn height_beneath(&self, index: usize) -> Option<f64> {
        self.world.height_beneath(index)
    }
}

/// A world in which nothing ever moves, and nothing is beneath anything.
pub(crate) struct Frozen(Vec<State>);

impl Frozen {
    pub(crate) fn new(scene: &DepthScene) -> Self {
        let state = |place: [f32; 3]| State { position: place.map(f64::from), ..State::default() };
        Frozen(scene.objects.iter().map(|object| state(object.position)).collect())
    }
}

impl DepthWorld for Frozen {
    fn step(&mut self, _: f32) {}

    fn object(&self, index: usize) -> State {
        self.0[index]
    }

    fn object_count(&self) -> usize {
        self.0.len()
    }

    fn height_beneath(&self, _: usize) -> Option<f64> {
        None
    }
}
