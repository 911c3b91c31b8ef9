//! Solver for a group of bodies with joints in three axes.
//!
//! Each substep has two solves. The first finds velocities with which the rows hold at the *end* of the substep, by Newton
//! iterations with the Jacobian of its start (SHAKE). The second, after bodies have moved, makes the velocities satisfy the
//! rows (RATTLE); for both see [`articulation_step`](super::super::articulation_step). Position corrections move bodies but are
//! removed from their velocities, so that contradicting joints add no energy.
//!
//! The Delassus matrix J M^-1 J^T is sparse: two rows are coupled if they share a body. It is [factorised](super::sparse_ldlt)
//! for each phase. Bounded rows, such as ropes, are solved by an active set: a row whose impulse reaches a bound leaves it, a
//! violated row joins it. Groups that are too large for a factorisation use Gauss-Seidel sweeps.

use super::super::super::bodies::BodySet;
use super::super::indices::JointIndex;
use super::super::joint_constraint::JointList;
use super::constraint_row::{SolvePhase, SpatialJointRow, delassus_term};
use super::joint_state::{JointState, NodeIndex, StateIndex, Velocity4};
use super::row_kind::RowKind;
use super::sparse_ldlt::SparseLdlt;
use crate::index::{BodyIndex, DenseIndex, IndexedVec};
use crate::minimum_degree::RowIndex;
use crate::parameters::spatial_joints::{
    ACTIVE_SET_MAX_ITERATIONS, GROUP_ERROR_CONVERGED, GROUP_ERROR_FLOOR, GROUP_GAUSS_SEIDEL_SWEEPS,
    LOOP_MAX_LATERAL_STIFFNESS, LOOP_MIN_VELOCITY_ITERATIONS, MERGED_CORRECTION_MAX_ERROR,
    TREE_MIN_VELOCITY_ITERATIONS,
};
use crate::reusing_clone;
use crate::sparse_ordering::EntryIndex;

/// A group of connected joints in three axes with a distance joint among them, and the bodies that they connect.
#[derive(Debug, Default)]
pub(in super::super) struct SpatialJointGroup {
    /// Indices of the dynamic bodies into the arrays of `BodySet`, sorted. Other fields of the group refer to a body by its
    /// position in this list.
    pub(super) bodies: IndexedVec<NodeIndex, BodyIndex>,
    /// Inverse masses: x, y and z in 1/(mass units), angular in 1/(mass units * length units^2). Entries of `bodies` come first;
    /// then 0 for each side of a joint that is the world, static or kinematic.
    pub(super) inverse_masses: IndexedVec<NodeIndex, Velocity4>,
    /// Velocities: x, y and z in length units/s, angular in radians/s. Entries of `bodies` come first; then one for each side of
    /// a joint that is the world, static or kinematic.
    pub(super) velocities: IndexedVec<NodeIndex, Velocity4>,
    /// Velocities of this substep that only correct positions, in the order of `velocities`: x, y and z in length units/s,
    /// angular in radians/s. They are contained in `velocities`, and subtracted after bodies have moved.
    pub(super) correction_velocities: IndexedVec<NodeIndex, Velocity4>,
    /// The joints of the group, with present poses.
    pub(super) joints: IndexedVec<StateIndex, JointState>,
    /// The rows of all joints of the group.
    pub(super) rows: IndexedVec<RowIndex, SpatialJointRow>,
    /// Couplings of rows that share a body: contributions to the off-diagonal elements of the Delassus matrix.
    pub(super) off_diagonals: Vec<OffDiagonal>,
    /// Factorisation of the Delassus matrix J M^-1 J^T; `None` if it needs too many products.
    pub(super) ldlt: Option<SparseLdlt>,
    /// Workspace, one number per row. Before a solve: velocity errors, in radians/s for angular rows, else length units/s.
    /// After it: amounts by which impulses decrease, in mass units * length units^2/s for angular rows, else mass units *
    /// length units/s.
    pub(super) velocity_errors: Vec<f64>,
    /// Whether a joint of the group closes a loop.
    pub(super) has_loops: bool,
    /// Length unit of the simulator with `Methods::Precise`, > 0, in the user's unit.
    pub(super) length_unit: f64,
    /// Whether no body of the group has a contact. The group then moves through the whole step by itself, with divided
    /// substeps.
    pub(super) is_contact_free: bool,
    /// Number of parts into which the group divides each substep, >= 1; 1 with contacts.
    pub(super) substep_parts: u32,
    /// Displacements of the bodies since the start of the step, in a group without contacts: x, y and z in length units, angle
    /// in radians.
    pub(super) displacements: IndexedVec<NodeIndex, Velocity4>,
    /// The joints at the start of a step without contacts, for its repetition with more parts.
    pub(super) initial_joints: IndexedVec<StateIndex, JointState>,
    /// Velocities of the bodies in a substep before the joints act: x, y and z in length units/s, angular in radians/s.
    pub(super) unconstrained_velocities: IndexedVec<NodeIndex, Velocity4>,
    /// Whether the energy of the group is checked: it has no motor, and no joint with a moving kinematic body.
    pub(super) is_passive: bool,
}

