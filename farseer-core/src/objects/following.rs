//! Geoms follow their bodies.

use super::Objects;
use crate::body::entry::BodyEntry;
use crate::body::{BodyId, Pose};
use crate::geom::entry::Geoms;
use crate::report::Notice;

/// What became of moving the geoms of a body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Followed {
    Yes,
    /// A box would not have been finite.
    PutBack {
        disabled: bool,
    },
}

/// Moves the geoms of a body to a pose, and answers whether their boxes are finite there.
fn move_geoms(entry: &BodyEntry, geoms: &mut Geoms, pose: Pose, all: bool) -> bool {
    let mut are_finite = true;
    for &geom in &entry.geoms {
        let geom = &mut geoms[geom];
        if all || geom.refresh_is_due {
            geom.follow(pose.position, pose.rotation);
            are_finite &= geom.place_is_finite();
        }
    }
    are_finite
}

impl Objects {
    /// Lets geoms follow a body that was edited; what it has refused is told when all edits settle.
    pub(crate) fn settle_body(&mut self, body: BodyId) {
        let Some(entry) = self.bodies.get(body) else { return };
        if entry.pending_pose().is_some() {
            // With the precise set geoms are behind without anybody having moved them.
            let was_moved = entry.body.pose_is_dirty || !self.methods.is_precise();
            match self.let_geoms_follow(body, true) {
                Followed::Yes if !was_moved => {}
                Followed::Yes => self.pending.push(Notice::BodyUpdated { body }),
                Followed::PutBack { disabled } => {
                    self.pending.push(Notice::NotFinite { body, disabled });
                }
            }
        }
    }

    /// Moves the geoms of a body to its pose. Those that are there already stay, unless `all` are to be refreshed.
    ///
    /// Should the box of a geom not be finite there, the body is put back to the pose that was followed before; a
    /// dynamic one is disabled.
    pub(crate) fn let_geoms_follow(&mut self, body: BodyId, all: bool) -> Followed {
        let entry = &mut self.bodies[body];
        entry.body.pose_is_dirty = false;
        let pose = entry.body.pose();
        if move_geoms(entry, &mut self.geoms, pose, all) {
            entry.followed = pose;
            return Followed::Yes;
        }
        let before = entry.followed;
        entry.body.restore_pose(before);
        move_geoms(entry, &mut self.geoms, before, true);
        let disabled = !entry.body.is_static();
        entry.body.set_enabled(entry.body.enabled() && !disabled);
        self.has_new_structure = true;
        Followed::PutBack { disabled }
    }
}
