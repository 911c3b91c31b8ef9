//! What a joint asks for, whatever its kind: as methods see it that solve joints in their own way.

use serde::{Deserialize, Serialize};

use super::{Drive, Joint, JointKind};
use crate::body::BodyId;
use crate::math::Vector2;

/// What a joint keeps of the second body's motion against the first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) enum Keeps {
    /// A point.
    Point,
    /// A point and the angle.
    PointAndAngle,
    /// The angle, by total rotations.
    Angle,
    /// The distance of two anchors.
    Distance,
    /// A line, and the angle.
    Line,
}

/// A joint's request.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) struct Held {
    pub(crate) keeps: Keeps,
    /// The first is `None` for the world.
    pub(crate) bodies: (Option<BodyId>, BodyId),
    /// In the coordinates of the bodies.
    pub(crate) anchors: [Vector2; 2],
    /// Where an angle or distance has to be: both are the same if nothing is left to choose.
    pub(crate) range: [f32; 2],
    /// Beyond the range by this much nothing is corrected.
    pub(crate) slop: f32,
    /// Greatest impulse of a substep, or of the angle alone where a point is kept too.
    pub(crate) most: f32,
    /// The line in the coordinates of the first body.
    pub(crate) axis: Vector2,
    /// What moves it along the way that is free.
    pub(crate) drive: Option<Drive>,
}

impl Held {
    fn point(bodies: (Option<BodyId>, BodyId), anchors: [Vector2; 2]) -> Self {
        Held {
            keeps: Keeps::Point,
            bodies,
            anchors,
            range: [0.0; 2],
            slop: 0.0,
            most: f32::MAX,
            axis: Vector2::zeros(),
            drive: None,
        }
    }

    fn angle(bodies: (Option<BodyId>, BodyId), range: [f32; 2]) -> Self {
        Held { keeps: Keeps::Angle, range, ..Held::point(bodies, [Vector2::zeros(); 2]) }
    }
}

impl Joint {
    /// What the joint asks for.
    pub(crate) fn held(&self) -> Held {
        let two = |body2: BodyId| (Some(self.body1()), body2);
        let drive = self.drive().copied().filter(|drive| !drive.is_idle());
        match self.kind() {
            JointKind::Angle(joint) => Held {
                most: joint.max_impulse(),
                ..Held::angle(two(joint.body2()), [joint.target_angle(); 2])
            },
            JointKind::AngleLimit(joint) => Held {
                slop: joint.slop(),
                ..Held::angle(two(joint.body2()), [joint.lower_limit(), joint.upper_limit()])
            },
            JointKind::FixedAngle(joint) => Held {
                most: joint.max_impulse(),
                ..Held::angle((None, joint.body()), [joint.target_angle(); 2])
            },
            JointKind::FixedAngleLimit(joint) => Held {
                slop: joint.slop(),
                ..Held::angle((None, joint.body()), [joint.lower_limit(), joint.upper_limit()])
            },
            JointKind::FixedRevolute(joint) => Held {
                most: joint.max_impulse(),
                drive,
                ..Held::point((None, joint.body()), [joint.anchor(), joint.local_anchor])
            },
            JointKind::Pin(joint) => Held {
                keeps: Keeps::Distance,
                range: [joint.target_distance(); 2],
                ..Held::point(two(joint.body2()), [joint.anchor1(), joint.anchor2()])
            },
            JointKind::Prismatic(joint) => Held {
                keeps: Keeps::Line,
                range: [joint.target_angle; 2],
                axis: joint.axis(),
                drive,
                ..Held::point(two(joint.body2()), joint.point.local_anchors())
            },
            JointKind::Revolute(joint) => {
                Held { drive, ..Held::point(two(joint.body2()), joint.point.local_anchors()) }
            }
            JointKind::Slider(joint) => Held {
                keeps: Keeps::Distance,
                range: [joint.min(), joint.max()],
                slop: joint.slop(),
                ..Held::point(two(joint.body2()), [joint.anchor1(), joint.anchor2()])
            },
            JointKind::Weld(joint) => Held {
                keeps: Keeps::PointAndAngle,
                range: [joint.target_angle; 2],
                most: joint.max_impulse(),
                ..Held::point(two(joint.body2()), joint.point.local_anchors())
            },
        }
    }

    /// Shows where the first anchor is from its body; where a distance is kept, where both are, from their bodies and in the
    /// world.
    pub(crate) fn show_anchors(&mut self, arm: Vector2, both: impl FnOnce() -> [[Vector2; 2]; 2]) {
        match self.kind_mut() {
            JointKind::Revolute(joint) => joint.point.show(arm),
            JointKind::Prismatic(joint) => joint.point.show(arm),
            JointKind::Weld(joint) => joint.point.show(arm),
            JointKind::Pin(joint) => joint.anchors.show(both()),
            JointKind::Slider(joint) => joint.anchors.show(both()),
            _ => {}
        }
    }

    /// Notes the error that an update has found.
    pub(crate) fn note(&mut self, error: f32) {
        self.joint_error = error;
    }
}
