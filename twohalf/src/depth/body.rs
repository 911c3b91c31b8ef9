//! State of a body beyond that of the core: motion along Z, and its ground.

use farseer_core::depth::{DepthBodyState, DepthTarget};
use farseer_core::{ArgumentNames, Body, BodyId, Objects, RejectedArguments};
use serde::{Deserialize, Serialize};

use super::ground::Ground;
use super::support::Support;
use crate::Vector3;

/// Motion of a body along Z, and its ground.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub(crate) struct DepthBody {
    /// Z of the centre of mass, px.
    pub(crate) z: f32,
    /// Velocity along Z, px/s.
    pub(crate) velocity_z: f32,
    /// Angular velocity about the x axis and, with y down, the y axis, radians/s: rolling, which is not
    /// drawn.
    pub(crate) angular_velocity_x: f32,
    pub(crate) angular_velocity_y: f32,
    /// Displacement of the body in the last update, px, y down; `None` before the first update.
    pub(crate) motion: Option<Vector3>,
    /// Penetration in px when the body's last contact with a static body ended; 0 after other contacts. The narrow phase of the
    /// precise set tests the next flush face with this tolerance.
    pub(crate) sunk: f32,
    /// Velocity along Z, px/s, by which the last update resolved penetration (faithful scheme). It is not kept as velocity.
    #[serde(skip)]
    pub(crate) bias_z: f32,
    /// Force along Z for the next update, mass · px/s².
    pub(crate) force_z: f32,
    /// Impulse along Z for the next update, mass · px/s.
    pub(crate) impulse_z: f32,
    /// Target position of a kinematic body along Z; `None` without one.
    pub(crate) target: Option<DepthTarget>,
    pub(crate) ground: Ground,
    /// The best support in the last update.
    pub(crate) support: Option<Support>,
    /// Whether the support is that of the update before the last, and the body has hardly moved since.
    pub(crate) is_support_kept: bool,
    /// Arguments that setters of this crate have refused since the last report.
    pub(crate) rejected: RejectedArguments<DepthArguments>,
    /// Whether the list `edited` of `DepthState` contains the body.
    #[serde(skip)]
    pub(crate) is_edited: bool,
}

/// Names of the arguments that setters of this crate may refuse; the core reports those of its own setters.
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
    /// Returns whether all numbers are finite: false only for a damaged save.
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

    /// The input of the precise set for the body, with a velocity in px/s and an acceleration in px/s² along
    /// Z.
    pub(crate) fn core_input(&self, velocity: f32, acceleration: f32, is_kinematic: bool) -> DepthBodyState {
        DepthBodyState {
            z: self.z,
            velocity,
            acceleration,
            displacement: self.motion.unwrap_or_default().into(),
            residual_penetration: self.sunk,
            angular_velocity: [self.angular_velocity_x, self.angular_velocity_y],
            target: self.target.filter(|_| is_kinematic),
        }
    }

    /// Integrates impulse, force and drag into the velocity, as the core does for X and Y (behaviour chapter
    /// 02, section 5). Clears force and impulse.
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

/// Returns whether the solver can move a body: enabled and dynamic.
pub(crate) fn is_movable(core: &Objects, body: BodyId) -> bool {
    core.body(body).is_some_and(|body| body.enabled() && !body.is_static() && !body.is_kinematic())
}
