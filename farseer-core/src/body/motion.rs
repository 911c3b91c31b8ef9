//! Pose and velocity of a body.

use serde::{Deserialize, Serialize};

use super::Body;
use super::options::BodyOptions;
use crate::math::vector2::length;
use crate::math::{Vector2, math_helper::TWO_PI, scalar};

impl Body {
    /// Position of the body's origin, its centre of mass, in length units.
    #[doc(alias = "Position")]
    #[inline]
    pub fn position(&self) -> Vector2 {
        self.position
    }

    /// Moves the body; its geoms follow. A value that is not finite is rejected.
    pub fn set_position(&mut self, value: Vector2) {
        if self.accepts_vector("position", value) {
            self.position = value;
            self.pose_is_dirty = true;
            self.target = None;
        }
    }

    /// Moves the body along x alone. A value that is not finite is rejected.
    #[doc(alias = "Position.X")]
    pub fn set_position_x(&mut self, x: f32) {
        self.set_position(Vector2::new(x, self.position.y));
    }

    /// Moves the body along y alone. A value that is not finite is rejected.
    #[doc(alias = "Position.Y")]
    pub fn set_position_y(&mut self, y: f32) {
        self.set_position(Vector2::new(self.position.x, y));
    }

    /// Whether continuous collision also stops the body at dynamic bodies, and them at it. Default false. Ours, and
    /// only with the [precise set](crate::Methods::Precise): there no body passes through a static, kinematic or
    /// sleeping one, and a bullet passes through no dynamic one either.
    pub fn is_bullet(&self) -> bool {
        self.options.has(BodyOptions::BULLET)
    }

    /// Sets [`is_bullet`](Self::is_bullet). Meant for few bodies that are small and fast: in every step in which a
    /// bullet moves by more than its thickness, its times of impact with all bodies along its path are computed.
    pub fn set_is_bullet(&mut self, value: bool) {
        self.options.set(BodyOptions::BULLET, value);
    }

    /// Rotation in radians, normally from 0 to 2 pi inclusive.
    #[doc(alias = "Rotation")]
    #[inline]
    pub fn rotation(&self) -> f32 {
        self.rotation
    }

    /// Turns the body; its geoms follow. The value is brought into the range of one turn, and the turns taken
    /// off are **added** to [`revolutions`](Self::revolutions), as in the original. A value that is not finite is rejected.
    pub fn set_rotation(&mut self, value: f32) {
        if self.accepts("rotation", value) {
            self.normalize_rotation(value);
            self.pose_is_dirty = true;
            self.target = None;
        }
    }

    /// Full turns taken so far.
    #[doc(alias = "Revolutions")]
    pub fn revolutions(&self) -> i32 {
        self.revolutions
    }

    /// Rotation plus 2 pi for every revolution, in radians, without the rounding of [`total_rotation`](Self::total_rotation). Each
    /// revolution counts by the same number that [`rotation`](Self::rotation) has lost.
    #[cfg_attr(not(feature = "precise"), allow(dead_code, reason = "gears act with the precise set alone"))]
    pub(crate) fn unwrapped_rotation(&self) -> f64 {
        f64::from(self.rotation) + f64::from(self.revolutions) * f64::from(TWO_PI)
    }

    /// Rotation plus 2 pi for every revolution, in radians.
    #[doc(alias = "TotalRotation")]
    pub fn total_rotation(&self) -> f32 {
        self.total_rotation
    }

    /// Velocity of the body's origin, in length units/s.
    #[doc(alias = "LinearVelocity")]
    #[inline]
    pub fn linear_velocity(&self) -> Vector2 {
        self.linear_velocity
    }

    /// Sets the velocity. A value that is not finite is rejected. A static body keeps its velocity and does not move:
    /// bodies that touch it are carried as by a conveyor belt.
    pub fn set_linear_velocity(&mut self, value: Vector2) {
        if self.accepts_vector("linear_velocity", value) {
            self.linear_velocity = value;
            self.target = None;
        }
    }

    /// Sets the velocity along x alone. A value that is not finite is rejected.
    #[doc(alias = "LinearVelocity.X")]
    pub fn set_linear_velocity_x(&mut self, x: f32) {
        self.set_linear_velocity(Vector2::new(x, self.linear_velocity.y));
    }

    /// Sets the velocity along y alone. A value that is not finite is rejected.
    #[doc(alias = "LinearVelocity.Y")]
    pub fn set_linear_velocity_y(&mut self, y: f32) {
        self.set_linear_velocity(Vector2::new(self.linear_velocity.x, y));
    }

    /// Angular velocity in rad/s.
    #[doc(alias = "AngularVelocity")]
    #[inline]
    pub fn angular_velocity(&self) -> f32 {
        self.angular_velocity
    }

    /// Sets the angular velocity. A value that is not finite is rejected.
    #[inline]
    pub fn set_angular_velocity(&mut self, value: f32) {
        if self.accepts("angular_velocity", value) {
            self.angular_velocity = if self.holds_rotation() { 0.0 } else { value };
            self.target = None;
        }
    }

    /// Whether the speed is at least [`minimum_velocity`](Self::minimum_velocity); the angular velocity does not count.
    #[doc(alias = "Moves")]
    pub fn moves(&self) -> bool {
        length(self.linear_velocity) >= self.minimum_velocity
    }

    /// Puts the body at rest at the origin without rotation; force, torque and impulse are cleared. Mass, flags and
    /// drag stay, and so does the bias velocity with which the solver was separating it from an overlap.
    #[doc(alias = "ResetDynamics")]
    pub fn reset_dynamics(&mut self) {
        self.linear_velocity = Vector2::zeros();
        self.angular_velocity = 0.0;
        self.position = Vector2::zeros();
        self.rotation = 0.0;
        self.revolutions = 0;
        self.total_rotation = 0.0;
        self.clear_force();
        self.clear_torque();
        self.clear_impulse();
        self.pose_is_dirty = true;
        self.target = None;
    }

    #[inline]
    pub(super) fn normalize_rotation(&mut self, raw: f32) {
        if (0.0..TWO_PI).contains(&raw) {
            self.rotation = raw;
        } else {
            let turns = whole_turns(raw);
            self.rotation = raw - turns as f32 * TWO_PI;
            self.revolutions = self.revolutions.wrapping_add(turns);
        }
        self.total_rotation = self.rotation + self.revolutions as f32 * TWO_PI;
    }

    #[inline]
    pub(crate) fn pose(&self) -> Pose {
        let Body { position, rotation, revolutions, total_rotation, .. } = *self;
        Pose { position, rotation, revolutions, total_rotation }
    }

    pub(crate) fn restore_pose(&mut self, pose: Pose) {
        let Pose { position, rotation, revolutions, total_rotation } = pose;
        (self.position, self.rotation) = (position, rotation);
        (self.revolutions, self.total_rotation) = (revolutions, total_rotation);
    }
}

/// Number of full turns that bring a rotation in radians back into the range of one turn.
pub(super) fn whole_turns(raw: f32) -> i32 {
    let turns = scalar::to_int(raw / TWO_PI);
    if raw < 0.0 { turns.wrapping_sub(1) } else { turns }
}

/// Position and rotation of a body.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) struct Pose {
    pub(crate) position: Vector2,
    pub(crate) rotation: f32,
    pub(crate) revolutions: i32,
    pub(crate) total_rotation: f32,
}
