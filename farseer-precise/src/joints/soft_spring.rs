//! A spring as rows of the iterative solver, integrated with implicit Euler in each substep of h seconds.
//!
//! With stretch x at the start of the substep and its rate u at the end, the impulse is l = -h (k (x + h u) + c u). With K the
//! inverse effective mass, a row with accumulated impulse l changes it by
//!
//! ```text
//! dl = (-s u - h k x - l) / (1 + s K),   s = h (c + h k)
//! ```
//!
//! The spring is solved in the phase with bias only, once per substep: the relaxation has no position errors to remove.
//!
//! The tension changes its direction with the line between the anchors, and its lever with the arms. This is geometric
//! stiffness (M. Tournier and others, "Stable constrained dynamics", 2015). The excess of it over the stable limit of an
//! explicit force is a row as well.

use super::super::bodies::{BodySet, MotionState};
use super::super::direct_solver::joint::{ACROSS, ALONG, ANGLE};
use super::super::direct_solver::mat3::Vec3;
use super::locked_dofs::LockedDofs;
use super::soft_law::{clamp_symmetric, min};
use super::soft_pair::SpringBodyPair;
use super::springs::SpringConstraint;
use super::vec2::dot;
use crate::parameters::direct::STABLE_STIFFNESS;

/// Row of a damped spring with the impulse l = -s u - h k x: velocity u at the end of a substep of h seconds, stretch x at its
/// start.
#[derive(Debug, Clone, Copy, Default)]
struct ImplicitSpringRow {
    /// Impulse per velocity, s = h (c + h k), >= 0, for stiffness k and damping c: mass units in linear rows, mass units *
    /// length units^2 in angular ones.
    impulse_per_velocity: f64,
    /// Impulse h k x of the stretch x at the start of the substep: mass units * length units/s, in angular rows mass units *
    /// length units^2/s.
    stretch_impulse: f64,
    /// Accumulated impulse of a substep on body B: mass units * length units/s, in angular rows mass units * length units^2/s.
    impulse: f64,
}

impl ImplicitSpringRow {
    /// Solves the row once at the relative velocity `velocity` (length units/s, in angular rows radians/s). Returns the change
    /// of the impulse: mass units * length units/s, in angular rows mass units * length units^2/s.
    ///
    /// `inverse_mass` is the inverse effective mass, and `limit` the largest absolute impulse, >= 0.
    fn solve(&mut self, velocity: f64, inverse_mass: f64, limit: f64) -> f64 {
        let impulse_error = -self.impulse_per_velocity * velocity - self.stretch_impulse - self.impulse;
        let impulse = clamp_symmetric(
            self.impulse + impulse_error / (1.0 + self.impulse_per_velocity * inverse_mass),
            limit,
        );
        impulse - std::mem::replace(&mut self.impulse, impulse)
    }
}

/// A spring as rows of the iterative solver.
#[derive(Debug, Clone, Copy)]
pub(super) struct SoftSpring {
    /// The two bodies of the spring, with relative pose and Jacobian.
    pair: SpringBodyPair,
    /// Index of the spring's row: ALONG (the line between the anchors) for linear springs, ANGLE for angle springs.
    row: usize,
    /// Row along the line between the anchors, or row of the angle for an angle spring.
    spring_row: ImplicitSpringRow,
    /// Row for the geometric stiffness of the spring across the line between its anchors. The stretch impulse of this row is 0.
    lateral_row: ImplicitSpringRow,
    /// Rows on the angular velocities of A and B: damping of an angle spring, and geometric stiffness due to the distances of
    /// the anchors from the centres of mass.
    spin_rows: [ImplicitSpringRow; 2],
    /// Angular impulse of damping in a substep per angular velocity, mass units * length units^2.
    spin_damping: f64,
    /// Inverse effective masses of the rows along the line, of the angle and across the line, diagonal of K: 1/(mass units), in
    /// the angular row 1/(mass units * length units^2).
    inverse_effective_masses: Vec3,
    /// Impulse of a substep per stretch, h k: mass units/s in linear springs, mass units * length units^2/s in angle springs.
    impulse_per_stretch: f64,
    /// Rest length in length units for linear springs, rest angle in radians for angle springs.
    rest_length: f64,
    /// Largest impulse of `spring_row` in a substep, >= 0: mass units * length units^2/s in angle springs, infinite in linear
    /// springs.
    max_impulse: f64,
    /// Length of a substep, seconds.
    h: f64,
}

impl SoftSpring {
    /// Returns the spring at the start of an update with substeps of `h` seconds.
    ///
    /// The warm-start impulse is the impulse of the stretch. It is limited so that it changes no relative velocity by more than
    /// `max_speed` length units/s. In angle springs the limit is `max_speed` / `lever` radians/s; `lever` is in length units.
    pub(super) fn new(
        constraint: &SpringConstraint,
        bodies: &BodySet,
        h: f64,
        [max_speed, lever]: [f64; 2],
    ) -> Self {
        let (frame, damping) = (constraint.frame(), h * constraint.spin_damping());
        let (row, length) = match frame.locked {
            LockedDofs::Distance => (ALONG, frame.distance()),
            _ => (ANGLE, frame.angle),
        };
        let mut spring = SoftSpring {
            pair: SpringBodyPair::new(constraint.ends(), frame, bodies),
            row,
            spring_row: ImplicitSpringRow {
                impulse_per_velocity: h * (constraint.damping + h * constraint.stiffness),
                ..ImplicitSpringRow::default()
            },
            lateral_row: ImplicitSpringRow::default(),
            spin_rows: [ImplicitSpringRow { impulse_per_velocity: damping, ..ImplicitSpringRow::default() };
                2],
            inverse_effective_masses: [0.0; 3],
            impulse_per_stretch: h * constraint.stiffness,
            rest_length: length - constraint.stretch,
            max_impulse: constraint.max_torque * h,
            spin_damping: damping,
            h,
        };
        spring.update_rows();
        let max_speed = if row == ANGLE { max_speed / lever } else { max_speed };
        let most = min(spring.max_impulse, max_speed / spring.inverse_effective_masses[row]);
        spring.spring_row.impulse = clamp_symmetric(-spring.spring_row.stretch_impulse, most);
        spring
    }

