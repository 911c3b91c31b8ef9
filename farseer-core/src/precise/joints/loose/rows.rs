//! The numbers that a joint outside of trees keeps, and how far they are from where they should be.

use super::push::Pass;
use super::{Keeps, Loose, Side};
use crate::precise::joints::hold::Hold;
use crate::precise::joints::swing::{aside_of_turn, turned};
use crate::precise::joints::tree::{Link, Node, Vector, dot, plus, spun};

/// Fraction of an error that a substep corrects, and fraction of the length unit, or of a radian, up to which the error counts:
/// a feedback of positions into velocities (J. Baumgarte, "Stabilization of constraints and integrals of motion in dynamical
/// systems", 1972).
const UNDONE: f64 = 0.2;
const AT_ONCE: f64 = 0.5;

/// One number that is kept.
#[derive(Debug, Clone, Copy)]
pub(super) struct Row {
    /// Of its impulse in the joint.
    pub(super) at: usize,
    pub(super) direction: Vector,
    pub(super) arms: [f64; 2],
    pub(super) error: Error,
    pub(super) most: f64,
    pub(super) slop: f64,
}

/// How far a number is from where it should be.
#[derive(Debug, Clone, Copy)]
pub(super) enum Error {
    /// Beyond where it should be.
    Of(f64),
    /// Room until a limit, whose impulse has this sign; negative beyond.
    Room(f64, f64),
    /// Where it is does not matter: it should have this speed.
    Speed(f64),
}

impl Loose {
    fn velocity_of(&self, side: &Side, nodes: &[Node]) -> [f64; 3] {
        nodes.get(side.node as usize).map_or(side.end.velocity, |node| node.velocity)
    }

    /// How far the anchors part in a time along a direction because their ways are bent: as the arms turn, and, if it is their
    /// distance that counts, as they go round each other.
    fn bend(&self, direction: Vector, distance: Option<f64>, nodes: &[Node], h: f64) -> f64 {
        let [a, b] = self.sides.each_ref().map(|side| {
            let ([x, y, spin], arm) = (self.velocity_of(side, nodes), side.end.arm);
            let [cosine, sine] = aside_of_turn(spin * h);
            let way = plus([x, y], spun(arm), spin);
            (way, turned([cosine - 1.0, sine], arm))
        });
        let aside = plus(b.1, a.1, -1.0);
        let bend = match distance {
            Some(distance) => {
                let way = plus(b.0, a.0, -1.0);
                let ahead = plus(plus(self.apart(), way, h), aside, 1.0);
                dot(ahead, ahead).sqrt() - distance - h * dot(way, direction)
            }
            None => dot(aside, direction),
        };
        // What turns so fast that this matters is not held to the last digit.
        bend.clamp(-AT_ONCE * self.unit, AT_ONCE * self.unit)
    }

    /// How far the anchors part in a time because the line turns, along it and across, if nothing acts: its origins go
    /// straight on.
    fn bend_of_line(&self, nodes: &[Node], h: f64) -> [f64; 2] {
        let [a, b] = self.sides.each_ref().map(|side| self.velocity_of(side, nodes));
        let ends = self.sides.map(|side| side.end);
        let (along, across, spin) = (self.direction, spun(self.direction), a[2]);
        let origins = plus(ends[1].place, ends[0].place, -1.0);
        let way = plus([b[0], b[1]], [a[0], a[1]], -1.0);
        let slide = dot(along, plus(way, spun(origins), -spin));
        let round = spin * spin;
        let most = AT_ONCE * self.unit;
        [dot(along, origins) * round, dot(across, origins) * round - 2.0 * spin * slide]
            .map(|bend| (0.5 * h * h * bend).clamp(-most, most))
    }

    /// What a push along a direction does to turn the sides. What slides along a line is held where the second anchor is.
    pub(super) fn arms(&self, direction: Vector) -> [f64; 2] {
        let [mut a, b] = self.sides.map(|side| side.end.arm);
        if self.link == Link::Line {
            a = plus(a, self.apart(), 1.0);
        }
        [dot(spun(a), direction), dot(spun(b), direction)]
    }

