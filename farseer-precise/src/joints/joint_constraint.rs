//! A joint as a constraint of one step: locked degrees of freedom, anchors at the poses of the step, limits, motor and force.
//!
//! The adapter fills the constraints from the joints of the simulator. The solvers of
//! this folder and the direct solver read them and write their forces.

use super::super::bodies::{BodySet, signed_angle};
use super::super::direct_solver::joint::ANGLE;
use super::indices::{CandidateIndex, JointIndex};
use super::locked_dofs::LockedDofs;
use super::vec2::{Vec2, add_scaled, cross, dot, rotate};
use crate::index::{BodyIndex, DenseIndex, IndexedVec};

/// The active joints of a simulator, as constraints of a step.
pub type JointList = IndexedVec<JointIndex, JointConstraint>;

/// One side of a joint: a body or the world, with the anchor on it.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct JointAnchor {
    /// Index of the dynamic body into the arrays of `BodySet`; 0 for the world and for static, kinematic and sleeping bodies.
    pub body: BodyIndex,
    /// Index of the body whose pose the anchor follows, whatever its body type; 0 for the world and for bodies that are not in
    /// the simulation.
    pub pose_body: BodyIndex,
    /// Anchor in local coordinates of the body, relative to its centre of mass. Unit: length units.
    pub local_anchor: Vec2,
    /// Position of the body's centre of mass in the world; 0 for the world. Unit: length units.
    pub position: Vec2,
    /// Velocity of a body that is not dynamic: x and y in length units/s, angular in radians/s; 0 for dynamic bodies.
    pub velocity: [f64; 3],
    /// Arm: vector from the centre of mass to the anchor, in world coordinates; for the world the position of the anchor. Unit:
    /// length units.
    pub arm: Vec2,
}

impl JointAnchor {
    /// Sets `position`, `arm` and `velocity` to the present ones of the body; the world stays as it is. Returns whether one of
    /// them has changed.
    #[inline(always)]
    pub fn update(&mut self, bodies: &BodySet) -> bool {
        if self.pose_body == BodyIndex::PLACEHOLDER {
            return false;
        }
        let before = (self.position, self.arm, self.velocity);
        let [x, y, c, s] = bodies.poses[self.pose_body].map(f64::from);
        self.position = [x, y];
        self.arm = [
            c * self.local_anchor[0] - s * self.local_anchor[1],
            s * self.local_anchor[0] + c * self.local_anchor[1],
        ];
        if self.body == BodyIndex::PLACEHOLDER
            && let Some(state) = bodies.states.get(self.pose_body.position())
        {
            let [x, y, spin, _] = state.velocity.map(f64::from);
            self.velocity = [x, y, spin];
        }
        before != (self.position, self.arm, self.velocity)
    }

    /// Returns the position of the anchor in the world. Unit: length units.
    pub fn anchor_position(&self) -> Vec2 {
        add_scaled(self.position, self.arm, 1.0)
    }
}

/// Motor of a joint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Motor {
    /// Target speed: length units/s in linear motors, radians/s in rotary ones.
    pub speed: f32,
    /// Greatest force (mass units * length units/s^2) or torque (mass units * length units^2/s^2), >= 0.
    pub greatest_effort: f32,
}

/// Limits of the degree of freedom that a joint leaves free.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    /// Least position: length units along a line, radians about a point.
    pub lower: f32,
    /// Greatest position: length units along a line, radians about a point.
    pub upper: f32,
}

/// Motor and limits of the degree of freedom that a joint leaves free.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct JointDrive {
    /// The motor; `None` if the joint has none.
    pub motor: Option<Motor>,
    /// The limits; `None` if the joint has none.
    pub limits: Option<Limits>,
    /// Angle of the second body minus that of the first that counts as position 0, in radians.
    pub reference: f32,
}

/// An edge of the joint graph, of which the spanning forest is built.
#[derive(Debug, Clone, Copy)]
pub(super) struct JointEdge {
    /// Indices of both bodies; 0 for the world and for bodies that are not dynamic.
    pub(super) bodies: [BodyIndex; 2],
    /// Whether the joint is bounded: it has a range of positions or a greatest impulse, or is no edge of a tree by its kind or as
    /// the lock of a body's axes.
    pub(super) is_bounded: bool,
}

/// A joint or spring with the properties by which the direct solver decides whether to solve it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct JointCandidate {
    /// The joint or the spring.
    pub(crate) index: CandidateIndex,
    /// Indices of both bodies; 0 for the world and for bodies that are not dynamic.
    pub(crate) bodies: [BodyIndex; 2],
    /// Whether the articulation of the joint is free, so that the articulated-body algorithm can solve it.
    pub(crate) is_free_articulation: bool,
    /// Whether the direct solver can represent the joint by rows.
    pub(crate) has_rows: bool,
    /// Absolute position error of the joint when the step begins. Unit: length units for linear errors, radians for angles.
    pub(crate) error: f32,
}

