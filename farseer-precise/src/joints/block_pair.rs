//! The two bodies of four joints in SIMD lanes: relative poses, Jacobians and velocity changes by impulses.
//!
//! The rows of a joint are: linear along the normal n, angular, and linear along the tangent t = (n.y, -n.x). Positions and
//! velocities of the rows are those of body B relative to body A; impulses act on body B. Lanes without a joint have body index
//! 0 and inverse masses 0. No two lanes share a dynamic body.

use wide::{f32x4, f64x4};

use super::super::bodies::{BodySet, MotionState};
use super::super::constraint_graph::set_lane;
use super::frame::JointFrame;
use super::joint_constraint::JointConstraint;
use super::locked_dofs::LockedDofs;
use crate::index::{BodyIndex, DenseIndex, IndexedVec};
use crate::math::lanes::{select, sin_cos};
use crate::math::scalar::sin_cos_of_any;

/// One number for each of four joints, in SIMD lanes.
pub(super) type JointLanes = f32x4;
/// One number for each row of four joints, in the order ALONG (linear row along the normal n), ANGLE, ACROSS (linear row along
/// the tangent t).
pub(super) type RowLanes = [JointLanes; 3];
/// Velocities or displacements of four bodies: x, y, angular, z. Velocities are in length units/s and radians/s, displacements
/// in length units and radians.
type VelocityLanes = [JointLanes; 4];

const ZERO: JointLanes = f32x4::ZERO;

/// Converts the lanes from f32 to f64.
#[inline(always)]
pub(super) fn to_f64(lanes: JointLanes) -> f64x4 {
    f64x4::new(lanes.to_array().map(f64::from))
}

/// Rounds the lanes from f64 to f32.
#[inline(always)]
pub(super) fn to_f32(lanes: f64x4) -> JointLanes {
    f32x4::new(lanes.to_array().map(|number| number as f32))
}

/// Stores `value`, rounded to f32, in one lane.
#[inline(always)]
pub(super) fn set_lane_rounded(lanes: &mut JointLanes, lane: usize, value: f64) {
    set_lane(lanes, lane, value as f32);
}

/// Direction of the normal n of a joint's linear rows.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(super) enum RowDirection {
    /// Keeps n = (1, 0): revolute, weld and angle joints.
    #[default]
    Fixed,
    /// Keeps n perpendicular to the axis of a prismatic joint.
    AcrossAxis,
    /// Keeps n perpendicular to the axis of a wheel joint, whose motor acts on the angle.
    AcrossWheelAxis,
    /// Turns n from anchor A to anchor B: pin and slider joints.
    BetweenAnchors,
}

impl RowDirection {
    pub(super) fn of_link(link: LockedDofs) -> Self {
        match link {
            LockedDofs::Line => RowDirection::AcrossAxis,
            LockedDofs::PointOnLine => RowDirection::AcrossWheelAxis,
            LockedDofs::Distance => RowDirection::BetweenAnchors,
            _ => RowDirection::Fixed,
        }
    }

    /// Returns whether n is perpendicular to an axis that turns with A.
    fn is_across_axis(self) -> bool {
        matches!(self, RowDirection::AcrossAxis | RowDirection::AcrossWheelAxis)
    }

    /// Returns whether motor and limits act on the angle.
    pub(super) fn has_angular_motor(self) -> bool {
        matches!(self, RowDirection::Fixed | RowDirection::AcrossWheelAxis)
    }
}

/// The bodies A and B of four joints, with relative poses and Jacobians.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct BodyPairLanes {
    /// Direction of the normal n, common to all four joints.
    pub(super) direction: RowDirection,
    /// Indices of the bodies A and B in [`BodySet::states`]; 0 for bodies without a velocity.
    bodies: [[BodyIndex; 4]; 2],
    /// Sets of the lanes in which A and B are dynamic: one bit per lane.
    movable_lanes: [u8; 2],
    /// Inverse masses of A and B, 1/(mass units); 0 for bodies that are not dynamic.
    inverse_masses: [JointLanes; 2],
    /// Inverse moments of inertia of A and B, 1/(mass units * length units^2); 0 for bodies that are not dynamic.
    inverse_inertias: [JointLanes; 2],
    /// Arms of A and B: vectors from the centres of mass to the anchors in world coordinates, length units.
    arms: [[JointLanes; 2]; 2],
    /// Vector from the centre of mass of A to that of B in world coordinates, length units.
    origin_offset: [JointLanes; 2],
    /// Axis of each prismatic joint in world coordinates, a unit vector.
    axis: [JointLanes; 2],
    /// Rotation of B relative to A since the start of the update, radians.
    pub(super) relative_rotation: JointLanes,
    /// Normal n of the linear rows in world coordinates, a unit vector.
    pub(super) normal: [JointLanes; 2],
    /// Angular elements of the Jacobian for A and B: velocity of the rows along n and t per angular velocity, length units. The
    /// element of the angular row is 1.
    angular_jacobian: [[JointLanes; 2]; 2],
}

