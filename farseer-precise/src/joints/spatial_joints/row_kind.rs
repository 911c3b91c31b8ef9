//! Kinds of rows of joints in three axes.

use super::super::joint_constraint::{Limits, Motor};
use super::super::locked_dofs::LockedDofs;

/// Kind of a row: the quantity that the row constrains.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum RowKind {
    /// Constrains the offset between the anchors along x (0) or y (1), in length units.
    AnchorAxis(usize),
    /// Makes the velocities of both bodies along the depth axis equal. Unit: length units/s.
    DepthVelocity,
    /// Constrains the angle of body B relative to A, in radians.
    Angle,
    /// Constrains the distance of the anchors in three axes, in length units.
    Distance,
    /// Constrains the distance of anchor B from the axis of a prismatic joint, in length units.
    LineOffset,
    /// Drives the speed of the joint's coordinate: length units/s along the axis of a prismatic joint, else radians/s.
    Motor(Motor),
    /// Keeps the joint's coordinate between limits: length units along the axis of a prismatic joint, else radians.
    Limits(Limits),
}

impl RowKind {
    /// Returns whether the value of the row is an angle. `link` are the degrees of freedom that the joint locks.
    pub(super) fn is_angular(self, link: LockedDofs) -> bool {
        match self {
            RowKind::Angle => true,
            RowKind::Motor(_) | RowKind::Limits(_) => link != LockedDofs::Line,
            _ => false,
        }
    }
}
