//! Joints as they are when a step begins.

use super::super::bodies::Bodies;
use super::tree::{Link, Vector, cross, dot, plus};
use crate::body::BodyId;
use crate::joints::{Drive, JointId};
use crate::math::Vector2;

/// One side of a joint.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct End {
    /// The number of a body that gives way, else 0.
    pub(super) body: u32,
    /// The number of the body that it follows; 0 for what has none and stays where it is.
    pub(super) pose: u32,
    /// The anchor in the coordinates of the body.
    pub(super) anchor: Vector,
    /// Where the body's origin is, and how it moves if it does so whatever happens.
    pub(super) place: Vector,
    pub(super) velocity: [f64; 3],
    /// From there to the anchor.
    pub(super) arm: Vector,
}

impl End {
    /// Goes where its body is.
    #[inline(always)]
    pub(super) fn follow(&mut self, bodies: &Bodies) {
        if self.pose == 0 {
            return;
        }
        let [x, y, c, s] = bodies.poses[self.pose as usize].map(f64::from);
        self.place = [x, y];
        self.arm = [c * self.anchor[0] - s * self.anchor[1], s * self.anchor[0] + c * self.anchor[1]];
        if self.body == 0
            && let Some(hot) = bodies.hot.get(self.pose as usize)
        {
            let [x, y, spin, _] = hot.velocity.map(f64::from);
            self.velocity = [x, y, spin];
        }
    }

    pub(super) fn point(&self) -> Vector {
        plus(self.place, self.arm, 1.0)
    }
}

/// As users see it.
pub(super) fn shown([x, y]: Vector) -> Vector2 {
    Vector2::new(x as f32, y as f32)
}

/// What of a joint the plan of trees depends on.
#[derive(Debug, Clone, Copy)]
pub(super) struct Key {
    pub(super) bodies: [u32; 2],
    /// It may give way: it has a range, or a greatest impulse.
    pub(super) is_bounded: bool,
}

/// A joint in a step. What every step reads and writes comes first: of long chains that is all that need be in the cache.
#[derive(Debug, Clone, Copy)]
#[repr(C)]
pub(in crate::precise) struct Hold {
    pub(super) joint: JointId,
    /// Force and torque on the second body; and what of the force is along the depth axis, where that is known.
    pub(super) force: [f64; 3],
    pub(super) force_along_depth: f32,
    /// The mean of that over the step, where the force is that of the last substep.
    pub(super) mean_force: Option<[f64; 3]>,
    /// What it tells of how it was when the step began: how far from what it keeps, and the arm of the first anchor.
    pub(super) error: f32,
    pub(super) arm: Vector2,
    /// The first is `None` for the world.
    pub(super) bodies: (Option<BodyId>, BodyId),
    pub(super) link: Link,
    pub(super) ends: [End; 2],
    /// Angle of the second body against the first, if the joint keeps or drives it.
    pub(super) angle: f64,
    /// The line that it keeps: in the first body, and in the world.
    pub(super) local_axis: Vector,
    pub(super) axis: Vector,
    /// What moves it along the way that it leaves free.
    pub(super) drive: Option<Drive>,
    /// Where an angle or distance has to be.
    pub(super) range: [f64; 2],
    pub(super) slop: f64,
    /// Greatest impulse of a substep.
    pub(super) most: f64,
    /// Velocity per impulse of an update with which it yields, and the part of an error that it undoes in an update then.
    pub(super) softness: f64,
    pub(super) bias_factor: f64,
    /// How far the second body is behind the first, if that matters to the joint.
    pub(super) behind: f64,
    /// Anchors, angle or motor are others than in the update before.
    pub(super) has_moved: bool,
}

impl Hold {
    pub(super) fn key(&self) -> Key {
        let [low, high] = self.range;
        Key {
            bodies: self.ends.map(|end| end.body),
            is_bounded: low < high || self.most < f64::from(f32::MAX),
        }
    }

    /// Whether anchors, angle or motor are others than in the update before.
    pub(in crate::precise) fn has_moved(&self) -> bool {
        self.has_moved
    }

    /// Whether it keeps or drives an angle.
    pub(super) fn turns(&self) -> bool {
        matches!(self.link, Link::Angle | Link::Weld | Link::Line) || self.drive.is_some()
    }

    /// How far the joint is from what it keeps: a length, or an angle in radians.
    pub(super) fn find_error(&self) -> f64 {
        let apart = plus(self.ends[1].point(), self.ends[0].point(), -1.0);
        let distance = dot(apart, apart).sqrt();
        match self.link {
            Link::Distance => self.beyond((dot(apart, apart) + self.behind * self.behind).sqrt()),
            Link::Angle => self.beyond(self.angle),
            Link::Line => cross(self.axis, apart).abs(),
            _ => distance,
        }
    }

    /// How far a value is out of the range.
    pub(super) fn beyond(&self, value: f64) -> f64 {
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
