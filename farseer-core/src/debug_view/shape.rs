//! Shapes that the debug view passes to a renderer.

use crate::math::Vector2;

/// A shape to draw over the earlier ones. Coordinates and sizes are in length units of the world. Colours are red,
/// green, blue and straight alpha, 0 to 255.
#[derive(Debug, Clone, PartialEq)]
pub enum DebugShape {
    /// A line between two points.
    Line {
        /// One end.
        start: Vector2,
        /// The other end.
        end: Vector2,
        /// Width of the line, in length units.
        thickness: f32,
        /// Its colour.
        color: [u8; 4],
    },
    /// A filled circle.
    Circle {
        /// Its centre.
        center: Vector2,
        /// Its radius, in length units.
        radius: f32,
        /// Its colour.
        color: [u8; 4],
    },
    /// A filled rectangle along the axes.
    Rectangle {
        /// The corner with the smallest x and y: on the screen the upper left one.
        min: Vector2,
        /// Width and height.
        size: Vector2,
        /// Its colour.
        color: [u8; 4],
    },
    /// One line of text; the original's font is monospaced, bold and of 10 points.
    Text {
        /// The upper left corner.
        position: Vector2,
        /// The text: ASCII.
        text: String,
        /// The colour of the letters.
        color: [u8; 4],
    },
}
