//! Four joints of one graph colour in the iterative solver: soft constraints in SIMD lanes.
//!
//! The equality rows of each joint are solved at once, as a block with a 3x3 effective mass. Motor and limits are one more row,
//! the [motor-limit row](super::block_row). Impulses are those of one substep on body B, in the rows of `BodyPairLanes`.

use crate::parameters::joints::{
    DRIVEN_JOINT_ERROR, HANDED_OVER_IMPULSE_LOSS, HANDED_OVER_LOSS_PER_CORRECTION, JOINT_CORRECTION_SPEED,
    SOFT_ROW_ANGLE_ERROR, SOFT_ROW_ARM,
};
use wide::{f32x4, f64x4};

use super::super::bodies::{BodySet, MotionState};
use super::super::direct_solver::constraint::RowMask;
use super::super::direct_solver::joint::{ACROSS, ALONG, ANGLE};
use super::super::direct_solver::mat3::Vec3;
use super::block_pair::{
    BodyPairLanes, JointLanes, RowDirection, RowLanes, set_lane_rounded, to_f32, to_f64,
};
use super::block_row::{MotorLimitLanes, motor_limit_row};
use super::frame::JointFrame;
use super::indices::JointIndex;
use super::joint_constraint::{JointAnchor, JointConstraint, JointList};
use super::locked_dofs::LockedDofs;
use super::soft_law::{BlockEffectiveMass, RowSoftness, RowSoftnessLanes, wide_masks};
use crate::index::{BodyIndex, IndexedVec};
use crate::math::lanes::{greater, select, smaller};

/// Index of the joint in a lane that has no joint.
const NO_JOINT: JointIndex = JointIndex(u32::MAX);

const ZERO: JointLanes = f32x4::ZERO;

/// Four joints with the same direction of rows, solved side by side, one in each SIMD lane.
#[derive(Debug, Clone, Copy)]
pub(super) struct SoftJointBlock {
    /// For each lane: index of the joint in the list of all joints, or [`NO_JOINT`] if the lane is empty.
    joints: [JointIndex; 4],
    /// The two bodies of each joint, with the Jacobian.
    pair: BodyPairLanes,
    /// Masks of the equality rows along the normal, of the angle and along the tangent: a lane has all bits set where its joint
    /// has the row.
    row_masks: RowLanes,
    /// `row_masks` for numbers in f64, from [`prepare`](Self::prepare) on.
    wide_row_masks: [f64x4; 3],
    /// Effective mass of the equality rows, with the compliance of compliant joints on the diagonal.
    effective_mass: BlockEffectiveMass,
    /// Position errors of the equality rows along the normal, of the angle and along the tangent: length units, for the angle
    /// radians.
    position_errors: RowLanes,
    /// Largest position errors that are corrected in proportion at bodies that contacts hold, >= 0: of the linear rows together
    /// (length units) and of the angular row (radians). Larger ones are corrected at [`JOINT_CORRECTION_SPEED`].
    max_errors: [f32; 2],
    /// Mask of the joints with a kinematic body: their lanes have all bits set.
    driven_lanes: JointLanes,
    /// Accumulated impulses of a substep on body B in the equality rows along the normal, of the angle and along the tangent:
    /// mass units * length units/s, for the angle mass units * length units^2/s.
    impulses: RowLanes,
    /// Position that an equality row keeps: the distance of the anchors in length units, or the angle of B relative to A in
    /// radians. An angle is relative to the angle at the start of the update.
    target: JointLanes,
    /// Largest length of the linear impulse in a substep, mass units * length units/s, >= 0; infinite without a limit.
    max_linear_impulse: JointLanes,
    /// Largest angular impulse in a substep, mass units * length units^2/s, >= 0; infinite without a limit.
    max_angular_impulse: JointLanes,
    /// Whether a joint had a position error above `max_errors` at this pose, before the errors were bounded.
    has_large_error: bool,
    /// Whether one of the joints has a finite greatest impulse.
    has_impulse_limit: bool,
    /// Mask of the compliant joints, whose users set `softness`: their lanes have all bits set.
    compliant_lanes: JointLanes,
    /// Softness of the compliant joints. Other lanes are unused.
    compliant_softness: RowSoftnessLanes,
    /// Whether one of the joints is compliant: its user gave it a `softness`.
    has_compliant_lanes: bool,
    /// The row of motor and limits of each joint; `None` if the joints of this block have neither.
    motor_and_limits: Option<MotorLimitLanes>,
    /// Sum of the impulses of the update so far on body B, in world coordinates: along x and y (mass units * length units/s)
    /// and angular (mass units * length units^2/s).
    total_impulse: RowLanes,
}

