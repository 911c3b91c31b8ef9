//! Handle of a contact constraint in the constraint graph, and constraints that are parked outside of the colours.

use super::color::{Color, OVERFLOW_COLOR, SlotIndex};
use super::contact_constraint::ContactConstraint;
use crate::depth::feature_gate::IS_DEPTH_ENABLED;

/// Kind of a contact constraint, which determines the colour set that holds the constraint.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ConstraintKind {
    /// Whether the constraint has room for two points, else for one. In three axes: whether neither body is a ball.
    pub(crate) has_two_points: bool,
    /// Whether body A is static; a kinematic body does not count as static. B is never static.
    pub(crate) is_static: bool,
    /// Whether the constraint acts in three axes, with rows and components along the depth axis.
    pub(crate) is_3d: bool,
}

impl ConstraintKind {
    /// Returns whether the constraint acts in three axes. Constantly false in builds without a depth axis, so that the compiler
    /// removes the code.
    pub(super) fn uses_depth(self) -> bool {
        IS_DEPTH_ENABLED && self.is_3d
    }
}

/// Place of a contact constraint: a lane of a graph colour, or an entry in a list of parked constraints.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ConstraintHandle {
    /// The graph colour, or one of `SLEEPING_LIST` and `DIRECT_SOLVER_LIST`.
    pub color: Color,
    /// Place in the colour or in the list of parked constraints.
    pub slot: SlotIndex,
}

/// Value of [`ConstraintHandle::color`] in place of an index: the constraint is parked in the list of constraints of sleeping
/// bodies.
pub(super) const SLEEPING_LIST: Color = Color(u32::MAX);
/// Value of [`ConstraintHandle::color`] in place of an index: the constraint is parked in the list of the direct solver.
pub(super) const DIRECT_SOLVER_LIST: Color = Color(u32::MAX - 1);

impl ConstraintHandle {
    /// Returns whether the constraint is in the overflow colour, whose constraints are solved in order.
    pub fn is_overflow(self) -> bool {
        self.color == OVERFLOW_COLOR
    }

    /// Returns whether the constraint is parked for the direct solver.
    pub(crate) fn is_in_direct_solver(self) -> bool {
        self.color == DIRECT_SOLVER_LIST
    }
}

/// A contact constraint that the iterative solver skips: its bodies sleep, or its island is in the direct solver.
#[derive(Debug, Clone, Copy)]
pub struct ParkedConstraint {
    pub(crate) constraint: ContactConstraint,
    /// The graph colour that the constraint had before it was parked, and gets again when it is unparked.
    pub color: Color,
    /// Length of the substep in which the impulses of the constraint act, seconds.
    pub h: f32,
    /// Impulses as the direct solver found them, mass units * length units/s: normal impulses of both points, then friction.
    /// Each is valid while it rounds to the impulse of `constraint`.
    pub exact_impulses: [f64; 3],
}

impl ParkedConstraint {
    /// Returns the impulses of the constraint, mass units * length units/s: normal impulses of both points, then friction. An
    /// impulse that the direct solver found has double precision.
    #[inline(always)]
    pub(crate) fn impulses(&self) -> [f64; 3] {
        let [one, two] = &self.constraint.points;
        let rounded = [one.normal_impulse, two.normal_impulse, self.constraint.tangent_impulse];
        let exact = |row: usize| self.exact_impulses[row] as f32 == rounded[row];
        std::array::from_fn(|row| if exact(row) { self.exact_impulses[row] } else { f64::from(rounded[row]) })
    }

    /// Scales the impulses of the constraint from substeps of `self.h` seconds to substeps of `h` seconds, since an impulse is
    /// force times time. Impulses that are not finite become 0.
    pub(super) fn scale(&mut self, h: f32) {
        let factor = if h == self.h { 1.0 } else { h / self.h };
        let scale = |impulse: &mut f32| {
            *impulse *= factor;
            *impulse = if impulse.is_finite() { *impulse } else { 0.0 };
        };
        scale(&mut self.constraint.tangent_impulse);
        for point in &mut self.constraint.points {
            [&mut point.normal_impulse, &mut point.rest_impulse].into_iter().for_each(scale);
        }
    }
}
