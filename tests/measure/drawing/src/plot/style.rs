//! Styles of lines: each method has a marker, dashes and a colour of its own. Each of these alone tells methods apart.

use plotters::style::RGBColor;

/// Shape of a marker.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Marker {
    /// A disc.
    Circle,
    /// A square.
    Square,
    /// A triangle, point up.
    Up,
    /// A triangle, point down.
    Down,
    /// A square on its corner.
    Diamond,
    /// A star of five points.
    Star,
}

/// Style of a method's line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Look {
    /// Shape of the line's markers.
    pub marker: Marker,
    /// Lengths of dashes and gaps in turn, px. Empty for a line without gaps.
    pub dashes: &'static [f64],
    /// Colour of line and markers. People with colour blindness can tell the colours apart.
    pub color: RGBColor,
}

/// Colour of text and axes.
pub const DARK: RGBColor = RGBColor(40, 40, 40);
/// Colour of grid lines.
pub const PALE: RGBColor = RGBColor(225, 225, 225);
/// Colour of small print.
pub const GREY: RGBColor = RGBColor(110, 110, 110);

/// Styles of the methods, with colours of Okabe and Ito. Their yellow is left out, because it is too pale for lines.
const LOOKS: [Look; 8] = [
    look(Marker::Circle, &[], RGBColor(0, 114, 178)),
    look(Marker::Square, &[7.0, 3.0], RGBColor(213, 94, 0)),
    look(Marker::Up, &[2.0, 3.0], RGBColor(86, 180, 233)),
    look(Marker::Diamond, &[10.0, 3.0, 2.0, 3.0], RGBColor(204, 121, 167)),
    look(Marker::Down, &[12.0, 4.0], RGBColor(0, 158, 115)),
    look(Marker::Star, &[5.0, 2.0, 2.0, 2.0], RGBColor(0, 0, 0)),
    look(Marker::Circle, &[4.0, 4.0], RGBColor(230, 159, 0)),
    look(Marker::Square, &[1.0, 2.0], RGBColor(120, 94, 240)),
];

const fn look(marker: Marker, dashes: &'static [f64], color: RGBColor) -> Look {
    Look { marker, dashes, color }
}

/// Returns the style of the method with index `place` in the list of all methods. Styles repeat from the ninth method on.
pub fn look_of(place: usize) -> Look {
    LOOKS[place % LOOKS.len()]
}