/// Kind of a joint: the direction of its rows, and whether it has a motor-limit row. The joints of a block have one kind.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct BlockKind {
    direction: RowDirection,
    has_motor_or_limits: bool,
}

impl BlockKind {
    /// Number of different kinds of blocks.
    pub(super) const COUNT: usize = 8;

    pub(super) fn of_joint(joint: &JointConstraint) -> Self {
        BlockKind {
            direction: RowDirection::of_link(joint.locked),
            has_motor_or_limits: motor_limit_row(joint).is_some(),
        }
    }

    /// Returns the number of the kind, 0..[`COUNT`](Self::COUNT), which serves as an index.
    pub(super) fn index(self) -> usize {
        let direction = match self.direction {
            RowDirection::Fixed => 0,
            RowDirection::AcrossAxis => 1,
            RowDirection::BetweenAnchors => 2,
            RowDirection::AcrossWheelAxis => 3,
        };
        direction * 2 + usize::from(self.has_motor_or_limits)
    }
}

impl SoftJointBlock {
    /// Returns a block without joints for joints of this kind.
    pub(super) fn new(kind: BlockKind) -> Self {
        let infinite = f32x4::splat(f32::INFINITY);
        SoftJointBlock {
            joints: [NO_JOINT; 4],
            pair: BodyPairLanes::new(kind.direction),
            row_masks: [ZERO; 3],
            wide_row_masks: [f64x4::ZERO; 3],
            effective_mass: BlockEffectiveMass::default(),
            position_errors: [ZERO; 3],
            max_errors: [f32::INFINITY; 2],
            driven_lanes: ZERO,
            impulses: [ZERO; 3],
            target: ZERO,
            max_linear_impulse: infinite,
            max_angular_impulse: infinite,
            has_large_error: false,
            has_impulse_limit: false,
            compliant_lanes: ZERO,
            compliant_softness: RowSoftnessLanes::splat(&RowSoftness::RIGID),
            has_compliant_lanes: false,
            motor_and_limits: kind.has_motor_or_limits.then(MotorLimitLanes::default),
            total_impulse: [ZERO; 3],
        }
    }

    /// Returns whether a joint of the block has a position error that is too large to be corrected in proportion, at the start of
    /// the substep.
    pub(super) fn has_large_error(&self) -> bool {
        self.has_large_error
    }

    /// Returns whether all four lanes have joints.
    pub(super) fn is_full(&self) -> bool {
        self.joints[3] != NO_JOINT
    }

