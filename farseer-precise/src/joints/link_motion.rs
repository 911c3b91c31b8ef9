//! Motion of a link in a substep of a free articulation: forces, position, geometric stiffness and joint error.

use super::articulated_body::ArticulatedLink;
use super::energy_balance::{BalancedLink, LinkEndState, max_rounding_error};
use super::locked_dofs::LockedDofs;
use super::rod::RodState;
use super::rotation::cos_sin;
use super::substep_plan::{momentum_carrying_stiffness, predict_spin_change, stable_stiffness};
use super::vec2::{Vec2, add_scaled, cross, dot, perp, rotate};
use crate::bodies::BodySet;
use crate::index::BodyIndex;
use crate::mass::radius_of_gyration;
use crate::parameters::joints::{MAX_ROTATION_ROUNDING, STIFFNESS_JUMP_RATIO};

impl ArticulatedLink {
    /// Adds the fraction `fraction` (0..=1) of the velocity change by applied forces in a substep to the velocity (a kick).
    #[inline(always)]
    pub(super) fn apply_forces(&mut self, fraction: f64) {
        (0..3).for_each(|i| self.velocity[i] += fraction * self.force_delta[i]);
    }

    /// Sets the target velocity of the joint to 0: the velocity is projected on the joints, and position errors stay.
    #[inline(always)]
    pub(super) fn clear_target_velocity(&mut self) {
        self.target_velocity = [0.0; 3];
    }

    /// Moves the body with its velocity for `h` seconds, and rotates the arms and the axis of its joint with the parent.
    #[inline(always)]
    pub(super) fn integrate_position(&mut self, parent: Option<&mut ArticulatedLink>, h: f64) {
        let [x, y, spin] = self.velocity.map(|velocity| velocity * h);
        self.position = add_scaled(self.position, [x, y], 1.0);
        self.delta_pose = [self.delta_pose[0] + x, self.delta_pose[1] + y, self.delta_pose[2] + spin];
        self.rotation = cos_sin(spin);
        self.arm = rotate(self.rotation, self.arm);
        let Some(parent) = parent else { return };
        self.parent_arm = rotate(parent.rotation, self.parent_arm);
        match self.locked {
            LockedDofs::Distance => {
                self.update_axis(parent.position);
            }
            LockedDofs::Line => {
                let first = if self.is_first { self.rotation } else { parent.rotation };
                self.axis = rotate(first, self.axis);
            }
            _ => {}
        }
    }

    /// Converts the quantities that refer to a solver substep or an undivided step, so that they refer to the articulation's
    /// substeps: impulse, geometric stiffness, predicted changes and forces. Adds the velocity change by forces that act in
    /// full at the start of the step.
    ///
    /// `dt` is the step in seconds, and `substeps` the number of the articulation's substeps. `substep_ratio` is the
    /// articulation's substep divided by the solver's substep (dimensionless).
    #[inline(always)]
    pub(super) fn scale_to_substep(
        &mut self,
        bodies: &BodySet,
        (dt, substeps): (f64, f64),
        substep_ratio: f64,
    ) {
        self.impulse = self.impulse.map(|impulse| impulse * substep_ratio);
        self.geometric_stiffness *= 1.0 / (substeps * substeps);
        self.joint_spin_change *= 1.0 / substeps;
        self.added_stiffness = self.excess_stiffness();
        self.rod.begin_substeps(substeps);
        if self.body != BodyIndex::PLACEHOLDER {
            let (force_delta, force_position_delta) =
                (bodies.force_delta[self.body], bodies.force_position_delta[self.body]);
            let (per_half_dt, share) = (2.0 / dt, 1.0 / substeps);
            for i in 0..3 {
                let initial_kick = f64::from(force_position_delta[i]) * per_half_dt;
                self.force_delta[i] = f64::from(force_delta[i]) * substep_ratio - initial_kick * share;
                self.velocity[i] += initial_kick;
            }
        }
    }

