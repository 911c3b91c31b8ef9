//! Joints outside of trees, one after the other: those that close loops, and those that may give way, as limits do. Their
//! impulses are kept from step to step, and act again in each substep with those of contacts.

use super::super::bodies::Hot;
use super::hold::{End, Hold};
use super::swing::{turn, turned};
use super::tree::{Link, Vector, cross, dot, plus, spun};

/// The part of what is beyond a limit that a substep undoes: a limit is a wall, not a spring that is wound up.
const UNDONE: f64 = 0.2;

/// A joint outside of trees.
#[derive(Debug, Clone, Copy)]
pub(super) struct Loose {
    pub(super) hold: u32,
    link: Link,
    softness: f64,
    rate: f64,
    sides: [Side; 2],
    angle: f64,
    direction: Vector,
    /// Impulses of a substep on the second body: along x and y, or along the direction, and turning.
    pub(super) impulse: [f64; 3],
}

#[derive(Debug, Clone, Copy)]
struct Side {
    end: End,
    /// Reciprocals of mass and inertia.
    inverses: [f64; 2],
}

/// One number that is kept: its speed, what a pass may do, and what it has done.
struct Row {
    direction: Vector,
    arms: [f64; 2],
    /// How far the number is from where it should be.
    error: Error,
    most: f64,
}

enum Error {
    /// Beyond where it should be.
    Of(f64),
    /// Room until a limit, whose impulse has this sign; negative beyond.
    Room(f64, f64),
}

/// What a pass asks for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Pass {
    /// Velocities with which errors go.
    Correct,
    /// Velocities with which nothing changes.
    Rest,
}

impl Loose {
    pub(super) fn new(at: usize, hold: &Hold, [dt, h]: [f64; 2], inverses: impl Fn(u32) -> [f64; 2]) -> Self {
        let sides = hold.ends.map(|end| Side { end, inverses: inverses(end.body) });
        let [x, y, turning] = hold.force.map(|force| f64::from(force) * h);
        let mut loose = Loose {
            hold: at as u32,
            link: hold.link,
            softness: hold.softness * dt / h,
            rate: hold.bias_factor / dt,
            sides,
            angle: hold.angle,
            direction: [1.0, 0.0],
            impulse: [x, y, turning],
        };
        if hold.link == Link::Distance {
            loose.find_direction();
            loose.impulse = [dot(loose.direction, [x, y]), 0.0, 0.0];
        }
        loose
    }

    /// Force on the second body.
    pub(super) fn force(&self, h: f64) -> [f32; 3] {
        let [x, y, turning] = self.impulse;
        let [x, y] =
            if self.link == Link::Distance { [self.direction[0] * x, self.direction[1] * x] } else { [x, y] };
        [x, y, turning].map(|impulse| (impulse / h) as f32)
    }

    fn apart(&self) -> Vector {
        let [a, b] = self.sides.map(|side| plus(side.end.place, side.end.arm, 1.0));
        plus(b, a, -1.0)
    }

    /// Answers the distance of the anchors.
    fn find_direction(&mut self) -> f64 {
        let apart = self.apart();
        let distance = dot(apart, apart).sqrt();
        if distance > 0.0 {
            self.direction = [apart[0] / distance, apart[1] / distance];
        }
        distance
    }

    /// Bodies have moved in a substep.
    pub(super) fn advance(&mut self, hot: &[Hot], h: f64) {
        let mut angles = [0.0; 2];
        for (side, turning) in self.sides.iter_mut().zip(&mut angles) {
            let [x, y, angle] = match side.end.body {
                0 => side.end.velocity.map(|velocity| velocity * h),
                body => {
                    let [x, y, angle, _] = hot[body as usize].step.map(f64::from);
                    [x, y, angle]
                }
            };
            side.end.place = plus(side.end.place, [x, y], 1.0);
            side.end.arm = turned(turn(angle), side.end.arm);
            *turning = angle;
        }
        self.angle += angles[1] - angles[0];
    }

    /// The impulses so far act: at the beginning of a step.
    pub(super) fn warm(&self, warm: &mut [[f32; 4]]) {
        let [x, y, turning] = self.impulse;
        let (linear, angular) = match self.link {
            Link::Distance => ([self.direction[0] * x, self.direction[1] * x], 0.0),
            _ => ([x, y], turning),
        };
        for (side, sign) in self.sides.iter().zip([-1.0, 1.0]) {
            let [mass, inertia] = side.inverses;
            let change = [
                sign * mass * linear[0],
                sign * mass * linear[1],
                sign * inertia * (cross(side.end.arm, linear) + angular),
            ];
            let of = &mut warm[side.end.body as usize];
            (0..3).for_each(|i| of[i] += change[i] as f32);
        }
    }