    /// Stores a joint in the first empty lane. `index` is the joint's index in the list of joints; `times` are the seconds of
    /// an update and of a substep.
    ///
    /// The force of the last update becomes the warm-start impulse of the lane. Returns whether the joint acts: it has an
    /// equality row, a motor, or a limit with an impulse. A slack rope does not act.
    pub(super) fn add_joint(
        &mut self,
        index: JointIndex,
        joint: &JointConstraint,
        bodies: &BodySet,
        times: [f64; 2],
    ) -> bool {
        let lane = self.joints.iter().position(|&joint| joint == NO_JOINT).unwrap_or(3);
        self.joints[lane] = index;
        self.pair.set_joint(lane, joint, bodies);
        let [nx, ny] = JointFrame::of(joint).normal();
        let [x, y, torque] = joint.force.map(|force| force * times[1]);
        let impulses = [x * nx + y * ny, torque, x * ny - y * nx];
        let active_rows = equality_rows(joint);
        for row in (0..3).filter(|row| active_rows >> row & 1 == 1) {
            set_lane_rounded(&mut self.impulses[row], lane, impulses[row]);
            self.row_masks[row].as_mut_array()[lane] = f32::from_bits(!0);
        }
        self.set_driven(lane, joint, bodies);
        let initial_angle = if joint.locked == LockedDofs::Distance { 0.0 } else { joint.angle };
        set_lane_rounded(&mut self.target, lane, joint.range[0] - initial_angle);
        if joint.max_impulse < f64::from(f32::MAX) {
            self.set_max_impulse(lane, joint);
        }
        if let Some(softness) = RowSoftness::of_compliant_joint(joint, times) {
            self.compliant_lanes.as_mut_array()[lane] = f32::from_bits(!0);
            self.compliant_softness.set_lane(lane, &softness);
            self.has_compliant_lanes = true;
        }
        let mut is_acting = active_rows != 0;
        if let (Some(motor_and_limits), Some(row)) = (&mut self.motor_and_limits, motor_limit_row(joint)) {
            motor_and_limits.set_joint(lane, joint, impulses[row], times[1]);
            is_acting |= joint.drive.is_some_and(|drive| drive.motor.is_some())
                || motor_and_limits.impulse().to_array()[lane] != 0.0;
        }
        is_acting
    }

    /// Notes whether a body of the joint in a lane is kinematic.
    fn set_driven(&mut self, lane: usize, joint: &JointConstraint, bodies: &BodySet) {
        let is_driven = has_kinematic_body(joint, bodies);
        self.driven_lanes.as_mut_array()[lane] = f32::from_bits(if is_driven { !0 } else { 0 });
    }

    /// Sets the greatest impulse of the joint in a lane: of the linear rows for joints that keep a point or a distance, else of
    /// the angular row.
    fn set_max_impulse(&mut self, lane: usize, joint: &JointConstraint) {
        let is_linear = matches!(joint.locked, LockedDofs::Point | LockedDofs::Distance);
        let max_impulse =
            if is_linear { &mut self.max_linear_impulse } else { &mut self.max_angular_impulse };
        set_lane_rounded(max_impulse, lane, joint.max_impulse);
        self.has_impulse_limit = true;
    }

    /// Computes Jacobian, position errors and effective masses, and limits the warm start. All joints of the block must be in
    /// their lanes. `length_unit` is the length unit of the simulator.
    pub(super) fn prepare(&mut self, softness: &RowSoftness, length_unit: f32) {
        self.wide_row_masks = wide_masks(self.row_masks);
        let max_error = (JOINT_CORRECTION_SPEED / softness.bias_rate) as f32;
        self.max_errors = [max_error * length_unit, max_error];
        self.pair.update_jacobian();
        self.update_rows();
        self.has_large_error = self.exceeds_max_errors();
        self.bound_errors_of(select(self.compliant_lanes, ZERO, self.driven_lanes));
        self.limit_warm_start(&RowSoftnessLanes::splat(softness), length_unit);
    }

