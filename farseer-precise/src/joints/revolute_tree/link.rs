//! A revolute link in a step: its state at the start, its part of the articulated-body algorithm, and its motion.

use wide::f32x4;

use super::super::articulated_inertia::{ArticulatedInertia, ArticulatedMomentum};
use super::super::joint_constraint::{JointConstraint, JointList};
use super::super::locked_dofs::LockedDofs;
use super::super::rotation::{cos_sin, nonlinear_rotation};
use super::super::substep_plan::{clamped_remainder, momentum_carrying_stiffness, predict_spin_change};
use super::super::vec2::{Vec2, add_scaled, cross, dot, perp, rotate};
use super::RevoluteLink;
use crate::bodies::BodySet;
use crate::index::{BodyIndex, DenseIndex};
use crate::parameters::joints::STIFFNESS_JUMP_RATIO;

impl RevoluteLink {
    /// Copies pose and velocity of the body to the link, and computes arms, joint error, geometric stiffness and predicted
    /// change of the angular velocity.
    ///
    /// Stiffness and change follow from the joint force of the last step; they are those of an undivided step of `dt` seconds.
    /// The contributions of the parent's side are added to `parent`. The change is computed if the articulation
    /// [`is_balanced`](super::super::substep_plan::SubstepPlan::is_energy_balanced).
    #[inline(always)]
    pub(super) fn begin_step(
        &mut self,
        parent: Option<&mut RevoluteLink>,
        constraints: &mut JointList,
        bodies: &BodySet,
        (dt, is_balanced): (f64, bool),
    ) {
        self.load_body(bodies);
        let Some(parent) = parent else {
            // Rotating a zero arm could flip the sign of a zero.
            self.arm = [0.0; 2];
            return;
        };
        let constraint = &mut constraints[self.joint];
        self.attach_to_parent(parent, constraint, bodies);
        let force = [constraint.force[0] * self.sign, constraint.force[1] * self.sign];
        self.geometric_stiffness = dt * dt * dot(self.arm, force);
        parent.geometric_stiffness -= dt * dt * dot(self.parent_arm, force);
        if is_balanced {
            self.joint_spin_change = cross(self.arm, force);
            parent.joint_spin_change -= cross(self.parent_arm, force);
        }
    }

    /// Copies pose and velocity of the body to the link, and sets all sums of the step to 0.
    #[inline(always)]
    pub(super) fn load_body(&mut self, bodies: &BodySet) {
        let body = self.body.position();
        if self.body != BodyIndex::PLACEHOLDER {
            let [x, y, c, s] = bodies.poses[BodyIndex::new(body)].map(f64::from);
            let [vx, vy, spin, _] = bodies.initial_velocity[BodyIndex::new(body)];
            (self.position, self.rotation) = ([x, y], [c, s]);
            self.velocity = [vx, vy, spin].map(f64::from);
        }
        (self.delta_pose, self.total_impulse, self.geometric_stiffness, self.initial_error) =
            ([0.0; 3], [0.0; 2], 0.0, 0.0);
        self.joint_spin_change = 0.0;
    }

    /// Computes the arms and the joint error, and stores error and first arm in the joint. A fixed parent takes position and
    /// velocity from its anchor.
    #[inline(always)]
    pub(super) fn attach_to_parent(
        &mut self,
        parent: &mut RevoluteLink,
        constraint: &mut JointConstraint,
        bodies: &BodySet,
    ) {
        self.arm = rotate(self.rotation, self.anchor);
        if parent.locked == LockedDofs::Fixed {
            let anchor = &mut constraint.anchors[usize::from(self.is_first)];
            anchor.update(bodies);
            (parent.position, parent.velocity, self.parent_arm) =
                (anchor.position, anchor.velocity, anchor.arm);
        } else {
            self.parent_arm = rotate(parent.rotation, self.parent_anchor);
        }
        let offset = self.anchor_offset(parent);
        self.initial_error = dot(offset, offset).sqrt();
        constraint.error = self.initial_error as f32;
        constraint.first_arm = if self.is_first { self.arm } else { self.parent_arm };
    }

