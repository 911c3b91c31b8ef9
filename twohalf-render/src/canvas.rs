//! Canvases: targets of drawing.

use crate::{Color, Point, Rectangle, Texture2D, Transform};

/// A picture to draw on: x right, y **down**, in px; pixel (0, 0) is the square from (0, 0) to (1, 1), top
/// left.
///
/// Later calls draw over earlier ones; translucent colours blend (source over, in sRGB). A call draws nothing
/// if a number is not finite, if a corner would be farther than [`MAX_COORDINATE`] px from the origin, or if
/// its shape has no area.
pub trait Canvas {
    /// Width and height in px.
    fn size(&self) -> [u32; 2];

    /// Least and greatest x and y of the visible area, px: from 0 to its size for a plain canvas. A
    /// [`View`](crate::View) shows another part.
    fn visible_area(&self) -> [Point; 2] {
        [[0.0, 0.0], self.size().map(|side| side as f32)]
    }

    /// Sets every pixel to this colour, without blending.
    fn clear(&mut self, color: Color);

    /// Fills a polygon of at least three points, convex or not; where it overlaps itself, non-zero winding
    /// counts.
    fn fill_polygon(&mut self, points: &[Point], transform: &Transform, color: Color);

    /// Fills an ellipse with half axes `radii` (greater than 0) along x and y before the transform.
    fn fill_ellipse(&mut self, center: Point, radii: Point, transform: &Transform, color: Color);

    /// Fills the rectangle from `corner` (its least x and y) with the given size (greater than 0).
    fn fill_rectangle(&mut self, corner: Point, size: Point, transform: &Transform, color: Color) {
        let [[x, y], [width, height]] = [corner, size];
        if width > 0.0 && height > 0.0 {
            let corners = [[x, y], [x + width, y], [x + width, y + height], [x, y + height]];
            self.fill_polygon(&corners, transform, color);
        }
    }

    /// Draws lines from point to point (at least two), and from the last to the first if `closed`. `width` is
    /// in px of the canvas: the transform moves the points and does not widen the lines.
    fn stroke_polyline(
        &mut self,
        points: &[Point],
        closed: bool,
        width: f32,
        transform: &Transform,
        color: Color,
    );

    /// Draws a texture. `transform` takes the texture's px (origin at its top left corner) to the canvas;
    /// every channel is multiplied by `tint`, whose alpha is the opacity.
    ///
    /// With a `clip` only what lies inside of this polygon is drawn: corners in px of the canvas, convex or
    /// not; where it overlaps itself, non-zero winding counts.
    fn draw_texture(
        &mut self,
        texture: &Texture2D,
        transform: &Transform,
        tint: Color,
        clip: Option<&[Point]>,
    );

    /// [`draw_texture`](Self::draw_texture) for a part of the texture, whose upper left corner is the origin
    /// of `transform`. Parts outside of the texture are left out.
    fn draw_texture_part(
        &mut self,
        texture: &Texture2D,
        source: Rectangle,
        transform: &Transform,
        tint: Color,
        clip: Option<&[Point]>,
    ) {
        if let Some(part) = texture.part(source) {
            self.draw_texture(&part, transform, tint, clip);
        }
    }
}

/// Greatest coordinate of a corner of a shape, px from the origin.
pub const MAX_COORDINATE: f32 = 1.0e6;
