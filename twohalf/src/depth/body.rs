//! What a body has beyond that of the 2D engine: motion along Z, and a ground.

use farseer_core::{ArgumentNames, Body, BodyId, PhysicsSimulator, Refusals, SpaceBody, SpaceTarget};
use serde::{Deserialize, Serialize};

use super::ground::Ground;
use super::support::Support;
use crate::Vector3;

/// The motion of a body along Z, and its ground.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub(crate) struct DepthBody {
    pub(crate) z: f32,
    pub(crate) velocity_z: f32,
    /// Rolling: rotation about the x axis and, with y down, the y axis, which is not drawn.
    pub(crate) angular_velocity_x: f32,
    pub(crate) angular_velocity_y: f32,
    /// How the body moved in the last update, y down; `None` before its first.
    pub(crate) motion: Option<Vector3>,
    /// How deep it was in what it parted from last: the precise set remembers.
    pub(crate) sunk: f32,
    /// Velocity along Z that only undid overlap in the last update.
    #[serde(skip)]
    pub(crate) bias_z: f32,
    pub(crate) force_z: f32,
    pub(crate) impulse_z: f32,
    /// Where a kinematic body is brought.
    pub(crate) target: Option<SpaceTarget>,
    pub(crate) ground: Ground,
    /// What held the body up best in the last update.
    pub(crate) support: Option<Support>,
    /// Whether that was in the update before the last, and the body has hardly moved since.
    pub(crate) is_support_kept: bool,
    /// Arguments that setters of this engine have refused and nobody was told of yet.
    pub(crate) rejected: Refusals<DepthArguments>,
    /// It is among the [news](Depths::news).
    #[serde(skip)]
    pub(crate) is_news: bool,
}

/// What setters of this engine refuse; what those of the 2D engine do is told by that.
#[derive(Debug)]
pub(crate) struct DepthArguments;

impl ArgumentNames for DepthArguments {
    const NAMES: &'static [&'static str] = &[
        "position3d",
        "velocity3d",
        "angular_velocity3d",
        "linear_velocity_z",
        "amount",
        "friction_coefficient",
        "restitution_coefficient",
    ];
}

impl DepthBody {
    /// Whether everything that enters arithmetic is finite: false only after loading garbage.
    pub(crate) fn is_valid(&self) -> bool {
        let numbers = [self.force_z, self.impulse_z, self.sunk];
        self.motion_is_finite()
            && self.motion.is_none_or(|motion| motion.iter().all(|number| number.is_finite()))
            && numbers.iter().all(|number| number.is_finite())
            && self.target.is_none_or(|target| target.z.is_finite())
            && self.ground.is_valid()
            && self.support.is_none_or(|support| support.normal.iter().all(|number| number.is_finite()))
    }

    pub(crate) fn motion_is_finite(&self) -> bool {
        let numbers = [self.z, self.velocity_z, self.angular_velocity_x, self.angular_velocity_y];
        numbers.iter().all(|number| number.is_finite())
    }

    /// What the precise set is told of it, with a velocity and an acceleration along Z.
    pub(crate) fn told(&self, velocity: f32, acceleration: f32, is_kinematic: bool) -> SpaceBody {
        SpaceBody {
            z: self.z,
            velocity,
            acceleration,
            motion: self.motion.unwrap_or_default().into(),
            sunk: self.sunk,
            angular_velocity: [self.angular_velocity_x, self.angular_velocity_y],
            target: self.target.filter(|_| is_kinematic),
        }
    }

    /// Impulse, force and drag become velocity, as the 2D engine does it for X and Y (behaviour chapter 02,
    /// section 5); then force and impulse are forgotten.
    pub(crate) fn integrate_velocity(&mut self, body: &Body, dt: f32) {
        self.velocity_z += self.impulse_z * body.inverse_mass();
        let mut drag = -self.velocity_z * body.linear_drag_coefficient();
        if body.is_quadratic_drag_enabled() && self.velocity_z != 0.0 {
            let v = body.linear_velocity();
            let speed = (v.x * v.x + v.y * v.y + self.velocity_z * self.velocity_z).sqrt();
            drag -= speed * body.quadratic_drag_coefficient() * self.velocity_z.signum();
        }
        self.velocity_z += (self.force_z + drag) * body.inverse_mass() * dt;
        let (spin_x, spin_y) = (self.angular_velocity_x, self.angular_velocity_y);
        if spin_x != 0.0 || spin_y != 0.0 {
            let spin = (spin_x * spin_x + spin_y * spin_y).sqrt();
            let drag = spin * body.rotational_drag_coefficient() * body.inverse_moment_of_inertia() * dt;
            self.angular_velocity_x -= spin_x * drag;
            self.angular_velocity_y -= spin_y * drag;
        }
        self.force_z = 0.0;
        self.impulse_z = 0.0;
    }
}

/// Whether the solver can move a body.
pub(crate) fn is_movable(core: &PhysicsSimulator, body: BodyId) -> bool {
    core.body(body).is_some_and(|body| body.enabled() && !body.is_static() && !body.is_kinematic())
}
