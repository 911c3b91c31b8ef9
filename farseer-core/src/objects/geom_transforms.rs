//! Transforms of geoms: they follow from the poses of their bodies.

use super::Objects;
use crate::body::entry::BodyEntry;
use crate::body::{BodyId, Pose};
use crate::geom::entry::Geoms;
use crate::report::PendingEvent;

/// Result of updating the geoms of a body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum TransformUpdate {
    Updated,
    /// A box would not have been finite; the body was put back to its last pose.
    Restored {
        disabled: bool,
    },
}

/// Moves the geoms of a body to a pose, and returns whether their boxes are finite there.
fn move_geoms(entry: &BodyEntry, geoms: &mut Geoms, pose: Pose, all: bool) -> bool {
    let mut are_finite = true;
    for &geom in &entry.geoms {
        let geom = &mut geoms[geom];
        if all || geom.refresh_is_due {
            geom.update_transform(pose.position, pose.rotation);
            are_finite &= geom.pose_is_finite();
        }
    }
    are_finite
}

impl Objects {
    /// Updates the geoms of a body that was edited. A body that is put back is reported when all edits are applied.
    pub(crate) fn update_edited_geom_transforms(&mut self, body: BodyId) {
        let Some(entry) = self.bodies.get(body) else { return };
        if entry.pending_pose().is_some() {
            // With the precise set the transforms of geoms are out of date also without an edit.
            let was_moved = entry.body.pose_is_dirty || !self.methods.is_precise();
            match self.update_geom_transforms(body, true) {
                TransformUpdate::Updated if !was_moved => {}
                TransformUpdate::Updated => self.pending.push(PendingEvent::BodyUpdated { body }),
                TransformUpdate::Restored { disabled } => {
                    self.pending.push(PendingEvent::NotFinite { body, disabled });
                }
            }
        }
    }

    /// Updates the geoms of a body for its pose. Geoms that are up to date are skipped, unless `all` is set.
    ///
    /// If the box of a geom is not finite there, the body is put back to the pose at which its geoms were updated last;
    /// a dynamic one is disabled.
    pub(crate) fn update_geom_transforms(&mut self, body: BodyId, all: bool) -> TransformUpdate {
        let entry = &mut self.bodies[body];
        entry.body.pose_is_dirty = false;
        let pose = entry.body.pose();
        if move_geoms(entry, &mut self.geoms, pose, all) {
            entry.followed = pose;
            return TransformUpdate::Updated;
        }
        let before = entry.followed;
        entry.body.restore_pose(before);
        move_geoms(entry, &mut self.geoms, before, true);
        let disabled = !entry.body.is_static();
        entry.body.set_enabled(entry.body.enabled() && !disabled);
        self.has_new_structure = true;
        TransformUpdate::Restored { disabled }
    }
}
