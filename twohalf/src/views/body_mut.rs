//! What a game does to bodies.

use farseer_core::{Body, SpaceTarget};

use super::access::AccessMut;
use super::body::TwoHalfBody;
use super::ground::GroundMut;
use crate::depth::{DepthBody, DepthScheme};
use crate::error::{invalid, only_precise};
use crate::projection::world_to_plane;
use crate::{Result, Vector2, Vector3};

/// Setters of one float of the motion along Z that reject what is not finite.
macro_rules! accumulate {
    ($($(#[$doc:meta])* $name:ident($argument:ident) $field:ident += ;)*) => {$(
        $(#[$doc])*
        pub fn $name(&mut self, $argument: f32) {
            let sum = self.state().$field + $argument;
            if self.accepts(stringify!($argument), &[sum]) {
                self.state_mut().$field = sum;
            }
        }
    )*};
}

impl<S: AccessMut> TwoHalfBody<S> {
    /// The body in the 2D engine, to change what is not offered here. Its position is that of the body's origin
    /// in the plane: x = X, y = -Y.
    pub fn core_mut(&mut self) -> &mut Body {
        self.simulator.core_body_mut(self.id).expect("the body was there when the view was made")
    }

    fn state_mut(&mut self) -> &mut DepthBody {
        let state = self.simulator.world_mut().depths.edit(self.id);
        state.expect("the body was there when the view was made")
    }

    /// Whether the numbers that an argument leads to are finite; if not, the refusal is noted.
    fn accepts(&mut self, argument: &'static str, numbers: &[f32]) -> bool {
        let accepted = numbers.iter().all(|number| number.is_finite());
        if !accepted {
            self.simulator.world_mut().reject(self.id, argument);
        }
        accepted
    }

    /// Moves the body in the world; see [`position3d`](Self::position3d). What is not finite is rejected.
    pub fn set_position3d(&mut self, value: Vector3) {
        let lowest = self.lowest();
        let plane = world_to_plane(value, lowest);
        let appears = self.simulator.world().projection.appears(plane, value.z);
        let place = [plane.x, plane.y, value.z, if appears { 0.0 } else { f32::INFINITY }];
        if self.accepts("position3d", &place) {
            self.core_mut().set_position(plane);
            self.state_mut().z = value.z;
        }
    }

    /// Moves the body in X and Y so that its origin appears at a point of the screen; Z stays. What is not finite
    /// is rejected.
    pub fn set_position(&mut self, value: Vector2) {
        let plane = self.simulator.world().projection.screen_to_plane(value, self.state().z);
        self.core_mut().set_position(plane);
    }

    /// Turns the body about its origin, so its height changes with the lowest point. What is not finite is
    /// rejected.
    pub fn set_rotation(&mut self, value: f32) {
        self.core_mut().set_rotation(value);
    }

    /// Sets the velocity along X and down. What is not finite is rejected. Of a static body, which it does not move, it is the
    /// speed of its surface: a belt, which carries what lies on it by friction.
    pub fn set_linear_velocity(&mut self, value: Vector2) {
        self.core_mut().set_linear_velocity(value);
    }

    /// Sets the velocity along Z. What is not finite is rejected. With
    /// [`DepthScheme::Precise`](crate::DepthScheme::Precise) that of a static body, which it does not move, is the speed of its
    /// surface: a belt, which carries what lies on it by friction.
    pub fn set_linear_velocity_z(&mut self, value: f32) {
        if self.accepts("linear_velocity_z", &[value]) {
            let state = self.state_mut();
            (state.velocity_z, state.target) = (value, None);
        }
    }

    /// Sets the angular velocity about the depth axis. What is not finite is rejected.
    pub fn set_angular_velocity(&mut self, value: f32) {
        self.core_mut().set_angular_velocity(value);
    }

    /// Makes the body immovable, along Z as well, or movable.
    pub fn set_is_static(&mut self, value: bool) {
        self.core_mut().set_is_static(value);
    }

    /// Makes the body kinematic, or dynamic if it was: [`Body::set_is_kinematic`]. Nothing pushes a kinematic body; it goes on
    /// with its velocity, or to where it is [told](Self::move_to3d) to, pushes what it touches, and carries it by friction.
    ///
    /// With [`DepthScheme::Precise`](crate::DepthScheme::Precise) it moves in three axes; with the others in X and Y, and keeps
    /// its Z.
    pub fn set_is_kinematic(&mut self, value: bool) {
        self.core_mut().set_is_kinematic(value);
        self.state_mut().target = None;
    }

    /// Lets the next update bring a [kinematic](Self::set_is_kinematic) body to where
    /// [`set_position3d`](Self::set_position3d) would put it, to the last bit, at the rotation that it has now. It has the velocity that does, so that it
    /// pushes and carries what it touches. In the update after that it stands still, unless it is told a new place or given
    /// a velocity before.
    ///
    /// # Errors
    /// What is not finite, in the world or on the screen; a body that is not kinematic; another scheme than
    /// [`DepthScheme::Precise`](crate::DepthScheme::Precise), where nothing kinematic moves along Z.
    pub fn move_to3d(&mut self, position3d: Vector3) -> Result<()> {
        if self.simulator.world().scheme != DepthScheme::Precise {
            return Err(only_precise("motion along Z of a kinematic body"));
        }
        let plane = world_to_plane(position3d, self.lowest());
        let appears = self.simulator.world().projection.appears(plane, position3d.z);
        let is_finite = appears && [plane.x, plane.y, position3d.z].iter().all(|number| number.is_finite());
        if !is_finite {
            return Err(invalid("position3d", position3d, "finite, also on the screen"));
        }
        let rotation = self.rotation();
        self.core_mut().move_to(plane, rotation)?;
        self.state_mut().target = Some(SpaceTarget { z: position3d.z, is_reached: false });
        Ok(())
    }

    /// Lets the body take part in the simulation or not.
    pub fn set_enabled(&mut self, value: bool) {
        self.core_mut().set_enabled(value);
    }

    /// Adds a force along X and down at the body's origin, acting over the next update.
    #[doc(alias = "ApplyForce")]
    pub fn apply_force(&mut self, amount: Vector2) {
        self.core_mut().apply_force(amount);
    }

    /// Adds an impulse, mass times velocity, along X and down, that changes the velocity at the next update.
    #[doc(alias = "ApplyImpulse")]
    pub fn apply_impulse(&mut self, amount: Vector2) {
        self.core_mut().apply_impulse(amount);
    }

    accumulate! {
        /// Adds a force along Z, acting over the next update (thesis 3.3.1). What is not finite is rejected.
        #[doc(alias = "ApplyForceZ")]
        apply_force_z(amount) force_z +=;
        /// Adds an impulse along Z, mass times velocity, that changes the velocity at the next update. What is not
        /// finite is rejected.
        #[doc(alias = "ApplyImpulseZ")]
        apply_impulse_z(amount) impulse_z +=;
    }

    /// Sets the velocity of the body's origin in the world: along X, **up** and along Z. What is not finite is
    /// rejected.
    pub fn set_velocity3d(&mut self, value: Vector3) {
        if self.accepts("velocity3d", value.as_slice()) {
            self.core_mut().set_linear_velocity(Vector2::new(value.x, -value.y));
            let state = self.state_mut();
            (state.velocity_z, state.target) = (value.z, None);
        }
    }

    /// Adds a force in the world, along X, **up** and along Z, at the body's origin, acting over the next update.
    /// What is not finite is rejected.
    pub fn apply_force3d(&mut self, amount: Vector3) {
        let (plane, z) = (self.core().force() + Vector2::new(amount.x, -amount.y), self.force_z() + amount.z);
        if self.accepts("amount", &[plane.x, plane.y, z]) {
            self.apply_force(Vector2::new(amount.x, -amount.y));
            self.apply_force_z(amount.z);
        }
    }

    /// Adds an impulse in the world, along X, **up** and along Z, that changes the velocity at the next update.
    /// What is not finite is rejected.
    pub fn apply_impulse3d(&mut self, amount: Vector3) {
        let waiting = self.core().impulse();
        let (plane, z) = (waiting + Vector2::new(amount.x, -amount.y), self.state().impulse_z + amount.z);
        if self.accepts("amount", &[plane.x, plane.y, z]) {
            self.apply_impulse(Vector2::new(amount.x, -amount.y));
            self.apply_impulse_z(amount.z);
        }
    }

    /// Sets the angular velocity about all three axes of [`angular_velocity3d`](Self::angular_velocity3d); the
    /// first two matter for balls. What is not finite is rejected.
    pub fn set_angular_velocity3d(&mut self, value: Vector3) {
        if self.accepts("angular_velocity3d", value.as_slice()) {
            self.core_mut().set_angular_velocity(value.z);
            let state = self.state_mut();
            (state.angular_velocity_x, state.angular_velocity_y) = (value.x, value.y);
        }
    }

    /// Sets the mass; the moment of inertia stays.
    ///
    /// # Errors
    /// As [`Body::set_mass`].
    pub fn set_mass(&mut self, value: f32) -> Result<()> {
        Ok(self.core_mut().set_mass(value)?)
    }

    /// Lets gravity act on the body or not.
    pub fn set_ignore_gravity(&mut self, value: bool) {
        self.core_mut().set_ignore_gravity(value);
    }

    /// Sets how strongly gravity acts on the body. What is not finite is rejected.
    pub fn set_gravity_scale(&mut self, value: f32) {
        self.core_mut().set_gravity_scale(value);
    }

    /// Sets the drag per velocity, in all three axes. What is not finite is rejected.
    pub fn set_linear_drag_coefficient(&mut self, value: f32) {
        self.core_mut().set_linear_drag_coefficient(value);
    }

    /// Sets the drag per square of the angular velocity. What is not finite is rejected.
    pub fn set_rotational_drag_coefficient(&mut self, value: f32) {
        self.core_mut().set_rotational_drag_coefficient(value);
    }

    /// Sets the game's own number.
    pub fn set_tag(&mut self, value: u64) {
        self.core_mut().set_tag(value);
    }

    /// Adds a torque about the depth axis, acting over the next update. What is not finite is rejected.
    #[doc(alias = "ApplyTorque")]
    pub fn apply_torque(&mut self, torque: f32) {
        self.core_mut().apply_torque(torque);
    }

    /// Adds an angular impulse about the depth axis that changes the angular velocity at once. What is not finite is
    /// rejected.
    #[doc(alias = "ApplyAngularImpulse")]
    pub fn apply_angular_impulse(&mut self, amount: f32) {
        self.core_mut().apply_angular_impulse(amount);
    }

    /// Forgets the accumulated force, along Z as well.
    #[doc(alias = "ClearForce")]
    pub fn clear_force(&mut self) {
        self.core_mut().clear_force();
        self.clear_force_z();
    }

    /// Forgets the accumulated impulse, along Z as well.
    #[doc(alias = "ClearImpulse")]
    pub fn clear_impulse(&mut self) {
        self.core_mut().clear_impulse();
        self.state_mut().impulse_z = 0.0;
    }

    /// Forgets the accumulated torque.
    #[doc(alias = "ClearTorque")]
    pub fn clear_torque(&mut self) {
        self.core_mut().clear_torque();
    }

    /// Back to the origin of the world at rest, as the 2D engine's: position, rotation, velocities, forces and
    /// impulses become 0, along Z as well.
    #[doc(alias = "ResetDynamics")]
    pub fn reset_dynamics(&mut self) {
        self.core_mut().reset_dynamics();
        let state = self.state_mut();
        (state.z, state.velocity_z, state.force_z, state.impulse_z) = (0.0, 0.0, 0.0, 0.0);
        (state.angular_velocity_x, state.angular_velocity_y) = (0.0, 0.0);
        state.target = None;
    }

    /// Forgets the accumulated force along Z.
    #[doc(alias = "ClearForceZ")]
    pub fn clear_force_z(&mut self) {
        self.state_mut().force_z = 0.0;
    }

    /// How the body meets the plane Y = 0, to be changed.
    pub fn ground_mut(&mut self) -> GroundMut<'_, S> {
        GroundMut { simulator: &mut self.simulator, body: self.id }
    }
}
