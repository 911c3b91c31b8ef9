//! The ground of a body: the plane Y = 0 as that body meets it (thesis 3.2).

use farseer_core::{BodyId, GeomId};
use serde::{Deserialize, Serialize};

use crate::depth::lowest;
use crate::error::stale;
use crate::projection::{plane_to_world, world_to_plane};
use crate::view::AccessMut;
use crate::{Error, Result, TextureId};

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

    /// The same for a body that has no geoms yet.
    pub(crate) fn without_object(self) -> Self {
        Ground { object_geom: None, ..self }
    }

    /// Takes the copy of an object geom, if the body has none.
    pub(crate) fn adopt_object(&mut self, geom: GeomId) {
        self.object_geom.get_or_insert(geom);
    }

    /// The geom has left the body.
    pub(crate) fn let_go_of(&mut self, geom: GeomId) {
        self.object_geom.take_if(|object| *object == geom);
    }

    /// Whether the coefficients are finite: false only after loading garbage.
    pub(crate) fn is_valid(&self) -> bool {
        self.restitution_coefficient.is_finite() && self.friction_coefficient.is_finite()
    }
}

/// A body's ground, to be changed: what [`TwoHalfBody::ground_mut`](crate::TwoHalfBody::ground_mut) gives.
/// Dereferences to [`Ground`].
#[derive(Debug)]
pub struct GroundMut<'a, S> {
    pub(crate) simulator: &'a mut S,
    pub(crate) body: BodyId,
}

impl<S: AccessMut> std::ops::Deref for GroundMut<'_, S> {
    type Target = Ground;
    fn deref(&self) -> &Ground {
        &self.simulator.world().depths.bodies[self.body].ground
    }
}

impl<S: AccessMut> GroundMut<'_, S> {
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
            self.simulator.world_mut().reject(self.body, argument);
        } else if let Some(state) = self.simulator.world_mut().depths.edit(self.body) {
            *field(&mut state.ground) = value;
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
        let geom = self.simulator.core().geom(object_geom).ok_or(stale("object_geom"))?;
        if geom.body() != self.body {
            return Err(Error::GeomOfAnotherBody { argument: "object_geom" });
        }
        let before = self.lowest();
        if let Some(state) = self.simulator.world_mut().depths.edit(self.body) {
            state.ground.object_geom = Some(object_geom);
            state.ground.shadow_image = shadow_image;
        }
        let after = self.lowest();
        if let Some(body) = self.simulator.core_body_mut(self.body).filter(|_| before != after) {
            let position = plane_to_world(body.position(), before, 0.0);
            body.set_position(world_to_plane(position, after));
        }
        Ok(())
    }

    fn lowest(&self) -> f64 {
        lowest(self.simulator.core(), &self.simulator.world().depths, self.body)
    }
}
