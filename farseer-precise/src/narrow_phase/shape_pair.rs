//! Narrow phase: two convex shapes with their relative poses, for capsules and linked
//! polygons (convex pieces that know the adjacent edges of their outline).
//!
//! The functions find the closest features of two cores (polygons or segments without radii) and build manifolds of edges and
//! vertices with the radii added.

use crate::math::plane::{
    Pose, Rot, Vector, difference, dot, rotate, rotate_inverse, rotation, scaled, sum, translation,
};
use crate::narrow_phase::manifold::{Manifold, clip_to_edge, find_max_separation, next_index};
use crate::parameters::narrow_phase::REFERENCE_EDGE_HYSTERESIS;
use crate::shape::ShapeRef;

/// Two shapes with vertices and perhaps radii. Each side also stores the pose of the other shape in its own frame.
pub(crate) struct ShapePair<'a> {
    pub(crate) a: PairSide<'a>,
    pub(crate) b: PairSide<'a>,
    rotation_a: Rot,
    rotation_b: Rot,
    /// Vector from the origin of A's body to that of B, in world axes, length units.
    offset: Vector,
}

/// One shape of a pair, with the pose of the other shape in the frame of this one.
#[derive(Clone, Copy)]
pub(crate) struct PairSide<'a> {
    pub(crate) shape_ref: ShapeRef<'a>,
    other_position: Vector,
    other_rotation: Rot,
}

/// Selects the shape A or B of a [`ShapePair`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum WhichShape {
    A,
    B,
}

impl WhichShape {
    pub(crate) fn other(self) -> Self {
        match self {
            WhichShape::A => WhichShape::B,
            WhichShape::B => WhichShape::A,
        }
    }
}

/// Closest features of two cores (polygons or segments without radii) that do not overlap.
#[derive(Debug, Clone, Copy)]
pub(crate) enum ClosestFeatures {
    /// The interior of an edge of the given shape (index of the edge), and a vertex of the other shape.
    Edge(WhichShape, usize),
    /// A vertex of each shape (indices), and the vector from the vertex of A to that of B in the frame of A, in length units.
    Vertices { vertex_a: usize, vertex_b: usize, offset: Vector },
}

impl<'a> PairSide<'a> {
    /// Converts a point from the frame of the other shape to the frame of this shape, in length units.
    pub(crate) fn to_local(self, point: Vector) -> Vector {
        sum(rotate(self.other_rotation, point), self.other_position)
    }

    /// Converts a direction from the frame of this shape to the frame of the other shape.
    pub(crate) fn to_other(self, direction: Vector) -> Vector {
        rotate_inverse(self.other_rotation, direction)
    }

    /// Returns the largest separation of the shape `other` along the edge normals of this shape (length units, negative for
    /// penetration), and the index of the edge. Both shapes count without their radii.
    pub(crate) fn find_max_separation(&self, other: &PairSide<'_>) -> (f32, usize) {
        find_max_separation(self.shape_ref, other.shape_ref, self.other_position, self.other_rotation)
    }
}

impl<'a> ShapePair<'a> {
    pub(crate) fn new(a: ShapeRef<'a>, b: ShapeRef<'a>, pose_a: Pose, pose_b: Pose) -> Self {
        let (rotation_a, rotation_b) = (rotation(pose_a), rotation(pose_b));
        let offset = difference(translation(pose_b), translation(pose_a));
        let (position, relative_rotation) =
            (rotate_inverse(rotation_a, offset), rotate_inverse(rotation_a, rotation_b));
        let (position_back, rotation_back) = (
            rotate_inverse(relative_rotation, scaled(position, -1.0)),
            [relative_rotation[0], -relative_rotation[1]],
        );
        ShapePair {
            a: PairSide { shape_ref: a, other_position: position, other_rotation: relative_rotation },
            b: PairSide { shape_ref: b, other_position: position_back, other_rotation: rotation_back },
            rotation_a,
            rotation_b,
            offset,
        }
    }