    /// One pass.
    pub(super) fn solve(&mut self, hold: &Hold, hot: &mut [Hot], h: f64, pass: Pass) {
        let mut velocities = self.sides.map(|side| match side.end.body {
            0 => side.end.velocity,
            body => {
                let [x, y, spin, _] = hot[body as usize].velocity.map(f64::from);
                [x, y, spin]
            }
        });
        match self.link {
            Link::Distance => {
                let distance = self.find_direction();
                let row = self.row(self.direction, bounded(distance, hold), hold.most);
                self.solve_row(0, &row, hold, &mut velocities, h, pass);
            }
            Link::Angle => self.solve_angle(hold, &mut velocities, h, pass),
            _ => {
                let apart = self.apart();
                // The greatest impulse of a weld is that of its angle.
                let most = if self.link == Link::Point { hold.most } else { f64::MAX };
                for (at, direction) in [[1.0, 0.0], [0.0, 1.0]].into_iter().enumerate() {
                    let row = self.row(direction, Error::Of(apart[at]), most);
                    self.solve_row(at, &row, hold, &mut velocities, h, pass);
                }
                if self.link == Link::Weld {
                    self.solve_angle(hold, &mut velocities, h, pass);
                }
            }
        }
        for (side, [x, y, spin]) in self.sides.iter().zip(velocities) {
            if side.end.body != 0 {
                let velocity = &mut hot[side.end.body as usize].velocity;
                [velocity[0], velocity[1], velocity[2]] = [x as f32, y as f32, spin as f32];
            }
        }
    }

    fn solve_angle(&mut self, hold: &Hold, velocities: &mut [[f64; 3]; 2], h: f64, pass: Pass) {
        let row =
            Row { direction: [0.0; 2], arms: [1.0; 2], error: bounded(self.angle, hold), most: hold.most };
        self.solve_row(2, &row, hold, velocities, h, pass);
    }

    fn row(&self, direction: Vector, error: Error, most: f64) -> Row {
        Row { direction, arms: self.sides.map(|side| dot(spun(side.end.arm), direction)), error, most }
    }

    fn solve_row(
        &mut self,
        at: usize,
        row: &Row,
        hold: &Hold,
        velocities: &mut [[f64; 3]; 2],
        h: f64,
        pass: Pass,
    ) {
        let along = |[x, y, spin]: [f64; 3], arm: f64| dot([x, y], row.direction) + spin * arm;
        let speed = along(velocities[1], row.arms[1]) - along(velocities[0], row.arms[0]);
        let square = dot(row.direction, row.direction);
        let weight = |side: &Side, arm: f64| side.inverses[0] * square + side.inverses[1] * arm * arm;
        let inverse = weight(&self.sides[0], row.arms[0]) + weight(&self.sides[1], row.arms[1]);
        if inverse <= 0.0 {
            return;
        }
        let (wanted, low, high) = row.error.asks(self, hold, h, pass, row.most);
        let old = if self.impulse[at] < low || self.impulse[at] > high { 0.0 } else { self.impulse[at] };
        let missing = wanted - speed - self.softness * old;
        let impulse = (old + missing / (inverse + self.softness)).clamp(low, high);
        let change = impulse - self.impulse[at];
        self.impulse[at] = impulse;
        for ((velocity, side), (arm, sign)) in
            velocities.iter_mut().zip(&self.sides).zip(row.arms.into_iter().zip([-1.0, 1.0]))
        {
            let [mass, inertia] = side.inverses;
            velocity[0] += sign * change * mass * row.direction[0];
            velocity[1] += sign * change * mass * row.direction[1];
            velocity[2] += sign * change * inertia * arm;
        }
    }
}

/// Where a number is that has to be in a range.
fn bounded(value: f64, hold: &Hold) -> Error {
    let [low, high] = hold.range;
    if low >= high {
        Error::Of(value - low)
    } else if value - low < high - value {
        Error::Room(value - low, 1.0)
    } else {
        Error::Room(high - value, -1.0)
    }
}

impl Error {
    /// The speed that is asked for, and the least and greatest impulse.
    fn asks(&self, joint: &Loose, hold: &Hold, h: f64, pass: Pass, most: f64) -> (f64, f64, f64) {
        match *self {
            Error::Of(error) if joint.softness > 0.0 => (-error * joint.rate, -most, most),
            Error::Of(_) if pass == Pass::Rest => (0.0, -most, most),
            Error::Of(error) => (-error / h, -most, most),
            Error::Room(room, sign) => {
                // Until the limit there is as much way as there is room.
                let beyond = if -room > hold.slop { -room - hold.slop } else { 0.0 };
                let speed = match pass {
                    _ if room >= 0.0 => -room / h,
                    Pass::Correct => UNDONE * beyond / h,
                    Pass::Rest => 0.0,
                };
                let (low, high) = if sign > 0.0 { (0.0, most) } else { (-most, 0.0) };
                (sign * speed, low, high)
            }
        }
    }
}
