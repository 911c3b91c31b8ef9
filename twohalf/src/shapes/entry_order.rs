//! Through which of several faces two shapes that begin to overlap have met: the one entered last.
//!
//! Lengths are px, times are steps: what moved by m in the last step closes in by m per step. At the moment of the
//! last entry some faces may be flush with what they touch: those that something rests on or slides along, such as
//! the floor when the next tile of it is reached. Of these, the one that least closes in is where the two meet;
//! otherwise every seam would be a wall.

use farseer_core::math::scalar;

/// An axis that was entered longer ago than this was entered before the pair was looked at last, so by something else
/// than its motion now: one step, and one more for what the game has changed since.
pub(crate) const RECENT: f32 = 2.0;

/// In units of slop: overlaps up to this are those of things that rest on or slide along each other. Contacts leave
/// one slop; the motion of a step adds to it.
pub(crate) const SHALLOW: f32 = 2.0;

/// An overlap along one axis.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Along {
    pub(crate) penetration: f32,
    /// Motion into each other in the last step; negative for what parts.
    pub(crate) closing: f32,
}

impl Along {
    /// Steps since the axis was entered; infinite when nothing closes in, or not fast enough to have entered just
    /// now.
    pub(crate) fn time(&self) -> f32 {
        let is_recent = self.closing > 0.0 && self.penetration <= RECENT * self.closing;
        if is_recent { self.penetration / self.closing } else { f32::INFINITY }
    }

    /// Whether this face was flush with what it touches, or entered, when the last one was, `latest` steps ago.
    pub(crate) fn is_tied(&self, latest: f32, slop: f32) -> bool {
        let since = if latest.is_finite() { scalar::max(self.closing, 0.0) * latest } else { 0.0 };
        self.time() <= latest && latest.is_finite() || self.penetration - since <= SHALLOW * slop
    }

    /// Of two tied ones, whether this is the better: it closes in less; if both do equally, it overlaps less.
    pub(crate) fn is_better(&self, other: &Along) -> bool {
        let (closing, other_closing) = (scalar::max(self.closing, 0.0), scalar::max(other.closing, 0.0));
        closing < other_closing || (closing == other_closing && self.penetration < other.penetration)
    }
}

/// Whether two shapes meet along the depth axis rather than in the plane, where they met `plane_time` steps ago.
/// What does not move in depth meets there only if it stands face to face.
pub(crate) fn is_depth_last(
    plane: Along,
    plane_time: f32,
    depth: Along,
    moves_in_depth: bool,
    slop: f32,
) -> bool {
    let depth_time = depth.time();
    let latest = scalar::min(plane_time, depth_time);
    let is_plane_tied = plane.is_tied(latest, slop) || (plane_time <= latest && latest.is_finite());
    match (is_plane_tied, depth.is_tied(latest, slop)) {
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

    fn along(penetration: f32, closing: f32) -> Along {
        Along { penetration, closing }
    }

    fn is_depth(plane: Along, depth: Along) -> bool {
        is_depth_last(plane, plane.time(), depth, depth.closing != 0.0, SLOP)
    }

    #[test]
    fn the_axis_entered_last_is_the_one_they_meet_along() {
        assert!(is_depth(along(15.0, 16.0), along(2.0, 5.0)));
        assert!(!is_depth(along(2.0, 16.0), along(8.0, 9.0)));
    }

    #[test]
    fn what_lands_while_it_parts_in_depth_meets_in_the_plane() {
        assert!(!is_depth(along(12.0, 15.0), along(3.0, -0.3)));
    }

    #[test]
    fn what_slides_from_one_floor_to_the_next_in_depth_stays_on_top() {
        for overlap in [0.001, 0.01, 0.1, 0.3] {
            assert!(!is_depth(along(0.05, 0.0), along(overlap, 0.4)));
        }
    }

    #[test]
    fn what_walks_along_a_front_meets_the_next_front() {
        assert!(is_depth(along(0.3, 0.4), along(0.05, 0.0)));
    }

    #[test]
    fn what_does_not_move_in_depth_and_overlaps_deeply_there_meets_in_the_plane() {
        assert!(!is_depth(along(5.0, 0.0), along(3.0, 0.0)));
        assert!(!is_depth(along(0.5, 1.0), along(3.0, 0.0)));
    }

    #[test]
    fn when_nothing_entered_just_now_the_smaller_overlap_decides() {
        assert!(is_depth(along(5.0, 0.0), along(3.0, 0.01)));
        assert!(!is_depth(along(3.0, 0.0), along(5.0, 0.01)));
    }
}
