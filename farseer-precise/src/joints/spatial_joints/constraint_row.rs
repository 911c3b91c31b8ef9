//! Scalar rows of joints in three axes: target velocity and Jacobian.
//!
//! The value of a row is a position error, a distance, an angle, or the coordinate that motor and limits act on. Velocities and
//! Jacobians have four components: x, y, angular about z, and z, along the depth axis.

use super::super::joint_constraint::{JointConstraint, JointList, Motor};
use super::super::locked_dofs::LockedDofs;
use super::super::vec2::{Vec2, add_scaled, dot, perp};
use super::joint_state::{JointState, NodeIndex, Nodes, StateIndex, States, Velocity4, anchor_offset};
use super::row_kind::RowKind;
use crate::index::DenseIndex;
use crate::parameters::spatial_joints::{LOOP_BAUMGARTE_FACTOR, LOOP_COMPLIANCE, MAX_POSITION_CORRECTION};

/// Phase of a substep, which determines the target velocities of the rows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum SolvePhase {
    /// Before bodies move: rows seek velocities with which the values of the rows at the end of the substep equal the present
    /// ones.
    HoldPosition,
    /// Before bodies move: rows seek velocities with which the position errors at the end of the substep are smaller, by the
    /// amount that a substep corrects.
    CorrectPosition,
    /// After bodies have moved: rows seek velocities that do not change the values of the rows.
    Relax,
}

/// A scalar row of a joint. Impulses are those of one substep: mass units * length units/s in linear rows, mass units * length
/// units^2/s in angular rows.
#[derive(Debug, Clone, Copy)]
pub(super) struct SpatialJointRow {
    /// Index of the joint in the group's list of joints.
    pub(super) joint: StateIndex,
    /// Indices of both sides of the joint into the group's velocities and inverse masses.
    pub(super) nodes: [NodeIndex; 2],
    /// Quantity that the row constrains.
    pub(super) kind: RowKind,
    /// Whether the joint of the row closes a loop of the joint graph.
    pub(super) closes_loop: bool,
    /// Row of the Jacobian for A and B: x, y, angular, z. A unit impulse of the row changes the momenta of the bodies by these
    /// components.
    pub(super) jacobian: [Velocity4; 2],
    /// Accumulated impulse of a substep: mass units * length units/s in linear rows, mass units * length units^2/s in angular
    /// rows.
    pub(super) impulse: f64,
    /// Accumulated impulse after the solve without position correction, at which the relaxation starts: mass units * length
    /// units/s in linear rows, mass units * length units^2/s in angular rows.
    pub(super) position_impulse: f64,
    /// Lower and upper bound of `impulse` in a substep: mass units * length units/s in linear rows, mass units * length
    /// units^2/s in angular rows.
    pub(super) impulse_bounds: [f64; 2],
    /// Limit that the row acts on, dimensionless: 1 for the lower limit, -1 for the upper limit, 0 for a bilateral row.
    active_limit: f64,
    /// Velocity per impulse of a compliant row: 1/(mass units) in linear rows, 1/(mass units * length units^2) in angular rows;
    /// 0 for rigid rows.
    pub(super) compliance: f64,
    /// Correction velocity per position error of a compliant row, 1/s, >= 0.
    pub(super) bias_rate: f64,
    /// Whether the row is in the active set: the solve changes its impulse.
    pub(super) is_active: bool,
    /// Largest absolute value of `impulse` in a substep, >= 0: mass units * length units/s in linear rows, mass units * length
    /// units^2/s in angular rows.
    max_impulse: f64,
    /// Least and greatest allowed value of the row: radians in angular rows, else length units. Both are equal for a bilateral
    /// row.
    range: [f64; 2],
    /// Violation of a limit that is not corrected, >= 0: radians in angular rows, else length units.
    slop: f64,
    /// Position error that counts as 1: the length unit in length units for linear rows, 1 radian for angular rows.
    error_unit: f64,
    /// Value of the row at the start of the phase: radians in angular rows, else length units.
    value: f64,
    /// Amount of the position error that the substep corrects, with the sign of the error: radians in angular rows, else length
    /// units.
    corrected_error: f64,
    /// Inverse effective mass, J M^-1 J^T: 1/(mass units) in linear rows, 1/(mass units * length units^2) in angular rows.
    pub(super) inverse_effective_mass: f64,
    /// Diagonal element of the Delassus matrix while the row is active, with the compliance of the row and of a loop: 1/(mass
    /// units) in linear rows, 1/(mass units * length units^2) in angular rows.
    pub(super) diagonal: f64,
    /// Whether an impulse changes the velocity of the row: it is compliant, or its inverse effective mass is not 0.
    pub(super) responds: bool,
    /// Whether the row seeks a value at the end of the substep, in this phase. Else it seeks a velocity.
    seeks_value: bool,
    /// Value or velocity that the row seeks in this phase: radians or radians/s in angular rows, else length units or length
    /// units/s.
    target: f64,
}

