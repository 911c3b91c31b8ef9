//! A joint in three axes with its present pose: anchors, distance, and the values that its rows constrain.
//!
//! Velocities have four components: x, y, angular about z, and z, along the depth axis.

use super::super::indices::JointIndex;
use super::super::joint_constraint::JointConstraint;
use super::super::locked_dofs::LockedDofs;
use super::super::rotation::cos_sin;
use super::super::vec2::{Vec2, dot, perp, rotate};
use super::row_kind::RowKind;
use crate::index::{IndexedSlice, index_type};

index_type! {
    /// Index of a node of a group: of a body, or of a side of a joint that is the world, static or kinematic.
    pub(super) struct NodeIndex;
}
index_type! {
    /// Index of a joint in the list of its group.
    pub(super) struct StateIndex;
}

/// The joints of a group.
pub(super) type States<'a> = IndexedSlice<'a, StateIndex, JointState>;

/// Velocities or inverse masses of the nodes of a group.
pub(super) type Nodes<'a> = IndexedSlice<'a, NodeIndex, Velocity4>;

/// Velocity, change of momentum, or row of a Jacobian, of one body: x, y, angular about z, z.
pub(super) type Velocity4 = [f64; 4];

/// One side of a joint: a body or the world, with pose and velocity.
#[derive(Debug, Clone, Copy)]
pub(super) struct JointSide {
    /// Index into the group's velocities and inverse masses. The dynamic bodies come first; each side that is the world, static
    /// or kinematic has an entry of its own behind them.
    pub(super) node: NodeIndex,
    /// Position of the body's centre of mass in the world: x, y and z, length units.
    pub(super) origin: [f64; 3],
    /// Arm: vector from the centre of mass to the anchor in world coordinates, length units. It has no z component.
    pub(super) arm: Vec2,
    /// Rotation of the body since the start of the step, radians.
    pub(super) rotation: f64,
}

/// Pose of one side of a joint: the present pose, or the predicted pose at the end of a substep.
#[derive(Debug, Clone, Copy)]
pub(super) struct PosedAnchor {
    /// Position of the anchor in the world, x, y and z, length units.
    point: [f64; 3],
    /// Arm: vector from the centre of mass to the anchor in world coordinates, length units.
    pub(super) arm: Vec2,
    /// Rotation of the body since the start of the step, radians.
    rotation: f64,
    /// Rotation from the present pose to this one, as [cosine, sine], dimensionless.
    rotation_in_h: Vec2,
}

impl JointSide {
    /// Returns the velocity of the body on this side of the joint: x, y and z in length units/s, angular in radians/s.
    /// `velocities` are those of the group.
    #[inline(always)]
    pub(super) fn velocity(&self, velocities: Nodes<'_>) -> Velocity4 {
        velocities[self.node]
    }

    /// Returns the inverse mass of the body on this side of the joint, 1/(mass units); 0 for static and kinematic bodies.
    /// `inverses` are those of the group.
    pub(super) fn inverse_mass(&self, inverses: Nodes<'_>) -> f64 {
        inverses[self.node][0]
    }

    /// Returns the pose of this side of the joint after `h` seconds with the given velocity (x, y, angular, z).
    fn predicted_anchor(&self, [x, y, spin, z]: Velocity4, h: f64) -> PosedAnchor {
        let turn = cos_sin(spin * h);
        let arm = rotate(turn, self.arm);
        let [px, py, pz] = self.origin;
        PosedAnchor {
            point: [px + x * h + arm[0], py + y * h + arm[1], pz + z * h],
            arm,
            rotation: self.rotation + spin * h,
            rotation_in_h: turn,
        }
    }

    /// Moves this side of the joint for `h` seconds with the given velocity (x, y, angular, z).
    #[inline(always)]
    pub(super) fn advance(&mut self, [x, y, spin, z]: Velocity4, h: f64) {
        let [px, py, pz] = self.origin;
        (self.origin, self.rotation) = ([px + x * h, py + y * h, pz + z * h], self.rotation + spin * h);
        if self.arm != [0.0; 2] {
            self.arm = rotate(cos_sin(spin * h), self.arm);
        }
    }
}

/// A joint of a group in three axes, with its present pose.
#[derive(Debug, Clone, Copy)]
pub(super) struct JointState {
    /// Index of the joint into the list of all joints.
    pub(super) joint: JointIndex,
    pub(super) link: LockedDofs,
    pub(super) sides: [JointSide; 2],
    /// Vector from anchor A to anchor B in the world at the present poses: x, y and z, length units.
    offset: [f64; 3],
    /// Length of `offset`, length units, >= 0.
    pub(super) distance: f64,
    /// Unit vector from anchor A to anchor B in the world, dimensionless. Coincident anchors keep the last direction.
    pub(super) direction: [f64; 3],
    /// Axis of a prismatic joint in world coordinates, a unit vector. Unused in other joints.
    pub(super) axis: Vec2,
    /// Sum of the impulses on body B since the step began: x, y and z in mass units * length units/s, angular in mass units *
    /// length units^2/s.
    pub(super) total_impulse: Velocity4,
    /// Whether both anchors are the centres of mass of their bodies. Such joints have shorter formulas.
    pub(super) anchors_at_origins: bool,
}

