//! Views of bodies for editing.

use farseer_core::Body;
use farseer_core::depth::DepthTarget;

use super::access::AccessMut;
use super::body::TwoHalfBody;
use super::ground::GroundMut;
use crate::depth::{DepthBody, DepthScheme};
use crate::error::{invalid, only_precise};
use crate::projection::world_to_plane;
use crate::{Result, Vector2, Vector3};

/// Defines setters that add to a number of the motion along Z and reject values that are not finite.
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
    /// The body in the core, for settings that this view lacks. Its position is that of the body's origin in
    /// the plane: x = X, y = -Y.
    pub fn core_mut(&mut self) -> &mut Body {
        self.simulator.core_body_mut(self.id).expect("the body was there when the view was made")
    }

    fn state_mut(&mut self) -> &mut DepthBody {
        let state = self.simulator.world_mut().depths.edit(self.id);
        state.expect("the body was there when the view was made")
    }

    /// Returns whether numbers are finite. If not, the next update reports the argument as refused.
    fn accepts(&mut self, argument: &'static str, numbers: &[f32]) -> bool {
        let accepted = numbers.iter().all(|number| number.is_finite());
        if !accepted {
            self.simulator.world_mut().reject(self.id, argument);
        }
        accepted
    }

    /// Moves the body in the world, px; see [`position3d`](Self::position3d). A value that is not finite is
    /// rejected.
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

    /// Moves the body in X and Y so that its origin is at a point of the screen, px; Z stays. A value that is
    /// not finite is rejected.
    pub fn set_position(&mut self, value: Vector2) {
        let plane = self.simulator.world().projection.screen_to_plane(value, self.state().z);
        self.core_mut().set_position(plane);
    }

    /// Sets the rotation about the origin, radians; the height changes with the lowest point. A value that is
    /// not finite is rejected.
    pub fn set_rotation(&mut self, value: f32) {
        self.core_mut().set_rotation(value);
    }

    /// Sets the velocity along X and down, px/s. A value that is not finite is rejected. For a static body it
    /// is the surface velocity: a belt that moves bodies by friction.
    pub fn set_linear_velocity(&mut self, value: Vector2) {
        self.core_mut().set_linear_velocity(value);
    }

    /// Sets the velocity along Z, px/s. A value that is not finite is rejected. For a static body with
    /// [`DepthScheme::Precise`] it is the surface velocity: a belt that moves
    /// bodies by friction.
    pub fn set_linear_velocity_z(&mut self, value: f32) {
        if self.accepts("linear_velocity_z", &[value]) {
            let state = self.state_mut();
            (state.velocity_z, state.target) = (value, None);
        }
    }

    /// Sets the angular velocity about the depth axis, radians/s. A value that is not finite is rejected.
    pub fn set_angular_velocity(&mut self, value: f32) {
        self.core_mut().set_angular_velocity(value);
    }

    /// Makes the body static, along Z as well, or dynamic.
    pub fn set_is_static(&mut self, value: bool) {
        self.core_mut().set_is_static(value);
    }

    /// Makes the body kinematic, or dynamic if it was kinematic: [`Body::set_is_kinematic`]. A kinematic body
    /// has infinite mass. It moves with its velocity or to its [target](Self::move_to3d), pushes bodies and
    /// carries them by friction.
    ///
    /// With [`DepthScheme::Precise`] it moves in three axes; with the others in
    /// X and Y, at a constant Z.
    pub fn set_is_kinematic(&mut self, value: bool) {
        self.core_mut().set_is_kinematic(value);
        self.state_mut().target = None;
    }

    /// Sets a target for a [kinematic](Self::set_is_kinematic) body: the next update moves it to the position
    /// of [`set_position3d`](Self::set_position3d), to the last bit, at its present rotation. It has the
    /// velocity of that move, so that it pushes and carries bodies. After that update it stops, unless it
    /// gets a new target or velocity before.
    ///
    /// # Errors
    /// A position that is not finite, in the world or on the screen; a body that is not kinematic; another
    /// scheme than [`DepthScheme::Precise`].
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
        self.state_mut().target = Some(DepthTarget { z: position3d.z, is_reached: false });
        Ok(())
    }

    /// Sets whether the body takes part in the simulation.
    pub fn set_enabled(&mut self, value: bool) {
        self.core_mut().set_enabled(value);
    }

    /// Adds a force along X and down at the body's origin for the next update, mass · px/s².
    #[doc(alias = "ApplyForce")]
    pub fn apply_force(&mut self, amount: Vector2) {
        self.core_mut().apply_force(amount);
    }

    /// Adds an impulse along X and down, mass · px/s, that changes the velocity in the next update.
    #[doc(alias = "ApplyImpulse")]
    pub fn apply_impulse(&mut self, amount: Vector2) {
        self.core_mut().apply_impulse(amount);
    }

    accumulate! {
        /// Adds a force along Z for the next update, mass · px/s² (thesis 3.3.1). A value that is not finite
        /// is rejected.
        #[doc(alias = "ApplyForceZ")]
        apply_force_z(amount) force_z +=;
        /// Adds an impulse along Z, mass · px/s, that changes the velocity in the next update. A value that
        /// is not finite is rejected.
        #[doc(alias = "ApplyImpulseZ")]
        apply_impulse_z(amount) impulse_z +=;
    }

    /// Sets the velocity of the body's origin in the world, px/s: along X, **up** and along Z. A value that
    /// is not finite is rejected.
    pub fn set_velocity3d(&mut self, value: Vector3) {
        if self.accepts("velocity3d", value.as_slice()) {
            self.core_mut().set_linear_velocity(Vector2::new(value.x, -value.y));
            let state = self.state_mut();
            (state.velocity_z, state.target) = (value.z, None);
        }
    }

    /// Adds a force in the world at the body's origin for the next update, mass · px/s²: along X, **up** and
    /// along Z. A value that is not finite is rejected.
    pub fn apply_force3d(&mut self, amount: Vector3) {
        let (plane, z) = (self.core().force() + Vector2::new(amount.x, -amount.y), self.force_z() + amount.z);
        if self.accepts("amount", &[plane.x, plane.y, z]) {
            self.apply_force(Vector2::new(amount.x, -amount.y));
            self.apply_force_z(amount.z);
        }
    }

    /// Adds an impulse in the world, mass · px/s, along X, **up** and along Z, that changes the velocity in
    /// the next update. A value that is not finite is rejected.
    pub fn apply_impulse3d(&mut self, amount: Vector3) {
        let waiting = self.core().impulse();
        let (plane, z) = (waiting + Vector2::new(amount.x, -amount.y), self.state().impulse_z + amount.z);
        if self.accepts("amount", &[plane.x, plane.y, z]) {
            self.apply_impulse(Vector2::new(amount.x, -amount.y));
            self.apply_impulse_z(amount.z);
        }
    }

    /// Sets the angular velocity about all three axes of [`angular_velocity3d`](Self::angular_velocity3d),
    /// radians/s; the first two matter for balls. A value that is not finite is rejected.
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
    /// The errors of [`Body::set_mass`].
    pub fn set_mass(&mut self, value: f32) -> Result<()> {
        Ok(self.core_mut().set_mass(value)?)
    }

    /// Sets whether the body ignores gravity.
    pub fn set_ignore_gravity(&mut self, value: bool) {
        self.core_mut().set_ignore_gravity(value);
    }

    /// Sets the factor of gravity for the body, dimensionless. A value that is not finite is rejected.
    pub fn set_gravity_scale(&mut self, value: f32) {
        self.core_mut().set_gravity_scale(value);
    }

    /// Sets the linear drag coefficient in all three axes, mass per s. A value that is not finite is
    /// rejected.
    pub fn set_linear_drag_coefficient(&mut self, value: f32) {
        self.core_mut().set_linear_drag_coefficient(value);
    }

    /// Sets the rotational drag coefficient, mass · px². A value that is not finite is rejected.
    pub fn set_rotational_drag_coefficient(&mut self, value: f32) {
        self.core_mut().set_rotational_drag_coefficient(value);
    }

    /// Sets the number for the game's own purposes.
    pub fn set_tag(&mut self, value: u64) {
        self.core_mut().set_tag(value);
    }

    /// Adds a torque about the depth axis for the next update, mass · px²/s². A value that is not finite is
    /// rejected.
    #[doc(alias = "ApplyTorque")]
    pub fn apply_torque(&mut self, torque: f32) {
        self.core_mut().apply_torque(torque);
    }

    /// Adds an angular impulse about the depth axis, mass · px²/s, that changes the angular velocity at once.
    /// A value that is not finite is rejected.
    #[doc(alias = "ApplyAngularImpulse")]
    pub fn apply_angular_impulse(&mut self, amount: f32) {
        self.core_mut().apply_angular_impulse(amount);
    }

    /// Clears the accumulated force, along Z as well.
    #[doc(alias = "ClearForce")]
    pub fn clear_force(&mut self) {
        self.core_mut().clear_force();
        self.clear_force_z();
    }

    /// Clears the accumulated impulse, along Z as well.
    #[doc(alias = "ClearImpulse")]
    pub fn clear_impulse(&mut self) {
        self.core_mut().clear_impulse();
        self.state_mut().impulse_z = 0.0;
    }

    /// Clears the accumulated torque.
    #[doc(alias = "ClearTorque")]
    pub fn clear_torque(&mut self) {
        self.core_mut().clear_torque();
    }

    /// Resets the body to the origin of the world at rest, as the core does: position, rotation, velocities,
    /// forces and impulses become 0, along Z as well.
    #[doc(alias = "ResetDynamics")]
    pub fn reset_dynamics(&mut self) {
        self.core_mut().reset_dynamics();
        let state = self.state_mut();
        (state.z, state.velocity_z, state.force_z, state.impulse_z) = (0.0, 0.0, 0.0, 0.0);
        (state.angular_velocity_x, state.angular_velocity_y) = (0.0, 0.0);
        state.target = None;
    }

    /// Clears the accumulated force along Z.
    #[doc(alias = "ClearForceZ")]
    pub fn clear_force_z(&mut self) {
        self.state_mut().force_z = 0.0;
    }

    /// Ground of the body, for editing.
    pub fn ground_mut(&mut self) -> GroundMut<'_, S> {
        GroundMut { simulator: &mut self.simulator, body: self.id }
    }
}
