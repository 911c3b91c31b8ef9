//! Step of a free articulation: a tree of joints whose bodies have no contacts. SHAKE with RATTLE in its own substeps, on top
//! of the [articulated-body algorithm](super::articulated_body).
//!
//! **Positions.** A substep of h seconds solves for the velocity v' with which the joints hold at its *end*: C(x + h v') = 0,
//! with the joint error C and positions x. Linearised about the velocity v before joint impulses this is J v' = J v - C(x + h
//! v) / h. All of v cancels but the angular velocity w: each side of a joint contributes (x + R r) / h - w p. Here r is the
//! vector from the centre of mass to the anchor, R the rotation of the body in the substep, and p = (-r.y, r.x). This is SHAKE
//! (J.-P. Ryckaert, G. Ciccotti, H. Berendsen 1977) with one iteration, or two.
//!
//! **Velocities.** Forces act by halves at the start and the end of a step (kick-drift-kick, as in a leapfrog). After the last
//! substep the velocity is projected on the joints (RATTLE, H. C. Andersen 1983). So far the method is symplectic, and energy
//! does not drift. Articulations above `MAX_BALANCED_ARTICULATION_BODIES` get full kicks at the start instead, without the
//! projection.
//!
//! **Geometric stiffness** above the stable limit occurs in a whip. It is added to the inertia. Most
//! of the added stiffness carries momentum, so that little energy is lost.
//!
//! The module reads the links, joint constraints and forces of [`BodySet`]. It writes velocities, displacements and joint
//! impulses of the links.

use super::super::bodies::BodySet;
use super::super::scaled_parameters::StepContext;
use super::articulated_body::{
    ArticulatedLink, Links, for_each_down, propagate_down, propagate_momentum_up, propagate_up,
};
use super::energy_balance::{BalancedLink, EnergyBalance, InitialEnergy, LinkEndState, max_rounding_error};
use super::joint_constraint::JointList;
use super::link_state::begin_links;
use super::locked_dofs::LockedDofs;
use super::vec2::{Vec2, add_scaled, cross, dot, perp, rotate};
use crate::index::{BodyIndex, DenseIndex};
use crate::parameters::direct::STABLE_STIFFNESS;
use crate::parameters::joints::{
    ARTICULATION_SUBSTEP_PARTS, IMPLICIT_STIFFNESS_RATIO, JOINT_CORRECTION_SPEED, LARGE_ARTICULATION_BODIES,
    MAX_BALANCED_ARTICULATION_BODIES, MAX_REPEATED_SUBSTEP_PARTS, MAX_ROTATION_ROUNDING,
    MAX_WHIP_JOINT_ERROR, MIN_ARTICULATION_PARTS, MOMENTUM_SHARE_HALVED_AT, MOMENTUM_SHARE_OF_STIFFNESS,
    PREDICTED_ROTATION_ERROR, ROTATION_PER_PART, STIFFNESS_JUMP_RETRIES,
};

/// Returns cosine and sine of the rotation of a body in a substep. `angle` is in radians.
///
/// Angles of up to 1 radian use a Taylor series. Its error is below 1e-10 for less than 0.3 radians.
#[inline(always)]
pub(super) fn cos_sin(angle: f64) -> [f64; 2] {
    if angle * angle > 1.0 {
        let (sine, cosine) = libm::sincos(angle);
        return [cosine, sine];
    }
    let x = angle * angle;
    let sine = angle * (1.0 - x * (1.0 / 6.0) * (1.0 - x * (1.0 / 20.0) * (1.0 - x * (1.0 / 42.0))));
    let cosine =
        1.0 - x * 0.5 * (1.0 - x * (1.0 / 12.0) * (1.0 - x * (1.0 / 30.0) * (1.0 - x * (1.0 / 56.0))));
    [cosine, sine]
}

/// Returns [cosine, sine minus the angle] of a rotation by `angle` radians. Applied to a vector r this is the rotated vector
/// minus the linear displacement `angle` * (-r.y, r.x) of its end.
///
/// The truncated series has an error of 1e-6 of the length of r at 0.3 radians; the next substep corrects it.
#[inline(always)]
pub(super) fn nonlinear_rotation(angle: f64) -> [f64; 2] {
    if angle * angle > 1.0 {
        let [cosine, sine] = cos_sin(angle);
        return [cosine, sine - angle];
    }
    let x = angle * angle;
    [1.0 - x * (0.5 - x * (1.0 / 24.0)), -angle * x * (1.0 / 6.0 - x * (1.0 / 120.0))]
}

