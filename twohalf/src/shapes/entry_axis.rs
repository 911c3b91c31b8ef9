//! Entry axis: the contact axis of two shapes is the one that they entered last.
//!
//! Lengths are px, times are steps: a displacement of m in the last step closes in by m per step. At the
//! moment of the last entry, some faces may be flush with the other shape, such as the floor when a box
//! reaches its next tile. Among these, the axis with the least closing motion is chosen; otherwise every seam
//! would be a wall.

use farseer_core::math::scalar;

/// Greatest time since entry, steps: one step for the motion of the last step, and one for edits of the game. A longer time
/// means that this motion did not cause the entry.
pub(crate) const MAX_ENTRY_AGE: f32 = 2.0;

/// Greatest penetration of resting or sliding contacts, as a factor of the slop, dimensionless. Contacts keep
/// one slop; the motion of a step adds to it.
pub(crate) const RESTING_SLOP_FACTOR: f32 = 2.0;

/// Penetration and closing motion along one axis.
#[derive(Debug, Clone, Copy)]
pub(crate) struct EntryAxis {
    /// Penetration along the axis, px.
    pub(crate) penetration: f32,
    /// Closing motion in the last step, px; negative if the shapes separate.
    pub(crate) closing: f32,
}

impl EntryAxis {
    /// Returns the time since the shapes began to overlap along the axis, steps. It is infinite if they do not close in along
    /// the axis, or if the time exceeds `MAX_ENTRY_AGE`.
    pub(crate) fn time(&self) -> f32 {
        let is_recent = self.closing > 0.0 && self.penetration <= MAX_ENTRY_AGE * self.closing;
        if is_recent { self.penetration / self.closing } else { f32::INFINITY }
    }

    /// Returns whether the axis was flush, or entered, at the time of the last entry, `latest` steps ago.
    pub(crate) fn is_entered_at(&self, latest: f32, slop: f32) -> bool {
        let since = if latest.is_finite() { scalar::max(self.closing, 0.0) * latest } else { 0.0 };
        self.time() <= latest && latest.is_finite() || self.penetration - since <= RESTING_SLOP_FACTOR * slop
    }

    /// Returns whether this axis is better than the axis `other`, both entered last: it has less closing motion, or equal
    /// closing motion and less penetration.
    pub(crate) fn is_better(&self, other: &EntryAxis) -> bool {
        let (closing, other_closing) = (scalar::max(self.closing, 0.0), scalar::max(other.closing, 0.0));
        closing < other_closing || (closing == other_closing && self.penetration < other.penetration)
    }
}

/// Returns whether the contact axis is the depth axis and not an axis of the plane. The plane's axis was entered `plane_time`
/// steps ago. Without motion in depth the depth axis needs a flush face.
pub(crate) fn is_depth_last(
    plane: EntryAxis,
    plane_time: f32,
    depth: EntryAxis,
    moves_in_depth: bool,
    slop: f32,
) -> bool {
    let depth_time = depth.time();
    let latest = scalar::min(plane_time, depth_time);
    let is_plane_tied = plane.is_entered_at(latest, slop) || (plane_time <= latest && latest.is_finite());
    match (is_plane_tied, depth.is_entered_at(latest, slop)) {
        (true, true) => depth.is_better(&plane) && (moves_in_depth || plane.closing > 0.0),
        (false, true) => true,
        (true, false) => false,
        (false, false) => moves_in_depth && depth.penetration < plane.penetration,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SLOP: f32 = 0.05;

    fn along(penetration: f32, closing: f32) -> EntryAxis {
        EntryAxis { penetration, closing }
    }

    fn is_depth(plane: EntryAxis, depth: EntryAxis) -> bool {
        is_depth_last(plane, plane.time(), depth, depth.closing != 0.0, SLOP)
    }

    #[test]
    fn the_axis_entered_last_is_the_one_they_meet_along() {
        assert!(is_depth(along(15.0, 16.0), along(2.0, 5.0)));
        assert!(!is_depth(along(2.0, 16.0), along(8.0, 9.0)));
    }

    #[test]
    fn a_landing_body_that_separates_in_depth_collides_in_the_plane() {
        assert!(!is_depth(along(12.0, 15.0), along(3.0, -0.3)));
    }

    #[test]
    fn a_body_that_slides_between_floors_in_depth_stays_on_top() {
        for overlap in [0.001, 0.01, 0.1, 0.3] {
            assert!(!is_depth(along(0.05, 0.0), along(overlap, 0.4)));
        }
    }

    #[test]
    fn a_body_that_moves_along_a_front_collides_with_the_next_front() {
        assert!(is_depth(along(0.3, 0.4), along(0.05, 0.0)));
    }

    #[test]
    fn a_deep_overlap_without_motion_in_depth_collides_in_the_plane() {
        assert!(!is_depth(along(5.0, 0.0), along(3.0, 0.0)));
        assert!(!is_depth(along(0.5, 1.0), along(3.0, 0.0)));
    }

    #[test]
    fn when_nothing_entered_just_now_the_smaller_overlap_decides() {
        assert!(is_depth(along(5.0, 0.0), along(3.0, 0.01)));
        assert!(!is_depth(along(3.0, 0.0), along(5.0, 0.01)));
    }
}
