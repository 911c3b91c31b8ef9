//! Where methods fail: families of scenes with a parameter that goes from easy to hard.
//!
//! A family is one entry of [`families`]. [`sheet`] says which methods and settings it is run with, [`map`] runs them
//! and keeps what came of it, [`table`] writes it down.
//!
//! Lengths are px, y points down, and 32 px are one metre; gravity is 320 px/s², which are 10 m/s². The floor's
//! surface is y = 0. Friction is 0.5 and restitution 0 unless a family says otherwise. Scenes are named after those of
//! Solver2D and of Box2D's benchmarks where they show the same thing; they are built from dimensions, and not equal in
//! every detail.

mod arches;
mod cards;
mod chains;
mod crowds;
mod far;
mod grids;
pub mod map;
mod masses;
mod overlaps;
mod parts;
mod pushes;
pub(crate) mod ragdolls;
pub mod reasons;
pub mod sheet;
mod springs;
pub(crate) mod stacks;
mod steps;
mod sweeps;
pub mod table;
mod tunnels;

use super::watch::Watch;
use super::world::World;
use conformance::scene::Scene;

/// A step of a run that is about to be made.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Moment {
    /// Steps made so far.
    pub step: u32,
    /// Simulated time so far in s.
    pub time: f64,
    /// The step of the setting in s.
    pub dt: f32,
}

/// Scenes of one kind, from easy to hard.
pub struct StabilityFamily<S = Scene> {
    /// Such as "Vertical Stack".
    pub name: &'static str,
    /// What there is, and what must happen.
    pub about: &'static str,
    /// What is varied.
    pub parameter: &'static str,
    /// Its unit; empty for a number of things.
    pub unit: &'static str,
    /// Its values, from easy to hard.
    pub values: &'static [f64],
    /// Some of them.
    pub quick_values: &'static [f64],
    /// Makes the scene for a value. The step in s that it will be run with is given as well, for springs whose
    /// stiffness is measured by it.
    pub build: fn(f64, f32) -> S,
    /// Length of a run in s for a value.
    pub seconds: fn(f64) -> f64,
    /// Makes whole steps of the length, in steps: the nearest number, or the next higher one.
    pub whole: fn(f64) -> f64,
    /// What happens before a step; mostly nothing.
    pub act: fn(f64, &mut dyn World, Moment),
    /// How long a step is, in s; mostly as the setting says.
    pub dt: fn(f64, Moment) -> f32,
    /// Makes what says how it went. It is asked after the last step.
    pub judge: fn(f64, &S) -> Box<dyn Watch>,
    /// What the judge measures.
    pub quantity: &'static str,
    /// Its unit.
    pub quantity_unit: &'static str,
    /// Whether the broad phases are compared too.
    pub broad_phases_matter: bool,
}

copied!(StabilityFamily);

/// What most families run for, in s.
const SECONDS: f64 = 10.0;

impl<S> StabilityFamily<S> {
    /// What most families have in common. Not a family by itself.
    pub(crate) const PLAIN: StabilityFamily<S> = StabilityFamily {
        name: "",
        about: "",
        parameter: "",
        unit: "",
        values: &[],
        quick_values: &[],
        build: |_, _| unreachable!("every family has scenes of its own"),
        seconds: |_| SECONDS,
        whole: f64::round,
        act: |_, _, _| {},
        dt: |_, moment| moment.dt,
        judge: |_, _| parts::all(Vec::new()),
        quantity: "",
        quantity_unit: "px",
        broad_phases_matter: false,
    };
}

/// All families: the one place to add one.
pub fn families() -> Vec<StabilityFamily> {
    [
        &stacks::FAMILIES[..],
        &cards::FAMILIES,
        &arches::FAMILIES,
        &crowds::FAMILIES,
        &masses::FAMILIES,
        &overlaps::FAMILIES,
        &pushes::FAMILIES,
        &chains::FAMILIES,
        &ragdolls::FAMILIES,
        &far::FAMILIES,
        &tunnels::FAMILIES,
        &grids::FAMILIES,
        &sweeps::FAMILIES,
        &springs::FAMILIES,
        &steps::FAMILIES,
    ]
    .concat()
}
