//! Captions: a built-in font of 8 x 8 px, drawn as scaled squares. No system fonts.

use font8x8::{BASIC_FONTS, LATIN_FONTS, UnicodeFonts};

use crate::{Canvas, Color, Point, Transform};

/// Width and height of a character, and so the distance of characters and of lines, px at scale 1.
pub const CHARACTER_SIZE: u32 = 8;

/// Largest scale of a text (a factor).
const MAX_SCALE: u32 = 256;

/// A text at a place, in the built-in font: 8 x 8 px a character, lines 8 px apart, at scale 1. `\n` begins a new
/// line. ASCII and Latin-1 characters are known; others become `?`. Made with [`Text::new`], other fields as needed:
///
/// ```
/// # use twohalf_render::{Color, SoftwareCanvas, SpriteBatch, Text};
/// let title = Text { scale: [3.0, 3.0], rotation: -0.1, ..Text::centered("GAME OVER", [160.0, 100.0]) };
/// assert_eq!(title.size(), [72.0, 8.0]);
/// let mut batch = SpriteBatch::begin();
/// batch.draw_string(title);
/// batch.end(&mut SoftwareCanvas::new(320, 200)?);
/// # Ok::<(), twohalf_render::RenderError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[doc(alias = "DrawString")]
pub struct Text {
    /// The text itself.
    pub text: String,
    /// Where the `origin` goes on the canvas, px.
    pub position: Point,
    /// Rotation about the origin, radians; positive is clockwise.
    pub rotation: f32,
    /// The point of the text that is put at `position` and about which it turns and scales, px at scale 1 from its
    /// top left corner.
    pub origin: Point,
    /// Factors along x and y, before the rotation.
    pub scale: Point,
    /// Colour of the letters.
    pub color: Color,
    /// Order in the batch, dimensionless: 0 is the front, 1 the back. Values outside are clamped.
    #[doc(alias = "LayerDepth")]
    pub layer_depth: f32,
}

impl Text {
    /// White, its top left corner at `position`, at scale 1, in front.
    pub fn new(text: impl Into<String>, position: impl Into<Point>) -> Self {
        Text {
            text: text.into(),
            position: position.into(),
            rotation: 0.0,
            origin: [0.0, 0.0],
            scale: [1.0, 1.0],
            color: Color::WHITE,
            layer_depth: 0.0,
        }
    }

    /// As [`Text::new`], with the middle of the text at `position`.
    pub fn centered(text: impl Into<String>, position: impl Into<Point>) -> Self {
        let text = Text::new(text, position);
        Text { origin: text.size().map(|side| 0.5 * side), ..text }
    }

    /// Width and height in px at scale 1.
    #[doc(alias = "MeasureString")]
    pub fn size(&self) -> Point {
        text_size(&self.text, 1)
    }

    /// Draws it. With a number that is not finite nothing is drawn.
    pub fn draw(&self, canvas: &mut dyn Canvas) {
        if !self.is_finite() {
            return;
        }
        let to_canvas = Transform::translation([-self.origin[0], -self.origin[1]])
            .then(&Transform::scaling(self.scale))
            .then(&Transform::rotation(self.rotation))
            .then(&Transform::translation(self.position));
        draw_characters(canvas, &self.text, &to_canvas, self.color);
    }

    pub(crate) fn is_finite(&self) -> bool {
        let Text { position, origin, scale, rotation, layer_depth, .. } = self;
        [position, origin, scale].into_iter().flatten().chain([rotation, layer_depth]).all(|n| n.is_finite())
    }
}

/// Writes a text with its upper left corner at `position` (px, rounded to whole ones). Every pixel of the
/// font is a square of `scale` x `scale` px. [`Text`] can be turned and sorted with sprites. A scale of 0 or
/// above 256 draws nothing.
pub fn draw_text(canvas: &mut dyn Canvas, text: &str, position: impl Into<Point>, scale: u32, color: Color) {
    if !(1..=MAX_SCALE).contains(&scale) {
        return;
    }
    let corner = Transform::translation(position.into().map(f32::round));
    draw_characters(canvas, text, &Transform::scaling([scale as f32; 2]).then(&corner), color);
}

fn draw_characters(canvas: &mut dyn Canvas, text: &str, to_canvas: &Transform, color: Color) {
    let advance = CHARACTER_SIZE as f32;
    for (row, line) in text.split('\n').enumerate() {
        for (column, character) in line.chars().enumerate() {
            let corner = Transform::translation([column as f32 * advance, row as f32 * advance]);
            draw_character(canvas, character, &corner.then(to_canvas), color);
        }
    }
}

/// Width and height in px that [`draw_text`] covers.
#[doc(alias = "MeasureString")]
pub fn text_size(text: &str, scale: u32) -> [f32; 2] {
    let columns = text.split('\n').map(|line| line.chars().count()).max().unwrap_or(0);
    let rows = text.split('\n').count();
    let advance = CHARACTER_SIZE as f32 * scale as f32;
    [columns as f32 * advance, rows as f32 * advance]
}

/// Writes a caption (a step, a time) on a picture: white on a translucent dark panel in the upper left
/// corner.
pub fn draw_caption(canvas: &mut dyn Canvas, text: &str) {
    const SCALE: u32 = 2;
    const MARGIN: f32 = 8.0;
    let [width, height] = text_size(text, SCALE);
    let panel = [width + 2.0 * MARGIN, height + 2.0 * MARGIN];
    canvas.fill_rectangle([0.0, 0.0], panel, &Transform::IDENTITY, Color::rgba(16, 20, 28, 150));
    draw_text(canvas, text, [MARGIN, MARGIN], SCALE, Color::WHITE);
}

fn draw_character(canvas: &mut dyn Canvas, character: char, to_canvas: &Transform, color: Color) {
    let glyph = BASIC_FONTS.get(character).or_else(|| LATIN_FONTS.get(character));
    let Some(rows) = glyph.or_else(|| BASIC_FONTS.get('?')) else { return };
    // One polygon for all runs, so that no seams are seen if it is rotated. The outline goes from a common
    // corner to each run and back along edges that enclose no area.
    let mut outline: Vec<Point> = Vec::new();
    for (row, bits) in (0u8..).zip(rows) {
        for (first, length) in runs(bits) {
            let [left, right, top, bottom] = [first, first + length, row, row + 1].map(f32::from);
            outline.extend([[0.0, 0.0], [left, top], [right, top], [right, bottom], [left, bottom]]);
            outline.push([left, top]);
        }
    }
    canvas.fill_polygon(&outline, to_canvas, color);
}

/// First column and length of each run of set bits; the lowest bit is the leftmost pixel.
fn runs(bits: u8) -> impl Iterator<Item = (u8, u8)> {
    let set = move |column: u8| column < 8 && bits >> column & 1 == 1;
    (0..8).filter(move |&column| set(column) && !(column > 0 && set(column - 1))).map(move |first| {
        let length = (first..9).take_while(|&column| set(column)).count();
        (first, length as u8)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_of_bits_are_found_from_the_left() {
        assert_eq!(runs(0b1110_0101).collect::<Vec<_>>(), [(0, 1), (2, 1), (5, 3)]);
        assert_eq!(runs(0xff).collect::<Vec<_>>(), [(0, 8)]);
        assert_eq!(runs(0).count(), 0);
    }

    #[test]
    fn the_longest_line_and_the_number_of_lines_give_the_size() {
        assert_eq!(text_size("ab\nabcd", 2), [64.0, 32.0]);
    }
}