    /// Converts the quantities that refer to an undivided step or a solver substep, so that they refer to the articulation's
    /// substeps: geometric stiffness, predicted change and forces. Adds the velocity change by forces that act in full at the
    /// start of the step.
    ///
    /// `dt` is the step in seconds; `parts` and `substeps` are the numbers of substeps of the articulation and of the solver.
    /// The predicted change is converted if the articulation
    /// [`is_balanced`](super::super::substep_plan::SubstepPlan::is_energy_balanced).
    #[inline(always)]
    pub(super) fn scale_to_substep(
        &mut self,
        bodies: &BodySet,
        (dt, parts, substeps): (f32, f32, f32),
        is_balanced: bool,
    ) {
        self.geometric_stiffness *= 1.0 / f64::from(parts * parts);
        if is_balanced {
            self.joint_spin_change *= 1.0 / f64::from(parts);
        }
        self.set_added_stiffness(self.excess_stiffness());
        if self.body != BodyIndex::PLACEHOLDER {
            let [force_delta, force_position_delta] =
                [&bodies.force_delta, &bodies.force_position_delta].map(|of| f32x4::new(of[self.body]));
            let initial_kick = force_position_delta * f32x4::splat(2.0 / dt);
            let push = (force_delta * f32x4::splat(substeps) - initial_kick) * f32x4::splat(1.0 / parts);
            let ([x, y, spin, _], at_once) = (push.to_array().map(f64::from), initial_kick.to_array());
            self.force_delta = [x, y, spin];
            (0..3).for_each(|i| self.velocity[i] += f64::from(at_once[i]));
        }
    }

    /// Adds the fraction `share` (0..=1) of the velocity change by applied forces in a substep to the velocity (a kick), and
    /// predicts the angular velocity after the joints have acted.
    #[inline(always)]
    pub(super) fn apply_forces(&mut self, share: f64, predicts_spin: bool) {
        (0..3).for_each(|i| self.velocity[i] += share * self.force_delta[i]);
        let joint_spin_change = if predicts_spin {
            predict_spin_change(self.joint_spin_change, self.geometric_stiffness, self.stable_stiffness)
        } else {
            0.0
        };
        self.predicted_spin = self.velocity[2] + share * joint_spin_change;
    }

    /// Sets rotation, inertia and momentum of the single body for a substep of `h` seconds.
    #[inline(always)]
    pub(super) fn prepare_substep(&mut self, h: f64) {
        self.rotation = nonlinear_rotation(self.predicted_spin * h);
        self.init_own();
    }

    /// Computes the target velocity with which the joint holds at the end of a substep: the predicted error of the anchors
    /// times `rate`.
    ///
    /// `rate` is -1 / (seconds of the substep). `max_correction` is the largest error that is corrected in the substep, in
    /// length units.
    #[inline(always)]
    pub(super) fn set_target_velocity(&mut self, parent: &RevoluteLink, (rate, max_correction): (f64, f64)) {
        let error = self.anchor_offset(parent);
        let predicted_anchor = add_scaled(self.position, rotate(self.rotation, self.arm), 1.0);
        let mut predicted_error = add_scaled(
            predicted_anchor,
            add_scaled(parent.position, rotate(parent.rotation, self.parent_arm), 1.0),
            -1.0,
        );
        let size = dot(error, error);
        if size > max_correction * max_correction {
            predicted_error =
                add_scaled(predicted_error, error, -clamped_remainder(size.sqrt(), max_correction));
        }
        self.target_velocity = [predicted_error[0] * rate, predicted_error[1] * rate];
    }

    /// Sets inertia and momentum to those of the single body about its joint with the parent.
    #[inline(always)]
    pub(super) fn init_own(&mut self) {
        self.articulated_inertia =
            ArticulatedInertia::of_body(self.mass, self.inertia + self.added_stiffness, self.arm);
        self.momentum = ArticulatedMomentum::of_body(
            self.mass,
            self.inertia + self.momentum_stiffness,
            self.arm,
            self.velocity,
        );
    }

    /// Adds inertia and momentum of the link's subtree to those of the parent, with the rotation about the joint eliminated.
    /// Backward pass of the articulated-body algorithm.
    #[inline(always)]
    pub(super) fn propagate_up(&mut self, parent: &mut RevoluteLink) {
        let lever = add_scaled(self.parent_arm, parent.arm, -1.0);
        let ArticulatedInertia { mass, coupling, rotational } = self.articulated_inertia;
        self.inverse_rotational = 1.0 / rotational;
        let reduced_mass = mass.with_outer_product(coupling, -self.inverse_rotational);
        let reduced_momentum =
            add_scaled(self.momentum.linear, coupling, -self.momentum.angular * self.inverse_rotational);
        (self.articulated_inertia.mass, self.momentum.linear) = (reduced_mass, reduced_momentum);
        parent.articulated_inertia.add_point_mass(&reduced_mass, lever);
        parent.momentum.add_at(
            add_scaled(reduced_momentum, reduced_mass.mul_vec(self.target_velocity), -1.0),
            0.0,
            lever,
        );
    }

