//! What the simulator keeps of a body.

use serde::{Deserialize, Serialize};

use crate::body::{Body, BodyId, Pose};
use crate::math::Vector2;
use crate::storage::collection::Collection;
use crate::storage::ids::GeomId;
use crate::storage::reusing_clone::reusing_clone;

/// The bodies of a simulator.
pub(crate) type Bodies = Collection<BodyEntry, BodyId>;

/// What the simulator keeps of a body.
#[derive(Debug, Serialize, Deserialize)]
pub(crate) struct BodyEntry {
    pub(crate) body: Body,
    /// In the order in which they were attached.
    pub(crate) geoms: Vec<GeomId>,
    /// The pose the geoms have followed.
    pub(crate) followed: Pose,
    /// It was lent out for editing since the simulator last looked.
    pub(crate) is_touched: bool,
}

reusing_clone! { BodyEntry { body, geoms, followed, is_touched } }

impl BodyEntry {
    pub(crate) fn new(body: Body) -> Self {
        BodyEntry { followed: body.pose(), body, geoms: Vec::new(), is_touched: false }
    }

    /// The geom is not attached any more, if it was. Bodies of thousands of geoms let them go one by one, so nothing is
    /// looked at beyond it.
    pub(crate) fn detach(&mut self, geom: GeomId) {
        if let Some(position) = self.geoms.iter().position(|&other| other == geom) {
            self.geoms.remove(position);
        }
    }

    /// The pose, if the geoms have not followed it yet.
    #[inline]
    pub(crate) fn pending_pose(&self) -> Option<(Vector2, f32)> {
        let (position, rotation) = (self.body.position(), self.body.rotation());
        let has_moved = position != self.followed.position || rotation != self.followed.rotation;
        (self.body.pose_is_dirty || has_moved).then_some((position, rotation))
    }
}