    /// Sets the geometric stiffness of the body to `h` * dot(`arm`, `impulse`), and subtracts `h` * dot(`parent_arm`,
    /// `impulse`) from that of the parent. Unit: mass units * length units^2.
    ///
    /// `h` is the substep in seconds, `impulse` the joint impulse of the substep. The arms are the vectors from the centres of
    /// mass to the anchors.
    #[inline(always)]
    pub(super) fn accumulate_stiffness(&mut self, parent: Option<&mut ArticulatedLink>, h: f64) {
        let [x, y, _] = self.impulse;
        self.geometric_stiffness = h * dot(self.arm, [x, y]);
        if let Some(parent) = parent {
            parent.geometric_stiffness -= h * dot(self.parent_arm, [x, y]);
            if self.locked == LockedDofs::Distance {
                let tension = -dot(self.axis, [x, y]);
                self.rod.set_stiffness(h * tension / self.angle_error_or_length);
            }
        }
    }

    /// Returns the velocity of the body's anchor relative to the parent's across the axis of a distance joint, in length
    /// units/s.
    #[inline(always)]
    pub(super) fn velocity_across(&self, parent: &ArticulatedLink) -> f64 {
        let relative =
            add_scaled(self.anchor_velocity(self.arm), parent.anchor_velocity(self.parent_arm), -1.0);
        dot(perp(self.axis), relative)
    }

    /// Predicts the velocity across a distance joint in a repeated solve by that of the last solve. Returns the deviation of that
    /// velocity from the last prediction, as an angular velocity of the rod in radians/s.
    #[inline(always)]
    pub(super) fn predict_rod(&mut self, parent: &ArticulatedLink) -> f64 {
        let deviation = self.rod.predict(self.velocity_across(parent)).abs();
        self.rod_spin(deviation)
    }

    /// Sets axis and stable stiffness of a distance joint at the start of a step. Returns the angular velocity of the rod, in
    /// radians/s, >= 0.
    pub(super) fn begin_rod(&mut self, parent: &ArticulatedLink) -> f64 {
        self.update_axis(parent.position);
        let t = perp(self.axis);
        let inverse_mass = |link: &ArticulatedLink, arm: Vec2| {
            let turned = cross(arm, t);
            if link.body == BodyIndex::PLACEHOLDER {
                0.0
            } else {
                1.0 / link.mass + turned * turned / link.inertia
            }
        };
        let inverse = inverse_mass(self, self.arm) + inverse_mass(parent, self.parent_arm);
        self.rod = RodState::of_mass(inverse.recip());
        self.rod_spin(self.velocity_across(parent).abs())
    }

    /// Returns the angular velocity of a rod whose ends have the relative velocity `across` its axis, length units/s, >= 0. Unit:
    /// radians/s; 0 for a rod of no length, which has no direction.
    #[inline(always)]
    fn rod_spin(&self, across: f64) -> f64 {
        let length = self.angle_error_or_length;
        if across > 0.0 && length > 0.0 { across / length } else { 0.0 }
    }

    /// Returns the velocity of the body's point at the end of `arm`, a vector from the centre of mass. Unit: length units/s.
    #[inline(always)]
    pub(super) fn anchor_velocity(&self, arm: Vec2) -> Vec2 {
        let [x, y, spin] = self.velocity;
        add_scaled([x, y], perp(arm), spin)
    }

    /// Returns the predicted change of the body's angular velocity by joints in this substep. Unit: radians/s.
    #[inline(always)]
    pub(super) fn predicted_spin_change(&self) -> f64 {
        predict_spin_change(self.joint_spin_change, self.geometric_stiffness, self.stable_stiffness())
    }

    /// Computes the angular impulse of the joint about the body's centre of mass, and subtracts the reaction from the parent's
    /// sum.
    ///
    /// Both are stored in `joint_spin_change` until they are divided by the moments of inertia. Unit: mass units * length
    /// units^2/s.
    #[inline(always)]
    pub(super) fn accumulate_joint_torque(&mut self, parent: Option<&mut ArticulatedLink>) {
        let [x, y, angular_impulse] = self.impulse;
        self.joint_spin_change = cross(self.arm, [x, y]) + angular_impulse;
        if let Some(parent) = parent {
            let slide =
                if self.locked == LockedDofs::Line { self.anchor_offset(parent.position) } else { [0.0; 2] };
            parent.joint_spin_change -=
                cross(add_scaled(self.parent_arm, slide, 1.0), [x, y]) + angular_impulse;
        }
    }

