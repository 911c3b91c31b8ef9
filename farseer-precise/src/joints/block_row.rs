//! The motor-limit row of four joints in the iterative solver: a motor and two limits on the same coordinate.
//!
//! | joint | coordinate of the row | position |
//! |---|---|---|
//! | revolute | angle | radians from the reference angle |
//! | prismatic | along the axis | length units |
//! | slider | along the line between the anchors | length units |
//! | angle limit | angle | radians |
//!
//! A joint without a motor has a largest motor impulse of 0. A joint without limits has infinite ones.

use crate::parameters::joints::SOFT_ROW_ANGLE_ERROR;
use wide::f32x4;

use super::super::direct_solver::joint::ANGLE;
use super::block_pair::{JointLanes, set_lane_rounded};
use super::joint_constraint::JointConstraint;
use super::soft_law::{RowSoftnessLanes, clamp_symmetric};
use crate::math::lanes::{greater, positive, select, smaller};

const ZERO: JointLanes = f32x4::ZERO;

/// Motor-limit rows of four joints, in SIMD lanes: a motor and two limits on one coordinate. Impulses are those of one substep,
/// on body B.
///
/// Linear rows have impulses in mass units * length units/s, angular rows in mass units * length units^2/s.
#[derive(Debug, Clone, Copy)]
pub(super) struct MotorLimitLanes {
    /// Inverse effective mass, K of the row: 1/(mass units) in linear rows, 1/(mass units * length units^2) in angular rows; 0
    /// if neither body can move along the row.
    inverse_effective_mass: JointLanes,
    /// Coordinate of the joint that motor and limits act on: length units in linear rows, radians in angular rows.
    position: JointLanes,
    /// Angle of the joint at the start of the update, minus the reference angle, radians; unused in linear rows.
    initial_position: JointLanes,
    /// Speed that the motor seeks: length units/s in linear rows, radians/s in angular rows.
    motor_speed: JointLanes,
    /// Largest motor impulse of a substep, >= 0: mass units * length units/s in linear rows, mass units * length units^2/s in
    /// angular rows; 0 without a motor.
    max_motor_impulse: JointLanes,
    /// Accumulated motor impulse of a substep on body B: mass units * length units/s in linear rows, mass units * length
    /// units^2/s in angular rows.
    motor_impulse: JointLanes,
    /// Lower and upper limit of `position`: length units in linear rows, radians in angular rows; infinite without limits.
    limits: [JointLanes; 2],
    /// Violation of a limit that is not corrected, >= 0: length units in linear rows, radians in angular rows.
    slop: JointLanes,
    /// Largest impulse of each limit in a substep, >= 0: mass units * length units/s in linear rows, mass units * length
    /// units^2/s in angular rows.
    max_limit_impulse: JointLanes,
    /// Largest violation of a limit that is corrected in proportion, >= 0: length units in linear rows, radians in angular rows.
    /// Larger ones are corrected at its speed.
    max_limit_error: JointLanes,
    /// Accumulated impulses of the lower and the upper limit in a substep, both >= 0: mass units * length units/s in linear
    /// rows, mass units * length units^2/s in angular rows. The lower limit acts along the row, the upper limit against it.
    limit_impulses: [JointLanes; 2],
}

impl Default for MotorLimitLanes {
    fn default() -> Self {
        let infinite = f32x4::splat(f32::INFINITY);
        MotorLimitLanes {
            inverse_effective_mass: ZERO,
            position: ZERO,
            initial_position: ZERO,
            motor_speed: ZERO,
            max_motor_impulse: ZERO,
            motor_impulse: ZERO,
            limits: [ZERO - infinite, infinite],
            slop: ZERO,
            max_limit_impulse: infinite,
            max_limit_error: infinite,
            limit_impulses: [ZERO; 2],
        }
    }
}

impl MotorLimitLanes {
    /// Stores a joint in one lane. `impulse` is the row's warm-start impulse of a substep of `h` seconds: mass units * length
    /// units/s in linear rows, mass units * length units^2/s in angular rows.
    ///
    /// The motor takes as much of the impulse as its limit allows. The rest goes to the limit that acts in the direction of
    /// this rest.
    pub(super) fn set_joint(&mut self, lane: usize, joint: &JointConstraint, impulse: f64, h: f64) {
        let drive = joint.drive;
        let mut limit_impulse = impulse;
        if let Some(motor) = drive.and_then(|drive| drive.motor) {
            let max_impulse = f64::from(motor.greatest_effort) * h;
            let motor_impulse = clamp_symmetric(impulse, max_impulse);
            limit_impulse -= motor_impulse;
            set_lane_rounded(&mut self.motor_speed, lane, motor.speed.into());
            set_lane_rounded(&mut self.max_motor_impulse, lane, max_impulse);
            set_lane_rounded(&mut self.motor_impulse, lane, motor_impulse);
        }
        let limits = match drive {
            Some(drive) => drive.limits.map(|limits| [limits.lower, limits.upper].map(f64::from)),
            None => Some(joint.range),
        };
        let reference = drive.map_or(0.0, |drive| f64::from(drive.reference));
        let is_angle = joint.locked.motor_row() == ANGLE;
        if is_angle {
            set_lane_rounded(&mut self.initial_position, lane, joint.angle - reference);
        }
        let Some(limits) = limits else { return };
        let (slop, max_limit_impulse) =
            if drive.is_some() { (0.0, f64::INFINITY) } else { (joint.slop, joint.max_impulse) };
        let limit_impulses = [limit_impulse, -limit_impulse]
            .map(|impulse| if impulse > 0.0 { clamp_symmetric(impulse, max_limit_impulse) } else { 0.0 });
        for side in [0, 1] {
            set_lane_rounded(&mut self.limits[side], lane, limits[side]);
            set_lane_rounded(&mut self.limit_impulses[side], lane, limit_impulses[side]);
        }
        set_lane_rounded(&mut self.slop, lane, slop);
        set_lane_rounded(&mut self.max_limit_impulse, lane, max_limit_impulse);
        set_lane_rounded(
            &mut self.max_limit_error,
            lane,
            if is_angle { SOFT_ROW_ANGLE_ERROR } else { f64::INFINITY },
        );
    }