impl JointCandidate {
    /// Returns the indices of both bodies if both are dynamic.
    pub(crate) fn dynamic_pair(&self) -> Option<[BodyIndex; 2]> {
        (!self.bodies.contains(&BodyIndex::PLACEHOLDER)).then_some(self.bodies)
    }

    /// Returns the index of the first dynamic body of the joint; `None` if neither body is dynamic.
    pub(crate) fn first_dynamic_body(&self) -> Option<BodyIndex> {
        self.bodies.into_iter().find(|&body| body != BodyIndex::PLACEHOLDER)
    }
}

/// A joint as a constraint in one step. Fields that every step reads and writes come first, so that long chains need few cache
/// lines.
#[derive(Debug, Clone, Copy)]
#[repr(C)]
pub struct JointConstraint {
    /// Force on the second body along x and y (mass units * length units/s^2), and torque (mass units * length units^2/s^2).
    pub force: [f64; 3],
    /// Force on the second body along the depth axis for joints of groups in three axes; else 0. Unit: mass units * length
    /// units/s^2.
    pub force_along_depth: f32,
    /// Mean force on the second body over the update along x and y (mass units * length units/s^2), and mean torque (mass
    /// units * length units^2/s^2). `None` if `force` itself is the mean, not the force of the last substep.
    pub mean_force: Option<[f64; 3]>,
    /// Position error of the joint when the step begins. Unit: length units; radians for a joint that locks an angle alone.
    pub error: f32,
    /// Vector from the first body's centre of mass to the anchor when the step begins, in world coordinates, for the public
    /// API. Unit: length units.
    pub first_arm: Vec2,
    /// Degrees of freedom that the joint locks between both bodies.
    pub locked: LockedDofs,
    /// Both sides of the joint: first body, second body.
    pub anchors: [JointAnchor; 2],
    /// Angle of the second body minus that of the first times `ratio`, in radians. Updated only if the joint locks or drives an
    /// angle.
    pub angle: f64,
    /// Axis of a prismatic joint in local coordinates of the first body, a unit vector. Unused in other joints.
    pub local_axis: Vec2,
    /// Axis of a prismatic joint in world coordinates, a unit vector. Unused in other joints.
    pub axis: Vec2,
    /// Motor and limits of the degree of freedom that the joint leaves free; `None` if the joint has neither.
    pub drive: Option<JointDrive>,
    /// Least and greatest allowed value of the joint's angle (radians) or distance (length units). Both are equal if the joint
    /// locks the angle or distance.
    pub range: [f64; 2],
    /// Violation of the range that is not corrected, >= 0. Unit: length units for a distance, radians for an angle.
    pub slop: f64,
    /// Greatest impulse of a substep, >= 0. Unit: mass units * length units/s; mass units * length units^2/s for a joint that
    /// locks an angle.
    pub max_impulse: f64,
    /// Compliance: velocity per impulse of an update, 0 for a rigid joint. Unit: 1/(mass units).
    pub softness: f64,
    /// Fraction of the position error that a compliant joint corrects per update, 0..=1.
    pub bias_factor: f64,
    /// Distance along the depth axis from the first body to the second, of a distance joint in three axes; else 0. Unit: length
    /// units.
    pub depth_offset: f64,
    /// Mean force on the second body over the update by the joint's servo along x and y (mass units * length units/s^2), and
    /// mean torque (mass units * length units^2/s^2). `force` does not contain it.
    pub servo_force: [f64; 3],
    /// Angle of the second body per angle of the first of a gear, or weight of the second rope of a pulley; 1 for other joints.
    pub ratio: f64,
    /// Points of the world over which the ropes of a pulley run; 0 for other joints. Unit: length units.
    pub pulleys: [Vec2; 2],
    /// Whether anchors, angle, axis or motor have changed from the last step to this one.
    pub has_moved: bool,
    /// Whether the joint is the lock of a body's axes. Such a joint has no effect along the depth axis.
    pub is_axis_lock: bool,
}

