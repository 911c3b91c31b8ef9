//! Joints outside of trees: those that close loops, those that may give way, as limits do, and motors.
//!
//! Trees are solved first. Then each of these pushes where it is not obeyed, and the trees answer as a whole: what a push of 1
//! does to all velocities is found by [solving](super::tree) the trees once more with it. So trees stay whole, and a single
//! loop, as of a bridge, is exact after one push. Where that were too much, as for a net, the two bodies answer alone, and
//! trees are solved after them.

use super::hold::{End, Hold};
use super::swing::{aside_of_turn, turn, turned};
use super::tree::{Link, Node, Vector, dot, plus, solve, solve_again, spun};
use crate::storage::reusing_clone::reusing_clone;

/// The part of an error that a substep undoes, and up to which part of the length unit, or of a radian.
const UNDONE: f64 = 0.2;
const AT_ONCE: f64 = 0.5;

/// Bodies times numbers that are kept, up to which trees answer as a whole.
const WHOLE: usize = 1000;

/// The part of what the two bodies alone would answer that is added to what trees answer where a loop closes: a chain that is
/// straight between two shores cannot be longer, whatever pulls.
const YIELDING: f64 = 1e-1;

/// Times that several joints of this kind take turns.
const SWEEPS: usize = 4;

/// A body that stands for what is no node.
pub(super) const GROUND: u32 = u32::MAX;

/// Which part of a joint is outside of trees.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Keeps {
    /// What it keeps of the motion of its bodies.
    Joint,
    /// What moves it on the way that it leaves free, and where that ends.
    Drive,
}

/// A joint outside of trees, or what drives one.
#[derive(Debug, Clone, Copy)]
pub(super) struct Loose {
    pub(super) hold: u32,
    link: Link,
    keeps: Keeps,
    /// What part of a substep the forces of a pass stand for, and how many of the simulator's substeps that is.
    share: f64,
    longer: f64,
    h: f64,
    softness: f64,
    rate: f64,
    unit: f64,
    sides: [Side; 2],
    angle: f64,
    /// From anchor to anchor, or along the line.
    direction: Vector,
    /// Impulses of a substep on the second body: along x and y, or along or across the direction, and turning; or of the motor
    /// and the limits.
    impulse: [f64; 3],
    /// What the impulses of the step so far have done to the second body.
    pub(super) total: [f64; 3],
}

/// One body of such a joint.
#[derive(Debug, Clone, Copy)]
struct Side {
    node: u32,
    end: End,
    /// How far the ground has turned in this step.
    turned: f64,
    /// By how much the side has turned in the last substep.
    turn: [f64; 2],
}

/// One number that is kept.
#[derive(Debug, Clone, Copy)]
struct Row {
    /// Of its impulse in the joint.
    at: usize,
    direction: Vector,
    arms: [f64; 2],
    error: Error,
    most: f64,
    slop: f64,
}

/// How far a number is from where it should be.
#[derive(Debug, Clone, Copy)]
enum Error {
    /// Beyond where it should be.
    Of(f64),
    /// Room until a limit, whose impulse has this sign; negative beyond.
    Room(f64, f64),
    /// Where it is does not matter: it should have this speed.
    Speed(f64),
}

/// What a pass asks for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Pass {
    /// Velocities with which errors go, by new impulses.
    Correct,
    /// Velocities with which nothing changes, by new impulses.
    Rest,
    /// The same, by a change of the impulses of the last pass.
    Relax,
}

/// What a push of 1 on a number does.
#[derive(Debug)]
pub(super) struct Answer {
    joint: usize,
    row: Row,
    /// Of the number itself, and of velocities and impulses of all nodes.
    own: f64,
    nodes: Vec<[[f64; 3]; 2]>,
}

reusing_clone! { Answer { joint, row, own, nodes } }

