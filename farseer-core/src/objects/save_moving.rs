//! Saving of all objects but the geoms, of which only the transforms are saved.

use std::borrow::Cow;

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

/// All objects but the geoms, which stay those of the simulator.
#[derive(Serialize, Deserialize)]
pub(crate) struct MovingObjects<'a> {
    /// [Hash](Collection::membership_hash) of the geoms that exist and take part.
    geoms: u64,
    /// Motions of all geoms, by their slots.
    motions: Vec<GeomMotion>,
    bodies: Cow<'a, Bodies>,
    controllers: Cow<'a, Collection<Controller, ControllerId>>,
    joints: Cow<'a, Collection<Joint, JointId>>,
    springs: Cow<'a, Collection<Spring, SpringId>>,
    next_geom_number: u32,
    touched_bodies: Cow<'a, [BodyId]>,
    touched_geoms: Cow<'a, [GeomId]>,
    pending: Cow<'a, [PendingEvent]>,
    methods: Methods,
    has_new_members: bool,
    has_new_structure: bool,
    separated_bodies: Cow<'a, [(BodyId, BodyId)]>,
}

impl Objects {
    /// Returns all but the geoms.
    pub(crate) fn moving(&self) -> MovingObjects<'_> {
        MovingObjects {
            geoms: self.geoms.membership_hash(),
            motions: self.geoms.iter().map(|(_, geom)| geom.motion()).collect(),
            bodies: Cow::Borrowed(&self.bodies),
            controllers: Cow::Borrowed(&self.controllers),
            joints: Cow::Borrowed(&self.joints),
            springs: Cow::Borrowed(&self.springs),
            next_geom_number: self.next_geom_number,
            touched_bodies: Cow::Borrowed(&self.touched_bodies),
            touched_geoms: Cow::Borrowed(&self.touched_geoms),
            pending: Cow::Borrowed(&self.pending),
            methods: self.methods,
            has_new_members: self.has_new_members,
            has_new_structure: self.has_new_structure,
            separated_bodies: Cow::Borrowed(&self.separated_bodies),
        }
    }
}

impl MovingObjects<'_> {
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
            bodies: self.bodies.into_owned(),
            controllers: self.controllers.into_owned(),
            joints: self.joints.into_owned(),
            springs: self.springs.into_owned(),
            next_geom_number: self.next_geom_number,
            touched_bodies: self.touched_bodies.into_owned(),
            touched_geoms: self.touched_geoms.into_owned(),
            pending: self.pending.into_owned(),
            methods: self.methods,
            has_new_members: self.has_new_members,
            has_new_structure: self.has_new_structure,
            separated_bodies: self.separated_bodies.into_owned(),
            limits: objects.limits,
            grids: objects.grids.clone(),
            ..Objects::empty()
        })
    }
}