impl ArticulatedLink {
    /// Adds the fraction `fraction` (0..=1) of the velocity change by applied forces in a substep to the velocity (a kick).
    #[inline(always)]
    fn apply_forces(&mut self, fraction: f64) {
        (0..3).for_each(|i| self.velocity[i] += fraction * self.force_delta[i]);
    }

    /// Computes the target velocity with which the joint holds at the end of a substep of `h` seconds. `length_unit` is the
    /// length unit of the simulator, in the user's unit.
    #[inline(always)]
    fn set_target_velocity(&mut self, parent: Option<&mut ArticulatedLink>, h: f64, length_unit: f64) {
        self.rotation = nonlinear_rotation(self.predicted_spin * h);
        let Some(parent) = parent else { return };
        let (parent, child) = (AnchorState::of(parent, self.parent_arm), AnchorState::of(self, self.arm));
        match self.locked {
            LockedDofs::Free | LockedDofs::Fixed => {}
            LockedDofs::Point => {
                self.target_velocity = point_target_velocity(&child, &parent, h, length_unit)
            }
            LockedDofs::Distance => {
                self.target_velocity[0] = distance_target_velocity(self, &child, &parent, h, length_unit)
            }
            LockedDofs::Angle => self.target_velocity[2] = angle_target_velocity(self, &child, &parent, h),
            LockedDofs::Weld => {
                self.target_velocity = point_target_velocity(&child, &parent, h, length_unit);
                self.target_velocity[2] = angle_target_velocity(self, &child, &parent, h);
            }
            LockedDofs::Line => {
                self.target_velocity = line_target_velocity(self, &child, &parent, h, length_unit)
            }
        }
    }

    /// Sets the target velocity of the joint to 0: the velocity is projected on the joints, and position errors stay.
    #[inline(always)]
    fn clear_target_velocity(&mut self) {
        self.target_velocity = [0.0; 3];
    }

