//! The joint scenes with fixed dimensions.

mod chains;
mod frames;
mod loads;
mod ragdolls;
mod vehicles;

use super::assembly::Assembly;
use crate::world::World;

/// Steps per second.
const RATE: u32 = 60;
/// Length of most runs in s.
const SECONDS: f64 = 10.0;
/// Impulse in kg px/s that wakes a body and does not move it visibly: scenes with a pull have masses of 1 kg.
const WAKING: [f64; 2] = [0.0, 1e-4];

/// A scene, and what is asked of it.
#[derive(Debug, Clone, PartialEq)]
pub struct JointScene {
    /// Its name, by which programs choose scenes.
    pub name: String,
    /// Bodies, joints and springs.
    pub assembly: Assembly,
    /// Length of a run in s.
    pub seconds: f64,
    /// A body, and its correct place in px at the end.
    pub watched: Option<(usize, [f32; 2])>,
    /// A static body that moves.
    pub pull: Option<Pull>,
    /// Whether a quick run leaves it out.
    pub is_large: bool,
}

impl JointScene {
    fn new(name: impl Into<String>, assembly: Assembly) -> Self {
        let name = name.into();
        JointScene { name, assembly, seconds: SECONDS, watched: None, pull: None, is_large: false }
    }

    /// A body belongs where it begins.
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

    /// Number of updates.
    pub fn steps(&self) -> u32 {
        (self.seconds * f64::from(RATE)) as u32
    }

    /// Whether a motor or a moved body adds energy.
    pub fn is_driven(&self) -> bool {
        self.pull.is_some() || self.assembly.is_driven()
    }

    /// Number of joints without springs.
    pub fn joints(&self) -> usize {
        let is_joint = |kind| !matches!(kind, super::assembly::JointKind::Spring { .. });
        self.assembly.joints.iter().filter(|joint| is_joint(joint.kind)).count()
    }
}

/// Teleports a static body along y = 0: the far end of a chain of 200 px, which it stretches.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pull {
    /// Index of the body.
    pub body: usize,
    /// Greatest elongation of the chain in px.
    pub elongation: f32,
}

impl Pull {
    /// The place along x in px before an update, if it changes: slack for 1 s, stretched within 0.5 s, loose again after
    /// 5 s more.
    fn place(self, step: u32) -> Option<f32> {
        match step {
            0 => Some(180.0),
            60..90 => Some(180.0 + (20.0 + self.elongation) * (step - 59) as f32 / 30.0),
            390 => Some(150.0),
            _ => None,
        }
    }

    /// Moves the body before an update and wakes all others.
    pub fn act(self, step: u32, assembly: &Assembly, world: &mut dyn World) {
        let Some(x) = self.place(step) else { return };
        world.teleport(self.body, [f64::from(x), 0.0], 0.0);
        let dynamic = assembly.bodies.iter().enumerate().filter(|(_, body)| !body.is_static);
        dynamic.for_each(|(index, _)| world.apply_impulse(index, WAKING));
    }
}

/// All scenes.
pub fn family() -> Vec<JointScene> {
    [chains::scenes(), frames::scenes(), loads::scenes(), vehicles::scenes(), ragdolls::scenes()].concat()
}
