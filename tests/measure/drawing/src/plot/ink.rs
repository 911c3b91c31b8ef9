//! Primitives of pictures: texts, lines with dashes, markers.

use super::Fault;
use super::style::{DARK, Look, Marker};
use plotters::coord::Shift;
use plotters::prelude::{
    Circle, Color, DrawingArea, DrawingBackend, IntoFont, PathElement, Polygon, RGBColor, Rectangle, Text,
};
use plotters::style::FontTransform;
use plotters::style::text_anchor::{HPos, Pos, VPos};

type Done<B> = Result<(), Fault<B>>;
/// A position on the sheet: x right and y down, px.
pub type Place = (i32, i32);

/// Ratio of the size of a font in `plotters` to that in SVG, for the same nominal size.
const FONT_SIZE: f64 = 1.24;

/// Style of a text: size, colour, alignment and direction.
#[derive(Clone, Copy)]
pub struct Words {
    /// Size of the font, px.
    pub size: f64,
    /// Colour of the letters.
    pub color: RGBColor,
    /// Point of the text that lies at its position.
    pub anchor: (HPos, VPos),
    /// Whether the text runs upwards.
    pub upwards: bool,
}

impl Words {
    /// Returns the style of a dark text that begins at its position, with a font of `size` px.
    pub fn new(size: f64) -> Self {
        Words { size, color: DARK, anchor: (HPos::Left, VPos::Center), upwards: false }
    }

    /// Returns this style for a text that is centred at its position.
    pub fn centred(self) -> Self {
        Words { anchor: (HPos::Center, self.anchor.1), ..self }
    }

    /// Returns this style for a text that ends at its position.
    pub fn up_to(self) -> Self {
        Words { anchor: (HPos::Right, self.anchor.1), ..self }
    }

    /// Returns this style in another colour.
    pub fn color(self, color: RGBColor) -> Self {
        Words { color, ..self }
    }

    /// Writes a text in this style at a position.
    ///
    /// # Errors
    ///
    /// An error of the backend.
    pub fn write<B: DrawingBackend>(self, sheet: &DrawingArea<B, Shift>, text: &str, at: Place) -> Done<B> {
        let transform = if self.upwards { FontTransform::Rotate270 } else { FontTransform::None };
        let font = ("sans-serif", self.size * FONT_SIZE).into_font().transform(transform);
        let style = font.color(&self.color).pos(Pos::new(self.anchor.0, self.anchor.1));
        sheet.draw(&Text::new(text.to_owned(), at, style))
    }
}

