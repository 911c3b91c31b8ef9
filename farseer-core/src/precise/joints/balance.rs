//! Balance of energy of a free articulation over a step.
//!
//! Joints do no work: the kinetic energy of an articulation changes by the work of the forces on its bodies. The difference is the error of
//! the step. It is second order in the length of a part, and would average out in parts of one length (E. Hairer, C. Lubich, G. Wanner,
//! "Geometric Numerical Integration", 2006, IX): parts that get shorter where bodies turn fast turn it into a drift. Large errors repeat
//! the step in more parts; what is left is projected on the energy (the same, IV.4) by scaling velocities, J s v = s J v = 0. A free
//! articulation is scaled about the rigid motion with its momentum and angular momentum, which it keeps.

use super::tree::{Seated, Vector, cross, dot, plus, spun};
use crate::precise::parameters::joints::{
    ARM_ROUNDING, ENERGY_ERROR_LEFT, ENERGY_ERROR_OF_A_STEP, GAP_OF_A_STEP, GAP_OF_A_WHIP, POSITION_ROUNDING,
    VELOCITY_SCALE,
};

/// A body of an articulation at the end of a step.
#[derive(Debug, Clone, Copy)]
pub(super) struct Moved {
    /// In kg.
    pub(super) mass: f64,
    /// In kg length units².
    pub(super) inertia: f64,
    /// Displacement and rotation in this step, in length units and radians.
    pub(super) path: [f64; 3],
    /// Origin, in length units.
    pub(super) place: Vector,
    /// In length units/s and radians/s.
    pub(super) velocity: [f64; 3],
    /// Change of the velocity by forces in a part of the step, in the same units.
    pub(super) push: [f64; 3],
}

/// A node whose velocity the balance reads and scales.
pub(super) trait InBalance: Seated {
    /// `None` for what is fixed.
    fn moved(&self) -> Option<Moved>;
    /// Sets the velocity of the body.
    fn set_velocity(&mut self, velocity: [f64; 3]);
    /// Work that the joint does in a step of `dt` seconds by closing the gap that rounded positions leave, at most.
    fn work_of_rounding(&self, dt: f64) -> f64;
    /// Speed with which the joint with the parent goes apart, in length units/s.
    fn parting_speed(&self, parent: &Self) -> f64;
    /// Whether the error of its joint when the step began was greater, as a fraction of its arms or in radians.
    fn is_torn(&self, gap: f64) -> bool;
    /// Whether it is fixed, and moves.
    fn is_driven(&self) -> bool;
    /// Whether it is a root that nothing holds.
    fn is_free_root(&self) -> bool;
}

/// The rigid motion with the momentum and the angular momentum of an articulation.
#[derive(Debug, Clone, Copy, Default)]
struct Rigid {
    /// In length units.
    center: Vector,
    /// In length units/s and radians/s.
    velocity: [f64; 3],
    /// In kg length units² / s².
    energy: f64,
}

impl Moved {
    fn kinetic(&self) -> f64 {
        let [x, y, spin] = self.velocity;
        0.5 * (self.mass * (x * x + y * y) + self.inertia * spin * spin)
    }

    /// Work of the forces, which act for parts of `h` seconds.
    fn work(&self, h: f64) -> f64 {
        let ([px, py, turn], [fx, fy, twist]) = (self.path, self.push);
        (self.mass * (fx * px + fy * py) + self.inertia * twist * turn) / h
    }
}

impl Rigid {
    fn of<N: InBalance>(nodes: &[N]) -> Self {
        let bodies = || nodes.iter().filter_map(N::moved);
        let (mut mass, mut moment, mut momentum) = (0.0, [0.0; 2], [0.0; 2]);
        for Moved { mass: m, place, velocity: [x, y, _], .. } in bodies() {
            mass += m;
            (moment, momentum) = (plus(moment, place, m), plus(momentum, [x, y], m));
        }
        let [center, [x, y]] = [moment, momentum].map(|sum| sum.map(|sum| sum / mass));
        let (mut inertia, mut twist) = (0.0, 0.0);
        for body in bodies() {
            let (arm, [vx, vy, spin]) = (plus(body.place, center, -1.0), body.velocity);
            inertia += body.inertia + body.mass * dot(arm, arm);
            twist += body.inertia * spin + body.mass * cross(arm, [vx - x, vy - y]);
        }
        let spin = twist / inertia;
        let energy = 0.5 * (mass * (x * x + y * y) + twist * spin);
        Rigid { center, velocity: [x, y, spin], energy }
    }

