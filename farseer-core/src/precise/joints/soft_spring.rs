//! A spring in the passes of the iterative solver, integrated with implicit Euler in each substep of h seconds.
//!
//! With x the stretch when the substep begins and u its rate after it, the impulse is l = -h (k (x + h u) + c u). A row with effective
//! mass 1 / K that exerts l now changes it by
//!
//! ```text
//! dl = (-s u - h k x - l) / (1 + s K),   s = h (c + h k)
//! ```
//!
//! A spring acts in the pass before bodies move, once per substep: the pass after that has no positions to answer for.
//!
//! Its tension turns with the line, and with the arms of its bodies. That is geometric stiffness (M. Tournier and others, "Stable constrained
//! dynamics", 2015): the part of it that masses and inertias do not bear in a substep as an explicit force is a row as well.

use super::super::bodies::{Bodies, Hot};
use super::super::direct::block::Triple;
use super::super::direct::joint::{ACROSS, ALONG, ANGLE};
use super::soft_law::{least, within};
use super::soft_pair::SoftPair;
use super::springs::SpringHold;
use super::tree::{Link, dot};
use crate::precise::parameters::direct::STABLE_STIFFNESS;

/// A row that yields: its impulse is `-slope u - pull`.
#[derive(Debug, Clone, Copy, Default)]
struct ElasticRow {
    /// Impulse per velocity, s.
    slope: f64,
    /// Impulse of the stretch when the substep begins, h k x.
    pull: f64,
    impulse: f64,
}

impl ElasticRow {
    /// Solves the row at this relative velocity, with this reciprocal of its effective mass. Answers the change of the impulse.
    fn solve(&mut self, speed: f64, inverse_mass: f64, most: f64) -> f64 {
        let missing = -self.slope * speed - self.pull - self.impulse;
        let impulse = within(self.impulse + missing / (1.0 + self.slope * inverse_mass), most);
        impulse - std::mem::replace(&mut self.impulse, impulse)
    }
}

/// The spring.
#[derive(Debug, Clone, Copy)]
pub(super) struct SoftSpring {
    pair: SoftPair,
    /// Its own row: along the line, or the angle.
    row: usize,
    own: ElasticRow,
    across: ElasticRow,
    /// Resistance of each body to spin, and the impulse of damping per spin.
    spins: [ElasticRow; 2],
    damping: f64,
    /// Reciprocals of effective masses of the rows.
    inverse_masses: Triple,
    /// Impulse of a substep per length unit or radian of stretch, and the length or angle at rest.
    stiffness: f64,
    rest: f64,
    /// Greatest impulse of a substep.
    most: f64,
    h: f64,
}

impl SoftSpring {
    /// The spring at the beginning of an update with substeps of `h` seconds. It begins with the impulse of its stretch, as far as that
    /// makes no more than this speed, in length units/s, or the spin that goes with it.
    pub(super) fn new(hold: &SpringHold, bodies: &Bodies, h: f64, [fastest, lever]: [f64; 2]) -> Self {
        let (frame, damping) = (hold.frame(), h * hold.damping_of_spin());
        let (row, length) = match frame.link {
            Link::Distance => (ALONG, frame.distance()),
            _ => (ANGLE, frame.angle),
        };
        let mut spring = SoftSpring {
            pair: SoftPair::new(hold.ends(), frame, bodies),
            row,
            own: ElasticRow { slope: h * (hold.damping + h * hold.stiffness), ..ElasticRow::default() },
            across: ElasticRow::default(),
            spins: [ElasticRow { slope: damping, ..ElasticRow::default() }; 2],
            inverse_masses: [0.0; 3],
            stiffness: h * hold.stiffness,
            rest: length - hold.stretch,
            most: hold.most * h,
            damping,
            h,
        };
        spring.follow_frame();
        let fastest = if row == ANGLE { fastest / lever } else { fastest };
        let most = least(spring.most, fastest / spring.inverse_masses[row]);
        spring.own.impulse = within(-spring.own.pull, most);
        spring
    }

