//! Velocities become positions, and geoms follow.

use crate::body::BodyId;
use crate::objects::{Followed, Objects};
use crate::report::{Event, Report};

/// Moves the body at a position of the list, unless it was disposed, and answers it if it was updated. One that would not
/// be finite is put back to its last finite state.
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
    // A way is finite only if the velocity was.
    if has_changed && !entry.body.place_is_finite() {
        entry.body.restore_pose(before);
        entry.body.set_enabled(false);
        report.push(Event::NotFinite { body, disabled: true });
        return None;
    }
    if !entry.body.has_moved() {
        return None;
    }
    if let Followed::PutBack { disabled } = objects.let_geoms_follow(body, has_changed) {
        report.push(Event::NotFinite { body, disabled });
        return None;
    }
    report.counters.bodies_moved += usize::from(has_changed);
    report.push(Event::BodyUpdated { body });
    Some(body)
}