impl SpatialJointRow {
    /// Returns a row without an impulse. `joint` is the index of the joint in the group's list of joints, and `nodes` those of
    /// its sides into the group's velocities.
    pub(super) fn new(
        (joint, nodes): (StateIndex, [NodeIndex; 2]),
        kind: RowKind,
        closes_loop: bool,
    ) -> Self {
        SpatialJointRow {
            closes_loop,
            joint,
            nodes,
            kind,
            jacobian: [[0.0; 4]; 2],
            impulse: 0.0,
            position_impulse: 0.0,
            impulse_bounds: [f64::MIN, f64::MAX],
            active_limit: 0.0,
            compliance: 0.0,
            bias_rate: 0.0,
            is_active: false,
            max_impulse: f64::MAX,
            range: [0.0; 2],
            slop: 0.0,
            error_unit: 1.0,
            value: 0.0,
            corrected_error: 0.0,
            inverse_effective_mass: 0.0,
            diagonal: 0.0,
            responds: false,
            seeks_value: false,
            target: 0.0,
        }
    }

    /// Returns least and greatest allowed value of the row: radians in angular rows, else length units. Both are equal for a
    /// bilateral row.
    fn allowed_range(&self, joint: &JointConstraint) -> [f64; 2] {
        let [low, high] = match self.kind {
            RowKind::Distance | RowKind::Angle => joint.range,
            RowKind::Limits(limits) => [f64::from(limits.lower), f64::from(limits.upper)],
            _ => [0.0; 2],
        };
        if low < high { [low, high] } else { [high; 2] }
    }

    /// Sets limits, motor, compliance and largest impulse of the row for a step, from the joint.
    ///
    /// `dt` and `h` are the seconds of the step and of a part of a substep; a substep has `substep_parts` parts. `length_unit`
    /// is the length unit of the simulator.
    pub(super) fn prepare(
        &mut self,
        state: &JointState,
        joint: &JointConstraint,
        ([dt, h], length_unit): ([f64; 2], f64),
        substep_parts: f64,
    ) {
        let drive = joint.drive.unwrap_or_default();
        match &mut self.kind {
            // The game may edit a motor in every step.
            RowKind::Motor(motor) => {
                *motor = drive.motor.unwrap_or(Motor { speed: 0.0, greatest_effort: 0.0 })
            }
            RowKind::Limits(limits) => *limits = drive.limits.unwrap_or(*limits),
            _ => {}
        }
        let is_compliant = match self.kind {
            RowKind::AnchorAxis(_) => state.link == LockedDofs::Point,
            RowKind::Distance => true,
            _ => false,
        };
        // A joint's `softness` and `bias_factor` are per update. An impulse of a substep is h / dt of that of an update.
        (self.compliance, self.bias_rate) =
            if is_compliant { (joint.softness * dt / h, joint.bias_factor / dt) } else { (0.0, 0.0) };
        let max_impulse = match self.kind {
            RowKind::Motor(motor) => f64::from(motor.greatest_effort) * h,
            // The largest impulse of a weld limits its angular row alone.
            RowKind::AnchorAxis(_) if state.link == LockedDofs::Weld => f64::MAX,
            RowKind::DepthVelocity | RowKind::LineOffset | RowKind::Limits(_) => f64::MAX,
            _ => joint.max_impulse / substep_parts,
        };
        self.max_impulse = max_impulse;
        (self.range, self.slop) = (self.allowed_range(joint), joint.slop);
        // Angular errors are compared in radians.
        self.error_unit = if self.kind.is_angular(state.link) { 1.0 } else { length_unit };
        self.set_active_limit(0.0);
        (self.impulse, self.position_impulse) = (0.0, 0.0);
    }

    /// Sets the limit that the row acts on: 1 lower, -1 upper, 0 none. Sets the impulse bounds that follow: one-sided for a
    /// limit, symmetric for a bilateral row.
    fn set_active_limit(&mut self, limit: f64) {
        self.active_limit = limit;
        self.impulse_bounds = [
            if limit > 0.0 { 0.0 } else { -self.max_impulse },
            if limit < 0.0 { 0.0 } else { self.max_impulse },
        ];
    }

    /// Chooses the limit that the value is nearer to at the end of a substep of `h` seconds. A distance with the lower limit 0
    /// has the upper limit only.
    pub(super) fn choose_limit(
        &mut self,
        state: &JointState,
        joints: &JointList,
        velocities: Nodes<'_>,
        h: f64,
    ) {
        let [low, high] = self.range;
        if low < high && self.compliance == 0.0 {
            let is_upper = self.kind == RowKind::Distance && low <= 0.0 || {
                let ahead = self.predicted_value(state, joints, velocities, h);
                ahead - low >= high - ahead
            };
            self.set_active_limit(if is_upper { -1.0 } else { 1.0 });
        }
    }

