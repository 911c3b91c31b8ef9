//! The row along which a joint leaves its bodies free, as the iterative solver sees it: a motor, and limits on both sides.
//!
//! | joint | row | value |
//! |---|---|---|
//! | revolute | angle | radians from the angle of reference |
//! | prismatic | along the axis | length units |
//! | slider | along the line between the anchors | length units |
//! | angle limit | angle | radians |

use super::super::direct::joint::{ACROSS, ALONG, ANGLE};
use super::frame::Frame;
use super::hold::Hold;
use super::soft_law::{GREATEST_ANGLE, Law, within};
use super::tree::Link;

/// A motor: it seeks a speed, in length units/s or radians/s, by at most an impulse.
#[derive(Debug, Clone, Copy)]
struct Motor {
    speed: f64,
    most: f64,
    impulse: f64,
}

/// The range of the value; each limit pushes one way, and both impulses are 0 or more. Beyond a limit by `slop` nothing is corrected.
#[derive(Debug, Clone, Copy)]
struct Range {
    limits: [f64; 2],
    slop: f64,
    most: f64,
    /// The greatest error that counts.
    farthest: f64,
    impulses: [f64; 2],
}

/// The row, with an impulse of a substep.
#[derive(Debug, Clone, Copy)]
pub(super) struct FreeRow {
    /// Index of the row.
    pub(super) row: usize,
    /// Reciprocal of its effective mass; 0 if neither body can move along it.
    pub(super) inverse_mass: f64,
    reference: f64,
    value: f64,
    motor: Option<Motor>,
    range: Option<Range>,
}

impl FreeRow {
    /// The row of a joint in substeps of `h` seconds, with the impulse that all of it exerted last; `None` if nothing acts along it.
    /// The motor takes as much of the impulse as it can, and the limit on whose side the rest is takes that.
    pub(super) fn of(hold: &Hold, impulses: [f64; 3], h: f64) -> Option<Self> {
        let row = free_row(hold)?;
        let drive = hold.drive;
        let motor = drive.and_then(|drive| drive.motor()).map(|motor| {
            let most = f64::from(motor.greatest_effort) * h;
            Motor { speed: motor.speed.into(), most, impulse: within(impulses[row], most) }
        });
        let rest = impulses[row] - motor.map_or(0.0, |motor| motor.impulse);
        let limits = match drive {
            Some(drive) => drive.limits().map(|limits| [limits.lower, limits.upper].map(f64::from)),
            None => Some(hold.range),
        };
        let (slop, most) = if drive.is_some() { (0.0, f64::INFINITY) } else { (hold.slop, hold.most) };
        let range = limits.map(|limits| {
            let impulses =
                [rest, -rest].map(|impulse| if impulse > 0.0 { within(impulse, most) } else { 0.0 });
            let farthest = if row == ANGLE { GREATEST_ANGLE } else { f64::INFINITY };
            Range { limits, slop, most, farthest, impulses }
        });
        let reference = drive.map_or(0.0, |drive| f64::from(drive.reference));
        Some(FreeRow { row, inverse_mass: 0.0, reference, value: 0.0, motor, range })
    }

    /// The value follows the bodies.
    pub(super) fn follow(&mut self, frame: &Frame, inverse_mass: f64) {
        self.inverse_mass = inverse_mass;
        self.value = match frame.link {
            Link::Distance => frame.distance(),
            _ => frame.travel(self.reference),
        };
    }

    /// Whether there is a motor, or a limit has an impulse.
    pub(super) fn acts(&self) -> bool {
        self.motor.is_some() || self.impulse() != 0.0
    }

    /// The impulse of motor and limits together.
    pub(super) fn impulse(&self) -> f64 {
        let of_limits = self.range.map_or(0.0, |range| range.impulses[0] - range.impulses[1]);
        of_limits + self.motor.map_or(0.0, |motor| motor.impulse)
    }

    /// Solves the motor, which is rigid, and then the limits, at this relative velocity along the row. Answers the change of the
    /// impulse.
    pub(super) fn solve(&mut self, mut speed: f64, (law, h): (&Law, f64)) -> f64 {
        if self.inverse_mass <= 0.0 {
            return 0.0;
        }
        let (inverse, mut change) = (self.inverse_mass, 0.0);
        if let Some(motor) = &mut self.motor {
            let impulse = within(motor.impulse - (speed - motor.speed) / inverse, motor.most);
            change = impulse - std::mem::replace(&mut motor.impulse, impulse);
            speed += inverse * change;
        }
        if let Some(range) = &mut self.range {
            for side in [0, 1] {
                let more = range.solve(side, (self.value, speed), inverse, (law, h));
                change += more;
                speed += inverse * more;
            }
        }
        change
    }
}

impl Range {
    /// Solves the lower (0) or the upper limit (1). A limit that is not reached is a rigid row with u >= -room / h; one that is passed
    /// has the law of the pass. Answers the change of the impulse along the row.
    fn solve(&mut self, side: usize, (value, speed): (f64, f64), inverse: f64, (law, h): (&Law, f64)) -> f64 {
        let sign = if side == 0 { 1.0 } else { -1.0 };
        let room = sign * (value - self.limits[side]);
        let (rate, law) = if room > 0.0 {
            (room / h, &Law::HARD)
        } else {
            let beyond = room + self.slop;
            (if beyond < 0.0 { law.bias * within(beyond, self.farthest) } else { 0.0 }, law)
        };
        let old = self.impulses[side];
        let missing = (sign * speed + rate + law.compliance * old) / (inverse + law.compliance);
        let new = law.next(old, missing);
        self.impulses[side] = if new > 0.0 { within(new, self.most) } else { 0.0 };
        sign * (self.impulses[side] - old)
    }
}

/// The row along which motor or limits of a joint act; `None` if it has none of them.
fn free_row(hold: &Hold) -> Option<usize> {
    let has_range = hold.range[0] < hold.range[1];
    match hold.link {
        Link::Distance => has_range.then_some(ALONG),
        Link::Angle => has_range.then_some(ANGLE),
        Link::Line => hold.drive.map(|_| ACROSS),
        _ => hold.drive.map(|_| ANGLE),
    }
}
