//! Outlines: lists of vertices and the methods to make them.

use super::reader::{keys, tagged};
use farseer_core::math::Vector2;

/// A list of vertices, made afresh wherever it is used.
#[derive(Debug, Clone, PartialEq)]
pub struct Outline {
    /// How the vertices are made.
    pub form: OutlineForm,
    /// Longest edge in length units; longer ones are subdivided.
    pub subdivide: Option<f32>,
}

keys!(Outline { form [flat], subdivide });

/// The creators of vertex lists. Lengths are in length units.
#[derive(Debug, Clone, PartialEq)]
pub enum OutlineForm {
    /// A rectangle with subdivided edges.
    Rectangle {
        /// Extent along x in length units.
        width: f32,
        /// Extent along y in length units.
        height: f32,
    },
    /// A rectangle of four vertices.
    SimpleRectangle {
        /// Extent along x in length units.
        width: f32,
        /// Extent along y in length units.
        height: f32,
    },
    /// A regular polygon.
    Circle {
        /// Distance of the vertices from the centre in length units.
        radius: f32,
        /// Number of edges.
        edges: i32,
    },
    /// An ellipse with vertices at equal angles.
    Ellipse {
        /// Half extent along x in length units.
        x_radius: f32,
        /// Half extent along y in length units.
        y_radius: f32,
        /// Number of edges.
        edges: i32,
    },
    /// A gear.
    Gear {
        /// Radius between the teeth in length units.
        radius: f32,
        /// Number of teeth.
        teeth: i32,
        /// Share of a tooth's width that its tip has, in percent.
        tip_percentage: f32,
        /// Height of a tooth in length units.
        tooth_height: f32,
    },
    /// Two half circles with straight sides.
    Capsule {
        /// Complete height in length units.
        height: f32,
        /// Radius at the top in length units.
        top_radius: f32,
        /// Number of edges of the top half circle.
        top_edges: i32,
        /// Radius at the bottom in length units.
        bottom_radius: f32,
        /// Number of edges of the bottom half circle.
        bottom_edges: i32,
    },
    /// The vertices themselves.
    Points {
        /// The vertices in order.
        points: Vec<Vector2>,
    },
}

tagged!(OutlineForm, "type" {
    "rectangle" => Rectangle { width, height },
    "simple_rectangle" => SimpleRectangle { width, height },
    "circle" => Circle { radius, edges },
    "ellipse" => Ellipse { x_radius, y_radius, edges },
    "gear" => Gear { radius, teeth, tip_percentage, tooth_height },
    "capsule" => Capsule { height, top_radius, top_edges, bottom_radius, bottom_edges },
    "points" => Points { points },
});
