//! A body as the simulator stores it: with its geoms and the state of edits.

use serde::{Deserialize, Serialize};

use crate::body::{Body, BodyId, Pose};
use crate::math::Vector2;
use crate::storage::collection::Collection;
use crate::storage::ids::GeomId;
use farseer_precise::reusing_clone;

/// The bodies of a simulator.
pub(crate) type Bodies = Collection<BodyEntry, BodyId>;

/// A body in the simulator, with its attached geoms.
#[derive(Debug, Serialize, Deserialize)]
pub(crate) struct BodyEntry {
    pub(crate) body: Body,
    /// Geoms of the body, in the order in which they were attached.
    pub(crate) geoms: Vec<GeomId>,
    /// Pose of the body when its geoms were last brought to it.
    pub(crate) followed: Pose,
    /// Whether the game has borrowed the body mutably since edits were last applied.
    pub(crate) is_touched: bool,
}

reusing_clone! { BodyEntry { body, geoms, followed, is_touched } }

impl BodyEntry {
    pub(crate) fn new(body: Body) -> Self {
        BodyEntry { followed: body.pose(), body, geoms: Vec::new(), is_touched: false }
    }

    /// Removes `geom` from the attached geoms, if it is one of them. Bodies with thousands of geoms lose them one by
    /// one, so the search ends at the geom.
    pub(crate) fn detach(&mut self, geom: GeomId) {
        if let Some(position) = self.geoms.iter().position(|&other| other == geom) {
            self.geoms.remove(position);
        }
    }

    /// The pose, if the geoms have not been brought to it yet.
    #[inline]
    pub(crate) fn pending_pose(&self) -> Option<(Vector2, f32)> {
        let (position, rotation) = (self.body.position(), self.body.rotation());
        let has_moved = position != self.followed.position || rotation != self.followed.rotation;
        (self.body.pose_is_dirty || has_moved).then_some((position, rotation))
    }
}
