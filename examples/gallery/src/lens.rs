//! Looking closer.

use twohalf_render::{Point, Transform};

/// Largest magnification, a factor.
const MOST: f32 = 20.0;

/// The visible part of a picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lens {
    /// Magnification relative to the complete picture, a factor of 1 or more.
    zoom: f32,
    /// Middle of the visible part: fractions of the picture's width and height.
    middle: Point,
}

impl Default for Lens {
    /// All of the picture.
    fn default() -> Self {
        Lens { zoom: 1.0, middle: [0.5; 2] }
    }
}

impl Lens {
    /// The magnification, from 1.
    pub fn zoom(&self) -> f32 {
        self.zoom
    }

    /// Multiplies the magnification by a factor, with the point at these fractions of the picture fixed. A factor that is not
    /// greater than 0, or NaN, has no effect.
    pub fn closer(self, factor: f32, at: Point) -> Self {
        if !(factor > 0.0 && factor.is_finite() && at.iter().all(|part| part.is_finite())) {
            return self;
        }
        let zoom = (self.zoom * factor).clamp(1.0, MOST);
        let middle = [0, 1].map(|axis| at[axis] + (self.middle[axis] - at[axis]) * self.zoom / zoom);
        Lens { zoom, middle }.inside()
    }

    /// Moves the visible part by fractions of the picture's width and height.
    pub fn moved(self, by: Point) -> Self {
        if !by.iter().all(|part| part.is_finite()) {
            return self;
        }
        Lens { middle: [0, 1].map(|axis| self.middle[axis] + by[axis]), ..self }.inside()
    }

    /// Clamps the visible part to the picture.
    fn inside(self) -> Self {
        let edge = 0.5 / self.zoom;
        Lens { middle: self.middle.map(|part| part.clamp(edge, 1.0 - edge)), ..self }
    }

    /// The camera that shows a picture of this size about a point of the canvas. At magnification 1 its scale is `scale`.
    pub(crate) fn camera(&self, size: [f32; 2], scale: f32, on_canvas: Point) -> Transform {
        let at = [self.middle[0] * size[0], self.middle[1] * size[1]];
        Transform::camera(at, scale * self.zoom, 0.0, on_canvas)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn on_canvas(lens: Lens, part: Point) -> Point {
        lens.camera([200.0, 100.0], 2.0, [300.0, 200.0]).apply([200.0 * part[0], 100.0 * part[1]])
    }

    #[test]
    fn the_zoomed_point_stays_where_it_is() {
        let at = [0.3, 0.6];
        let before = on_canvas(Lens::default(), at);
        let lens = Lens::default().closer(1.7, at).closer(1.3, at);
        let after = on_canvas(lens, at);
        assert!((0..2).all(|axis| (after[axis] - before[axis]).abs() < 1e-3), "{before:?} {after:?}");
        assert!((lens.zoom() - 2.21).abs() < 1e-5);
    }

    #[test]
    fn the_visible_part_is_clamped_to_the_picture_and_can_be_reset() {
        let lens = Lens::default().closer(4.0, [0.0, 0.0]).moved([-10.0, 10.0]);
        // The left lower corner of the picture is in that of the visible part: 200 px to the left of the middle, and 100 below.
        assert_eq!(on_canvas(lens, [0.0, 1.0]), [100.0, 300.0]);
        assert_eq!(lens.closer(0.001, [0.7, 0.2]), Lens::default());
    }

    #[test]
    fn a_nan_zoom_has_no_effect() {
        for (factor, at) in [(f32::NAN, 0.5), (0.0, 0.5), (-1.0, 0.5), (2.0, f32::INFINITY)] {
            assert_eq!(Lens::default().closer(factor, [at; 2]), Lens::default());
        }
        assert_eq!(Lens::default().moved([f32::NAN, 0.0]), Lens::default());
    }
}
