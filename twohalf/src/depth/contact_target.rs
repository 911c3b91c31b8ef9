//! Terms of contacts: the target of a contact, and the axes along which it acts.

use farseer_core::GeomId;
use serde::{Deserialize, Serialize};

use super::platform_id::PlatformId;

/// The target of a contact: the other side, as seen by a geom.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub enum ContactTarget {
    /// The target is a geom of another object.
    Geom(GeomId),
    /// The target is a platform.
    Platform(PlatformId),
    /// The target is the body's own ground: the plane Y = 0.
    Ground,
}

impl ContactTarget {
    /// Returns whether the target is the ground.
    #[doc(alias = "IsGround")]
    pub fn is_ground(&self) -> bool {
        matches!(self, ContactTarget::Ground)
    }
}

/// Axes along which a contact acts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Axis {
    /// The contact acts along X and Y: at sides, tops and undersides.
    Plane,
    /// The contact acts along Z: at fronts and backs.
    Depth,
    /// The contact acts along all three axes: of a ball, or at the slanted side of a platform.
    Oblique,
}

impl Axis {
    /// Returns the axes along which a contact acts whose unit normal has this Z component.
    pub(crate) fn of(normal_z: f32) -> Self {
        match normal_z.abs() {
            0.0 => Axis::Plane,
            1.0 => Axis::Depth,
            _ => Axis::Oblique,
        }
    }
}
