//! Saving and loading the whole simulator.
//!
//! Everything that can influence a later bit is saved: queues, the order of sorted lists, arbiters with their
//! impulses and the pool they go back to, creation numbers. Distance grids are saved as the outline they are made
//! from. So is everything that is still to be told: what was disposed, moved or refused since the last update. What was
//! loaded continues with the same bits, events and callbacks; what contradicts itself is refused. The
//! [events](PhysicsSimulator::events), counters and times of the last update are not saved: the next one overwrites
//! them and reads none of them.

use serde::{Deserialize, Deserializer, de::Error as _};

use super::{PhysicsSimulator, Settings};
use crate::contacts::arbiter::ArbiterList;
use crate::limits::Limits;
use crate::objects::{Objects, SavedObjects};
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

/// What is saved of a simulator.
#[derive(Deserialize)]
struct Parts {
    settings: Settings,
    #[serde(with = "SavedObjects")]
    objects: Objects,
    contacts: ArbiterList,
    pipeline: Pipeline,
}

/// A simulator that was read and checked, and whose distance grids are still to be made: to load with other [`Limits`]
/// than the default ones, or as a part of something else.
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
        let Parts { settings, objects, contacts, pipeline } = Parts::deserialize(deserializer)?;
        let simulator = PhysicsSimulator { settings, objects, contacts, pipeline, report: Report::default() };
        simulator.check().map_err(D::Error::custom)?;
        Ok(SavedSimulator(simulator))
    }
}

impl SavedSimulator {
    /// Makes the simulator, which has these limits from then on.
    ///
    /// # Errors
    /// [`Error::LimitExceeded`] if its distance grids are more work than is allowed; a grid that cannot be made.
    pub fn load(self, limits: Limits) -> Result<PhysicsSimulator> {
        let mut simulator = self.0;
        simulator.set_limits(limits);
        simulator.objects.make_grids()?;
        // Of a depth axis the engine above has to tell first.
        if let Some(precise) = simulator.pipeline.precise.as_mut().filter(|precise| !precise.is_in_space()) {
            precise.list_loaded(&mut simulator.objects);
        }
        Ok(simulator)
    }
}

impl PhysicsSimulator {
    /// Refuses what no sequence of calls could have made, and what would make a later call fail.
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