reusing_clone! {
    SpatialJointGroup { bodies, inverse_masses, velocities, correction_velocities, joints, rows, off_diagonals, ldlt, velocity_errors, has_loops, length_unit, is_contact_free, substep_parts, displacements,
        initial_joints, unconstrained_velocities, is_passive }
}

/// Contribution of one body to an off-diagonal element of the Delassus matrix J M^-1 J^T. Two rows act on that body.
#[derive(Debug, Clone, Copy)]
pub(super) struct OffDiagonal {
    /// Index of the body in the group's list of bodies.
    pub(super) body: NodeIndex,
    /// Indices of the two rows in the group's list of rows.
    pub(super) rows: [RowIndex; 2],
    /// For each row, whether the body is the second body (B) of its joint.
    pub(super) is_second: [bool; 2],
    /// Index of the element in the sparse factorisation.
    pub(super) entry: EntryIndex,
    /// Contribution to the element: 1/(mass units), divided by length units for each angular row.
    pub(super) term: f64,
}

impl SpatialJointGroup {
    /// Returns the indices of the group's dynamic bodies into the arrays of `BodySet`.
    pub(in super::super) fn bodies(&self) -> &[BodyIndex] {
        &self.bodies
    }

    /// Returns the indices of the group's joints in the list of all joints.
    pub(in super::super) fn joint_indices(&self) -> impl Iterator<Item = JointIndex> + '_ {
        self.joints.iter().map(|tie| tie.joint)
    }

    /// Returns whether no body of the group has a contact.
    pub(in super::super) fn is_contact_free(&self) -> bool {
        self.is_contact_free
    }

    /// Returns the number of parts into which the last step divided each substep.
    pub(in super::super) fn substep_parts(&self) -> u32 {
        self.substep_parts
    }

    /// Sets `is_contact_free`. `is_touched` returns whether contacts or springs act on a body.
    pub(in super::super) fn update_contact_free(&mut self, is_touched: impl Fn(BodyIndex) -> bool) {
        self.is_contact_free = !self.bodies.iter().any(|&body| is_touched(body));
    }

    /// Prepares the group for a step of `dt` seconds with substeps of `h` seconds: sets poses, velocities of static and
    /// kinematic bodies, and rows.
    ///
    /// `depth_of` returns the z position of the body on a side (0 or 1) of a joint, by its index, in length units.
    pub(in super::super) fn prepare(
        &mut self,
        joints: &JointList,
        bodies: &BodySet,
        [dt, h]: [f64; 2],
        length_unit: f64,
        depth_of: impl Fn(JointIndex, usize) -> f32,
    ) {
        self.length_unit = length_unit;
        let mut is_at_rest = true;
        for state in self.joints.iter_mut() {
            let joint = &joints[state.joint];
            for (at, side) in state.sides.iter_mut().enumerate() {
                let (end, z) = (&joint.anchors[at], f64::from(depth_of(state.joint, at)));
                (side.origin, side.arm, side.rotation) =
                    ([end.position[0], end.position[1], z], end.arm, 0.0);
                let along_z =
                    bodies.states.at(end.pose_body).map_or(0.0, |state| f64::from(state.velocity[3]));
                let [x, y, spin] = end.velocity;
                let velocity =
                    [x, y, spin, if end.pose_body == BodyIndex::PLACEHOLDER { 0.0 } else { along_z }];
                // The velocity of a dynamic body is energy that the group has, not work that is done on it.
                if side.node.position() >= self.bodies.len() {
                    is_at_rest &= velocity == [0.0; 4];
                    self.velocities[side.node] = velocity;
                }
            }
            (state.axis, state.total_impulse, state.direction) = (joint.axis, [0.0; 4], [1.0, 0.0, 0.0]);
            state.anchors_at_origins = state.sides.iter().all(|side| side.arm == [0.0; 2]);
            state.update_offset();
        }
        self.is_passive = is_at_rest && !self.rows.iter().any(|row| matches!(row.kind, RowKind::Motor(_)));
        let parts = if self.is_contact_free { self.required_parts(joints, [dt, h]) } else { 1 };
        self.prepare_rows(joints, [dt, h], parts);
    }

    /// Prepares the rows for a step of `dt` seconds with substeps of `h` seconds, each divided into `substep_parts` parts.
    pub(super) fn prepare_rows(&mut self, joints: &JointList, [dt, h]: [f64; 2], substep_parts: u32) {
        self.substep_parts = substep_parts;
        let (parts, unit) = (f64::from(substep_parts), self.length_unit);
        for row in self.rows.iter_mut() {
            let state = &self.joints[row.joint];
            row.prepare(state, &joints[state.joint], ([dt, h / parts], unit), parts);
        }
        if self.has_loops {
            self.cap_loop_impulses(h / parts);
        }
    }

    /// Changes the velocities of the bodies so that the joints hold at the end of a substep of `h` seconds (SHAKE).
    pub(in super::super) fn solve_positions(&mut self, joints: &JointList, bodies: &mut BodySet, h: f64) {
        self.load_velocities(bodies);
        if !self.solve_position_velocities(joints, h, true) {
            self.solve_velocities_only(joints, h);
        }
        self.store_velocities(bodies);
    }

    /// Computes the velocities of the group with which the joints hold at the end of a substep of `h` seconds (SHAKE). Returns
    /// whether the solve has converged.
    ///
    /// With `accepts_residual`, or in a group with loops, a solve that has not increased the largest error counts as converged.
    /// Position errors above [`MERGED_CORRECTION_MAX_ERROR`] are corrected by a second solve. Its correction velocities are
    /// removed in the relaxation.
    pub(super) fn solve_position_velocities(
        &mut self,
        joints: &JointList,
        h: f64,
        accepts_residual: bool,
    ) -> bool {
        self.unconstrained_velocities.clone_from(&self.velocities);
        let (mut has_errors, count) = (false, self.bodies.len());
        let (velocities, inverse_masses) = (self.velocities.borrowed(), self.inverse_masses.borrowed());
        for row in self.rows.iter_mut() {
            let state = &self.joints[row.joint];
            row.impulse = 0.0;
            row.update_jacobian(state, joints, (inverse_masses, count));
            row.choose_limit(state, joints, velocities, h);
            has_errors |= row.choose_corrected_error() > MERGED_CORRECTION_MAX_ERROR;
        }
        let phase = if has_errors { SolvePhase::HoldPosition } else { SolvePhase::CorrectPosition };
        if !self.solve(joints, h, (phase, accepts_residual)) {
            return false;
        }
        self.rows.iter_mut().for_each(|row| row.position_impulse = row.impulse);
        self.correction_velocities.clear();
        self.correction_velocities.resize(self.velocities.len(), [0.0; 4]);
        if has_errors {
            self.correction_velocities.copy_from_slice(&self.velocities);
            let is_solved = self.solve(joints, h, (SolvePhase::CorrectPosition, true));
            for (correction, velocity) in
                self.correction_velocities.iter_mut().zip(self.velocities.iter_mut())
            {
                let uncorrected = *correction;
                *correction =
                    std::array::from_fn(|i| if is_solved { velocity[i] - uncorrected[i] } else { 0.0 });
                if !is_solved {
                    *velocity = uncorrected;
                }
            }
        }
        true
    }

    /// Computes velocities that satisfy the rows at the start of the substep of `h` seconds: the fallback after a failed
    /// position solve.
    ///
    /// Such velocities add no energy. The position errors that they leave are corrected in later substeps.
    pub(super) fn solve_velocities_only(&mut self, joints: &JointList, h: f64) {
        self.velocities.clone_from(&self.unconstrained_velocities);
        self.rows.iter_mut().for_each(|row| row.impulse = 0.0);
        self.solve(joints, h, (SolvePhase::Relax, true));
        self.rows.iter_mut().for_each(|row| row.position_impulse = row.impulse);
        self.correction_velocities.clear();
        self.correction_velocities.resize(self.velocities.len(), [0.0; 4]);
    }

    /// Copies the velocities of the bodies into the group, and moves its anchors by them for `h` seconds.
    pub(in super::super) fn update_anchors(&mut self, bodies: &BodySet, h: f64) {
        self.load_velocities(bodies);
        self.advance_joints(h);
    }

    /// Moves the anchors of the joints for `h` seconds with the group's velocities.
    pub(super) fn advance_joints(&mut self, h: f64) {
        let velocities = self.velocities.borrowed();
        self.joints.iter_mut().for_each(|tie| tie.advance(velocities, h));
    }

    /// Changes the velocities of the bodies so that they satisfy the joints, after bodies have moved in a substep of `h`
    /// seconds (RATTLE).
    pub(in super::super) fn solve_velocities(&mut self, joints: &JointList, bodies: &mut BodySet, h: f64) {
        self.load_velocities(bodies);
        self.relax_velocities(joints, h);
        self.store_velocities(bodies);
    }

    /// Removes the correction velocities from the group's velocities, and solves the velocities for the joints (RATTLE). Adds
    /// the impulses of the substep of `h` seconds to the sums of the step.
    pub(super) fn relax_velocities(&mut self, joints: &JointList, h: f64) {
        for (correction, velocity) in self.correction_velocities.iter().zip(self.velocities.iter_mut()) {
            (0..4).for_each(|i| velocity[i] -= correction[i]);
        }
        let (inverse_masses, count) = (self.inverse_masses.borrowed(), self.bodies.len());
        for row in self.rows.iter_mut() {
            let state = &self.joints[row.joint];
            row.impulse = row.position_impulse;
            row.update_jacobian(state, joints, (inverse_masses, count));
        }
        self.solve(joints, h, (SolvePhase::Relax, true));
        for row in self.rows.iter() {
            let state = &mut self.joints[row.joint];
            row.accumulate_impulse(state.link, &mut state.total_impulse);
        }
    }

    /// Stores the mean forces and torques of a step of `dt` seconds in the joints. Stores velocities and displacements of a
    /// group without contacts in `bodies`.
    pub(in super::super) fn store_forces(&self, joints: &mut JointList, bodies: &mut BodySet, dt: f64) {
        self.store_free_step(bodies);
        for state in self.joints.iter() {
            let [x, y, turning, z] = state.total_impulse.map(|impulse| impulse / dt);
            let joint = &mut joints[state.joint];
            (joint.force, joint.force_along_depth) = ([x, y, turning], z as f32);
        }
    }

    /// Copies the velocities of the bodies into `velocities` of the group.
    pub(super) fn load_velocities(&mut self, bodies: &BodySet) {
        for (velocity, &body) in self.velocities.iter_mut().zip(&self.bodies) {
            *velocity = bodies.states[body].velocity.map(f64::from);
        }
    }

    /// Stores the velocities of the group in the bodies.
    ///
    /// The change is added to the warm-started velocity as well, so that the next warm start does not apply it again.
    fn store_velocities(&self, bodies: &mut BodySet) {
        for (velocity, &body) in self.velocities.iter().zip(&self.bodies) {
            let (now, begun) = (&mut bodies.states[body].velocity, &mut bodies.warm_started_velocity[body]);
            for i in 0..4 {
                let next = velocity[i] as f32;
                begun[i] += next - now[i];
                now[i] = next;
            }
        }
    }

    /// Solves the rows for the target velocities of a phase, in a substep of `h` seconds. Returns whether the solve has
    /// converged.
    ///
    /// With `accepts_residual`, or in a group with loops, a solve that has not increased the largest error counts as converged,
    /// too.
    fn solve(&mut self, joints: &JointList, h: f64, (phase, accepts_residual): (SolvePhase, bool)) -> bool {
        self.rows.iter_mut().for_each(|row| row.set_target(h, phase));
        let Some(sparse) = self.ldlt.take() else {
            self.gauss_seidel(joints, h);
            let velocities = self.velocities.slice(..self.bodies.len());
            return velocities.iter().flatten().all(|velocity| velocity.is_finite());
        };
        let [first, last] = self.solve_active_set(joints, h, sparse);
        let is_found = last * h <= GROUP_ERROR_CONVERGED * self.length_unit;
        if is_found || (!accepts_residual && !self.has_loops) { is_found } else { last <= first }
    }

    /// Solves the rows by the active set, with the factorisation `sparse` in a substep of `h` seconds. If the set does not settle,
    /// Gauss-Seidel sweeps follow. Returns the largest velocity errors before and after: radians/s in angular rows, else length
    /// units/s.
    fn solve_active_set(&mut self, joints: &JointList, h: f64, mut sparse: SparseLdlt) -> [f64; 2] {
        let least = if self.has_loops { LOOP_MIN_VELOCITY_ITERATIONS } else { TREE_MIN_VELOCITY_ITERATIONS };
        let mut has_clamped = false;
        let (mut first, mut last) = (0.0, 0.0);
        for iteration in 0..ACTIVE_SET_MAX_ITERATIONS {
            // In the second half of the iterations no row joins the active set, so that the set cannot cycle.
            let (worst, is_set_changed) =
                self.find_velocity_errors(joints, h, iteration < ACTIVE_SET_MAX_ITERATIONS / 2);
            last = worst;
            if iteration == 0 {
                first = worst;
            }
            if !has_clamped
                && (worst * h <= GROUP_ERROR_FLOOR * self.length_unit
                    || (iteration >= least && !is_set_changed))
            {
                break;
            }
            if iteration == 0 {
                self.update_off_diagonals();
            }
            if iteration == 0 || is_set_changed {
                self.assemble(&mut sparse);
            }
            sparse.solve(&mut self.velocity_errors);
            has_clamped = self.apply_active_set();
        }
        self.ldlt = Some(sparse);
        if has_clamped {
            self.gauss_seidel(joints, h);
            (last, _) = self.find_velocity_errors(joints, h, true);
        }
        [first, last]
    }

    /// Limits the impulses of distance rows that close a loop, for substeps of `h` seconds.
    ///
    /// A tension T gives a distance joint of length l the lateral stiffness T / l. Beyond [`LOOP_MAX_LATERAL_STIFFNESS`] it is
    /// unstable in a substep. The tension of a tree follows from the load on it; that of a loop which cannot close is
    /// unbounded.
    fn cap_loop_impulses(&mut self, h: f64) {
        let of_distance = self.rows.iter().filter(|row| row.kind == RowKind::Distance);
        let inverse_inertia_per_length = of_distance.map(|row| {
            let state = &self.joints[row.joint];
            let inverse: f64 =
                state.sides.iter().map(|side| side.inverse_mass(self.inverse_masses.borrowed())).sum();
            inverse / state.distance.max(GROUP_ERROR_FLOOR * self.length_unit)
        });
        let max_impulse = LOOP_MAX_LATERAL_STIFFNESS / (h * inverse_inertia_per_length.fold(0.0, f64::max));
        for row in self.rows.iter_mut().filter(|row| row.closes_loop && row.kind == RowKind::Distance) {
            row.lower_max_impulse(max_impulse);
        }
    }

    /// Computes the velocity errors of all rows and updates the active set. Returns the largest absolute error (radians/s in
    /// angular rows, else length units/s), and whether the set has changed.
    ///
    /// Errors of inactive rows are set to 0. A row joins the set only if `may_activate` holds.
    fn find_velocity_errors(&mut self, joints: &JointList, h: f64, may_activate: bool) -> (f64, bool) {
        let (mut worst, mut is_set_changed) = (0.0_f64, false);
        let (states, velocities) = (self.joints.borrowed(), self.velocities.borrowed());
        for (row, missing) in self.rows.iter_mut().zip(&mut self.velocity_errors) {
            let error = row.velocity_error((states, joints), velocities, h);
            let [low, high] = row.impulse_bounds;
            let is_bound = (row.impulse <= low && error > 0.0) || (row.impulse >= high && error < 0.0);
            let is_active = !is_bound && (may_activate || row.is_active) && row.responds;
            is_set_changed |= row.is_active != is_active;
            row.is_active = is_active;
            *missing = if is_active { error } else { 0.0 };
            // This comparison also takes a NaN.
            worst = if !is_active || error.abs() <= worst { worst } else { error.abs() };
        }
        (worst, is_set_changed)
    }

    /// Computes the contributions of the bodies to the off-diagonal elements of the Delassus matrix.
    fn update_off_diagonals(&mut self) {
        for of in &mut self.off_diagonals {
            let [a, b] = of.rows.map(|row| &self.rows[row].jacobian);
            let (a, b) = (a[usize::from(of.is_second[0])], b[usize::from(of.is_second[1])]);
            of.term = delassus_term(a, b, self.inverse_masses[of.body]);
        }
    }

    /// Assembles and factorises the Delassus matrix of the active rows. Inactive rows have a diagonal element of 1.
    fn assemble(&self, sparse: &mut SparseLdlt) {
        sparse.reset(self.rows.iter().map(|row| if row.is_active { row.diagonal } else { 1.0 }));
        for &OffDiagonal { rows, entry, term, .. } in &self.off_diagonals {
            if rows.iter().all(|&row| self.rows[row].is_active) {
                sparse.add_lower(entry, term);
            }
        }
        sparse.factorise();
    }

    /// Applies the impulse changes in `velocity_errors` to the active rows. Returns whether one of these changes would leave
    /// the bounds of its row.
    ///
    /// If so, only the rows whose changes leave their bounds are changed, and clamped to their bounds. The solution of the
    /// other rows assumed the unclamped impulses.
    fn apply_active_set(&mut self) -> bool {
        let exceeds_bounds = |row: &SpatialJointRow, decrease: f64| {
            let wanted = row.impulse - decrease;
            row.is_active && !(row.impulse_bounds[0]..=row.impulse_bounds[1]).contains(&wanted)
        };
        let has_clamped =
            self.rows.iter().zip(&self.velocity_errors).any(|(row, &less)| exceeds_bounds(row, less));
        let count = self.bodies.len();
        let bodies = (self.velocities.slice_mut(..count), self.inverse_masses.slice(..count));
        for (row, &less) in self.rows.iter_mut().zip(&self.velocity_errors) {
            if row.is_active && (!has_clamped || exceeds_bounds(row, less)) {
                apply_impulse(row, less, (&mut *bodies.0, bodies.1));
            }
        }
        has_clamped
    }

    /// Solves the rows one after the other in [`GROUP_GAUSS_SEIDEL_SWEEPS`] sweeps, in a substep of `h` seconds.
    fn gauss_seidel(&mut self, joints: &JointList, h: f64) {
        let (states, count) = (self.joints.borrowed(), self.bodies.len());
        for _ in 0..GROUP_GAUSS_SEIDEL_SWEEPS {
            for row in self.rows.iter_mut() {
                let velocities = self.velocities.borrowed();
                let missing = row.velocity_error((states, joints), velocities, h);
                let own = row.inverse_effective_mass + row.compliance;
                if own > 0.0 {
                    let bodies = (self.velocities.slice_mut(..count), self.inverse_masses.slice(..count));
                    apply_impulse(row, missing / own, bodies);
                }
            }
        }
    }
}

/// Subtracts `decrease` from the accumulated impulse of a row, clamps the result to the impulse bounds of the row, and updates
/// the velocities of its bodies.
///
/// `decrease` is in mass units * length units/s for linear rows and mass units * length units^2/s for angular rows.
/// `velocities` and `inverse_masses` are those of the group's dynamic bodies.
#[inline(always)]
fn apply_impulse(
    row: &mut SpatialJointRow,
    decrease: f64,
    (velocities, inverse_masses): (&mut [Velocity4], &[Velocity4]),
) {
    let impulse = (row.impulse - decrease).clamp(row.impulse_bounds[0], row.impulse_bounds[1]);
    let change = impulse - std::mem::replace(&mut row.impulse, impulse);
    for (node, push) in row.nodes.map(NodeIndex::position).into_iter().zip(row.jacobian) {
        // Sides that are static or kinematic come behind the dynamic bodies.
        if let (Some(velocity), Some(inverse)) = (velocities.get_mut(node), inverse_masses.get(node)) {
            *velocity = std::array::from_fn(|i| velocity[i] + change * push[i] * inverse[i]);
        }
    }
}