    /// Returns the length by which linear joint errors are divided, without the length of a distance joint: the sum of both arms
    /// and the radius of gyration. Unit: length units.
    fn linear_error_scale(&self, parent: &ArticulatedLink) -> f64 {
        let [arm, parent_arm] = [self.arm, self.parent_arm].map(|v| dot(v, v).sqrt());
        // A joint with the world has no arm on its parent: the anchor is a position.
        let of_parent = if parent.body == BodyIndex::PLACEHOLDER { 0.0 } else { parent_arm };
        arm + of_parent + radius_of_gyration(self.mass, self.inertia)
    }

    /// Returns the joint error, >= 0. Linear errors are fractions of the sum of the arms and the radius of gyration
    /// (dimensionless), angular errors are in radians. Welds and prismatic joints return the larger of both.
    pub(super) fn relative_joint_error(&self, parent: &ArticulatedLink) -> f64 {
        let offset = self.anchor_offset(parent.position);
        let angle_error = (self.angle_error_or_length + self.delta_pose[2] - parent.delta_pose[2]).abs();
        let (distance, length) = (dot(offset, offset).sqrt(), self.linear_error_scale(parent));
        let relative = |gap: f64, reach: f64| if gap > 0.0 { gap / reach } else { 0.0 };
        match self.locked {
            LockedDofs::Free
            | LockedDofs::Fixed
            | LockedDofs::PointOnLine
            | LockedDofs::Unlocked
            | LockedDofs::Gear
            | LockedDofs::Pulley => 0.0,
            LockedDofs::Point => relative(distance, length),
            LockedDofs::Weld => relative(distance, length).max(angle_error),
            LockedDofs::Angle => angle_error,
            LockedDofs::Distance => {
                relative((distance - self.angle_error_or_length).abs(), length + self.angle_error_or_length)
            }
            LockedDofs::Line => {
                relative(dot(perp(self.axis), offset).abs(), length + distance).max(angle_error)
            }
        }
    }

    /// Returns the largest geometric stiffness of the body that is stable in a substep. Unit: mass units * length units^2.
    #[inline(always)]
    pub(super) fn stable_stiffness(&self) -> f64 {
        stable_stiffness(self.inertia, self.mass, self.max_arm_squared)
    }

    /// Returns the amount of the added stiffness that [carries momentum](momentum_carrying_stiffness). Unit: mass units *
    /// length units^2.
    #[inline(always)]
    pub(super) fn momentum_stiffness(&self) -> f64 {
        momentum_carrying_stiffness(self.added_stiffness, self.stable_stiffness())
    }

    /// Returns the excess of the geometric stiffness over the stable limit. Unit: mass units * length units^2, >= 0; 0 for a
    /// fixed root.
    #[inline(always)]
    pub(super) fn excess_stiffness(&self) -> f64 {
        let excess = self.geometric_stiffness - self.stable_stiffness();
        if excess > 0.0 && self.locked != LockedDofs::Fixed { excess } else { 0.0 }
    }

    /// Returns whether the geometric stiffness of the body or of its rod exceeds the added stiffness by more than
    /// [`STIFFNESS_JUMP_RATIO`] times the stable limit. This happens when a chain snaps taut.
    #[inline(always)]
    pub(super) fn stiffness_jumped(&self) -> bool {
        self.rod.stiffness_jumped()
            || self.excess_stiffness()
                > self.added_stiffness + (STIFFNESS_JUMP_RATIO - 1.0) * self.stable_stiffness()
    }

    /// Returns whether the geometric stiffness of the body or of its rod exceeds `ratio` times the stable limit; false for a fixed
    /// root.
    pub(super) fn is_stiffer(&self, ratio: f64) -> bool {
        let is_free = self.locked != LockedDofs::Fixed;
        self.rod.is_stiffer(ratio) || (is_free && self.geometric_stiffness > ratio * self.stable_stiffness())
    }