    /// Updates position errors and effective masses after the poses in `pair` have changed.
    fn update_rows(&mut self) {
        let ([along, across], travel) = self.pair.positions();
        let max_angle_error = f32x4::splat(SOFT_ROW_ANGLE_ERROR as f32);
        let angle_error = self.pair.relative_rotation - self.target;
        let is_distance = self.pair.direction == RowDirection::BetweenAnchors;
        self.position_errors = [
            if is_distance { along - self.target } else { along },
            smaller(greater(angle_error, ZERO - max_angle_error), max_angle_error),
            if is_distance { ZERO } else { across },
        ];
        let [mut diagonal, products] = self.pair.inverse_effective_mass();
        let motor_row = self.motor_limit_row();
        if let Some(motor_and_limits) = &mut self.motor_and_limits {
            let length = match self.pair.direction {
                RowDirection::Fixed | RowDirection::AcrossWheelAxis => None,
                RowDirection::AcrossAxis => Some(travel),
                RowDirection::BetweenAnchors => Some(along),
            };
            motor_and_limits.update_position(
                self.pair.relative_rotation,
                length,
                to_f32(diagonal[motor_row]),
            );
        }
        if self.has_compliant_lanes {
            let compliance = to_f64(self.compliant_softness.compliance & self.compliant_lanes);
            diagonal.iter_mut().for_each(|own| *own += compliance);
        }
        self.effective_mass = BlockEffectiveMass::factorise(diagonal, products, self.wide_row_masks);
    }

    /// Returns the index of the motor-limit row: ALONG (normal), ANGLE or ACROSS (tangent).
    fn motor_limit_row(&self) -> usize {
        match self.pair.direction {
            RowDirection::Fixed | RowDirection::AcrossWheelAxis => ANGLE,
            RowDirection::AcrossAxis => ACROSS,
            RowDirection::BetweenAnchors => ALONG,
        }
    }

    /// Returns the impulses of a substep on body B, of equality rows, motors and limits together, in the rows along the normal,
    /// of the angle and along the tangent. Unit: mass units * length units/s, for the angle mass units * length units^2/s.
    #[inline(always)]
    fn row_impulses(&self) -> RowLanes {
        let mut impulses = self.impulses;
        if let Some(motor_and_limits) = &self.motor_and_limits {
            impulses[self.motor_limit_row()] += motor_and_limits.impulse();
        }
        impulses
    }

    /// Scales down warm-start impulses of which the soft rows would lose too much at once.
    ///
    /// The direct solver may have found an impulse as that of a rigid row. A soft row removes the fraction `impulse_scale` of
    /// it in its first solve, as a jump of the velocity. Where that jump exceeds [`HANDED_OVER_IMPULSE_LOSS`] plus
    /// [`HANDED_OVER_LOSS_PER_CORRECTION`] times the correction speed, the impulse is scaled to that limit. Compliant joints
    /// keep their impulses.
    fn limit_warm_start(&mut self, softness: &RowSoftnessLanes, length_unit: f32) {
        let [[ax, ay, aw], [bx, by, bw]] = self.pair.velocity_changes(self.impulses);
        let speeds = self.pair.relative_velocities(&[[ax, ay, aw, ZERO], [bx, by, bw, ZERO]]);
        let lost: RowLanes =
            std::array::from_fn(|row| (softness.impulse_scale * speeds[row]) & self.row_masks[row]);
        let loss_per_error =
            f32x4::splat(HANDED_OVER_LOSS_PER_CORRECTION) * softness.mass_scale * softness.bias_rate;
        let closed: RowLanes =
            std::array::from_fn(|row| (loss_per_error * self.position_errors[row]) & self.row_masks[row]);
        let lever = f32x4::splat(SOFT_ROW_ARM * length_unit);
        let size = |rows: RowLanes| {
            let linear = (rows[ALONG] * rows[ALONG] + rows[ACROSS] * rows[ACROSS]).sqrt();
            [linear, greater(rows[ANGLE], ZERO - rows[ANGLE]) * lever]
        };
        let (lost, closed) = (size(lost), size(closed));
        for (rows, kind) in [(&[ALONG, ACROSS][..], 0), (&[ANGLE], 1)] {
            let max_loss = f32x4::splat(HANDED_OVER_IMPULSE_LOSS * length_unit) + closed[kind];
            let is_limited =
                lost[kind].simd_gt(max_loss) & (self.compliant_lanes ^ f32x4::splat(f32::from_bits(!0)));
            for &row in rows {
                let impulse = self.impulses[row];
                self.impulses[row] = select(is_limited, impulse * (max_loss / lost[kind]), impulse);
            }
        }
    }