/// Velocities that obey all joints of a group as far as they can, from those that do not.
pub(super) fn solve_group(
    nodes: &mut [Node],
    loose: &mut [Loose],
    holds: &[Hold],
    room: &mut Room,
    (h, pass, stiff): (f64, Pass, f64),
) {
    match pass {
        Pass::Correct => loose.iter().for_each(|joint| joint.act_again(nodes)),
        Pass::Rest => loose.iter_mut().for_each(|joint| joint.impulse = [0.0; 3]),
        Pass::Relax => {}
    }
    let is_whole = loose.len() * nodes.len() <= WHOLE;
    if !is_whole {
        for joint in loose.iter_mut() {
            let hold = &holds[joint.hold as usize];
            for row in joint.rows(hold, nodes, (h, pass)).into_iter().flatten() {
                joint.push_alone(&row, nodes, h, pass);
            }
        }
    }
    solve(nodes, stiff);
    if is_whole && !loose.is_empty() {
        room.find_answers(nodes, loose, holds, (h, pass));
        room.push_all(nodes, loose, (h, pass));
    }
}

/// A second look at a [correction](Pass::Correct), with the ways that it makes bodies go.
pub(super) fn refine_group(nodes: &mut [Node], loose: &mut [Loose], room: &mut Room, h: f64) {
    if loose.len() * nodes.len() > WHOLE {
        return;
    }
    nodes.iter_mut().for_each(|node| node.velocity = node.before);
    loose.iter().for_each(|joint| joint.act_again(nodes));
    solve_again(nodes);
    if !loose.is_empty() {
        room.push_all(nodes, loose, (h, Pass::Correct));
    }
}

/// Kept from pass to pass, so that nothing is allocated.
#[derive(Debug, Default)]
pub(super) struct Room {
    answers: Vec<Answer>,
    count: usize,
    /// Limits that are obeyed, of which joints.
    idle: Vec<(usize, Row)>,
    kept: Vec<[[f64; 3]; 3]>,
}

reusing_clone! { Room { answers, count, idle, kept } }

impl Room {
    /// Finds what the trees answer to each number that is not obeyed, or has had to be.
    fn find_answers(&mut self, nodes: &mut [Node], loose: &[Loose], holds: &[Hold], (h, pass): (f64, Pass)) {
        self.count = 0;
        self.idle.clear();
        for (at, joint) in loose.iter().enumerate() {
            let hold = &holds[joint.hold as usize];
            for row in joint.rows(hold, nodes, (h, pass)).into_iter().flatten() {
                if joint.is_idle(&row, nodes, h, pass) {
                    self.idle.push((at, row));
                } else {
                    self.find_answer(nodes, joint, at, &row);
                }
            }
        }
    }

    /// All push, and once more with the limits that they have pushed something past.
    fn push_all(&mut self, nodes: &mut [Node], loose: &mut [Loose], (h, pass): (f64, Pass)) {
        self.push_by_turns(nodes, loose, (h, pass));
        let known = self.count;
        for place in (0..self.idle.len()).rev() {
            let (at, row) = self.idle[place];
            if !loose[at].is_idle(&row, nodes, h, pass) {
                self.idle.remove(place);
                self.find_answer(nodes, &loose[at], at, &row);
            }
        }
        if self.count > known {
            self.push_by_turns(nodes, loose, (h, pass));
        }
    }

    fn push_by_turns(&self, nodes: &mut [Node], loose: &mut [Loose], (h, pass): (f64, Pass)) {
        for _ in 0..if self.count > 1 { SWEEPS } else { 1 } {
            for answer in &self.answers[..self.count] {
                loose[answer.joint].push(answer, nodes, h, pass);
            }
        }
    }

