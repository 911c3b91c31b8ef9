//! Bodies as a game sees them.

use std::ops::{Deref, DerefMut};

use farseer_core::{Body, BodyId, Event};

use crate::depth::{DepthBody, lowest};
use crate::ground::{Ground, GroundMut};
use crate::projection::{plane_to_world, world_to_plane};
use crate::{TwoHalfPhysicsSimulator, Vector2, Vector3};

/// A body of a simulator: to look at, from [`TwoHalfPhysicsSimulator::body`], or to change as well, from
/// [`TwoHalfPhysicsSimulator::body_mut`].
///
/// Velocities, forces and impulses along X and Y are in screen orientation: x right, y **down**. Along Z,
/// positive is into the picture. Rotation is about the depth axis, in rad, clockwise on the screen.
///
/// What is not here is in [`core`](Self::core) and [`core_mut`](Self::core_mut).
///
/// Setters that a game calls every frame return nothing. Given a value that is not finite they change nothing;
/// the simulator reports the refusal as [`Event::RejectedInput`] in its next update.
#[derive(Debug)]
pub struct TwoHalfBody<S> {
    simulator: S,
    id: BodyId,
}

impl<S: Deref<Target = TwoHalfPhysicsSimulator>> TwoHalfBody<S> {
    pub(crate) fn new(simulator: S, id: BodyId) -> Option<Self> {
        simulator.core.body(id)?;
        simulator.depths.bodies.get(id)?;
        Some(TwoHalfBody { simulator, id })
    }

    /// The body in the 2D engine. Its position is that of the body's origin in the plane: x = X, y = -Y.
    pub fn core(&self) -> &Body {
        // That it exists was checked when the view was made, and nothing can be disposed while the view lives.
        &self.simulator.core[self.id]
    }

    fn state(&self) -> &DepthBody {
        &self.simulator.depths.bodies[self.id]
    }

    /// The id.
    pub fn id(&self) -> BodyId {
        self.id
    }

    /// Position in the world: X and Z of the body's origin, and as Y the height of the object geom's lowest point
    /// over the ground; without an object geom, of the origin.
    ///
    /// While a body that is not round rotates, the lowest point changes, and with it Y.
    #[doc(alias = "Position3D")]
    pub fn position3d(&self) -> Vector3 {
        let lowest = lowest(&self.simulator.core, &self.simulator.depths, self.id);
        plane_to_world(self.core().position(), lowest, self.state().z)
    }

    /// Position of the body's origin on the screen, px.
    #[doc(alias = "Position")]
    pub fn position(&self) -> Vector2 {
        self.simulator.projection.plane_to_screen(self.core().position(), self.state().z)
    }

    /// Rotation in rad, normally from 0 to 2 pi.
    #[doc(alias = "Rotation")]
    pub fn rotation(&self) -> f32 {
        self.core().rotation()
    }

    /// Velocity along X and down, px/s.
    #[doc(alias = "LinearVelocity")]
    pub fn linear_velocity(&self) -> Vector2 {
        self.core().linear_velocity()
    }

    /// Velocity along Z, px/s.
    #[doc(alias = "LinearVelocityZ")]
    pub fn linear_velocity_z(&self) -> f32 {
        self.state().velocity_z
    }

    /// Angular velocity about the depth axis, rad/s.
    #[doc(alias = "AngularVelocity")]
    pub fn angular_velocity(&self) -> f32 {
        self.core().angular_velocity()
    }

    /// Angular velocity about the x axis, rad/s, with which a ball rolls in depth; it is not drawn. A ball of
    /// radius r that rolls on the ground without slipping has -v/r at a velocity v along Z.
    pub fn angular_velocity_x(&self) -> f32 {
        self.state().angular_velocity_x
    }

    /// Force along Z accumulated for the next update.
    #[doc(alias = "ForceZ")]
    pub fn force_z(&self) -> f32 {
        self.state().force_z
    }

