//! The state of motion of one rigid body (behaviour chapter 02).
//!
//! Lengths are in the user's unit, velocities per second, angles in radians, screen orientation (x right,
//! y down, so that positive angles turn clockwise on the screen).

pub(crate) mod entry;
mod forces;
mod frame;
mod integration;
mod kinematic;
mod mass;
pub(crate) mod missing_body;
mod motion;
mod options;
#[cfg(feature = "precise")]
mod precise_step;
mod rejected_arguments;
mod save;
mod switches;

pub(crate) use self::motion::Pose;
use self::options::BodyOptions;
use self::rejected_arguments::BodyArguments;
use crate::math::Vector2;
pub use crate::storage::ids::BodyId;
use crate::storage::rejected_arguments::RejectedArguments;

/// The state of motion of one rigid body. It has no shape; geoms attached to it have.
///
/// A body is made by [`BodyFactory`](crate::BodyFactory) or [`Body::new`] and given to a simulator, which answers with
/// a [`BodyId`]: `simulator[body]` is the body from then on.
///
/// Methods that a game calls every frame return nothing. Given a value that is not finite they change nothing; the
/// simulator reports the refusal as [`Event::RejectedInput`](crate::Event::RejectedInput) in its next update. After
/// sixteen refusals it reports only arguments that were not refused before, each once.
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
    options: BodyOptions,
    /// Target pose of a kinematic body.
    target: Option<kinematic::Target>,
    enabled: bool,
    ignore_gravity: bool,
    is_quadratic_drag_enabled: bool,
    is_auto_idle: bool,
    /// Set by the first movement and never cleared; see [`Body::integrate_position`].
    has_moved: bool,
    /// Whether a setter has moved the body since its geoms were last brought to it.
    pub(crate) pose_is_dirty: bool,
    /// Arguments that setters refused since the simulator last reported them.
    pub(crate) rejected: RejectedArguments<BodyArguments>,
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

        #[doc = concat!("Sets [`", stringify!($field), "`](Self::", stringify!($field), "). A number that is not finite is rejected.")]
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
    #[doc(alias = "Body()")]
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
            options: BodyOptions::default(),
            target: None,
            enabled: true,
            ignore_gravity: false,
            is_quadratic_drag_enabled: false,
            is_auto_idle: false,
            has_moved: false,
            pose_is_dirty: false,
            rejected: RejectedArguments::default(),
        }
    }

    /// A new body with the mass, inertia, drag, tag and flags of another (behaviour chapter 02, section 7). Position,
    /// velocities, accumulators, idle time and idle settings are those of [`Body::new`].
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
            options: body.options.of_copy(),
            ..Body::new()
        }
    }

    properties! {
        /// Whether the body takes part in the simulation. Default true.
        #[doc(alias = "Enabled")]
        enabled: bool, set_enabled;
        /// Whether gravity has no effect on the body. Default false.
        #[doc(alias = "IgnoreGravity")]
        ignore_gravity: bool, set_ignore_gravity;
        /// Whether drag quadratic in the speed acts. Default false.
        #[doc(alias = "IsQuadraticDragEnabled")]
        is_quadratic_drag_enabled: bool, set_is_quadratic_drag_enabled;
        /// Whether an inactivity controller may disable the body. Default false.
        #[doc(alias = "IsAutoIdle")]
        is_auto_idle: bool, set_is_auto_idle;
        /// A number for the user's own purposes, such as the index of a name in a list. Default 0.
        #[doc(alias("Tag", "Body.Name"))]
        tag: u64, set_tag;
    }

    finite_properties! {
        /// Coefficient c of linear drag: force = -c · velocity. Mass units/s, not scaled by mass. Default 0.001.
        #[doc(alias = "LinearDragCoefficient")]
        linear_drag_coefficient, set_linear_drag_coefficient;
        /// Coefficient c of quadratic drag, in mass units/length unit. It acts only when it is
        /// [enabled](Self::is_quadratic_drag_enabled). Default 0.001.
        #[doc(alias = "QuadraticDragCoefficient")]
        quadratic_drag_coefficient, set_quadratic_drag_coefficient;
        /// Coefficient c of rotational drag: torque = -c · angular velocity · |angular velocity|. Default 0.001.
        #[doc(alias = "RotationalDragCoefficient")]
        rotational_drag_coefficient, set_rotational_drag_coefficient;
        /// Milliseconds spent below [`minimum_velocity`](Self::minimum_velocity), counted by an inactivity controller.
        #[doc(alias = "IdleTime")]
        idle_time, set_idle_time;
        /// Speed in length units/s, from which on the body counts as moving. Default 55.
        #[doc(alias = "MinimumVelocity")]
        minimum_velocity, set_minimum_velocity;
        /// Factor by which the simulator's gravity acts on the body, dimensionless. Default 1; 0 has the same effect as
        /// [ignoring](Self::ignore_gravity) gravity, and with a negative number the body falls upward. Ours: the
        /// original has only the switch.
        gravity_scale, set_gravity_scale;
    }
}
