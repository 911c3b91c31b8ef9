//! Scenes to simulations: building and driving.
//!
//! [`Run`] builds a scene and makes its steps one by one; [`record`] makes all of them and returns the trace. Values that the
//! engine's setters would silently refuse (because a game calls them every frame) are errors here, so that the position of such
//! a value in the scene is reported.

mod build;
mod controllers;
mod links;
mod log;
mod paths;
mod recording;
mod script;

pub use recording::{Recording, record};

use crate::scene::{At, Reason, Scene, SceneError};
use crate::trace::{Counts, Event, Line, word};
use farseer_core::math::Vector2;
use farseer_core::{BodyId, ControllerId, GeomId, JointId, PhysicsSimulator, ScalingController, SpringId};
use log::Log;

/// A scene that is being simulated.
#[derive(Debug, Clone)]
pub struct Run<'a> {
    scene: &'a Scene,
    simulator: PhysicsSimulator,
    bodies: Vec<BodyId>,
    geoms: Vec<GeomId>,
    joints: Vec<JointId>,
    springs: Vec<SpringId>,
    controllers: Vec<ControllerId>,
    log: Log,
    dt: f32,
    dt_real: f32,
    /// The controller that decides the time step.
    scaled_by: Option<ControllerId>,
}

impl<'a> Run<'a> {
    /// Builds a scene. No step is made yet, but the added objects have entered the lists of the simulator.
    ///
    /// # Errors
    ///
    /// When the scene refers to an object that does not exist, or has a value the engine refuses. The error names the file, the
    /// position and the reason.
    pub fn build(scene: &'a Scene) -> Result<Self, SceneError> {
        build::build(scene).map_err(|error| error.in_file(scene.file()))
    }

    /// Makes the next step: the operations of the script, then an update, if the controller that decides the time step wants
    /// one.
    ///
    /// # Errors
    ///
    /// When an operation of the script refers to an object that does not exist or has a value the engine refuses.
    pub fn step(&mut self) -> Result<(), SceneError> {
        self.log.step += 1;
        script::apply(self).map_err(|error| error.in_file(self.scene.file()))?;
        let dt = self.interval();
        if self.scaled_by.is_none() || dt != 0.0 {
            self.simulator.update_with_real_time(dt, self.dt_real, Some(&mut self.log));
        }
        Ok(())
    }

    /// The time step of this update in s: the scene's, or that of its scaling controller.
    fn interval(&mut self) -> f32 {
        let Some(id) = self.scaled_by else { return self.dt };
        // A disposed controller has no effect.
        let Ok(scaling) = self.simulator.controller_as_mut::<ScalingController>(id) else { return self.dt };
        let interval = scaling.get_update_interval(self.dt);
        let values = [interval, scaling.update_interval(), scaling.maximum_update_interval()];
        self.log.event(Event::Interval { values: values.map(word) });
        interval
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

    /// The joints by index, disposed ones included.
    pub fn joints(&self) -> &[JointId] {
        &self.joints
    }

    /// The springs by index, disposed ones included.
    pub fn springs(&self) -> &[SpringId] {
        &self.springs
    }

    /// The controllers by index, disposed ones included.
    pub fn controllers(&self) -> &[ControllerId] {
        &self.controllers
    }

    /// How much was created so far.
    pub fn counts(&self) -> Counts {
        Counts {
            bodies: self.bodies.len(),
            geoms: self.geoms.len(),
            joints: self.joints.len(),
            springs: self.springs.len(),
            controllers: self.controllers.len(),
        }
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

    fn joint(&self, index: usize, at: At<'_>) -> Result<JointId, SceneError> {
        find(&self.joints, "joint", index, at)
    }

    fn spring(&self, index: usize, at: At<'_>) -> Result<SpringId, SceneError> {
        find(&self.springs, "spring", index, at)
    }

    fn controller(&self, index: usize, at: At<'_>) -> Result<ControllerId, SceneError> {
        find(&self.controllers, "controller", index, at)
    }
}

/// The object with an index.
fn find<I: Copy>(list: &[I], kind: &'static str, index: usize, at: At<'_>) -> Result<I, SceneError> {
    let missing = || SceneError::new(at, Reason::NoSuch { kind, index, count: list.len() });
    list.get(index).copied().ok_or_else(missing)
}

/// A result of the engine whose error gets a position in the scene.
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
    /// The value itself, or an error at its position.
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