    /// Moves the body with its velocity for `h` seconds, and rotates the arms and the axis of its joint with the parent.
    #[inline(always)]
    fn integrate_position(&mut self, parent: Option<&mut ArticulatedLink>, h: f64) {
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
    fn scale_to_substep(&mut self, bodies: &BodySet, (dt, substeps): (f64, f64), substep_ratio: f64) {
        self.impulse = self.impulse.map(|impulse| impulse * substep_ratio);
        self.geometric_stiffness *= 1.0 / (substeps * substeps);
        self.joint_spin_change *= 1.0 / substeps;
        self.added_stiffness = self.excess_stiffness();
        if self.body != BodyIndex::PLACEHOLDER {
            let (force_delta, force_position_delta) =
                (bodies.force_delta[self.body.position()], bodies.force_position_delta[self.body.position()]);
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
    fn accumulate_stiffness(&mut self, parent: Option<&mut ArticulatedLink>, h: f64) {
        let [x, y, _] = self.impulse;
        self.geometric_stiffness = h * dot(self.arm, [x, y]);
        if let Some(parent) = parent {
            parent.geometric_stiffness -= h * dot(self.parent_arm, [x, y]);
        }
    }

    /// Returns the velocity of the body's point at the end of `arm`, a vector from the centre of mass. Unit: length units/s.
    #[inline(always)]
    fn anchor_velocity(&self, arm: Vec2) -> Vec2 {
        let [x, y, spin] = self.velocity;
        add_scaled([x, y], perp(arm), spin)
    }

    /// Returns the predicted change of the body's angular velocity by joints in this substep. Unit: radians/s.
    #[inline(always)]
    fn predicted_spin_change(&self) -> f64 {
        predict_spin_change(self.joint_spin_change, self.geometric_stiffness, self.stable_stiffness())
    }

    /// Computes the angular impulse of the joint about the body's centre of mass, and subtracts the reaction from the parent's
    /// sum.
    ///
    /// Both are stored in `joint_spin_change` until they are divided by the moments of inertia. Unit: mass units * length
    /// units^2/s.
    #[inline(always)]
    fn accumulate_joint_torque(&mut self, parent: Option<&mut ArticulatedLink>) {
        let [x, y, angular_impulse] = self.impulse;
        self.joint_spin_change = cross(self.arm, [x, y]) + angular_impulse;
        if let Some(parent) = parent {
            let slide =
                if self.locked == LockedDofs::Line { self.anchor_offset(parent.position) } else { [0.0; 2] };
            parent.joint_spin_change -=
                cross(add_scaled(self.parent_arm, slide, 1.0), [x, y]) + angular_impulse;
        }
    }

    /// Returns the joint error, >= 0. Linear errors are fractions of the sum of the arms and the radius of gyration
    /// (dimensionless), angular errors are in radians. Welds and prismatic joints return the larger of both.
    fn relative_joint_error(&self, parent: &ArticulatedLink) -> f64 {
        let offset = self.anchor_offset(parent.position);
        let angle_error = self.angle_error_or_length.abs();
        let [arm, parent_arm, distance] = [self.arm, self.parent_arm, offset].map(|v| dot(v, v).sqrt());
        // A joint with the world has no arm on its parent: the anchor is a position.
        let length = arm
            + if parent.body == BodyIndex::PLACEHOLDER { 0.0 } else { parent_arm }
            + (self.inertia / self.mass).sqrt();
        let relative = |gap: f64, reach: f64| if gap > 0.0 { gap / reach } else { 0.0 };
        match self.locked {
            LockedDofs::Free | LockedDofs::Fixed => 0.0,
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
    fn stable_stiffness(&self) -> f64 {
        stable_stiffness(self.inertia, self.mass, self.max_arm_squared)
    }

    /// Returns the amount of the added stiffness that [carries momentum](momentum_conserving_stiffness). Unit: mass units *
    /// length units^2.
    #[inline(always)]
    fn momentum_stiffness(&self) -> f64 {
        momentum_conserving_stiffness(self.added_stiffness, self.stable_stiffness())
    }

    /// Returns the excess of the geometric stiffness over the stable limit. Unit: mass units * length units^2, >= 0; 0 for a
    /// fixed root.
    #[inline(always)]
    fn excess_stiffness(&self) -> f64 {
        let excess = self.geometric_stiffness - self.stable_stiffness();
        if excess > 0.0 && self.locked != LockedDofs::Fixed { excess } else { 0.0 }
    }

    /// Returns whether the geometric stiffness exceeds the added stiffness by more than twice the stable limit. This happens
    /// when a chain snaps taut.
    #[inline(always)]
    fn stiffness_jumped(&self) -> bool {
        self.excess_stiffness() > self.added_stiffness + self.stable_stiffness()
    }

    /// Sets the axis of a distance joint to the direction from the parent's anchor to the body's. Returns the distance of the
    /// anchors in length units.
    ///
    /// Coincident anchors keep the axis. `parent` is the position of the parent's centre of mass in the world.
    fn update_axis(&mut self, parent: Vec2) -> f64 {
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
    fn end_state(&self) -> Option<LinkEndState> {
        let ArticulatedLink { mass, inertia, delta_pose, position, velocity, force_delta, .. } = *self;
        (self.body != BodyIndex::PLACEHOLDER).then_some(LinkEndState {
            mass,
            inertia,
            delta_pose,
            position,
            velocity,
            force_delta,
        })
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

    fn joint_velocity_error(&self, parent: &Self) -> f64 {
        let relative_velocity =
            add_scaled(self.anchor_velocity(self.arm), parent.anchor_velocity(self.parent_arm), -1.0);
        let rotation_speed = (self.velocity[2] - parent.velocity[2]).abs() * self.max_arm_squared.sqrt();
        match self.locked {
            LockedDofs::Free | LockedDofs::Fixed => 0.0,
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

    fn has_joint_error_above(&self, error: f64) -> bool {
        self.initial_error > error
    }

    fn is_moving_fixed_root(&self) -> bool {
        self.locked == LockedDofs::Fixed && self.velocity != [0.0; 3]
    }

    fn is_free_root(&self) -> bool {
        self.locked == LockedDofs::Free
    }
}

/// One side of a joint, the body or its parent, at the start of a substep.
struct AnchorState {
    /// Position of the body's centre of mass in the world. Unit: length units.
    position: Vec2,
    /// Velocity of the centre of mass, and angular velocity: x and y in length units/s, angular in radians/s.
    velocity: [f64; 3],
    /// Arm: vector from the centre of mass to the anchor, in world coordinates. Unit: length units.
    arm: Vec2,
    /// Arm rotated to the end of the substep, minus the linear displacement of its end by the predicted angular velocity. Unit:
    /// length units.
    nonlinear_arm: Vec2,
    /// Rotation of the body since the step began. Unit: radians.
    angle: f64,
}

impl AnchorState {
    #[inline(always)]
    fn of(link: &ArticulatedLink, arm: Vec2) -> Self {
        AnchorState {
            position: link.position,
            velocity: link.velocity,
            arm,
            nonlinear_arm: rotate(link.rotation, arm),
            angle: link.delta_pose[2],
        }
    }

    /// Returns the position of the anchor at the end of the substep minus its displacement by the velocity at the start. World
    /// coordinates, length units.
    #[inline(always)]
    fn nonlinear_anchor(&self) -> Vec2 {
        add_scaled(self.position, self.nonlinear_arm, 1.0)
    }

    /// Returns the position of the anchor at the start of the substep, in the world. Unit: length units.
    #[inline(always)]
    fn anchor(&self) -> Vec2 {
        add_scaled(self.position, self.arm, 1.0)
    }

    /// Returns the velocity of the anchor at the start of the substep, along x and y. Unit: length units/s.
    #[inline(always)]
    fn anchor_velocity(&self) -> Vec2 {
        add_scaled([self.velocity[0], self.velocity[1]], perp(self.arm), self.velocity[2])
    }
}

/// Returns the largest geometric stiffness of a body that is stable in a substep: [`STABLE_STIFFNESS`] times the moment of
/// inertia about the farthest joint. Unit: mass units * length units^2.
///
/// `inertia` is the moment of inertia about the centre of mass. `max_arm_squared` is the square of the largest distance from
/// the centre of mass to a joint, in length units^2.
#[inline(always)]
pub(super) fn stable_stiffness(inertia: f64, mass: f64, max_arm_squared: f64) -> f64 {
    STABLE_STIFFNESS * (inertia + mass * max_arm_squared)
}

/// Returns the fraction of a position error that is left for later substeps, 0..=1. At most `max_correction` of the error
/// `size` is corrected now, both in length units or both in radians.
#[inline(always)]
pub(super) fn clamped_remainder(size: f64, max_correction: f64) -> f64 {
    if size > max_correction { 1.0 - max_correction / size } else { 0.0 }
}

/// Returns the target velocity of a point joint: x and y in length units/s, angular 0. With it the anchors meet at the end of
/// the substep of `h` seconds, with a bounded speed of correction.
#[inline(always)]
fn point_target_velocity(child: &AnchorState, parent: &AnchorState, h: f64, length_unit: f64) -> [f64; 3] {
    let error = add_scaled(child.anchor(), parent.anchor(), -1.0);
    let remainder = clamped_remainder(dot(error, error).sqrt(), JOINT_CORRECTION_SPEED * h * length_unit);
    let [x, y] =
        add_scaled(add_scaled(child.nonlinear_anchor(), parent.nonlinear_anchor(), -1.0), error, -remainder);
    let rate = -1.0 / h;
    [x * rate, y * rate, 0.0]
}

/// Returns the target speed of a distance joint along its axis, in length units/s, and sets `axis` of `link` to the present
/// direction.
#[inline(always)]
fn distance_target_velocity(
    link: &mut ArticulatedLink,
    child: &AnchorState,
    parent: &AnchorState,
    h: f64,
    length_unit: f64,
) -> f64 {
    let error = link.update_axis(parent.position) - link.angle_error_or_length;
    let relative_velocity = add_scaled(child.anchor_velocity(), parent.anchor_velocity(), -1.0);
    let speed = dot(link.axis, relative_velocity);
    let nonlinear_offset = add_scaled(child.nonlinear_anchor(), parent.nonlinear_anchor(), -1.0);
    let predicted_offset = add_scaled(nonlinear_offset, relative_velocity, h);
    let remainder = error * clamped_remainder(error.abs(), JOINT_CORRECTION_SPEED * h * length_unit);
    speed - (dot(predicted_offset, predicted_offset).sqrt() - link.angle_error_or_length - remainder) / h
}

/// Returns the target angular velocity of the body relative to its parent, in radians/s, for a joint that locks the angle.
#[inline(always)]
fn angle_target_velocity(link: &ArticulatedLink, child: &AnchorState, parent: &AnchorState, h: f64) -> f64 {
    let error = link.angle_error_or_length + child.angle - parent.angle;
    -error * (1.0 - clamped_remainder(error.abs(), JOINT_CORRECTION_SPEED * h)) / h
}

/// Returns the target velocity of a prismatic joint at the child's anchor: x and y in length units/s, angular in radians/s.
///
/// The child's distance from the axis changes with the relative velocity at its anchor and with the rotation of the axis.
#[inline(always)]
fn line_target_velocity(
    link: &ArticulatedLink,
    child: &AnchorState,
    parent: &AnchorState,
    h: f64,
    length_unit: f64,
) -> [f64; 3] {
    let target_spin = angle_target_velocity(link, child, parent, h);
    let across = perp(link.axis);
    let first = if link.is_first { child } else { parent };
    let offset = add_scaled(child.anchor(), parent.anchor(), -1.0);
    let relative_velocity = add_scaled(child.anchor_velocity(), parent.anchor_velocity(), -1.0);
    let predicted_offset = add_scaled(
        add_scaled(child.nonlinear_anchor(), parent.nonlinear_anchor(), -1.0),
        relative_velocity,
        h,
    );
    let error = dot(across, offset);
    let predicted_error = dot(rotate(cos_sin(first.velocity[2] * h), across), predicted_offset)
        - error * clamped_remainder(error.abs(), JOINT_CORRECTION_SPEED * h * length_unit);
    let along = dot(link.axis, offset);
    // A line fixed to the child rotates with a spin that the solve is about to change.
    let spin_change =
        if link.is_first { along * (target_spin - (child.velocity[2] - parent.velocity[2])) } else { 0.0 };
    let speed = dot(across, relative_velocity) - parent.velocity[2] * along;
    let [x, y] = across.map(|component| component * (speed + spin_change - predicted_error / h));
    [x, y, target_spin]
}

/// Returns the amount of the added stiffness `stiffness` that carries momentum, too; the solve of a substep applies it to the
/// old angular velocity. Both arguments and the result are in mass units * length units^2.
///
/// With moment of inertia I, added stiffness S and angular velocities w before and w' after, a substep solves (I + S) w' = (I +
/// m) w + impulses. The result is m. The value m = 0 is an implicit step, which loses energy of rotation. The value m = S
/// conserves energy like a leapfrog with larger inertias while S is constant. A stiffness that is many times the limit and
/// changes from step to step makes such a leapfrog gain energy.
///
/// Measured with balls of 1 to 100,000 mass units on a chain and chains of 9 to 50 links. With m = S a third of them gains
/// energy. With m = 0 they lose 19, 7.8 and 2.8 % of their greatest kinetic energy in ten seconds at 30, 60 and 120 Hz. With
/// this formula they lose 6.2, 2.3 and 1.1 %, and none gains energy.
#[inline(always)]
pub(crate) fn momentum_conserving_stiffness(stiffness: f64, stable_stiffness: f64) -> f64 {
    if stiffness == 0.0 {
        return 0.0;
    }
    let ratio = stiffness / (MOMENTUM_SHARE_HALVED_AT * stable_stiffness);
    MOMENTUM_SHARE_OF_STIFFNESS * stiffness / (1.0 + ratio * ratio)
}

/// Raises the added stiffness of each body to the present excess of its geometric stiffness over the stable limit, after a
/// [jump](ArticulatedLink::stiffness_jumped).
///
/// Joint tension acts as a stiffness against rotation, which an explicit substep cannot integrate beyond a limit: a chain that
/// carries much more than its own weight would be torn apart. The excess is added to the inertia, as an implicit step does (M.
/// Tournier et al., "Stable constrained dynamics", 2015; S. Andrews et al., "Geometric stiffness for real-time constrained
/// multibody dynamics", 2017).
fn raise_added_stiffness(links: &mut Links<ArticulatedLink>) {
    for link in links.iter_mut() {
        let excess = link.excess_stiffness();
        link.added_stiffness = if excess > link.added_stiffness { excess } else { link.added_stiffness };
    }
}

/// Computes the geometric stiffness of all links from the joint impulses of a substep of `h` seconds. Unit: mass units * length
/// units^2.
fn compute_geometric_stiffness(links: &mut Links<ArticulatedLink>, h: f64) {
    for_each_down(links, |link, parent| link.accumulate_stiffness(parent, h));
}

/// Number of substeps of a free articulation's step, with the choices of the method that depend on it.
pub(crate) struct SubstepPlan {
    /// Number of substeps that the articulation divides the step into, >= 1.
    pub(crate) substeps: u32,
    /// Largest number of substeps for a repetition of the step.
    pub(super) max_substeps: u32,
    /// Whether forces act in full at the start of each substep (kick-drift) instead of by halves at both ends of the step.
    ///
    /// Both methods move bodies to the same positions. The velocities after kick-drift belong to a time half a substep earlier,
    /// and are not projected on the joints.
    pub(super) is_kick_drift: bool,
    /// Whether the [changes of the angular velocities by joints are predicted](predict_spin_change). False where large joint
    /// errors are being closed.
    pub(super) predicts_spin: bool,
    /// Largest deviation of a body's rotation from its prediction in a substep. A greater one repeats the solve. Unit: radians.
    pub(super) max_prediction_error: f64,
}

impl SubstepPlan {
    /// Returns the plan for the step of an articulation with `bodies` dynamic bodies.
    ///
    /// `start_spin` and `end_spin` are the greatest absolute angular velocities at the start and at the predicted end of the
    /// step, in radians/s. `is_stiffer(f)` returns whether a geometric stiffness exceeds f times the limit of an undivided
    /// step.
    ///
    /// The number of substeps grows until no body turns by more than [`ROTATION_PER_PART`] in one. Up to
    /// [`LARGE_ARTICULATION_BODIES`] bodies it also grows until every stiffness is within the limit.
    pub(crate) fn of(
        bodies: u32,
        step: &StepContext,
        [start_spin, end_spin]: [f64; 2],
        is_stiffer: impl Fn(f64) -> bool,
    ) -> Self {
        let is_large = bodies > LARGE_ARTICULATION_BODIES;
        let is_balanced = Self::is_energy_balanced(bodies);
        let spin = if is_balanced { start_spin.max(end_spin) } else { start_spin };
        let rotation = spin * f64::from(step.dt);
        let is_stiff = |parts: u32| is_stiffer(f64::from(parts * parts));
        let max_substeps = if is_large { step.substeps } else { ARTICULATION_SUBSTEP_PARTS * step.substeps };
        let mut substeps = if is_balanced { MIN_ARTICULATION_PARTS } else { 1 };
        while substeps < max_substeps
            && (f64::from(substeps) * ROTATION_PER_PART < rotation || (!is_large && is_stiff(substeps)))
        {
            substeps += (substeps / 2).max(1);
        }
        SubstepPlan {
            substeps: substeps.min(max_substeps),
            max_substeps: MAX_REPEATED_SUBSTEP_PARTS * step.substeps,
            is_kick_drift: !is_balanced,
            predicts_spin: is_balanced,
            max_prediction_error: if is_balanced { 0.5 } else { 1.0 } * PREDICTED_ROTATION_ERROR,
        }
    }

    /// Returns whether an articulation of `bodies` dynamic bodies gets an [energy balance](super::energy_balance).
    #[inline(always)]
    pub(crate) fn is_energy_balanced(bodies: u32) -> bool {
        bodies <= MAX_BALANCED_ARTICULATION_BODIES
    }

    /// Returns the energy balance of the step of `dt` seconds that followed this plan. Returns `None` if `start`, the energy at
    /// the start, is `None`, or if a moving root or a moved anchor did work.
    pub(super) fn energy_balance<N: BalancedLink>(
        &self,
        links: &Links<N>,
        start: Option<InitialEnergy>,
        dt: f64,
    ) -> Option<EnergyBalance> {
        EnergyBalance::of(links, start?, [dt, dt / f64::from(self.substeps)])
    }

    /// Returns the plan for the repetition of a step with this energy balance: twice the substeps, within `max_substeps`.
    /// Returns `None` if the energy error is small or the number of substeps cannot grow.
    pub(super) fn refined(&self, balance: &EnergyBalance) -> Option<Self> {
        let substeps = (2 * self.substeps).min(self.max_substeps);
        (balance.exceeds_tolerance() && substeps > self.substeps).then_some(SubstepPlan { substeps, ..*self })
    }
}

/// Returns the predicted change of a body's angular velocity by joints in a substep, in radians/s. `change` is that in the
/// previous substep.
///
/// The prediction falls linearly to 0 as the geometric stiffness approaches the stable stiffness, both in mass units * length
/// units^2. A motion that oscillates within a substep cannot be predicted.
#[inline(always)]
pub(super) fn predict_spin_change(change: f64, geometric_stiffness: f64, stable_stiffness: f64) -> f64 {
    let remainder = 1.0 - geometric_stiffness.abs() / stable_stiffness;
    if remainder > 0.0 { remainder * change } else { 0.0 }
}

/// Returns the larger absolute values of the given angular velocities and those of one more body, at the start and at the
/// predicted end of a step. Unit: radians/s.
///
/// `start_spin` is the body's angular velocity and `change` the predicted change of it.
#[inline(always)]
pub(super) fn max_spins([max_start, max_end]: [f64; 2], start_spin: f64, change: f64) -> [f64; 2] {
    [max_start.max(start_spin.abs()), max_end.max((start_spin + change).abs())]
}

/// Moves a free tree through all substeps of a step, and repeats the step with more substeps if its energy error is too large.
/// Returns the number of substeps.
///
/// Forces of springs and of the game may depend on the position. They act in full at the start of the step, as for bodies
/// without joints. `length_unit` is the length unit of the simulator.
pub(super) fn step_free_tree(
    links: &mut Links<ArticulatedLink>,
    constraints: &JointList,
    bodies: &BodySet,
    step: &StepContext,
    length_unit: f64,
) -> u32 {
    let dt = f64::from(step.dt);
    let mut plan = begin_step(links, constraints, bodies, step);
    loop {
        let start = run_substeps(links, bodies, step, &plan, length_unit);
        let balance = plan.energy_balance(links, start, dt);
        let Some(refined) = balance.and_then(|balance| plan.refined(&balance)) else {
            balance.inspect(|balance| balance.project_energy(links));
            break;
        };
        begin_step(links, constraints, bodies, step);
        plan = refined;
    }
    plan.substeps
}

/// Sets the links to the state at the start of a step, and returns the plan of the articulation's substeps.
fn begin_step(
    links: &mut Links<ArticulatedLink>,
    constraints: &JointList,
    bodies: &BodySet,
    step: &StepContext,
) -> SubstepPlan {
    let (dt, substeps) = (f64::from(step.dt), f64::from(step.substeps));
    begin_links(links, constraints, bodies, f64::from(step.h));
    // The impulse of one undivided step is `substeps` times that of a solver substep.
    compute_geometric_stiffness(links, dt * substeps);
    for_each_down(links, |link, parent| {
        link.initial_error = parent.as_deref().map_or(0.0, |parent| link.relative_joint_error(parent));
        link.accumulate_joint_torque(parent);
    });
    let (mut count, mut spins, mut has_large_error) = (0, [0.0; 2], false);
    for link in links.iter_mut() {
        if link.body == BodyIndex::PLACEHOLDER {
            link.joint_spin_change = 0.0;
            continue;
        }
        count += 1;
        has_large_error |= link.has_joint_error_above(MAX_WHIP_JOINT_ERROR);
        link.joint_spin_change *= substeps / link.inertia;
        spins = max_spins(spins, link.velocity[2], link.joint_spin_change);
    }
    let plan = SubstepPlan::of(count, step, spins, |ratio| {
        let bears = IMPLICIT_STIFFNESS_RATIO * ratio;
        links.iter().any(|link| {
            link.geometric_stiffness > bears * link.stable_stiffness() && link.locked != LockedDofs::Fixed
        })
    });
    SubstepPlan { predicts_spin: plan.predicts_spin && !has_large_error, ..plan }
}

/// Runs all substeps of a step with as few passes over the links as possible. Returns the energy at the start of the step, or
/// `None` if the articulation gets no energy balance.
fn run_substeps(
    links: &mut Links<ArticulatedLink>,
    bodies: &BodySet,
    step: &StepContext,
    plan: &SubstepPlan,
    length_unit: f64,
) -> Option<InitialEnergy> {
    let SubstepPlan { substeps, is_kick_drift, max_prediction_error, predicts_spin, .. } = *plan;
    let (dt, solver_substeps) = (f64::from(step.dt), f64::from(step.substeps));
    let h = dt / f64::from(substeps);
    for link in links.iter_mut() {
        link.scale_to_substep(bodies, (dt, f64::from(substeps)), solver_substeps / f64::from(substeps));
    }
    let start = (!is_kick_drift).then(|| InitialEnergy::of(links));
    for substep in 0..substeps {
        let share = if substep == 0 && !is_kick_drift { 0.5 } else { 1.0 };
        for link in links.iter_mut() {
            link.apply_forces(share);
            let joint_spin_change = if predicts_spin { link.predicted_spin_change() } else { 0.0 };
            (link.unconstrained_velocity, link.predicted_spin) =
                (link.velocity, link.velocity[2] + share * joint_spin_change);
        }
        solve_substep(links, (h, length_unit), max_prediction_error / h);
        for_each_down(links, |link, parent| {
            if predicts_spin {
                link.joint_spin_change = (link.velocity[2] - link.unconstrained_velocity[2]) / share;
            }
            link.accumulate_impulse();
            link.integrate_position(parent, h);
        });
    }
    if !is_kick_drift {
        for link in links.iter_mut() {
            link.apply_forces(0.5);
            link.clear_target_velocity();
            link.init_own(0.0);
        }
        propagate_up(links);
        propagate_down(links);
        links.iter_mut().for_each(ArticulatedLink::accumulate_impulse);
    }
    start
}

/// Solves a substep of `h` seconds for the velocities with which the joints hold at the end of the substep.
///
/// The solve is repeated once if a body's rotation deviates from the prediction. It is repeated up to
/// [`STIFFNESS_JUMP_RETRIES`] times while the [stiffness jumps](ArticulatedLink::stiffness_jumped). `max_spin_error` is the
/// largest accepted deviation of an angular velocity, in radians/s.
fn solve_substep(links: &mut Links<ArticulatedLink>, (h, length_unit): (f64, f64), max_spin_error: f64) {
    let mut has_stiffness_jump = true;
    for iteration in 0..=STIFFNESS_JUMP_RETRIES {
        for_each_down(links, |link, parent| {
            link.set_target_velocity(parent, h, length_unit);
            link.init_own_momentum(link.unconstrained_velocity, link.momentum_stiffness());
        });
        if has_stiffness_jump {
            links.iter_mut().for_each(|link| link.init_own_inertia(1.0));
            propagate_up(links);
        } else {
            propagate_momentum_up(links);
        }
        propagate_down(links);
        compute_geometric_stiffness(links, h);
        has_stiffness_jump = links.iter().any(ArticulatedLink::stiffness_jumped);
        let is_mispredicted =
            |link: &ArticulatedLink| (link.velocity[2] - link.predicted_spin).abs() > max_spin_error;
        if iteration == STIFFNESS_JUMP_RETRIES
            || !(has_stiffness_jump || (iteration == 0 && links.iter().any(is_mispredicted)))
        {
            break;
        }
        if has_stiffness_jump {
            raise_added_stiffness(links);
        }
        for link in links.iter_mut() {
            (link.predicted_spin, link.velocity) = (link.velocity[2], link.unconstrained_velocity);
        }
    }
}
