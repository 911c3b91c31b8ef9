//! A list of vertices: indices, edges, normals, transformations (behaviour chapter 05, sections 1.1, 1.4
//! and 1.5).
//!
//! Coordinates are in length units, screen y down. *Engine winding* is the order of vertices with negative shoelace
//! area, counter-clockwise on such a screen: with it `(-edge.y, edge.x)` points outward.

use std::fmt;
use std::ops::{Deref, DerefMut};

use serde::de::Visitor;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::error::{Error, Result};
use crate::math::{Vector2, matrix, vector2};

/// Maximum number of vertices that a creator or a subdivision makes; f32 counts every index below it exactly.
pub const MAX_VERTICES: usize = 1 << 24;

/// A list of vertices, mostly a polygon whose last vertex is joined to the first.
///
/// It derefs to `Vec<Vector2>`, with all list operations. Vertices are not checked when they are inserted: the
/// arithmetic uses non-finite ones as they are.
///
/// ```
/// use farseer_core::math::Vector2;
/// use farseer_core::shape::Vertices;
/// let mut box_outline = Vertices::create_simple_rectangle(4.0, 2.0)?;
/// assert_eq!(box_outline.get_area(), 8.0);
/// box_outline.translate(Vector2::new(1.0, 0.0));
/// assert_eq!(box_outline.get_centroid(), Vector2::new(1.0, 0.0));
/// # Ok::<(), farseer_core::Error>(())
/// ```
#[doc(alias("FarseerGames.FarseerPhysics.Collisions.Vertices", "Vertices.ToString"))]
#[derive(Debug, Default, PartialEq)]
pub struct Vertices(Vec<Vector2>);

/// A list of points in text formats; in binary ones the bytes of all coordinates, least byte first.
impl Serialize for Vertices {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        if serializer.is_human_readable() {
            return self.0.serialize(serializer);
        }
        let coordinates = self.0.iter().flat_map(|point| [point.x, point.y]);
        serializer.serialize_bytes(&coordinates.flat_map(f32::to_le_bytes).collect::<Vec<u8>>())
    }
}

impl<'de> Deserialize<'de> for Vertices {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> std::result::Result<Self, D::Error> {
        if deserializer.is_human_readable() {
            return Vec::deserialize(deserializer).map(Vertices);
        }
        deserializer.deserialize_bytes(PointsVisitor)
    }
}

/// Reads points from the bytes of their coordinates.
struct PointsVisitor;

impl Visitor<'_> for PointsVisitor {
    type Value = Vertices;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("the coordinates of points")
    }

    fn visit_bytes<E: serde::de::Error>(self, bytes: &[u8]) -> std::result::Result<Vertices, E> {
        let (coordinates, []) = bytes.as_chunks::<4>() else {
            return Err(E::custom("a coordinate is cut short"));
        };
        let (points, []) = coordinates.as_chunks::<2>() else {
            return Err(E::custom("a point has one coordinate"));
        };
        Ok(points.iter().map(|&[x, y]| Vector2::new(f32::from_le_bytes(x), f32::from_le_bytes(y))).collect())
    }
}

/// `clone_from` keeps the capacity of the list.
impl Clone for Vertices {
    fn clone(&self) -> Self {
        Vertices(self.0.clone())
    }

    fn clone_from(&mut self, source: &Self) {
        self.0.clone_from(&source.0);
    }
}

impl Deref for Vertices {
    type Target = Vec<Vector2>;

    #[inline]
    fn deref(&self) -> &Vec<Vector2> {
        &self.0
    }
}

impl DerefMut for Vertices {
    #[inline]
    fn deref_mut(&mut self) -> &mut Vec<Vector2> {
        &mut self.0
    }
}

impl From<Vec<Vector2>> for Vertices {
    fn from(vertices: Vec<Vector2>) -> Self {
        Vertices(vertices)
    }
}

impl From<&[Vector2]> for Vertices {
    fn from(vertices: &[Vector2]) -> Self {
        Vertices(vertices.to_vec())
    }
}

impl From<Vertices> for Vec<Vector2> {
    fn from(vertices: Vertices) -> Self {
        vertices.0
    }
}

impl FromIterator<Vector2> for Vertices {
    fn from_iter<I: IntoIterator<Item = Vector2>>(iter: I) -> Self {
        Vertices(iter.into_iter().collect())
    }
}

impl Extend<Vector2> for Vertices {
    fn extend<I: IntoIterator<Item = Vector2>>(&mut self, iter: I) {
        self.0.extend(iter);
    }
}

impl IntoIterator for Vertices {
    type Item = Vector2;
    type IntoIter = std::vec::IntoIter<Vector2>;

    fn into_iter(self) -> Self::IntoIter {
        self.0.into_iter()
    }
}

impl<'a> IntoIterator for &'a Vertices {
    type Item = &'a Vector2;
    type IntoIter = std::slice::Iter<'a, Vector2>;

    fn into_iter(self) -> Self::IntoIter {
        self.0.iter()
    }
}

