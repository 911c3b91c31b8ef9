//! Small tools for single points (behaviour chapter 05, section 1.9).

use super::Vertices;
use crate::math::{Vector2, scalar, vector2};

impl Vertices {
    /// The middle of two points.
    #[doc(alias = "FindMidpoint")]
    pub fn find_midpoint(first: Vector2, second: Vector2) -> Vector2 {
        let middle = |a: f32, b: f32| {
            let half = if a < b { ((a - b) * 0.5).abs() } else { (b - a) * 0.5 };
            a + half
        };
        Vector2::new(middle(first.x, second.x), middle(first.y, second.y))
    }

    /// The unit normal of the edge between two points; opposite to that of [`Vertices::get_edge_normal`], inward in
    /// engine winding. NaN for equal points.
    #[doc(alias = "FindEdgeNormal")]
    pub fn find_edge_normal(first: Vector2, second: Vector2) -> Vector2 {
        let edge = first - second;
        vector2::normalize(Vector2::new(-edge.y, edge.x))
    }

    /// The sum of the normals of the edges from `first` to `second` and from there to `c`, **not**
    /// normalised.
    #[doc(alias = "FindVertexNormal")]
    pub fn find_vertex_normal(first: Vector2, second: Vector2, c: Vector2) -> Vector2 {
        Vertices::find_edge_normal(first, second) + Vertices::find_edge_normal(second, c)
    }

    /// The angle of a vector in radians, -pi/2 to pi/2 from the y axis. Opposite vectors have the same angle; a vector
    /// along an axis, or with a NaN, has 0.
    #[doc(alias = "FindNormalAngle")]
    pub fn find_normal_angle(n: Vector2) -> f32 {
        let off_axis = n.y.abs() > 0.0;
        if n.x > 0.0 && off_axis {
            scalar::atan(n.x / -n.y)
        } else if n.x < 0.0 && off_axis {
            scalar::atan(-n.x / n.y)
        } else {
            0.0
        }
    }
}
