//! What a geom has beyond that of the 2D engine: depth.

use farseer_core::GeomRef;
use farseer_core::math::scalar::nearest_finite;
use farseer_core::shape::Aabb;
use serde::{Deserialize, Serialize};

use crate::Result;
use crate::error::invalid;

/// How the outline of a geom becomes a body of three dimensions.
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
}

impl DepthProfile {
    /// Half of the extent along Z in px.
    pub fn half_depth(&self) -> f32 {
        match *self {
            DepthProfile::Prism { depth } => depth * 0.5,
            DepthProfile::Round { radius } => radius,
        }
    }

    pub(crate) fn is_round(&self) -> bool {
        matches!(self, DepthProfile::Round { .. })
    }

    /// What a geom has unless it is told otherwise: a prism as deep as the shorter side of its outline's box, which may
    /// be beyond finite numbers.
    pub(crate) fn default_of(geom: GeomRef<'_>) -> Self {
        let side = Aabb::from_vertices(geom.local_vertices()).get_shortest_side();
        DepthProfile::Prism { depth: nearest_finite(side) }
    }

    /// Refuses what no shape can have.
    pub(crate) fn check(self) -> Result<Self> {
        match self {
            DepthProfile::Prism { depth } if !(depth.is_finite() && depth >= 0.0) => {
                Err(invalid("depth", depth, "finite and 0 or more"))
            }
            DepthProfile::Round { radius } if !(radius.is_finite() && radius > 0.0) => {
                Err(invalid("radius", radius, "finite and greater than 0"))
            }
            _ => Ok(self),
        }
    }
}