    /// The trees have been solved as they are: only what moves is another.
    fn find_answer(&mut self, nodes: &mut [Node], joint: &Loose, at: usize, row: &Row) {
        self.kept.clear();
        self.kept.extend(nodes.iter().map(|node| [node.velocity, node.bias, node.impulse]));
        for node in nodes.iter_mut() {
            (node.velocity, node.bias) = ([0.0; 3], [0.0; 3]);
        }
        joint.apply(row, 1.0, nodes);
        solve_again(nodes);
        let mut own = joint.speed_of(row, nodes, false);
        if let Error::Of(_) = row.error {
            own += YIELDING * joint.alone(row, nodes);
        }
        if self.answers.len() == self.count {
            self.answers.push(Answer { joint: at, row: *row, own, nodes: Vec::new() });
        }
        let answer = &mut self.answers[self.count];
        (answer.joint, answer.row, answer.own) = (at, *row, own);
        answer.nodes.clear();
        answer.nodes.extend(nodes.iter().map(|node| [node.velocity, node.impulse]));
        self.count += 1;
        for (node, &[velocity, bias, impulse]) in nodes.iter_mut().zip(&self.kept) {
            (node.velocity, node.bias, node.impulse) = (velocity, bias, impulse);
        }
    }
}

impl Loose {
    pub(super) fn new(at: u32, keeps: Keeps, hold: &Hold, node_of: impl Fn(u32) -> u32) -> Self {
        let sides = hold.ends.map(|end| Side { node: node_of(end.body), end, turned: 0.0, turn: [1.0, 0.0] });
        Loose {
            hold: at,
            link: hold.link,
            keeps,
            share: 1.0,
            longer: 1.0,
            h: 0.0,
            softness: 0.0,
            rate: 0.0,
            unit: 1.0,
            sides,
            angle: 0.0,
            direction: [1.0, 0.0],
            impulse: [0.0; 3],
            total: [0.0; 3],
        }
    }

    /// A step begins.
    pub(super) fn begin(&mut self, hold: &Hold, [dt, h]: [f64; 2], unit: f64) {
        self.unit = unit;
        for (side, &end) in self.sides.iter_mut().zip(&hold.ends) {
            (side.end, side.turned) = (end, 0.0);
        }
        // An impulse of a substep is that part of one of an update.
        (self.softness, self.rate) = (hold.softness * dt / h, hold.bias_factor / dt);
        (self.share, self.longer, self.h) = (1.0, 1.0, h);
        self.angle = hold.angle;
        self.total = [0.0; 3];
        self.direction = if hold.link == Link::Line { hold.axis } else { [1.0, 0.0] };
        if hold.link == Link::Distance {
            self.find_direction();
        }
        let [x, y, turning] = hold.force.map(|force| f64::from(force) * h);
        self.impulse = match (self.keeps, hold.link) {
            // What it did is not told from what the joint did.
            (Keeps::Drive, _) => [0.0; 3],
            (_, Link::Distance) => [dot(self.direction, [x, y]), 0.0, 0.0],
            (_, Link::Line) => [dot(spun(self.direction), [x, y]), 0.0, turning],
            (_, Link::Point) => [x, y, 0.0],
            _ => [x, y, turning],
        };
        if self.keeps == Keeps::Drive {
            self.softness = 0.0;
        }
    }

    pub(super) fn is_soft(&self) -> bool {
        self.softness > 0.0
    }

    /// Substeps have another length than it was begun with.
    pub(super) fn stretch(&mut self, longer: f64, h: f64) {
        (self.longer, self.h) = (longer, h);
        self.softness /= longer;
        self.impulse = self.impulse.map(|impulse| impulse * longer);
    }

    /// The forces of the next pass stand for this part of a substep.
    pub(super) fn share(&mut self, share: f64) {
        self.share = share;
    }

    /// The impulse of this substep has acted.
    pub(super) fn count_impulse(&mut self) {
        let ([x, y], turning) = self.pushes();
        self.total = [self.total[0] + x, self.total[1] + y, self.total[2] + turning];
    }

    /// What the impulses so far do to the second body at the joint.
    fn pushes(&self) -> (Vector, f64) {
        let ([x, y, turning], direction) = (self.impulse, self.direction);
        let along = |impulse: f64| [direction[0] * impulse, direction[1] * impulse];
        match (self.keeps, self.link) {
            (Keeps::Drive, Link::Line) => (along(x + y), 0.0),
            (Keeps::Drive, _) => ([0.0; 2], x + y),
            (_, Link::Distance) => (along(x), turning),
            (_, Link::Line) => (spun(along(x)), turning),
            _ => ([x, y], turning),
        }
    }

