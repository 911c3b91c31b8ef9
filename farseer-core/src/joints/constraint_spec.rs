//! Specification of a joint as a constraint, independent of its kind, for solvers other than the joint's own methods.

use serde::{Deserialize, Serialize};

use super::{Joint, JointKind, MotorAndLimits, PoseServo};
use crate::body::BodyId;
use crate::math::Vector2;

/// The part of the second body's motion relative to the first that a joint constrains.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) enum ConstraintSpecKind {
    /// A point.
    Point,
    /// A point and the relative angle.
    PointAndAngle,
    /// The relative angle, as a difference of total rotations.
    Angle,
    /// The distance of two anchors.
    Distance,
    /// Two directions: across a line, and the relative angle.
    Line,
    /// The direction across a line.
    PointOnLine,
    /// No part: servos alone act.
    Nothing,
    /// The angle, as a multiple of that of the first body.
    Gear,
    /// The length of a rope over two pulleys.
    Pulley,
}

/// A joint as a constraint.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) struct ConstraintSpec {
    pub(crate) keeps: ConstraintSpecKind,
    /// The bodies; the first is `None` for the world.
    pub(crate) bodies: (Option<BodyId>, BodyId),
    /// The anchors, in the coordinates of the bodies.
    pub(crate) anchors: [Vector2; 2],
    /// Allowed range of the angle in radians or of the distance in length units; both ends are equal for a fixed value.
    pub(crate) range: [f32; 2],
    /// Violation of the range up to which there is no correction, in radians or length units.
    pub(crate) slop: f32,
    /// Maximum impulse in a substep; for a point with an angle it limits the angular impulse alone.
    pub(crate) most: f32,
    /// Direction of the line, a unit vector in the coordinates of the first body.
    pub(crate) axis: Vector2,
    /// Motor, limits and servo of the free motion.
    pub(crate) drive: Option<MotorAndLimits>,
    /// Ratio of a gear or pulley; 1 for other kinds.
    pub(crate) ratio: f32,
    /// World positions of the pulleys of a pulley joint, in length units.
    pub(crate) pulleys: [Vector2; 2],
    /// Strength of a motor joint; `None` for other kinds. Its pose is in `anchors` and `range`.
    pub(crate) pose_servo: Option<PoseServo>,
}

impl ConstraintSpec {
    fn point(bodies: (Option<BodyId>, BodyId), anchors: [Vector2; 2]) -> Self {
        ConstraintSpec {
            keeps: ConstraintSpecKind::Point,
            bodies,
            anchors,
            range: [0.0; 2],
            slop: 0.0,
            most: f32::MAX,
            axis: Vector2::zeros(),
            drive: None,
            ratio: 1.0,
            pulleys: [Vector2::zeros(); 2],
            pose_servo: None,
        }
    }

    fn angle(bodies: (Option<BodyId>, BodyId), range: [f32; 2]) -> Self {
        ConstraintSpec {
            keeps: ConstraintSpecKind::Angle,
            range,
            ..ConstraintSpec::point(bodies, [Vector2::zeros(); 2])
        }
    }
}