    /// Adds the velocity changes by the accumulated impulses to `sums`, the warm-start sums by body index.
    pub(super) fn add_warm_start(&self, sums: &mut [[f32; 4]]) {
        self.pair.add_warm_start(sums, self.row_impulses());
    }

    /// Solves the motor-limit row and then the block of equality rows once. Changes the velocities in `states`. `inverse_h` is
    /// the reciprocal of the substep, 1/s.
    #[inline(always)]
    pub(super) fn solve(
        &mut self,
        states: &mut [MotionState],
        phase_softness: &RowSoftnessLanes,
        inverse_h: f32,
    ) {
        let mut velocities = self.pair.velocities(states);
        let softness = match self.has_compliant_lanes {
            true => phase_softness.select(self.compliant_lanes, &self.compliant_softness),
            false => *phase_softness,
        };
        let motor_row = self.motor_limit_row();
        if let Some(motor_and_limits) = &mut self.motor_and_limits {
            let mut change = [ZERO; 3];
            change[motor_row] = motor_and_limits.solve(
                self.pair.relative_velocities(&velocities)[motor_row],
                &softness,
                inverse_h,
            );
            self.pair.apply_impulses(&mut velocities, change);
        }
        let speeds = self.pair.relative_velocities(&velocities);
        let velocity_errors: RowLanes = std::array::from_fn(|row| {
            speeds[row]
                + softness.bias_rate * self.position_errors[row]
                + softness.compliance * self.impulses[row]
        });
        let impulse_errors = self.effective_mass.solve(velocity_errors);
        let mut next: RowLanes =
            std::array::from_fn(|row| softness.next_impulse(self.impulses[row], impulse_errors[row]));
        if self.has_impulse_limit {
            next = self.clamp_impulses(next, velocity_errors, &softness);
        }
        let change = std::array::from_fn(|row| next[row] - self.impulses[row]);
        self.impulses = next;
        self.pair.apply_impulses(&mut velocities, change);
        self.pair.store_velocities(states, velocities);
    }

    /// Bounds the position errors by `max_errors` at bodies that contacts hold against joints (their entries of `held_masks` have
    /// all bits set, others are 0), and at joints with kinematic bodies. Compliant joints keep theirs.
    ///
    /// The impulse of a soft row grows with its error. Without the bound it would exceed any contact.
    #[inline(always)]
    fn bound_errors(&mut self, held_masks: &IndexedVec<BodyIndex, u32>) {
        let held = self.pair.marked_lanes(held_masks) | self.driven_lanes;
        self.bound_errors_of(select(self.compliant_lanes, ZERO, held));
    }

    /// Bounds the position errors of the joints in the lanes `held` by `max_errors`.
    fn bound_errors_of(&mut self, held: JointLanes) {
        if held.none() {
            return;
        }
        let is_angle = self.pair.direction.has_angular_motor();
        if let Some(motor_and_limits) = &mut self.motor_and_limits {
            motor_and_limits.bound_limit_error(self.max_errors[usize::from(is_angle)], held);
        }
        let [along, angle, across] =
            std::array::from_fn(|row| self.position_errors[row] & self.row_masks[row]);
        let errors = [along * along + across * across, angle * angle].map(f32x4::sqrt);
        for (rows, kind) in [(&[ALONG, ACROSS][..], 0), (&[ANGLE], 1)] {
            let (error, most) = (errors[kind], f32x4::splat(self.max_errors[kind]));
            let fraction = select(held & error.simd_gt(most), most / error, f32x4::splat(1.0));
            rows.iter().for_each(|&row| self.position_errors[row] *= fraction);
        }
    }

