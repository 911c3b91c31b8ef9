//! Springs: forces and torques between bodies (behaviour chapter 11).
//!
//! Forces are in mass units · length units/s², torques in force times length, angles in radians.

// Constructors of a kind return the whole spring.
#![expect(clippy::new_ret_no_self)]

mod angle_spring;
mod discrete_spring;
mod fixed_angle_spring;
mod fixed_linear_spring;
mod linear_spring;
mod spring_body;
mod spring_force;
mod spring_type;

use serde::{Deserialize, Serialize};

pub use angle_spring::AngleSpring;
pub(crate) use discrete_spring::StepLengths;
pub use fixed_angle_spring::FixedAngleSpring;
pub use fixed_linear_spring::FixedLinearSpring;
pub use linear_spring::LinearSpring;
pub(crate) use spring_force::SpringForce;
pub use spring_type::SpringType;

use crate::body::BodyId;
use crate::body::entry::Bodies;
use crate::checked_properties::checked_properties;
use crate::error::Result;
use crate::math::Vector2;
use crate::math::finite::finite;
use crate::math::vector2::length;
use crate::precise::DepthState;

crate::storage::arena::define_id! {
    /// Id of a [`Spring`], valid in the simulator that made it, in its clones and in simulators loaded from its saves.
    SpringId
}

/// Minimum length of a linear spring, in length units: a shorter one has no direction and exerts no force. Farseer's
/// value.
const MIN_SPRING_LENGTH: f32 = 0.00001;

/// A spring: the settings that all kinds share, and the spring of its kind.
///
/// Springs are made by [`SpringFactory`](crate::SpringFactory), or without bodies by
/// [`create_empty_spring`](crate::PhysicsSimulator::create_empty_spring). A spring in the simulation is removed when
/// one of its bodies is disposed; a spring that was not added yet is removed when it is added.
///
/// Between two bodies of which one is disabled a spring still acts on both. The force accumulates in the disabled body
/// and acts at once when that is enabled again, as in the original.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Spring {
    breakpoint: f32,
    damping_constant: f32,
    spring_constant: f32,
    spring_error: f32,
    enabled: bool,
    tag: u64,
    kind: SpringKind,
}

/// The kinds of springs.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[non_exhaustive]
pub enum SpringKind {
    /// Torques toward a relative angle of two bodies.
    Angle(AngleSpring),
    /// A torque toward an angle of a body.
    FixedAngle(FixedAngleSpring),
    /// A force toward a point of the world.
    FixedLinear(FixedLinearSpring),
    /// Forces between points of two bodies.
    Linear(LinearSpring),
}

/// Result of the update of a spring.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum SpringOutcome {
    /// The spring exerted no force or torque.
    Idle,
    /// A force or torque was applied.
    Updated,
    /// The force on a body would not have been finite; no state has changed.
    NotFinite,
}

/// Stiffness and damping of a spring.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SpringConstants {
    spring: f32,
    damping: f32,
    /// The step for which they are [corrected](Self::for_step); `None` for the faithful set.
    step: Option<StepLengths>,
}

/// Error and forces of a kind of spring in an update.
#[derive(Debug, Clone, Copy)]
pub(crate) enum SpringEvaluation {
    /// The spring does not act; its error keeps its value.
    None,
    Done {
        error: f32,
        has_acted: bool,
        /// Force or torque on each body.
        forces: [Option<SpringForce>; 2],
    },
    NotFinite,
}

impl Spring {
    fn of(kind: SpringKind, spring_constant: f32, damping_constant: f32) -> Result<Self> {
        Ok(Spring {
            damping_constant: finite("damping_constant", damping_constant)?,
            spring_constant: finite("spring_constant", spring_constant)?,
            ..Spring::without_constants(kind)
        })
    }

    fn without_constants(kind: SpringKind) -> Self {
        Spring {
            breakpoint: f32::MAX,
            damping_constant: 0.0,
            spring_constant: 0.0,
            spring_error: 0.0,
            enabled: true,
            tag: 0,
            kind,
        }
    }

    checked_properties! {
        /// Maximum absolute error, in length units or radians. In the update after one with a greater error the spring
        /// breaks: it acts once more, is disabled, and [`Event::SpringBroke`](crate::Event::SpringBroke) is reported.
        /// Default [`f32::MAX`].
        #[doc(alias = "Breakpoint")]
        breakpoint, set_breakpoint;
        /// Damping: force per velocity in mass units/s, or torque per angular velocity in mass units · length units²/s.
        #[doc(alias = "DampingConstant")]
        damping_constant, set_damping_constant;
        /// Stiffness: force per length in mass units/s², or torque per angle in mass units · length units²/s².
        #[doc(alias = "SpringConstant")]
        spring_constant, set_spring_constant;
    }

    /// Error of the last update in which the spring acted, in radians or length units.
    #[doc(alias = "SpringError")]
    pub fn spring_error(&self) -> f32 {
        self.spring_error
    }

    /// Whether the spring takes part in the simulation. Default true.
    #[doc(alias = "Enabled")]
    pub fn enabled(&self) -> bool {
        self.enabled
    }

    /// Sets [`enabled`](Self::enabled). A spring that broke breaks again in the next update, unless its breakpoint was
    /// raised.
    pub fn set_enabled(&mut self, value: bool) {
        self.enabled = value;
    }

    /// A number for the user's own purposes. Default 0.
    #[doc(alias = "Tag")]
    pub fn tag(&self) -> u64 {
        self.tag
    }

    /// Sets [`tag`](Self::tag).
    pub fn set_tag(&mut self, value: u64) {
        self.tag = value;
    }