    /// Bounds the violation of a limit that is corrected in proportion by `max_error`, >= 0 (length units in linear rows, radians
    /// in angular rows), for the joints in `lanes`.
    pub(super) fn bound_limit_error(&mut self, max_error: f32, lanes: JointLanes) {
        let bounded = smaller(self.max_limit_error, f32x4::splat(max_error));
        self.max_limit_error = select(lanes, bounded, self.max_limit_error);
    }

    /// Returns by how much each joint is beyond its limits, >= 0: length units in linear rows, radians in angular rows.
    pub(super) fn limit_violation(&self) -> JointLanes {
        positive(greater(self.limits[0] - self.position, self.position - self.limits[1]) - self.slop)
    }

    /// Sets the coordinate of each joint (`position`) and the inverse effective mass of the row (`inverse_mass`) at the present
    /// poses.
    ///
    /// In linear rows the coordinate is `length`, in length units. In angular rows `length` is `None`, and the coordinate
    /// follows from `relative_rotation`: the rotation of B relative to A since the start of the update, in radians.
    pub(super) fn update_position(
        &mut self,
        relative_rotation: JointLanes,
        length: Option<JointLanes>,
        inverse_mass: JointLanes,
    ) {
        self.inverse_effective_mass = inverse_mass;
        self.position = length.unwrap_or(self.initial_position + relative_rotation);
    }

    /// Returns the sum of the impulses of motor and limits on body B in a substep: mass units * length units/s in linear rows,
    /// mass units * length units^2/s in angular rows.
    #[inline(always)]
    pub(super) fn impulse(&self) -> JointLanes {
        self.motor_impulse + (self.limit_impulses[0] - self.limit_impulses[1])
    }

    /// Solves the rigid motor and then both limits. Returns the change of the impulse on body B: mass units * length units/s in
    /// linear rows, mass units * length units^2/s in angular rows.
    ///
    /// `speed` is the relative velocity of the row, length units/s or, in angular rows, radians/s. `inverse_h` is the
    /// reciprocal of the substep, 1/s.
    #[inline(always)]
    pub(super) fn solve(
        &mut self,
        mut speed: JointLanes,
        softness: &RowSoftnessLanes,
        inverse_h: f32,
    ) -> JointLanes {
        let is_movable = self.inverse_effective_mass.simd_gt(ZERO);
        let inverse = self.inverse_effective_mass;
        let mass = (f32x4::splat(1.0) / inverse) & is_movable;
        let unclamped = self.motor_impulse - (speed - self.motor_speed) * mass;
        let clamped = smaller(greater(unclamped, ZERO - self.max_motor_impulse), self.max_motor_impulse);
        let mut change = (clamped - self.motor_impulse) & is_movable;
        self.motor_impulse += change;
        speed += inverse * change;
        let soft_mass = (f32x4::splat(1.0) / (inverse + softness.compliance)) & is_movable;
        for (side, sign) in [1.0, -1.0].into_iter().enumerate() {
            let limit_change =
                self.solve_limit((side, f32x4::splat(sign)), speed, softness, [mass, soft_mass], inverse_h);
            change += limit_change;
            speed += inverse * limit_change;
        }
        change
    }

    /// Solves the lower limit (`side` 0) or the upper limit (1). Returns the change of the impulse along the row: mass units *
    /// length units/s in linear rows, mass units * length units^2/s in angular rows.
    ///
    /// `speed` is the relative velocity of the row, length units/s or, in angular rows, radians/s. A limit at a distance d > 0
    /// is a rigid, speculative row: the speed towards it is at most d / h, with the substep h. A limit that is reached has the
    /// softness of the phase.
    #[inline(always)]
    fn solve_limit(
        &mut self,
        (side, sign): (usize, JointLanes),
        speed: JointLanes,
        softness: &RowSoftnessLanes,
        [mass, soft_mass]: [JointLanes; 2],
        inverse_h: f32,
    ) -> JointLanes {
        let (old_impulse, approach) = (self.limit_impulses[side], sign * speed);
        let distance = sign * (self.position - self.limits[side]);
        let is_apart = distance.simd_gt(ZERO);
        let violation = smaller(distance + self.slop, ZERO);
        let correction_speed = softness.bias_rate * greater(violation, ZERO - self.max_limit_error);
        let soft = softness.next_impulse(
            old_impulse,
            soft_mass * (approach + correction_speed + softness.compliance * old_impulse),
        );
        let rigid = old_impulse - mass * (approach + distance * f32x4::splat(inverse_h));
        let new_impulse = smaller(positive(select(is_apart, rigid, soft)), self.max_limit_impulse);
        let change = (new_impulse - old_impulse) & mass.simd_gt(ZERO);
        self.limit_impulses[side] = old_impulse + change;
        sign * change
    }
}

/// Returns the row that motor and limits of a joint act on: ALONG (normal), ANGLE or ACROSS (tangent). Returns `None` if the
/// joint has neither a motor nor limits.
pub(super) fn motor_limit_row(joint: &JointConstraint) -> Option<usize> {
    (joint.has_limited_row() || joint.drive.is_some()).then_some(joint.locked.motor_row())
}
