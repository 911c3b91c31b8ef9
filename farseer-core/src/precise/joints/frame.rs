//! The relative pose of the two bodies of a joint, and the Jacobian of its rows there.

use super::super::direct::block::Triple;
use super::super::direct::constraint::Jacobian;
use super::hold::{End, Hold};
use super::swing::{turn, turned};
use super::tree::{Link, Vector, dot, plus};

/// Where the two bodies of a joint are against each other.
#[derive(Debug, Clone, Copy)]
pub(super) struct Frame {
    pub(super) link: Link,
    /// From the origin of each body to its anchor.
    pub(super) arms: [Vector; 2],
    /// From the origin of the first body to that of the second.
    pub(super) apart: Vector,
    /// Angle of the second body against the first, in radians.
    pub(super) angle: f64,
    /// The axis of a prismatic joint, in world coordinates.
    pub(super) axis: Vector,
}

impl Frame {
    pub(super) fn of(hold: &Hold) -> Self {
        Frame { axis: hold.axis, ..Frame::between(hold.link, &hold.ends, hold.angle) }
    }

    /// Of a link without an axis, at this angle.
    pub(super) fn between(link: Link, [first, second]: &[End; 2], angle: f64) -> Self {
        let arms = [first.arm, second.arm];
        Frame { link, arms, apart: plus(second.place, first.place, -1.0), angle, axis: [0.0; 2] }
    }

    /// After these displacements of both bodies: x, y and angle.
    pub(super) fn displaced(mut self, [a, b]: [Triple; 2]) -> Self {
        let turns = [turn(a[2]), turn(b[2])];
        self.arms = [turned(turns[0], self.arms[0]), turned(turns[1], self.arms[1])];
        self.apart = [self.apart[0] + b[0] - a[0], self.apart[1] + b[1] - a[1]];
        self.angle += b[2] - a[2];
        self.axis = turned(turns[0], self.axis);
        self
    }

    /// From the anchor of the first body to that of the second.
    pub(super) fn gap(&self) -> Vector {
        plus(plus(self.apart, self.arms[1], 1.0), self.arms[0], -1.0)
    }

    pub(super) fn distance(&self) -> f64 {
        let gap = self.gap();
        dot(gap, gap).sqrt()
    }

    /// The direction n of the linear rows.
    pub(super) fn normal(&self) -> Vector {
        match self.link {
            Link::Line => [-self.axis[1], self.axis[0]],
            Link::Distance => {
                let ([x, y], distance) = (self.gap(), self.distance());
                if distance > 0.0 { [x / distance, y / distance] } else { [1.0, 0.0] }
            }
            _ => [1.0, 0.0],
        }
    }

    pub(super) fn jacobian(&self) -> Jacobian {
        let (n, [mut a, b]) = (self.normal(), self.arms);
        if self.link == Link::Line {
            // A prismatic joint acts on both bodies at the second anchor.
            a = plus(a, self.gap(), 1.0);
        }
        Jacobian::at(n, [a, b])
    }

    /// The value that motor and limits act on: radians, or length units along the axis.
    pub(super) fn travel(&self, reference: f64) -> f64 {
        match self.link {
            Link::Line => dot(self.gap(), self.axis),
            _ => self.angle - reference,
        }
    }
}