    /// The first body, or the only one. For a spring that was made without bodies the id is invalid until it is set:
    /// `simulator.body(spring.body1())` is `None` then.
    pub fn body1(&self) -> BodyId {
        match &self.kind {
            SpringKind::Angle(spring) => spring.body1,
            SpringKind::FixedAngle(spring) => spring.body,
            SpringKind::FixedLinear(spring) => spring.body,
            SpringKind::Linear(spring) => spring.body1,
        }
    }

    /// The second body, if the spring has two. Until it is set the id is invalid, as that of [`body1`](Self::body1).
    pub fn body2(&self) -> Option<BodyId> {
        match &self.kind {
            SpringKind::Angle(spring) => Some(spring.body2),
            SpringKind::Linear(spring) => Some(spring.body2),
            SpringKind::FixedAngle(_) | SpringKind::FixedLinear(_) => None,
        }
    }

    /// The bodies at both ends.
    pub(crate) fn ends(&self) -> [Option<BodyId>; 2] {
        [Some(self.body1()), self.body2()]
    }

    /// Whether the rest length is 0, so that the spring pulls two points together.
    pub(crate) fn has_zero_rest_length(&self) -> bool {
        match &self.kind {
            SpringKind::Linear(spring) => spring.rest_length() == 0.0,
            SpringKind::FixedLinear(spring) => spring.rest_length() == 0.0,
            SpringKind::Angle(_) | SpringKind::FixedAngle(_) => false,
        }
    }

    /// The spring of its kind.
    pub fn kind(&self) -> &SpringKind {
        &self.kind
    }

    pub(crate) fn kind_mut(&mut self) -> &mut SpringKind {
        &mut self.kind
    }

    pub(crate) fn set_body1(&mut self, body: BodyId) {
        match &mut self.kind {
            SpringKind::Angle(spring) => spring.body1 = body,
            SpringKind::FixedAngle(spring) => spring.body = body,
            SpringKind::FixedLinear(spring) => spring.body = body,
            SpringKind::Linear(spring) => spring.body1 = body,
        }
    }

    /// Sets the second body; no effect on a spring of one body.
    pub(crate) fn set_body2(&mut self, body: BodyId) {
        match &mut self.kind {
            SpringKind::Angle(spring) => spring.body2 = body,
            SpringKind::Linear(spring) => spring.body2 = body,
            SpringKind::FixedAngle(_) | SpringKind::FixedLinear(_) => {}
        }
    }

    /// Tests the breakpoint with the error of the update before, and returns whether the spring broke just now; then it
    /// is disabled. As in the original the update that finds it broken still acts.
    pub(crate) fn breaks(&mut self) -> bool {
        let breaks = self.enabled && self.spring_error.abs() > self.breakpoint;
        if breaks {
            self.enabled = false;
        }
        breaks
    }

    /// Computes force or torque, if the bodies let the spring act. With `step` they are corrected for its length; in an
    /// engine with depth a linear spring also acts along the depth axis. Returns the forces on the bodies, which the
    /// caller applies; `None` if the spring is not active.
    pub(crate) fn compute_forces(
        &mut self,
        bodies: &Bodies,
        space: Option<&mut DepthState>,
        step: Option<StepLengths>,
    ) -> (SpringOutcome, Option<[Option<SpringForce>; 2]>) {
        let constants =
            SpringConstants { spring: self.spring_constant, damping: self.damping_constant, step };
        let pull = match &self.kind {
            SpringKind::Angle(spring) => spring.evaluate(constants, bodies),
            SpringKind::FixedAngle(spring) => spring.evaluate(constants, bodies),
            SpringKind::FixedLinear(spring) => spring.evaluate(constants, bodies, space),
            SpringKind::Linear(spring) => spring.evaluate(constants, bodies, space),
        };
        match pull {
            SpringEvaluation::None => (SpringOutcome::Idle, None),
            SpringEvaluation::NotFinite => (SpringOutcome::NotFinite, None),
            SpringEvaluation::Done { error, has_acted, forces: pushes } => {
                self.spring_error = error;
                (if has_acted { SpringOutcome::Updated } else { SpringOutcome::Idle }, Some(pushes))
            }
        }
    }

    /// Whether all numbers are finite.
    pub(crate) fn is_valid(&self) -> bool {
        let numbers = [self.breakpoint, self.damping_constant, self.spring_constant, self.spring_error];
        let is_kind_valid = match &self.kind {
            SpringKind::Angle(spring) => spring.is_valid(),
            SpringKind::FixedAngle(spring) => spring.is_valid(),
            SpringKind::FixedLinear(spring) => spring.is_valid(),
            SpringKind::Linear(spring) => spring.is_valid(),
        };
        is_kind_valid && numbers.iter().all(|number| number.is_finite())
    }
}

/// Length of a difference with a component along the depth axis. If that is 0 it is the length in the plane to the last
/// bit.
#[inline]
fn length_with_depth(difference: Vector2, behind: f32) -> f32 {
    let in_plane = length(difference);
    if behind == 0.0 { in_plane } else { (in_plane * in_plane + behind * behind).sqrt() }
}

/// Scalar product of velocity and difference, both with components along the depth axis.
#[inline]
fn dot_with_depth(in_plane: f32, receding: f32, behind: f32) -> f32 {
    if behind == 0.0 { in_plane } else { in_plane + receding * behind }
}

/// Force of a linear spring along its direction, from the scalar product of velocity and difference.
#[inline]
fn strength_along(constants: SpringConstants, error: f32, along: f32, distance: f32) -> f32 {
    let stiffness = constants.spring * error;
    let damping = constants.damping * along / distance;
    -(stiffness + damping)
}