    /// Mass.
    #[doc(alias = "Mass")]
    pub fn mass(&self) -> f32 {
        self.core().mass()
    }

    /// Whether the body is immovable.
    #[doc(alias = "IsStatic")]
    pub fn is_static(&self) -> bool {
        self.core().is_static()
    }

    /// Whether the body takes part in the simulation.
    #[doc(alias = "Enabled")]
    pub fn enabled(&self) -> bool {
        self.core().enabled()
    }

    /// How the body meets the plane Y = 0.
    #[doc(alias = "Ground")]
    pub fn ground(&self) -> &Ground {
        &self.state().ground
    }
}

/// Setters of one float of the motion along Z that reject what is not finite.
macro_rules! accumulate {
    ($($(#[$doc:meta])* $name:ident($argument:ident) $field:ident += ;)*) => {$(
        $(#[$doc])*
        pub fn $name(&mut self, $argument: f32) {
            let sum = self.state().$field + $argument;
            if self.accepts(stringify!($argument), sum) {
                self.state_mut().$field = sum;
            }
        }
    )*};
}

impl<S: DerefMut<Target = TwoHalfPhysicsSimulator>> TwoHalfBody<S> {
    /// The body in the 2D engine, to change what is not offered here. Its position is that of the body's origin
    /// in the plane: x = X, y = -Y.
    pub fn core_mut(&mut self) -> &mut Body {
        &mut self.simulator.core[self.id]
    }

    fn state_mut(&mut self) -> &mut DepthBody {
        &mut self.simulator.depths.bodies[self.id]
    }

    /// Notes a refused argument and answers whether the value may be used.
    fn accepts(&mut self, argument: &'static str, value: f32) -> bool {
        let accepted = value.is_finite();
        if !accepted {
            let object = Some(self.id.into());
            self.simulator.pending_events.push(Event::RejectedInput { object, argument });
        }
        accepted
    }

    /// Moves the body in the world; see [`position3d`](Self::position3d). What is not finite is rejected.
    pub fn set_position3d(&mut self, value: Vector3) {
        let lowest = lowest(&self.simulator.core, &self.simulator.depths, self.id);
        let plane = world_to_plane(value, lowest);
        // Any infinity or NaN makes a product, and with it the sum, NaN.
        let screen = self.simulator.projection.plane_to_screen(plane, value.z);
        let is_finite = 0.0 * plane.x + 0.0 * plane.y + 0.0 * value.z + 0.0 * screen.x + 0.0 * screen.y;
        if self.accepts("position3d", is_finite) {
            self.core_mut().set_position(plane);
            self.state_mut().z = value.z;
        }
    }

    /// Moves the body in X and Y so that its origin appears at a point of the screen; Z stays. What is not finite
    /// is rejected.
    pub fn set_position(&mut self, value: Vector2) {
        let plane = self.simulator.projection.screen_to_plane(value, self.state().z);
        self.core_mut().set_position(plane);
    }

    /// Turns the body about its origin, so its height changes with the lowest point. What is not finite is
    /// rejected.
    pub fn set_rotation(&mut self, value: f32) {
        self.core_mut().set_rotation(value);
    }

    /// Sets the velocity along X and down. What is not finite is rejected.
    pub fn set_linear_velocity(&mut self, value: Vector2) {
        self.core_mut().set_linear_velocity(value);
    }

    /// Sets the velocity along Z. What is not finite is rejected.
    pub fn set_linear_velocity_z(&mut self, value: f32) {
        if self.accepts("linear_velocity_z", value) {
            self.state_mut().velocity_z = value;
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

    /// Forgets the accumulated force along Z.
    #[doc(alias = "ClearForceZ")]
    pub fn clear_force_z(&mut self) {
        self.state_mut().force_z = 0.0;
    }

    /// How the body meets the plane Y = 0, to be changed.
    pub fn ground_mut(&mut self) -> GroundMut<'_> {
        GroundMut { simulator: &mut self.simulator, body: self.id }
    }
}