    /// Tells what it has held with in a step.
    pub(super) fn tell(&self, force: &mut [f32; 3], dt: f64) {
        let with = self.total.map(|impulse| (impulse / dt) as f32);
        match self.keeps {
            Keeps::Joint => *force = with,
            Keeps::Drive => (0..3).for_each(|i| force[i] += with[i]),
        }
    }

    /// The nodes have moved in a substep.
    pub(super) fn advance(&mut self, nodes: &[Node], h: f64) {
        for side in &mut self.sides {
            if let Some(node) = nodes.get(side.node as usize) {
                side.end.place = node.place;
                side.end.arm = turned(node.turn, side.end.arm);
                side.turn = node.turn;
            } else {
                let [x, y, angle] = side.end.velocity.map(|velocity| velocity * h);
                side.end.place = plus(side.end.place, [x, y], 1.0);
                side.turn = turn(angle);
                side.end.arm = turned(side.turn, side.end.arm);
                side.turned += angle;
            }
        }
        match self.link {
            Link::Line => self.direction = turned(self.sides[0].turn, self.direction),
            _ => self.find_direction(),
        }
    }

    fn apart(&self) -> Vector {
        plus(self.sides[1].end.point(), self.sides[0].end.point(), -1.0)
    }

    /// Anchors on one spot have no direction: that which they had last in this step, or any, will do.
    fn find_direction(&mut self) {
        let apart = self.apart();
        let distance = dot(apart, apart).sqrt();
        if distance > 0.0 {
            self.direction = [apart[0] / distance, apart[1] / distance];
        }
    }

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
    fn arms(&self, direction: Vector) -> [f64; 2] {
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
    fn rows(&self, hold: &Hold, nodes: &[Node], (h, pass): (f64, Pass)) -> [Option<Row>; 3] {
        if self.keeps == Keeps::Drive {
            return self.drive_rows(hold, nodes, (h, pass));
        }
        let (apart, unit) = (self.apart(), self.unit);
        let row = |at, direction, error, most| {
            let (arms, slop) = (self.arms(direction), hold.slop);
            Some(Row { at, direction, arms, error, most, slop })
        };
        let most = hold.most * self.longer * self.share;
        let is_soft = self.softness > 0.0;
        let bend = |direction, distance| {
            if pass == Pass::Correct && !is_soft { self.bend(direction, distance, nodes, h) } else { 0.0 }
        };
        let point = |at: usize, direction, most| {
            row(
                at,
                direction,
                Error::Of(if is_soft { apart[at] } else { undone(apart[at], unit) + bend(direction, None) }),
                most,
            )
        };
        match self.link {
            Link::Distance => {
                let distance = dot(apart, apart).sqrt();
                let error = match bounded(distance, bend(self.direction, Some(distance)), hold.range, unit) {
                    Error::Of(_) if is_soft => Error::Of(distance - hold.range[1]),
                    error => error,
                };
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

    /// How fast a number changes.
    fn speed_of(&self, row: &Row, nodes: &[Node], with_ground: bool) -> f64 {
        let of = |side: &Side, arm: f64| {
            let ground = if with_ground { side.end.velocity } else { [0.0; 3] };
            let [x, y, spin] = nodes.get(side.node as usize).map_or(ground, |node| node.velocity);
            dot([x, y], row.direction) + spin * arm
        };
        of(&self.sides[1], row.arms[1]) - of(&self.sides[0], row.arms[0])
    }

    /// Whether a limit is obeyed, and has not had to push.
    fn is_idle(&self, row: &Row, nodes: &[Node], h: f64, pass: Pass) -> bool {
        match row.error {
            Error::Of(_) | Error::Speed(_) => false,
            Error::Room(_, sign) => {
                let (wanted, ..) = self.wants(row, h, pass);
                self.impulse[row.at] == 0.0 && sign * (self.speed_of(row, nodes, true) - wanted) >= 0.0
            }
        }
    }

    /// The impulses so far act anew.
    fn act_again(&self, nodes: &mut [Node]) {
        let (direction, turning) = self.pushes();
        let arms = self.arms(direction).map(|arm| arm + turning);
        let row = Row { at: 0, direction, arms, error: Error::Of(0.0), most: 0.0, slop: 0.0 };
        self.apply(&row, 1.0, nodes);
    }

    /// Pushes both bodies.
    fn apply(&self, row: &Row, impulse: f64, nodes: &mut [Node]) {
        for ((side, arm), sign) in self.sides.iter().zip(row.arms).zip([-1.0, 1.0]) {
            let Some(node) = nodes.get_mut(side.node as usize) else { continue };
            let push = sign * impulse;
            node.velocity[0] += push * row.direction[0] / node.mass;
            node.velocity[1] += push * row.direction[1] / node.mass;
            node.velocity[2] += push * arm / node.inertia;
        }
    }

    /// The speed that is asked for, and the least and greatest impulse.
    fn wants(&self, row: &Row, h: f64, pass: Pass) -> (f64, f64, f64) {
        let most = row.most;
        match row.error {
            Error::Of(error) if self.softness > 0.0 => (-error * self.rate, -most, most),
            Error::Of(error) if pass == Pass::Correct => (-error / h, -most, most),
            Error::Of(_) => (0.0, -most, most),
            Error::Speed(speed) => (speed, -most, most),
            Error::Room(room, sign) => {
                let beyond = if -room > row.slop { -room - row.slop } else { 0.0 };
                let speed = match pass {
                    // Until the limit there is as much way as there is room.
                    _ if room >= 0.0 => -room / h,
                    Pass::Correct => undone(beyond, self.unit) / h,
                    Pass::Rest | Pass::Relax => 0.0,
                };
                let (low, high) = if sign > 0.0 { (0.0, most) } else { (-most, 0.0) };
                (sign * speed, low, high)
            }
        }
    }

    /// The change of an impulse that a number asks for, with what a push of 1 does to it.
    fn change(&mut self, row: &Row, nodes: &[Node], own: f64, (h, pass): (f64, Pass)) -> f64 {
        let (wanted, low, high) = self.wants(row, h, pass);
        let old = self.impulse[row.at];
        let missing = wanted - self.speed_of(row, nodes, true) - self.softness * old;
        let inverse = own + self.softness;
        if inverse.is_nan() || inverse <= 0.0 {
            return 0.0;
        }
        self.impulse[row.at] = (old + missing / inverse).clamp(low, high);
        self.impulse[row.at] - old
    }

    /// What a push of 1 does to the number if only the two bodies answer.
    fn alone(&self, row: &Row, nodes: &[Node]) -> f64 {
        let of = |side: &Side, arm: f64| {
            nodes
                .get(side.node as usize)
                .map_or(0.0, |node| dot(row.direction, row.direction) / node.mass + arm * arm / node.inertia)
        };
        of(&self.sides[0], row.arms[0]) + of(&self.sides[1], row.arms[1])
    }

    /// Pushes, and the trees answer.
    fn push(&mut self, answer: &Answer, nodes: &mut [Node], h: f64, pass: Pass) {
        let change = self.change(&answer.row, nodes, answer.own, (h, pass));
        if change != 0.0 {
            for (node, [velocity, impulse]) in nodes.iter_mut().zip(&answer.nodes) {
                for i in 0..3 {
                    node.velocity[i] += change * velocity[i];
                    node.impulse[i] += change * impulse[i];
                }
            }
        }
    }

    /// Pushes, and the two bodies answer.
    fn push_alone(&mut self, row: &Row, nodes: &mut [Node], h: f64, pass: Pass) {
        let own = self.alone(row, nodes);
        let change = self.change(row, nodes, own, (h, pass));
        self.apply(row, change, nodes);
    }
}

/// The part of an error that a substep undoes. Loops may ask for what cannot be: then it must not be asked for at once.
fn undone(error: f64, unit: f64) -> f64 {
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
