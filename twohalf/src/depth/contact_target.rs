//! Terms of contacts: the target of a contact, and the axes along which it acts.

use farseer_core::GeomId;
use serde::{Deserialize, Serialize};

use super::platform_id::PlatformId;

/// The target of a contact: the other side, as seen by a geom.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub enum ContactTarget {
    /// Another object's geom.
    Geom(GeomId),
    /// A platform.
    Platform(PlatformId),
    /// The body's own ground: the plane Y = 0.
    Ground,
}

impl ContactTarget {
    /// Whether it is the ground.
    #[doc(alias = "IsGround")]
    pub fn is_ground(&self) -> bool {
        matches!(self, ContactTarget::Ground)
    }
}

/// Axes along which a contact acts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Axis {
    /// X and Y: sides, tops and undersides.
    Plane,
    /// Z: fronts and backs.
    Depth,
    /// All three: a ball, or the slanted side of a platform.
    Oblique,
}

impl Axis {
    /// The axes of a normal with this Z component.
    pub(crate) fn of(normal_z: f32) -> Self {
        match normal_z.abs() {
            0.0 => Axis::Plane,
            1.0 => Axis::Depth,
            _ => Axis::Oblique,
        }
    }
}
