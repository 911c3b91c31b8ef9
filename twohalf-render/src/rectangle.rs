//! Rectangles of whole px.

use crate::Point;

/// A rectangle of whole px, x right and y down: a part of a texture, or of a canvas.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[doc(alias = "Microsoft.Xna.Framework.Rectangle")]
pub struct Rectangle {
    /// Left side, px.
    #[doc(alias = "X")]
    pub x: u32,
    /// Upper side, px.
    #[doc(alias = "Y")]
    pub y: u32,
    /// Width in px.
    #[doc(alias = "Width")]
    pub width: u32,
    /// Height in px.
    #[doc(alias = "Height")]
    pub height: u32,
}

impl Rectangle {
    /// The rectangle with this upper left corner and size, px.
    pub const fn new(x: u32, y: u32, width: u32, height: u32) -> Self {
        Rectangle { x, y, width, height }
    }

    /// The cell `index` of a sheet whose cells of `width` x `height` px lie in rows of `columns`, from the
    /// upper left corner to the right and down. Without columns it is the first. Cells beyond the range of
    /// u32 are empty.
    ///
    /// ```
    /// # use twohalf_render::Rectangle;
    /// assert_eq!(Rectangle::cell(5, 4, 32, 48), Rectangle::new(32, 48, 32, 48));
    /// ```
    pub const fn cell(index: u32, columns: u32, width: u32, height: u32) -> Self {
        let [column, row] = if columns == 0 { [0, 0] } else { [index % columns, index / columns] };
        match (column.checked_mul(width), row.checked_mul(height)) {
            (Some(x), Some(y)) => Rectangle { x, y, width, height },
            _ => Rectangle { x: 0, y: 0, width: 0, height: 0 },
        }
    }

    /// The common part; without width or height if there is none.
    pub fn intersection(&self, other: &Rectangle) -> Rectangle {
        let [x, y] = [self.x.max(other.x), self.y.max(other.y)];
        let right = self.x.saturating_add(self.width).min(other.x.saturating_add(other.width));
        let bottom = self.y.saturating_add(self.height).min(other.y.saturating_add(other.height));
        Rectangle { x, y, width: right.saturating_sub(x), height: bottom.saturating_sub(y) }
    }

    /// Whether it has no width or no height.
    pub const fn is_empty(&self) -> bool {
        self.width == 0 || self.height == 0
    }

    /// Corners from the upper left one clockwise.
    pub(crate) fn corners(&self) -> [Point; 4] {
        let [x, y, width, height] = [self.x, self.y, self.width, self.height].map(|side| side as f32);
        [[x, y], [x + width, y], [x + width, y + height], [x, y + height]]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rectangles_apart_have_an_empty_intersection() {
        let left = Rectangle::new(0, 0, 10, 10);
        assert_eq!(left.intersection(&Rectangle::new(4, 6, 100, 2)), Rectangle::new(4, 6, 6, 2));
        assert!(left.intersection(&Rectangle::new(10, 0, 5, 5)).is_empty());
        assert!(left.intersection(&Rectangle::new(u32::MAX, 0, u32::MAX, 5)).is_empty());
    }

    #[test]
    fn a_cell_beyond_whole_numbers_is_empty() {
        assert!(Rectangle::cell(u32::MAX, 1, 2, 2).is_empty());
    }
}
