//! What stands upright, as the 2D engine below is told of it, and what games ask about it.

use farseer_core::{Body, GeomRef, SpaceFoot, SpaceUpright, Vertices};

use super::profile::DepthProfile;
use crate::{Vector2, Vector3};

impl DepthProfile {
    /// As the 2D engine below is told of it, if it is upright.
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

    /// What it looks like from the front: the outline that its geom is given.
    pub(crate) fn front(&self) -> Option<Vertices> {
        let upright = self.upright()?;
        let ([left, right], half) = (span(&upright), half_height(&upright));
        // In the order of the engine's own rectangles.
        let corners = [[left, -half], [left, half], [right, half], [right, -half]];
        Some(corners.into_iter().map(Vector2::from).collect())
    }
}

/// How far it reaches up and down.
pub(crate) fn half_height(upright: &SpaceUpright) -> f32 {
    match *upright {
        SpaceUpright::Cylinder { half_height, .. }
        | SpaceUpright::Capsule { half_height, .. }
        | SpaceUpright::Prism { half_height, .. } => half_height,
    }
}

/// Least and greatest X about its geom's origin.
pub(crate) fn span(upright: &SpaceUpright) -> [f32; 2] {
    match upright {
        SpaceUpright::Cylinder { radius, .. } | SpaceUpright::Capsule { radius, .. } => [-radius, *radius],
        SpaceUpright::Prism { footprint, .. } => {
            let (low, high) = footprint.bounds();
            [low.x, high.x]
        }
    }
}

/// Least and greatest Z about its body.
pub(crate) fn depths(upright: &SpaceUpright) -> [f32; 2] {
    match upright {
        SpaceUpright::Cylinder { radius, .. } | SpaceUpright::Capsule { radius, .. } => [-radius, *radius],
        SpaceUpright::Prism { footprint, .. } => {
            let (low, high) = footprint.bounds();
            [low.y, high.y]
        }
    }
}

/// Looks at what something upright covers of the floor.
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

/// Where the middle of an upright geom is, y down: it does not turn about its body.
pub(crate) fn middle(geom: GeomRef<'_>, body: &Body, z: f32) -> Vector3 {
    let place = body.position() + geom.offset();
    Vector3::new(place.x, place.y, z)
}
