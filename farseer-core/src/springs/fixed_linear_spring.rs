//! Fixed linear spring: a force toward a point of the world (behaviour chapter 11, section 6).

use serde::{Deserialize, Serialize};

use crate::body::entry::Bodies;
use crate::body::missing_body::missing_body_id;
use crate::body::{Body, BodyId};
use crate::checked_properties::checked_properties;
use crate::error::Result;
use crate::joints::joint_body::is_non_zero;
use crate::math::Vector2;
use crate::math::finite::{finite, finite_vector};
use crate::math::vector2::{dot, length};
use crate::precise::DepthState;
use crate::springs::discrete_spring::inverse_mass_at;
use crate::springs::spring_body::SpringBody;
use crate::springs::{
    MIN_SPRING_LENGTH, Spring, SpringConstants, SpringEvaluation, SpringForce, SpringKind, dot_with_depth,
    length_with_depth, strength_along,
};

/// Pulls or pushes a point of a body until it is the rest length away from a point of the world.
///
/// Points closer than 0.00001 length units define no direction: there is no force then, whatever the rest length.
///
/// In an engine with depth a spring whose point of the world [has a depth](Self::set_world_attach_depth) acts along all
/// three axes: the point of the body is at the body's depth. Without such a depth it acts in the plane alone.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct FixedLinearSpring {
    pub(crate) body: BodyId,
    body_attach_point: Vector2,
    world_attach_point: Vector2,
    rest_length: f32,
    world_attach_depth: Option<f32>,
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
            world_attach_depth: None,
        });
        Spring::of(kind, spring_constant, damping_constant)
    }

    pub(crate) fn without_bodies() -> Self {
        FixedLinearSpring {
            body: missing_body_id(),
            body_attach_point: Vector2::zeros(),
            world_attach_point: Vector2::zeros(),
            rest_length: 0.0,
            world_attach_depth: None,
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
    /// A value that is not finite.
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
    /// A value that is not finite.
    pub fn set_world_attach_point(&mut self, value: Vector2) -> Result<()> {
        self.world_attach_point = finite_vector("world_attach_point", value)?;
        Ok(())
    }

    /// Coordinate of the point of the world on the depth axis, in length units; `None`, the default, for a spring that
    /// acts in the plane alone. Only an engine with depth uses it.
    pub fn world_attach_depth(&self) -> Option<f32> {
        self.world_attach_depth
    }

    /// Sets [`world_attach_depth`](Self::world_attach_depth). The rest length stays.
    ///
    /// # Errors
    /// A value that is not finite.
    pub fn set_world_attach_depth(&mut self, value: Option<f32>) -> Result<()> {
        self.world_attach_depth = value.map(|depth| finite("world_attach_depth", depth)).transpose()?;
        Ok(())
    }

    checked_properties! {
        /// Distance at which the spring is at rest, in length units: at first the distance of the points when the
        /// spring was made, or 0 if it was made without its body.
        #[doc(alias = "RestLength")]
        rest_length, set_rest_length;
    }

    pub(crate) fn evaluate(
        &self,
        constants: SpringConstants,
        bodies: &Bodies,
        space: Option<&mut DepthState>,
    ) -> SpringEvaluation {
        let Some(body) = bodies.get(self.body).map(|entry| &entry.body) else {
            return SpringEvaluation::None;
        };
        if !body.is_integrated() {
            return SpringEvaluation::None;
        }
        let point = body.get_world_position(self.body_attach_point);
        let difference = point - self.world_attach_point;
        let [behind, receding] =
            self.world_attach_depth.zip(space.as_deref()).map_or([0.0; 2], |(depth, space)| {
                let [z, velocity] = space.z_and_velocity(self.body.slot());
                [z - depth, velocity]
            });
        let distance = length_with_depth(difference, behind);
        if distance < MIN_SPRING_LENGTH {
            return SpringEvaluation::None;
        }
        let error = distance - self.rest_length;
        let constants = constants
            .for_step(|| inverse_mass_at(body, point - body.position(), difference * (1.0 / distance)));
        let velocity = body.get_velocity_at_world_point(point);
        let along = dot_with_depth(dot(velocity, difference), receding, behind);
        let strength = strength_along(constants, error, along, distance);
        let (force, force_z) = (difference * (1.0 / distance) * strength, behind / distance * strength);
        if !(SpringBody::of(body).with_force(force, point - body.position()).is_finite()
            && force_z.is_finite())
        {
            return SpringEvaluation::NotFinite;
        }
        if let Some(space) = space.filter(|_| force_z != 0.0) {
            space.add_acceleration(self.body.slot(), force_z * body.inverse_mass());
        }
        let push = is_non_zero(force).then_some(SpringForce::Force { body: self.body, force, point });
        SpringEvaluation::Done { error, has_acted: push.is_some() || force_z != 0.0, forces: [push, None] }
    }

    pub(crate) fn is_valid(&self) -> bool {
        let vectors = [self.body_attach_point, self.world_attach_point];
        let depth = self.world_attach_depth.unwrap_or_default();
        self.rest_length.is_finite()
            && depth.is_finite()
            && vectors.iter().all(|v| v.x.is_finite() && v.y.is_finite())
    }
}
