//! Looks of the lines: each method has a marker, dashes and a colour of its own, any one of which would do.

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

/// How a line looks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Look {
    /// The markers.
    pub marker: Marker,
    /// Lengths in px of dashes and gaps by turns; empty for a line without gaps.
    pub dashes: &'static [f64],
    /// The colour, one that people tell apart who see colours differently.
    pub color: RGBColor,
}

/// Text and axes.
pub const DARK: RGBColor = RGBColor(40, 40, 40);
/// Lines of the grid.
pub const PALE: RGBColor = RGBColor(225, 225, 225);
/// What is said in small print.
pub const GREY: RGBColor = RGBColor(110, 110, 110);

/// The colours of Okabe and Ito, the yellow one left out, which is too pale for lines.
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

/// The look of the method with a place in the list of all. From the ninth on they repeat.
pub fn look_of(place: usize) -> Look {
    LOOKS[place % LOOKS.len()]
}
