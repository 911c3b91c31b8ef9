//! The numbers that joints keep, in three axes: how far they are from where they should be, and what pushes them there.
//!
//! Velocities and pushes are along x and y, turning, and along the depth axis, as those of bodies are.

use super::super::hold::Hold;
use super::super::loose::GROUND;
use super::super::swing::{turn, turned};
use super::super::tree::{Link, Vector, dot, plus, spun};
use crate::joints::{JointLimits, JointMotor};

pub(super) type Motion = [f64; 4];

/// The part of an error that a substep undoes where a joint closes a loop, which may ask for what cannot be, or where a limit was
/// passed; and up to which part of the length unit, or of a radian, an error is undone at once.
const UNDONE: f64 = 0.2;
const AT_ONCE: f64 = 0.5;

/// One number of a joint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum What {
    /// The way between the anchors along x (0) or y (1).
    Axis(usize),
    /// How fast the bodies part along the depth axis.
    Depth,
    Angle,
    /// In three axes.
    Distance,
    /// The way of the second anchor off a line.
    Across,
    /// The speed on the way that the joint leaves free, and where that ends.
    Motor(JointMotor),
    Limits(JointLimits),
}

impl What {
    fn is_angle(self, link: Link) -> bool {
        match self {
            What::Angle => true,
            What::Motor(_) | What::Limits(_) => link != Link::Line,
            _ => false,
        }
    }
}

/// What a pass asks for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Pass {
    /// Velocities with which the numbers are at the end of the substep what they are.
    Keep,
    /// Velocities with which errors have gone then.
    Undo,
    /// Velocities with which the numbers do not change.
    Relax,
}

/// One body of a joint.
#[derive(Debug, Clone, Copy)]
pub(super) struct Side {
    /// The place among the nodes of the group, or [`GROUND`].
    pub(super) node: u32,
    /// How the ground moves.
    pub(super) ground: Motion,
    /// Where the origin is, and from there to the anchor.
    pub(super) place: [f64; 3],
    pub(super) arm: Vector,
    /// How far it has turned in this step.
    pub(super) turned: f64,
}

/// Where a side is.
#[derive(Debug, Clone, Copy)]
struct Seen {
    point: [f64; 3],
    arm: Vector,
    turned: f64,
    turn: Vector,
}

impl Side {
    pub(super) fn velocity(&self, velocities: &[Motion]) -> Motion {
        if self.node == GROUND { self.ground } else { velocities[self.node as usize] }
    }

    pub(super) fn inverse_mass(&self, inverses: &[Motion]) -> f64 {
        if self.node == GROUND { 0.0 } else { inverses[self.node as usize][0] }
    }

    /// Where it will be in a time with this velocity.
    fn ahead(&self, [x, y, spin, z]: Motion, h: f64) -> Seen {
        let turn = turn(spin * h);
        let arm = turned(turn, self.arm);
        let [px, py, pz] = self.place;
        Seen {
            point: [px + x * h + arm[0], py + y * h + arm[1], pz + z * h],
            arm,
            turned: self.turned + spin * h,
            turn,
        }
    }

    pub(super) fn advance(&mut self, velocity @ [x, y, _, z]: Motion, h: f64) {
        let Seen { arm, turned, .. } = self.ahead(velocity, h);
        let [px, py, pz] = self.place;
        (self.place, self.arm, self.turned) = ([px + x * h, py + y * h, pz + z * h], arm, turned);
    }
}

/// A joint.
#[derive(Debug, Clone, Copy)]
pub(super) struct Tie {
    pub(super) hold: u32,
    pub(super) link: Link,
    pub(super) sides: [Side; 2],
    /// From anchor to anchor; anchors on one spot have the direction that they had last, or any.
    pub(super) direction: [f64; 3],
    /// The line in the world.
    pub(super) line: Vector,
    /// What the impulses of the step so far have done to the second body.
    pub(super) total: Motion,
}

impl Tie {
    fn seen(&self, velocities: &[Motion], h: f64) -> [Seen; 2] {
        self.sides.each_ref().map(|side| side.ahead(side.velocity(velocities), h))
    }

    fn seen_now(&self) -> [Seen; 2] {
        self.sides.each_ref().map(|side| side.ahead([0.0; 4], 0.0))
    }

    /// Between the anchors.
    pub(super) fn distance(&self) -> f64 {
        norm(apart(&self.seen_now()))
    }

    pub(super) fn find_direction(&mut self) {
        let apart = apart(&self.seen_now());
        let distance = norm(apart);
        if distance > 0.0 {
            self.direction = apart.map(|part| part / distance);
        }
    }

