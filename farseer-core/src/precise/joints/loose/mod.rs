//! Joints outside of trees: those that close loops, those that may give way, as limits do, and motors.
//!
//! Trees are solved first. Then each of these pushes where it is not obeyed, and the trees answer as a whole: what a push of 1
//! does to all velocities is found by [solving](super::tree) the trees once more with it. So trees stay whole, and a single
//! loop, as of a bridge, is exact after one push. Where that were too much, as for a net, the two bodies answer alone, and
//! trees are solved after them.

mod group;
mod push;
mod rows;

use super::hold::{End, Hold};
use super::swing::{turn, turned};
use super::tree::{Link, Node, Vector, dot, plus, spun};
pub(super) use group::{Room, refine_group, solve_group};
pub(super) use push::Pass;

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
            unit: 1.0,
            sides,
            angle: 0.0,
            direction: [1.0, 0.0],
            impulse: [0.0; 3],
            total: [0.0; 3],
        }
    }

    /// A step begins.
    pub(super) fn begin(&mut self, hold: &Hold, h: f64, unit: f64) {
        self.unit = unit;
        for (side, &end) in self.sides.iter_mut().zip(&hold.ends) {
            (side.end, side.turned) = (end, 0.0);
        }
        (self.share, self.longer, self.h) = (1.0, 1.0, h);
        self.angle = hold.angle;
        self.total = [0.0; 3];
        self.direction = if hold.link == Link::Line { hold.axis } else { [1.0, 0.0] };
        if hold.link == Link::Distance {
            self.find_direction();
        }
        let [x, y, turning] = hold.force.map(|force| force * h);
        self.impulse = match (self.keeps, hold.link) {
            // What it did is not told from what the joint did.
            (Keeps::Drive, _) => [0.0; 3],
            (_, Link::Distance) => [dot(self.direction, [x, y]), 0.0, 0.0],
            (_, Link::Line) => [dot(spun(self.direction), [x, y]), 0.0, turning],
            (_, Link::Point) => [x, y, 0.0],
            _ => [x, y, turning],
        };
    }

    /// Substeps have another length than it was begun with.
    pub(super) fn stretch(&mut self, longer: f64, h: f64) {
        (self.longer, self.h) = (longer, h);
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
    pub(super) fn tell(&self, force: &mut [f64; 3], dt: f64) {
        let with = self.total.map(|impulse| impulse / dt);
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
}
