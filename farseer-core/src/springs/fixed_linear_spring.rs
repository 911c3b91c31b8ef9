//! A force towards a point of the world (behaviour chapter 11, section 6).

use serde::{Deserialize, Serialize};

use crate::body::entry::Bodies;
use crate::body::nobody::nobody;
use crate::body::{Body, BodyId};
use crate::checked_properties::checked_properties;
use crate::error::Result;
use crate::joints::joint_body::is_non_zero;
use crate::math::Vector2;
use crate::math::finite::{finite, finite_vector};
use crate::math::vector2::length;
use crate::springs::load::Load;
use crate::springs::swing::inverse_mass_at;
use crate::springs::{Constants, Pull, SHORTEST, Spring, SpringKind, strength};

/// Pulls a point of a body to, or pushes it from, a point of the world until they are the rest length apart.
///
/// Points closer than 0.00001 have no direction: there is no force then, whatever the rest length.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct FixedLinearSpring {
    pub(crate) body: BodyId,
    body_attach_point: Vector2,
    world_attach_point: Vector2,
    rest_length: f32,
}

impl FixedLinearSpring {
    pub(crate) fn new(
        body: (BodyId, &Body),
        body_attach_point: Vector2,
        world_attach_point: Vector2,
        spring_constant: f32,
        damping_constant: f32,
    ) -> Result<Spring> {
        finite_vector("body_attach_point", body_attach_point)?;
        finite_vector("world_attach_point", world_attach_point)?;
        let rest_length = length(world_attach_point - body.1.get_world_position(body_attach_point));
        let kind = SpringKind::FixedLinear(FixedLinearSpring {
            body: body.0,
            body_attach_point,
            world_attach_point,
            rest_length: finite("rest_length", rest_length)?,
        });
        Spring::of(kind, spring_constant, damping_constant)
    }

    pub(crate) fn without_bodies() -> Self {
        FixedLinearSpring {
            body: nobody(),
            body_attach_point: Vector2::zeros(),
            world_attach_point: Vector2::zeros(),
            rest_length: 0.0,
        }
    }

    /// The body.
    #[doc(alias = "Body")]
    pub fn body(&self) -> BodyId {
        self.body
    }

    /// The attached point in the body's coordinates.
    #[doc(alias = "BodyAttachPoint")]
    pub fn body_attach_point(&self) -> Vector2 {
        self.body_attach_point
    }

    /// Sets [`body_attach_point`](Self::body_attach_point). The rest length stays.
    ///
    /// # Errors
    /// What is not finite.
    pub fn set_body_attach_point(&mut self, value: Vector2) -> Result<()> {
        self.body_attach_point = finite_vector("body_attach_point", value)?;
        Ok(())
    }

    /// The point of the world.
    #[doc(alias = "WorldAttachPoint")]
    pub fn world_attach_point(&self) -> Vector2 {
        self.world_attach_point
    }

    /// Sets [`world_attach_point`](Self::world_attach_point). The rest length stays.
    ///
    /// # Errors
    /// What is not finite.
    pub fn set_world_attach_point(&mut self, value: Vector2) -> Result<()> {
        self.world_attach_point = finite_vector("world_attach_point", value)?;
        Ok(())
    }

    checked_properties! {
        /// Distance at which the spring is at rest: at first the one the points had when the spring was made, or 0
        /// if it was made without its body.
        #[doc(alias = "RestLength")]
        rest_length, set_rest_length;
    }

    pub(crate) fn pull(&self, constants: Constants, bodies: &mut Bodies) -> Pull {
        let Some(body) = bodies.get_mut(self.body).map(|entry| &mut entry.body) else { return Pull::None };
        if !body.is_integrated() {
            return Pull::None;
        }
        let point = body.get_world_position(self.body_attach_point);
        let difference = point - self.world_attach_point;
        let distance = length(difference);
        if distance < SHORTEST {
            return Pull::None;
        }
        let error = distance - self.rest_length;
        let constants =
            constants.tuned(|| inverse_mass_at(body, point - body.position(), difference * (1.0 / distance)));
        let velocity = body.get_velocity_at_world_point(point);
        let force =
            difference * (1.0 / distance) * strength(constants, error, velocity, difference, distance);
        if !Load::of(body).with_force(force, point - body.position()).is_finite() {
            return Pull::NotFinite;
        }
        let has_acted = is_non_zero(force);
        if has_acted {
            body.apply_force_at_world_point(force, point);
        }
        Pull::Done { error, has_acted }
    }

    pub(crate) fn is_valid(&self) -> bool {
        let vectors = [self.body_attach_point, self.world_attach_point];
        self.rest_length.is_finite() && vectors.iter().all(|v| v.x.is_finite() && v.y.is_finite())
    }
}
