//! Edges and their intersections (behaviour chapter 15, section 15.7). Points are in length units.

use std::cmp::Ordering;

use crate::math::Vector2;

/// A straight edge of an outline.
#[doc(alias = "FarseerGames.FarseerPhysics.Collisions.Edge")]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Edge {
    /// Start of the edge.
    #[doc(alias = "Edge.EdgeStart")]
    pub edge_start: Vector2,
    /// End of the edge.
    #[doc(alias = "Edge.EdgeEnd")]
    pub edge_end: Vector2,
}

impl Edge {
    /// The edge between two points.
    pub fn new(edge_start: Vector2, edge_end: Vector2) -> Self {
        Edge { edge_start, edge_end }
    }
}

/// Two edges of different outlines that cross.
#[doc(alias = "FarseerGames.FarseerPhysics.Collisions.EdgeIntersectInfo")]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EdgeIntersectInfo {
    /// The edge of the first outline.
    #[doc(alias = "EdgeIntersectInfo.EdgeOne")]
    pub edge_one: Edge,
    /// The edge of the second outline.
    #[doc(alias = "EdgeIntersectInfo.EdgeTwo")]
    pub edge_two: Edge,
    /// The point where they cross.
    #[doc(alias = "EdgeIntersectInfo.IntersectionPoint")]
    pub intersection_point: Vector2,
}

impl EdgeIntersectInfo {
    /// Two edges and the point where they cross.
    pub fn new(edge_one: Edge, edge_two: Edge, intersection_point: Vector2) -> Self {
        EdgeIntersectInfo { edge_one, edge_two, intersection_point }
    }
}

/// Coordinate by which crossings with a line are sorted.
#[doc(alias = "FarseerGames.FarseerPhysics.Collisions.EdgeAlignment")]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum EdgeAlignment {
    /// By x.
    #[doc(alias = "EdgeAlignment.Vertical")]
    Vertical = 0,
    /// By y. Outlines from textures never need it.
    #[doc(alias = "EdgeAlignment.Horizontal")]
    Horizontal = 1,
}

/// An edge of an outline that crosses a row of a texture.
#[doc(alias = "FarseerGames.FarseerPhysics.Collisions.CrossingEdgeInfo")]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CrossingEdgeInfo {
    /// One end of the edge.
    #[doc(alias = "CrossingEdgeInfo.EdgeVertex1")]
    pub edge_vertex1: Vector2,
    /// The other end.
    #[doc(alias = "CrossingEdgeInfo.EdgeVertex2")]
    pub edge_vertex2: Vector2,
    /// The point where the edge crosses the row.
    #[doc(alias = "CrossingEdgeInfo.CrossingPoint")]
    pub crossing_point: Vector2,
    /// Coordinate that [`CrossingEdgeInfo::compare_to`] compares.
    #[doc(alias = "CrossingEdgeInfo.CheckLineAlignment")]
    pub check_line_alignment: EdgeAlignment,
}

impl CrossingEdgeInfo {
    /// An edge and the point where it crosses the row.
    pub fn new(
        edge_vertex1: Vector2,
        edge_vertex2: Vector2,
        crossing_point: Vector2,
        check_line_alignment: EdgeAlignment,
    ) -> Self {
        CrossingEdgeInfo { edge_vertex1, edge_vertex2, crossing_point, check_line_alignment }
    }

    /// Compares crossings by the coordinate that this one's alignment names. NaN is equal to every number.
    #[doc(alias = "CompareTo")]
    pub fn compare_to(&self, other: &CrossingEdgeInfo) -> Ordering {
        let (mine, others) = match self.check_line_alignment {
            EdgeAlignment::Vertical => (self.crossing_point.x, other.crossing_point.x),
            EdgeAlignment::Horizontal => (self.crossing_point.y, other.crossing_point.y),
        };
        mine.partial_cmp(&others).unwrap_or(Ordering::Equal)
    }
}
