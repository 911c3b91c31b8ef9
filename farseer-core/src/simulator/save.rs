//! Saving and loading the whole simulator.
//!
//! All state that can influence a later bit is saved: queues, the order of sorted lists, arbiters with their impulses
//! and the pool to which they return, creation numbers. Distance grids are saved as their outlines. Pending events are
//! saved, too: objects disposed or moved and arguments rejected since the last update.
//!
//! A loaded simulator continues with the same bits, events and callbacks; a save that contradicts itself is refused.
//! The [events](PhysicsSimulator::events), counters and times of the last update are not saved: the next one overwrites
//! them and does not depend on them.

use serde::{Deserialize, Deserializer, Serialize, de::Error as _};

use super::game_settings::GameSettings;
use super::{PhysicsSimulator, Settings};
use crate::broad_phase::BroadPhase;
use crate::contacts::arbiter::ArbiterList;
use crate::limits::Limits;
use crate::objects::{LoadedMovingObjects, MovingObjectsView, Objects, SavedObjects};
use crate::pipeline::Pipeline;
use crate::report::Report;
use crate::{Error, Result};

impl<'de> Deserialize<'de> for PhysicsSimulator {
    /// Within the default [`Limits`]; see [`SavedSimulator`].
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let saved = SavedSimulator::deserialize(deserializer)?;
        saved.load(Limits::default()).map_err(D::Error::custom)
    }
}

/// The saved parts of a simulator.
#[derive(Deserialize)]
struct SavedParts {
    settings: Settings,
    #[serde(with = "SavedObjects")]
    objects: Objects,
    contacts: ArbiterList,
    pipeline: Pipeline,
}

/// A simulator that was read and checked, and whose distance grids are still to be sampled: for loading with other
/// [`Limits`] than the default ones, or as a part of another saved object.
///
/// ```
/// use farseer_core::{Limits, PhysicsSimulator, SavedSimulator};
/// let bytes = postcard::to_stdvec(&PhysicsSimulator::default())?;
/// let saved: SavedSimulator = postcard::from_bytes(&bytes)?;
/// let simulator = saved.load(Limits { grid_work: 1 << 30, ..Limits::default() })?;
/// assert_eq!(simulator.limits().grid_work, 1 << 30);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct SavedSimulator(PhysicsSimulator);

impl<'de> Deserialize<'de> for SavedSimulator {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let SavedParts { settings, objects, contacts, pipeline } = SavedParts::deserialize(deserializer)?;
        let simulator = PhysicsSimulator {
            settings,
            objects,
            contacts,
            pipeline,
            report: Report::default(),
            game_settings: GameSettings::default(),
        };
        simulator.check().map_err(D::Error::custom)?;
        Ok(SavedSimulator(simulator))
    }
}

/// All of a simulator but its geoms.
#[derive(Serialize, Deserialize)]
pub(crate) struct MovingSimulator<O, A, P> {
    settings: Settings,
    objects: O,
    contacts: A,
    pipeline: P,
}

/// A simulator without geoms that was read.
pub(crate) type LoadedMovingSimulator = MovingSimulator<LoadedMovingObjects, ArbiterList, Pipeline>;

impl LoadedMovingSimulator {
    /// Returns a simulator with the geoms and limits of another one.
    pub(crate) fn load_with_geoms_of(self, simulator: &PhysicsSimulator) -> Result<PhysicsSimulator> {
        let loaded = PhysicsSimulator {
            settings: self.settings,
            objects: self.objects.with_geoms_of(&simulator.objects)?,
            contacts: self.contacts,
            pipeline: self.pipeline,
            report: Report::default(),
            game_settings: GameSettings::default(),
        };
        loaded.check()?;
        SavedSimulator(loaded).load(simulator.limits())
    }
}

impl SavedSimulator {
    /// Makes the simulator, which has these limits from then on.
    ///
    /// # Errors
    /// [`Error::LimitExceeded`] if the work of its distance grids exceeds the limits; a grid that cannot be made.
    pub fn load(self, limits: Limits) -> Result<PhysicsSimulator> {
        let mut simulator = self.0;
        simulator.set_limits(limits);
        simulator.objects.sample_grids()?;
        if simulator.pipeline.precise.is_some() {
            // Saves of former versions list geoms here, which the precise set does not use.
            simulator.pipeline.broad_phase = BroadPhase::new(simulator.objects.methods.broad());
        }
        // An engine with depth must set its depth data first.
        if let Some(precise) = simulator.pipeline.precise.as_mut().filter(|precise| !precise.has_depth()) {
            precise.rebuild_from_loaded(&mut simulator.objects);
        }
        Ok(simulator)
    }
}

impl PhysicsSimulator {
    /// Returns all but the geoms.
    pub(crate) fn moving(&self) -> MovingSimulator<MovingObjectsView<'_>, &ArbiterList, &Pipeline> {
        MovingSimulator {
            settings: self.settings,
            objects: self.objects.moving(),
            contacts: &self.contacts,
            pipeline: &self.pipeline,
        }
    }

    /// Refuses a simulator that no sequence of calls could have made, or with which a later call would fail.
    fn check(&self) -> Result<()> {
        let damaged = |reason| Err(Error::DamagedSave { reason });
        let settings = &self.settings;
        if ![settings.gravity.x, settings.gravity.y, settings.bias_factor, settings.allowed_penetration]
            .iter()
            .all(|value| value.is_finite())
        {
            return damaged("a setting is not finite");
        }
        self.objects.check()?;
        if !self.pipeline.broad_phase.is_valid(self.objects.methods.broad(), &self.objects.geoms) {
            return damaged("the broad phase names what is not there");
        }
        let methods = self.objects.methods;
        if !self.pipeline.precise.as_ref().map_or(!methods.is_precise(), |precise| precise.is_valid(methods))
        {
            return damaged("the precise set is not what the methods say, or not finite");
        }
        if !self.contacts.is_valid(&self.objects.geoms) {
            return damaged("an arbiter names what is not there or is not finite");
        }
        Ok(())
    }
}
