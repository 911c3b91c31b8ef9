//! Settings of the simulator and of the trace.

use super::SceneError;
use super::reader::{Keys, Object, keys, words};
use farseer_core::math::Vector2;

/// How contacts are found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NarrowPhase {
    /// Vertices of one geom against the distance grid of the other.
    DistanceGrid,
    /// Separating axes of convex geoms.
    Sat,
}

words!(NarrowPhase { "distance_grid" => DistanceGrid, "sat" => Sat });

/// How pairs that may touch are found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BroadPhase {
    /// The collider a simulator starts with.
    SelectiveSweep,
    /// Sorted ends on both axes.
    SweepAndPrune,
    /// Every pair.
    BruteForce,
    /// Cells of a hashed grid.
    SpatialHash,
}

words!(BroadPhase {
    "selective_sweep" => SelectiveSweep,
    "sweep_and_prune" => SweepAndPrune,
    "brute_force" => BruteForce,
    "spatial_hash" => SpatialHash,
});

/// How the friction of two geoms is combined.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Friction {
    /// The mean of the two coefficients.
    Average,
    /// The smaller of the two.
    Minimum,
}

words!(Friction { "average" => Average, "minimum" => Minimum });

/// Settings of the contact solver. Absent ones keep the engine's default.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SolverSettings {
    /// Rounds of impulses per step.
    pub iterations: Option<i32>,
    /// Share of the penetration that is removed in a step.
    pub bias_factor: Option<f32>,
    /// Penetration that is not corrected, in length units.
    pub allowed_penetration: Option<f32>,
    /// Greatest number of contacts that are solved per pair.
    pub max_contacts_to_resolve: Option<i32>,
    /// How friction is combined.
    pub friction_type: Option<Friction>,
}

keys!(SolverSettings {
    iterations,
    bias_factor,
    allowed_penetration,
    max_contacts_to_resolve,
    friction_type
});

/// Settings a simulator is made with.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SimulatorSettings {
    /// Acceleration of every body, in length units per second squared; default zero.
    pub gravity: Option<Vector2>,
    /// How contacts are found.
    pub narrow_phase: Option<NarrowPhase>,
    /// Greatest number of contacts that are computed per pair; set before any object is created.
    pub max_contacts_to_detect: Option<i32>,
    /// Settings of the contact solver.
    pub solver: SolverSettings,
    /// How pairs are found.
    pub broad_phase: Option<BroadPhase>,
    /// Cell size of the spatial hash, in length units.
    pub cell_size: Option<f32>,
    /// Whether the spatial hash adapts its cell size.
    pub auto_adjust_cell_size: Option<bool>,
    /// Whether a handler of the broad phase event, which always agrees, is subscribed.
    pub broad_phase_event: bool,
}

keys!(SimulatorSettings {
    gravity,
    narrow_phase,
    max_contacts_to_detect,
    solver [flat],
    broad_phase,
    cell_size,
    auto_adjust_cell_size,
    broad_phase_event [or false],
});

/// Content of a trace of the scene.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TraceSettings {
    /// Every how many steps the full state is written, at least 1.
    pub full_every: u32,
    /// Whether callbacks are subscribed and logged.
    pub events: bool,
    /// Number of the last step whose events are logged.
    pub events_until: Option<u32>,
    /// Whether contacts are written with the full state.
    pub contacts: bool,
    /// Every how many steps the line of the step is written, at least 1.
    pub step_every: u32,
}

impl Keys for TraceSettings {
    fn take(object: &mut Object<'_>) -> Result<Self, SceneError> {
        Ok(TraceSettings {
            full_every: at_least_one(object, "full_every", None)?,
            events: object.key("events")?,
            events_until: object.key("events_until")?,
            contacts: object.key("contacts")?,
            step_every: at_least_one(object, "step_every", Some(1))?,
        })
    }
}

/// A count that must not be zero.
pub(super) fn at_least_one(
    object: &mut Object<'_>,
    key: &'static str,
    default: Option<u32>,
) -> Result<u32, SceneError> {
    let count = match default {
        Some(default) => object.key_or(key, default)?,
        None => object.key(key)?,
    };
    if count == 0 { Err(object.error_at(key, "0 is not an integer of at least 1")) } else { Ok(count) }
}

/// Faults of the original in the recorded run.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Outcome {
    /// First step after which a component of a body's state was not a number.
    pub first_nan_step: Option<u32>,
    /// Full name of the exception's type.
    pub throws: Option<String>,
    /// Step in which it was thrown, 0 while building.
    pub throw_step: Option<u32>,
}

impl Keys for Outcome {
    fn take(object: &mut Object<'_>) -> Result<Self, SceneError> {
        let outcome = Outcome {
            first_nan_step: object.key("first_nan_step")?,
            throws: object.key("throws")?,
            throw_step: object.key("throw_step")?,
        };
        if outcome.throws.is_some() != outcome.throw_step.is_some() {
            return Err(object.error("`throws` and `throw_step` belong together"));
        }
        Ok(outcome)
    }
}
