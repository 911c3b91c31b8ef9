//! The ground of a body: the plane Y = 0 as that body meets it (thesis 3.2).

use farseer_core::{BodyId, Event, GeomId};
use serde::{Deserialize, Serialize};

use crate::depth::lowest;
use crate::error::stale;
use crate::projection::{plane_to_world, world_to_plane};
use crate::{Error, Result, TextureId, TwoHalfPhysicsSimulator};

/// How a body meets the plane Y = 0. Every body has a ground of its own, and no body meets another one's.
///
/// The object geom is what rests on it. Without one the body falls for ever. The geom holds the body up while
/// it is in the simulation with collisions and their response switched on, like any other pair of geoms.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Ground {
    restitution_coefficient: f32,
    friction_coefficient: f32,
    object_geom: Option<GeomId>,
    shadow_image: Option<TextureId>,
}

impl Ground {
    /// Bounciness, usually 0 to 1; the mean of it and the object geom's acts. Default 0, as a geom's.
    #[doc(alias = "RestitutionCoefficient")]
    pub fn restitution_coefficient(&self) -> f32 {
        self.restitution_coefficient
    }

    /// Friction, combined with the object geom's in every update, by the simulator's friction type: the mean,
    /// or the smaller. Default 0, as a geom's.
    #[doc(alias = "FrictionCoefficient")]
    pub fn friction_coefficient(&self) -> f32 {
        self.friction_coefficient
    }

    /// The geom that rests on the ground. Its id is stale if the geom was disposed; the body then is one
    /// without an object geom.
    #[doc(alias = "ObjectGeom")]
    pub fn object_geom(&self) -> Option<GeomId> {
        self.object_geom
    }

    /// The picture of the object's shadow.
    pub fn shadow_image(&self) -> Option<TextureId> {
        self.shadow_image
    }

    /// Whether the coefficients are finite: false only after loading garbage.
    pub(crate) fn is_valid(&self) -> bool {
        self.restitution_coefficient.is_finite() && self.friction_coefficient.is_finite()
    }
}

/// A body's ground, to be changed: what [`TwoHalfBody::ground_mut`](crate::TwoHalfBody::ground_mut) gives.
/// Dereferences to [`Ground`].
#[derive(Debug)]
pub struct GroundMut<'a> {
    pub(crate) simulator: &'a mut TwoHalfPhysicsSimulator,
    pub(crate) body: BodyId,
}

impl std::ops::Deref for GroundMut<'_> {
    type Target = Ground;
    fn deref(&self) -> &Ground {
        &self.simulator.depths.bodies[self.body].ground
    }
}

impl GroundMut<'_> {
    /// Sets the bounciness. What is not finite is rejected and reported.
    pub fn set_restitution_coefficient(&mut self, value: f32) {
        self.set("restitution_coefficient", value, |ground| &mut ground.restitution_coefficient);
    }

    /// Sets the friction. What is not finite is rejected and reported.
    pub fn set_friction_coefficient(&mut self, value: f32) {
        self.set("friction_coefficient", value, |ground| &mut ground.friction_coefficient);
    }

    fn set(&mut self, argument: &'static str, value: f32, field: impl Fn(&mut Ground) -> &mut f32) {
        if !value.is_finite() {
            let object = Some(self.body.into());
            self.simulator.pending_events.push(Event::RejectedInput { object, argument });
        } else {
            *field(&mut self.simulator.depths.bodies[self.body].ground) = value;
        }
    }

    /// Says which geom of the body rests on the ground, and which picture its shadow is.
    ///
    /// The body's [`position3d`](crate::TwoHalfBody::position3d) stays: what was its height is now the height
    /// of the geom's lowest point, so the body's origin moves.
    ///
    /// # Errors
    /// A stale geom, or one of another body.
    #[doc(alias = "setObjectGeom")]
    pub fn set_object_geom(&mut self, object_geom: GeomId, shadow_image: Option<TextureId>) -> Result<()> {
        let TwoHalfPhysicsSimulator { core, depths, .. } = &mut *self.simulator;
        let geom = core.geom(object_geom).ok_or(stale("object_geom"))?;
        if geom.body() != self.body {
            return Err(Error::GeomOfAnotherBody { argument: "object_geom" });
        }
        let before = lowest(core, depths, self.body);
        let ground = &mut depths.bodies[self.body].ground;
        ground.object_geom = Some(object_geom);
        ground.shadow_image = shadow_image;
        let after = lowest(core, depths, self.body);
        if let Some(body) = core.body_mut(self.body).filter(|_| before != after) {
            let position = plane_to_world(body.position(), before, 0.0);
            body.set_position(world_to_plane(position, after));
        }
        Ok(())
    }
}
