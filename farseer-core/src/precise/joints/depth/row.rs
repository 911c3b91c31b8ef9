//! The numbers that joints keep, in three axes: how far they are from where they should be, and what pushes them there.
//!
//! Velocities and pushes are along x and y, turning, and along the depth axis, as those of bodies are.

use super::super::forest::GROUND;
use super::super::hold::Hold;
use super::super::swing::{turn, turned};
use super::super::tree::{Link, Vector, dot, plus, spun};
use crate::joints::{JointLimits, JointMotor};
use crate::precise::parameters::spatial_joints::{LOOP_BAUMGARTE_FACTOR, POSITION_CORRECTION_LIMIT};

pub(super) type Motion = [f64; 4];

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

    pub(super) fn advance(&mut self, [x, y, spin, z]: Motion, h: f64) {
        let [px, py, pz] = self.place;
        (self.place, self.turned) = ([px + x * h, py + y * h, pz + z * h], self.turned + spin * h);
        if self.arm != [0.0; 2] {
            self.arm = turned(turn(spin * h), self.arm);
        }
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
    /// Both anchors are the origins of their bodies.
    pub(super) is_central: bool,
}

impl Tie {
    /// From anchor to anchor, where these are the origins of the bodies.
    fn apart_of_origins(&self) -> [f64; 3] {
        let [a, b] = self.sides.each_ref().map(|side| side.place);
        [b[0] - a[0], b[1] - a[1], b[2] - a[2]]
    }