    /// Computes the velocity of a root at its centre of mass from the momentum and inertia of its tree; a fixed root keeps its
    /// velocity.
    #[inline(always)]
    pub(super) fn solve_root(&mut self) {
        self.joint_velocity = if self.locked == LockedDofs::Free {
            self.articulated_inertia.unconstrained_velocity(&self.momentum)
        } else {
            self.velocity
        };
    }

    /// Computes the velocity of the body at its joint, and the joint impulse, from the parent's velocity. Forward pass of the
    /// articulated-body algorithm.
    #[inline(always)]
    pub(super) fn propagate_down(&mut self, parent: &RevoluteLink) {
        let [x, y, spin] = parent.joint_velocity;
        let lever = add_scaled(self.parent_arm, parent.arm, -1.0);
        let at_joint = add_scaled(add_scaled([x, y], perp(lever), spin), self.target_velocity, 1.0);
        self.impulse =
            add_scaled(self.articulated_inertia.mass.mul_vec(at_joint), self.momentum.linear, -1.0);
        let spin = (self.momentum.angular - dot(self.articulated_inertia.coupling, at_joint))
            * self.inverse_rotational;
        self.joint_velocity = [at_joint[0], at_joint[1], spin];
    }

    /// Forward pass of a substep of `h` seconds: computes the velocity of the body, the joint impulse, and the geometric stiffness
    /// of body and parent. Returns whether one of these [has jumped](Self::stiffness_jumped).
    #[inline(always)]
    pub(super) fn solve(&mut self, parent: Option<&mut RevoluteLink>, h: f64) -> bool {
        let mut may_have_jump = false;
        if let Some(parent) = parent {
            self.propagate_down(parent);
            self.set_stiffness(h);
            parent.geometric_stiffness -= h * dot(self.parent_arm, self.impulse);
            may_have_jump |= parent.stiffness_jumped();
        } else {
            self.solve_root();
            self.set_stiffness(h);
        }
        may_have_jump | self.stiffness_jumped()
    }

    /// Returns the solved velocity of the centre of mass, and the angular velocity: x and y in length units/s, angular in
    /// radians/s.
    #[inline(always)]
    pub(super) fn origin_velocity(&self) -> [f64; 3] {
        let [x, y, spin] = self.joint_velocity;
        let [x, y] = add_scaled([x, y], perp(self.arm), -spin);
        [x, y, spin]
    }

    /// Returns the displacement since the step began, after `h` more seconds with the velocity `velocity`: x and y in length
    /// units, rotation in radians.
    #[inline(always)]
    pub(super) fn delta_pose_after(&self, velocity: [f64; 3], h: f64) -> [f64; 3] {
        std::array::from_fn(|i| self.delta_pose[i] + velocity[i] * h)
    }

    /// Sets the velocity of the link to the solved one, and adds the joint impulse to `total_impulse`, the sum of the step.
    #[inline(always)]
    pub(super) fn apply_solution(&mut self) {
        self.velocity = self.origin_velocity();
        self.total_impulse = add_scaled(self.total_impulse, self.impulse, 1.0);
    }

    /// Stores the change of the angular velocity by joints in this substep, which predicts the change in the next one. `share`
    /// is the fraction of the force kick that the substep had, 0..=1.
    #[inline(always)]
    pub(super) fn record_joint_spin_change(&mut self, predicts_spin: bool, share: f64) {
        if predicts_spin {
            self.joint_spin_change = (self.joint_velocity[2] - self.velocity[2]) / share;
        }
    }

    /// Moves the body with the solved velocity for `h` seconds, and rotates the arms of its joint with the parent.
    #[inline(always)]
    pub(super) fn integrate_position(&mut self, parent: Option<&mut RevoluteLink>, h: f64) {
        self.apply_solution();
        self.delta_pose = self.delta_pose_after(self.velocity, h);
        let [x, y, spin] = self.velocity.map(|velocity| velocity * h);
        self.position = add_scaled(self.position, [x, y], 1.0);
        self.rotation = cos_sin(spin);
        self.arm = rotate(self.rotation, self.arm);
        if let Some(parent) = parent {
            self.parent_arm = rotate(parent.rotation, self.parent_arm);
        }
    }

