//! Graph colours that each body uses, for the greedy colouring of new constraints.

use super::color::{Color, OVERFLOW_COLOR, lowest_color};
use super::constraint_handle::ConstraintKind;
use crate::index::{BodyIndex, IndexedVec};
use crate::reusing_clone;

/// Mask of the colours used at each body (bit i for colour i), indexed like the bodies. Constraints with a static body have
/// masks of their own, since a separate loop solves them. The overflow colour never counts. Static and kinematic bodies use no
/// colour: impulses do not change their velocities, so that constraints of one colour may share them.
#[derive(Debug, Default)]
pub struct ColorUsage {
    /// For each body the mask of the colours of its constraints with movable bodies: dynamic, kinematic or on a hinge.
    movable_colors: IndexedVec<BodyIndex, u32>,
    /// For each body the mask of the colours of its constraints with static bodies.
    static_colors: IndexedVec<BodyIndex, u32>,
    /// For each body whether it has finite mass or finite moment of inertia.
    is_dynamic: IndexedVec<BodyIndex, bool>,
}

reusing_clone! { ColorUsage { movable_colors, static_colors, is_dynamic } }

impl ColorUsage {
    /// Clears all masks, and stores which bodies are dynamic. `inverses`: reciprocals of mass (1/mass units) and moment of
    /// inertia (1/(mass units * length units^2)) of each body.
    pub(crate) fn reset(&mut self, inverses: &[[f32; 2]]) {
        for taken in [&mut self.movable_colors, &mut self.static_colors] {
            taken.clear();
            taken.resize(inverses.len(), 0);
        }
        self.is_dynamic.clear();
        self.is_dynamic.extend(inverses.iter().map(|&inverses| inverses != [0.0; 2]));
    }

    /// Stores whether a new body is dynamic. `inverses`: its reciprocals of mass (1/mass units) and moment of inertia (1/(mass
    /// units * length units^2)).
    pub fn add_body(&mut self, body: BodyIndex, inverses: [f32; 2]) {
        self.is_dynamic[body] = inverses != [0.0; 2];
    }

    /// Clears the masks of a removed body. Its constraints have been removed before.
    pub fn remove_body(&mut self, body: BodyIndex) {
        (self.movable_colors[body], self.static_colors[body], self.is_dynamic[body]) = (0, 0, false);
    }

    /// Excludes a hinged box from [`has_at_most_one_constraint`](Self::has_at_most_one_constraint) and
    /// [`has_no_constraint`](Self::has_no_constraint): two colours of constraints with static bodies count as used. A hinged
    /// box has no such constraints, so that the mask is free for this purpose.
    pub(crate) fn mark_hinged(&mut self, body: BodyIndex) {
        self.static_colors[body] = 0b11;
    }

    /// Returns whether a hinged box has no constraint; constraints in the overflow colour do not count.
    pub(crate) fn hinged_has_no_constraint(&self, body: BodyIndex) -> bool {
        self.movable_colors[body] == 0
    }

    /// Returns, by body index, the masks of the colours that constraints of this kind use.
    fn colors_of_kind(&mut self, kind: ConstraintKind) -> &mut IndexedVec<BodyIndex, u32> {
        if kind.is_static { &mut self.static_colors } else { &mut self.movable_colors }
    }

    /// Returns the mask of the colours that constraints of this kind leave free at both bodies.
    pub(crate) fn free_colors(&mut self, kind: ConstraintKind, bodies: [BodyIndex; 2]) -> u32 {
        let taken = self.colors_of_kind(kind);
        !bodies.iter().fold(0, |both, &body| both | taken[body])
    }

    /// Returns the colour for a constraint from a loaded snapshot: `color` or, if another constraint at one of the bodies has
    /// that colour, the lowest free one. The second case occurs in damaged snapshots only.
    pub(crate) fn reserve_color(
        &mut self,
        kind: ConstraintKind,
        bodies: [BodyIndex; 2],
        color: Color,
    ) -> Color {
        let is_taken = bodies.iter().any(|&body| color.is_in(self.colors_of_kind(kind)[body]));
        if is_taken { lowest_color(self.free_colors(kind, bodies)) } else { color }
    }

    /// Marks a colour as used (`is_taken`) or as free at both bodies. Has no effect at bodies of infinite mass and inertia, and
    /// for the overflow colour.
    pub(crate) fn set_color(
        &mut self,
        kind: ConstraintKind,
        bodies: [BodyIndex; 2],
        color: Color,
        is_taken: bool,
    ) {
        for body in bodies.into_iter().filter(|_| color != OVERFLOW_COLOR) {
            let bit = if self.is_dynamic[body] { 1 << color.0 } else { 0 };
            let colours = &mut self.colors_of_kind(kind)[body];
            *colours = if is_taken { *colours | bit } else { *colours & !bit };
        }
    }

    /// Returns whether a body has no constraint; constraints in the overflow colour do not count.
    #[inline(always)]
    pub fn has_no_constraint(&self, body: BodyIndex) -> bool {
        self.movable_colors[body] | self.static_colors[body] == 0
    }

    /// Returns whether a body has no constraint with another movable body; constraints in the overflow colour do not count.
    #[inline(always)]
    pub(crate) fn touches_only_static(&self, body: BodyIndex) -> bool {
        self.movable_colors[body] == 0
    }

    /// Returns whether a body has at most one constraint; constraints in the overflow colour do not count.
    #[inline(always)]
    pub(crate) fn has_at_most_one_constraint(&self, body: BodyIndex) -> bool {
        let (shared, fixed) = (self.movable_colors[body], self.static_colors[body]);
        (shared & shared.wrapping_sub(1)) | (fixed & fixed.wrapping_sub(1)) == 0
            && (shared == 0 || fixed == 0)
    }
}

#[cfg(test)]
mod tests {
    use super::{Color, ColorUsage, ConstraintKind};
    use crate::index::BodyIndex;

    #[test]
    fn static_bodies_use_no_colour() {
        let kind = ConstraintKind { has_two_points: true, is_static: false, is_3d: false };
        let mut usage = ColorUsage::default();
        usage.reset(&[[0.0; 2], [0.0; 2], [1.0, 0.0], [1.0, 1.0]]);
        usage.set_color(kind, [1, 2].map(BodyIndex), Color(0), true);
        assert_eq!(usage.free_colors(kind, [1, 3].map(BodyIndex)), !0);
        assert_eq!(usage.free_colors(kind, [1, 2].map(BodyIndex)), !1);
        assert!(
            usage.has_no_constraint(BodyIndex(1))
                && usage.has_at_most_one_constraint(BodyIndex(2))
                && !usage.has_no_constraint(BodyIndex(2))
        );
    }
}
