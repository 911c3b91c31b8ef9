//! Integration of positions: velocities move bodies, geoms follow.

use crate::body::BodyId;
use crate::objects::{Objects, TransformUpdate};
use crate::report::{Event, Report};

/// Moves the body at a position of the list, unless it was disposed, and returns its id if it was updated. A body whose
/// pose would not be finite is put back to its last finite pose.
pub(crate) fn move_body(
    objects: &mut Objects,
    report: &mut Report,
    position: usize,
    dt: f32,
) -> Option<BodyId> {
    let (body, entry) = objects.bodies.at_mut(position)?;
    if !entry.body.is_integrated() {
        return None;
    }
    let before = entry.body.pose();
    let has_changed = entry.body.integrate_position(dt);
    // The displacement is finite only if the velocity was.
    if has_changed && !entry.body.pose_is_finite() {
        entry.body.restore_pose(before);
        entry.body.set_enabled(false);
        report.push(Event::NotFinite { body, disabled: true });
        return None;
    }
    if !entry.body.has_moved() {
        return None;
    }
    if let TransformUpdate::Restored { disabled } = objects.update_geom_transforms(body, has_changed) {
        report.push(Event::NotFinite { body, disabled });
        return None;
    }
    report.counters.bodies_moved += usize::from(has_changed);
    report.push(Event::BodyUpdated { body });
    Some(body)
}