    /// Updates the stretch impulse, effective masses and geometric stiffness after the pose in `pair` has changed.
    fn update_rows(&mut self) {
        let (frame, matrix) = (self.pair.frame, self.pair.inverse_effective_mass());
        self.inverse_effective_masses = std::array::from_fn(|row| matrix[row][row]);
        let is_linear = self.row == ALONG;
        let length = if is_linear { frame.distance() } else { frame.angle };
        self.spring_row.stretch_impulse = self.impulse_per_stretch * (length - self.rest_length);
        if is_linear {
            self.update_geometric_stiffness(length);
        }
    }

    /// Sets the rows of geometric stiffness of a linear spring. `distance` is the distance between its anchors in length units.
    ///
    /// Each row has the stiffness beyond [`STABLE_STIFFNESS`] times the effective mass that it acts on.
    fn update_geometric_stiffness(&mut self, distance: f64) {
        let SpringBodyPair { frame, jacobian, .. } = self.pair;
        let tension = if self.spring_row.stretch_impulse > 0.0 && distance > 0.0 {
            self.h * self.spring_row.stretch_impulse
        } else {
            0.0
        };
        let excess = |stiffness: f64, effective_mass: f64| {
            let rest = stiffness - STABLE_STIFFNESS * effective_mass;
            if rest > 0.0 && rest < f64::INFINITY { rest } else { 0.0 }
        };
        self.lateral_row.impulse_per_velocity =
            excess(tension / distance, 1.0 / self.inverse_effective_masses[ACROSS]);
        let [a, b] = frame.arms.map(|arm| dot(arm, jacobian.normal));
        for (side, outwards) in [a, -b].into_iter().enumerate() {
            let squared_arm = dot(frame.arms[side], frame.arms[side]);
            let slope = excess(tension * outwards, self.pair.inertia_about(side, squared_arm));
            self.spin_rows[side].impulse_per_velocity = self.spin_damping + slope;
        }
    }

    /// Returns the accumulated impulses on body B in the order along the line between the anchors, angle, across that line:
    /// mass units * length units/s, for the angle mass units * length units^2/s.
    ///
    /// The spin rows are left out: they are torques, and a warm start with them does not depend on the pose.
    fn row_impulses(&self) -> Vec3 {
        let mut impulses = [0.0, 0.0, self.lateral_row.impulse];
        impulses[self.row] = self.spring_row.impulse;
        impulses
    }

    /// Adds the velocity changes by the accumulated impulses to `sums`, the warm-start sums by body index.
    pub(super) fn add_warm_start(&self, sums: &mut [[f32; 4]]) {
        self.pair.add_warm_start(sums, self.pair.velocity_changes(self.row_impulses()));
    }

    /// Solves all rows once, in the phase with bias, in the order spin rows, lateral row, spring row. Changes the velocities in
    /// `states`.
    pub(super) fn solve(&mut self, states: &mut [MotionState]) {
        let SoftSpring {
            pair,
            spring_row,
            lateral_row,
            spin_rows,
            inverse_effective_masses,
            row,
            max_impulse,
            ..
        } = self;
        let mut velocities = pair.velocities(states);
        for (side, inverse) in pair.inverse_inertias().into_iter().enumerate() {
            velocities[side][2] +=
                inverse * spin_rows[side].solve(velocities[side][2], inverse, f64::INFINITY);
        }
        for (elastic, row, most) in [(lateral_row, ACROSS, f64::INFINITY), (spring_row, *row, *max_impulse)] {
            let speed = pair.jacobian.relative_velocities(velocities[0], velocities[1])[row];
            let mut change = [0.0; 3];
            change[row] = elastic.solve(speed, inverse_effective_masses[row], most);
            pair.apply_impulses(&mut velocities, change);
        }
        pair.store_velocities(states, velocities);
    }

    /// Updates relative pose and rows after the bodies have moved in a substep.
    pub(super) fn advance(&mut self, bodies: &mut BodySet) {
        self.pair.advance(bodies, self.row_impulses());
        self.update_rows();
    }
}

#[cfg(test)]
mod tests {
    use super::ImplicitSpringRow;

    #[test]
    fn a_spring_row_converges_to_implicit_euler_from_any_initial_impulse() {
        let (k, c, x, h, inverse_mass, free) = (900.0, 3.0, 0.7, 1.0 / 240.0, 0.4, -2.0);
        for begun in [0.0, -1.0, 20.0] {
            let mut row = ImplicitSpringRow {
                impulse_per_velocity: h * (c + h * k),
                stretch_impulse: h * k * x,
                impulse: begun,
            };
            // The initial impulse has changed the velocity already, as a warm start does.
            let speed = free + inverse_mass * begun;
            let after = speed + inverse_mass * row.solve(speed, inverse_mass, f64::INFINITY);
            let law = -h * (k * (x + h * after) + c * after);
            assert!((row.impulse - law).abs() < 1e-12, "{} instead of {law}", row.impulse);
        }
    }
}
