//! Velocities become positions, and geoms follow.

use crate::body::BodyId;
use crate::objects::{Followed, Objects};

/// What became of a body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Moved {
    /// It has never moved, or is not integrated.
    Not,
    /// It was updated; its pose changed or not.
    Updated { has_changed: bool },
    /// It was put back to its last finite state.
    PutBack { disabled: bool },
}

/// Moves the body at a position of the list, unless it was disposed.
pub(crate) fn move_body(objects: &mut Objects, position: usize, dt: f32) -> Option<(BodyId, Moved)> {
    let (id, entry) = objects.bodies.at_mut(position)?;
    if !entry.body.is_integrated() {
        return Some((id, Moved::Not));
    }
    let before = entry.body.pose();
    let has_changed = entry.body.integrate_position(dt);
    if has_changed && !entry.body.is_finite() {
        entry.body.restore_pose(before);
        entry.body.set_enabled(false);
        return Some((id, Moved::PutBack { disabled: true }));
    }
    if !entry.body.has_moved() {
        return Some((id, Moved::Not));
    }
    let moved = match objects.let_geoms_follow(id, has_changed) {
        Followed::Yes => Moved::Updated { has_changed },
        Followed::PutBack { disabled } => Moved::PutBack { disabled },
    };
    Some((id, moved))
}
