//! Walls and pavements.

use super::Texture2D;
use super::generated::generate;
use crate::error::check_range;
use crate::{Color, RenderError, Result};

/// Width of a joint, px.
const JOINT: f32 = 1.5;
/// Difference of brightness between the lightest and the darkest stone (a ratio).
const UNEVEN: f32 = 0.22;

impl Texture2D {
    /// A wall of bricks of `width` by `height` px in the given number of columns and rows. Every other row is
    /// shifted by half a brick, and each brick has its own shade. It can be repeated to all sides if `rows`
    /// is even.
    ///
    /// ```
    /// # use twohalf_render::{Color, Texture2D};
    /// let wall = Texture2D::bricks([24, 10], [6, 8], Color::rgb(150, 84, 66))?;
    /// assert_eq!((wall.width(), wall.height()), (144, 80));
    /// # Ok::<(), twohalf_render::RenderError>(())
    /// ```
    ///
    /// # Errors
    /// Bricks of fewer than 4 px a side; no columns or rows; a texture that would be too large (see
    /// [`SoftwareCanvas::new`](crate::SoftwareCanvas::new)).
    pub fn bricks(brick: [u32; 2], count: [u32; 2], color: Color) -> Result<Self> {
        masonry(brick, count, 0.5, color)
    }

    /// A pavement of slabs of `width` by `height` px in the given number of columns and rows, each slab with
    /// its own shade. It can be repeated to all sides.
    ///
    /// # Errors
    /// As [`bricks`](Self::bricks).
    pub fn paving(slab: [u32; 2], count: [u32; 2], color: Color) -> Result<Self> {
        masonry(slab, count, 0.0, color)
    }
}

fn masonry(stone: [u32; 2], count: [u32; 2], shift: f32, color: Color) -> Result<Texture2D> {
    for side in stone {
        check_range("side of a stone", side as f32, 4.0..=f32::MAX, "4 px or more")?;
    }
    let too_large = || RenderError::invalid("count", count, "fewer stones");
    let [width, height] = [0, 1].map(|axis| stone[axis].checked_mul(count[axis]));
    let (width, height) = (width.ok_or_else(too_large)?, height.ok_or_else(too_large)?);
    let color = color.with_alpha(255);
    let size = stone.map(|side| side as f32);
    generate(width, height, |[u, v]| {
        let row = v * count[1] as f32;
        let shifted = if row as u32 % 2 == 1 { shift } else { 0.0 };
        let column = u * count[0] as f32 + shifted;
        let [across, down] = [column.fract() * size[0], row.fract() * size[1]];
        let number = [column as u32 % count[0], row as u32];
        let to_edge = across.min(size[0] - across).min(down).min(size[1] - down);
        let base = color.darker(UNEVEN * shade(number));
        match to_edge {
            edge if edge < 0.5 * JOINT => color.darker(0.5),
            // Light from the upper left.
            edge if edge < JOINT => {
                let lit = across < 1.5 * JOINT || down < 1.5 * JOINT;
                if lit { base.lighter(0.16) } else { base.darker(0.16) }
            }
            _ => base,
        }
    })
}

/// Brightness of a stone, 0 to 1, scattered by its column and row.
fn shade([column, row]: [u32; 2]) -> f32 {
    let mixed = column.wrapping_mul(0x9E37_79B9) ^ row.wrapping_mul(0x85EB_CA6B);
    let mixed = (mixed ^ (mixed >> 15)).wrapping_mul(0x2C1B_3C6D);
    (mixed >> 24) as f32 / 255.0
}
