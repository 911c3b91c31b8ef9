//! Depth profiles: the shape of a geom in three axes.

use farseer_core::math::scalar::nearest_finite;
use farseer_core::shape::Aabb;
use farseer_core::{Footprint, GeomRef};
use serde::{Deserialize, Serialize};

use crate::Result;
use crate::error::invalid;

/// Shape of a geom in three axes, from its outline and a depth.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum DepthProfile {
    /// The outline, extruded to this depth: half of it before and half of it behind the body's Z.
    Prism {
        /// Extent along Z in px, 0 or more.
        depth: f32,
    },
    /// A ball about the geom's origin. On the ground it touches in one point and rolls in every direction.
    Round {
        /// Radius in px, greater than 0.
        radius: f32,
    },
    /// An upright cylinder about the geom's origin. Neither it nor its body rotates: see
    /// [`Upright`](Self::Upright).
    Cylinder {
        /// Radius in px, greater than 0.
        radius: f32,
        /// Height in px, greater than 0.
        height: f32,
    },
    /// An upright capsule about the geom's origin: a cylinder with hemispheres as ends, so that it slides
    /// over edges. Neither it nor its body rotates: see [`Upright`](Self::Upright).
    Capsule {
        /// Radius in px, greater than 0.
        radius: f32,
        /// Height in px with both ends, at least twice the radius.
        height: f32,
    },
    /// An upright prism: a footprint extruded along Y, half of its height above and half below the geom's
    /// origin. Cylinders, capsules and upright prisms need
    /// [`DepthScheme::Precise`](crate::DepthScheme::Precise).
    ///
    /// Contacts and torques do not rotate its body; a rotation that a game sets turns the picture only.
    /// Contacts with other upright geoms, platforms, extruded outlines and balls use the true normals of its
    /// sides.
    Upright {
        /// Footprint in X and Z about the geom's origin.
        footprint: Footprint,
        /// Height in px, greater than 0.
        height: f32,
    },
}

impl DepthProfile {
    /// Half of the extent along Z in px.
    pub fn half_depth(&self) -> f32 {
        match *self {
            DepthProfile::Prism { depth } => depth * 0.5,
            DepthProfile::Round { radius }
            | DepthProfile::Cylinder { radius, .. }
            | DepthProfile::Capsule { radius, .. } => radius,
            DepthProfile::Upright { footprint, .. } => {
                let (low, high) = footprint.bounds();
                if -low.y > high.y { -low.y } else { high.y }
            }
        }
    }

    /// Returns whether it is a cylinder, capsule or upright prism, whose body does not rotate.
    pub fn is_upright(&self) -> bool {
        self.upright().is_some()
    }

    pub(crate) fn is_round(&self) -> bool {
        matches!(self, DepthProfile::Round { .. })
    }

    /// The default profile: a prism as deep as the shorter side of the outline's AABB, limited to finite
    /// numbers.
    pub(crate) fn default_of(geom: GeomRef<'_>) -> Self {
        let side = Aabb::from_vertices(geom.local_vertices()).get_shortest_side();
        DepthProfile::Prism { depth: nearest_finite(side) }
    }

    /// Returns the profile, or an error for sizes out of range.
    pub(crate) fn check(self) -> Result<Self> {
        match self {
            DepthProfile::Prism { depth } if !(depth.is_finite() && depth >= 0.0) => {
                Err(invalid("depth", depth, "finite and 0 or more"))
            }
            DepthProfile::Round { radius } if !(radius.is_finite() && radius > 0.0) => {
                Err(invalid("radius", radius, "finite and greater than 0"))
            }
            DepthProfile::Cylinder { radius, height } | DepthProfile::Capsule { radius, height } => {
                let is_size = |size: f32| size.is_finite() && size > 0.0;
                let is_capsule = matches!(self, DepthProfile::Capsule { .. });
                if !is_size(radius) {
                    return Err(invalid("radius", radius, "finite and greater than 0"));
                }
                if !is_size(height) || (is_capsule && height < 2.0 * radius) {
                    let wanted = "finite and greater than 0, and no less than twice the radius of a capsule";
                    return Err(invalid("height", height, wanted));
                }
                Ok(self)
            }
            DepthProfile::Upright { height, .. } if !(height.is_finite() && height > 0.0) => {
                Err(invalid("height", height, "finite and greater than 0"))
            }
            _ => Ok(self),
        }
    }
}
