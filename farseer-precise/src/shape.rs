//! Convex shapes in the frame of their body: circles, capsules, and polygons with the outward normals of their edges.
//!
//! A convex piece of a concave outline, or an edge of a chain, is a linked polygon: each edge knows the adjacent edges of the
//! outline, for the ghost filter. Vertices and normals of all shapes are in one [`VertexPool`].

use crate::edge_adjacency::{self, Seam};
use crate::index::{DenseIndex, index_type};
use crate::math::plane::{Vector, difference, dot, length, rotate, sum};
use crate::math::scalar;
use crate::pieces::{Piece, simplified};
use crate::reusing_clone;
use std::ops::Range;
use wide::f32x4;

index_type! {
    /// Index of [`EdgeLanes`] in the [`VertexPool`].
    struct LaneIndex;
}

/// Kind of a shape. It selects the collision routine.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) enum ShapeKind {
    #[default]
    Circle,
    /// Closed convex polygon that is a whole outline, without a radius.
    Polygon,
    /// Capsule: a segment between two vertices, with a radius.
    Capsule,
    /// Polygon that is one convex piece of an outline: each edge knows the adjacent edges of the outline. With two vertices it
    /// is an edge of a chain. If its second edge is internal, it collides on the side of its first normal only.
    LinkedPolygon,
    /// Convex polygon with a radius: all points within that distance of the polygon.
    RoundedPolygon,
}

/// Convex shape in the frame of its body. Its vertices and normals are in a [`VertexPool`].
#[derive(Debug, Clone, Copy, Default)]
pub struct Shape {
    pub(crate) kind: ShapeKind,
    /// Index of the shape's first vertex in the [`VertexPool`].
    vertex_start: u32,
    /// Index of the shape's first edge adjacency in the [`VertexPool`]; unused unless the shape is a linked polygon.
    adjacency_start: u32,
    /// Index of the shape's first [`EdgeLanes`] in the [`VertexPool`].
    lane_start: LaneIndex,
    /// Number of vertices: 0 for a circle, 2 for a capsule or an edge of a chain, else at least 3.
    pub(crate) vertex_count: u32,
    /// Whether the shape is a rectangle about the origin of its body, with sides along the axes of the body.
    pub(crate) is_box: bool,
    /// Radius of a circle, capsule or rounded polygon, in length units; 0 for other polygons.
    pub radius: f32,
    /// Centre of the shape's AABB in the frame of the body, in length units.
    pub centre: Vector,
    /// Half extents (x, y) of the shape's AABB in the frame of the body, without the radius, in length units.
    pub half_extents: Vector,
    /// Largest distance of the surface of the shape from the origin of its body, in length units, radius included.
    pub max_extent: f32,
}

impl Shape {
    /// Returns whether the shape is a polygon that is a whole outline, without a radius.
    pub(crate) fn is_plain_polygon(self) -> bool {
        self.kind == ShapeKind::Polygon
    }

    /// Returns whether the shape is a convex piece of an outline, or an edge of a chain: its edges know the adjacent edges.
    pub(crate) fn is_linked(self) -> bool {
        self.kind == ShapeKind::LinkedPolygon
    }

    /// Returns the range of the shape's vertices in the [`VertexPool`].
    fn vertex_range(self) -> Range<usize> {
        self.vertex_start as usize..(self.vertex_start + self.vertex_count) as usize
    }

    /// Returns the number of [`EdgeLanes`] of the shape.
    fn lane_count(self) -> usize {
        self.vertex_range().len().div_ceil(4)
    }

    /// Returns the shape with half extents and `max_extent` enlarged by `distance`, in length units. Vertices and radius stay.
    pub(crate) fn expanded(self, distance: f32) -> Self {
        let [x, y] = self.half_extents;
        Shape {
            half_extents: [x + distance, y + distance],
            max_extent: self.max_extent + distance,
            is_box: self.is_box && distance == 0.0,
            ..self
        }
    }
}

/// Vertices, outward unit edge normals and edge adjacencies of all shapes, in the frames of the bodies, length units.
#[derive(Debug, Default)]
pub struct VertexPool {
    vertices: Vec<Vector>,
    normals: Vec<Vector>,
    /// Adjacency of each edge of the linked polygons: the normals of the adjacent edges of the outline.
    adjacency: Vec<Seam>,
    /// The edges of all shapes in SIMD lanes.
    edge_lanes: Vec<EdgeLanes>,
}

reusing_clone! { VertexPool { vertices, normals, adjacency, edge_lanes } }