    /// Sets the geometric stiffness of the body to `h` * dot(`arm`, `impulse`), without the part of its children. Unit: mass
    /// units * length units^2.
    ///
    /// `h` is the substep in seconds, `impulse` the joint impulse of the substep, and `arm` the vector from the centre of mass
    /// to the anchor. A child subtracts `h` * dot(`parent_arm`, `impulse`).
    #[inline(always)]
    pub(super) fn set_stiffness(&mut self, h: f64) {
        self.geometric_stiffness = h * dot(self.arm, self.impulse);
    }

    /// Stores velocity and displacement of the body in `bodies`, and the force of the joint in `constraints`.
    ///
    /// `force` is that on the link's body along x and y, in mass units * length units/s^2.
    #[inline(always)]
    pub(super) fn store(
        &self,
        constraints: &mut JointList,
        bodies: &mut BodySet,
        (velocity, delta_pose, force): ([f64; 3], [f64; 3], Vec2),
    ) {
        if self.body != BodyIndex::PLACEHOLDER {
            let body = self.body.position();
            // Joints in the plane leave the velocity along the depth axis as it is.
            let (stored_velocity, stored_delta_pose) = (
                &mut bodies.states[BodyIndex::new(body)].velocity,
                &mut bodies.delta_pose[BodyIndex::new(body)],
            );
            for i in 0..3 {
                (stored_velocity[i], stored_delta_pose[i]) = (velocity[i] as f32, delta_pose[i] as f32);
            }
        }
        if self.locked.is_joint() {
            let [x, y] = force.map(|force| force * self.sign);
            constraints[self.joint].force = [x, y, 0.0];
        }
    }

    /// Stores the results of the last substep with kick-drift: its velocity and impulse are not in the sums of the step yet.
    /// `h` and `dt` are the substep and the step in seconds.
    #[inline(always)]
    pub(super) fn store_kick_drift(
        &self,
        constraints: &mut JointList,
        bodies: &mut BodySet,
        (h, dt): (f64, f64),
    ) {
        let velocity = self.origin_velocity();
        let total = add_scaled(self.total_impulse, self.impulse, 1.0);
        let force = total.map(|impulse| impulse / dt);
        self.store(constraints, bodies, (velocity, self.delta_pose_after(velocity, h), force));
    }

    /// Begins another solve of the substep with the solution of the last one: predicts its angular velocity, and raises the
    /// added stiffness to the geometric stiffness that it has found if `has_jump` is set.
    #[inline(always)]
    pub(super) fn adopt_solution(&mut self, has_jump: bool) {
        if has_jump {
            self.set_added_stiffness(self.added_stiffness.max(self.excess_stiffness()));
        }
        self.predicted_spin = self.joint_velocity[2];
    }

    /// Sets the added stiffness to `stiffness`, and computes the amount of it that carries momentum. Unit: mass units * length
    /// units^2, >= 0.
    #[inline(always)]
    pub(super) fn set_added_stiffness(&mut self, stiffness: f64) {
        self.jump_stiffness = stiffness + STIFFNESS_JUMP_RATIO * self.stable_stiffness;
        (self.added_stiffness, self.momentum_stiffness) =
            (stiffness, momentum_carrying_stiffness(stiffness, self.stable_stiffness));
    }

    /// Returns the excess of the geometric stiffness over the stable limit. Unit: mass units * length units^2, >= 0; 0 for a
    /// fixed root.
    #[inline(always)]
    pub(super) fn excess_stiffness(&self) -> f64 {
        let excess = self.geometric_stiffness - self.stable_stiffness;
        if excess > 0.0 { excess } else { 0.0 }
    }

    /// Returns whether the geometric stiffness exceeds the added stiffness by more than twice the stable limit. This happens
    /// when a chain snaps taut.
    #[inline(always)]
    pub(super) fn stiffness_jumped(&self) -> bool {
        self.geometric_stiffness > self.jump_stiffness
    }

    /// Returns the vector from the parent's anchor to the body's, in world coordinates. Unit: length units.
    #[inline(always)]
    pub(super) fn anchor_offset(&self, parent: &RevoluteLink) -> Vec2 {
        add_scaled(
            add_scaled(self.position, self.arm, 1.0),
            add_scaled(parent.position, self.parent_arm, 1.0),
            -1.0,
        )
    }
}