    /// Sets the axis of a distance joint to the direction from the parent's anchor to the body's. Returns the distance of the
    /// anchors in length units.
    ///
    /// Coincident anchors keep the axis. `parent` is the position of the parent's centre of mass in the world.
    pub(super) fn update_axis(&mut self, parent: Vec2) -> f64 {
        let offset = self.anchor_offset(parent);
        let distance = dot(offset, offset).sqrt();
        if distance > 0.0 {
            self.axis = [offset[0] / distance, offset[1] / distance];
        }
        distance
    }

    /// Returns the vector from the parent's anchor to the body's, in length units. `parent` is the position of the parent's
    /// centre of mass in the world.
    #[inline(always)]
    pub(super) fn anchor_offset(&self, parent: Vec2) -> Vec2 {
        add_scaled(add_scaled(self.position, self.arm, 1.0), add_scaled(parent, self.parent_arm, 1.0), -1.0)
    }
}

impl BalancedLink for ArticulatedLink {
    fn state(&self) -> LinkEndState {
        let ArticulatedLink { locked, mass, inertia, delta_pose, position, velocity, force_delta, .. } =
            *self;
        LinkEndState { locked, mass, inertia, delta_pose, position, velocity, force_delta }
    }

    fn set_velocity(&mut self, velocity: [f64; 3]) {
        self.velocity = velocity;
    }

    fn max_rounding_work(&self, dt: f64) -> f64 {
        let [x, y, angular_impulse] = self.total_impulse;
        let reach = self.max_arm_squared.sqrt();
        (dot([x, y], [x, y]).sqrt() * max_rounding_error(self.position, reach)
            + angular_impulse.abs() * MAX_ROTATION_ROUNDING)
            / dt
    }

    fn max_closing_work(&self, parent: &Self, dt: f64) -> f64 {
        let [x, y, angular_impulse] = self.total_impulse;
        // Of a distance joint the length counts, too; an angle error is less than half a turn.
        let reach = self.linear_error_scale(parent) + self.angle_error_or_length.abs();
        (dot([x, y], [x, y]).sqrt() * reach + angular_impulse.abs()) / dt * self.initial_error
    }

    fn joint_velocity_error(&self, parent: &Self) -> f64 {
        let relative_velocity =
            add_scaled(self.anchor_velocity(self.arm), parent.anchor_velocity(self.parent_arm), -1.0);
        let rotation_speed = (self.velocity[2] - parent.velocity[2]).abs() * self.max_arm_squared.sqrt();
        match self.locked {
            LockedDofs::Free
            | LockedDofs::Fixed
            | LockedDofs::PointOnLine
            | LockedDofs::Unlocked
            | LockedDofs::Gear
            | LockedDofs::Pulley => 0.0,
            LockedDofs::Point => dot(relative_velocity, relative_velocity).sqrt(),
            LockedDofs::Weld => dot(relative_velocity, relative_velocity).sqrt().max(rotation_speed),
            LockedDofs::Angle => {
                (self.velocity[2] - parent.velocity[2]).abs() * (self.inertia / self.mass).sqrt()
            }
            LockedDofs::Distance => {
                let offset = self.anchor_offset(parent.position);
                let distance = dot(offset, offset).sqrt();
                if distance > 0.0 { dot(offset, relative_velocity).abs() / distance } else { 0.0 }
            }
            LockedDofs::Line => {
                let along = dot(self.axis, self.anchor_offset(parent.position));
                let line_spin = if self.is_first { self.velocity[2] } else { parent.velocity[2] };
                (dot(perp(self.axis), relative_velocity) - line_spin * along).abs().max(rotation_speed)
            }
        }
    }

    fn joint_error_growth(&self, parent: &Self) -> f64 {
        if !self.locked.is_joint() {
            return 0.0;
        }
        self.relative_joint_error(parent) - self.initial_error
    }

    fn has_joint_error_above(&self, error: f64) -> bool {
        self.initial_error > error
    }
}
