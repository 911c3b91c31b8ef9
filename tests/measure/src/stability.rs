//! Limits of methods: families of scenes with a parameter that goes from easy to hard, until methods fail.
//!
//! Each entry of [`families`] is one family. [`sheet`] lists the methods and settings of a family, [`map`] runs them and
//! keeps the outcomes, [`table`] writes the outcomes.
//!
//! Lengths are px, y points down, and 32 px are one metre; gravity is 320 px/s² (10 m/s²). The surface of the floor is y =
//! 0. Friction is 0.5 and restitution 0 unless a family states otherwise. Scenes are named after those of Solver2D and of
//! Box2D's benchmarks that show the same effect; their dimensions differ in details.

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

/// State of a run just before a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Moment {
    /// Number of steps so far.
    pub step: u32,
    /// Simulated time in s so far.
    pub time: f64,
    /// Time step in s of the setting.
    pub dt: f32,
}

/// Scenes of one kind, whose parameter goes from easy to hard.
pub struct StabilityFamily<S = Scene> {
    /// Name of the family, such as "Vertical Stack".
    pub name: &'static str,
    /// Description of the scene and of its condition of success.
    pub about: &'static str,
    /// Name of the parameter that varies.
    pub parameter: &'static str,
    /// Unit of the parameter; empty for a count.
    pub unit: &'static str,
    /// Values of the parameter, from easy to hard.
    pub values: &'static [f64],
    /// Subset of `values` that a quick measurement runs.
    pub quick_values: &'static [f64],
    /// Builds the scene for a value of the parameter. The second argument is the time step in s of its run, for springs
    /// whose stiffness depends on it.
    pub build: fn(f64, f32) -> S,
    /// Simulated time of a run in s, as a function of the parameter's value.
    pub seconds: fn(f64) -> f64,
    /// Rounds the length of a run, as a fractional number of steps, to a whole number of steps: to the nearest or to the
    /// next higher one.
    pub whole: fn(f64) -> f64,
    /// Changes the world before a step; in most families it does nothing. The first argument is the value of the parameter.
    pub act: fn(f64, &mut dyn World, Moment),
    /// Returns the length of a step in s for a value of the parameter; in most families the time step of the setting.
    pub dt: fn(f64, Moment) -> f32,
    /// Creates the watch that judges a run, for a value of the parameter. Its verdict is read after the last step.
    pub judge: fn(f64, &S) -> Box<dyn Watch>,
    /// Name of the quantity that the watch of `judge` measures.
    pub quantity: &'static str,
    /// Unit of the measured quantity.
    pub quantity_unit: &'static str,
    /// Whether the family is also run with methods that differ in the broad phase alone.
    pub broad_phases_matter: bool,
}

copied!(StabilityFamily);

/// Simulated time in s of a run in most families.
const SECONDS: f64 = 10.0;

impl<S> StabilityFamily<S> {
    /// Default values of the fields of a family; `build` must be replaced.
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

/// Returns all families in the order of maps and tables. New families are added here.
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
