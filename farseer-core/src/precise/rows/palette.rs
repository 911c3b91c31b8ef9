//! Which colours are free for a new row.

use super::colours::{LAST, first_of};
use super::home::Kind;
use crate::storage::reusing_clone::reusing_clone;

/// Which colours are taken at each body, by bits: among rows of two bodies, and among those with something fixed. The last
/// colour is never taken, and what cannot be pushed takes none: rows that share it do not disturb each other.
#[derive(Debug, Default)]
pub(in crate::precise) struct Palette {
    shared: Vec<u32>,
    fixed: Vec<u32>,
    /// Whether a body can be pushed.
    gives_way: Vec<bool>,
}

reusing_clone! { Palette { shared, fixed, gives_way } }

impl Palette {
    /// For bodies with these reciprocals of mass and inertia.
    pub(in crate::precise) fn reset(&mut self, inverses: &[[f32; 2]]) {
        for taken in [&mut self.shared, &mut self.fixed] {
            taken.clear();
            taken.resize(inverses.len(), 0);
        }
        self.gives_way.clear();
        self.gives_way.extend(inverses.iter().map(|&inverses| inverses != [0.0; 2]));
    }

    /// A body has come, with these reciprocals of mass and inertia.
    pub(in crate::precise) fn add(&mut self, body: usize, inverses: [f32; 2]) {
        self.gives_way[body] = inverses != [0.0; 2];
    }

    /// A body has gone, and its rows.
    pub(in crate::precise) fn forget(&mut self, body: usize) {
        (self.shared[body], self.fixed[body], self.gives_way[body]) = (0, 0, false);
    }

    /// A body never counts as one that nothing, or one row alone, touches: it swings, and has no rows with what is fixed.
    pub(in crate::precise) fn note_swing(&mut self, body: usize) {
        self.fixed[body] = 0b11;
    }

    /// Whether one that swings has no row, but for those of the last colour.
    pub(in crate::precise) fn swings_freely(&self, body: usize) -> bool {
        self.shared[body] == 0
    }

    fn of(&mut self, kind: Kind) -> &mut [u32] {
        if kind.is_fixed { &mut self.fixed } else { &mut self.shared }
    }

    /// The colours that are free at both bodies, by bits.
    pub(in crate::precise) fn free(&mut self, kind: Kind, bodies: [u32; 2]) -> u32 {
        let taken = self.of(kind);
        !bodies.iter().fold(0, |both, &body| both | taken[body as usize])
    }

    /// This colour, unless a damaged save says that it is taken already: then the first free one.
    pub(in crate::precise) fn again(&mut self, kind: Kind, bodies: [u32; 2], colour: u32) -> u32 {
        let is_taken = bodies.iter().any(|&body| self.of(kind)[body as usize] >> colour & 1 == 1);
        if is_taken { first_of(self.free(kind, bodies)) } else { colour }
    }

    /// A row with this colour begins or ends.
    pub(in crate::precise) fn mark(&mut self, kind: Kind, bodies: [u32; 2], colour: u32, is_taken: bool) {
        for body in bodies.into_iter().filter(|_| colour != LAST) {
            let bit = if self.gives_way[body as usize] { 1 << colour } else { 0 };
            let colours = &mut self.of(kind)[body as usize];
            *colours = if is_taken { *colours | bit } else { *colours & !bit };
        }
    }

    /// Whether a body has no row, but for those of the last colour.
    #[inline(always)]
    pub(in crate::precise) fn is_free(&self, body: usize) -> bool {
        self.shared[body] | self.fixed[body] == 0
    }

    /// Whether a body has no row with another body that can be pushed, but for those of the last colour.
    #[inline(always)]
    pub(in crate::precise) fn touches_fixed_alone(&self, body: usize) -> bool {
        self.shared[body] == 0
    }

    /// Whether a body has one row at most, but for those of the last colour.
    #[inline(always)]
    pub(in crate::precise) fn is_single(&self, body: usize) -> bool {
        let (shared, fixed) = (self.shared[body], self.fixed[body]);
        (shared & shared.wrapping_sub(1)) | (fixed & fixed.wrapping_sub(1)) == 0
            && (shared == 0 || fixed == 0)
    }
}

#[cfg(test)]
mod tests {
    use super::{Kind, Palette};

    #[test]
    fn what_cannot_be_pushed_takes_no_colour() {
        let kind = Kind { has_two_points: true, is_fixed: false, is_in_space: false };
        let mut palette = Palette::default();
        palette.reset(&[[0.0; 2], [0.0; 2], [1.0, 0.0], [1.0, 1.0]]);
        palette.mark(kind, [1, 2], 0, true);
        assert_eq!(palette.free(kind, [1, 3]), !0);
        assert_eq!(palette.free(kind, [1, 2]), !1);
        assert!(palette.is_free(1) && palette.is_single(2) && !palette.is_free(2));
    }
}
