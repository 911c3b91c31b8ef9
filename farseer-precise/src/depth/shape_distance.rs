//! Signed distances of posed shapes in three axes, for queries of the engine above (`twohalf`). The shapes need not be part of
//! the simulation.
//!
//! Uses the separating axes of the narrow phase for vertical shapes.

use super::footprint::{FootprintPolygon, FootprintShape};
use super::interface::VerticalShape;
use super::posed_solid::{PosedSolid, SolidKind};
use super::vertical_dispatch;
use super::vertical_sheared_box::highest_top;
use super::vertical_solid::VerticalSolid;
use crate::math::Vector3;
use crate::pieces::simplified;
use crate::shape::VertexPool;
use crate::slanted_box::SlantedBox;

/// Shape with its position in world coordinates x, y (down) and z, for a distance query. Lengths are in length units.
#[derive(Debug, Clone, Copy)]
pub enum DepthQueryShape<'a> {
    /// The shape is vertical: shape, and world position of its origin in length units.
    Vertical(VerticalShape, Vector3),
    /// The shape is a sphere: radius (>= 0) and world position of its centre, in length units.
    Sphere(f32, Vector3),
    /// The shape is a prism: a convex outline, extruded along z.
    Prism {
        /// Vertices of the outline in world coordinates x and y (down), length units.
        corners: &'a [[f32; 2]],
        /// World position of the prism's centre along z, in length units.
        z: f32,
        /// Half of the extent along z in length units, >= 0.
        half: f32,
    },
}

/// Footprint in x and z, relative to its own position, for queries. Lengths are in length units.
#[derive(Debug, Clone, Copy)]
pub enum DepthQueryFootprint<'a> {
    /// The footprint is a disc about its position with this radius in length units, >= 0.
    Disc(f32),
    /// The footprint is a convex polygon with at most 16 vertices, positive area and these vertices in x and z, length units.
    Polygon(&'a [[f32; 2]]),
}

impl DepthQueryFootprint<'_> {
    /// Returns the footprint as the type that the narrow phase uses.
    fn to_footprint(self) -> FootprintShape {
        match self {
            DepthQueryFootprint::Disc(radius) => FootprintShape::disc(radius),
            DepthQueryFootprint::Polygon(corners) => {
                FootprintShape::from_polygon(FootprintPolygon::new(corners.iter().copied()))
            }
        }
    }

    /// Returns the least and the greatest x of the footprint's points with `near <= z <= far`; `None` if there is no such
    /// point. All values are in length units, relative to the footprint's position.
    pub fn x_range(self, near: f32, far: f32) -> Option<[f32; 2]> {
        self.to_footprint().x_range(near, far)
    }

    /// Returns the signed distance to another footprint in length units, negative for overlap, and the unit vector in x and z
    /// towards the other footprint. `at` is the position of the other footprint relative to this one.
    pub fn distance_to(self, other: DepthQueryFootprint<'_>, at: [f32; 2]) -> (f32, [f32; 2]) {
        let gap = self.to_footprint().distance_to(&other.to_footprint(), at);
        (gap.separation, gap.normal)
    }

    /// Returns the highest point of a box within this footprint: its y in world coordinates (down, length units), and the
    /// outward unit normal x, y, z at the point. `at` is the world position of the footprint in x and z. `None` if footprint
    /// and box do not overlap in x and z.
    pub fn top_surface(self, at: [f32; 2], shape: &SlantedBox) -> Option<(f32, Vector3)> {
        highest_top(shape, &self.to_footprint(), at)
    }
}

/// Returns the signed distance of two shapes in length units, negative for overlap. At least one shape must be vertical; other
/// pairs get `f32::MAX`.
pub fn signed_distance_3d(one: DepthQueryShape<'_>, other: DepthQueryShape<'_>) -> f32 {
    let mut corners = VertexPool::default();
    let vertical = |form: &DepthQueryShape<'_>| match form {
        DepthQueryShape::Vertical(vertical, _) => Some(VerticalSolid::new(*vertical)),
        _ => None,
    };
    let uprights = [vertical(&one), vertical(&other)];
    let shapes = [one, other].map(|form| match form {
        DepthQueryShape::Vertical(vertical, _) => {
            let (middle, half) = vertical.front_box();
            corners.add_box_at(middle, half)
        }
        DepthQueryShape::Sphere(radius, _) => corners.add_disc(radius),
        DepthQueryShape::Prism { corners: outline, .. } => corners.add_hull(&simplified(outline.to_vec())),
    });
    let solids = [0, 1].map(|at| {
        let (kind, [x, y, z]) = match [one, other][at] {
            DepthQueryShape::Vertical(_, place) => (SolidKind::Vertical, place.into()),
            DepthQueryShape::Sphere(_, place) => (SolidKind::Sphere, place.into()),
            DepthQueryShape::Prism { z, half, .. } => (SolidKind::Prism(half), [0.0, 0.0, z]),
        };
        PosedSolid {
            outline: corners.shape_ref(shapes[at]),
            pose: [x, y, 1.0, 0.0],
            kind,
            z,
            last_displacement: [0.0; 3],
            predicted_displacement: [0.0; 3],
            sheared_box: None,
            vertical: uprights[at].as_ref(),
        }
    });
    vertical_dispatch::separation(solids[0], solids[1]).0
}
