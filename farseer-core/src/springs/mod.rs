//! Springs push and turn bodies by forces (behaviour chapter 11).
//!
//! Forces are mass times length per square second, torques force times length, angles radians.

// What is made of a kind is always the whole spring.
#![expect(clippy::new_ret_no_self)]

mod angle_spring;
mod fixed_angle_spring;
mod fixed_linear_spring;
mod linear_spring;
mod load;
mod push;
mod spring_type;
mod swing;

use serde::{Deserialize, Serialize};

pub use angle_spring::AngleSpring;
pub use fixed_angle_spring::FixedAngleSpring;
pub use fixed_linear_spring::FixedLinearSpring;
pub use linear_spring::LinearSpring;
pub(crate) use push::Push;
pub use spring_type::SpringType;
pub(crate) use swing::Steps;

use crate::body::BodyId;
use crate::body::entry::Bodies;
use crate::checked_properties::checked_properties;
use crate::error::Result;
use crate::math::Vector2;
use crate::math::finite::finite;
use crate::math::vector2::length;
use crate::precise::space::Space;

crate::storage::arena::define_id! {
    /// Names a [`Spring`] of a simulator: the one that made it, its clones and what is loaded from its saves.
    SpringId
}

/// A linear spring shorter than this has no direction.
const SHORTEST: f32 = 0.00001;

/// What all springs have in common, and the spring of a certain kind.
///
/// Springs are made by [`SpringFactory`](crate::SpringFactory), or without bodies by
/// [`create_empty_spring`](crate::PhysicsSimulator::create_empty_spring). A spring in the simulation goes when one of
/// its bodies is disposed; another one when it is added. Between two bodies of which one is disabled it keeps pulling at
/// both: the force piles up in the disabled one and acts at once when that is enabled again, as in the original.
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
    /// Torques towards an angle between two bodies.
    Angle(AngleSpring),
    /// A torque towards an angle of a body.
    FixedAngle(FixedAngleSpring),
    /// A force towards a point of the world.
    FixedLinear(FixedLinearSpring),
    /// Forces between points of two bodies.
    Linear(LinearSpring),
}

/// What came of the update of a spring.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum SpringOutcome {
    /// There was nothing to do.
    Idle,
    /// A force or torque was applied.
    Updated,
    /// What a body had to bear would not have been finite; nothing has changed.
    NotFinite,
}

/// Stiffness and damping.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Constants {
    spring: f32,
    damping: f32,
    /// The step that they are [tuned](Self::tuned) to; `None` for the faithful set.
    step: Option<Steps>,
}

/// Result of a kind of spring in an update.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Pull {
    /// The error stays what it was.
    None,
    Done {
        error: f32,
        has_acted: bool,
        /// Force or torque on each body.
        pushes: [Option<Push>; 2],
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
        /// Greatest error the spring bears, whatever its sign; in the update after one beyond it the spring breaks:
        /// it acts once more, is disabled, and [`Event::SpringBroke`](crate::Event::SpringBroke) is reported. Default
        /// [`f32::MAX`].
        #[doc(alias = "Breakpoint")]
        breakpoint, set_breakpoint;
        /// Force per velocity, or torque per angular velocity, against the movement.
        #[doc(alias = "DampingConstant")]
        damping_constant, set_damping_constant;
        /// Force per length, or torque per angle, against the error.
        #[doc(alias = "SpringConstant")]
        spring_constant, set_spring_constant;
    }

    /// Error of the last update in which the spring acted: an angle in radians or a length.
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

    /// The first body, or the only one. The id names nothing until the first one of a spring that was made without bodies
    /// is set: `simulator.body(spring.body1())` is `None` then.
    pub fn body1(&self) -> BodyId {
        match &self.kind {
            SpringKind::Angle(spring) => spring.body1,
            SpringKind::FixedAngle(spring) => spring.body,
            SpringKind::FixedLinear(spring) => spring.body,
            SpringKind::Linear(spring) => spring.body1,
        }
    }

    /// The second body, if the spring is one between two bodies. Until it is set the id names nothing, as that of
    /// [`body1`](Self::body1).
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

    /// Whether it pulls two points together until they are one.
    pub(crate) fn has_no_length_at_rest(&self) -> bool {
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

    /// Does nothing to a spring of one body.
    pub(crate) fn set_body2(&mut self, body: BodyId) {
        match &mut self.kind {
            SpringKind::Angle(spring) => spring.body2 = body,
            SpringKind::Linear(spring) => spring.body2 = body,
            SpringKind::FixedAngle(_) | SpringKind::FixedLinear(_) => {}
        }
    }

    /// The breaking test, with the error of the update before. Answers whether the spring broke just now; it is
    /// disabled then. As in the original the update that finds it broken still acts.
    pub(crate) fn breaks(&mut self) -> bool {
        let breaks = self.enabled && self.spring_error.abs() > self.breakpoint;
        if breaks {
            self.enabled = false;
        }
        breaks
    }

    /// Finds force or torque, if the bodies let it act, tuned to the length of a step, if there is one; a linear spring also acts along
    /// the depth axis, if there is one. Answers the pushes on the bodies, which are still to be applied; `None` if it has not been active.
    pub(crate) fn find(
        &mut self,
        bodies: &Bodies,
        space: Option<&mut Space>,
        step: Option<Steps>,
    ) -> (SpringOutcome, Option<[Option<Push>; 2]>) {
        let constants = Constants { spring: self.spring_constant, damping: self.damping_constant, step };
        let pull = match &self.kind {
            SpringKind::Angle(spring) => spring.pull(constants, bodies),
            SpringKind::FixedAngle(spring) => spring.pull(constants, bodies),
            SpringKind::FixedLinear(spring) => spring.pull(constants, bodies, space),
            SpringKind::Linear(spring) => spring.pull(constants, bodies, space),
        };
        match pull {
            Pull::None => (SpringOutcome::Idle, None),
            Pull::NotFinite => (SpringOutcome::NotFinite, None),
            Pull::Done { error, has_acted, pushes } => {
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

/// How long a difference is that also has a part along the depth axis. Without one it is that of the plane to the last bit.
#[inline]
fn length_with_depth(difference: Vector2, behind: f32) -> f32 {
    let in_plane = length(difference);
    if behind == 0.0 { in_plane } else { (in_plane * in_plane + behind * behind).sqrt() }
}

/// Product of velocity and difference that also have parts along the depth axis.
#[inline]
fn along_with_depth(in_plane: f32, receding: f32, behind: f32) -> f32 {
    if behind == 0.0 { in_plane } else { in_plane + receding * behind }
}

/// Force of a linear spring along its direction, from the product of velocity and difference.
#[inline]
fn strength_along(constants: Constants, error: f32, along: f32, distance: f32) -> f32 {
    let stiffness = constants.spring * error;
    let damping = constants.damping * along / distance;
    -(stiffness + damping)
}