/// Four consecutive edges of a shape in SIMD lanes, in the frame of its body. The last edge of the shape fills the lanes beyond it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct EdgeLanes {
    /// Coordinates x and y of the first vertex of each edge, length units.
    pub(crate) starts: [f32x4; 2],
    /// Components x and y of the outward unit normals.
    pub(crate) normals: [f32x4; 2],
}

impl EdgeLanes {
    /// Returns the edges of a closed outline from the index `first` on. `vertices` are in length units.
    fn new(first: usize, vertices: &[Vector], normals: &[Vector]) -> Self {
        let lanes = |vectors: &[Vector]| {
            let last = vectors.len() - 1;
            let four: [Vector; 4] = std::array::from_fn(|lane| vectors[(first + lane).min(last)]);
            [0, 1].map(|axis| f32x4::new(four.map(|vector| vector[axis])))
        };
        EdgeLanes { starts: lanes(vertices), normals: lanes(normals) }
    }
}

/// A shape with slices of its vertices (length units) and outward unit edge normals, in the frame of its body. Edge i runs from
/// vertex i to the next one.
#[derive(Clone, Copy)]
pub struct ShapeRef<'a> {
    pub(crate) shape: Shape,
    pub(crate) vertices: &'a [Vector],
    pub(crate) normals: &'a [Vector],
    /// Vertices, normals and edges of all shapes.
    pool: &'a VertexPool,
}

impl<'a> ShapeRef<'a> {
    /// Returns the largest coordinate of the vertices along a direction in the frame of the body, in length units; for a circle
    /// that of its centre. The radius is not included.
    pub(crate) fn max_projection(&self, direction: Vector) -> f32 {
        let points =
            if self.vertices.is_empty() { std::slice::from_ref(&self.shape.centre) } else { self.vertices };
        points.iter().map(|&point| dot(point, direction)).fold(f32::MIN, scalar::max)
    }

    /// Returns the edges, four at a time.
    #[inline(always)]
    pub(crate) fn edge_lanes(&self) -> &'a [EdgeLanes] {
        &self.pool.edge_lanes[self.shape.lane_start.position()..][..self.shape.lane_count()]
    }

    /// Returns whether the shape is an edge of a chain.
    pub(crate) fn is_chain_edge(&self) -> bool {
        self.shape.is_linked() && self.shape.vertex_count == 2
    }

    /// Returns whether the shape is an edge of a chain that collides on the side of its first normal only.
    pub(crate) fn is_one_sided(&self) -> bool {
        self.is_chain_edge() && self.adjacency()[1].is_internal
    }

    /// Returns whether the shape is an edge of a chain that collides on both sides.
    pub(crate) fn is_two_sided(&self) -> bool {
        self.is_chain_edge() && !self.adjacency()[1].is_internal
    }

    /// Returns for each edge the adjacent edges of the whole outline; an empty slice if the shape itself is a whole outline.
    pub(crate) fn adjacency(&self) -> &'a [Seam] {
        if self.shape.is_linked() {
            &self.pool.adjacency[self.shape.adjacency_start as usize..][..self.shape.vertex_range().len()]
        } else {
            &[]
        }
    }
}

impl VertexPool {
    /// Removes the vertices, normals and edge adjacencies of all shapes.
    pub(crate) fn clear(&mut self) {
        self.vertices.clear();
        self.normals.clear();
        self.adjacency.clear();
        self.edge_lanes.clear();
    }

