//! What a joint outside of trees does to its bodies.

use super::rows::{Error, Row, undone};
use super::{Loose, Side};
use crate::precise::joints::tree::{Node, dot};

/// What a pass asks for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::precise::joints) enum Pass {
    /// Velocities with which errors go, by new impulses.
    Correct,
    /// Velocities with which nothing changes, by new impulses.
    Rest,
}

impl Loose {
    /// How fast a number changes.
    pub(super) fn speed_of(&self, row: &Row, nodes: &[Node], with_ground: bool) -> f64 {
        let of = |side: &Side, arm: f64| {
            let ground = if with_ground { side.end.velocity } else { [0.0; 3] };
            let [x, y, spin] = nodes.get(side.node as usize).map_or(ground, |node| node.velocity);
            dot([x, y], row.direction) + spin * arm
        };
        of(&self.sides[1], row.arms[1]) - of(&self.sides[0], row.arms[0])
    }

    /// Whether a limit is obeyed, and has not had to push.
    pub(super) fn is_idle(&self, row: &Row, nodes: &[Node], h: f64, pass: Pass) -> bool {
        match row.error {
            Error::Of(_) | Error::Speed(_) => false,
            Error::Room(_, sign) => {
                let (wanted, ..) = self.wants(row, h, pass);
                self.impulse[row.at] == 0.0 && sign * (self.speed_of(row, nodes, true) - wanted) >= 0.0
            }
        }
    }

    /// The impulses so far act anew.
    pub(super) fn act_again(&self, nodes: &mut [Node]) {
        let (direction, turning) = self.pushes();
        let arms = self.arms(direction).map(|arm| arm + turning);
        let row = Row { at: 0, direction, arms, error: Error::Of(0.0), most: 0.0, slop: 0.0 };
        self.apply(&row, 1.0, nodes);
    }

    /// Pushes both bodies.
    pub(super) fn apply(&self, row: &Row, impulse: f64, nodes: &mut [Node]) {
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
            Error::Of(error) if pass == Pass::Correct => (-error / h, -most, most),
            Error::Of(_) => (0.0, -most, most),
            Error::Speed(speed) => (speed, -most, most),
            Error::Room(room, sign) => {
                let beyond = if -room > row.slop { -room - row.slop } else { 0.0 };
                let speed = match pass {
                    // Until the limit there is as much way as there is room.
                    _ if room >= 0.0 => -room / h,
                    Pass::Correct => undone(beyond, self.unit) / h,
                    Pass::Rest => 0.0,
                };
                let (low, high) = if sign > 0.0 { (0.0, most) } else { (-most, 0.0) };
                (sign * speed, low, high)
            }
        }
    }

    /// The change of an impulse that a number asks for, with what a push of 1 does to it.
    pub(super) fn change(&mut self, row: &Row, nodes: &[Node], own: f64, (h, pass): (f64, Pass)) -> f64 {
        let (wanted, low, high) = self.wants(row, h, pass);
        let old = self.impulse[row.at];
        let missing = wanted - self.speed_of(row, nodes, true);
        if own.is_nan() || own <= 0.0 {
            return 0.0;
        }
        self.impulse[row.at] = (old + missing / own).clamp(low, high);
        self.impulse[row.at] - old
    }

    /// What a push of 1 does to the number if only the two bodies answer.
    pub(super) fn alone(&self, row: &Row, nodes: &[Node]) -> f64 {
        let of = |side: &Side, arm: f64| {
            nodes
                .get(side.node as usize)
                .map_or(0.0, |node| dot(row.direction, row.direction) / node.mass + arm * arm / node.inertia)
        };
        of(&self.sides[0], row.arms[0]) + of(&self.sides[1], row.arms[1])
    }

    /// Pushes, and the two bodies answer.
    pub(super) fn push_alone(&mut self, row: &Row, nodes: &mut [Node], h: f64, pass: Pass) {
        let own = self.alone(row, nodes);
        let change = self.change(row, nodes, own, (h, pass));
        self.apply(row, change, nodes);
    }
}
