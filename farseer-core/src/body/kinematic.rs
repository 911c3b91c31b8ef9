//! Kinematic bodies: moved by the game and by no force or contact, such as lifts, doors, turntables. Ours: the original
//! has none.

use serde::{Deserialize, Serialize};

use super::Body;
use super::motion::whole_turns;
use crate::math::finite::{finite, finite_vector};
use crate::math::{Vector2, math_helper::TWO_PI};
use crate::{Error, Result};

const PI: f32 = std::f32::consts::PI;

/// The pose to which [`Body::move_to`] brings a kinematic body.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) struct Target {
    position: Vector2,
    /// Radians, within one turn.
    rotation: f32,
    progress: Progress,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
enum Progress {
    /// The next update moves the body to the pose.
    Due,
    /// The body has the velocity that brings it there in this step.
    Moving,
    /// The body is there; the next update sets its velocity to zero.
    Reached,
}

impl Target {
    pub(super) fn is_finite(&self) -> bool {
        self.position.x.is_finite() && self.position.y.is_finite() && self.rotation.is_finite()
    }
}

impl Body {
    /// Whether the body is moved by the game alone. Default false.
    #[inline]
    pub fn is_kinematic(&self) -> bool {
        self.is_kinematic
    }

    /// Makes the body kinematic, or dynamic if it was kinematic. Ours: the original has only static and dynamic bodies.
    ///
    /// A kinematic body has infinite mass, as a static one. It keeps its linear and angular velocity, or goes to the
    /// pose that [`move_to`](Self::move_to) sets. No force, gravity, drag or contact changes its motion, and each
    /// update discards the forces that were applied to it. It pushes dynamic bodies and carries them by friction. It
    /// passes through static and other kinematic bodies. With the precise set it also pushes those that it would cross
    /// within an update, however fast it is.
    ///
    /// It is not [static](Self::is_static), and making it static ends this. With both [sets of
    /// methods](crate::Methods).
    ///
    /// ```
    /// use farseer_core::{BodyFactory, PhysicsSimulator, math::Vector2};
    /// let mut simulator = PhysicsSimulator::new(Vector2::new(0.0, 100.0))?;
    /// let lift = BodyFactory::create_rectangle_body_in(&mut simulator, 80.0, 10.0, 1.0)?;
    /// simulator[lift].set_is_kinematic(true);
    /// simulator[lift].set_linear_velocity(Vector2::new(0.0, -60.0));
    /// (0..100).for_each(|_| simulator.update(0.01));
    /// assert!((simulator[lift].position().y + 60.0).abs() < 0.001);
    /// # Ok::<(), farseer_core::Error>(())
    /// ```
    pub fn set_is_kinematic(&mut self, value: bool) {
        self.is_static &= !value;
        self.is_kinematic = value;
        self.target = None;
        self.update_inverse_mass();
    }

    /// Lets the next update bring a kinematic body to a position and rotation, exact to the last bit. In that update it
    /// has the velocity that leads there, by the shorter turn, so that it pushes and carries the bodies it touches. In
    /// the update after that it stands still, unless it is given a new target or a velocity before.
    ///
    /// # Errors
    /// A value that is not finite; a body that is not [kinematic](Self::is_kinematic).
    pub fn move_to(&mut self, position: Vector2, rotation: f32) -> Result<()> {
        finite_vector("position", position)?;
        finite("rotation", rotation)?;
        if !self.is_kinematic {
            return Err(Error::WrongKind { argument: "body", expected: "kinematic body" });
        }
        let rotation = rotation - whole_turns(rotation) as f32 * TWO_PI;
        self.target = Some(Target { position, rotation, progress: Progress::Due });
        Ok(())
    }

    /// Whether no impulse changes the body's velocity: it is static or kinematic.
    #[inline]
    pub(crate) fn is_immovable(&self) -> bool {
        self.is_static || self.is_kinematic
    }

    pub(super) fn update_inverse_mass(&mut self) {
        let is_immovable = self.is_immovable();
        self.inverse_mass = if is_immovable { 0.0 } else { 1.0 / self.mass };
        let cannot_turn = is_immovable || self.is_rotation_locked();
        self.inverse_moment_of_inertia = if cannot_turn { 0.0 } else { 1.0 / self.moment_of_inertia };
        if self.holds_rotation() {
            self.angular_velocity = 0.0;
        }
    }

    /// Clears force, torque and impulse, and sets the velocity that leads to the target in `dt` seconds. If that
    /// velocity is not finite, the target is discarded.
    pub(crate) fn begin_kinematic_step(&mut self, dt: f32) {
        self.clear_force();
        self.clear_torque();
        self.clear_impulse();
        let Some(target) = self.target else { return };
        (self.linear_velocity, self.angular_velocity) = self.kinematic_velocity(dt);
        let is_there = target.progress == Progress::Reached;
        self.target =
            Some(Target { progress: Progress::Moving, ..target }).filter(|_| !is_there && self.is_finite());
    }

    /// Linear and angular velocity, in length units/s and rad/s, of a kinematic body in the next step of `dt` seconds.
    pub(crate) fn kinematic_velocity(&self, dt: f32) -> (Vector2, f32) {
        let Some(target) = self.target else { return (self.linear_velocity, self.angular_velocity) };
        if target.progress == Progress::Reached {
            return (Vector2::zeros(), 0.0);
        }
        let turn = target.rotation - self.rotation;
        let shorter = if turn > PI {
            turn - TWO_PI
        } else if turn < -PI {
            turn + TWO_PI
        } else {
            turn
        };
        ((target.position - self.position) / dt, shorter / dt)
    }

    /// Sets the exact target pose at the end of the step that led to it.
    #[cold]
    pub(crate) fn finish_move(&mut self) {
        let Some(target) = self.target.as_mut().filter(|target| target.progress == Progress::Moving) else {
            return;
        };
        target.progress = Progress::Reached;
        // Rounding may have ended the motion just beyond one turn, or before it.
        let turns = ((self.rotation - target.rotation) / TWO_PI).round() as i32;
        (self.position, self.rotation) = (target.position, target.rotation);
        self.revolutions = self.revolutions.wrapping_add(turns);
        self.total_rotation = self.rotation + self.revolutions as f32 * TWO_PI;
    }
}

/// Queries and changes that the precise set needs.
#[cfg(feature = "precise")]
impl Body {
    /// Whether the next update moves the body, if it is kinematic.
    pub(crate) fn will_move(&self) -> bool {
        let is_due = self.target.is_some_and(|target| target.progress != Progress::Reached);
        let moves = self.linear_velocity != Vector2::zeros() || self.angular_velocity != 0.0;
        is_due || (moves && self.target.is_none())
    }

    /// Discards the target: the body stays where it is.
    pub(crate) fn clear_target(&mut self) {
        self.target = None;
    }
}