    /// The distance of such anchors in `h` seconds.
    fn distance_of_origins(&self, velocities: &[Motion], h: f64) -> f64 {
        let [a, b] = self.sides.each_ref().map(|side| side.velocity(velocities));
        let [x, y, z] = self.apart_of_origins();
        norm([x + h * (b[0] - a[0]), y + h * (b[1] - a[1]), z + h * (b[3] - a[3])])
    }

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
        let apart = if self.is_central { self.apart_of_origins() } else { apart(&self.seen_now()) };
        let distance = norm(apart);
        if distance > 0.0 {
            self.direction = apart.map(|part| part / distance);
        }
    }

    /// The bodies have moved in a substep.
    pub(super) fn advance(&mut self, velocities: &[Motion], h: f64) {
        if self.link == Link::Line {
            let [_, _, spin, _] = self.sides[0].velocity(velocities);
            self.line = turned(turn(spin * h), self.line);
        }
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
    /// Greatest impulse of a substep.
    most: f64,
    /// Where the number has to be; how far out of that it may be; and the length or angle by which errors are told apart.
    range: [f64; 2],
    slop: f64,
    unit: f64,
    /// At the beginning of the pass: the number, and its velocity per impulse.
    now: f64,
    pub(super) answer: f64,
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
            most: f64::MAX,
            range: [0.0; 2],
            slop: 0.0,
            unit: 1.0,
            now: 0.0,
            answer: 0.0,
        }
    }

    /// Where the number has to be: both are the same if nothing is left to choose.
    fn range_of(&self, hold: &Hold) -> [f64; 2] {
        let [low, high] = match self.what {
            What::Distance | What::Angle => hold.range,
            What::Limits(limits) => [f64::from(limits.lower), f64::from(limits.upper)],
            _ => [0.0; 2],
        };
        if low < high { [low, high] } else { [high; 2] }
    }

    /// A step begins: what does not change in it.
    pub(super) fn begin(&mut self, tie: &Tie, hold: &Hold, ([dt, h], unit): ([f64; 2], f64), parts: f64) {
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
        self.most = most;
        (self.range, self.slop) = (self.range_of(hold), hold.slop);
        // Angles have a unit of their own.
        self.unit = if self.what.is_angle(tie.link) { 1.0 } else { unit };
        self.turn_to(0.0);
        (self.impulse, self.kept_impulse) = (0.0, 0.0);
    }

    /// Impulses towards one end of a range, or in both directions.
    fn turn_to(&mut self, end: f64) {
        self.end = end;
        self.bounds = [if end > 0.0 { 0.0 } else { -self.most }, if end < 0.0 { 0.0 } else { self.most }];
    }

    /// A substep begins: a range acts at the end that is nearer after it. No distance is below 0.
    pub(super) fn choose_end(&mut self, tie: &Tie, holds: &[Hold], velocities: &[Motion], h: f64) {
        let [low, high] = self.range;
        if low < high && self.softness == 0.0 {
            let is_upper = self.what == What::Distance && low <= 0.0 || {
                let ahead = self.ahead(tie, holds, velocities, h);
                ahead - low >= high - ahead
            };
            self.turn_to(if is_upper { -1.0 } else { 1.0 });
        }
    }

    /// No impulse is greater.
    pub(super) fn bind(&mut self, most: f64) {
        self.most = self.most.min(most);
        self.turn_to(self.end);
    }

    /// Finds the number and what a push does, with the bodies as they are.
    pub(super) fn aim(&mut self, tie: &Tie, hold: &Hold, inverses: &[Motion]) {
        if tie.is_central && self.what == What::Distance {
            let [nx, ny, nz] = tie.direction;
            self.pushes = [[-nx, -ny, 0.0, -nz], [nx, ny, 0.0, nz]];
            self.now = norm(tie.apart_of_origins());
        } else {
            self.aim_at_anchors(tie, hold);
        }
        self.answer = 0.0;
        for (side, push) in tie.sides.iter().zip(self.pushes).filter(|(side, _)| side.node != GROUND) {
            self.answer += product(push, push, inverses[side.node as usize]);
        }
    }

    fn aim_at_anchors(&mut self, tie: &Tie, hold: &Hold) {
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
        self.now = tie.value(self.what, &[a, b], hold);
    }

    /// How fast the number changes.
    fn speed(&self, tie: &Tie, velocities: &[Motion]) -> f64 {
        let of = |side: usize| {
            let (push, velocity) = (self.pushes[side], tie.sides[side].velocity(velocities));
            (0..4).map(|i| push[i] * velocity[i]).sum::<f64>()
        };
        of(0) + of(1)
    }

    /// The number in `h` seconds.
    fn ahead(&self, tie: &Tie, holds: &[Hold], velocities: &[Motion], h: f64) -> f64 {
        if tie.is_central && self.what == What::Distance {
            tie.distance_of_origins(velocities, h)
        } else {
            tie.value(self.what, &tie.seen(velocities, h), &holds[tie.hold as usize])
        }
    }

    /// By how much its speed is not what a pass asks for.
    pub(super) fn missing(
        &self,
        (tie, holds): (&Tie, &[Hold]),
        velocities: &[Motion],
        (h, pass): (f64, Pass),
    ) -> f64 {
        match self.what {
            What::Depth => return self.speed(tie, velocities),
            What::Motor(motor) => return self.speed(tie, velocities) - f64::from(motor.speed),
            _ => {}
        }
        let [low, high] = self.range;
        if self.softness > 0.0 {
            let speed = self.speed(tie, velocities);
            return speed + (self.now - high) * self.rate + self.softness * self.impulse;
        }
        let room = if self.end > 0.0 { self.now - low } else { high - self.now };
        match (pass, self.end == 0.0) {
            (Pass::Relax, true) => self.speed(tie, velocities),
            (Pass::Relax, false) => self.speed(tie, velocities) + self.end * room.max(0.0) / h,
            (_, is_exact) => {
                let allowed = if !is_exact && room >= 0.0 {
                    self.now - self.end * room
                } else if pass == Pass::Keep {
                    self.now
                } else {
                    self.now - self.undone()
                };
                (self.ahead(tie, holds, velocities, h) - allowed) / h
            }
        }
    }

    /// The part of its error that a substep undoes, with the error's sign.
    pub(super) fn undone(&self) -> f64 {
        let [low, high] = self.range;
        match self.what {
            What::Depth | What::Motor(_) => 0.0,
            _ if self.softness > 0.0 => 0.0,
            _ if self.end == 0.0 => undone(self.now - high, self.unit, self.closes_loop),
            _ => {
                let room = if self.end > 0.0 { self.now - low } else { high - self.now };
                -self.end * undone((-room - self.slop).max(0.0), self.unit, true)
            }
        }
    }

    /// The same as a part of its unit.
    pub(super) fn part_undone(&self) -> f64 {
        self.undone().abs() / self.unit
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

/// The effect of a push on one number on another one, by way of a body that both hold.
pub(super) fn product(a: Motion, b: Motion, inverse: Motion) -> f64 {
    (0..4).map(|i| a[i] * b[i] * inverse[i]).sum()
}

/// What of an error a substep undoes.
fn undone(error: f64, unit: f64, is_gentle: bool) -> f64 {
    let at_once = error.clamp(-POSITION_CORRECTION_LIMIT * unit, POSITION_CORRECTION_LIMIT * unit);
    if is_gentle { LOOP_BAUMGARTE_FACTOR * at_once } else { at_once }
}