impl BodyPairLanes {
    /// Returns four lanes without joints.
    pub(super) fn new(direction: RowDirection) -> Self {
        BodyPairLanes { direction, ..BodyPairLanes::default() }
    }

    /// Stores a joint in one lane, with the present pose of its bodies.
    pub(super) fn set_joint(&mut self, lane: usize, joint: &JointConstraint, bodies: &BodySet) {
        let JointFrame { arms, origin_offset: apart, axis, .. } = JointFrame::of(joint);
        for side in [0, 1] {
            let end = &joint.anchors[side];
            let is_listed = end.pose_body.position() < bodies.states.len();
            self.bodies[side][lane] = if is_listed { end.pose_body } else { BodyIndex::PLACEHOLDER };
            let [mass, inertia] = if end.body == BodyIndex::PLACEHOLDER {
                [0.0; 2]
            } else {
                bodies.inverse_mass_inertia[end.body]
            };
            self.movable_lanes[side] |= u8::from(mass > 0.0 || inertia > 0.0) << lane;
            set_lane_rounded(&mut self.inverse_masses[side], lane, mass.into());
            set_lane_rounded(&mut self.inverse_inertias[side], lane, inertia.into());
            (0..2).for_each(|i| set_lane_rounded(&mut self.arms[side][i], lane, arms[side][i]));
        }
        for i in 0..2 {
            set_lane_rounded(&mut self.origin_offset[i], lane, apart[i]);
            set_lane_rounded(&mut self.axis[i], lane, axis[i]);
        }
    }

    /// Returns the velocities of A and B in the world: x, y, angular, z, in length units/s and radians/s.
    #[inline(always)]
    pub(super) fn velocities(&self, states: &[MotionState]) -> [VelocityLanes; 2] {
        let of_side = |side: usize| lanes_of(&self.bodies[side], |body| states[body.position()].velocity);
        [of_side(0), of_side(1)]
    }

    /// Stores the velocities of A and B (x, y, angular, z) in `states`, for the dynamic bodies.
    #[inline(always)]
    pub(super) fn store_velocities(&self, states: &mut [MotionState], velocities: [VelocityLanes; 2]) {
        for (side, velocities) in velocities.into_iter().enumerate() {
            let rows = f32x4::transpose(velocities);
            self.for_each_movable_body(side, |lane, body| {
                states[body.position()].velocity = rows[lane].to_array()
            });
        }
    }

    /// Calls `visit` with lane and body index for each dynamic body on `side`: 0 (A) or 1 (B).
    #[inline(always)]
    fn for_each_movable_body(&self, side: usize, mut visit: impl FnMut(usize, BodyIndex)) {
        for lane in 0..4 {
            if self.movable_lanes[side] >> lane & 1 == 1 {
                visit(lane, self.bodies[side][lane]);
            }
        }
    }

    /// Returns the relative velocities of the rows for the velocities of A and B, J v: length units/s, in the angular row
    /// radians/s.
    #[inline(always)]
    pub(super) fn relative_velocities(&self, [a, b]: &[VelocityLanes; 2]) -> RowLanes {
        let ([nx, ny], [x, y, spin]) = (self.normal, [b[0] - a[0], b[1] - a[1], b[2] - a[2]]);
        let [[along_a, across_a], [along_b, across_b]] = self.angular_jacobian;
        [
            x * nx + y * ny + (b[2] * along_b - a[2] * along_a),
            spin,
            x * ny - y * nx + (b[2] * across_b - a[2] * across_a),
        ]
    }

