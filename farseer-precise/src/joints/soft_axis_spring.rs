//! A servo along an axis as a row of the iterative solver: a spring [along an axis](super::implicit_spring_row) that turns with
//! body A, of a prismatic joint.

use super::super::bodies::{BodySet, MotionState};
use super::super::direct_solver::joint::ACROSS;
use super::super::direct_solver::mat3::Vec3;
use super::implicit_spring_row::ImplicitSpringRow;
use super::indices::JointIndex;
use super::soft_law::{clamp_symmetric, min};
use super::soft_pair::SpringBodyPair;
use super::springs::SpringConstraint;

/// A servo along an axis as a row of the iterative solver.
#[derive(Debug, Clone, Copy)]
pub(super) struct SoftAxisSpring {
    /// The two bodies of the joint, with relative pose and Jacobian.
    pair: SpringBodyPair,
    /// Row along the axis.
    row: ImplicitSpringRow,
    /// Inverse effective mass of the row, 1/(mass units).
    inverse_effective_mass: f64,
    /// Impulse of a substep per stretch, h k: mass units/s.
    impulse_per_stretch: f64,
    /// Position along the axis at which the stretch is 0, length units.
    rest_position: f64,
    /// Largest impulse of a substep, >= 0: mass units * length units/s.
    max_impulse: f64,
    /// The joint whose servo the spring is.
    joint: Option<JointIndex>,
    /// Sum of the impulses of the update so far on body B along x and y, mass units * length units/s.
    total_impulse: [f64; 2],
}

impl SoftAxisSpring {
    /// Returns the servo at the start of an update with substeps of `h` seconds.
    ///
    /// The warm-start impulse is the impulse of the stretch. It is limited so that it changes no relative velocity by more than
    /// `max_speed` length units/s.
    pub(super) fn new(constraint: &SpringConstraint, bodies: &BodySet, h: f64, max_speed: f64) -> Self {
        let frame = constraint.frame();
        let mut spring = SoftAxisSpring {
            pair: SpringBodyPair::new(constraint.ends(), frame, bodies),
            row: ImplicitSpringRow {
                impulse_per_velocity: h * (constraint.row_damping(h) + h * constraint.stiffness),
                ..ImplicitSpringRow::default()
            },
            inverse_effective_mass: 0.0,
            impulse_per_stretch: h * constraint.stiffness,
            rest_position: frame.axis_offset() - constraint.stretch,
            max_impulse: constraint.max_torque * h,
            joint: constraint.joint,
            total_impulse: [0.0; 2],
        };
        spring.update_row();
        let most = min(spring.max_impulse, max_speed / spring.inverse_effective_mass);
        spring.row.impulse = clamp_symmetric(-spring.row.stretch_impulse, most);
        spring
    }

    /// Updates the stretch impulse and the effective mass after the pose in `pair` has changed.
    fn update_row(&mut self) {
        self.inverse_effective_mass = self.pair.inverse_effective_mass()[ACROSS][ACROSS];
        self.row.stretch_impulse =
            self.impulse_per_stretch * (self.pair.frame.axis_offset() - self.rest_position);
    }

    /// Returns the accumulated impulse on body B in the rows of `pair`: mass units * length units/s.
    fn row_impulses(&self) -> Vec3 {
        [0.0, 0.0, self.row.impulse]
    }

    /// Adds the velocity changes by the accumulated impulse to `sums`, the warm-start sums by body index.
    pub(super) fn add_warm_start(&self, sums: &mut [[f32; 4]]) {
        self.pair.add_warm_start(sums, self.pair.velocity_changes(self.row_impulses()));
    }

    /// Solves the row once, in the phase with bias. Changes the velocities in `states`.
    pub(super) fn solve(&mut self, states: &mut [MotionState]) {
        let mut velocities = self.pair.velocities(states);
        let speed = self.pair.jacobian.relative_velocities(velocities[0], velocities[1])[ACROSS];
        let change = self.row.solve(speed, self.inverse_effective_mass, self.max_impulse);
        self.pair.apply_impulses(&mut velocities, [0.0, 0.0, change]);
        self.pair.store_velocities(states, velocities);
    }

    /// Updates relative pose and row after the bodies have moved in a substep.
    pub(super) fn advance(&mut self, bodies: &mut BodySet) {
        self.pair.advance(bodies, self.row_impulses());
        self.update_row();
    }

    /// Adds the impulse of this substep to the sum of the update.
    pub(super) fn accumulate_impulse(&mut self) {
        (0..2).for_each(|i| self.total_impulse[i] += self.row.impulse * self.pair.frame.axis[i]);
    }

    /// Returns the joint of the servo, with its mean force and torque on body B over an update of `dt` seconds: mass units *
    /// length units/s^2, mass units * length units^2/s^2.
    pub(super) fn servo_force(&self, dt: f64) -> Option<(JointIndex, Vec3)> {
        let [x, y] = self.total_impulse.map(|impulse| impulse / dt);
        self.joint.map(|joint| (joint, [x, y, 0.0]))
    }
}