    /// Returns a shape with slices of its vertices and normals.
    #[inline]
    pub fn shape_ref(&self, shape: Shape) -> ShapeRef<'_> {
        let range = shape.vertex_range();
        ShapeRef { shape, vertices: &self.vertices[range.clone()], normals: &self.normals[range], pool: self }
    }

    /// Returns the smallest distance from the centre of a shape's AABB to the shape's surface, in length units, >= 0.
    pub fn min_extent(&self, shape: Shape) -> f32 {
        let ShapeRef { vertices: points, normals, .. } = self.shape_ref(shape);
        let distances =
            points.iter().zip(normals).map(|(&point, &normal)| dot(normal, difference(point, shape.centre)));
        let min_distance = distances.reduce(|a, b| if b < a { b } else { a }).unwrap_or(0.0);
        shape.radius + if min_distance > 0.0 { min_distance } else { 0.0 }
    }

    /// Adds a convex piece of a geom, and returns its shape in the frame of the geom's body.
    pub fn add(&mut self, piece: &Piece, (offset, rotation): (Vector, f32)) -> Shape {
        let (sine, cosine) = scalar::sin_cos(rotation);
        let to_body = |v: Vector| rotate([cosine, sine], sum(offset, v));
        match piece {
            &Piece::Circle { centre, radius } => {
                let centre = to_body(centre);
                Shape { radius, centre, max_extent: length(centre) + radius, ..Shape::default() }
            }
            &Piece::Capsule { ends, radius } => self.add_capsule(ends.map(to_body), radius),
            Piece::Part { corners, seams } => {
                let corners: Vec<Vector> = corners.iter().map(|&corner| to_body(corner)).collect();
                let turned = seams.iter().map(|seam| seam.rotated([cosine, sine]));
                self.add_piece(corners, turned)
            }
            Piece::Edge { ends, normal, seam, back } => {
                let normal = rotate([cosine, sine], *normal);
                let seams = [*seam, back.unwrap_or(Seam::INTERNAL)];
                self.add_edge(ends.map(to_body), normal, seams.map(|seam| seam.rotated([cosine, sine])))
            }
            Piece::Rounded { corners, radius } => {
                let core = simplified(corners.iter().map(|&corner| to_body(corner)).collect());
                self.add_rounded(core, *radius)
            }
            Piece::Polygon(corners) => {
                // Vertices of a small polygon far from the origin may coincide after rounding.
                self.add_polygon(simplified(corners.iter().map(|&corner| to_body(corner)).collect()))
            }
        }
    }

    /// Adds a box about the origin of its body and returns its shape. `half`: half extents in length units. A half extent of 0,
    /// which rounding may give, is replaced by the smallest normal `f32`, so that each edge has a normal.
    pub(crate) fn add_box(&mut self, half: Vector) -> Shape {
        let [x, y] = half.map(|half| if half > 0.0 { half } else { f32::MIN_POSITIVE });
        self.add_polygon(vec![[-x, -y], [x, -y], [x, y], [-x, y]])
    }

    /// Returns the shape of a disc about the origin of its body. `radius` is in length units.
    pub(crate) fn add_disc(&mut self, radius: f32) -> Shape {
        Shape { radius, max_extent: radius, ..Shape::default() }
    }

    /// Adds a box and returns its shape, given centre and half extents in the frame of its body, in length units. Vertices of a
    /// small box far from the origin may coincide after rounding; then they are merged.
    pub fn add_box_at(&mut self, [x, y]: Vector, [half_x, half_y]: Vector) -> Shape {
        let corners = [[-half_x, -half_y], [half_x, -half_y], [half_x, half_y], [-half_x, half_y]];
        self.add_polygon(simplified(corners.map(|[dx, dy]| [x + dx, y + dy]).to_vec()))
    }

    /// Adds a convex polygon and returns its shape. `corners` are in the frame of its body, in length units.
    pub(crate) fn add_hull(&mut self, corners: &[Vector]) -> Shape {
        self.add_polygon(corners.to_vec())
    }

    /// Adds a capsule and returns its shape: a circle if the ends coincide after rounding. `ends` and `radius` are in length
    /// units.
    fn add_capsule(&mut self, ends: [Vector; 2], radius: f32) -> Shape {
        if length(difference(ends[0], ends[1])) == 0.0 {
            let centre = ends[0];
            return Shape { radius, centre, max_extent: length(centre) + radius, ..Shape::default() };
        }
        let core = self.add_polygon(ends.to_vec());
        Shape { kind: ShapeKind::Capsule, radius, max_extent: core.max_extent + radius, ..core }
    }

    /// Adds a convex polygon with a radius and returns its shape: a capsule or circle if corners of the core coincide after rounding.
    /// `core` and `radius` are in length units.
    fn add_rounded(&mut self, core: Vec<Vector>, radius: f32) -> Shape {
        if let [one, other] = core[..] {
            return self.add_capsule([one, other], radius);
        }
        let core = self.add_polygon(core);
        let kind = if core.vertex_count > 0 { ShapeKind::RoundedPolygon } else { ShapeKind::Circle };
        Shape { kind, radius, max_extent: core.max_extent + radius, is_box: false, ..core }
    }

    /// Adds a convex piece of a concave outline and returns its shape: a linked polygon, or a plain polygon if vertices
    /// coincide after rounding. `seams`: the adjacent edges of the outline for each edge.
    fn add_piece(&mut self, corners: Vec<Vector>, seams: impl Iterator<Item = Seam>) -> Shape {
        let count = corners.len();
        let has_length = |at: usize| length(difference(corners[(at + 1) % count], corners[at])) > 0.0;
        if !(0..count).all(has_length) {
            return self.add_polygon(simplified(corners));
        }
        let polygon = self.add_polygon(corners);
        self.link_polygon(polygon, seams)
    }

    /// Adds an edge of a chain and returns its shape. `normal`, the unit normal of the colliding side, is given because it was
    /// computed before the ends were rounded. `seams`: adjacencies in both directions of the edge.
    fn add_edge(&mut self, ends: [Vector; 2], normal: Vector, seams: [Seam; 2]) -> Shape {
        let edge = self.add_polygon(ends.to_vec());
        let normals = &mut self.normals[edge.vertex_start as usize..];
        (normals[0], normals[1]) = (normal, [-normal[0], -normal[1]]);
        self.edge_lanes.truncate(edge.lane_start.position());
        self.add_edge_lanes(edge.vertex_range().start);
        self.link_polygon(edge, seams.into_iter())
    }

    /// Adds the edges of the last shape to the SIMD lanes. `start`: index of its first vertex.
    fn add_edge_lanes(&mut self, start: usize) {
        let (vertices, normals) = (&self.vertices[start..], &self.normals[start..]);
        let firsts = (0..vertices.len()).step_by(4);
        self.edge_lanes.extend(firsts.map(|first| EdgeLanes::new(first, vertices, normals)));
    }

    /// Adds the edge adjacencies of a polygon to the pool, and returns its shape as a linked polygon.
    fn link_polygon(&mut self, shape: Shape, seams: impl Iterator<Item = Seam>) -> Shape {
        let start = self.adjacency.len() as u32;
        self.adjacency.extend(seams);
        Shape { kind: ShapeKind::LinkedPolygon, adjacency_start: start, ..shape }
    }

    /// Adds a convex polygon with its normals and returns its shape. A single vertex becomes a circle of radius 0. `corners`
    /// are in the frame of the body, in length units.
    fn add_polygon(&mut self, corners: Vec<Vector>) -> Shape {
        if let [centre] = corners[..] {
            return Shape { centre, max_extent: length(centre), ..Shape::default() };
        }
        let start = self.vertices.len();
        self.vertices.extend(corners);
        let points = &self.vertices[start..];
        let normal = |i: usize| edge_normal(points[i], points[(i + 1) % points.len()]);
        self.normals.extend((0..points.len()).map(normal));
        let lane_start = LaneIndex::new(self.edge_lanes.len());
        self.add_edge_lanes(start);
        let points = &self.vertices[start..];
        let bound = |axis: usize, better: fn(f32, f32) -> bool| {
            points.iter().map(|p| p[axis]).reduce(|a, b| if better(a, b) { a } else { b }).unwrap_or(0.0)
        };
        let (low, high) =
            ([0, 1].map(|axis| bound(axis, |a, b| a < b)), [0, 1].map(|axis| bound(axis, |a, b| a > b)));
        let centre = [0, 1].map(|axis| 0.5 * (low[axis] + high[axis]));
        let half_extents = [0, 1].map(|axis| 0.5 * (high[axis] - low[axis]));
        let max_extent = points.iter().map(|&p| length(p)).fold(0.0, |a, b| if b > a { b } else { a });
        let has_side = |edge: Vector| edge[0] == 0.0 || edge[1] == 0.0;
        let is_box = points.len() == 4
            && centre == [0.0, 0.0]
            && (0..4).all(|i| has_side(difference(points[(i + 1) % 4], points[i])));
        let (family, count) = (ShapeKind::Polygon, points.len() as u32);
        Shape {
            kind: family,
            vertex_start: start as u32,
            adjacency_start: 0,
            lane_start,
            vertex_count: count,
            is_box,
            radius: 0.0,
            centre,
            half_extents,
            max_extent,
        }
    }
}

/// Returns the outward unit normal of an edge. If the squared length of the edge is not a normal `f32`, the normal is computed
/// in `f64`.
fn edge_normal(start: Vector, end: Vector) -> Vector {
    let edge = difference(end, start);
    let squared = dot(edge, edge);
    let length = squared.sqrt();
    if squared.is_normal() {
        [edge[1] / length, -edge[0] / length]
    } else {
        edge_adjacency::normal(start, end)
    }
}

#[cfg(test)]
mod tests {
    use super::{edge_normal, length};

    #[test]
    fn edge_normal_is_unit_for_any_edge_length() {
        let long = [[-4e30, 12.0], [f32::MAX, 1e-6], [1e31, -12.0], [f32::MIN, 0.0], [3.0, 4.0]];
        let short = [[5e-31, -3.0], [-5e-31, -3.0], [1e-44, 1e-20], [1e-44, 0.0], [0.0, 1e-45]];
        let corners: Vec<_> = long.into_iter().chain(short).collect();
        for (at, &start) in corners.iter().enumerate() {
            let normal = edge_normal(start, corners[(at + 1) % corners.len()]);
            assert!((length(normal) - 1.0).abs() < 1e-6, "{start:?}: {normal:?}");
        }
    }
}
