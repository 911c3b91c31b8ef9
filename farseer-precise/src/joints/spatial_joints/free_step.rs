//! Step of a group of joints in three axes without contacts.
//!
//! The tension of a rope makes it stiff against lateral motion, and substeps that are too long for this stiffness overshoot. A
//! group without contacts divides its substeps further, into *parts*. Groups with contacts use the substeps of the contact
//! solver.

use super::super::super::bodies::BodySet;
use super::super::super::scaled_parameters::StepContext;
use super::super::joint_constraint::JointList;
use super::super::soft_law::min;
use super::group_solver::SpatialJointGroup;
use super::joint_state::Velocity4;
use super::row_kind::RowKind;
use super::sparse_ldlt::SparseLdlt;
use crate::parameters::spatial_joints::{
    ROPE_MAX_ENERGY_GAIN, ROPE_MAX_STEP_PARTS, ROPE_MAX_SUBSTEP_PARTS, ROPE_MAX_SUBSTEP_PRODUCTS,
    ROPE_RETRY_FACTOR, ROPE_STABLE_LIMIT_FRACTION, ROPE_TENSION_MARGIN,
};

impl SpatialJointGroup {
    /// Returns the number of parts into which a substep of `h` seconds must be divided, in a step of `dt` seconds. It follows
    /// from the tensions of the last step.
    pub(super) fn required_parts(&self, joints: &JointList, [dt, h]: [f64; 2]) -> u32 {
        let stiffness = self.rows.iter().filter(|row| row.kind == RowKind::Distance).map(|row| {
            let state = &self.joints[row.joint];
            let joint = &joints[state.joint];
            let ([x, y, _], z) = (joint.force, f64::from(joint.force_along_depth));
            let inverse: f64 =
                state.sides.iter().map(|side| side.inverse_mass(self.inverse_masses.borrowed())).sum();
            // Two links pull at each body.
            2.0 * (x * x + y * y + z * z).sqrt() * inverse * h * h / state.distance
        });
        let max_stiffness = stiffness.filter(|stiffness| stiffness.is_finite()).fold(0.0, f64::max);
        (0.25 * ROPE_TENSION_MARGIN * max_stiffness / ROPE_STABLE_LIMIT_FRACTION)
            .sqrt()
            .ceil()
            .clamp(1.0, self.max_parts((dt / h).round()).into()) as u32
    }

    /// Returns the largest number of parts of a substep: [`ROPE_MAX_SUBSTEP_PARTS`], or less if the factorisations of the group
    /// are expensive or the step has many `substeps`.
    fn max_parts(&self, substeps: f64) -> u32 {
        let products = self.ldlt.as_ref().map_or(0, SparseLdlt::product_count);
        // In this order NaN, from a step of no length, is left out.
        let affordable = min(ROPE_MAX_STEP_PARTS / substeps, ROPE_MAX_SUBSTEP_PRODUCTS / products as f64);
        affordable.clamp(1.0, ROPE_MAX_SUBSTEP_PARTS) as u32
    }

    /// Moves a group without contacts through all substeps of a step.
    ///
    /// An impulsive tension is known only after it has occurred. A step that does not converge or gains energy is repeated with
    /// [`ROPE_RETRY_FACTOR`] times as many parts per substep.
    pub(in super::super) fn free_step(&mut self, joints: &JointList, bodies: &BodySet, step: &StepContext) {
        if !self.is_contact_free {
            return;
        }
        self.initial_joints.clone_from(&self.joints);
        let max_parts = self.max_parts(step.substeps.into());
        while !self.try_free_step(joints, bodies, step, self.substep_parts >= max_parts) {
            self.joints.clone_from(&self.initial_joints);
            let times = [f64::from(step.dt), f64::from(step.h)];
            self.prepare_rows(joints, times, (ROPE_RETRY_FACTOR * self.substep_parts).min(max_parts));
        }
    }

    /// Moves the group through all substeps of a step. Returns whether all solves converged without a gain of energy.
    ///
    /// With `is_last_attempt` it continues after a failure: position errors are left to later substeps, and gained energy is
    /// removed.
    fn try_free_step(
        &mut self,
        joints: &JointList,
        bodies: &BodySet,
        step: &StepContext,
        is_last_attempt: bool,
    ) -> bool {
        self.load_velocities(bodies);
        self.displacements.clear();
        self.displacements.resize(self.bodies.len(), [0.0; 4]);
        let fraction = 1.0 / f64::from(self.substep_parts);
        let h = f64::from(step.h) * fraction;
        for _ in 0..step.substeps * self.substep_parts {
            self.apply_forces(bodies, fraction);
            let energy = if self.is_passive { self.doubled_kinetic_energy() } else { 0.0 };
            if !self.solve_position_velocities(joints, h, is_last_attempt) {
                if !is_last_attempt {
                    return false;
                }
                self.solve_velocities_only(joints, h);
            }
            self.move_bodies(h);
            self.relax_velocities(joints, h);
            let is_lawful = |energy_after: f64| energy_after <= (1.0 + ROPE_MAX_ENERGY_GAIN) * energy;
            // A NaN compares as a failure.
            if self.is_passive && !is_lawful(self.doubled_kinetic_energy()) {
                if !is_last_attempt {
                    return false;
                }
                self.scale_to_energy(energy);
            }
        }
        true
    }

    /// Adds a fraction (0..=1) of the velocity changes by forces in a substep to the velocities.
    fn apply_forces(&mut self, bodies: &BodySet, fraction: f64) {
        for (velocity, &body) in self.velocities.iter_mut().zip(&self.bodies) {
            let push = bodies.force_delta[body];
            (0..4).for_each(|i| velocity[i] += f64::from(push[i]) * fraction);
        }
    }

    /// Moves the bodies and the anchors of the joints for `h` seconds with the velocities.
    fn move_bodies(&mut self, h: f64) {
        for (way, velocity) in self.displacements.iter_mut().zip(self.velocities.iter()) {
            (0..4).for_each(|i| way[i] += velocity[i] * h);
        }
        self.advance_joints(h);
    }

    /// Returns twice the kinetic energy of the group, mass units * length units^2/s^2.
    fn doubled_kinetic_energy(&self) -> f64 {
        let of = |(velocity, inverse): (&Velocity4, &Velocity4)| {
            let weight =
                |i: usize| if inverse[i] > 0.0 { velocity[i] * velocity[i] / inverse[i] } else { 0.0 };
            (0..4).map(weight).sum::<f64>()
        };
        self.velocities.iter().zip(self.inverse_masses.iter()).map(of).sum()
    }

    /// Scales all velocities of the group so that twice its kinetic energy is `energy` (mass units * length units^2/s^2).
    /// Velocities that are not finite become 0.
    fn scale_to_energy(&mut self, energy: f64) {
        let scale = (energy / self.doubled_kinetic_energy()).sqrt();
        let part = if scale.is_finite() { scale } else { 0.0 };
        for velocity in self.velocities.slice_mut(..self.bodies.len()).iter_mut().flatten() {
            *velocity = if velocity.is_finite() { *velocity * part } else { 0.0 };
        }
    }

    /// Stores velocities and displacements of a group without contacts in `bodies`.
    pub(super) fn store_free_step(&self, bodies: &mut BodySet) {
        if !self.is_contact_free {
            return;
        }
        for ((velocity, way), &body) in
            self.velocities.iter().zip(self.displacements.iter()).zip(&self.bodies)
        {
            bodies.states[body].velocity = velocity.map(|velocity| velocity as f32);
            bodies.delta_pose[body] = way.map(|way| way as f32);
        }
    }
}
