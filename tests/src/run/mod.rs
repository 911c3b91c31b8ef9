//! Scenes to simulations: building and driving.
//!
//! [`Run`] builds a scene and makes its steps one by one; [`record`] makes all of them and gives the trace.
//! Values the engine's setters would silently refuse (because a game calls them every frame) are errors here,
//! so that a scene with such a value says where it is.

mod build;
mod log;
mod recording;
mod script;

pub use recording::{Recording, record};

use crate::scene::{At, Feature, Features, Reason, Scene, SceneError};
use crate::trace::{Counts, Line};
use farseer_core::math::Vector2;
use farseer_core::{BodyId, GeomId, PhysicsSimulator};
use log::Log;

/// What this version of the engine has beyond bodies and geoms.
pub const BUILT: &[Feature] = &[];

/// A scene that is being simulated.
#[derive(Debug)]
pub struct Run<'a> {
    scene: &'a Scene,
    simulator: PhysicsSimulator,
    bodies: Vec<BodyId>,
    geoms: Vec<GeomId>,
    log: Log,
    dt: f32,
}

impl<'a> Run<'a> {
    /// Builds a scene. Nothing is simulated yet, but what was added has entered the lists of the simulator.
    ///
    /// # Errors
    ///
    /// When the scene refers to something that does not exist, has a value the engine refuses, or needs a
    /// part the engine does not have. The error names the file, the place and the reason.
    pub fn build(scene: &'a Scene) -> Result<Self, SceneError> {
        let missing = scene.features().without(Features::of(BUILT));
        if !missing.is_empty() {
            return Err(SceneError::new(At::Root, Reason::NotBuilt(missing)).in_file(scene.file()));
        }
        build::build(scene).map_err(|error| error.in_file(scene.file()))
    }

    /// Makes the next step: the operations of the script, then an update.
    ///
    /// # Errors
    ///
    /// When an operation of the script refers to something that does not exist or has a value the engine
    /// refuses.
    pub fn step(&mut self) -> Result<(), SceneError> {
        self.log.step += 1;
        script::apply(self).map_err(|error| error.in_file(self.scene.file()))?;
        self.simulator.update_with(self.dt, &mut self.log);
        Ok(())
    }

    /// The scene.
    pub fn scene(&self) -> &'a Scene {
        self.scene
    }

    /// The simulator.
    pub fn simulator(&self) -> &PhysicsSimulator {
        &self.simulator
    }

    /// The simulator, to look at it from or to change it beside the script.
    pub fn simulator_mut(&mut self) -> &mut PhysicsSimulator {
        &mut self.simulator
    }

    /// Number of steps made so far.
    pub fn steps(&self) -> u32 {
        self.log.step
    }

    /// The bodies by index, disposed ones included.
    pub fn bodies(&self) -> &[BodyId] {
        &self.bodies
    }

    /// The geoms by id of the scene, disposed ones included.
    pub fn geoms(&self) -> &[GeomId] {
        &self.geoms
    }

    /// How much was created so far.
    pub fn counts(&self) -> Counts {
        Counts { bodies: self.bodies.len(), geoms: self.geoms.len(), ..Counts::default() }
    }

    /// The event lines logged since the last call.
    pub fn take_events(&mut self) -> Vec<Line> {
        std::mem::take(&mut self.log.lines)
    }

    fn body(&self, index: usize, at: At<'_>) -> Result<BodyId, SceneError> {
        find(&self.bodies, "body", index, at)
    }

    fn geom(&self, index: usize, at: At<'_>) -> Result<GeomId, SceneError> {
        find(&self.geoms, "geom", index, at)
    }
}

/// The thing with an index.
fn find<I: Copy>(list: &[I], kind: &'static str, index: usize, at: At<'_>) -> Result<I, SceneError> {
    let missing = || SceneError::new(at, Reason::NoSuch { kind, index, count: list.len() });
    list.get(index).copied().ok_or_else(missing)
}

/// A result of the engine, its error put at a place of the scene.
trait AtPlace<T> {
    fn at(self, at: At<'_>) -> Result<T, SceneError>;
}

impl<T> AtPlace<T> for farseer_core::Result<T> {
    fn at(self, at: At<'_>) -> Result<T, SceneError> {
        self.map_err(|error| SceneError::new(at, error))
    }
}

/// Values that may be infinite although the engine takes finite ones only.
trait Finite: Sized {
    /// The value itself, or an error at its place.
    fn finite(self, at: At<'_>) -> Result<Self, SceneError>;
}

impl Finite for f32 {
    fn finite(self, at: At<'_>) -> Result<Self, SceneError> {
        if self.is_finite() { Ok(self) } else { Err(SceneError::new(at, Reason::NotFinite(self))) }
    }
}

impl Finite for Vector2 {
    fn finite(self, at: At<'_>) -> Result<Self, SceneError> {
        self.x.finite(at.item(0))?;
        self.y.finite(at.item(1))?;
        Ok(self)
    }
}
