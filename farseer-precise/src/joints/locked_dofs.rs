//! Kinds of joints: the degrees of freedom that they lock.

/// Degrees of freedom that a joint locks between a body and its parent in the tree, or how the root of a tree is held.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum LockedDofs {
    /// Locks nothing: the body is the root of a free tree.
    #[default]
    Free,
    /// Locks all motion of a root: the world, or a static, kinematic or sleeping body. The velocity of the root is given.
    Fixed,
    /// Locks the relative translation of two anchors: a revolute joint.
    Point,
    /// Locks the relative translation of two anchors and the relative angle: a weld joint.
    Weld,
    /// Locks the relative angle of the bodies alone: an angle joint.
    Angle,
    /// Locks the distance between two anchors: a pin or slider joint.
    Distance,
    /// Locks the translation across a line fixed to the first body, and the relative angle: a prismatic joint.
    Line,
    /// Locks the translation across a line fixed to the first body alone: a wheel joint.
    PointOnLine,
    /// Locks no degree of freedom: a joint whose servos, motor or limits alone act.
    Unlocked,
    /// Locks the angle of the second body to a multiple of that of the first: a gear.
    Gear,
    /// Keeps the sum of two lengths of rope from growing: a pulley.
    Pulley,
}

impl LockedDofs {
    /// Returns whether the linear rows of the joint follow an axis that turns with the first body.
    pub fn has_axis(self) -> bool {
        matches!(self, LockedDofs::Line | LockedDofs::PointOnLine)
    }

    /// Returns whether the joint can be an edge of a tree, which the articulated-body algorithm solves.
    pub(super) fn fits_tree(self) -> bool {
        !matches!(self, LockedDofs::PointOnLine | LockedDofs::Unlocked) && !self.is_coupling()
    }

    /// Returns whether the joint is a gear or pulley, a row of its own in the iterative solver.
    pub(super) fn is_coupling(self) -> bool {
        matches!(self, LockedDofs::Gear | LockedDofs::Pulley)
    }

    /// Returns whether this is a joint with a parent, not the state of a root.
    pub(super) fn is_joint(self) -> bool {
        !matches!(self, LockedDofs::Free | LockedDofs::Fixed)
    }
}
