//! Saving and loading the whole simulator.
//!
//! Everything that can influence a later bit is saved: queues, the order of sorted lists, arbiters with their
//! impulses and the pool they go back to, creation numbers. Distance grids are saved as the outline they are made
//! from. So is everything that is still to be told: what was disposed, moved or refused since the last update. What was
//! loaded continues with the same bits, events and callbacks; what contradicts itself is refused. The
//! [events](PhysicsSimulator::events), counters and times of the last update are not saved: the next one overwrites
//! them and reads none of them.

use serde::{Deserialize, Deserializer, Serialize, Serializer, de::Error as _};

use super::PhysicsSimulator;
use super::editing::GEOM_NUMBERS;
use crate::body::{BodyId, Pose};
use crate::body_entry::BodyEntry;
use crate::collection::has_no_duplicates;
use crate::geom::GeomId;
use crate::geom_entry::GeomEntry;
use crate::limits::Limits;
use crate::nobody::check_bodies;
use crate::{Error, Result};

impl Serialize for PhysicsSimulator {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        PhysicsSimulator::serialize(self, serializer)
    }
}

impl<'de> Deserialize<'de> for PhysicsSimulator {
    /// Within the default [`Limits`]; see [`SavedSimulator`].
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let saved = SavedSimulator::deserialize(deserializer)?;
        saved.load(Limits::default()).map_err(D::Error::custom)
    }
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
        let simulator = PhysicsSimulator::deserialize(deserializer)?;
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
        simulator.make_grids()?;
        Ok(simulator)
    }
}

impl PhysicsSimulator {
    /// Geoms of equal outline and cell size share one grid again.
    fn make_grids(&mut self) -> Result<()> {
        let with_grid = |(id, geom): (GeomId, &GeomEntry)| geom.grid.clone().map(|grid| (id, grid));
        let to_be_made: Vec<_> = self.geoms.iter().filter_map(with_grid).collect();
        for (geom, grid) in to_be_made {
            let grid = self.distance_grid(grid.outline(), grid.cell_size())?;
            self.geoms[geom].set_grid(grid);
        }
        Ok(())
    }

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
        if self.next_geom_number > GEOM_NUMBERS {
            return damaged("more creation numbers were used than there are");
        }
        if !self.bodies.is_consistent() || !self.geoms.is_consistent() {
            return damaged("a free slot is occupied");
        }
        if !self.lists_are_consistent() {
            return damaged("a list names an object that is not there, or twice");
        }
        let attachments = self.attachments();
        let mut geoms = self.geoms.iter::<GeomId>();
        if !geoms.all(|(id, geom)| {
            geom.is_valid()
                && geom.number < self.next_geom_number
                && self.bodies.get(geom.body).is_some_and(|body| {
                    geom.is_disposed
                        || (attachments[id.slot()] == 1
                            && geom.would_be_finite_at(body.followed.position, body.followed.rotation))
                })
        }) {
            return damaged("a geom is not finite or not attached to its body");
        }
        let mut bodies = self.bodies.iter::<BodyId>();
        if !bodies
            .all(|(id, entry)| entry.is_consistent(|geom| self.geoms.get(geom).is_some_and(|g| g.body == id)))
        {
            return damaged("a body names a geom that is not its own");
        }
        if !(self.controllers.is_consistent() && self.joints.is_consistent() && self.springs.is_consistent())
        {
            return damaged("a list of joints, springs or controllers does not name what it should");
        }
        if !self.controllers.iter().all(|(_, controller)| controller.is_valid())
            || !self.joints.iter().all(|(_, joint)| joint.is_valid())
            || !self.springs.iter().all(|(_, spring)| spring.is_valid())
        {
            return damaged("a joint, spring or controller has a value that is not possible");
        }
        if !self.joints_and_springs_have_bodies() {
            return damaged("a joint or spring takes part without its bodies");
        }
        if !self.broad_phase.is_valid(&self.geoms) {
            return damaged("the broad phase names what is not there");
        }
        if !self.arbiters.is_valid(&self.geoms) {
            return damaged("an arbiter names what is not there or is not finite");
        }
        Ok(())
    }

    /// Only what has all of its bodies can be added.
    fn joints_and_springs_have_bodies(&self) -> bool {
        let mut joints = self.joints.listed_or_queued();
        let mut springs = self.springs.listed_or_queued();
        joints.all(|joint| check_bodies("joint", joint.body1(), joint.body2()).is_ok())
            && springs.all(|spring| check_bodies("spring", spring.body1(), spring.body2()).is_ok())
    }

    /// By slot of the geom: how often the bodies name it. No body names another's: that is checked, too.
    fn attachments(&self) -> Vec<u32> {
        let mut attachments = vec![0; self.geoms.slot_count()];
        let named = self.bodies.iter::<BodyId>().flat_map(|(_, body)| &body.geoms);
        for &geom in named.filter(|&&geom| self.geoms.contains(geom)) {
            attachments[geom.slot()] += 1;
        }
        attachments
    }

    fn lists_are_consistent(&self) -> bool {
        let listed_bodies = self.bodies.iter::<BodyId>().filter(|(_, entry)| entry.is_listed).count();
        let listed_geoms = self.geoms.iter::<GeomId>().filter(|(_, entry)| entry.is_listed).count();
        let queues = &self.queues;
        let waiting_bodies = self.bodies.iter::<BodyId>().filter(|(_, entry)| entry.is_queued).count();
        let waiting_geoms = self.geoms.iter::<GeomId>().filter(|(_, entry)| entry.is_queued).count();
        let disposed_bodies = self.bodies.iter::<BodyId>().filter(|(_, entry)| entry.is_disposed).count();
        let disposed_geoms = self.geoms.iter::<GeomId>().filter(|(_, entry)| entry.is_disposed).count();
        let queued_body = |id: &&BodyId| self.bodies.get(**id).is_some_and(|entry| entry.is_queued);
        let queued_geom = |id: &&GeomId| self.geoms.get(**id).is_some_and(|entry| entry.is_queued);
        has_no_duplicates(&queues.added_bodies)
            && has_no_duplicates(&queues.added_geoms)
            && queues.added_bodies.iter().filter(queued_body).count() == waiting_bodies
            && queues.added_geoms.iter().filter(queued_geom).count() == waiting_geoms
            && has_no_duplicates(&self.body_list)
            && has_no_duplicates(&self.geom_list)
            && has_no_duplicates(&queues.disposed_bodies)
            && has_no_duplicates(&queues.disposed_geoms)
            && queues.disposed_bodies.len() == disposed_bodies
            && queues.disposed_geoms.len() == disposed_geoms
            && self.body_list.len() == listed_bodies
            && self.geom_list.len() == listed_geoms
            && self.body_list.iter().all(|&id| self.bodies.get(id).is_some_and(|entry| entry.is_listed))
            && self.geom_list.iter().all(|&id| self.geoms.get(id).is_some_and(|entry| entry.is_listed))
            && queues
                .disposed_bodies
                .iter()
                .all(|&id| self.bodies.get(id).is_some_and(|entry| entry.is_disposed))
            && queues
                .disposed_geoms
                .iter()
                .all(|&id| self.geoms.get(id).is_some_and(|entry| entry.is_disposed))
    }
}

impl BodyEntry {
    fn is_consistent(&self, is_own_geom: impl Fn(GeomId) -> bool) -> bool {
        let Pose { position, rotation, total_rotation, .. } = self.followed;
        let followed = [position.x, position.y, rotation, total_rotation];
        followed.iter().all(|value| value.is_finite()) && self.geoms.iter().all(|&geom| is_own_geom(geom))
    }
}
