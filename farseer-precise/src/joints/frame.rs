//! Relative pose of the two bodies of a joint, the rows that each kind of joint locks, and their Jacobian at this pose.
//!
//! The direct solver and the soft rows of the iterative solver read from here the Jacobian, the position errors, and the
//! coordinate that motor and limits act on.

use super::super::direct_solver::constraint::{Jacobian, RowMask};
use super::super::direct_solver::joint::{ACROSS, ALONG, ANGLE};
use super::super::direct_solver::mat3::Vec3;
use super::joint_constraint::{JointAnchor, JointConstraint};
use super::locked_dofs::LockedDofs;
use super::rotation::cos_sin;
use super::vec2::{Vec2, add_scaled, dot, rotate};

/// Relative pose of the two bodies of a joint, or of a spring, in world coordinates.
#[derive(Debug, Clone, Copy)]
pub(super) struct JointFrame {
    /// Degrees of freedom that the joint locks between both bodies.
    pub(super) locked: LockedDofs,
    /// Arms: vectors from the centre of mass of each body to its anchor, in world coordinates. Unit: length units.
    pub(super) arms: [Vec2; 2],
    /// Vector from the centre of mass of the first body to that of the second, in world coordinates. Unit: length units.
    pub(super) origin_offset: Vec2,
    /// Angle of the second body minus that of the first times `ratio`. Unit: radians.
    pub(super) angle: f64,
    /// Axis of a prismatic joint in world coordinates, a unit vector; 0 for other joints.
    pub(super) axis: Vec2,
    /// Ratio of a gear: angle of the second body per angle of the first; 1 for other joints.
    pub(super) ratio: f64,
}

impl LockedDofs {
    /// Returns the mask of the rows that a joint without a range locks: bit ALONG (normal), ANGLE or ACROSS (tangent). A range
    /// turns the row of a distance or angle into limits.
    pub(super) fn locked_rows(self) -> RowMask {
        match self {
            LockedDofs::Free | LockedDofs::Fixed | LockedDofs::Unlocked | LockedDofs::Pulley => 0,
            LockedDofs::Point => 1 << ALONG | 1 << ACROSS,
            LockedDofs::Weld => 1 << ALONG | 1 << ANGLE | 1 << ACROSS,
            LockedDofs::Angle | LockedDofs::Gear => 1 << ANGLE,
            LockedDofs::Distance => 1 << ALONG,
            LockedDofs::Line => 1 << ALONG | 1 << ANGLE,
            LockedDofs::PointOnLine => 1 << ALONG,
        }
    }

    /// Returns whether a joint locks `row`: ALONG (normal), ANGLE or ACROSS (tangent).
    pub(super) fn locks(self, row: usize) -> bool {
        self.locked_rows() >> row & 1 == 1
    }

    /// Returns the row that a servo of a joint acts on: ACROSS (along the axis) of a prismatic or wheel joint, else ANGLE.
    pub(super) fn servo_row(self) -> usize {
        if self.has_axis() { ACROSS } else { ANGLE }
    }

    /// Returns the row that motor and limits of a joint act on: ALONG (normal), ANGLE or ACROSS (tangent).
    pub(super) fn motor_row(self) -> usize {
        match self {
            LockedDofs::Distance => ALONG,
            LockedDofs::Line => ACROSS,
            _ => ANGLE,
        }
    }
}

impl JointFrame {
    /// Returns the relative pose of a joint's bodies when the step begins.
    pub(super) fn of(constraint: &JointConstraint) -> Self {
        JointFrame {
            axis: constraint.axis,
            ratio: constraint.ratio,
            ..JointFrame::between(constraint.locked, &constraint.anchors, constraint.angle)
        }
    }

    /// Returns the relative pose of the bodies of a joint without an axis. `angle` is the angle of the second body minus that
    /// of the first, in radians.
    pub(super) fn between(locked: LockedDofs, [first, second]: &[JointAnchor; 2], angle: f64) -> Self {
        let arms = [first.arm, second.arm];
        JointFrame {
            locked,
            arms,
            origin_offset: add_scaled(second.position, first.position, -1.0),
            angle,
            axis: [0.0; 2],
            ratio: 1.0,
        }
    }

    /// Returns the relative pose after the displacements `a` and `b` of the first and the second body: x and y in length units,
    /// angle in radians.
    pub(super) fn displaced(mut self, [a, b]: [Vec3; 2]) -> Self {
        let rotations = [cos_sin(a[2]), cos_sin(b[2])];
        self.arms = [rotate(rotations[0], self.arms[0]), rotate(rotations[1], self.arms[1])];
        self.origin_offset = [self.origin_offset[0] + b[0] - a[0], self.origin_offset[1] + b[1] - a[1]];
        self.angle += b[2] - self.ratio * a[2];
        self.axis = rotate(rotations[0], self.axis);
        self
    }

    /// Returns the vector from the first anchor to the second, in world coordinates. Unit: length units.
    pub(super) fn anchor_offset(&self) -> Vec2 {
        add_scaled(add_scaled(self.origin_offset, self.arms[1], 1.0), self.arms[0], -1.0)
    }

    /// Returns the distance between the anchors. Unit: length units, >= 0.
    pub(super) fn distance(&self) -> f64 {
        let offset = self.anchor_offset();
        dot(offset, offset).sqrt()
    }

    /// Returns the unit normal n of the linear rows in world coordinates: across the axis of a prismatic joint, along a
    /// distance joint, else (1, 0).
    pub(super) fn normal(&self) -> Vec2 {
        match self.locked {
            locked if locked.has_axis() => [-self.axis[1], self.axis[0]],
            LockedDofs::Distance => {
                let ([x, y], distance) = (self.anchor_offset(), self.distance());
                if distance > 0.0 { [x / distance, y / distance] } else { [1.0, 0.0] }
            }
            _ => [1.0, 0.0],
        }
    }

    /// Returns the Jacobian of the joint's rows: along the normal, angular, and along the tangent.
    pub(super) fn jacobian(&self) -> Jacobian {
        let (n, [mut a, b]) = (self.normal(), self.arms);
        if self.locked.has_axis() {
            // A prismatic or wheel joint acts on both bodies at the second anchor.
            a = add_scaled(a, self.anchor_offset(), 1.0);
        }
        let mut jacobian = Jacobian::of_joint(n, [a, b]);
        jacobian.angular_a[ANGLE] = self.ratio;
        jacobian
    }

    /// Returns the coordinate that motor and limits act on. Prismatic joints: position along the axis, in length units. Other
    /// joints: angle of the second body minus that of the first minus `reference`, in radians.
    pub(super) fn travel(&self, reference: f64) -> f64 {
        match self.locked {
            LockedDofs::Line => self.axis_offset(),
            _ => self.angle - reference,
        }
    }

    /// Returns the position of the second anchor relative to the first along the axis. Unit: length units.
    pub(super) fn axis_offset(&self) -> f64 {
        dot(self.anchor_offset(), self.axis)
    }
}