    /// Stretch and effective masses follow the frame.
    fn follow_frame(&mut self) {
        let (frame, matrix) = (self.pair.frame, self.pair.matrix());
        self.inverse_masses = std::array::from_fn(|row| matrix[row][row]);
        let is_linear = self.row == ALONG;
        let length = if is_linear { frame.distance() } else { frame.angle };
        self.own.pull = self.stiffness * (length - self.rest);
        if is_linear {
            self.resist_turning(length);
        }
    }

    /// Geometric stiffness of a spring of this length.
    fn resist_turning(&mut self, length: f64) {
        let SoftPair { frame, jacobian, .. } = self.pair;
        let tension = if self.own.pull > 0.0 && length > 0.0 { self.h * self.own.pull } else { 0.0 };
        let beyond = |slope: f64, weight: f64| {
            let rest = slope - STABLE_STIFFNESS * weight;
            if rest > 0.0 && rest < f64::INFINITY { rest } else { 0.0 }
        };
        self.across.slope = beyond(tension / length, 1.0 / self.inverse_masses[ACROSS]);
        let [a, b] = frame.arms.map(|arm| dot(arm, jacobian.normal));
        for (side, outwards) in [a, -b].into_iter().enumerate() {
            let reach = dot(frame.arms[side], frame.arms[side]);
            let slope = beyond(tension * outwards, self.pair.inertia_about(side, reach));
            self.spins[side].slope = self.damping + slope;
        }
    }

    /// Impulses of its rows, without those on the spins of single bodies.
    fn impulses(&self) -> Triple {
        let mut impulses = [0.0, 0.0, self.across.impulse];
        impulses[self.row] = self.own.impulse;
        impulses
    }

    /// The impulses so far are to act at the beginning of every substep.
    pub(super) fn warm(&self, warm: &mut [[f32; 4]]) {
        self.pair.warm(warm, self.pair.yields(self.impulses()));
    }

    /// The pass before bodies move.
    pub(super) fn solve(&mut self, hot: &mut [Hot]) {
        let SoftSpring { pair, own, across, spins, inverse_masses, row, most, .. } = self;
        let mut velocities = pair.velocities(hot);
        for (side, inverse) in pair.inverse_inertias().into_iter().enumerate() {
            velocities[side][2] += inverse * spins[side].solve(velocities[side][2], inverse, f64::INFINITY);
        }
        for (elastic, row, most) in [(across, ACROSS, f64::INFINITY), (own, *row, *most)] {
            let speed = pair.jacobian.relative(velocities[0], velocities[1])[row];
            let mut change = [0.0; 3];
            change[row] = elastic.solve(speed, inverse_masses[row], most);
            pair.push(&mut velocities, change);
        }
        pair.write(hot, velocities);
    }

    /// Bodies have moved.
    pub(super) fn advance(&mut self, bodies: &mut Bodies) {
        self.pair.advance(bodies, self.impulses());
        self.follow_frame();
    }
}

#[cfg(test)]
mod tests {
    use super::ElasticRow;

    #[test]
    fn an_elastic_row_has_the_impulse_of_implicit_euler_whatever_it_began_with() {
        let (k, c, x, h, inverse_mass, free) = (900.0, 3.0, 0.7, 1.0 / 240.0, 0.4, -2.0);
        for begun in [0.0, -1.0, 20.0] {
            let mut row = ElasticRow { slope: h * (c + h * k), pull: h * k * x, impulse: begun };
            // The impulse that is there has acted already.
            let speed = free + inverse_mass * begun;
            let after = speed + inverse_mass * row.solve(speed, inverse_mass, f64::INFINITY);
            let law = -h * (k * (x + h * after) + c * after);
            assert!((row.impulse - law).abs() < 1e-12, "{} instead of {law}", row.impulse);
        }
    }
}