    pub(crate) fn side(&self, which: WhichShape) -> &PairSide<'a> {
        match which {
            WhichShape::A => &self.a,
            WhichShape::B => &self.b,
        }
    }

    /// Returns the sum of the radii of both shapes, in length units.
    pub(crate) fn total_radius(&self) -> f32 {
        self.a.shape_ref.shape.radius + self.b.shape_ref.shape.radius
    }

    /// Returns the manifold of an edge of the shape `which` with the incident edge of the other shape, in world axes.
    ///
    /// Let a and b be the radii of the shape with the reference edge and of the other, s the separation of the cores (the
    /// shapes without radii) along the normal n. The surfaces are s - a - b apart. The point midway between the surfaces is the
    /// one midway between the cores, minus n (b - a) / 2.
    pub(crate) fn clip_edge(&self, which: WhichShape, edge: usize, margin: f32) -> Manifold {
        let (this, other) = (self.side(which), self.side(which.other()));
        let (a, b) = (this.shape_ref.shape.radius, other.shape_ref.shape.radius);
        let mut manifold = clip_to_edge(
            this.shape_ref,
            other.shape_ref,
            this.other_position,
            this.other_rotation,
            edge,
            margin + a + b,
        );
        let towards_this = scaled(manifold.normal, 0.5 * (b - a));
        manifold.points = manifold.points.map(|point| difference(point, towards_this));
        manifold.separations = manifold.separations.map(|separation| separation - a - b);
        match which {
            WhichShape::A => manifold.to_world(self.rotation_a),
            WhichShape::B => manifold.to_world_flipped(self.rotation_b, self.offset),
        }
    }

    /// Returns the manifold of a vertex of each shape, in world axes: at most one point. `offset` leads from the vertex of A to
    /// that of B, in the frame of A, length units.
    pub(crate) fn vertex_vertex(
        &self,
        vertex_a: usize,
        vertex_b: usize,
        offset: Vector,
        margin: f32,
    ) -> Manifold {
        let distance = dot(offset, offset).sqrt();
        let normal = scaled(offset, 1.0 / distance);
        let separation = distance - self.total_radius();
        let from_corner = self.a.shape_ref.shape.radius + 0.5 * separation;
        let point = sum(self.a.shape_ref.vertices[vertex_a], scaled(normal, from_corner));
        let feature = ((vertex_a as u32) << 16) | vertex_b as u32;
        Manifold::single_point(normal, point, separation, feature, margin).to_world(self.rotation_a)
    }

    /// Returns the distance of the cores (polygons or segments without radii) in length units, and their closest features.
    /// `None` if no edge faces a vertex. The closest features of separated convex shapes are an edge and a vertex, or two
    /// vertices.
    pub(crate) fn closest_features(&self, margin: f32) -> Option<(f32, ClosestFeatures)> {
        let of_a = closest_edge(&self.a, &self.b);
        let of_b = closest_edge(&self.b, &self.a);
        // The hysteresis keeps the edge of A where both are about as good.
        let is_b = match (&of_a, &of_b) {
            (Some(a), Some(b)) => b.distance < a.distance - REFERENCE_EDGE_HYSTERESIS * margin,
            (None, Some(_)) => true,
            _ => false,
        };
        let candidate = if is_b { of_b } else { of_a }?;
        let nearest = match candidate.edge_end {
            None => ClosestFeatures::Edge(if is_b { WhichShape::B } else { WhichShape::A }, candidate.edge),
            Some(end) if is_b => {
                let offset = scaled(self.b.to_other(candidate.offset), -1.0);
                ClosestFeatures::Vertices { vertex_a: candidate.vertex, vertex_b: end, offset }
            }
            Some(end) => ClosestFeatures::Vertices {
                vertex_a: end,
                vertex_b: candidate.vertex,
                offset: candidate.offset,
            },
        };
        Some((candidate.distance, nearest))
    }
}

/// An edge of one shape and a vertex of the other, with the distance between them.
struct EdgePoint {
    /// Distance of the vertex from the edge, in length units, >= 0.
    distance: f32,
    /// Index of the edge of the first shape.
    edge: usize,
    /// Index of the end vertex of the edge that is closest to the vertex of the other shape. `None` if a point between the ends
    /// is closer.
    edge_end: Option<usize>,
    /// Index of the vertex of the other shape.
    vertex: usize,
    /// Vector from the closest point of the edge to the vertex, in the frame of the edge's body, length units.
    offset: Vector,
}

/// Returns the edge of `one` and the vertex of `other` with the smallest distance, among the edges that face the vertex. `None`
/// if no edge faces a vertex.
fn closest_edge(one: &PairSide<'_>, other: &PairSide<'_>) -> Option<EdgePoint> {
    let ShapeRef { vertices, normals, .. } = one.shape_ref;
    // Distance, indices of edge and vertex, and the end of the edge: the vector of the closest pair follows at the end.
    let (mut min_distance, mut nearest) = (f32::INFINITY, None);
    for (vertex, &point) in other.shape_ref.vertices.iter().enumerate() {
        let point = one.to_local(point);
        for (edge, (&start, &normal)) in vertices.iter().zip(normals).enumerate() {
            let from_start = difference(point, start);
            let height = dot(normal, from_start);
            if height < 0.0 {
                continue;
            }
            let next = next_index(edge, vertices.len());
            let (end, along) = (vertices[next], difference(vertices[next], start));
            let from_end = difference(point, end);
            let (distance, edge_end) = if dot(from_start, along) <= 0.0 {
                (dot(from_start, from_start).sqrt(), Some(edge))
            } else if dot(from_end, along) >= 0.0 {
                (dot(from_end, from_end).sqrt(), Some(next))
            } else {
                (height, None)
            };
            if distance < min_distance || nearest.is_none() {
                (min_distance, nearest) = (distance, Some((edge, edge_end, vertex, point)));
            }
        }
    }
    let (edge, edge_end, vertex, point) = nearest?;
    let offset = match edge_end {
        Some(end) => difference(point, vertices[end]),
        None => scaled(normals[edge], min_distance),
    };
    Some(EdgePoint { distance: min_distance, edge, edge_end, vertex, offset })
}
