//! Footprints: what of an object meets others along Z (thesis 3.5).

use farseer_core::GeomRef;
use farseer_core::math::scalar::nearest_finite;

use crate::depth::DepthProfile;

/// The footprint of a geom in the plane of X and Z, and the heights between which the geom lies. In px, in the world,
/// Y up; beyond finite numbers the nearest ones.
///
/// The thesis makes it a geom of its own, which lies under the object and collides with those of others. Here it is
/// only looked at: shapes meet in three axes without it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct VirtualGeom {
    /// Least X.
    pub left: f32,
    /// Greatest X.
    pub right: f32,
    /// Least Z.
    pub front: f32,
    /// Greatest Z.
    pub back: f32,
    /// Least Y.
    pub bottom: f32,
    /// Greatest Y.
    pub top: f32,
    /// Whether the footprint is a disc; otherwise it is a rectangle.
    pub is_round: bool,
}

impl VirtualGeom {
    pub(crate) fn of(geom: GeomRef<'_>, profile: DepthProfile, z: f32) -> Self {
        let half = profile.half_depth();
        let (low, high) = match profile {
            DepthProfile::Round { radius } => {
                let (centre, reach) = (geom.position(), crate::Vector2::new(radius, radius));
                (centre - reach, centre + reach)
            }
            DepthProfile::Prism { .. } => {
                let aabb = geom.aabb();
                (aabb.min, aabb.max)
            }
        };
        VirtualGeom {
            left: nearest_finite(low.x),
            right: nearest_finite(high.x),
            front: nearest_finite(z - half),
            back: nearest_finite(z + half),
            bottom: nearest_finite(-high.y),
            top: nearest_finite(-low.y),
            is_round: profile.is_round(),
        }
    }

    /// Whether two footprints overlap, and their heights do as well; what only touches does not.
    pub fn overlaps(&self, other: &VirtualGeom) -> bool {
        self.left < other.right
            && other.left < self.right
            && self.front < other.back
            && other.front < self.back
            && self.bottom < other.top
            && other.bottom < self.top
    }
}