    /// Returns the velocity changes M^-1 J^T l of A and B by the impulses l of the rows: x and y in length units/s, angular in
    /// radians/s.
    #[inline(always)]
    pub(super) fn velocity_changes(&self, [along, angle, across]: RowLanes) -> [[JointLanes; 3]; 2] {
        let [nx, ny] = self.normal;
        let (x, y) = (along * nx + across * ny, along * ny - across * nx);
        let change = |side: usize, sign: JointLanes| {
            let (mass, inertia) = (sign * self.inverse_masses[side], sign * self.inverse_inertias[side]);
            let [along_arm, across_arm] = self.angular_jacobian[side];
            [mass * x, mass * y, inertia * (along * along_arm + angle + across * across_arm)]
        };
        [change(0, f32x4::splat(-1.0)), change(1, f32x4::splat(1.0))]
    }

    /// Applies the impulses of the rows to the velocities of A and B (x, y, angular).
    #[inline(always)]
    pub(super) fn apply_impulses(&self, velocities: &mut [VelocityLanes; 2], impulses: RowLanes) {
        for (velocity, change) in velocities.iter_mut().zip(self.velocity_changes(impulses)) {
            (0..3).for_each(|i| velocity[i] += change[i]);
        }
    }

    /// Returns a mask with all bits set in the lanes of joints of which a body is marked. `masks` has for each body index all
    /// bits set if the body is marked, else 0.
    pub(super) fn marked_lanes(&self, masks: &IndexedVec<BodyIndex, u32>) -> JointLanes {
        let [a, b] = self.bodies;
        let of = |body: BodyIndex| {
            if body == BodyIndex::PLACEHOLDER { 0 } else { masks.at(body).copied().unwrap_or(0) }
        };
        f32x4::new(std::array::from_fn(|lane| f32::from_bits(of(a[lane]) | of(b[lane]))))
    }

    /// Marks the dynamic bodies of the joints in `lanes`: sets all bits in `masks`, and appends the indices of newly marked
    /// bodies to `marked`.
    pub(super) fn mark_bodies(
        &self,
        lanes: JointLanes,
        masks: &mut IndexedVec<BodyIndex, u32>,
        marked: &mut Vec<BodyIndex>,
    ) {
        for side in [0, 1] {
            self.for_each_movable_body(side, |lane, body| {
                if lanes.to_array()[lane].to_bits() != 0 && std::mem::replace(&mut masks[body], !0) == 0 {
                    marked.push(body);
                }
            });
        }
    }

    /// Adds the velocity changes by impulses of the rows to `sums`, the warm-start sums by body index.
    pub(super) fn add_warm_start(&self, sums: &mut [[f32; 4]], impulses: RowLanes) {
        self.add_changes(sums, self.velocity_changes(impulses));
    }

    fn add_changes(&self, sums: &mut [[f32; 4]], changes: [[JointLanes; 3]; 2]) {
        for (side, [x, y, turn]) in changes.into_iter().enumerate() {
            let rows = f32x4::transpose([x, y, turn, ZERO]);
            self.for_each_movable_body(side, |lane, body| {
                let sum = &mut sums[body.position()];
                *sum = (f32x4::new(*sum) + rows[lane]).to_array();
            });
        }
    }

    /// Returns K = J M^-1 J^T, the inverse of the effective mass: its diagonal, and its elements 10, 20 and 21 (row and column
    /// number).
    ///
    /// K is in 1/(mass units); the angular row and the angular column each divide by length units. The sums are in f64: with
    /// long arms, f32 would round the inverse masses away.
    pub(super) fn inverse_effective_mass(&self) -> [[f64x4; 3]; 2] {
        let linear = to_f64(self.inverse_masses[0]) + to_f64(self.inverse_masses[1]);
        let [ia, ib] = self.inverse_inertias.map(to_f64);
        let [[na, ta], [nb, tb]] = self.angular_jacobian.map(|of_side| of_side.map(to_f64));
        [
            [linear + (ia * na * na + ib * nb * nb), ia + ib, linear + (ia * ta * ta + ib * tb * tb)],
            [ia * na + ib * nb, ia * na * ta + ib * nb * tb, ia * ta + ib * tb],
        ]
    }

    /// Returns the vector from anchor A to anchor B in world coordinates, length units.
    #[inline(always)]
    fn anchor_offset(&self) -> [JointLanes; 2] {
        std::array::from_fn(|i| self.origin_offset[i] + self.arms[1][i] - self.arms[0][i])
    }