impl JointState {
    /// Returns the state of the joint with the index `joint` into the list of all joints, at poses that are not known yet.
    pub(super) fn new(joint: JointIndex, link: LockedDofs, nodes: [NodeIndex; 2]) -> Self {
        JointState {
            joint,
            link,
            sides: nodes.map(|node| JointSide { node, origin: [0.0; 3], arm: [0.0; 2], rotation: 0.0 }),
            offset: [0.0; 3],
            distance: 0.0,
            direction: [1.0, 0.0, 0.0],
            axis: [1.0, 0.0],
            total_impulse: [0.0; 4],
            anchors_at_origins: false,
        }
    }

    /// Returns the vector from the centre of mass of A to that of B in the world: x, y and z, length units.
    fn origin_offset(&self) -> [f64; 3] {
        let [a, b] = self.sides.each_ref().map(|side| side.origin);
        [b[0] - a[0], b[1] - a[1], b[2] - a[2]]
    }

    /// Returns the distance of the anchors after `h` seconds with these velocities, length units. The anchors must be the
    /// centres of mass.
    #[inline(always)]
    pub(super) fn predicted_origin_distance(&self, velocities: Nodes<'_>, h: f64) -> f64 {
        let [a, b] = self.sides.each_ref().map(|side| side.velocity(velocities));
        let [x, y, z] = self.offset;
        norm([x + h * (b[0] - a[0]), y + h * (b[1] - a[1]), z + h * (b[3] - a[3])])
    }

    /// Returns the poses of both sides of the joint after `h` seconds with the velocities of the group's bodies.
    pub(super) fn predicted_anchors(&self, velocities: Nodes<'_>, h: f64) -> [PosedAnchor; 2] {
        self.sides.each_ref().map(|side| side.predicted_anchor(side.velocity(velocities), h))
    }

    /// Returns the present poses of both sides of the joint.
    pub(super) fn anchors(&self) -> [PosedAnchor; 2] {
        self.sides.each_ref().map(|side| side.predicted_anchor([0.0; 4], 0.0))
    }

    /// Computes `offset`, `distance` and `direction` at the present poses.
    #[inline(always)]
    pub(super) fn update_offset(&mut self) {
        self.offset =
            if self.anchors_at_origins { self.origin_offset() } else { anchor_offset(&self.anchors()) };
        self.distance = norm(self.offset);
        if self.distance > 0.0 {
            self.direction = self.offset.map(|component| component / self.distance);
        }
    }

    /// Moves the joint for `h` seconds with the velocities of the group's bodies.
    #[inline(always)]
    pub(super) fn advance(&mut self, velocities: Nodes<'_>, h: f64) {
        if self.link.has_axis() {
            let [_, _, spin, _] = self.sides[0].velocity(velocities);
            self.axis = rotate(cos_sin(spin * h), self.axis);
        }
        for side in &mut self.sides {
            side.advance(side.velocity(velocities), h);
        }
        self.update_offset();
    }

    /// Returns the value of a row at the poses `anchors`: radians for angles, else length units. The value of motor and depth
    /// velocity rows is 0.
    pub(super) fn value(&self, kind: RowKind, anchors: &[PosedAnchor; 2], joint: &JointConstraint) -> f64 {
        let [x, y, _] = anchor_offset(anchors);
        let line = || rotate(anchors[0].rotation_in_h, self.axis);
        match kind {
            RowKind::AnchorAxis(0) => x,
            RowKind::AnchorAxis(_) => y,
            RowKind::Distance => norm(anchor_offset(anchors)),
            RowKind::LineOffset => dot(perp(line()), [x, y]),
            RowKind::Limits(_) if self.link == LockedDofs::Line => dot(line(), [x, y]),
            RowKind::Limits(_) => {
                self.angle(anchors, joint) - joint.drive.map_or(0.0, |drive| f64::from(drive.reference))
            }
            RowKind::Angle => self.angle(anchors, joint),
            RowKind::DepthVelocity | RowKind::Motor(_) => 0.0,
        }
    }

    /// Returns the angle of B relative to A at the poses `anchors`, radians.
    fn angle(&self, anchors: &[PosedAnchor; 2], joint: &JointConstraint) -> f64 {
        joint.angle + anchors[1].rotation - anchors[0].rotation
    }
}

/// Returns the vector from anchor A to anchor B in the world: x, y and z, length units.
pub(super) fn anchor_offset([a, b]: &[PosedAnchor; 2]) -> [f64; 3] {
    [b.point[0] - a.point[0], b.point[1] - a.point[1], b.point[2] - a.point[2]]
}

/// Returns the length of the vector, in the unit of its components.
#[inline(always)]
fn norm([x, y, z]: [f64; 3]) -> f64 {
    (x * x + y * y + z * z).sqrt()
}
