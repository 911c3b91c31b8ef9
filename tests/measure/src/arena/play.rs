//! Run of a scene in an engine, step by step.

use super::engine::{Engine, EngineEntry, Result};
use super::joint::Joint;
use super::scene::{Action, Body, Kind, Scene};
use crate::stopwatch::Stopwatch;
use std::time::Duration;

/// A scene in an engine between two steps.
#[expect(missing_debug_implementations, reason = "engines have none")]
pub struct Play<'a> {
    pub(super) scene: &'a Scene,
    pub(super) engine: Box<dyn Engine>,
    /// Bodies in the order of creation; `None` for bodies that were removed.
    pub(super) bodies: Vec<Option<Body>>,
    pub(super) joints: Vec<Option<Joint>>,
    step: usize,
    build_time: Duration,
}

impl<'a> Play<'a> {
    /// Creates an engine and builds a scene in it.
    ///
    /// # Errors
    /// The engine refuses a body, a joint or a step.
    pub fn new(scene: &'a Scene, engine: EngineEntry) -> Result<Self> {
        Play::within(scene, (engine.create)(scene)?)
    }

    /// Builds a scene in an engine with an empty world.
    ///
    /// # Errors
    /// The engine refuses a body, a joint or a step.
    pub fn within(scene: &'a Scene, engine: Box<dyn Engine>) -> Result<Self> {
        let mut play = Play {
            scene,
            engine,
            bodies: Vec::new(),
            joints: Vec::new(),
            step: 0,
            build_time: Duration::ZERO,
        };
        let bodies = scene.bodies.iter().cloned().map(Action::AddBody);
        let joints = scene.joints.iter().cloned().map(Action::AddJoint);
        let actions: Vec<Action> = bodies.chain(joints).collect();
        actions.iter().try_for_each(|action| play.count_action(action))?;
        let watch = Stopwatch::start();
        actions.iter().try_for_each(|action| play.act(action))?;
        play.build_time = watch.elapsed();
        Ok(play)
    }

    /// Applies the actions of the scene's script for this step, makes the step, and returns the CPU time of both.
    ///
    /// # Errors
    /// The engine refuses a body, a joint or a step.
    pub fn step(&mut self) -> Result<Duration> {
        let actions = self.scene.script.as_ref().map_or_else(Vec::new, |script| script(self.step));
        self.step += 1;
        actions.iter().try_for_each(|action| self.count_action(action))?;
        let watch = Stopwatch::start();
        actions.iter().try_for_each(|action| self.act(action))?;
        self.engine.step()?;
        let elapsed = watch.elapsed();
        Ok(elapsed)
    }

    /// Returns the CPU time in which the engine took all bodies and joints that the scene has at the start.
    pub fn build_time(&self) -> Duration {
        self.build_time
    }

    /// Applies an action at once and returns its CPU time.
    ///
    /// # Errors
    /// The engine refuses it.
    pub fn change(&mut self, action: &Action) -> Result<Duration> {
        self.count_action(action)?;
        let watch = Stopwatch::start();
        self.act(action)?;
        Ok(watch.elapsed())
    }

    /// Removes all joints, then all bodies, one after the other, makes a step, and returns the CPU time of all this.
    ///
    /// # Errors
    /// The engine refuses to remove one, or the step.
    pub fn clear(&mut self) -> Result<Duration> {
        let joints = (0..self.joints.len()).filter(|&index| self.joints[index].is_some());
        let bodies = (0..self.bodies.len()).filter(|&index| self.bodies[index].is_some());
        let actions: Vec<Action> =
            joints.map(Action::RemoveJoint).chain(bodies.map(Action::RemoveBody)).collect();
        actions.iter().try_for_each(|action| self.count_action(action))?;
        let watch = Stopwatch::start();
        actions.iter().try_for_each(|action| self.act(action))?;
        self.engine.step()?;
        Ok(watch.elapsed())
    }

    /// Returns the engine, for reading states and counters.
    pub fn engine(&mut self) -> &mut dyn Engine {
        &mut *self.engine
    }

    /// Returns the indices of the dynamic bodies that exist at present.
    pub fn dynamic_bodies(&self) -> impl Iterator<Item = usize> + '_ {
        let is_dynamic = |body: &Option<Body>| body.as_ref().is_some_and(|body| body.kind == Kind::Dynamic);
        self.bodies.iter().enumerate().filter(move |(_, body)| is_dynamic(body)).map(|(index, _)| index)
    }

    /// Adds the body or joint of an action to the lists of this object, or removes it. This does not use the engine and is
    /// not timed.
    fn count_action(&mut self, action: &Action) -> Result<()> {
        match action {
            Action::AddBody(body) => self.bodies.push(Some(body.clone())),
            Action::AddJoint(joint) => self.joints.push(Some(joint.clone())),
            Action::RemoveBody(index) => *self.bodies.get_mut(*index).ok_or("no such body")? = None,
            Action::RemoveJoint(index) => *self.joints.get_mut(*index).ok_or("no such joint")? = None,
            Action::Move { .. } => {}
        }
        Ok(())
    }

    fn act(&mut self, action: &Action) -> Result<()> {
        match action {
            Action::AddBody(body) => self.engine.add_body(body),
            Action::AddJoint(joint) => {
                let [a, b] = joint.bodies.map(|index| self.bodies.get(index).and_then(Option::as_ref));
                let (Some(a), Some(b)) = (a, b) else { return Err("a joint of a body that has gone".into()) };
                self.engine.add_joint(joint, [a, b])
            }
            Action::RemoveBody(index) => self.engine.remove_body(*index),
            Action::RemoveJoint(index) => self.engine.remove_joint(*index),
            Action::Move { body, to } => self.engine.move_to(*body, *to),
        }
    }
}