    /// Returns the positions of B's anchor relative to A's along n and t, and that along the axis of prismatic joints, all in
    /// length units.
    ///
    /// For pin and slider joints, the position along n is the distance of the anchors.
    pub(super) fn positions(&self) -> ([JointLanes; 2], JointLanes) {
        let ([x, y], [nx, ny]) = (self.anchor_offset(), self.normal);
        ([x * nx + y * ny, x * ny - y * nx], x * self.axis[0] + y * self.axis[1])
    }

    /// Computes the normals and Jacobians of the present poses.
    pub(super) fn update_jacobian(&mut self) {
        let [x, y] = self.anchor_offset();
        self.normal = match self.direction {
            RowDirection::Fixed => [f32x4::splat(1.0), ZERO],
            RowDirection::AcrossAxis | RowDirection::AcrossWheelAxis => [ZERO - self.axis[1], self.axis[0]],
            RowDirection::BetweenAnchors => {
                let distance = (x * x + y * y).sqrt();
                let is_apart = distance.simd_gt(ZERO);
                [select(is_apart, x / distance, f32x4::splat(1.0)), (y / distance) & is_apart]
            }
        };
        let ([nx, ny], [[ax, ay], [bx, by]]) = (self.normal, self.arms);
        // The constraint impulse of a prismatic or wheel joint acts on both bodies at anchor B.
        let [ax, ay] = if self.direction.is_across_axis() { [ax + x, ay + y] } else { [ax, ay] };
        let angular = |x: JointLanes, y: JointLanes| [x * ny - y * nx, ZERO - (x * nx + y * ny)];
        self.angular_jacobian = [angular(ax, ay), angular(bx, by)];
    }

    /// Updates poses and Jacobians after the bodies have moved in a substep, and corrects the next warm start.
    ///
    /// `impulses` are the accumulated impulses of the rows. They act again at the start of the next substep, with the arms and
    /// normals after the motion. With the arms and normals before it, the impulses would add energy to bodies that rotate.
    pub(super) fn advance_poses(&mut self, bodies: &mut BodySet, impulses: RowLanes) {
        let before = self.velocity_changes(impulses);
        let of_side = |side: usize| lanes_of(&self.bodies[side], |body| bodies.states[body].displacement);
        let (a, b) = (of_side(0), of_side(1));
        for (arm, turn) in self.arms.iter_mut().zip([a[2], b[2]]) {
            *arm = rotated(*arm, sin_cos_of_rotations(turn));
        }
        if self.direction.is_across_axis() {
            self.axis = rotated(self.axis, sin_cos_of_rotations(a[2]));
        }
        (0..2).for_each(|i| self.origin_offset[i] += b[i] - a[i]);
        self.relative_rotation += b[2] - a[2];
        self.update_jacobian();
        let after = self.velocity_changes(impulses);
        let changes = [0, 1].map(|side| std::array::from_fn(|i| before[side][i] - after[side][i]));
        self.add_changes(&mut bodies.warm_started_velocity, changes);
    }
}

/// Returns the components of one vector per body in lanes; `of` returns the vector of a body by its index.
#[inline(always)]
fn lanes_of(bodies: &[BodyIndex; 4], of: impl Fn(BodyIndex) -> [f32; 4]) -> VelocityLanes {
    let row = |lane: usize| f32x4::new(of(bodies[lane]));
    f32x4::transpose([row(0), row(1), row(2), row(3)])
}

/// Returns sine and cosine of angles in radians.
#[inline(always)]
fn sin_cos_of_rotations(angles: JointLanes) -> (JointLanes, JointLanes) {
    let are_small = (angles * angles).simd_lt(f32x4::splat(10.0));
    if are_small.all() { sin_cos(angles) } else { sin_cos_of_large_rotations(angles) }
}

/// Returns sine and cosine of angles of any size in radians, computed one lane at a time.
#[cold]
fn sin_cos_of_large_rotations(angles: JointLanes) -> (JointLanes, JointLanes) {
    let of_each = angles.to_array().map(sin_cos_of_any);
    (f32x4::new(of_each.map(|(sine, _)| sine)), f32x4::new(of_each.map(|(_, cosine)| cosine)))
}

/// Returns vectors rotated by angles, which are given by sine and cosine.
#[inline(always)]
fn rotated([x, y]: [JointLanes; 2], (sine, cosine): (JointLanes, JointLanes)) -> [JointLanes; 2] {
    [cosine * x - sine * y, sine * x + cosine * y]
}