    /// Returns whether a joint of the block has a position error, or is beyond a limit, by more than `max_errors`, or
    /// by [`DRIVEN_JOINT_ERROR`] of them if a kinematic body drives it.
    fn exceeds_max_errors(&self) -> bool {
        let one = f32x4::splat(1.0);
        let share = select(self.driven_lanes, f32x4::splat(DRIVEN_JOINT_ERROR), one);
        let [along, angle, across] =
            std::array::from_fn(|row| self.position_errors[row] & self.row_masks[row]);
        let [linear, angular] = self.max_errors.map(|error| {
            let most = share * f32x4::splat(error);
            most * most
        });
        let mut is_large =
            (along * along + across * across).simd_gt(linear) | (angle * angle).simd_gt(angular);
        if let Some(motor_and_limits) = &self.motor_and_limits {
            let is_angle = self.pair.direction.has_angular_motor();
            let most = share * f32x4::splat(self.max_errors[usize::from(is_angle)]);
            is_large |= motor_and_limits.limit_violation().simd_gt(most);
        }
        is_large.any()
    }

    /// Removes the velocity error of rigid joints after an impact, if one of their bodies is in `impacted_masks`. Adds the
    /// other bodies of these joints to `impacted_masks` and `impacted_bodies`.
    ///
    /// The accumulated impulses of these joints become 0: they have stopped the bodies before the impact, and a warm start with
    /// them would accelerate the bodies that have rebounded. Motors, limits, compliant joints and joints with a greatest
    /// impulse transmit no impact. Returns the largest velocity error before the solve, length units/s. [`SOFT_ROW_ARM`]
    /// converts angular errors to it.
    pub(super) fn solve_impact(
        &mut self,
        states: &mut [MotionState],
        (impacted_masks, impacted_bodies): (&mut IndexedVec<BodyIndex, u32>, &mut Vec<BodyIndex>),
        length_unit: f32,
    ) -> f32 {
        let infinite = f32x4::splat(f32::INFINITY);
        let is_rigid = self.max_linear_impulse.simd_eq(infinite) & self.max_angular_impulse.simd_eq(infinite);
        let [along, angle, across] = self.row_masks;
        let is_hard = is_rigid & (along | angle | across);
        let impacted = select(self.compliant_lanes, ZERO, is_hard & self.pair.marked_lanes(impacted_masks));
        if impacted.none() {
            return 0.0;
        }
        let mut velocities = self.pair.velocities(states);
        let velocity_errors = self.pair.relative_velocities(&velocities);
        let change = self.effective_mass.solve(velocity_errors).map(|impulse| (ZERO - impulse) & impacted);
        self.pair.apply_impulses(&mut velocities, change);
        self.pair.store_velocities(states, velocities);
        self.pair.mark_bodies(impacted, impacted_masks, impacted_bodies);
        let impulses = self.world_impulse(change);
        (0..3).for_each(|i| self.total_impulse[i] += impulses[i]);
        self.impulses = self.impulses.map(|impulse| select(impacted, ZERO, impulse));
        let size = |row: usize| {
            greater(velocity_errors[row], ZERO - velocity_errors[row]) & self.row_masks[row] & impacted
        };
        let velocity_error = greater(
            greater(size(ALONG), size(ACROSS)),
            f32x4::splat(SOFT_ROW_ARM * length_unit) * size(ANGLE),
        );
        velocity_error
            .to_array()
            .into_iter()
            .fold(0.0, |most, missed| if missed > most { missed } else { most })
    }

