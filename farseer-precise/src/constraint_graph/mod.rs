//! Constraint graph: contact constraints in graph colours. No two constraints of a colour share a body of finite mass, so that
//! four of them are solved at once in SIMD lanes and their order has no effect. The overflow colour takes the constraints for
//! which no colour is free: it has one constraint per block and is solved in order.
//!
//! A constraint keeps its place from step to step. The narrow phase adds, updates and removes constraints; `contact_solver/`
//! solves them. Constraints of sleeping bodies, and of islands in the direct solver, are parked: in lists outside of the
//! colours.
//!
//! Greedy colouring as constraints come and go, the overflow colour and one SIMD lane per constraint follow Box2D 3 (E. Catto,
//! "SIMD Matters", box2d.org, 2024; `constraint_graph.c`, `contact_solver.c`). Box2D cites Y.-K. Chen et al., "High-Performance
//! Physical Simulations on Next-Generation Architecture with Many Cores" (2007).

pub mod color;
pub mod color_set;
pub mod color_usage;
pub mod constraint_handle;
pub mod contact_constraint;
pub mod contact_constraint_3d;
pub mod contact_constraint_simd;
pub mod impulse_scaling;
pub mod saved_constraint;

use crate::index::{BodyIndex, IndexedVec, PairIndex};
use crate::reusing_clone;
use color::OVERFLOW_COLOR;
pub use color::{COLOR_COUNT, Color, SlotIndex};
pub use color_set::ColorSet;
pub(crate) use color_usage::ColorUsage;
pub use constraint_handle::{ConstraintHandle, ConstraintKind, ParkedConstraint};
use constraint_handle::{DIRECT_SOLVER_LIST, SLEEPING_LIST};
pub use contact_constraint::{ContactConstraint, ContactConstraintZ, ContactPoint};
pub(crate) use contact_constraint_3d::{ContactConstraint3Simd, tangents};
pub(crate) use contact_constraint_simd::{
    ContactConstraintSimd, ContactPointSimd, SimdContacts, SimdSlot, set_lane,
};

/// All contact constraints: in colours by kind, or parked.
#[derive(Debug, Default)]
pub struct ConstraintGraph {
    /// Parked constraints of sleeping bodies.
    sleeping: IndexedVec<SlotIndex, ParkedConstraint>,
    /// Parked constraints of islands in the direct solver.
    direct: IndexedVec<SlotIndex, ParkedConstraint>,
    /// Whether a constraint in the direct solver may have got other arms or impulses, except by its solution, since the last
    /// [`take_direct_change`](ConstraintGraph::take_direct_change).
    has_direct_change: bool,
    /// Constraints of two movable bodies (dynamic, kinematic or on a hinge), with at most two points.
    pub(crate) two_points: ColorSet<ContactConstraintSimd<2>>,
    /// Constraints of two movable bodies (dynamic, kinematic or on a hinge), with one point.
    pub(crate) one_point: ColorSet<ContactConstraintSimd<1>>,
    /// Constraints of a static body A and a movable body B, with at most two points.
    pub(crate) two_points_static: ColorSet<ContactConstraintSimd<2>>,
    /// Constraints of a static body A and a movable body B, with one point.
    pub(crate) one_point_static: ColorSet<ContactConstraintSimd<1>>,
    /// Constraints in three axes; empty in plain 2D.
    pub(crate) depth: ConstraintGraph3,
    /// Pair index and new handle of each constraint that has moved; empty between calls.
    moved_handles: Vec<(PairIndex, ConstraintHandle)>,
}

reusing_clone! { ConstraintGraph { sleeping, direct, has_direct_change, two_points, one_point, two_points_static, one_point_static, depth, moved_handles } }