/// Breaks a text into lines of at most `letters` letters, and returns these.
pub fn wrapped(text: &str, letters: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split(' ').filter(|word| !word.is_empty()) {
        match lines.last_mut() {
            Some(line) if line.chars().count() + word.chars().count() < letters => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

/// Draws a straight line.
///
/// # Errors
///
/// An error of the backend.
pub fn line<B: DrawingBackend>(
    sheet: &DrawingArea<B, Shift>,
    ends: [Place; 2],
    color: RGBColor,
    width: u32,
) -> Done<B> {
    sheet.draw(&PathElement::new(ends, color.stroke_width(width)))
}

/// Draws a filled rectangle without a border.
///
/// # Errors
///
/// An error of the backend.
pub fn area<B: DrawingBackend>(
    sheet: &DrawingArea<B, Shift>,
    corners: [Place; 2],
    color: RGBColor,
) -> Done<B> {
    sheet.draw(&Rectangle::new(corners, color.filled()))
}

/// Draws a line through points. `dashes` has the lengths of dashes and gaps in turn, px; if it is empty the line has no gaps.
///
/// # Errors
///
/// An error of the backend.
pub fn dashed<B: DrawingBackend>(
    sheet: &DrawingArea<B, Shift>,
    places: &[Place],
    dashes: &[f64],
    color: RGBColor,
    width: u32,
) -> Done<B> {
    if dashes.is_empty() {
        return sheet.draw(&PathElement::new(places.to_vec(), color.stroke_width(width)));
    }
    let (mut index, mut left, mut dash) =
        (0, dashes[0], places.first().copied().into_iter().collect::<Vec<_>>());
    for pair in places.windows(2) {
        let [(x0, y0), (x1, y1)] = [pair[0], pair[1]].map(|(x, y)| (f64::from(x), f64::from(y)));
        let length = (x1 - x0).hypot(y1 - y0);
        let mut along = 0.0;
        while length - along > left {
            along += left;
            let part = along / length;
            let end = ((x0 + part * (x1 - x0)).round() as i32, (y0 + part * (y1 - y0)).round() as i32);
            if index % 2 == 0 {
                dash.push(end);
                sheet.draw(&PathElement::new(std::mem::take(&mut dash), color.stroke_width(width)))?;
            } else {
                dash = vec![end];
            }
            index = (index + 1) % dashes.len();
            left = dashes[index];
        }
        left -= length - along;
        if index % 2 == 0 {
            dash.push(pair[1]);
        }
    }
    if dash.len() > 1 {
        sheet.draw(&PathElement::new(dash, color.stroke_width(width)))?;
    }
    Ok(())
}

/// Draws a marker, either filled or with a white inside.
///
/// # Errors
///
/// An error of the backend.
pub fn marker<B: DrawingBackend>(
    sheet: &DrawingArea<B, Shift>,
    (x, y): Place,
    look: &Look,
    radius: i32,
    full: bool,
) -> Done<B> {
    let inside = if full { look.color } else { RGBColor(255, 255, 255) };
    if look.marker == Marker::Circle {
        sheet.draw(&Circle::new((x, y), radius, inside.filled()))?;
        return sheet.draw(&Circle::new((x, y), radius, look.color.stroke_width(1)));
    }
    let mut corners: Vec<Place> = corners(look.marker)
        .map(|(across, down)| {
            let [dx, dy] = [across, down].map(|part| (part * f64::from(radius)).round() as i32);
            (x + dx, y + dy)
        })
        .collect();
    sheet.draw(&Polygon::new(corners.clone(), inside.filled()))?;
    corners.extend_from_within(..1);
    sheet.draw(&PathElement::new(corners, look.color.stroke_width(1)))
}

/// Returns the corners of a marker of radius 1, relative to its centre.
fn corners(marker: Marker) -> impl Iterator<Item = (f64, f64)> {
    // `count`: number of corners. `turn`: angle of the first corner from straight up, in turns. `radius`: distance of the first
    // corner, and of every second one after it, from the centre. `second`: distance of the other corners.
    let (count, turn, radius, second) = match marker {
        Marker::Circle => (12, 0.0, 1.0, 1.0),
        Marker::Square => (4, 0.125, 1.3, 1.3),
        Marker::Up => (3, 0.0, 1.35, 1.35),
        Marker::Down => (3, 0.5, 1.35, 1.35),
        Marker::Diamond => (4, 0.0, 1.4, 1.4),
        Marker::Star => (10, 0.0, 1.6, 0.7),
    };
    (0..count).map(move |index| {
        let angle = std::f64::consts::TAU * (turn + f64::from(index) / f64::from(count));
        let length = if index % 2 == 0 { radius } else { second };
        (length * angle.sin(), -length * angle.cos())
    })
}

/// Draws a cross.
///
/// # Errors
///
/// An error of the backend.
pub fn cross<B: DrawingBackend>(
    sheet: &DrawingArea<B, Shift>,
    (x, y): Place,
    radius: i32,
    color: RGBColor,
) -> Done<B> {
    line(sheet, [(x - radius, y - radius), (x + radius, y + radius)], color, 2)?;
    line(sheet, [(x - radius, y + radius), (x + radius, y - radius)], color, 2)
}
