//! The description of a body.

use crate::Result;
use crate::math::Vector2;
use crate::math::finite::{finite, finite_vector, positive, zero_or_more};
use crate::methods::Methods;

/// Kind of a body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    /// Forces and contacts move it.
    Dynamic,
    /// The game alone moves it.
    Kinematic,
    /// It never moves.
    Fixed,
}

/// Describes a body for [`add_body`](crate::Objects::add_body), which adds it together with its geoms.
///
/// Lengths are in the user's unit, y down; times in seconds; angles in radians, clockwise on the screen. Values are checked when
/// the body is added, and errors name the method of the builder.
///
/// ```
/// use farseer_core::{BodyBuilder, GeomBuilder, PhysicsSimulator};
/// let mut simulator = PhysicsSimulator::precise([0.0, 300.0])?;
/// simulator.add_body(BodyBuilder::fixed().position([0.0, 10.0]), [GeomBuilder::rectangle(400.0, 20.0)])?;
///
/// // A hammer: mass, centre of mass and moment of inertia are those of both parts together.
/// let handle = GeomBuilder::rectangle(8.0, 60.0);
/// let head = GeomBuilder::rectangle(40.0, 16.0).offset([0.0, -38.0]).density(0.004);
/// let hammer = BodyBuilder::dynamic().position([0.0, -100.0]).angular_velocity(1.0);
/// let (hammer, [_, head]) = simulator.add_body(hammer, [handle, head])?;
///
/// (0..240).for_each(|_| simulator.update(1.0 / 60.0));
/// assert!(simulator.is_asleep(hammer));
/// assert_eq!(simulator.body_of(head), Some(hammer));
/// # Ok::<(), farseer_core::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[must_use]
pub struct BodyBuilder {
    pub(super) kind: Kind,
    pub(super) position: Vector2,
    pub(super) rotation: f32,
    pub(super) linear_velocity: Vector2,
    pub(super) angular_velocity: f32,
    pub(super) linear_damping: f32,
    pub(super) angular_damping: f32,
    pub(super) gravity_scale: f32,
    pub(super) mass: Option<f32>,
    pub(super) moment_of_inertia: Option<f32>,
    pub(super) user_data: u64,
    pub(super) enabled: bool,
    pub(super) locks_rotation: bool,
    pub(super) locked_axes: [bool; 2],
    pub(super) is_bullet: bool,
    pub(super) sleep_allowed: bool,
    pub(super) starts_asleep: bool,
    /// `None`: as the methods have them.
    pub(super) sleep_events: Option<bool>,
}

impl BodyBuilder {
    fn new(kind: Kind) -> Self {
        BodyBuilder {
            kind,
            position: Vector2::zeros(),
            rotation: 0.0,
            linear_velocity: Vector2::zeros(),
            angular_velocity: 0.0,
            linear_damping: 0.0,
            angular_damping: 0.0,
            gravity_scale: 1.0,
            mass: None,
            moment_of_inertia: None,
            user_data: 0,
            enabled: true,
            locks_rotation: false,
            locked_axes: [false; 2],
            is_bullet: false,
            sleep_allowed: true,
            starts_asleep: false,
            sleep_events: None,
        }
    }

    /// A body that forces, contacts and joints move.
    pub fn dynamic() -> Self {
        BodyBuilder::new(Kind::Dynamic)
    }

    /// A body that the game alone moves, by velocities or [`Body::move_to`](crate::Body::move_to): lifts, doors.
    pub fn kinematic() -> Self {
        BodyBuilder::new(Kind::Kinematic)
    }

    /// A body that never moves: a static one.
    #[doc(alias = "static")]
    pub fn fixed() -> Self {
        BodyBuilder::new(Kind::Fixed)
    }

    /// Position in the world of the point to which the offsets of the geoms refer, in length units. Default the origin.
    ///
    /// The [position](crate::Body::position) of the added body is that of its centre of mass. It is the same point for geoms
    /// that lie evenly about it, and for static and kinematic bodies.
    pub fn position(mut self, position: impl Into<Vector2>) -> Self {
        self.position = position.into();
        self
    }

    /// Rotation in radians, about the [position](Self::position). Default 0.
    pub fn rotation(mut self, rotation: f32) -> Self {
        self.rotation = rotation;
        self
    }

    /// Velocity of the centre of mass, in length units/s. Default 0. That of a static body makes it a conveyor belt.
    pub fn linear_velocity(mut self, linear_velocity: impl Into<Vector2>) -> Self {
        self.linear_velocity = linear_velocity.into();
        self
    }

    /// Angular velocity in rad/s. Default 0.
    pub fn angular_velocity(mut self, angular_velocity: f32) -> Self {
        self.angular_velocity = angular_velocity;
        self
    }

