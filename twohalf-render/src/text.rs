//! Captions: a built-in font of 8 x 8 px, drawn as scaled squares. No system fonts.

use font8x8::{BASIC_FONTS, LATIN_FONTS, UnicodeFonts};

use crate::{Canvas, Color, Point, Transform};

/// Width and height of a character, and so the distance of characters and lines, in px at scale 1.
pub const CHARACTER_SIZE: u32 = 8;

/// Largest scale a text is drawn at.
const MAX_SCALE: u32 = 256;

/// Writes a text with its upper left corner at `position` (px, rounded to whole ones), every pixel of the
/// font as a square of `scale` x `scale` px. `\n` begins a new line. ASCII and Latin-1 characters are known;
/// others become `?`. A scale of 0 or above 256 draws nothing.
pub fn draw_text(canvas: &mut dyn Canvas, text: &str, position: impl Into<Point>, scale: u32, color: Color) {
    if !(1..=MAX_SCALE).contains(&scale) {
        return;
    }
    let [left, top] = position.into().map(f32::round);
    let advance = (CHARACTER_SIZE * scale) as f32;
    for (row, line) in text.split('\n').enumerate() {
        for (column, character) in line.chars().enumerate() {
            let corner = [left + column as f32 * advance, top + row as f32 * advance];
            draw_character(canvas, character, corner, scale as f32, color);
        }
    }
}

/// Width and height in px that [`draw_text`] covers.
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

fn draw_character(canvas: &mut dyn Canvas, character: char, [x, y]: Point, scale: f32, color: Color) {
    let glyph = BASIC_FONTS.get(character).or_else(|| LATIN_FONTS.get(character));
    let Some(rows) = glyph.or_else(|| BASIC_FONTS.get('?')) else { return };
    for (row, bits) in (0u8..).zip(rows) {
        for (first, length) in runs(bits) {
            let corner = [x + f32::from(first) * scale, y + f32::from(row) * scale];
            let size = [f32::from(length) * scale, scale];
            canvas.fill_rectangle(corner, size, &Transform::IDENTITY, color);
        }
    }
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
