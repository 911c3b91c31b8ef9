//! Ground of a body: the plane Y = 0 with that body's coefficients (thesis 3.2).

use farseer_core::GeomId;
use serde::{Deserialize, Serialize};

use crate::TextureId;

/// The plane Y = 0 as one body meets it. Every body has its own ground, and no other body touches it.
///
/// The ground supports the object geom of the body; without one the body falls forever. The geom must be in
/// the simulation with collisions and response enabled, as for any pair of geoms.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Ground {
    /// Restitution coefficient, dimensionless.
    pub(crate) restitution_coefficient: f32,
    /// Friction coefficient, dimensionless.
    pub(crate) friction_coefficient: f32,
    pub(crate) object_geom: Option<GeomId>,
    pub(crate) shadow_image: Option<TextureId>,
}

impl Ground {
    /// Restitution coefficient, dimensionless, usually 0 to 1; combined with the object geom's by their mean.
    /// Default 0, as a geom's.
    #[doc(alias = "RestitutionCoefficient")]
    pub fn restitution_coefficient(&self) -> f32 {
        self.restitution_coefficient
    }

    /// Friction coefficient, dimensionless; combined with the object geom's by the simulator's friction type:
    /// mean or minimum. Default 0, as a geom's.
    #[doc(alias = "FrictionCoefficient")]
    pub fn friction_coefficient(&self) -> f32 {
        self.friction_coefficient
    }

    /// The geom that rests on the ground. Its id is stale after the geom was disposed; the body then counts
    /// as one without an object geom.
    #[doc(alias = "ObjectGeom")]
    pub fn object_geom(&self) -> Option<GeomId> {
        self.object_geom
    }

    /// The picture of the object's shadow.
    pub fn shadow_image(&self) -> Option<TextureId> {
        self.shadow_image
    }

    /// Returns this ground without an object geom, for a new body that has no geoms yet.
    pub(crate) fn without_object(self) -> Self {
        Ground { object_geom: None, ..self }
    }

    /// Sets the object geom if the ground has none.
    pub(crate) fn adopt_object(&mut self, geom: GeomId) {
        self.object_geom.get_or_insert(geom);
    }

    /// Clears the object geom if it is `geom`, which has left the body.
    pub(crate) fn clear_removed_geom(&mut self, geom: GeomId) {
        self.object_geom.take_if(|object| *object == geom);
    }

    /// Returns whether the coefficients are finite: false only for a damaged save.
    pub(crate) fn is_valid(&self) -> bool {
        self.restitution_coefficient.is_finite() && self.friction_coefficient.is_finite()
    }
}
