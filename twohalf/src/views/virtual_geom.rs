//! Footprints: the virtual geoms of the thesis (3.5).

use farseer_core::depth::VerticalShape;
use farseer_core::math::scalar::nearest_finite;
use farseer_core::{GeomRef, PhysicsSimulator};

use crate::Vector3;
use crate::depth::{DepthProfile, upright};

/// Footprint of a geom in X and Z, and its least and greatest height. In px, in the world, Y up, limited to
/// finite numbers.
///
/// In the thesis a virtual geom lies under the object and collides with the virtual geoms of other objects. Here it is for
/// queries only: shapes touch in three axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct VirtualGeom {
    /// Least X, px.
    pub left: f32,
    /// Greatest X, px.
    pub right: f32,
    /// Least Z, px.
    pub front: f32,
    /// Greatest Z, px.
    pub back: f32,
    /// Least Y, px.
    pub bottom: f32,
    /// Greatest Y, px.
    pub top: f32,
    /// Whether the footprint is a disc; otherwise it is a rectangle.
    pub is_round: bool,
    /// Whether the geom has the top of its outline, on which other objects can stand; false for a ball and a capsule.
    pub has_top: bool,
}

impl VirtualGeom {
    pub(crate) fn of(core: &PhysicsSimulator, geom: GeomRef<'_>, profile: DepthProfile, z: f32) -> Self {
        if let Some((upright, body)) = profile.upright().zip(core.body(geom.body())) {
            return Self::of_upright(profile, &upright, upright::middle(geom, body, z));
        }
        let half = profile.half_depth();
        let (low, high) = match profile {
            DepthProfile::Round { radius } => {
                let (centre, reach) = (geom.position(), crate::Vector2::new(radius, radius));
                (centre - reach, centre + reach)
            }
            _ => {
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
            has_top: !profile.is_round(),
        }
    }

    fn of_upright(profile: DepthProfile, upright: &VerticalShape, middle: Vector3) -> Self {
        let ([left, right], half) = (upright::span(upright), upright::half_height(upright));
        let [front, back] = upright::depths(upright);
        VirtualGeom {
            left: nearest_finite(middle.x + left),
            right: nearest_finite(middle.x + right),
            front: nearest_finite(middle.z + front),
            back: nearest_finite(middle.z + back),
            bottom: nearest_finite(-middle.y - half),
            top: nearest_finite(-middle.y + half),
            is_round: !matches!(profile, DepthProfile::Upright { .. }),
            has_top: !matches!(profile, DepthProfile::Capsule { .. }),
        }
    }

    /// Returns whether two footprints overlap, and their heights as well; shapes that only touch do not.
    pub fn overlaps(&self, other: &VirtualGeom) -> bool {
        self.left < other.right
            && other.left < self.right
            && self.front < other.back
            && other.front < self.back
            && self.bottom < other.top
            && other.bottom < self.top
    }
}
