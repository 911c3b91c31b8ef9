//! A linear spring as rows of the iterative solver: one [along the line](super::implicit_spring_row) between its anchors, and
//! rows for its geometric stiffness.
//!
//! The tension changes its direction with the line between the anchors, and its lever with the arms. This is geometric
//! stiffness (M. Tournier and others, "Stable constrained dynamics", 2015). The excess of it over the stable limit of an
//! explicit force is a row as well.

use super::super::bodies::{BodySet, MotionState};
use super::super::direct_solver::joint::{ACROSS, ALONG};
use super::super::direct_solver::mat3::Vec3;
use super::implicit_spring_row::ImplicitSpringRow;
use super::soft_law::clamp_symmetric;
use super::soft_pair::SpringBodyPair;
use super::springs::SpringConstraint;
use super::vec2::dot;
use crate::parameters::direct::STABLE_STIFFNESS;

/// A linear spring as rows of the iterative solver.
#[derive(Debug, Clone, Copy)]
pub(super) struct SoftSpring {
    /// The two bodies of the spring, with relative pose and Jacobian.
    pair: SpringBodyPair,
    /// Row along the line between the anchors.
    spring_row: ImplicitSpringRow,
    /// Row for the geometric stiffness of the spring across the line between its anchors. The stretch impulse of this row is 0.
    lateral_row: ImplicitSpringRow,
    /// Rows on the angular velocities of A and B: geometric stiffness due to the distances of the anchors from the centres of
    /// mass.
    spin_rows: [ImplicitSpringRow; 2],
    /// Inverse effective masses of the rows along the line, of the angle and across the line, diagonal of K: 1/(mass units), in
    /// the angular row 1/(mass units * length units^2).
    inverse_effective_masses: Vec3,
    /// Impulse of a substep per stretch, h k: mass units/s.
    impulse_per_stretch: f64,
    /// Rest length, length units.
    rest_length: f64,
    /// Length of a substep, seconds.
    h: f64,
}

impl SoftSpring {
    /// Returns the spring at the start of an update with substeps of `h` seconds.
    ///
    /// The warm-start impulse is the impulse of the stretch. It is limited so that it changes no relative velocity by more than
    /// `max_speed` length units/s.
    pub(super) fn new(constraint: &SpringConstraint, bodies: &BodySet, h: f64, max_speed: f64) -> Self {
        let frame = constraint.frame();
        let mut spring = SoftSpring {
            pair: SpringBodyPair::new(constraint.ends(), frame, bodies),
            spring_row: ImplicitSpringRow {
                impulse_per_velocity: h * (constraint.damping + h * constraint.stiffness),
                ..ImplicitSpringRow::default()
            },
            lateral_row: ImplicitSpringRow::default(),
            spin_rows: [ImplicitSpringRow::default(); 2],
            inverse_effective_masses: [0.0; 3],
            impulse_per_stretch: h * constraint.stiffness,
            rest_length: frame.distance() - constraint.stretch,
            h,
        };
        spring.update_rows();
        let most = max_speed / spring.inverse_effective_masses[ALONG];
        spring.spring_row.impulse = clamp_symmetric(-spring.spring_row.stretch_impulse, most);
        spring
    }

    /// Updates the stretch impulse, effective masses and geometric stiffness after the pose in `pair` has changed.
    fn update_rows(&mut self) {
        let (distance, matrix) = (self.pair.frame.distance(), self.pair.inverse_effective_mass());
        self.inverse_effective_masses = std::array::from_fn(|row| matrix[row][row]);
        self.spring_row.stretch_impulse = self.impulse_per_stretch * (distance - self.rest_length);
        self.update_geometric_stiffness(distance);
    }

    /// Sets the rows of geometric stiffness. `distance` is the distance between its anchors in length units.
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
            self.spin_rows[side].impulse_per_velocity =
                excess(tension * outwards, self.pair.inertia_about(side, squared_arm));
        }
    }

    /// Returns the accumulated impulses on body B in the order along the line between the anchors, angle, across that line:
    /// mass units * length units/s, for the angle mass units * length units^2/s.
    ///
    /// The spin rows are left out: they are torques, and a warm start with them does not depend on the pose.
    fn row_impulses(&self) -> Vec3 {
        [self.spring_row.impulse, 0.0, self.lateral_row.impulse]
    }

    /// Adds the velocity changes by the accumulated impulses to `sums`, the warm-start sums by body index.
    pub(super) fn add_warm_start(&self, sums: &mut [[f32; 4]]) {
        self.pair.add_warm_start(sums, self.pair.velocity_changes(self.row_impulses()));
    }

    /// Solves all rows once, in the phase with bias, in the order spin rows, lateral row, spring row. Changes the velocities in
    /// `states`.
    pub(super) fn solve(&mut self, states: &mut [MotionState]) {
        let SoftSpring { pair, spring_row, lateral_row, spin_rows, inverse_effective_masses, .. } = self;
        let mut velocities = pair.velocities(states);
        for (side, inverse) in pair.inverse_inertias().into_iter().enumerate() {
            velocities[side][2] +=
                inverse * spin_rows[side].solve(velocities[side][2], inverse, f64::INFINITY);
        }
        for (elastic, row) in [(lateral_row, ACROSS), (spring_row, ALONG)] {
            let speed = pair.jacobian.relative_velocities(velocities[0], velocities[1])[row];
            let mut change = [0.0; 3];
            change[row] = elastic.solve(speed, inverse_effective_masses[row], f64::INFINITY);
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
