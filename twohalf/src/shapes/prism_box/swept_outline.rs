//! Swept outline of a sheared box between two depths: the convex hull of its outlines at both depths, with four to six edges.
//!
//! Frame: the plane's, x right, y **down**, z into the picture. Vertices are relative to the box's centre,
//! which keeps rounding small far from the origin.

use farseer_core::math::Vector2;
use serde::{Deserialize, Serialize};

use crate::shapes::{Face, SlantedBox};

/// An edge of the swept outline.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) enum BoxEdge {
    /// The edge is a side of the box.
    Face(Face),
    /// The edge is the path of the upper or lower corner through depth: an edge of the box along its depth.
    Level { is_upper: bool },
}

impl BoxEdge {
    /// Returns the outward unit normal of the edge in the plane, y down.
    pub(super) fn normal(self, shape: &SlantedBox) -> Vector2 {
        match self {
            BoxEdge::Face(face) => shape.plane_normal(face),
            BoxEdge::Level { is_upper } => Vector2::new(0.0, if is_upper { -1.0 } else { 1.0 }),
        }
    }
}

/// Hull of a box's outlines at two depths, with the core's winding.
#[derive(Debug, Clone, Copy)]
pub(super) struct SweptOutline {
    /// Number of vertices, 4..=6.
    count: usize,
    vertices: [Vector2; 6],
    /// Z at which the box reaches each vertex, px, in the world.
    depths: [f32; 6],
    /// Feature ids of the vertices, dimensionless, which do not change with the depths.
    labels: [u32; 6],
    /// The edge from each vertex to the next.
    edges: [BoxEdge; 6],
}

impl SweptOutline {
    /// The outline between the depths `near` and `far` of the world, px.
    pub(super) fn new(shape: &SlantedBox, near: f32, far: f32) -> Self {
        let mut outline = SweptOutline {
            count: 0,
            vertices: [Vector2::zeros(); 6],
            depths: [0.0; 6],
            labels: [0; 6],
            edges: [BoxEdge::Face(Face::Top); 6],
        };
        let rectangle = shape.rectangle();
        let middle = near + (far - near) * 0.5;
        let reach = |z: f32| shape.shear * (z - shape.centre.z);
        // The end of the depths at which a side reaches farther out.
        let side = |edge: usize| lean(shape, Face::SIDES[edge]);
        let mut push = |corner: usize, lean: f32, edge: BoxEdge| {
            let (depth, end) = match lean {
                lean if lean > 0.0 => (far, 1),
                lean if lean < 0.0 => (near, 0),
                _ => (middle, 0),
            };
            let index = outline.count;
            outline.vertices[index] = rectangle[corner] + Vector2::new(reach(depth), 0.0);
            outline.depths[index] = depth;
            outline.labels[index] = corner as u32 * 2 + end;
            outline.edges[index] = edge;
            outline.count += 1;
        };
        for (corner, face) in Face::SIDES.into_iter().enumerate() {
            let (before, after) = (side((corner + 3) % 4), side(corner));
            let edge = BoxEdge::Face(face);
            if before * after < 0.0 {
                // The upper corner is the one between a side that faces right and one that faces left, in
                // this order.
                let is_upper = (before > 0.0) == (shape.shear > 0.0);
                push(corner, before, BoxEdge::Level { is_upper });
                push(corner, after, edge);
            } else {
                push(corner, if after == 0.0 { before } else { after }, edge);
            }
        }
        outline
    }

    pub(super) fn len(&self) -> usize {
        self.count
    }

    /// Vertices relative to the box's centre, px.
    pub(super) fn vertices(&self) -> &[Vector2] {
        &self.vertices[..self.count]
    }

    pub(super) fn edge(&self, index: usize) -> BoxEdge {
        self.edges[index]
    }

    pub(super) fn position_of(&self, edge: BoxEdge) -> Option<usize> {
        self.edges[..self.count].iter().position(|&other| other == edge)
    }

    pub(super) fn depth(&self, vertex: usize) -> f32 {
        self.depths[vertex]
    }

    pub(super) fn label(&self, vertex: usize) -> u32 {
        self.labels[vertex]
    }

    /// Vertices in the plane, px.
    pub(super) fn in_plane(&self, shape: &SlantedBox) -> [Vector2; 6] {
        let centre = Vector2::new(shape.centre.x, shape.centre.y);
        self.vertices.map(|vertex| centre + vertex)
    }
}

/// Returns how far a side moves outward per px of depth, dimensionless; negative for a side that moves inward.
fn lean(shape: &SlantedBox, face: Face) -> f32 {
    shape.shear * shape.plane_normal(face).x
}
