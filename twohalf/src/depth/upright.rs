//! Upright geoms in the form that the core takes, and their extents.

use farseer_core::{Body, GeomRef, SpaceFoot, SpaceUpright, Vertices};

use super::profile::DepthProfile;
use crate::{Vector2, Vector3};

impl DepthProfile {
    /// The upright shape in the form that the core takes; `None` for prisms and balls.
    pub(crate) fn upright(&self) -> Option<SpaceUpright> {
        match *self {
            DepthProfile::Cylinder { radius, height } => {
                Some(SpaceUpright::Cylinder { radius, half_height: 0.5 * height })
            }
            DepthProfile::Capsule { radius, height } => {
                Some(SpaceUpright::Capsule { radius, half_height: 0.5 * height })
            }
            DepthProfile::Upright { footprint, height } => {
                Some(SpaceUpright::Prism { footprint, half_height: 0.5 * height })
            }
            DepthProfile::Prism { .. } | DepthProfile::Round { .. } => None,
        }
    }

    /// The outline of its geom: its silhouette from the front.
    pub(crate) fn front(&self) -> Option<Vertices> {
        let upright = self.upright()?;
        let ([left, right], half) = (span(&upright), half_height(&upright));
        // In the order of the core's own rectangles.
        let corners = [[left, -half], [left, half], [right, half], [right, -half]];
        Some(corners.into_iter().map(Vector2::from).collect())
    }
}

/// Half of the height, px.
pub(crate) fn half_height(upright: &SpaceUpright) -> f32 {
    match *upright {
        SpaceUpright::Cylinder { half_height, .. }
        | SpaceUpright::Capsule { half_height, .. }
        | SpaceUpright::Prism { half_height, .. } => half_height,
    }
}

/// Least and greatest X about the geom's origin, px.
pub(crate) fn span(upright: &SpaceUpright) -> [f32; 2] {
    match upright {
        SpaceUpright::Cylinder { radius, .. } | SpaceUpright::Capsule { radius, .. } => [-radius, *radius],
        SpaceUpright::Prism { footprint, .. } => {
            let (low, high) = footprint.bounds();
            [low.x, high.x]
        }
    }
}

/// Least and greatest Z about the body, px.
pub(crate) fn depths(upright: &SpaceUpright) -> [f32; 2] {
    match upright {
        SpaceUpright::Cylinder { radius, .. } | SpaceUpright::Capsule { radius, .. } => [-radius, *radius],
        SpaceUpright::Prism { footprint, .. } => {
            let (low, high) = footprint.bounds();
            [low.y, high.y]
        }
    }
}

/// Calls a function with the footprint of an upright shape.
pub(crate) fn with_foot<R>(upright: &SpaceUpright, look: impl FnOnce(SpaceFoot<'_>) -> R) -> R {
    match upright {
        SpaceUpright::Cylinder { radius, .. } | SpaceUpright::Capsule { radius, .. } => {
            look(SpaceFoot::Disc(*radius))
        }
        SpaceUpright::Prism { footprint, .. } => {
            let corners: Vec<[f32; 2]> =
                footprint.corners().iter().map(|corner| [corner.x, corner.y]).collect();
            look(SpaceFoot::Polygon(&corners))
        }
    }
}

/// Centre of an upright geom, px, y down; it does not rotate about its body.
pub(crate) fn middle(geom: GeomRef<'_>, body: &Body, z: f32) -> Vector3 {
    let place = body.position() + geom.offset();
    Vector3::new(place.x, place.y, z)
}
