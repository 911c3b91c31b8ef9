//! Where a row lives.

use super::colours::LAST;
use super::lane::Lane;
use crate::precise::space::IS_THERE;

/// What a row is between: two bodies that can be pushed, or one and something that does not give way, which then is A.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::precise) struct Kind {
    /// In three axes: neither of the two is a ball.
    pub(in crate::precise) has_two_points: bool,
    pub(in crate::precise) is_fixed: bool,
    pub(in crate::precise) is_in_space: bool,
}

impl Kind {
    pub(super) fn is_in_space(self) -> bool {
        IS_THERE && self.is_in_space
    }
}

/// Where a row lives: in a colour, or aside, [asleep](ASLEEP) or [solved with its island](DIRECT).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::precise) struct Home {
    pub(in crate::precise) colour: u32,
    pub(in crate::precise) slot: u32,
}

/// In place of a colour: the row is of bodies that sleep; or of an island that is solved as a whole.
pub(super) const ASLEEP: u32 = u32::MAX;
pub(super) const DIRECT: u32 = u32::MAX - 1;

impl Home {
    /// Whether the order of its colour's rows matters.
    pub(in crate::precise) fn is_in_order(self) -> bool {
        self.colour == LAST
    }

    /// Whether the row is solved with its island.
    pub(in crate::precise) fn is_direct(self) -> bool {
        self.colour == DIRECT
    }
}

/// A row that no pass looks at.
#[derive(Debug, Clone, Copy)]
pub(in crate::precise) struct Aside {
    pub(in crate::precise) lane: Lane,
    /// Which it goes back to.
    pub(in crate::precise) colour: u32,
    /// Seconds of the substeps that its impulses are of.
    pub(in crate::precise) h: f32,
    /// The impulses of points and friction as they were found last, if their rounded values still are those of the row.
    pub(in crate::precise) exact: [f64; 3],
}

impl Aside {
    /// Impulses of points and friction.
    #[inline(always)]
    pub(in crate::precise) fn impulses(&self) -> [f64; 3] {
        let [one, two] = &self.lane.points;
        let rounded = [one.impulse, two.impulse, self.lane.tangent_impulse];
        let exact = |row: usize| self.exact[row] as f32 == rounded[row];
        std::array::from_fn(|row| if exact(row) { self.exact[row] } else { f64::from(rounded[row]) })
    }

    /// Impulses are forces times the length of a substep.
    pub(super) fn scale(&mut self, h: f32) {
        let factor = if h == self.h { 1.0 } else { h / self.h };
        let scale = |impulse: &mut f32| {
            *impulse *= factor;
            *impulse = if impulse.is_finite() { *impulse } else { 0.0 };
        };
        scale(&mut self.lane.tangent_impulse);
        for point in &mut self.lane.points {
            [&mut point.impulse, &mut point.held].into_iter().for_each(scale);
        }
    }
}