    /// The bodies have moved in a substep.
    pub(super) fn advance(&mut self, velocities: &[Motion], h: f64) {
        let [_, _, spin, _] = self.sides[0].velocity(velocities);
        self.line = turned(turn(spin * h), self.line);
        for side in &mut self.sides {
            side.advance(side.velocity(velocities), h);
        }
        self.find_direction();
    }

    /// A number of the joint where the sides are seen.
    fn value(&self, what: What, seen: &[Seen; 2], hold: &Hold) -> f64 {
        let [x, y, _] = apart(seen);
        let line = || turned(seen[0].turn, self.line);
        match what {
            What::Axis(0) => x,
            What::Axis(_) => y,
            What::Distance => norm(apart(seen)),
            What::Across => dot(spun(line()), [x, y]),
            What::Limits(_) if self.link == Link::Line => dot(line(), [x, y]),
            What::Limits(_) => {
                self.angle(seen, hold) - hold.drive.map_or(0.0, |drive| f64::from(drive.reference))
            }
            What::Angle => self.angle(seen, hold),
            What::Depth | What::Motor(_) => 0.0,
        }
    }

    fn angle(&self, seen: &[Seen; 2], hold: &Hold) -> f64 {
        hold.angle + seen[1].turned - seen[0].turned
    }
}

fn apart([a, b]: &[Seen; 2]) -> [f64; 3] {
    [b.point[0] - a.point[0], b.point[1] - a.point[1], b.point[2] - a.point[2]]
}

fn norm([x, y, z]: [f64; 3]) -> f64 {
    (x * x + y * y + z * z).sqrt()
}

/// One number that is kept.
#[derive(Debug, Clone, Copy)]
pub(super) struct Row {
    /// The place of its joint in the group.
    pub(super) tie: u32,
    pub(super) what: What,
    /// Its joint does, or may do.
    pub(super) closes_loop: bool,
    /// What a push of 1 does to the momenta of both bodies, and how their motion changes the number.
    pub(super) pushes: [Motion; 2],
    /// Of this substep, and between which bounds it has to be.
    pub(super) impulse: f64,
    pub(super) kept_impulse: f64,
    pub(super) bounds: [f64; 2],
    /// Which end of a range is near: 1 for the lower one, -1 for the upper one, 0 where there is none.
    end: f64,
    /// Velocity per impulse of a substep with which it yields, and the part of its error that it undoes in a second then.
    pub(super) softness: f64,
    pub(super) rate: f64,
    pub(super) is_active: bool,
}

impl Row {
    pub(super) fn new(tie: u32, what: What, closes_loop: bool) -> Self {
        Row {
            closes_loop,
            tie,
            what,
            pushes: [[0.0; 4]; 2],
            impulse: 0.0,
            kept_impulse: 0.0,
            bounds: [f64::MIN, f64::MAX],
            end: 0.0,
            softness: 0.0,
            rate: 0.0,
            is_active: false,
        }
    }

    /// Where the number has to be: both are the same if nothing is left to choose.
    fn range(&self, hold: &Hold) -> [f64; 2] {
        let [low, high] = match self.what {
            What::Distance | What::Angle => hold.range,
            What::Limits(limits) => [f64::from(limits.lower), f64::from(limits.upper)],
            _ => [0.0; 2],
        };
        if low < high { [low, high] } else { [high; 2] }
    }

    /// A step begins: what does not change in it.
    pub(super) fn begin(&mut self, tie: &Tie, hold: &Hold, [dt, h]: [f64; 2], parts: f64) {
        let drive = hold.drive.unwrap_or_default();
        match &mut self.what {
            // What a motor seeks may change in every step.
            What::Motor(motor) => {
                *motor = drive.motor().unwrap_or(JointMotor { speed: 0.0, greatest_effort: 0.0 })
            }
            What::Limits(limits) => *limits = drive.limits().unwrap_or(*limits),
            _ => {}
        }
        let yields = match self.what {
            What::Axis(_) => tie.link == Link::Point,
            What::Distance => true,
            _ => false,
        };
        // An impulse of a substep is that part of one of an update.
        (self.softness, self.rate) =
            if yields { (hold.softness * dt / h, hold.bias_factor / dt) } else { (0.0, 0.0) };
        let most = match self.what {
            What::Motor(motor) => f64::from(motor.greatest_effort) * h,
            // The greatest impulse of a weld is that of its angle.
            What::Axis(_) if tie.link == Link::Weld => f64::MAX,
            What::Depth | What::Across | What::Limits(_) => f64::MAX,
            _ => hold.most / parts,
        };
        self.bounds = [-most, most];
        let [low, high] = self.range(hold);
        self.end = 0.0;
        if low < high && self.softness == 0.0 {
            let value = tie.value(self.what, &tie.seen_now(), hold);
            self.end = if value - low < high - value { 1.0 } else { -1.0 };
            self.bounds = if self.end > 0.0 { [0.0, most] } else { [-most, 0.0] };
        }
        (self.impulse, self.kept_impulse) = (0.0, 0.0);
    }

