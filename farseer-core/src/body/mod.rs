//! The state of motion of one rigid body (behaviour chapter 02).
//!
//! Lengths are in the user's unit, velocities per second, angles in radians, screen orientation (x right,
//! y down, so that positive angles turn clockwise on the screen).

pub(crate) mod entry;
mod kinematic;
pub(crate) mod nobody;
mod save;

use serde::{Deserialize, Serialize};

use crate::error::{Error, Result};
use crate::math::finite::finite;
use crate::math::matrix::create_rotation_z;
use crate::math::vector2::{length, transform};
use crate::math::{Matrix, Vector2, math_helper::TWO_PI, scalar};
pub use crate::storage::ids::BodyId;
use crate::storage::refusals::{ArgumentNames, Refusals};

/// The state of motion of one rigid body. It has no shape; geoms attached to it have.
///
/// A body is made by [`BodyFactory`](crate::BodyFactory) or [`Body::new`] and given to a simulator, which
/// answers with a [`BodyId`]: `simulator[body]` is the body from then on.
///
/// Methods that a game calls every frame return nothing. Given a value that is not finite they change nothing;
/// the simulator reports the refusal as [`Event::RejectedInput`](crate::Event::RejectedInput) in its next update;
/// after sixteen refusals only further arguments, each once.
#[derive(Debug, Clone)]
pub struct Body {
    pub(crate) position: Vector2,
    pub(crate) rotation: f32,
    pub(crate) revolutions: i32,
    pub(crate) total_rotation: f32,
    pub(crate) linear_velocity: Vector2,
    pub(crate) angular_velocity: f32,
    pub(crate) linear_velocity_bias: Vector2,
    pub(crate) angular_velocity_bias: f32,
    force: Vector2,
    torque: f32,
    impulse: Vector2,
    mass: f32,
    pub(crate) inverse_mass: f32,
    moment_of_inertia: f32,
    pub(crate) inverse_moment_of_inertia: f32,
    linear_drag_coefficient: f32,
    quadratic_drag_coefficient: f32,
    rotational_drag_coefficient: f32,
    idle_time: f32,
    minimum_velocity: f32,
    gravity_scale: f32,
    tag: u64,
    is_static: bool,
    is_kinematic: bool,
    /// Where a kinematic body is brought.
    target: Option<kinematic::Target>,
    enabled: bool,
    ignore_gravity: bool,
    is_quadratic_drag_enabled: bool,
    is_auto_idle: bool,
    /// Never cleared once set; see [`Body::integrate_position`].
    has_moved: bool,
    /// A setter moved the body and its geoms have not followed yet.
    pub(crate) pose_is_dirty: bool,
    /// Arguments refused since the simulator last looked.
    pub(crate) rejected: Refusals<BodyArguments>,
}

/// What setters of bodies refuse.
#[derive(Debug)]
pub(crate) struct BodyArguments;

impl ArgumentNames for BodyArguments {
    const NAMES: &'static [&'static str] = &[
        "position",
        "rotation",
        "linear_velocity",
        "angular_velocity",
        "linear_drag_coefficient",
        "quadratic_drag_coefficient",
        "rotational_drag_coefficient",
        "idle_time",
        "minimum_velocity",
        "gravity_scale",
        "amount",
        "point",
        "torque",
    ];
}

impl Default for Body {
    fn default() -> Self {
        Body::new()
    }
}