impl Joint {
    /// The joint as a constraint.
    pub(crate) fn constraint_spec(&self) -> ConstraintSpec {
        let two = |body2: BodyId| (Some(self.body1()), body2);
        let drive = self.motor_and_limits().copied().filter(|drive| !drive.is_empty());
        match self.kind() {
            JointKind::Angle(joint) => ConstraintSpec {
                most: joint.max_impulse(),
                ..ConstraintSpec::angle(two(joint.body2()), [joint.target_angle(); 2])
            },
            JointKind::AngleLimit(joint) => ConstraintSpec {
                slop: joint.slop(),
                ..ConstraintSpec::angle(two(joint.body2()), [joint.lower_limit(), joint.upper_limit()])
            },
            JointKind::FixedAngle(joint) => ConstraintSpec {
                most: joint.max_impulse(),
                ..ConstraintSpec::angle((None, joint.body()), [joint.target_angle(); 2])
            },
            JointKind::FixedAngleLimit(joint) => ConstraintSpec {
                slop: joint.slop(),
                ..ConstraintSpec::angle((None, joint.body()), [joint.lower_limit(), joint.upper_limit()])
            },
            JointKind::FixedRevolute(joint) => ConstraintSpec {
                most: joint.max_impulse(),
                drive,
                ..ConstraintSpec::point((None, joint.body()), [joint.anchor(), joint.local_anchor])
            },
            JointKind::Pin(joint) => ConstraintSpec {
                keeps: ConstraintSpecKind::Distance,
                range: [joint.target_distance(); 2],
                ..ConstraintSpec::point(two(joint.body2()), [joint.anchor1(), joint.anchor2()])
            },
            JointKind::Prismatic(joint) => ConstraintSpec {
                keeps: ConstraintSpecKind::Line,
                range: [joint.target_angle; 2],
                axis: joint.axis(),
                drive,
                ..ConstraintSpec::point(two(joint.body2()), joint.point.local_anchors())
            },
            JointKind::Wheel(joint) => ConstraintSpec {
                keeps: ConstraintSpecKind::PointOnLine,
                axis: joint.axis(),
                drive,
                ..ConstraintSpec::point(two(joint.body2()), joint.point.local_anchors())
            },
            JointKind::AngleSpring(joint) => ConstraintSpec {
                keeps: ConstraintSpecKind::Nothing,
                drive,
                ..ConstraintSpec::point(two(joint.body2()), [Vector2::zeros(); 2])
            },
            JointKind::Motor(joint) => ConstraintSpec {
                keeps: ConstraintSpecKind::Nothing,
                range: [joint.angle(); 2],
                // The angle of the bodies is read for joints with a drive.
                drive: Some(MotorAndLimits::default()),
                pose_servo: Some(joint.servo()),
                ..ConstraintSpec::point(two(joint.body2()), [joint.offset(), Vector2::zeros()])
            },
            JointKind::Gear(joint) => ConstraintSpec {
                keeps: ConstraintSpecKind::Gear,
                ratio: joint.ratio(),
                ..ConstraintSpec::angle(two(joint.body2()), [joint.reference; 2])
            },
            JointKind::Pulley(joint) => ConstraintSpec {
                keeps: ConstraintSpecKind::Pulley,
                range: [joint.length(); 2],
                ratio: joint.ratio(),
                pulleys: joint.pulleys(),
                ..ConstraintSpec::point(two(joint.body2()), joint.anchors())
            },
            JointKind::Revolute(joint) => ConstraintSpec {
                drive,
                ..ConstraintSpec::point(two(joint.body2()), joint.point.local_anchors())
            },
            JointKind::Slider(joint) => ConstraintSpec {
                keeps: ConstraintSpecKind::Distance,
                range: [joint.min(), joint.max()],
                slop: joint.slop(),
                ..ConstraintSpec::point(two(joint.body2()), [joint.anchor1(), joint.anchor2()])
            },
            JointKind::Weld(joint) => ConstraintSpec {
                keeps: ConstraintSpecKind::PointAndAngle,
                range: [joint.target_angle; 2],
                most: joint.max_impulse(),
                ..ConstraintSpec::point(two(joint.body2()), joint.point.local_anchors())
            },
        }
    }

    /// Stores anchors for the queries of users: the arm of the first anchor from its body, and for joints that keep a
    /// distance arms and world positions of both.
    #[inline]
    pub(crate) fn store_world_anchors(&mut self, arm: [f32; 2], both: impl FnOnce() -> [[Vector2; 2]; 2]) {
        match self.kind_mut() {
            JointKind::Revolute(joint) => joint.point.set_arm(arm),
            JointKind::Prismatic(joint) => joint.point.set_arm(arm),
            JointKind::Weld(joint) => joint.point.set_arm(arm),
            JointKind::Wheel(joint) => joint.point.set_arm(arm),
            JointKind::Pin(joint) => joint.anchors.set_world_anchors(both()),
            JointKind::Slider(joint) => joint.anchors.set_world_anchors(both()),
            _ => {}
        }
    }

    /// Stores the error that an update has found, in radians or length units.
    pub(crate) fn set_error(&mut self, error: f32) {
        self.joint_error = error;
    }
}
