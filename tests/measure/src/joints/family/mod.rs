//! Joint scenes with fixed dimensions, and the script that moves a body in some of them.

mod chains;
mod frames;
mod loads;
mod ragdolls;
mod vehicles;

use super::assembly::Assembly;
use crate::world::World;

/// Number of steps per second of simulated time.
const RATE: u32 = 60;
/// Simulated time in s of most runs.
const SECONDS: f64 = 10.0;
/// Impulse in kg px/s that wakes a body without moving it visibly: bodies in scenes with a [`Pull`] have masses of 1 kg.
const WAKING: [f64; 2] = [0.0, 1e-4];

/// A joint scene with its length and its expected outcome.
#[derive(Debug, Clone, PartialEq)]
pub struct JointScene {
    /// Name of the scene, by which programs select it.
    pub name: String,
    /// Bodies, joints and springs of the scene.
    pub assembly: Assembly,
    /// Simulated time of a run in s.
    pub seconds: f64,
    /// Index of the watched body, and its expected position at the end of the run, in px; `None` if none is watched.
    pub watched: Option<(usize, [f32; 2])>,
    /// Script that moves a static body; `None` if there is none.
    pub pull: Option<Pull>,
    /// Whether quick runs omit the scene because of its size.
    pub is_large: bool,
}

impl JointScene {
    fn new(name: impl Into<String>, assembly: Assembly) -> Self {
        let name = name.into();
        JointScene { name, assembly, seconds: SECONDS, watched: None, pull: None, is_large: false }
    }

    /// Sets the watched body; its position at the end should be that at the start.
    fn watching(self, body: usize) -> Self {
        let place = self.assembly.bodies[body].position;
        self.watching_at(body, place)
    }

    fn watching_at(mut self, body: usize, place: [f32; 2]) -> Self {
        self.watched = Some((body, place));
        self
    }

    fn lasting(mut self, seconds: f64) -> Self {
        self.seconds = seconds;
        self
    }

    /// Returns the number of updates of a run.
    pub fn steps(&self) -> u32 {
        (self.seconds * f64::from(RATE)) as u32
    }

    /// Returns whether a motor or a moved static body adds energy.
    pub fn is_driven(&self) -> bool {
        self.pull.is_some() || self.assembly.is_driven()
    }

    /// Returns the number of joints; springs do not count.
    pub fn joints(&self) -> usize {
        let is_joint = |kind| !matches!(kind, super::assembly::JointKind::Spring { .. });
        self.assembly.joints.iter().filter(|joint| is_joint(joint.kind)).count()
    }
}

/// Script that teleports a static body along y = 0. The body is the far end of a chain of 200 px, which it stretches.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pull {
    /// Index into `Assembly::bodies` of the static body that is teleported.
    pub body: usize,
    /// Greatest elongation of the chain in px, >= 0.
    pub elongation: f32,
}

impl Pull {
    /// Returns the position of the body along x in px before update `step`; `None` if it does not change. The chain is slack
    /// for 1 s, is stretched within 0.5 s, and is loose again 5 s later.
    fn place(self, step: u32) -> Option<f32> {
        match step {
            0 => Some(180.0),
            60..90 => Some(180.0 + (20.0 + self.elongation) * (step - 59) as f32 / 30.0),
            390 => Some(150.0),
            _ => None,
        }
    }

    /// Moves the static body before update `step`, and wakes all dynamic bodies.
    pub fn act(self, step: u32, assembly: &Assembly, world: &mut dyn World) {
        let Some(x) = self.place(step) else { return };
        world.teleport(self.body, [f64::from(x), 0.0], 0.0);
        let dynamic = assembly.bodies.iter().enumerate().filter(|(_, body)| !body.is_static);
        dynamic.for_each(|(index, _)| world.apply_impulse(index, WAKING));
    }
}

/// Returns all joint scenes with fixed dimensions.
pub fn family() -> Vec<JointScene> {
    [chains::scenes(), frames::scenes(), loads::scenes(), vehicles::scenes(), ragdolls::scenes()].concat()
}
