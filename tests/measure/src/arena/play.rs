//! A scene that is played in an engine.

use super::engine::{Engine, EngineEntry, Result};
use super::scene::{Action, Body, Joint, Kind, Scene};
use crate::stopwatch::Stopwatch;
use std::time::Duration;

/// A scene in an engine, between two steps.
#[expect(missing_debug_implementations, reason = "engines have none")]
pub struct Play<'a> {
    pub(super) scene: &'a Scene,
    pub(super) engine: Box<dyn Engine>,
    /// As they were made, by index; nothing where they have gone.
    pub(super) bodies: Vec<Option<Body>>,
    pub(super) joints: Vec<Option<Joint>>,
    step: usize,
}

impl<'a> Play<'a> {
    /// Builds a scene in an engine.
    ///
    /// # Errors
    /// Errors of the engine.
    pub fn new(scene: &'a Scene, engine: EngineEntry) -> Result<Self> {
        Play::within(scene, (engine.create)(scene)?)
    }

    /// Builds a scene in an empty world.
    ///
    /// # Errors
    /// Errors of the engine.
    pub fn within(scene: &'a Scene, engine: Box<dyn Engine>) -> Result<Self> {
        let mut play = Play { scene, engine, bodies: Vec::new(), joints: Vec::new(), step: 0 };
        let bodies = scene.bodies.iter().cloned().map(Action::AddBody);
        let joints = scene.joints.iter().cloned().map(Action::AddJoint);
        let actions: Vec<Action> = bodies.chain(joints).collect();
        actions.iter().try_for_each(|action| play.note(action))?;
        actions.iter().try_for_each(|action| play.act(action))?;
        Ok(play)
    }

    /// Makes the changes that are due and a step, and answers the CPU time of both.
    ///
    /// # Errors
    /// Errors of the engine.
    pub fn step(&mut self) -> Result<Duration> {
        let actions = self.scene.script.as_ref().map_or_else(Vec::new, |script| script(self.step));
        self.step += 1;
        actions.iter().try_for_each(|action| self.note(action))?;
        let watch = Stopwatch::start();
        actions.iter().try_for_each(|action| self.act(action))?;
        self.engine.step()?;
        let elapsed = watch.elapsed();
        Ok(elapsed)
    }

    /// The engine, to ask for states and counters.
    pub fn engine(&mut self) -> &mut dyn Engine {
        &mut *self.engine
    }

    /// Indices of the dynamic bodies that are there.
    pub fn dynamic_bodies(&self) -> impl Iterator<Item = usize> + '_ {
        let is_dynamic = |body: &Option<Body>| body.as_ref().is_some_and(|body| body.kind == Kind::Dynamic);
        self.bodies.iter().enumerate().filter(move |(_, body)| is_dynamic(body)).map(|(index, _)| index)
    }

    /// Keeps account of an action, which the engine is not asked about and which is not timed.
    fn note(&mut self, action: &Action) -> Result<()> {
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