impl JointConstraint {
    /// Returns a rigid joint without a motor and without a force, whose allowed range is 0. `most` is the greatest impulse of a
    /// substep, in the unit of `max_impulse`.
    pub fn new(locked: LockedDofs, anchors: [JointAnchor; 2], most: f64) -> Self {
        JointConstraint {
            force: [0.0; 3],
            force_along_depth: 0.0,
            mean_force: None,
            error: 0.0,
            first_arm: [0.0; 2],
            locked,
            anchors,
            angle: 0.0,
            local_axis: [0.0; 2],
            axis: [0.0; 2],
            drive: None,
            range: [0.0; 2],
            slop: 0.0,
            max_impulse: most,
            softness: 0.0,
            bias_factor: 0.0,
            depth_offset: 0.0,
            servo_force: [0.0; 3],
            ratio: 1.0,
            pulleys: [[0.0; 2]; 2],
            has_moved: true,
            is_axis_lock: false,
        }
    }

    /// Sets anchors, angle, axis, motor and position error to those at the start of a step. `read` sets angle, axis and motor.
    pub(super) fn update(&mut self, bodies: &BodySet, read: impl FnOnce(&mut Self)) {
        let before = (self.angle, self.axis, self.drive);
        let [first, second] = self.anchors.each_mut().map(|anchor| anchor.update(bodies));
        read(self);
        self.has_moved = first || second || before != (self.angle, self.axis, self.drive);
        self.servo_force = [0.0; 3];
        self.error = self.compute_error() as f32;
        self.first_arm = self.anchors[0].arm;
    }

    /// Turns the axis of a prismatic joint with its first body, whose rotation is `rotation` radians.
    pub fn set_axis(&mut self, rotation: f32) {
        let (sine, cosine) = libm::sincos(signed_angle(rotation));
        self.axis = rotate([cosine, sine], self.local_axis);
    }

    /// Moves both anchors to the centres of mass of their bodies.
    pub fn clear_arms(&mut self) {
        for anchor in &mut self.anchors {
            (anchor.local_anchor, anchor.arm) = ([0.0; 2], [0.0; 2]);
        }
    }

    /// Returns whether the joint yields to a force.
    pub(super) fn is_compliant(&self) -> bool {
        self.softness > 0.0
    }

    /// Returns the joint as an edge of the joint graph.
    pub(super) fn edge(&self) -> JointEdge {
        let [low, high] = self.range;
        JointEdge {
            bodies: self.anchors.map(|anchor| anchor.body),
            is_bounded: low < high
                || self.max_impulse < f64::from(f32::MAX)
                || !self.locked.fits_tree()
                || self.is_axis_lock,
        }
    }

    /// Returns the properties by which the direct solver accepts or rejects islands: whether the joint is bounded, whether it has
    /// a motor or limits, and whether it has rows of the direct solver.
    pub fn solver_properties(&self) -> [bool; 3] {
        [self.edge().is_bounded, self.drive.is_some(), self.fits_direct_solver()]
    }

    /// Returns whether the joint limits a distance or angle to a range, instead of locking it.
    pub(super) fn has_limited_row(&self) -> bool {
        matches!(self.locked, LockedDofs::Distance | LockedDofs::Angle) && self.range[0] < self.range[1]
    }

    /// Returns whether anchors, angle, axis or motor have changed from the last step to this one.
    pub(crate) fn has_moved(&self) -> bool {
        self.has_moved
    }

    /// Returns whether the joint locks or drives an angle.
    pub fn has_angle(&self) -> bool {
        self.locked.locks(ANGLE) || self.drive.is_some()
    }

    /// Returns the position error of the joint: length units; radians for a joint that locks an angle alone.
    pub fn compute_error(&self) -> f64 {
        let offset = add_scaled(self.anchors[1].anchor_position(), self.anchors[0].anchor_position(), -1.0);
        let distance = dot(offset, offset).sqrt();
        match self.locked {
            LockedDofs::Distance => {
                self.range_error((dot(offset, offset) + self.depth_offset * self.depth_offset).sqrt())
            }
            LockedDofs::Angle => self.range_error(self.angle),
            LockedDofs::Line | LockedDofs::PointOnLine => cross(self.axis, offset).abs(),
            LockedDofs::Unlocked => 0.0,
            LockedDofs::Gear => self.coupling_row().1,
            LockedDofs::Pulley => self.coupling_row().1.max(0.0),
            _ => distance,
        }
    }

    /// Returns the violation of `range` by `value`, signed: negative below the range, 0 inside of the range or within `slop` of
    /// it. Unit: length units for a distance, radians for an angle.
    pub(super) fn range_error(&self, value: f64) -> f64 {
        let [low, high] = self.range;
        let slop = if low < high { self.slop } else { 0.0 };
        if value > high {
            if value < high + slop { 0.0 } else { value - high }
        } else if value < low && value <= low - slop {
            value - low
        } else {
            0.0
        }
    }
}
