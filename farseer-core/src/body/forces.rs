//! Forces, torques and impulses that act on a body in the next update.

use super::Body;
use crate::math::Vector2;

impl Body {
    /// Force accumulated for the next update, in mass units · length units/s².
    #[doc(alias = "Force")]
    pub fn force(&self) -> Vector2 {
        self.force
    }

    /// Impulse accumulated for the next update, in mass units · length units/s.
    pub fn impulse(&self) -> Vector2 {
        self.impulse
    }

    /// Torque accumulated for the next update, in mass units · length units²/s².
    #[doc(alias = "Torque")]
    pub fn torque(&self) -> f32 {
        self.torque
    }

    /// Adds a force in mass units · length units/s² at the body's origin, acting over the next update.
    #[doc(alias = "ApplyForce")]
    pub fn apply_force(&mut self, amount: Vector2) {
        let force = self.force + amount;
        if self.accepts_vector("amount", force) {
            self.force = force;
        }
    }

    /// Adds a force, in world orientation, at a point given in the body's coordinates.
    #[doc(alias = "ApplyForceAtLocalPoint")]
    pub fn apply_force_at_local_point(&mut self, amount: Vector2, point: Vector2) {
        self.apply_force_at_offset(amount, self.get_world_position(point) - self.position);
    }

    /// Adds a force at a point of the world.
    #[doc(alias = "ApplyForceAtWorldPoint")]
    pub fn apply_force_at_world_point(&mut self, amount: Vector2, point: Vector2) {
        self.apply_force_at_offset(amount, point - self.position);
    }

    fn apply_force_at_offset(&mut self, amount: Vector2, offset: Vector2) {
        let torque = self.torque + (offset.x * amount.y - offset.y * amount.x);
        let force = self.force + amount;
        if self.accepts_vector("amount", force) && self.accepts("point", torque) {
            self.torque = torque;
            self.force = force;
        }
    }

    /// Adds a torque in mass units · length units²/s², acting over the next update.
    #[doc(alias = "ApplyTorque")]
    pub fn apply_torque(&mut self, torque: f32) {
        let torque = self.torque + torque;
        if self.accepts("torque", torque) {
            self.torque = torque;
        }
    }

    /// Adds an impulse in mass units · length units/s that changes the velocity at the next update.
    #[doc(alias = "ApplyImpulse")]
    pub fn apply_impulse(&mut self, amount: Vector2) {
        let impulse = self.impulse + amount;
        if self.accepts_vector("amount", impulse) {
            self.impulse = impulse;
        }
    }

    /// Adds an impulse at a point of the world: it changes the velocity at the next update, and the angular velocity at once.
    /// Ours: the original has such a call for forces only.
    pub fn apply_impulse_at_world_point(&mut self, amount: Vector2, point: Vector2) {
        let arm = point - self.position;
        let turning = arm.x * amount.y - arm.y * amount.x;
        if self.accepts_vector("amount", self.impulse + amount) && self.accepts("point", turning) {
            self.apply_impulse(amount);
            self.apply_angular_impulse(turning);
        }
    }

    /// Changes the angular velocity at once by `amount` times the inverse moment of inertia. `amount` is in mass units
    /// · length units²/s.
    #[doc(alias = "ApplyAngularImpulse")]
    pub fn apply_angular_impulse(&mut self, amount: f32) {
        let angular_velocity = self.angular_velocity + amount * self.inverse_moment_of_inertia;
        if self.accepts("amount", amount) && self.accepts("amount", angular_velocity) {
            self.angular_velocity = angular_velocity;
        }
    }

    /// Sets the accumulated force to zero.
    #[doc(alias = "ClearForce")]
    pub fn clear_force(&mut self) {
        self.force = Vector2::zeros();
    }

    /// Sets the accumulated torque to zero.
    #[doc(alias = "ClearTorque")]
    pub fn clear_torque(&mut self) {
        self.torque = 0.0;
    }

    /// Sets the accumulated impulse to zero.
    #[doc(alias = "ClearImpulse")]
    pub fn clear_impulse(&mut self) {
        self.impulse = Vector2::zeros();
    }
}