    /// Fraction of the velocity that is lost per second, 0 or more, in 1/s: the velocity decays as exp(-damping · time). Default
    /// 0. Sets the body's [drag coefficient](crate::Body::linear_drag_coefficient) to damping · mass.
    pub fn linear_damping(mut self, linear_damping: f32) -> Self {
        self.linear_damping = linear_damping;
        self
    }

    /// Fraction of the angular velocity that is lost per second, 0 or more, in 1/s. Default 0. Makes the rotational drag
    /// [linear](crate::Body::is_rotational_drag_linear), with the coefficient damping · moment of inertia.
    pub fn angular_damping(mut self, angular_damping: f32) -> Self {
        self.angular_damping = angular_damping;
        self
    }

    /// Factor of gravity, dimensionless. Default 1; with 0 the body floats, with a negative number it falls upward.
    pub fn gravity_scale(mut self, gravity_scale: f32) -> Self {
        self.gravity_scale = gravity_scale;
        self
    }

    /// Mass of the whole body, in mass units, greater than 0. Without it, it is the sum of the masses of the geoms; with it
    /// these masses keep their proportions. A body without geoms has mass 1 by default.
    pub fn mass(mut self, mass: f32) -> Self {
        self.mass = Some(mass);
        self
    }

    /// Moment of inertia about the centre of mass, in mass units · length units², greater than 0. Default that of the geoms;
    /// without geoms that of a square with sides of one length unit of the methods.
    pub fn moment_of_inertia(mut self, moment_of_inertia: f32) -> Self {
        self.moment_of_inertia = Some(moment_of_inertia);
        self
    }

    /// [Locks the rotation](crate::Body::set_rotation_locked): for figures that stay upright. Default false.
    pub fn lock_rotation(mut self, locks_rotation: bool) -> Self {
        self.locks_rotation = locks_rotation;
        self
    }

    /// [Locks the x coordinate](crate::Objects::set_axes_locked): for lifts, and things that fall straight. Default false. Only
    /// with the precise set.
    pub fn lock_x(mut self, locks_x: bool) -> Self {
        self.locked_axes[0] = locks_x;
        self
    }

    /// [Locks the y coordinate](crate::Objects::set_axes_locked): for paddles and sliding doors. Default false. Only with the
    /// precise set.
    pub fn lock_y(mut self, locks_y: bool) -> Self {
        self.locked_axes[1] = locks_y;
        self
    }

    /// Continuous collision also with dynamic bodies: see [`Body::is_bullet`](crate::Body::is_bullet). Default false. Only with
    /// the precise set.
    pub fn bullet(mut self, is_bullet: bool) -> Self {
        self.is_bullet = is_bullet;
        self
    }

    /// Whether the body [may sleep](crate::Body::is_sleep_allowed). Default true.
    pub fn sleep_allowed(mut self, sleep_allowed: bool) -> Self {
        self.sleep_allowed = sleep_allowed;
        self
    }

    /// Lets the body sleep from the first update on, at its place: for piles, and things that wait in the air. It falls asleep
    /// if all bodies that touch it, or are joined to it, sleep or start asleep too. Default false. Only with the precise set.
    pub fn starts_asleep(mut self, starts_asleep: bool) -> Self {
        self.starts_asleep = starts_asleep;
        self
    }

    /// Whether falling asleep and waking are [events](crate::Event::BodySlept). Default true with the precise set.
    pub fn sleep_events(mut self, sleep_events: bool) -> Self {
        self.sleep_events = Some(sleep_events);
        self
    }

    /// Whether the body takes part in the simulation. Default true.
    pub fn enabled(mut self, enabled: bool) -> Self {
        self.enabled = enabled;
        self
    }

    /// The number of the game that [`Body::tag`](crate::Body::tag) returns. Default 0.
    pub fn user_data(mut self, user_data: u64) -> Self {
        self.user_data = user_data;
        self
    }

    /// Refuses values that are not possible, and options that the methods do not have.
    pub(super) fn check(&self, methods: Methods) -> Result<()> {
        finite_vector("position", self.position)?;
        finite("rotation", self.rotation)?;
        finite_vector("linear_velocity", self.linear_velocity)?;
        finite("angular_velocity", self.angular_velocity)?;
        zero_or_more("linear_damping", self.linear_damping)?;
        zero_or_more("angular_damping", self.angular_damping)?;
        finite("gravity_scale", self.gravity_scale)?;
        self.mass.map(|mass| positive("mass", mass)).transpose()?;
        self.moment_of_inertia.map(|inertia| positive("moment_of_inertia", inertia)).transpose()?;
        if self.is_bullet {
            methods.only_precise("bullets")?;
        }
        if self.locked_axes.contains(&true) {
            methods.only_precise("locked axes of bodies")?;
        }
        if self.starts_asleep || !self.sleep_allowed || self.sleep_events == Some(true) {
            methods.only_precise("sleep")?;
        }
        Ok(())
    }
}
