//! Check and completion of loaded objects.

use serde::{Deserialize, Serialize};

use super::creating::MAX_GEOM_NUMBERS;
use super::{NewMembers, Objects};
use crate::body::entry::{Bodies, BodyEntry};
use crate::body::missing_body::check_bodies;
use crate::body::{BodyId, Pose};
use crate::controllers::{Controller, ControllerId};
use crate::geom::GeomId;
use crate::geom::entry::{GeomEntry, Geoms};
use crate::geom::grid_cache::GridCache;
use crate::joints::{Joint, JointId};
use crate::limits::Limits;
use crate::methods::Methods;
use crate::report::PendingEvent;
use crate::springs::{Spring, SpringId};
use crate::storage::collection::Collection;
use crate::{Error, Result};

/// The fields of [`Objects`]. `Objects` does not derive `Deserialize`, so that no one is loaded without the check.
#[derive(Serialize, Deserialize)]
#[serde(remote = "Objects")]
pub(crate) struct SavedObjects {
    bodies: Bodies,
    geoms: Geoms,
    controllers: Collection<Controller, ControllerId>,
    joints: Collection<Joint, JointId>,
    springs: Collection<Spring, SpringId>,
    next_geom_number: u32,
    touched_bodies: Vec<BodyId>,
    touched_geoms: Vec<GeomId>,
    pending: Vec<PendingEvent>,
    methods: Methods,
    has_new_members: bool,
    /// Not saved: the precise set lists all bodies of a loaded simulator anew.
    #[serde(skip)]
    new_members: NewMembers,
    has_new_structure: bool,
    /// Not saved: a loaded simulator reads all joints.
    #[serde(skip)]
    has_edited_joints: bool,
    #[serde(skip)]
    has_edited_drives: bool,
    separated_bodies: Vec<(BodyId, BodyId)>,
    #[serde(skip)]
    limits: Limits,
    #[serde(skip)]
    grids: GridCache,
}

impl Objects {
    /// Samples the distance grids of loaded geoms; geoms of equal outline and cell size share one grid again.
    pub(crate) fn sample_grids(&mut self) -> Result<()> {
        let with_grid = |(id, geom): (GeomId, &GeomEntry)| geom.grid.clone().map(|grid| (id, grid));
        let to_be_made: Vec<_> = self.geoms.iter().filter_map(with_grid).collect();
        for (geom, grid) in to_be_made {
            let grid = self.distance_grid(grid.outline(), grid.cell_size())?;
            self.geoms[geom].set_grid(grid);
        }
        Ok(())
    }

    /// Refuses objects that no sequence of calls could have made, or with which a later call would fail.
    pub(crate) fn check(&self) -> Result<()> {
        let damaged = |reason| Err(Error::DamagedSave { reason });
        if self.next_geom_number > MAX_GEOM_NUMBERS {
            return damaged("more creation numbers were used than there are");
        }
        if !(self.bodies.is_consistent()
            && self.geoms.is_consistent()
            && self.controllers.is_consistent()
            && self.joints.is_consistent()
            && self.springs.is_consistent())
        {
            return damaged("a list names an object that is not there, or twice");
        }
        if !self.geoms_are_valid() {
            return damaged("a geom is not finite or not attached to its body");
        }
        if self.geoms.listed_or_queued().any(|geom| self.methods.check_geom(geom).is_err()) {
            return damaged("a geom takes part that the faithful methods do not have");
        }
        if self.joints.listed_or_queued().any(|joint| self.methods.check_joint(joint).is_err()) {
            return damaged("a joint takes part that the faithful methods do not have");
        }
        if !self.bodies_are_valid() {
            return damaged("a body names a geom that is not its own");
        }
        if !self.controllers.iter().all(|(_, controller)| controller.is_valid())
            || !self.joints.iter().all(|(_, joint)| joint.is_valid())
            || !self.springs.iter().all(|(_, spring)| spring.is_valid())
        {
            return damaged("a joint, spring or controller has a value that is not possible");
        }
        if !self.separated_bodies.is_sorted() {
            return damaged("the bodies that joints keep from colliding are not in order");
        }
        if !self.joints_and_springs_have_bodies() {
            return damaged("a joint or spring takes part without its bodies");
        }
        Ok(())
    }

    fn geoms_are_valid(&self) -> bool {
        let attachments = self.attachments();
        let is_at_its_place = |id: GeomId, geom: &GeomEntry, body: &BodyEntry| {
            attachments[id.slot()] == 1
                && geom.would_be_finite_at(body.followed.position, body.followed.rotation)
        };
        self.geoms.iter().all(|(id, geom)| {
            let body = self.bodies.get(geom.body);
            geom.is_valid()
                && geom.number < self.next_geom_number
                && body.is_some_and(|body| self.geoms.is_disposed(id) || is_at_its_place(id, geom, body))
        })
    }

    fn bodies_are_valid(&self) -> bool {
        self.bodies.iter().all(|(id, entry)| {
            entry.is_consistent(|geom| self.geoms.get(geom).is_some_and(|geom| geom.body == id))
        })
    }

    /// Whether all joints and springs that are listed or queued have all of their bodies: only these can be added.
    fn joints_and_springs_have_bodies(&self) -> bool {
        let mut joints = self.joints.listed_or_queued();
        let mut springs = self.springs.listed_or_queued();
        joints.all(|joint| check_bodies("joint", joint.body1(), joint.body2()).is_ok())
            && springs.all(|spring| check_bodies("spring", spring.body1(), spring.body2()).is_ok())
    }

    /// Number of bodies that list a geom, by the geom's slot. `check` also makes sure that no body lists the geom of
    /// another.
    fn attachments(&self) -> Vec<u32> {
        let mut attachments = vec![0; self.geoms.slot_count()];
        let named = self.bodies.iter().flat_map(|(_, body)| &body.geoms);
        for &geom in named.filter(|&&geom| self.geoms.contains(geom)) {
            attachments[geom.slot()] += 1;
        }
        attachments
    }
}

impl BodyEntry {
    fn is_consistent(&self, is_own_geom: impl Fn(GeomId) -> bool) -> bool {
        let Pose { position, rotation, total_rotation, .. } = self.followed;
        let followed = [position.x, position.y, rotation, total_rotation];
        followed.iter().all(|value| value.is_finite()) && self.geoms.iter().all(|&geom| is_own_geom(geom))
    }
}