/// Contact constraints in three axes, of `twohalf`. A prism has at most two contact points, a ball has one.
#[derive(Debug, Default)]
pub(crate) struct ConstraintGraph3 {
    /// Constraints of two movable bodies, neither of which is a ball.
    pub(crate) prisms: ColorSet<ContactConstraint3Simd<2>>,
    /// Constraints of two movable bodies, at least one of which is a ball.
    pub(crate) balls: ColorSet<ContactConstraint3Simd<1>>,
    /// Constraints of a static body A and a movable body B, neither of which is a ball.
    pub(crate) prisms_static: ColorSet<ContactConstraint3Simd<2>>,
    /// Constraints of a static body A and a movable body B, at least one of which is a ball.
    pub(crate) balls_static: ColorSet<ContactConstraint3Simd<1>>,
}

reusing_clone! { ConstraintGraph3 { prisms, balls, prisms_static, balls_static } }

impl ConstraintGraph3 {
    /// Calls `act` with the contact points of each block of four constraints.
    pub(crate) fn for_each_point(&mut self, act: &mut impl FnMut(&mut [ContactPointSimd])) {
        self.prisms.for_each(|row| act(row.points_mut()));
        self.balls.for_each(|row| act(row.points_mut()));
        self.prisms_static.for_each(|row| act(row.points_mut()));
        self.balls_static.for_each(|row| act(row.points_mut()));
    }
}

/// Selects the colour set of a kind of constraint, borrowed as given (`&` or `&mut`), and runs the expression on it. The
/// expression is compiled once per type of block.
macro_rules! of_kind {
    (@of ($($borrow:tt)+) $is_static:expr, $static:expr, $other:expr) => {
        if $is_static { $($borrow)+ $static } else { $($borrow)+ $other }
    };
    ($borrow:tt $rows:expr, $kind:expr, $colors:ident => $act:expr) => {
        match ($kind.uses_depth(), $kind.has_two_points) {
            (true, true) => {
                let $colors =
                    of_kind!(@of $borrow $kind.is_static, $rows.depth.prisms_static, $rows.depth.prisms);
                $act
            }
            (true, false) => {
                let $colors =
                    of_kind!(@of $borrow $kind.is_static, $rows.depth.balls_static, $rows.depth.balls);
                $act
            }
            (false, true) => {
                let $colors = of_kind!(@of $borrow $kind.is_static, $rows.two_points_static, $rows.two_points);
                $act
            }
            (false, false) => {
                let $colors = of_kind!(@of $borrow $kind.is_static, $rows.one_point_static, $rows.one_point);
                $act
            }
        }
    };
}

impl ConstraintGraph {
    /// Gives back memory that the colours no longer need, because many constraints have moved to the direct solver.
    pub(crate) fn release_memory(&mut self) {
        self.two_points.release_memory();
        self.one_point.release_memory();
        self.two_points_static.release_memory();
        self.one_point_static.release_memory();
    }

    pub(crate) fn clear(&mut self) {
        self.two_points.clear();
        self.one_point.clear();
        self.two_points_static.clear();
        self.one_point_static.clear();
        self.depth.prisms.clear();
        self.depth.balls.clear();
        self.depth.prisms_static.clear();
        self.depth.balls_static.clear();
        self.sleeping.clear();
        self.direct.clear();
    }

    /// Returns the list of parked constraints that contains this handle; `None` if the constraint is in a colour.
    #[inline(always)]
    fn parked_list(&self, handle: ConstraintHandle) -> Option<&IndexedVec<SlotIndex, ParkedConstraint>> {
        match handle.color {
            SLEEPING_LIST => Some(&self.sleeping),
            DIRECT_SOLVER_LIST => Some(&self.direct),
            _ => None,
        }
    }

    #[inline(always)]
    fn parked_list_mut(
        &mut self,
        handle: ConstraintHandle,
    ) -> Option<&mut IndexedVec<SlotIndex, ParkedConstraint>> {
        match handle.color {
            SLEEPING_LIST => Some(&mut self.sleeping),
            DIRECT_SOLVER_LIST => Some(&mut self.direct),
            _ => None,
        }
    }