    /// Finds what a push does, with the bodies as they are.
    pub(super) fn aim(&mut self, tie: &Tie) {
        let [a, b] = tie.seen_now();
        let [x, y, _] = apart(&[a, b]);
        let along = |[nx, ny, nz]: [f64; 3], arm_a: Vector| {
            let turning = |arm: Vector| dot(spun(arm), [nx, ny]);
            [[-nx, -ny, -turning(arm_a), -nz], [nx, ny, turning(b.arm), nz]]
        };
        // What slides along a line is held where the second anchor is.
        let slid = plus(a.arm, [x, y], 1.0);
        let [lx, ly] = tie.line;
        let turning = [[0.0, 0.0, -1.0, 0.0], [0.0, 0.0, 1.0, 0.0]];
        self.pushes = match self.what {
            What::Axis(0) => along([1.0, 0.0, 0.0], a.arm),
            What::Axis(_) => along([0.0, 1.0, 0.0], a.arm),
            What::Depth => [[0.0, 0.0, 0.0, -1.0], [0.0, 0.0, 0.0, 1.0]],
            What::Distance => along(tie.direction, a.arm),
            What::Across => along([-ly, lx, 0.0], slid),
            What::Motor(_) | What::Limits(_) if tie.link == Link::Line => along([lx, ly, 0.0], slid),
            What::Angle | What::Motor(_) | What::Limits(_) => turning,
        };
    }

    /// How fast the number changes.
    fn speed(&self, tie: &Tie, velocities: &[Motion]) -> f64 {
        let of = |side: usize| {
            let (push, velocity) = (self.pushes[side], tie.sides[side].velocity(velocities));
            (0..4).map(|i| push[i] * velocity[i]).sum::<f64>()
        };
        of(0) + of(1)
    }

    /// By how much its speed is not what a pass asks for.
    pub(super) fn missing(
        &self,
        (tie, hold): (&Tie, &Hold),
        velocities: &[Motion],
        (h, pass): (f64, Pass),
        unit: f64,
    ) -> f64 {
        let speed = self.speed(tie, velocities);
        match self.what {
            What::Depth => return speed,
            What::Motor(motor) => return speed - f64::from(motor.speed),
            _ => {}
        }
        // Angles have a unit of their own.
        let unit = if self.what.is_angle(tie.link) { 1.0 } else { unit };
        let [low, high] = self.range(hold);
        let now = tie.value(self.what, &tie.seen_now(), hold);
        if self.softness > 0.0 {
            return speed + (now - high) * self.rate + self.softness * self.impulse;
        }
        let room = if self.end > 0.0 { now - low } else { high - now };
        match (pass, self.end == 0.0) {
            (Pass::Relax, true) => speed,
            (Pass::Relax, false) => speed + self.end * room.max(0.0) / h,
            (_, is_exact) => {
                let ahead = tie.value(self.what, &tie.seen(velocities, h), hold);
                let allowed = if !is_exact && room >= 0.0 {
                    now - self.end * room
                } else if pass == Pass::Keep {
                    now
                } else if is_exact {
                    now - undone(now - high, unit, self.closes_loop)
                } else {
                    let beyond = (-room - hold.slop).max(0.0);
                    now + self.end * undone(beyond, unit, true)
                };
                (ahead - allowed) / h
            }
        }
    }

    /// Adds what its impulse has done to the second body.
    pub(super) fn count(&self, link: Link, total: &mut Motion) {
        let [x, y, turning, z] = self.pushes[1];
        // What a force at an anchor does to turn a body is no torque of the joint.
        let turning = if self.what.is_angle(link) { turning } else { 0.0 };
        for (total, push) in total.iter_mut().zip([x, y, turning, z]) {
            *total += push * self.impulse;
        }
    }
}

/// What of an error a substep undoes.
fn undone(error: f64, unit: f64, is_gentle: bool) -> f64 {
    let at_once = error.clamp(-AT_ONCE * unit, AT_ONCE * unit);
    if is_gentle { UNDONE * at_once } else { at_once }
}