macro_rules! properties {
    ($($(#[$doc:meta])* $field:ident: $type:ty, $setter:ident;)*) => {$(
        $(#[$doc])*
        #[inline]
        pub fn $field(&self) -> $type {
            self.$field
        }

        #[doc = concat!("Sets [`", stringify!($field), "`](Self::", stringify!($field), ").")]
        #[inline]
        pub fn $setter(&mut self, value: $type) {
            self.$field = value;
        }
    )*};
}

macro_rules! finite_properties {
    ($($(#[$doc:meta])* $field:ident, $setter:ident;)*) => {$(
        $(#[$doc])*
        #[inline]
        pub fn $field(&self) -> f32 {
            self.$field
        }

        #[doc = concat!("Sets [`", stringify!($field), "`](Self::", stringify!($field), "). What is not finite is rejected.")]
        #[inline]
        pub fn $setter(&mut self, value: f32) {
            if self.accepts(stringify!($field), value) {
                self.$field = value;
            }
        }
    )*};
}

impl Body {
    /// A dynamic body of mass 1 and moment of inertia 1, at rest at the origin.
    pub fn new() -> Self {
        Body {
            position: Vector2::zeros(),
            rotation: 0.0,
            revolutions: 0,
            total_rotation: 0.0,
            linear_velocity: Vector2::zeros(),
            angular_velocity: 0.0,
            linear_velocity_bias: Vector2::zeros(),
            angular_velocity_bias: 0.0,
            force: Vector2::zeros(),
            torque: 0.0,
            impulse: Vector2::zeros(),
            mass: 1.0,
            inverse_mass: 1.0,
            moment_of_inertia: 1.0,
            inverse_moment_of_inertia: 1.0,
            linear_drag_coefficient: 0.001,
            quadratic_drag_coefficient: 0.001,
            rotational_drag_coefficient: 0.001,
            idle_time: 0.0,
            minimum_velocity: 55.0,
            gravity_scale: 1.0,
            tag: 0,
            is_static: false,
            is_kinematic: false,
            target: None,
            enabled: true,
            ignore_gravity: false,
            is_quadratic_drag_enabled: false,
            is_auto_idle: false,
            has_moved: false,
            pose_is_dirty: false,
            rejected: Refusals::default(),
        }
    }

    /// A fresh body with the mass, inertia, drag, tag and flags of another (behaviour chapter 02, section 7).
    /// Position, velocities, accumulators, idle time and idle settings are those of [`Body::new`].
    #[doc(alias = "Body(Body)")]
    pub fn copy_of(body: &Body) -> Self {
        Body {
            mass: body.mass,
            inverse_mass: body.inverse_mass,
            moment_of_inertia: body.moment_of_inertia,
            inverse_moment_of_inertia: body.inverse_moment_of_inertia,
            linear_drag_coefficient: body.linear_drag_coefficient,
            rotational_drag_coefficient: body.rotational_drag_coefficient,
            is_quadratic_drag_enabled: body.is_quadratic_drag_enabled,
            quadratic_drag_coefficient: body.quadratic_drag_coefficient,
            enabled: body.enabled,
            tag: body.tag,
            gravity_scale: body.gravity_scale,
            ignore_gravity: body.ignore_gravity,
            is_static: body.is_static,
            is_kinematic: body.is_kinematic,
            ..Body::new()
        }
    }

    /// Notes a refused argument and answers whether the value may be used.
    #[inline]
    fn accepts(&mut self, argument: &'static str, value: f32) -> bool {
        let accepted = value.is_finite();
        if !accepted {
            self.rejected.note(argument);
        }
        accepted
    }

    #[inline]
    fn accepts_vector(&mut self, argument: &'static str, value: Vector2) -> bool {
        let accepted = value.x.is_finite() && value.y.is_finite();
        if !accepted {
            self.rejected.note(argument);
        }
        accepted
    }

    properties! {
        /// Whether the body takes part in the simulation. Default true.
        #[doc(alias = "Enabled")]
        enabled: bool, set_enabled;
        /// Whether gravity leaves the body alone. Default false.
        #[doc(alias = "IgnoreGravity")]
        ignore_gravity: bool, set_ignore_gravity;
        /// Whether drag quadratic in the speed acts. Default false.
        #[doc(alias = "IsQuadraticDragEnabled")]
        is_quadratic_drag_enabled: bool, set_is_quadratic_drag_enabled;
        /// Whether an inactivity controller may disable the body. Default false.
        #[doc(alias = "IsAutoIdle")]
        is_auto_idle: bool, set_is_auto_idle;
        /// A number for the user's own purposes, such as the place of a name in a list. Default 0.
        #[doc(alias("Tag", "Body.Name"))]
        tag: u64, set_tag;
    }

    finite_properties! {
        /// Force per velocity that linear drag exerts, not scaled by mass. Default 0.001.
        #[doc(alias = "LinearDragCoefficient")]
        linear_drag_coefficient, set_linear_drag_coefficient;
        /// Factor of the quadratic drag; acts only when it is enabled. Default 0.001.
        #[doc(alias = "QuadraticDragCoefficient")]
        quadratic_drag_coefficient, set_quadratic_drag_coefficient;
        /// Torque per square of the angular velocity. Default 0.001.
        #[doc(alias = "RotationalDragCoefficient")]
        rotational_drag_coefficient, set_rotational_drag_coefficient;
        /// Milliseconds spent below [`minimum_velocity`](Self::minimum_velocity), kept by an inactivity controller.
        #[doc(alias = "IdleTime")]
        idle_time, set_idle_time;
        /// Speed from which on the body counts as moving. Default 55.
        #[doc(alias = "MinimumVelocity")]
        minimum_velocity, set_minimum_velocity;
        /// How strongly the simulator's gravity acts on the body: times what it does to others. Default 1; 0 is as
        /// [ignoring](Self::ignore_gravity) it, and with a negative number the body falls upward. Ours: the original has
        /// only the switch.
        gravity_scale, set_gravity_scale;
    }

    /// Position of the body's origin, its centre of mass.
    #[doc(alias = "Position")]
    #[inline]
    pub fn position(&self) -> Vector2 {
        self.position
    }

    /// Moves the body; its geoms follow. What is not finite is rejected.
    pub fn set_position(&mut self, value: Vector2) {
        if self.accepts_vector("position", value) {
            self.position = value;
            self.pose_is_dirty = true;
            self.target = None;
        }
    }

    /// Rotation in radians, normally from 0 to 2 pi inclusive.
    #[doc(alias = "Rotation")]
    #[inline]
    pub fn rotation(&self) -> f32 {
        self.rotation
    }

    /// Turns the body; its geoms follow. The value is brought into the range of one turn, and the turns taken
    /// off are **added** to [`revolutions`](Self::revolutions), as in the original. What is not finite is rejected.
    pub fn set_rotation(&mut self, value: f32) {
        if self.accepts("rotation", value) {
            self.normalize_rotation(value);
            self.pose_is_dirty = true;
            self.target = None;
        }
    }

    /// Whole turns taken so far.
    #[doc(alias = "Revolutions")]
    pub fn revolutions(&self) -> i32 {
        self.revolutions
    }

    /// Rotation plus 2 pi for every revolution, in radians.
    #[doc(alias = "TotalRotation")]
    pub fn total_rotation(&self) -> f32 {
        self.total_rotation
    }

    /// Velocity of the body's origin, per second.
    #[doc(alias = "LinearVelocity")]
    #[inline]
    pub fn linear_velocity(&self) -> Vector2 {
        self.linear_velocity
    }

    /// Sets the velocity. What is not finite is rejected. A static body keeps its velocity and does not move:
    /// what touches it feels a conveyor belt.
    pub fn set_linear_velocity(&mut self, value: Vector2) {
        if self.accepts_vector("linear_velocity", value) {
            self.linear_velocity = value;
            self.target = None;
        }
    }

    /// Angular velocity in rad/s.
    #[doc(alias = "AngularVelocity")]
    #[inline]
    pub fn angular_velocity(&self) -> f32 {
        self.angular_velocity
    }

    /// Sets the angular velocity. What is not finite is rejected.
    #[inline]
    pub fn set_angular_velocity(&mut self, value: f32) {
        if self.accepts("angular_velocity", value) {
            self.angular_velocity = value;
            self.target = None;
        }
    }

    /// Whether the speed is at least [`minimum_velocity`](Self::minimum_velocity); spin does not count.
    #[doc(alias = "Moves")]
    pub fn moves(&self) -> bool {
        length(self.linear_velocity) >= self.minimum_velocity
    }

    /// Mass. Default 1.
    #[doc(alias = "Mass")]
    pub fn mass(&self) -> f32 {
        self.mass
    }

    /// Sets the mass. Negative masses are accepted, as in the original.
    ///
    /// # Errors
    /// Zero, what is not finite, and what is so small that its reciprocal is not finite.
    pub fn set_mass(&mut self, value: f32) -> Result<()> {
        if value == 0.0 {
            return Err(Error::invalid("mass", value, "other than 0"));
        }
        finite("mass", value)?;
        if !(1.0 / value).is_finite() {
            return Err(Error::invalid("mass", value, "large enough for a finite reciprocal"));
        }
        self.mass = value;
        self.renew_inverses();
        Ok(())
    }

    /// Reciprocal of the mass; 0 for a static or kinematic body.
    #[doc(alias = "InverseMass")]
    #[inline]
    pub fn inverse_mass(&self) -> f32 {
        self.inverse_mass
    }

    /// Moment of inertia about the body's origin. Default 1.
    #[doc(alias = "MomentOfInertia")]
    pub fn moment_of_inertia(&self) -> f32 {
        self.moment_of_inertia
    }

    /// Sets the moment of inertia.
    ///
    /// # Errors
    /// Zero or less, what is not finite, and what is so small that its reciprocal is not finite.
    pub fn set_moment_of_inertia(&mut self, value: f32) -> Result<()> {
        crate::math::finite::positive("moment_of_inertia", value)?;
        if !(1.0 / value).is_finite() {
            return Err(Error::invalid("moment_of_inertia", value, "large enough for a finite reciprocal"));
        }
        self.moment_of_inertia = value;
        self.renew_inverses();
        Ok(())
    }

    /// Reciprocal of the moment of inertia; 0 for a static or kinematic body.
    #[doc(alias = "InverseMomentOfInertia")]
    #[inline]
    pub fn inverse_moment_of_inertia(&self) -> f32 {
        self.inverse_moment_of_inertia
    }

    /// Whether the body is immovable. Default false.
    #[doc(alias = "IsStatic")]
    #[inline]
    pub fn is_static(&self) -> bool {
        self.is_static
    }

    /// Makes the body immovable or movable. Velocities and accumulated forces stay: what was applied to a
    /// static body acts at once when it becomes dynamic. A [kinematic](Self::is_kinematic) body becomes static, or stays what
    /// it is.
    pub fn set_is_static(&mut self, value: bool) {
        if value {
            self.set_is_kinematic(false);
        }
        self.is_static = value;
        self.renew_inverses();
    }

    /// Force accumulated for the next update.
    #[doc(alias = "Force")]
    pub fn force(&self) -> Vector2 {
        self.force
    }

    /// Impulse accumulated for the next update, mass times velocity.
    pub fn impulse(&self) -> Vector2 {
        self.impulse
    }

    /// Torque accumulated for the next update.
    #[doc(alias = "Torque")]
    pub fn torque(&self) -> f32 {
        self.torque
    }

    /// Rotation about the body's origin and its translation, in row vector convention.
    #[doc(alias = "GetBodyMatrix")]
    pub fn get_body_matrix(&self) -> Matrix {
        let mut matrix = create_rotation_z(self.rotation);
        // The matrix product of the original adds zeros, which turn -0 into +0.
        matrix.m12 += 0.0;
        matrix.m21 += 0.0;
        matrix.m41 = 0.0 + self.position.x;
        matrix.m42 = 0.0 + self.position.y;
        matrix
    }

    /// Rotation about the body's origin alone.
    #[doc(alias = "GetBodyRotationMatrix")]
    pub fn get_body_rotation_matrix(&self) -> Matrix {
        create_rotation_z(self.rotation)
    }

    /// World position of a point given in the body's coordinates.
    #[doc(alias = "GetWorldPosition")]
    pub fn get_world_position(&self, local_position: Vector2) -> Vector2 {
        transform(local_position, &self.get_body_matrix())
    }

    /// Position in the body's coordinates of a point of the world.
    #[doc(alias = "GetLocalPosition")]
    pub fn get_local_position(&self, world_position: Vector2) -> Vector2 {
        let d = world_position - self.position;
        transform(d, &self.get_body_rotation_matrix().transpose())
    }

    /// The body's x axis in the world.
    #[doc(alias = "XVectorInWorldCoordinates")]
    pub fn x_vector_in_world_coordinates(&self) -> Vector2 {
        let matrix = self.get_body_matrix();
        Vector2::new(matrix.m11, matrix.m12)
    }

    /// The body's y axis in the world.
    #[doc(alias = "YVectorInWorldCoordinates")]
    pub fn y_vector_in_world_coordinates(&self) -> Vector2 {
        let matrix = self.get_body_matrix();
        Vector2::new(matrix.m21, matrix.m22)
    }

    /// Velocity of the point at this offset from the body's origin, in world orientation.
    #[doc(alias = "GetVelocityAtWorldOffset")]
    pub fn get_velocity_at_world_offset(&self, offset: Vector2) -> Vector2 {
        velocity_at(self.linear_velocity, self.angular_velocity, offset)
    }

    /// Like [`get_velocity_at_world_offset`](Self::get_velocity_at_world_offset), of the velocity with which
    /// the solver pushes overlapping bodies apart.
    #[doc(alias = "GetVelocityBiasAtWorldOffset")]
    pub fn get_velocity_bias_at_world_offset(&self, offset: Vector2) -> Vector2 {
        velocity_at(self.linear_velocity_bias, self.angular_velocity_bias, offset)
    }

    /// Velocity of the body at a point of the world.
    #[doc(alias = "GetVelocityAtWorldPoint")]
    pub fn get_velocity_at_world_point(&self, world_point: Vector2) -> Vector2 {
        self.get_velocity_at_world_offset(world_point - self.position)
    }

    /// Velocity of a point given in the body's coordinates. The original adds the position and subtracts it
    /// again, so the result loses digits far from the origin.
    #[doc(alias = "GetVelocityAtLocalPoint")]
    pub fn get_velocity_at_local_point(&self, local_point: Vector2) -> Vector2 {
        self.get_velocity_at_world_offset(self.get_world_position(local_point) - self.position)
    }

    /// Adds a force at the body's origin, acting over the next update.
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

    /// Adds a torque, acting over the next update.
    #[doc(alias = "ApplyTorque")]
    pub fn apply_torque(&mut self, torque: f32) {
        let torque = self.torque + torque;
        if self.accepts("torque", torque) {
            self.torque = torque;
        }
    }

    /// Adds an impulse, mass times velocity, that changes the velocity at the next update.
    #[doc(alias = "ApplyImpulse")]
    pub fn apply_impulse(&mut self, amount: Vector2) {
        let impulse = self.impulse + amount;
        if self.accepts_vector("amount", impulse) {
            self.impulse = impulse;
        }
    }

    /// Changes the angular velocity at once by the impulse over the moment of inertia.
    #[doc(alias = "ApplyAngularImpulse")]
    pub fn apply_angular_impulse(&mut self, amount: f32) {
        let angular_velocity = self.angular_velocity + amount * self.inverse_moment_of_inertia;
        if self.accepts("amount", amount) && self.accepts("amount", angular_velocity) {
            self.angular_velocity = angular_velocity;
        }
    }

    /// Forgets the accumulated force.
    #[doc(alias = "ClearForce")]
    pub fn clear_force(&mut self) {
        self.force = Vector2::zeros();
    }

    /// Forgets the accumulated torque.
    #[doc(alias = "ClearTorque")]
    pub fn clear_torque(&mut self) {
        self.torque = 0.0;
    }

    /// Forgets the accumulated impulse.
    #[doc(alias = "ClearImpulse")]
    pub fn clear_impulse(&mut self) {
        self.impulse = Vector2::zeros();
    }

    /// Puts the body at rest at the origin without rotation; forces, torque and impulse are forgotten. Mass,
    /// flags and drag stay, and so does the velocity with which the solver was pushing it out of an overlap.
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

    fn normalize_rotation(&mut self, raw: f32) {
        let turns = whole_turns(raw);
        self.rotation = raw - turns as f32 * TWO_PI;
        self.revolutions = self.revolutions.wrapping_add(turns);
        self.total_rotation = self.rotation + self.revolutions as f32 * TWO_PI;
    }
}

/// The turns that are taken off a rotation.
fn whole_turns(raw: f32) -> i32 {
    let turns = scalar::to_int(raw / TWO_PI);
    if raw < 0.0 { turns.wrapping_sub(1) } else { turns }
}

/// Where a body is and how far it has turned.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) struct Pose {
    pub(crate) position: Vector2,
    pub(crate) rotation: f32,
    pub(crate) revolutions: i32,
    pub(crate) total_rotation: f32,
}

/// Velocity at an offset from the centre of mass.
#[inline(always)]
pub(crate) fn velocity_at(linear: Vector2, angular: f32, offset: Vector2) -> Vector2 {
    Vector2::new(-angular * offset.y + linear.x, angular * offset.x + linear.y)
}

/// What the simulator does with a body that is enabled and not static (behaviour chapter 02, sections 5, 6).
impl Body {
    /// Whether the simulator moves the body.
    #[inline]
    pub(crate) fn is_integrated(&self) -> bool {
        self.enabled && !self.is_static
    }

    /// Whether the position and rotation are finite.
    #[inline]
    pub(crate) fn place_is_finite(&self) -> bool {
        let sum =
            self.position.x * 0.0 + self.position.y * 0.0 + self.rotation * 0.0 + self.total_rotation * 0.0;
        sum == 0.0
    }

    /// Whether position, rotation and velocities are finite.
    pub(crate) fn is_finite(&self) -> bool {
        let sum = self.linear_velocity.x * 0.0
            + self.linear_velocity.y * 0.0
            + self.angular_velocity * 0.0
            + self.linear_velocity_bias.x * 0.0
            + self.linear_velocity_bias.y * 0.0
            + self.angular_velocity_bias * 0.0;
        sum == 0.0 && self.place_is_finite()
    }

    /// Whether the velocity is finite: all that forces change.
    #[inline]
    pub(crate) fn moves_finitely(&self) -> bool {
        self.linear_velocity.x * 0.0 + self.linear_velocity.y * 0.0 + self.angular_velocity * 0.0 == 0.0
    }

    /// What part of gravity acts on the body.
    #[inline]
    pub(crate) fn gravity_part(&self) -> f32 {
        if self.ignore_gravity || self.is_immovable() { 0.0 } else { self.gravity_scale }
    }

    /// Adds gravity to the accumulated force. A scale of 1 changes no bit.
    #[inline]
    pub(crate) fn accumulate_gravity(&mut self, gravity: Vector2) {
        if !self.ignore_gravity {
            self.force.x += gravity.x * self.mass * self.gravity_scale;
            self.force.y += gravity.y * self.mass * self.gravity_scale;
        }
    }

    /// Turns the accumulated impulse into velocity. Also without any impulse: the addition turns -0 into +0.
    #[inline]
    pub(crate) fn apply_accumulated_impulse(&mut self) {
        if !self.is_immovable() {
            self.linear_velocity += self.impulse * self.inverse_mass;
        }
        self.impulse = Vector2::zeros();
    }

    /// Turns force and drag into velocity over `dt` seconds, then forgets the force.
    #[inline]
    pub(crate) fn integrate_velocity(&mut self, dt: f32) {
        let v = self.linear_velocity;
        let w = self.angular_velocity;
        let mut drag = -v * self.linear_drag_coefficient;
        if self.is_quadratic_drag_enabled {
            let speed = length(v);
            drag.x += -speed * self.quadratic_drag_coefficient * scalar::sign(v.x);
            drag.y += -speed * self.quadratic_drag_coefficient * scalar::sign(v.y);
        }
        self.force += drag;
        let rotational_drag = w * w * scalar::sign(w) * -self.rotational_drag_coefficient;
        self.torque += rotational_drag;
        self.linear_velocity += self.force * self.inverse_mass * dt;
        self.angular_velocity += self.torque * self.inverse_moment_of_inertia * dt;
        self.force = Vector2::zeros();
        self.torque = 0.0;
    }

    /// What the precise set reads before a step: the accelerations by forces and torque, which are forgotten then, and by drag
    /// in proportion to the square of the velocity.
    pub(crate) fn take_accelerations(&mut self) -> (Vector2, f32) {
        let mut force = std::mem::replace(&mut self.force, Vector2::zeros());
        if self.is_quadratic_drag_enabled {
            force -= self.linear_velocity * (length(self.linear_velocity) * self.quadratic_drag_coefficient);
        }
        let torque = std::mem::take(&mut self.torque);
        (force * self.inverse_mass, torque * self.inverse_moment_of_inertia)
    }

    /// What part of its velocity and of its spin the body loses to drag in a second, at the spin it has.
    pub(crate) fn drag_rates(&self) -> (f32, f32) {
        let spin_drag = self.rotational_drag_coefficient * self.angular_velocity.abs();
        (self.linear_drag_coefficient * self.inverse_mass, spin_drag * self.inverse_moment_of_inertia)
    }

    /// Moves the body to where a step of the precise set has brought it.
    pub(crate) fn end_step(&mut self, position: Vector2, turned_by: f32, velocity: Vector2, spin: f32) {
        self.position = position;
        self.normalize_rotation(self.rotation + turned_by);
        (self.linear_velocity, self.angular_velocity) = (velocity, spin);
        self.has_moved = true;
        self.land();
    }

    /// Moves the body over `dt` seconds and answers whether its pose changed.
    #[inline]
    pub(crate) fn integrate_position(&mut self, dt: f32) -> bool {
        let mut moved = false;
        let d = (self.linear_velocity + self.linear_velocity_bias) * dt;
        if d.x != 0.0 || d.y != 0.0 {
            self.position += d;
            moved = true;
        }
        self.linear_velocity_bias = Vector2::zeros();
        let turn = (self.angular_velocity + self.angular_velocity_bias) * dt;
        if turn != 0.0 {
            self.normalize_rotation(self.rotation + turn);
            moved = true;
        }
        self.angular_velocity_bias = 0.0;
        if self.is_kinematic {
            self.land();
        }
        self.has_moved |= moved;
        moved
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

    /// Whether the original raises its Updated event at the end of every step: from the first movement on.
    #[inline]
    pub(crate) fn has_moved(&self) -> bool {
        self.has_moved
    }
}
