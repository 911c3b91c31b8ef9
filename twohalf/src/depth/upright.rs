//! Upright geoms in the form that the core takes, and their extents.

use farseer_core::depth::VerticalShape;
use farseer_core::{Body, GeomRef, Vertices};
use farseer_precise::depth::shape_distance::DepthQueryFootprint;

use super::profile::DepthProfile;
use crate::{Vector2, Vector3};

impl DepthProfile {
    /// Returns the upright shape as a vertical shape of the core; `None` for prisms and balls.
    pub(crate) fn upright(&self) -> Option<VerticalShape> {
        match *self {
            DepthProfile::Cylinder { radius, height } => {
                Some(VerticalShape::Cylinder { radius, half_height: 0.5 * height })
            }
            DepthProfile::Capsule { radius, height } => {
                Some(VerticalShape::Capsule { radius, half_height: 0.5 * height })
            }
            DepthProfile::Upright { footprint, height } => {
                Some(VerticalShape::Prism { footprint: footprint.into(), half_height: 0.5 * height })
            }
            DepthProfile::Prism { .. } | DepthProfile::Round { .. } => None,
        }
    }

    /// Returns the outline that the geom of an upright profile gets: the silhouette from the front. `None` for prisms and
    /// balls.
    pub(crate) fn front(&self) -> Option<Vertices> {
        let upright = self.upright()?;
        let ([left, right], half) = (span(&upright), half_height(&upright));
        // In the order of the core's own rectangles.
        let corners = [[left, -half], [left, half], [right, half], [right, -half]];
        Some(corners.into_iter().map(Vector2::from).collect())
    }
}

/// Returns half of the height of an upright shape, px.
pub(crate) fn half_height(upright: &VerticalShape) -> f32 {
    match *upright {
        VerticalShape::Cylinder { half_height, .. }
        | VerticalShape::Capsule { half_height, .. }
        | VerticalShape::Prism { half_height, .. } => half_height,
    }
}

/// Returns the least and the greatest X of an upright shape relative to the geom's origin, px.
pub(crate) fn span(upright: &VerticalShape) -> [f32; 2] {
    match upright {
        VerticalShape::Cylinder { radius, .. } | VerticalShape::Capsule { radius, .. } => [-radius, *radius],
        VerticalShape::Prism { footprint, .. } => {
            let (low, high) = footprint.bounds();
            [low.x, high.x]
        }
    }
}

/// Returns the least and the greatest Z of an upright shape relative to the body's Z, px.
pub(crate) fn depths(upright: &VerticalShape) -> [f32; 2] {
    match upright {
        VerticalShape::Cylinder { radius, .. } | VerticalShape::Capsule { radius, .. } => [-radius, *radius],
        VerticalShape::Prism { footprint, .. } => {
            let (low, high) = footprint.bounds();
            [low.y, high.y]
        }
    }
}

/// Calls a function with the footprint of an upright shape.
pub(crate) fn with_foot<R>(upright: &VerticalShape, look: impl FnOnce(DepthQueryFootprint<'_>) -> R) -> R {
    match upright {
        VerticalShape::Cylinder { radius, .. } | VerticalShape::Capsule { radius, .. } => {
            look(DepthQueryFootprint::Disc(*radius))
        }
        VerticalShape::Prism { footprint, .. } => {
            let corners: Vec<[f32; 2]> =
                footprint.corners().iter().map(|corner| [corner.x, corner.y]).collect();
            look(DepthQueryFootprint::Polygon(&corners))
        }
    }
}

/// Returns the centre of an upright geom in world axes: x right, y down, z into the picture, px. `z` is the depth of the body.
/// The geom does not rotate about its body.
pub(crate) fn middle(geom: GeomRef<'_>, body: &Body, z: f32) -> Vector3 {
    let place = body.position() + geom.offset();
    Vector3::new(place.x, place.y, z)
}