    /// Returns the impulses `next` of the equality rows clamped to their limits: mass units * length units/s, for the angle
    /// mass units * length units^2/s.
    ///
    /// The length of the linear impulse and the absolute angular impulse are limited. Where the angular impulse is clamped, the
    /// linear rows are solved again for the clamped one.
    #[inline(never)]
    fn clamp_impulses(
        &self,
        mut next: RowLanes,
        velocity_errors: RowLanes,
        softness: &RowSoftnessLanes,
    ) -> RowLanes {
        let size = (next[ALONG] * next[ALONG] + next[ACROSS] * next[ACROSS]).sqrt();
        let scale =
            select(size.simd_gt(self.max_linear_impulse), self.max_linear_impulse / size, f32x4::splat(1.0));
        [ALONG, ACROSS].into_iter().for_each(|row| next[row] *= scale);
        let angle = smaller(greater(next[ANGLE], ZERO - self.max_angular_impulse), self.max_angular_impulse);
        let is_clamped = angle.simd_ne(next[ANGLE]);
        let change = angle - self.impulses[ANGLE];
        let [diagonal, products @ [coupling_along, _, coupling_across]] = self.pair.inverse_effective_mass();
        let mass = BlockEffectiveMass::factorise(
            diagonal,
            products,
            [self.wide_row_masks[ALONG], f64x4::ZERO, self.wide_row_masks[ACROSS]],
        );
        let [along, _, across] = velocity_errors;
        let [beside_along, beside_across] = [coupling_along, coupling_across].map(to_f32);
        let impulse_errors =
            mass.solve([along + beside_along * change, ZERO, across + beside_across * change]);
        for row in [ALONG, ACROSS] {
            next[row] =
                select(is_clamped, softness.next_impulse(self.impulses[row], impulse_errors[row]), next[row]);
        }
        next[ANGLE] = angle;
        next
    }

    /// Updates relative poses and rows after the bodies have moved in a substep.
    /// `held_masks` has all bits set for bodies that contacts hold against joints, else 0.
    pub(super) fn advance(&mut self, bodies: &mut BodySet, held_masks: &IndexedVec<BodyIndex, u32>) {
        self.pair.advance_poses(bodies, self.row_impulses());
        self.update_rows();
        self.has_large_error = self.exceeds_max_errors();
        self.bound_errors(held_masks);
    }

    /// Returns the total impulses of this substep on body B in world coordinates: along x and y (mass units * length units/s)
    /// and angular (mass units * length units^2/s).
    fn impulse_on_b(&self) -> RowLanes {
        self.world_impulse(self.row_impulses())
    }

    fn world_impulse(&self, [along, angle, across]: RowLanes) -> RowLanes {
        let [nx, ny] = self.pair.normal;
        [along * nx + across * ny, along * ny - across * nx, angle]
    }

    /// Adds the impulses of this substep on body B to `total_impulse`, the sum of the update.
    pub(super) fn accumulate_impulses(&mut self) {
        let impulses = self.impulse_on_b();
        (0..3).for_each(|i| self.total_impulse[i] += impulses[i]);
    }

    /// Stores force and torque on body B in each joint: `force` is that of the last substep of `h` seconds, `mean_force` the
    /// mean over the update of `dt` seconds.
    pub(super) fn store_forces(&self, joints: &mut JointList, [dt, h]: [f32; 2]) {
        let impulse_on_b = self.impulse_on_b();
        for (lane, &at) in self.joints.iter().enumerate().filter(|&(_, &at)| at != NO_JOINT) {
            let per_second = |rows: &RowLanes, seconds: f32| -> Vec3 {
                rows.map(|impulses| f64::from(impulses.to_array()[lane]) / f64::from(seconds) + 0.0)
            };
            let joint = &mut joints[at];
            joint.force = per_second(&impulse_on_b, h);
            joint.mean_force = Some(per_second(&self.total_impulse, dt));
        }
    }
}

/// Returns whether a body of the joint is kinematic.
fn has_kinematic_body(joint: &JointConstraint, bodies: &BodySet) -> bool {
    joint.anchors.iter().any(|&JointAnchor { pose_body: body, .. }| {
        body != BodyIndex::PLACEHOLDER && body < bodies.first_static() && bodies.is_kinematic(body)
    })
}

/// Returns the mask of a joint's equality rows: bit ALONG (normal), ANGLE or ACROSS (tangent). A distance or angle with a range
/// has none, since its limits are in the motor-limit row.
fn equality_rows(joint: &JointConstraint) -> RowMask {
    if joint.has_limited_row() { 0 } else { joint.locked.locked_rows() }
}
