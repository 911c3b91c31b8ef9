//! Vertical shapes as the narrow phase knows them: a footprint in x and z, with height and rounding.

use super::footprint::{FootprintPolygon, FootprintShape};
use super::interface::VerticalShape;
use crate::math::plane::Vector;

/// Vertical shape: the footprint extruded along y from -`half_height` to `half_height`, then rounded by a radius.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct VerticalSolid {
    /// Footprint in x and z, relative to the centre of the shape.
    pub(super) footprint: FootprintShape,
    /// Half of the height of the shape without its rounding, in length units, >= 0.
    pub(super) half_height: f32,
    /// Radius of the rounding in length units, >= 0.
    pub(super) rounding: f32,
}

impl VerticalSolid {
    pub(super) fn new(shape: VerticalShape) -> Self {
        match shape {
            VerticalShape::Cylinder { radius, half_height } => {
                VerticalSolid { footprint: FootprintShape::disc(radius), half_height, rounding: 0.0 }
            }
            VerticalShape::Capsule { radius, half_height } => {
                let half = if half_height > radius { half_height - radius } else { 0.0 };
                VerticalSolid { footprint: FootprintShape::disc(0.0), half_height: half, rounding: radius }
            }
            VerticalShape::Prism { footprint, half_height } => {
                let (low, high) = footprint.bounds();
                // The origin is the middle of the width, like that of the outline.
                let middle = 0.5 * (low.x + high.x);
                let corners = footprint.corners().iter().map(|corner| [corner.x - middle, corner.y]);
                let foot = FootprintShape::from_polygon(FootprintPolygon::new(corners));
                VerticalSolid { footprint: foot, half_height, rounding: 0.0 }
            }
        }
    }

    /// Returns a level box as a vertical shape. `corners` are the vertices of its footprint (x and z relative to the origin of
    /// the box), `half` is half of its height; both are in length units.
    pub(super) fn level_box(corners: [Vector; 4], half: f32) -> Self {
        VerticalSolid {
            footprint: FootprintShape::from_polygon(FootprintPolygon::new(corners)),
            half_height: half,
            rounding: 0.0,
        }
    }

    pub(super) fn sphere(radius: f32) -> Self {
        VerticalSolid { footprint: FootprintShape::disc(0.0), half_height: 0.0, rounding: radius }
    }
}
