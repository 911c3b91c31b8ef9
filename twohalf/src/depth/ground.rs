//! The ground of a body: the plane Y = 0 as that body meets it (thesis 3.2).

use farseer_core::GeomId;
use serde::{Deserialize, Serialize};

use crate::TextureId;

/// How a body meets the plane Y = 0. Every body has a ground of its own, and no body meets another one's.
///
/// The object geom is what rests on it. Without one the body falls for ever. The geom holds the body up while
/// it is in the simulation with collisions and their response switched on, like any other pair of geoms.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Ground {
    pub(crate) restitution_coefficient: f32,
    pub(crate) friction_coefficient: f32,
    pub(crate) object_geom: Option<GeomId>,
    pub(crate) shadow_image: Option<TextureId>,
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
