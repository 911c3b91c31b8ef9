//! Pictures on the graphics card: small ones lie side by side in one texture, so that they are drawn at once.

use std::collections::HashMap;

use macroquad::prelude as quad;
use twohalf_render::{Point, Texture2D};

/// Width and height of the texture with the small pictures, px.
const SIDE: u16 = 1024;
/// Largest side of a small picture, px.
const SMALL: u32 = 200;
/// Width in px of the border around each picture, which is free or has the colours of the picture's edge.
const MARGIN: u16 = 1;
/// Number of frames for which a large picture that is not drawn is kept.
const KEPT: u32 = 600;

/// Location of a picture: its texture, and the rectangle in it, from 0 to 1.
#[derive(Debug, Clone)]
pub(super) struct Face {
    pub(super) page: quad::Texture2D,
    corner: Point,
    size: Point,
}

impl Face {
    /// The point in the texture of a point in the picture, from 0 to 1.
    pub(super) fn at(&self, [x, y]: Point) -> Point {
        [self.corner[0] + x * self.size[0], self.corner[1] + y * self.size[1]]
    }
}

/// A picture on the graphics card, and the one it was made of: as long as that is here, no other has its address.
struct Uploaded {
    face: Face,
    _pixels: Texture2D,
    last_drawn: u32,
    is_small: bool,
}

/// All pictures.
pub(super) struct Atlas {
    page: quad::Texture2D,
    uploaded: HashMap<usize, Uploaded>,
    /// Position in px of the next small picture, and the height of its row.
    next: [u16; 2],
    row: u16,
    frame: u32,
}

impl Atlas {
    /// An atlas with a white spot alone, for shapes without a picture.
    pub(super) fn new() -> Self {
        let page =
            quad::Texture2D::from_rgba8(SIDE, SIDE, &vec![0; usize::from(SIDE) * usize::from(SIDE) * 4]);
        page.set_filter(quad::FilterMode::Linear);
        let mut atlas = Atlas { page, uploaded: HashMap::new(), next: [0; 2], row: 0, frame: 0 };
        atlas.clear();
        atlas
    }

    /// Forgets the small pictures.
    fn clear(&mut self) {
        self.uploaded.retain(|_, uploaded| !uploaded.is_small);
        let white = quad::Image { bytes: vec![255; 4 * 16], width: 4, height: 4 };
        self.page.update_part(&white, 0, 0, 4, 4);
        (self.next, self.row) = ([4 + MARGIN, 0], 4);
    }

    /// Another frame: large pictures that were not drawn for long are forgotten.
    pub(super) fn begin_frame(&mut self) {
        self.frame = self.frame.wrapping_add(1);
        let frame = self.frame;
        self.uploaded
            .retain(|_, uploaded| uploaded.is_small || frame.wrapping_sub(uploaded.last_drawn) < KEPT);
    }

    /// Plain white, from the middle of the spot.
    pub(super) fn white(&self) -> Face {
        Face { page: self.page.clone(), corner: [2.0 / f32::from(SIDE); 2], size: [0.0; 2] }
    }

    /// A picture; `None` if there is no space until [`start_again`](Self::start_again).
    pub(super) fn face(&mut self, texture: &Texture2D) -> Option<Face> {
        let key = texture.rgba8().as_ptr() as usize;
        if let Some(uploaded) = self.uploaded.get_mut(&key) {
            uploaded.last_drawn = self.frame;
            return Some(uploaded.face.clone());
        }
        let is_small = texture.width().max(texture.height()) <= SMALL;
        let face = if is_small { self.place(texture)? } else { alone(texture) };
        let uploaded =
            Uploaded { face: face.clone(), _pixels: texture.clone(), last_drawn: self.frame, is_small };
        self.uploaded.insert(key, uploaded);
        Some(face)
    }

    /// Frees the space of the small pictures; drawings with them have to be flushed before.
    pub(super) fn start_again(&mut self) {
        self.clear();
    }

    fn place(&mut self, texture: &Texture2D) -> Option<Face> {
        let [width, height] = [texture.width(), texture.height()].map(|side| side as u16 + 2 * MARGIN);
        if self.next[0] + width > SIDE {
            self.next = [0, self.next[1] + self.row];
            self.row = 0;
        }
        let [x, y] = self.next;
        if y + height > SIDE {
            return None;
        }
        self.next[0] += width;
        self.row = self.row.max(height);
        let image = quad::Image { bytes: bordered(texture), width, height };
        self.page.update_part(&image, x.into(), y.into(), width.into(), height.into());
        let part = |px: u16| f32::from(px) / f32::from(SIDE);
        Some(Face {
            page: self.page.clone(),
            corner: [part(x + MARGIN), part(y + MARGIN)],
            size: [part(width - 2 * MARGIN), part(height - 2 * MARGIN)],
        })
    }
}

/// A large picture has a texture of its own.
fn alone(texture: &Texture2D) -> Face {
    let [width, height] = [texture.width(), texture.height()].map(|side| side as u16);
    let page = quad::Texture2D::from_rgba8(width, height, texture.rgba8());
    page.set_filter(quad::FilterMode::Linear);
    Face { page, corner: [0.0; 2], size: [1.0; 2] }
}

/// The pixels with a border as wide as the margin that repeats the outermost ones, so that no neighbour shines through.
fn bordered(texture: &Texture2D) -> Vec<u8> {
    let [width, height] = [texture.width(), texture.height()];
    let margin = u32::from(MARGIN);
    let inside = |at: u32, side: u32| at.saturating_sub(margin).min(side - 1);
    let mut bytes = Vec::new();
    for row in 0..height + 2 * margin {
        for column in 0..width + 2 * margin {
            let from = 4 * (inside(row, height) * width + inside(column, width)) as usize;
            bytes.extend_from_slice(&texture.rgba8()[from..from + 4]);
        }
    }
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_border_repeats_the_outermost_pixels() {
        let texture = Texture2D::from_rgba8(2, 1, vec![1, 1, 1, 1, 2, 2, 2, 2]).unwrap();
        let row = [1, 1, 2, 2].map(|value: u8| [value; 4]).concat();
        assert_eq!(bordered(&texture), [row.clone(), row.clone(), row].concat());
    }
}
