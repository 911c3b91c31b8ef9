//! Target velocities of the joints of a free articulation: the velocities with which the joints hold at the end of a substep
//! (SHAKE).

use super::articulated_body::ArticulatedLink;
use super::locked_dofs::LockedDofs;
use super::rotation::{cos_sin, nonlinear_rotation};
use super::substep_plan::{clamped_remainder, momentum_carrying_stiffness};
use super::vec2::{Vec2, add_scaled, dot, perp, rotate};
use crate::parameters::joints::{JOINT_CORRECTION_SPEED, MAX_ROD_SLOPE};

impl ArticulatedLink {
    /// Computes the target velocity with which the joint holds at the end of a substep of `h` seconds. `length_unit` is the
    /// length unit of the simulator, in the user's unit.
    #[inline(always)]
    pub(super) fn set_target_velocity(
        &mut self,
        parent: Option<&mut ArticulatedLink>,
        h: f64,
        length_unit: f64,
    ) {
        self.rotation = nonlinear_rotation(self.predicted_spin * h);
        let Some(parent) = parent else { return };
        let (parent, child) = (AnchorState::of(parent, self.parent_arm), AnchorState::of(self, self.arm));
        match self.locked {
            LockedDofs::Free
            | LockedDofs::Fixed
            | LockedDofs::PointOnLine
            | LockedDofs::Unlocked
            | LockedDofs::Gear
            | LockedDofs::Pulley => {}
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

/// Returns the target speed of a distance joint along its axis, in length units/s, and begins the solve of its rod.
///
/// With the predicted velocity across the axis, the rod ends the substep at the offset across that this velocity gives. The
/// target speed brings it to the target length there. Beyond [`MAX_ROD_SLOPE`] the length is linearised about the velocity before
/// joint impulses instead.
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
    let nonlinear_offset = add_scaled(child.nonlinear_anchor(), parent.nonlinear_anchor(), -1.0);
    let (n, t) = (link.axis, perp(link.axis));
    link.rod.begin_solve(dot(t, relative_velocity), momentum_carrying_stiffness);
    let remainder = error * clamped_remainder(error.abs(), JOINT_CORRECTION_SPEED * h * length_unit);
    let length = link.angle_error_or_length + remainder;
    let across = dot(t, nonlinear_offset) + h * link.rod.predicted_velocity();
    if across.abs() <= MAX_ROD_SLOPE * length {
        return ((length * length - across * across).sqrt() - dot(n, nonlinear_offset)) / h;
    }
    let predicted_offset = add_scaled(nonlinear_offset, relative_velocity, h);
    dot(n, relative_velocity) - (dot(predicted_offset, predicted_offset).sqrt() - length) / h
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
