//! A picture of a size of its own on another canvas.

use twohalf_render::{Canvas, Color, Point, Rectangle, Texture2D, Transform, View};

/// A canvas that reports the size of the picture drawn on it, not that of the canvas below.
#[derive(Debug)]
pub(crate) struct Sheet<'a> {
    view: View<'a>,
    size: [u32; 2],
}

impl<'a> Sheet<'a> {
    /// A picture of this size in px, shown on a canvas through a camera, and cut off outside of a rectangle of the canvas.
    pub(crate) fn new(
        canvas: &'a mut dyn Canvas,
        size: [f32; 2],
        camera: &Transform,
        clip: Rectangle,
    ) -> Self {
        let size = size.map(|side| side as u32);
        Sheet { view: View::new(canvas).camera(camera).clip(clip), size }
    }
}

impl Canvas for Sheet<'_> {
    fn size(&self) -> [u32; 2] {
        self.size
    }

    fn visible_area(&self) -> [Point; 2] {
        [[0.0; 2], self.size.map(|side| side as f32)]
    }

    fn clear(&mut self, color: Color) {
        self.view.clear(color);
    }

    fn fill_polygon(&mut self, points: &[Point], transform: &Transform, color: Color) {
        self.view.fill_polygon(points, transform, color);
    }

    fn fill_ellipse(&mut self, center: Point, radii: Point, transform: &Transform, color: Color) {
        self.view.fill_ellipse(center, radii, transform, color);
    }

    fn stroke_polyline(
        &mut self,
        points: &[Point],
        closed: bool,
        width: f32,
        transform: &Transform,
        color: Color,
    ) {
        self.view.stroke_polyline(points, closed, width, transform, color);
    }

    fn draw_texture(
        &mut self,
        texture: &Texture2D,
        transform: &Transform,
        tint: Color,
        clip: Option<&[Point]>,
    ) {
        self.view.draw_texture(texture, transform, tint, clip);
    }
}
