//! Linear spring: forces between points of two bodies (behaviour chapter 11, section 7).

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
use crate::springs::spring_body::{SpringBody, may_act};
use crate::springs::{
    MIN_SPRING_LENGTH, Spring, SpringConstants, SpringEvaluation, SpringForce, SpringKind, dot_with_depth,
    length_with_depth, strength_along,
};

/// Pulls points of two bodies together, or pushes them apart, until their distance is the rest length.
///
/// Points closer than 0.00001 length units define no direction: there is no force then, whatever the rest length.
///
/// In an engine with depth both points are at the depths of their bodies, and the spring acts along all three axes; its
/// initial rest length is that in the plane.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct LinearSpring {
    pub(crate) body1: BodyId,
    pub(crate) body2: BodyId,
    attach_point1: Vector2,
    attach_point2: Vector2,
    rest_length: f32,
}

impl LinearSpring {
    pub(crate) fn new(
        body1: (BodyId, &Body),
        attach_point1: Vector2,
        body2: (BodyId, &Body),
        attach_point2: Vector2,
        spring_constant: f32,
        damping_constant: f32,
    ) -> Result<Spring> {
        finite_vector("attach_point1", attach_point1)?;
        finite_vector("attach_point2", attach_point2)?;
        let (point1, point2) =
            (body1.1.get_world_position(attach_point1), body2.1.get_world_position(attach_point2));
        let kind = SpringKind::Linear(LinearSpring {
            body1: body1.0,
            body2: body2.0,
            attach_point1,
            attach_point2,
            rest_length: finite("rest_length", length(point2 - point1))?,
        });
        Spring::of(kind, spring_constant, damping_constant)
    }

    pub(crate) fn without_bodies() -> Self {
        LinearSpring {
            body1: missing_body_id(),
            body2: missing_body_id(),
            attach_point1: Vector2::zeros(),
            attach_point2: Vector2::zeros(),
            rest_length: 0.0,
        }
    }

    /// The first body.
    #[doc(alias = "Body1")]
    pub fn body1(&self) -> BodyId {
        self.body1
    }

    /// The second body.
    #[doc(alias = "Body2")]
    pub fn body2(&self) -> BodyId {
        self.body2
    }

    /// The attached point in the first body's coordinates.
    #[doc(alias = "AttachPoint1")]
    pub fn attach_point1(&self) -> Vector2 {
        self.attach_point1
    }

    /// Sets [`attach_point1`](Self::attach_point1). The rest length stays.
    ///
    /// # Errors
    /// A value that is not finite.
    pub fn set_attach_point1(&mut self, value: Vector2) -> Result<()> {
        self.attach_point1 = finite_vector("attach_point1", value)?;
        Ok(())
    }

    /// The attached point in the second body's coordinates.
    #[doc(alias = "AttachPoint2")]
    pub fn attach_point2(&self) -> Vector2 {
        self.attach_point2
    }

    /// Sets [`attach_point2`](Self::attach_point2). The rest length stays.
    ///
    /// # Errors
    /// A value that is not finite.
    pub fn set_attach_point2(&mut self, value: Vector2) -> Result<()> {
        self.attach_point2 = finite_vector("attach_point2", value)?;
        Ok(())
    }

    checked_properties! {
        /// Distance at which the spring is at rest, in length units: at first the distance of the points when the
        /// spring was made, or 0 if it was made without its bodies.
        #[doc(alias = "RestLength")]
        rest_length, set_rest_length;
    }

    pub(crate) fn evaluate(
        &self,
        constants: SpringConstants,
        bodies: &Bodies,
        space: Option<&mut DepthState>,
    ) -> SpringEvaluation {
        let (Some(entry1), Some(entry2)) = (bodies.get(self.body1), bodies.get(self.body2)) else {
            return SpringEvaluation::None;
        };
        let (body1, body2) = (&entry1.body, &entry2.body);
        if !may_act(body1, body2) {
            return SpringEvaluation::None;
        }
        let point1 = body1.get_world_position(self.attach_point1);
        let point2 = body2.get_world_position(self.attach_point2);
        let difference = point1 - point2;
        let [behind, receding] = space
            .as_deref()
            .map_or([0.0; 2], |space| space.relative_z_and_velocity(self.body1.slot(), self.body2.slot()));
        let distance = length_with_depth(difference, behind);
        if distance < MIN_SPRING_LENGTH {
            return SpringEvaluation::None;
        }
        let error = distance - self.rest_length;
        let constants = constants.for_step(|| {
            let direction = difference * (1.0 / distance);
            let one = inverse_mass_at(body1, point1 - body1.position(), direction);
            one + inverse_mass_at(body2, point2 - body2.position(), direction)
        });
        let velocity = body1.get_velocity_at_world_point(point1) - body2.get_velocity_at_world_point(point2);
        let along = dot_with_depth(dot(velocity, difference), receding, behind);
        let strength = strength_along(constants, error, along, distance);
        let (force, force_z) = (difference * (1.0 / distance) * strength, behind / distance * strength);

        let (moves1, moves2) = (!body1.is_immovable(), !body2.is_immovable());
        let mut load = SpringBody::of(body1);
        if moves1 {
            load = load.with_force(force, point1 - body1.position());
        }
        let mut is_finite = load.is_finite();
        if self.body1 != self.body2 {
            load = SpringBody::of(body2);
        }
        if moves2 {
            load = load.with_force(-force, point2 - body2.position());
        }
        is_finite &= load.is_finite() && force_z.is_finite();
        if !is_finite {
            return SpringEvaluation::NotFinite;
        }

        if let Some(space) = space.filter(|_| force_z != 0.0) {
            let inverses = [(moves1, body1), (moves2, body2)]
                .map(|(moves, body)| if moves { body.inverse_mass() } else { 0.0 });
            space.add_acceleration(self.body1.slot(), force_z * inverses[0]);
            space.add_acceleration(self.body2.slot(), -force_z * inverses[1]);
        }
        let has_acted = is_non_zero(force) || force_z != 0.0;
        let one = SpringForce::Force { body: self.body1, force, point: point1 };
        let other = SpringForce::Force { body: self.body2, force: -force, point: point2 };
        let pushes = [(has_acted && moves1).then_some(one), (has_acted && moves2).then_some(other)];
        SpringEvaluation::Done { error, has_acted, forces: pushes }
    }

    pub(crate) fn is_valid(&self) -> bool {
        let vectors = [self.attach_point1, self.attach_point2];
        self.rest_length.is_finite() && vectors.iter().all(|v| v.x.is_finite() && v.y.is_finite())
    }
}