    /// Lowers the largest impulse of the row to `limit`, if it is greater: mass units * length units/s in linear rows, mass
    /// units * length units^2/s in angular rows.
    pub(super) fn lower_max_impulse(&mut self, limit: f64) {
        self.max_impulse = self.max_impulse.min(limit);
        self.set_active_limit(self.active_limit);
    }

    /// Computes value, Jacobian and inverse effective mass of the row at the present poses.
    ///
    /// `inverse_masses` are those of the group, of which the first `body_count` belong to dynamic bodies.
    #[inline(always)]
    pub(super) fn update_jacobian(
        &mut self,
        state: &JointState,
        joints: &JointList,
        (inverse_masses, body_count): (Nodes<'_>, usize),
    ) {
        if state.anchors_at_origins && self.kind == RowKind::Distance {
            let [nx, ny, nz] = state.direction;
            self.jacobian = [[-nx, -ny, 0.0, -nz], [nx, ny, 0.0, nz]];
            self.value = state.distance;
        } else {
            self.update_anchor_jacobian(state, &joints[state.joint]);
        }
        let mut inverse_mass = 0.0;
        for (node, push) in self.nodes.into_iter().zip(self.jacobian) {
            if node.position() < body_count {
                inverse_mass += delassus_term(push, push, inverse_masses[node]);
            }
        }
        self.inverse_effective_mass = inverse_mass;
        self.responds = inverse_mass + self.compliance > 0.0;
        // A motor and a limit share one coordinate and may contradict each other; a loop may contradict itself. Compliance keeps
        // the matrix regular.
        let yields = self.closes_loop || matches!(self.kind, RowKind::Motor(_));
        self.diagonal =
            if yields { inverse_mass * (1.0 + LOOP_COMPLIANCE) } else { inverse_mass } + self.compliance;
    }

    /// Computes value and Jacobian of a row for anchors anywhere on the bodies, not only at the centres of mass.
    fn update_anchor_jacobian(&mut self, state: &JointState, joint: &JointConstraint) {
        let [a, b] = state.anchors();
        let [x, y, _] = anchor_offset(&[a, b]);
        let along = |[nx, ny, nz]: [f64; 3], arm_a: Vec2| {
            let angular = |arm: Vec2| dot(perp(arm), [nx, ny]);
            [[-nx, -ny, -angular(arm_a), -nz], [nx, ny, angular(b.arm), nz]]
        };
        // A prismatic joint acts on both bodies at anchor B.
        let arm_a_to_b = add_scaled(a.arm, [x, y], 1.0);
        let [lx, ly] = state.axis;
        let turning = [[0.0, 0.0, -1.0, 0.0], [0.0, 0.0, 1.0, 0.0]];
        self.jacobian = match self.kind {
            RowKind::AnchorAxis(0) => along([1.0, 0.0, 0.0], a.arm),
            RowKind::AnchorAxis(_) => along([0.0, 1.0, 0.0], a.arm),
            RowKind::DepthVelocity => [[0.0, 0.0, 0.0, -1.0], [0.0, 0.0, 0.0, 1.0]],
            RowKind::Distance => along(state.direction, a.arm),
            RowKind::LineOffset => along([-ly, lx, 0.0], arm_a_to_b),
            RowKind::Motor(_) | RowKind::Limits(_) if state.link == LockedDofs::Line => {
                along([lx, ly, 0.0], arm_a_to_b)
            }
            RowKind::Angle | RowKind::Motor(_) | RowKind::Limits(_) => turning,
        };
        self.value = state.value(self.kind, &[a, b], joint);
    }

    /// Returns the rate of the row's value for the velocities of the group, J v: radians/s in angular rows, else length
    /// units/s.
    #[inline(always)]
    fn relative_velocity(&self, velocities: Nodes<'_>) -> f64 {
        let of = |side: usize| {
            let (push, velocity) = (self.jacobian[side], velocities[self.nodes[side]]);
            (0..4).map(|i| push[i] * velocity[i]).sum::<f64>()
        };
        of(0) + of(1)
    }

    /// Returns the value of the row after `h` seconds with the velocities of the group's bodies: radians in angular rows, else
    /// length units.
    #[inline(always)]
    fn predicted_value(&self, state: &JointState, joints: &JointList, velocities: Nodes<'_>, h: f64) -> f64 {
        if state.anchors_at_origins && self.kind == RowKind::Distance {
            state.predicted_origin_distance(velocities, h)
        } else {
            state.value(self.kind, &state.predicted_anchors(velocities, h), &joints[state.joint])
        }
    }

    /// Sets the value or the velocity that the row seeks in a phase of a substep of `h` seconds.
    ///
    /// In the phases before bodies move, the velocity of a row is the nonlinear change of its value in the substep, divided by
    /// `h`. The row then seeks a value.
    #[inline(always)]
    pub(super) fn set_target(&mut self, h: f64, phase: SolvePhase) {
        let [low, high] = self.range;
        let is_exact = self.active_limit == 0.0;
        let distance = if self.active_limit > 0.0 { self.value - low } else { high - self.value };
        (self.seeks_value, self.target) = match self.kind {
            RowKind::DepthVelocity => (false, 0.0),
            RowKind::Motor(motor) => (false, f64::from(motor.speed)),
            _ if self.compliance > 0.0 => (false, -((self.value - high) * self.bias_rate)),
            _ if phase == SolvePhase::Relax && is_exact => (false, 0.0),
            _ if phase == SolvePhase::Relax => (false, -(self.active_limit * distance.max(0.0) / h)),
            _ if !is_exact && distance >= 0.0 => (true, self.value - self.active_limit * distance),
            _ if phase == SolvePhase::HoldPosition => (true, self.value),
            _ => (true, self.value - self.corrected_error),
        };
    }

    /// Returns the velocity of the row minus its [target](Self::set_target), in a substep of `h` seconds: radians/s in angular
    /// rows, else length units/s.
    #[inline(always)]
    pub(super) fn velocity_error(
        &self,
        (states, joints): (States<'_>, &JointList),
        velocities: Nodes<'_>,
        h: f64,
    ) -> f64 {
        if self.seeks_value {
            let state = &states[self.joint];
            return (self.predicted_value(state, joints, velocities, h) - self.target) / h;
        }
        let error = self.relative_velocity(velocities) - self.target;
        if self.compliance > 0.0 { error + self.compliance * self.impulse } else { error }
    }

    /// Returns the amount of the position error that the substep corrects, with the sign of the error: radians in angular rows,
    /// else length units.
    #[inline(always)]
    fn position_error_to_correct(&self) -> f64 {
        let [low, high] = self.range;
        match self.kind {
            RowKind::DepthVelocity | RowKind::Motor(_) => 0.0,
            _ if self.compliance > 0.0 => 0.0,
            _ if self.active_limit == 0.0 => {
                corrected_part(self.value - high, self.error_unit, self.closes_loop)
            }
            _ => {
                let distance = if self.active_limit > 0.0 { self.value - low } else { high - self.value };
                -self.active_limit * corrected_part((-distance - self.slop).max(0.0), self.error_unit, true)
            }
        }
    }

    /// Determines the position error that the substep corrects. Returns its absolute value as a multiple of `error_unit`,
    /// dimensionless.
    #[inline(always)]
    pub(super) fn choose_corrected_error(&mut self) -> f64 {
        self.corrected_error = self.position_error_to_correct();
        self.corrected_error.abs() / self.error_unit
    }

    /// Adds the impulse of the row on body B to `total`: x, y and z in mass units * length units/s, angular in mass units *
    /// length units^2/s.
    ///
    /// Linear rows add no angular impulse.
    #[inline(always)]
    pub(super) fn accumulate_impulse(&self, link: LockedDofs, total: &mut Velocity4) {
        let [x, y, turning, z] = self.jacobian[1];
        // The moment of a force at the anchor is no torque of the joint.
        let turning = if self.kind.is_angular(link) { turning } else { 0.0 };
        for (total, push) in total.iter_mut().zip([x, y, turning, z]) {
            *total += push * self.impulse;
        }
    }
}

/// Returns the contribution of one body to an element of the Delassus matrix J M^-1 J^T: the sum of `a` * `b` *
/// `inverse_masses` over the components.
///
/// `a` and `b` are the elements of two rows of the Jacobian for the body. The unit is 1/(mass units); each angular row divides
/// it by length units.
#[inline(always)]
pub(super) fn delassus_term(a: Velocity4, b: Velocity4, inverse_masses: Velocity4) -> f64 {
    (0..4).map(|i| a[i] * b[i] * inverse_masses[i]).sum()
}

/// Returns the amount of a position error that a substep corrects, limited to [`MAX_POSITION_CORRECTION`] times `error_unit`:
/// radians in angular rows, else length units.
///
/// With `is_baumgarte` it is the fraction [`LOOP_BAUMGARTE_FACTOR`] of the limited error.
#[inline(always)]
fn corrected_part(error: f64, error_unit: f64, is_baumgarte: bool) -> f64 {
    let clamped = error.clamp(-MAX_POSITION_CORRECTION * error_unit, MAX_POSITION_CORRECTION * error_unit);
    if is_baumgarte { LOOP_BAUMGARTE_FACTOR * clamped } else { clamped }
}
