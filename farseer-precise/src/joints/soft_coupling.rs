//! A gear or pulley as a row of the iterative solver. Its Jacobian has another direction for each body, so that it is in no
//! [block](super::soft_block).
//!
//! | joint | position error C | impulses l |
//! |---|---|---|
//! | gear | b - r a - target, with the angles a and b of both bodies and the ratio r | any |
//! | pulley | A + r B - length, with the distances A and B of both anchors from their pulleys | l <= 0: a rope only pulls |
//!
//! The row obeys the [law of soft rows](super::soft_law). A slack rope allows the velocity that makes it taut at the end of the
//! substep.

use super::super::bodies::{BodySet, MotionState};
use super::super::direct_solver::mat3::Vec3;
use super::indices::JointIndex;
use super::joint_constraint::{JointConstraint, JointList};
use super::locked_dofs::LockedDofs;
use super::rotation::cos_sin;
use super::soft_law::RowSoftness;
use super::vec2::{Vec2, add_scaled, cross, dot, rotate};
use crate::index::{BodyIndex, DenseIndex};
use crate::parameters::joints::{JOINT_CORRECTION_SPEED, SOFT_ROW_ANGLE_ERROR};

/// A gear or pulley as a row of the iterative solver. Impulses are those of one substep.
#[derive(Debug, Clone, Copy)]
pub(super) struct SoftCoupling {
    /// The joint.
    joint: JointIndex,
    /// Its pose: anchors, pulleys, ratio, angle and target.
    pose: JointConstraint,
    /// Indices of A and B in [`BodySet::states`]; 0 for bodies without a velocity.
    bodies: [BodyIndex; 2],
    /// For A and B: inverse mass, 1/(mass units), and inverse moment of inertia, 1/(mass units * length units^2); 0 for bodies
    /// that are not dynamic.
    inverses: [[f64; 2]; 2],
    /// Jacobian of the row for A and B: velocity of the row per velocity of the body (x, y, angular).
    jacobian: [Vec3; 2],
    /// Inverse effective mass of the row: 1/(mass units), for a gear 1/(mass units * length units^2).
    inverse_effective_mass: f64,
    /// Position error of the row: radians for a gear; length units for a pulley, negative for a slack rope.
    error: f64,
    /// Largest position error that is corrected in proportion, in the unit of `error`.
    max_error: f64,
    /// Accumulated impulse of the row: mass units * length units/s, for a gear mass units * length units^2/s.
    impulse: f64,
    /// Sum of the impulses of the update so far on body B: x and y in mass units * length units/s, angular in mass units * length
    /// units^2/s.
    total_impulse: Vec3,
}

impl SoftCoupling {
    /// Returns the joint with the index `joint` at the start of an update with substeps of `h` seconds. The force of the last
    /// update becomes its warm start. `length_unit` is that of the simulator.
    pub(super) fn new(
        joint: JointIndex,
        constraint: &JointConstraint,
        bodies: &BodySet,
        (h, length_unit): (f64, f64),
    ) -> Self {
        let is_listed = |pose: BodyIndex| pose.position() < bodies.states.len();
        let max_error = match constraint.locked {
            LockedDofs::Gear => SOFT_ROW_ANGLE_ERROR,
            _ => JOINT_CORRECTION_SPEED * length_unit / RowSoftness::soft(h).bias_rate,
        };
        let mut coupling = SoftCoupling {
            joint,
            pose: *constraint,
            bodies: constraint.anchors.map(|end| match is_listed(end.pose_body) {
                true => end.pose_body,
                false => BodyIndex::PLACEHOLDER,
            }),
            inverses: constraint.anchors.map(|end| match end.body {
                BodyIndex::PLACEHOLDER => [0.0; 2],
                body => bodies.inverse_mass_inertia[body].map(f64::from),
            }),
            jacobian: [[0.0; 3]; 2],
            inverse_effective_mass: 0.0,
            error: 0.0,
            max_error,
            impulse: 0.0,
            total_impulse: [0.0; 3],
        };
        coupling.update_row();
        let ([x, y, torque], b) = (constraint.force, coupling.jacobian[1]);
        let (projected, squared) = match constraint.locked {
            LockedDofs::Gear => (torque, 1.0),
            _ => (x * b[0] + y * b[1], b[0] * b[0] + b[1] * b[1]),
        };
        coupling.impulse = coupling.clamp(if squared > 0.0 { h * projected / squared } else { 0.0 });
        coupling
    }

    /// Sets Jacobian, effective mass and position error to those of the present pose.
    fn update_row(&mut self) {
        (self.jacobian, self.error) = self.pose.coupling_row();
        let of_side = |side: usize| {
            let ([mass, inertia], [x, y, spin]) = (self.inverses[side], self.jacobian[side]);
            mass * (x * x + y * y) + inertia * spin * spin
        };
        self.inverse_effective_mass = of_side(0) + of_side(1);
    }

    /// Returns `impulse` within its bounds: a rope only pulls.
    fn clamp(&self, impulse: f64) -> f64 {
        if self.pose.locked == LockedDofs::Pulley && impulse > 0.0 { 0.0 } else { impulse }
    }

    /// Returns the velocity changes of A and B by an impulse of the row: x and y in length units/s, angular in radians/s.
    fn velocity_changes(&self, impulse: f64) -> [Vec3; 2] {
        [0, 1].map(|side| {
            let ([mass, inertia], [x, y, spin]) = (self.inverses[side], self.jacobian[side]);
            [mass * x * impulse, mass * y * impulse, inertia * spin * impulse]
        })
    }