/// The vertices as `{X:1 Y:2.5}`, separated by one space (behaviour chapter 05, section 1.9).
impl std::fmt::Display for Vertices {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        for (i, v) in self.iter().enumerate() {
            let separator = if i == 0 { "" } else { " " };
            write!(f, "{separator}{}", vector2::to_text(*v))?;
        }
        Ok(())
    }
}

impl Vertices {
    /// The empty list.
    pub fn new() -> Self {
        Vertices(Vec::new())
    }

    /// An empty list with room for `capacity` vertices.
    pub fn with_capacity(capacity: usize) -> Self {
        Vertices(Vec::with_capacity(capacity))
    }

    /// A copy of the vertices.
    #[doc(alias = "GetVerticesArray")]
    pub fn get_vertices_array(&self) -> Vec<Vector2> {
        self.0.clone()
    }

    /// The index after `index`, 0 after the last one. The range is not checked.
    #[doc(alias = "NextIndex")]
    #[inline]
    pub fn next_index(&self, index: usize) -> usize {
        if index + 1 == self.len() { 0 } else { index + 1 }
    }

    /// The index before `index`, the last one before 0. The range is not checked; an empty list gives 0.
    #[doc(alias = "PreviousIndex")]
    #[inline]
    pub fn previous_index(&self, index: usize) -> usize {
        if index == 0 { self.len().saturating_sub(1) } else { index - 1 }
    }

    /// The edge from vertex `index` to the next one.
    ///
    /// # Panics
    /// When `index` is out of range.
    #[doc(alias = "GetEdge")]
    #[inline]
    pub fn get_edge(&self, index: usize) -> Vector2 {
        self[self.next_index(index)] - self[index]
    }

    /// The middle of edge `index`: its start plus half of it.
    ///
    /// # Panics
    /// When `index` is out of range.
    #[doc(alias = "GetEdgeMidPoint")]
    pub fn get_edge_mid_point(&self, index: usize) -> Vector2 {
        self[index] + self.get_edge(index) * 0.5
    }

    /// The unit normal of edge `index`, outward in engine winding. An edge of length 0 gives NaN.
    ///
    /// # Panics
    /// When `index` is out of range.
    #[doc(alias = "GetEdgeNormal")]
    #[inline]
    pub fn get_edge_normal(&self, index: usize) -> Vector2 {
        let edge = self.get_edge(index);
        vector2::normalize(Vector2::new(-edge.y, edge.x))
    }

    /// The normal of vertex `index`: the normalised sum of the normals of the two edges that meet there.
    /// Between opposite edge normals it is NaN.
    ///
    /// # Panics
    /// When `index` is out of range.
    #[doc(alias = "GetVertexNormal")]
    #[inline]
    pub fn get_vertex_normal(&self, index: usize) -> Vector2 {
        let own = self.get_edge_normal(index);
        let previous = self.get_edge_normal(self.previous_index(index));
        vector2::normalize(own + previous)
    }

    /// Length of the shortest edge; `f32::MAX` for an empty list.
    #[doc(alias = "GetShortestEdge")]
    pub fn get_shortest_edge(&self) -> f32 {
        let mut shortest = f32::MAX;
        for i in 0..self.len() {
            let length = vector2::length(self.get_edge(i));
            if length < shortest {
                shortest = length;
            }
        }
        shortest
    }

    /// The range of the vertices' dot products with `axis`, which is not normalised: `(min, max)`.
    ///
    /// # Errors
    /// When the list is empty.
    #[doc(alias = "ProjectToAxis")]
    pub fn project_to_axis(&self, axis: Vector2) -> Result<(f32, f32)> {
        vector2::project_to_axis(self, axis)
            .ok_or_else(|| Error::invalid("self", self, "a list of one vertex or more"))
    }

    /// Moves all vertices by `vector`.
    #[doc(alias = "Translate")]
    pub fn translate(&mut self, vector: Vector2) {
        for v in self.iter_mut() {
            *v += vector;
        }
    }

    /// Multiplies all vertices by `value`, component by component.
    #[doc(alias = "Scale")]
    pub fn scale(&mut self, value: Vector2) {
        for v in self.iter_mut() {
            v.component_mul_assign(&value);
        }
    }

    /// Turns all vertices about the origin by `angle` radians.
    #[doc(alias = "Rotate")]
    pub fn rotate(&mut self, angle: f32) {
        let rotation = matrix::create_rotation_z(angle);
        for v in self.iter_mut() {
            *v = vector2::transform(*v, &rotation);
        }
    }

    /// Whether all corners turn to the same side. Corners between collinear vertices count as turning in the direction
    /// of positive area, so that an outline in engine winding with such corners is reported as not convex; the
    /// 16-vertex rectangle is an example.
    #[doc(alias = "IsConvex")]
    pub fn is_convex(&self) -> bool {
        let turn = |i: usize| {
            let (here, before, after) = (self[i], self[self.previous_index(i)], self[self.next_index(i)]);
            let incoming = here - before;
            let outgoing = after - here;
            incoming.x * outgoing.y - outgoing.x * incoming.y >= 0.0
        };
        (1..self.len()).all(|i| turn(i) == turn(0))
    }
}