    /// Returns whether the iterative solver has no contact constraint; parked constraints do not count.
    pub(crate) fn is_empty(&self) -> bool {
        self.used_colors() == 0
    }

    /// Returns the number of planar contact constraints of the iterative solver.
    pub(crate) fn planar_count(&self) -> usize {
        self.two_points.constraint_count()
            + self.one_point.constraint_count()
            + self.two_points_static.constraint_count()
            + self.one_point_static.constraint_count()
    }

    /// Returns whether there is no contact constraint, neither of the iterative solver nor a parked one.
    pub fn has_none(&self) -> bool {
        self.is_empty() && self.sleeping.is_empty() && self.direct.is_empty()
    }

    /// Returns the mask of the colours that have constraints: bit i for colour i.
    fn used_colors(&self) -> u32 {
        let ConstraintGraph3 { prisms, balls, prisms_static, balls_static } = &self.depth;
        let in_plane = self.two_points.used_colors
            | self.one_point.used_colors
            | self.two_points_static.used_colors
            | self.one_point_static.used_colors;
        in_plane
            | prisms.used_colors
            | balls.used_colors
            | prisms_static.used_colors
            | balls_static.used_colors
    }

    /// Returns whether the overflow colour has constraints, which [`ColorUsage`] does not count.
    pub fn has_overflow(&self) -> bool {
        OVERFLOW_COLOR.is_in(self.used_colors())
    }

    /// Returns the number of constraints of each colour, up to the last used colour.
    pub fn constraints_per_color(&self) -> Vec<usize> {
        let ConstraintGraph3 { prisms, balls, prisms_static, balls_static } = &self.depth;
        let counts = |colour: Color| {
            let fixed = self.two_points_static.count_of(colour) + self.one_point_static.count_of(colour);
            let in_plane = self.two_points.count_of(colour) + self.one_point.count_of(colour) + fixed;
            let fixed = prisms_static.count_of(colour) + balls_static.count_of(colour);
            in_plane + prisms.count_of(colour) + balls.count_of(colour) + fixed
        };
        (0..u32::BITS - self.used_colors().leading_zeros()).map(Color).map(counts).collect()
    }

    /// Returns the number of contact points of all awake constraints, in both solvers. A constraint of the iterative solver
    /// counts with the number of points that its block has room for.
    pub fn point_count(&self) -> usize {
        let direct =
            self.direct.iter().map(|row| 1 + usize::from(row.constraint.points[1].normal_mass > 0.0));
        let ConstraintGraph3 { prisms, balls, prisms_static, balls_static } = &self.depth;
        let with_two = self.two_points.constraint_count()
            + self.two_points_static.constraint_count()
            + prisms.constraint_count()
            + prisms_static.constraint_count();
        let with_one = self.one_point.constraint_count()
            + self.one_point_static.constraint_count()
            + balls.constraint_count()
            + balls_static.constraint_count();
        let in_colours = 2 * with_two + with_one;
        in_colours + direct.sum::<usize>()
    }

    /// Returns the colour for a new constraint of this kind, among the colours of the mask `free`. It is the lowest colour
    /// whose last block has an empty lane, else the lowest colour. It is the overflow colour if the mask is empty.
    pub(crate) fn choose_color(&self, kind: ConstraintKind, free: u32) -> Color {
        of_kind!((&) self, kind, colours => colours.choose_color(free))
    }

    /// Adds a constraint to a colour. Returns its handle.
    pub(crate) fn add(
        &mut self,
        kind: ConstraintKind,
        color: Color,
        constraint: &ContactConstraint,
    ) -> ConstraintHandle {
        ConstraintHandle {
            color,
            slot: of_kind!((&mut) self, kind, colours => colours.add(color, constraint)),
        }
    }