    /// Adds `changes` of velocity of A and B to `sums`, by body index, for the dynamic bodies.
    fn add_changes(&self, sums: &mut [[f32; 4]], changes: [Vec3; 2]) {
        for (side, change) in changes.into_iter().enumerate() {
            if self.inverses[side] != [0.0; 2] {
                let sum = &mut sums[self.bodies[side].position()];
                (0..3).for_each(|i| sum[i] += change[i] as f32);
            }
        }
    }

    /// Adds the velocity changes by the accumulated impulse to `sums`, the warm-start sums by body index.
    pub(super) fn add_warm_start(&self, sums: &mut [[f32; 4]]) {
        self.add_changes(sums, self.velocity_changes(self.impulse));
    }

    /// Solves the row once with the softness of the phase, in a substep of `h` seconds. Changes the velocities in `states`.
    pub(super) fn solve(&mut self, states: &mut [MotionState], softness: &RowSoftness, h: f64) {
        if self.inverse_effective_mass <= 0.0 {
            return;
        }
        let speed: f64 = (0..2)
            .map(|side| {
                let velocity = states[self.bodies[side].position()].velocity;
                (0..3).map(|i| self.jacobian[side][i] * f64::from(velocity[i])).sum::<f64>()
            })
            .sum();
        let is_slack = self.pose.locked == LockedDofs::Pulley && self.error < 0.0;
        let next = if is_slack {
            self.impulse - (speed + self.error / h) / self.inverse_effective_mass
        } else {
            let error = self.error.clamp(-self.max_error, self.max_error);
            let impulse_error = (speed + softness.bias_rate * error) / self.inverse_effective_mass;
            self.impulse - softness.mass_scale * impulse_error - softness.impulse_scale * self.impulse
        };
        let next = self.clamp(next);
        let change = self.velocity_changes(next - self.impulse);
        self.impulse = next;
        for (side, change) in change.into_iter().enumerate() {
            if self.inverses[side] != [0.0; 2] {
                let velocity = &mut states[self.bodies[side].position()].velocity;
                (0..3).for_each(|i| velocity[i] = (f64::from(velocity[i]) + change[i]) as f32);
            }
        }
    }

    /// Updates pose and row after the bodies have moved in a substep, and corrects the next warm start as springs do.
    pub(super) fn advance(&mut self, bodies: &mut BodySet) {
        let before = self.velocity_changes(self.impulse);
        let steps = self.bodies.map(|body| {
            let [x, y, turned, _] = bodies.states[body].displacement.map(f64::from);
            [x, y, turned]
        });
        self.pose.displace_coupling(steps);
        self.update_row();
        let after = self.velocity_changes(self.impulse);
        let changes = [0, 1].map(|side| std::array::from_fn(|i| before[side][i] - after[side][i]));
        self.add_changes(&mut bodies.warm_started_velocity, changes);
    }

    /// Returns the impulse of this substep on body B: x and y in mass units * length units/s, angular in mass units * length
    /// units^2/s. The torque of a rope about the centre of B is not included.
    fn impulse_on_b(&self) -> Vec3 {
        let [x, y, spin] = self.jacobian[1].map(|part| part * self.impulse);
        [x, y, if self.pose.locked == LockedDofs::Gear { spin } else { 0.0 }]
    }

    /// Adds the impulse of this substep to the sum of the update.
    pub(super) fn accumulate_impulse(&mut self) {
        let impulse = self.impulse_on_b();
        (0..3).for_each(|i| self.total_impulse[i] += impulse[i]);
    }

    /// Stores force and torque on body B in the joint: those of the last substep of `h` seconds, and the mean over the update of
    /// `dt` seconds.
    pub(super) fn store_force(&self, joints: &mut JointList, [dt, h]: [f64; 2]) {
        joints[self.joint].force = self.impulse_on_b().map(|impulse| impulse / h + 0.0);
        joints[self.joint].mean_force = Some(self.total_impulse.map(|impulse| impulse / dt + 0.0));
    }
}

impl JointConstraint {
    /// Returns the Jacobian of a gear or pulley for A and B (x, y, angular), and the position error: radians or length units.
    pub(super) fn coupling_row(&self) -> ([Vec3; 2], f64) {
        if self.locked == LockedDofs::Gear {
            return ([[0.0, 0.0, -self.ratio], [0.0, 0.0, 1.0]], self.angle - self.range[0]);
        }
        let mut error = -self.range[0];
        let rows = [0, 1].map(|side| {
            let (anchor, ratio) = (&self.anchors[side], if side == 0 { 1.0 } else { self.ratio });
            let rope = add_scaled(anchor.anchor_position(), self.pulleys[side], -1.0);
            let length = dot(rope, rope).sqrt();
            error += ratio * length;
            if length <= 0.0 {
                return [0.0; 3];
            }
            let direction = rope.map(|part| part / length);
            [ratio * direction[0], ratio * direction[1], ratio * cross(anchor.arm, direction)]
        });
        (rows, error)
    }

    /// Moves a gear or pulley by the displacements of its bodies A and B: x and y in length units, angle in radians.
    fn displace_coupling(&mut self, steps: [Vec3; 2]) {
        for (anchor, [x, y, turned]) in self.anchors.iter_mut().zip(steps) {
            anchor.position = add_scaled(anchor.position, [x, y] as Vec2, 1.0);
            anchor.arm = rotate(cos_sin(turned), anchor.arm);
        }
        self.angle += steps[1][2] - self.ratio * steps[0][2];
    }
}
