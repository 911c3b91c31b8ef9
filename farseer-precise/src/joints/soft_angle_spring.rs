//! An angle spring as rows of the iterative solver: one [on the angle](super::implicit_spring_row) between two bodies, and one
//! on the angular velocity of each body for its damping.
//!
//! The rows depend on angular velocities alone. So the spring needs neither the poses of its bodies nor a Jacobian, and no
//! correction of the warm start after bodies have moved.

use super::super::bodies::{BodySet, MotionState};
use super::super::direct_solver::mat3::Vec3;
use super::implicit_spring_row::ImplicitSpringRow;
use super::indices::JointIndex;
use super::soft_law::{clamp_symmetric, min};
use super::springs::SpringConstraint;
use crate::index::{BodyIndex, DenseIndex, IndexedVec};

/// An angle spring as rows of the iterative solver.
#[derive(Debug, Clone, Copy)]
pub(super) struct SoftAngleSpring {
    /// Indices of A and B in [`BodySet::states`]; [`BodyIndex::PLACEHOLDER`] for bodies without a velocity.
    bodies: [BodyIndex; 2],
    /// Inverse moments of inertia of A and B, 1/(mass units * length units^2); 0 for bodies that are not dynamic or do not
    /// rotate.
    inverse_inertias: [f64; 2],
    /// Row of the angle of B relative to A.
    angle_row: ImplicitSpringRow,
    /// Rows of the damping, on the angular velocities of A and B.
    spin_rows: [ImplicitSpringRow; 2],
    /// Inverse effective mass of `angle_row`, 1/(mass units * length units^2).
    inverse_effective_mass: f64,
    /// Impulse of a substep per radian, h k: mass units * length units^2/s.
    impulse_per_stretch: f64,
    /// Stretch: angle of B relative to A, without the rest angle. Unit: radians.
    stretch: f64,
    /// Largest impulse of `angle_row` in a substep, >= 0: mass units * length units^2/s.
    max_impulse: f64,
    /// The joint whose servo the spring is; `None` for a spring of the game.
    joint: Option<JointIndex>,
    /// Sum of the impulses of `angle_row` in the update so far: mass units * length units^2/s.
    total_impulse: f64,
}

impl SoftAngleSpring {
    /// Returns the spring at the start of an update with substeps of `h` seconds.
    ///
    /// The warm-start impulse is the impulse of the stretch. It is limited so that it changes no relative angular velocity by
    /// more than `max_spin` radians/s.
    pub(super) fn new(constraint: &SpringConstraint, bodies: &BodySet, h: f64, max_spin: f64) -> Self {
        let is_listed = |pose: BodyIndex| pose.position() < bodies.states.len();
        let inverse_inertias = [0, 1].map(|side| match constraint.ends[side].body {
            BodyIndex::PLACEHOLDER => 0.0,
            body => f64::from(bodies.inverse_mass_inertia[body][1]),
        });
        let damping = h * constraint.spin_damping();
        let mut spring = SoftAngleSpring {
            bodies: [0, 1]
                .map(|side| constraint.ends[side].pose_body)
                .map(|pose| if is_listed(pose) { pose } else { BodyIndex::PLACEHOLDER }),
            inverse_inertias,
            angle_row: ImplicitSpringRow {
                impulse_per_velocity: h * (constraint.row_damping(h) + h * constraint.stiffness),
                ..ImplicitSpringRow::default()
            },
            spin_rows: [ImplicitSpringRow { impulse_per_velocity: damping, ..ImplicitSpringRow::default() };
                2],
            inverse_effective_mass: inverse_inertias[0] + inverse_inertias[1],
            impulse_per_stretch: h * constraint.stiffness,
            stretch: constraint.stretch,
            max_impulse: constraint.max_torque * h,
            joint: constraint.joint,
            total_impulse: 0.0,
        };
        spring.update_stretch_impulse();
        let most = min(spring.max_impulse, max_spin / spring.inverse_effective_mass);
        spring.angle_row.impulse = clamp_symmetric(-spring.angle_row.stretch_impulse, most);
        spring
    }

    /// Sets the impulse of the stretch to that of the present stretch.
    fn update_stretch_impulse(&mut self) {
        self.angle_row.stretch_impulse = self.impulse_per_stretch * self.stretch;
    }

    /// Adds the changes of angular velocity by the accumulated impulse of the angle to `sums`, the warm-start sums.
    ///
    /// The spin rows are left out: their impulses follow from the velocities of each substep.
    pub(super) fn add_warm_start(&self, sums: &mut IndexedVec<BodyIndex, [f32; 4]>) {
        for (side, sign) in [(0, -1.0), (1, 1.0)] {
            if self.inverse_inertias[side] != 0.0 {
                sums[self.bodies[side]][2] +=
                    (self.inverse_inertias[side] * (sign * self.angle_row.impulse)) as f32;
            }
        }
    }

    /// Solves all rows once, in the phase with bias: first the spin rows, then the row of the angle. Changes the angular
    /// velocities in `states`.
    pub(super) fn solve(&mut self, states: &mut IndexedVec<BodyIndex, MotionState>) {
        let inverses = self.inverse_inertias;
        let mut spins = self.bodies.map(|body| f64::from(states[body].velocity[2]));
        for side in 0..2 {
            let change = self.spin_rows[side].solve(spins[side], inverses[side], f64::INFINITY);
            spins[side] += inverses[side] * change;
        }
        let change = self.angle_row.solve(spins[1] - spins[0], self.inverse_effective_mass, self.max_impulse);
        spins = [spins[0] - inverses[0] * change, spins[1] + inverses[1] * change];
        for side in 0..2 {
            if inverses[side] != 0.0 {
                states[self.bodies[side]].velocity[2] = spins[side] as f32;
            }
        }
    }

    /// Adds the impulse of this substep to the sum of the update.
    pub(super) fn accumulate_impulse(&mut self) {
        self.total_impulse += self.angle_row.impulse;
    }

    /// Returns the joint whose servo the spring is, with its mean force and torque on body B over an update of `dt` seconds:
    /// mass units * length units/s^2, mass units * length units^2/s^2. `None` for a spring of the game.
    pub(super) fn servo_force(&self, dt: f64) -> Option<(JointIndex, Vec3)> {
        self.joint.map(|joint| (joint, [0.0, 0.0, self.total_impulse / dt]))
    }

    /// Updates the stretch after the bodies have moved in a substep.
    pub(super) fn advance(&mut self, bodies: &BodySet) {
        let [a, b] = self.bodies.map(|body| f64::from(bodies.states[body].displacement[2]));
        self.stretch += b - a;
        self.update_stretch_impulse();
    }
}
