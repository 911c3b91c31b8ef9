//! Contacts of two geoms (behaviour chapter 03, section 1).

use serde::{Deserialize, Serialize};

use crate::math::Vector2;
#[cfg(feature = "precise")]
use crate::math::scalar::nearest_finite;
#[cfg(feature = "precise")]
use farseer_precise::narrow_phase::contact_reader::PlanarContactPoint;

/// Identifies a contact from one update to the next: the vertex of one geom that touches another geom.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
pub struct ContactId {
    /// Creation number of the geom that owns the vertex.
    #[doc(alias = "Geom1Index")]
    pub geom1: u32,
    /// Vertex number given by the narrow phase.
    #[doc(alias = "Geom1Vertex")]
    pub vertex: i32,
    /// Creation number of the geom that the vertex touches.
    #[doc(alias = "Geom2Index")]
    pub geom2: u32,
}

/// A point at which two geoms touch.
#[derive(Debug, Clone, Copy, Default, Serialize, Deserialize)]
pub struct Contact {
    /// Which vertex touches which geom.
    #[doc(alias = "ContactId")]
    pub id: ContactId,
    /// World position, in the user's length unit.
    #[doc(alias = "Position")]
    pub position: Vector2,
    /// Unit normal from geom A toward geom B.
    #[doc(alias = "Normal")]
    pub normal: Vector2,
    /// Distance of the outlines along the normal, in length units; negative when they overlap.
    #[doc(alias = "Separation")]
    pub separation: f32,
    pub(crate) normal_impulse: f32,
    pub(crate) tangent_impulse: f32,
}

impl Contact {
    /// A contact that has not carried any impulse yet.
    pub fn new(position: Vector2, normal: Vector2, separation: f32, id: ContactId) -> Self {
        Contact { id, position, normal, separation, normal_impulse: 0.0, tangent_impulse: 0.0 }
    }

    /// A contact point of the precise set. Numbers that are not finite become the nearest finite ones.
    #[cfg(feature = "precise")]
    pub(crate) fn of_point(point: &PlanarContactPoint, normal: Vector2, id: ContactId) -> Self {
        let &PlanarContactPoint { position: [x, y], separation, impulses, feature: _ } = point;
        let [normal_impulse, tangent_impulse] = impulses.map(nearest_finite);
        Contact::new(Vector2::new(x, y), normal, nearest_finite(separation), id)
            .with_impulses(normal_impulse, tangent_impulse)
    }

    /// The same contact with impulses for a warm start, in mass units · length units/s.
    pub fn with_impulses(self, normal_impulse: f32, tangent_impulse: f32) -> Self {
        Contact { normal_impulse, tangent_impulse, ..self }
    }

    /// Whether all numbers are finite. They are not if a handler has set others, or a matrix of the user's is too
    /// large.
    pub(crate) fn is_finite(&self) -> bool {
        let Contact { id: _, position, normal, separation, normal_impulse, tangent_impulse } = self;
        [position.x, position.y, normal.x, normal.y, *separation, *normal_impulse, *tangent_impulse]
            .iter()
            .all(|value| value.is_finite())
    }

    /// Impulse along the normal, accumulated by the solver in the last update, in mass units · length units/s, 0 or
    /// more.
    pub fn normal_impulse(&self) -> f32 {
        self.normal_impulse
    }

    /// Friction impulse accumulated by the solver in the last update, in mass units · length units/s, along `(normal.y,
    /// -normal.x)`.
    pub fn tangent_impulse(&self) -> f32 {
        self.tangent_impulse
    }
}

/// Contacts are equal when their ids are, wherever they lie.
impl PartialEq for Contact {
    fn eq(&self, other: &Self) -> bool {
        self.id == other.id
    }
}

/// Index of the first contact with the same id.
#[doc(alias("IndexOfSafe", "ContactList"))]
pub fn index_of_safe(contacts: &[Contact], contact: &Contact) -> Option<usize> {
    contacts.iter().position(|other| other == contact)
}