    /// Removes a constraint. Another constraint may take its slot: [`drain_moved`](Self::drain_moved) has the new handles.
    pub(crate) fn remove(&mut self, kind: ConstraintKind, handle: ConstraintHandle) {
        let ConstraintHandle { color, slot } = handle;
        if let Some(list) = self.parked_list_mut(handle) {
            list.swap_remove(slot);
            let pair = list.at(slot).map(|moved| moved.constraint.pair);
            self.moved_handles.extend(pair.map(|pair| (pair, handle)));
            return;
        }
        let mut moved = std::mem::take(&mut self.moved_handles);
        of_kind!((&mut) self, kind, colours => {
            colours.remove(color, slot, |pair, slot| moved.push((pair, ConstraintHandle { color, slot })));
        });
        self.moved_handles = moved;
    }

    /// Removes and returns the list of constraints that have moved: pair index and new handle of each.
    pub(crate) fn drain_moved(&mut self) -> std::vec::Drain<'_, (PairIndex, ConstraintHandle)> {
        self.moved_handles.drain(..)
    }

    /// Parks a constraint of a sleeping body or, if `is_direct`, of an island in the direct solver. `h`: length of the substep
    /// in which the impulses of the constraint act, seconds. Returns the new handle.
    pub(crate) fn park(
        &mut self,
        kind: ConstraintKind,
        handle: ConstraintHandle,
        is_direct: bool,
        h: f32,
    ) -> ConstraintHandle {
        if handle.color == if is_direct { DIRECT_SOLVER_LIST } else { SLEEPING_LIST } {
            return handle;
        }
        let constraint = self.get(kind, handle);
        let parked = self.parked(handle).unwrap_or(ParkedConstraint {
            constraint,
            color: handle.color,
            h,
            exact_impulses: [0.0; 3],
        });
        self.remove(kind, handle);
        self.push_parked(parked, is_direct)
    }

    /// Appends a parked constraint to the list of the direct solver (`is_direct`) or of sleeping bodies. Returns its handle.
    pub(crate) fn push_parked(&mut self, parked: ParkedConstraint, is_direct: bool) -> ConstraintHandle {
        let handle = ConstraintHandle {
            color: if is_direct { DIRECT_SOLVER_LIST } else { SLEEPING_LIST },
            slot: SlotIndex(0),
        };
        let Some(list) = self.parked_list_mut(handle) else { return handle };
        ConstraintHandle { slot: list.push(parked), ..handle }
    }

    /// Moves a parked constraint back to its colour and scales its impulses to substeps of `h` seconds. Returns the new handle.
    pub(crate) fn unpark(
        &mut self,
        kind: ConstraintKind,
        handle: ConstraintHandle,
        h: f32,
    ) -> ConstraintHandle {
        let Some(mut parked) = self.parked(handle) else { return handle };
        parked.scale(h);
        self.remove(kind, handle);
        self.add(kind, parked.color, &parked.constraint)
    }

    /// Returns a copy of a parked constraint; `None` if the constraint is in a colour.
    pub fn parked(&self, handle: ConstraintHandle) -> Option<ParkedConstraint> {
        self.parked_list(handle)?.at(handle.slot).copied()
    }

    /// Returns all constraints that are parked for the direct solver.
    pub(crate) fn direct_constraints(&self) -> &[ParkedConstraint] {
        &self.direct
    }

    /// Calls `change` with each constraint in the direct solver. `change` returns whether more than the separations may have
    /// changed.
    pub(crate) fn update_direct_constraints(
        &mut self,
        mut change: impl FnMut(&mut ContactConstraint) -> bool,
    ) {
        for ParkedConstraint { constraint, .. } in &mut self.direct {
            self.has_direct_change |= change(constraint);
        }
    }

    /// Returns whether a constraint in the direct solver may have got other arms or impulses since the last call, except by its
    /// solution. Clears this flag.
    pub(crate) fn take_direct_change(&mut self) -> bool {
        std::mem::take(&mut self.has_direct_change)
    }

    /// Returns the constraint with this handle in the direct solver.
    #[inline(always)]
    pub(crate) fn direct_constraint(&self, handle: ConstraintHandle) -> &ParkedConstraint {
        &self.direct[handle.slot]
    }

    #[inline(always)]
    pub(crate) fn direct_constraint_mut(&mut self, handle: ConstraintHandle) -> &mut ParkedConstraint {
        &mut self.direct[handle.slot]
    }

    /// Returns a copy of a constraint of sleeping bodies; `None` if the constraint is not parked for sleep.
    pub fn sleeping_constraint(&self, handle: ConstraintHandle) -> Option<ParkedConstraint> {
        self.parked(handle).filter(|_| handle.color == SLEEPING_LIST)
    }

    /// Returns a copy of a constraint, parked or in a colour.
    #[inline]
    pub fn get(&self, kind: ConstraintKind, handle: ConstraintHandle) -> ContactConstraint {
        if let Some(list) = self.parked_list(handle) {
            return list[handle.slot].constraint;
        }
        of_kind!((&) self, kind, colours => {
            let (row, lane) = colours.row(handle);
            row.extract(lane)
        })
    }

    /// Returns the bodies A and B of a constraint, parked or in a colour: index 0 for a static body.
    pub(crate) fn bodies_of(&self, kind: ConstraintKind, handle: ConstraintHandle) -> [BodyIndex; 2] {
        if let Some(list) = self.parked_list(handle) {
            let ContactConstraint { a, b, .. } = list[handle.slot].constraint;
            return [a, b];
        }
        of_kind!((&) self, kind, colours => {
            let (row, lane) = colours.row(handle);
            row.bodies_of(lane)
        })
    }

    /// Returns the graph colour of a constraint; for a parked one the colour that it returns to.
    pub(crate) fn color_of(&self, handle: ConstraintHandle) -> Color {
        self.parked_list(handle).map_or(handle.color, |list| list[handle.slot].color)
    }

    /// Returns copies of the two points of a constraint, parked or in a colour. A kind with one point has zeros in the second.
    pub(crate) fn points_of(&self, kind: ConstraintKind, handle: ConstraintHandle) -> [ContactPoint; 2] {
        if let Some(list) = self.parked_list(handle) {
            return list[handle.slot].constraint.points;
        }
        of_kind!((&) self, kind, colours => {
            let (row, lane) = colours.row(handle);
            row.points_of(lane)
        })
    }

    /// Overwrites a constraint, parked or in a colour.
    #[inline]
    pub(crate) fn set(
        &mut self,
        kind: ConstraintKind,
        handle: ConstraintHandle,
        constraint: &ContactConstraint,
    ) {
        if let Some(list) = self.parked_list_mut(handle) {
            list[handle.slot].constraint = *constraint;
            self.has_direct_change = true;
            return;
        }
        of_kind!((&mut) self, kind, colours => {
            let (row, lane) = colours.row_mut(handle);
            row.insert(lane, constraint);
        });
    }

    /// Overwrites the pair index of a constraint, parked or in a colour.
    pub(crate) fn set_pair(&mut self, kind: ConstraintKind, handle: ConstraintHandle, pair: PairIndex) {
        if let Some(list) = self.parked_list_mut(handle) {
            list[handle.slot].constraint.pair = pair;
            return;
        }
        of_kind!((&mut) self, kind, colours => {
            let (row, lane) = colours.row_mut(handle);
            row.pair_indices()[lane] = pair;
        });
    }

    /// Overwrites the separations of both points of a constraint, length units.
    #[inline]
    pub(crate) fn set_separations(
        &mut self,
        kind: ConstraintKind,
        handle: ConstraintHandle,
        separations: [f32; 2],
    ) {
        if let Some(list) = self.parked_list_mut(handle) {
            let points = &mut list[handle.slot].constraint.points;
            points.iter_mut().zip(separations).for_each(|(point, separation)| point.separation = separation);
            return;
        }
        of_kind!((&mut) self, kind, colours => {
            let (row, lane) = colours.row_mut(handle);
            for (point, separation) in row.points_mut().iter_mut().zip(separations) {
                set_lane(&mut point.separation, lane, separation);
            }
        });
    }
}