    /// The velocity of a body here.
    fn at(&self, place: Vector) -> [f64; 3] {
        let [x, y, spin] = self.velocity;
        let [x, y] = plus([x, y], spun(plus(place, self.center, -1.0)), spin);
        [x, y, spin]
    }
}

/// Greatest gap in length units that rounding leaves between bodies with this origin and joints at this distance from it: that of positions,
/// and of rotations of up to a hundred turns.
pub(super) fn rounded([x, y]: Vector, reach: f64) -> f64 {
    POSITION_ROUNDING * (x.abs() + y.abs()) + ARM_ROUNDING * reach
}

/// An articulation when a step begins, with what forces add at once.
#[derive(Debug, Clone, Copy)]
pub(super) struct Start {
    /// Kinetic energy, in kg length units² / s².
    kinetic: f64,
    /// Greatest energy that joints take from velocities which do not obey them, in the same unit.
    inelastic: f64,
}

impl Start {
    pub(super) fn of<N: InBalance>(nodes: &[N]) -> Self {
        let bodies = || nodes.iter().filter_map(N::moved);
        let kinetic = bodies().map(|body| body.kinetic()).sum();
        let mass: f64 = bodies().map(|body| body.mass).sum();
        let apart = |speed: f64, node: &N| speed.max(node.parting_speed(&nodes[node.parent()]));
        let parting = nodes.iter().fold(0.0, apart);
        Start { kinetic, inelastic: 0.5 * mass * parting * parting }
    }
}

/// Energies of a step, in kg length units² / s².
#[derive(Debug, Clone, Copy)]
pub(super) struct Balance {
    /// Kinetic energy at the end.
    end: f64,
    /// Its excess over that at the beginning and the work of forces.
    excess: f64,
    /// Kinetic energy and sum of the work of forces, which errors are compared with.
    size: f64,
    /// Joints closed gaps, or took energy from velocities that did not obey them: losses are right.
    is_torn: bool,
}

impl Balance {
    /// Of a step of `dt` seconds in parts of `h` seconds. `None` if something drives the articulation, or pushed its bodies apart before.
    pub(super) fn of<N: InBalance>(nodes: &[N], start: Start, [dt, h]: [f64; 2]) -> Option<Self> {
        let is_torn_off = |node: &N| node.is_torn(GAP_OF_A_STEP) && nodes[node.parent()].moved().is_none();
        if nodes.iter().any(|node| node.is_driven() || is_torn_off(node)) {
            return None;
        }
        let of_rounding: f64 = nodes.iter().map(|node| node.work_of_rounding(dt)).sum();
        let (mut end, mut work, mut work_size) = (0.0, 0.0, 0.0);
        for body in nodes.iter().filter_map(N::moved) {
            let of_body = body.work(h);
            (end, work, work_size) = (end + body.kinetic(), work + of_body, work_size + of_body.abs());
        }
        // A joint lifts a body that rounding does not let move in every step: that work is none.
        let excess = end - (start.kinetic + work);
        let excess = if excess.abs() > of_rounding { excess } else { 0.0 };
        let size = start.kinetic.max(end) + work_size;
        let is_torn = nodes.iter().any(|node| node.is_torn(GAP_OF_A_WHIP))
            || start.inelastic > ENERGY_ERROR_LEFT * size;
        Some(Balance { end, excess, size, is_torn })
    }

    /// Whether the step is to be repeated in more parts.
    pub(super) fn is_off(&self) -> bool {
        !self.is_torn && self.excess.abs() > ENERGY_ERROR_OF_A_STEP * self.size
    }

    /// Scales velocities so that the energy is right.
    pub(super) fn restore<N: InBalance>(&self, nodes: &mut [N]) {
        let is_free = nodes.first().is_some_and(N::is_free_root);
        let rigid = if is_free { Rigid::of(nodes) } else { Rigid::default() };
        let inner = self.end - rigid.energy;
        let scale = (1.0 - self.excess / inner).max(0.0).sqrt().min(VELOCITY_SCALE);
        if !(inner > 0.0 && scale.is_finite()) || self.excess == 0.0 || (self.is_torn && scale > 1.0) {
            return;
        }
        for node in nodes {
            if let Some(Moved { velocity, place, .. }) = node.moved() {
                let whole = rigid.at(place);
                node.set_velocity(std::array::from_fn(|i| whole[i] + scale * (velocity[i] - whole[i])));
            }
        }
    }
}
