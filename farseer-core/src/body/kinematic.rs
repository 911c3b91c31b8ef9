//! Bodies that a game moves and nothing pushes: lifts, doors, turntables. Ours: the original has none.

use serde::{Deserialize, Serialize};

use super::Body;
use super::motion::whole_turns;
use crate::math::finite::{finite, finite_vector};
use crate::math::{Vector2, math_helper::TWO_PI};
use crate::{Error, Result};

const PI: f32 = std::f32::consts::PI;

/// Where a kinematic body is brought.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) struct Target {
    position: Vector2,
    /// In the range of one turn.
    rotation: f32,
    progress: Progress,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
enum Progress {
    /// The next update brings the body there.
    Due,
    /// The body has the velocity that does.
    Moving,
    /// The next update lets the body stand still.
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

    /// Makes the body kinematic, or dynamic if it was. Ours: the original has only static and dynamic bodies.
    ///
    /// A kinematic body has infinite mass, as a static one. It goes on with its linear and angular velocity, or to where it
    /// is [told](Self::move_to) to; no force, gravity, drag or push changes that, and what was applied to it is forgotten
    /// with each update. It pushes dynamic bodies, with the precise set also those on its way in an update, however fast it is, carries
    /// them by friction, and passes through static and other kinematic
    /// ones. It is not [static](Self::is_static), and making it static ends this. With both
    /// [sets of methods](crate::Methods).
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
        self.renew_inverses();
    }

    /// Lets the next update bring a kinematic body to a position and rotation, where it then is to the last bit. It has the
    /// velocity that does, turning the shorter way, so that it pushes and carries what it touches. In the update after that
    /// it stands still, unless it is told a new place or given a velocity before.
    ///
    /// # Errors
    /// What is not finite; a body that is not [kinematic](Self::is_kinematic).
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

    /// Whether nothing can push the body: it is static or kinematic.
    #[inline]
    pub(crate) fn is_immovable(&self) -> bool {
        self.is_static || self.is_kinematic
    }

    pub(super) fn renew_inverses(&mut self) {
        let is_immovable = self.is_immovable();
        self.inverse_mass = if is_immovable { 0.0 } else { 1.0 / self.mass };
        self.inverse_moment_of_inertia = if is_immovable { 0.0 } else { 1.0 / self.moment_of_inertia };
    }

    /// Forgets what was applied, and takes the velocity that leads to the target in `dt` seconds. One to which no finite
    /// velocity leads is forgotten.
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

    /// The linear and angular velocity that a kinematic body has in the step of `dt` seconds that comes.
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

    /// Whether the next update moves the body, if it is kinematic.
    pub(crate) fn is_on_its_way(&self) -> bool {
        let is_due = self.target.is_some_and(|target| target.progress != Progress::Reached);
        let moves = self.linear_velocity != Vector2::zeros() || self.angular_velocity != 0.0;
        is_due || (moves && self.target.is_none())
    }

    /// The body stays where it is.
    pub(crate) fn forget_target(&mut self) {
        self.target = None;
    }

    /// A body that was on its way to its target is there.
    pub(crate) fn land(&mut self) {
        let Some(target) = self.target.as_mut().filter(|target| target.progress == Progress::Moving) else {
            return;
        };
        target.progress = Progress::Reached;
        // The way may have ended just beyond one turn, or before it.
        let turns = ((self.rotation - target.rotation) / TWO_PI).round() as i32;
        (self.position, self.rotation) = (target.position, target.rotation);
        self.revolutions = self.revolutions.wrapping_add(turns);
        self.total_rotation = self.rotation + self.revolutions as f32 * TWO_PI;
    }
}
