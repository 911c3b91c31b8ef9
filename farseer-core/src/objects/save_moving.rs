//! Saving of all objects but the geoms, of which only the transforms are saved.

use serde::{Deserialize, Serialize};

use super::Objects;
use crate::body::BodyId;
use crate::body::entry::Bodies;
use crate::controllers::{Controller, ControllerId};
use crate::geom::GeomId;
use crate::geom::entry::GeomMotion;
use crate::joints::{Joint, JointId};
use crate::methods::Methods;
use crate::report::PendingEvent;
use crate::springs::{Spring, SpringId};
use crate::storage::collection::Collection;
use crate::{Error, Result};

/// All objects but the geoms, which stay those of the simulator. The lists of objects are references for a writer: a reader that
/// might clone them would have the code for it.
#[derive(Serialize, Deserialize)]
pub(crate) struct MovingObjects<B, C, J, S> {
    /// [Hash](Collection::membership_hash) of the geoms that exist and take part.
    geoms: u64,
    /// Motions of all geoms, by their slots.
    motions: Vec<GeomMotion>,
    bodies: B,
    controllers: C,
    joints: J,
    springs: S,
    next_geom_number: u32,
    touched_bodies: Vec<BodyId>,
    touched_geoms: Vec<GeomId>,
    pending: Vec<PendingEvent>,
    methods: Methods,
    has_new_members: bool,
    has_new_structure: bool,
    separated_bodies: Vec<(BodyId, BodyId)>,
}

type Joints = Collection<Joint, JointId>;
type Springs = Collection<Spring, SpringId>;
type Controllers = Collection<Controller, ControllerId>;

/// The objects of a simulator, to be written.
pub(crate) type MovingObjectsView<'a> = MovingObjects<&'a Bodies, &'a Controllers, &'a Joints, &'a Springs>;
/// Objects that were read.
pub(crate) type LoadedMovingObjects = MovingObjects<Bodies, Controllers, Joints, Springs>;

impl Objects {
    /// Returns all but the geoms.
    pub(crate) fn moving(&self) -> MovingObjectsView<'_> {
        MovingObjects {
            geoms: self.geoms.membership_hash(),
            motions: self.geoms.iter().map(|(_, geom)| geom.motion()).collect(),
            bodies: &self.bodies,
            controllers: &self.controllers,
            joints: &self.joints,
            springs: &self.springs,
            next_geom_number: self.next_geom_number,
            touched_bodies: self.touched_bodies.clone(),
            touched_geoms: self.touched_geoms.clone(),
            pending: self.pending.clone(),
            methods: self.methods,
            has_new_members: self.has_new_members,
            has_new_structure: self.has_new_structure,
            separated_bodies: self.separated_bodies.clone(),
        }
    }
}

impl LoadedMovingObjects {
    /// Returns these objects with the geoms of a simulator.
    ///
    /// # Errors
    /// Other geoms than those of which the motions were saved.
    pub(crate) fn with_geoms_of(self, objects: &Objects) -> Result<Objects> {
        if self.geoms != objects.geoms.membership_hash() || self.methods != objects.methods {
            return Err(Error::DamagedSave {
                reason: "it was made with other geoms or methods than the simulator has",
            });
        }
        let mut geoms = objects.geoms.clone();
        if !geoms.give_each(self.motions, |geom, motion| geom.set_motion(motion)) {
            return Err(Error::DamagedSave { reason: "it has another number of geoms than it says" });
        }
        Ok(Objects {
            geoms,
            bodies: self.bodies,
            controllers: self.controllers,
            joints: self.joints,
            springs: self.springs,
            next_geom_number: self.next_geom_number,
            touched_bodies: self.touched_bodies,
            touched_geoms: self.touched_geoms,
            pending: self.pending,
            methods: self.methods,
            has_new_members: self.has_new_members,
            has_new_structure: self.has_new_structure,
            separated_bodies: self.separated_bodies,
            limits: objects.limits,
            grids: objects.grids.clone(),
            ..Objects::empty()
        })
    }
}