    /// The motor and the limits.
    fn drive_rows(&self, hold: &Hold, nodes: &[Node], (h, pass): (f64, Pass)) -> [Option<Row>; 3] {
        let Some(drive) = hold.drive else { return [None; 3] };
        let (value, bend, unit, direction, arms) = if self.link == Link::Line {
            let bend = if pass == Pass::Correct { self.bend_of_line(nodes, h)[0] } else { 0.0 };
            let along = self.direction;
            (dot(along, self.apart()), bend, self.unit, along, self.arms(along))
        } else {
            (self.angle_of(nodes) - f64::from(drive.reference), 0.0, 1.0, [0.0; 2], [1.0; 2])
        };
        let row = |at, error, most| Row { at, direction, arms, error, most, slop: 0.0 };
        let motor = drive.motor().map(|motor| {
            let most = f64::from(motor.greatest_effort) * self.h * self.share;
            row(0, Error::Speed(f64::from(motor.speed)), most)
        });
        let limits = drive.limits().map(|limits| {
            let range = [limits.lower, limits.upper].map(f64::from);
            row(1, bounded(value, bend, range, unit), f64::MAX)
        });
        [motor, limits, None]
    }

    /// The numbers that it keeps.
    pub(super) fn rows(&self, hold: &Hold, nodes: &[Node], (h, pass): (f64, Pass)) -> [Option<Row>; 3] {
        if self.keeps == Keeps::Drive {
            return self.drive_rows(hold, nodes, (h, pass));
        }
        let (apart, unit) = (self.apart(), self.unit);
        let row = |at, direction, error, most| {
            let (arms, slop) = (self.arms(direction), hold.slop);
            Some(Row { at, direction, arms, error, most, slop })
        };
        let most = hold.most * self.longer * self.share;
        let bend = |direction, distance| {
            if pass == Pass::Correct { self.bend(direction, distance, nodes, h) } else { 0.0 }
        };
        let point = |at: usize, direction, most| {
            row(at, direction, Error::Of(undone(apart[at], unit) + bend(direction, None)), most)
        };
        match self.link {
            Link::Distance => {
                let distance = dot(apart, apart).sqrt();
                let error = bounded(distance, bend(self.direction, Some(distance)), hold.range, unit);
                [row(0, self.direction, error, most), None, None]
            }
            Link::Angle => [None, None, self.angle_row(hold, nodes, most)],
            Link::Line => {
                let across = spun(self.direction);
                let bend = if pass == Pass::Correct { self.bend_of_line(nodes, h)[1] } else { 0.0 };
                let error = Error::Of(undone(dot(across, apart), unit) + bend);
                [row(0, across, error, f64::MAX), None, self.angle_row(hold, nodes, most)]
            }
            Link::Point => [point(0, [1.0, 0.0], most), point(1, [0.0, 1.0], most), None],
            // The greatest impulse of a weld is that of its angle.
            _ => [
                point(0, [1.0, 0.0], f64::MAX),
                point(1, [0.0, 1.0], f64::MAX),
                self.angle_row(hold, nodes, most),
            ],
        }
    }

    fn angle_of(&self, nodes: &[Node]) -> f64 {
        let turned = |side: Side| nodes.get(side.node as usize).map_or(side.turned, |node| node.path[2]);
        let [a, b] = self.sides.map(turned);
        self.angle + b - a
    }

    fn angle_row(&self, hold: &Hold, nodes: &[Node], most: f64) -> Option<Row> {
        // Angles have a unit of their own.
        let error = bounded(self.angle_of(nodes), 0.0, hold.range, 1.0);
        Some(Row { at: 2, direction: [0.0; 2], arms: [1.0; 2], error, most, slop: hold.slop })
    }
}

/// The part of an error that a substep undoes. Loops may ask for what cannot be: then it must not be asked for at once.
pub(super) fn undone(error: f64, unit: f64) -> f64 {
    UNDONE * error.clamp(-AT_ONCE * unit, AT_ONCE * unit)
}

/// Where a number is, and will be besides what its speed does, that has to be in a range.
fn bounded(value: f64, bend: f64, [low, high]: [f64; 2], unit: f64) -> Error {
    let ahead = value + bend;
    if low >= high {
        Error::Of(undone(value - high, unit) + bend)
    } else if ahead - low < high - ahead {
        Error::Room(ahead - low, 1.0)
    } else {
        Error::Room(high - ahead, -1.0)
    }
}
