//! The canvas in memory, drawn by tiny-skia.

use std::path::Path;

use tiny_skia::{
    FillRule, FilterQuality, LineJoin, Paint, PathBuilder, Pattern, Pixmap, PixmapRef, Rect, Shader,
    SpreadMode, Stroke,
};

use crate::canvas::MAX_COORDINATE;
use crate::clip::clip_to_convex;
use crate::error::check_size;
use crate::png_file;
use crate::whole_move::{draw_moved, whole_move};
use crate::{Canvas, Color, Point, Result, Texture2D, Transform};

/// A picture in memory, drawn without graphics hardware, with smooth edges.
///
/// Pixels are kept as RGBA8 with premultiplied alpha; [`SoftwareCanvas::pixel`] and [`SoftwareCanvas::rgba8`]
/// return straight alpha. Textures are sampled bilinearly or, if they are only translated, at the nearest
/// pixel. There are no mipmaps, so a texture drawn at less than half its size loses detail.
#[derive(Debug, Clone, PartialEq)]
pub struct SoftwareCanvas {
    pixmap: Pixmap,
    /// Premultiplied pixels of the texture being drawn, tinted; kept to save allocations.
    tinted: Vec<u8>,
}

impl SoftwareCanvas {
    /// A transparent canvas of `width` x `height` px.
    ///
    /// # Errors
    /// A side of 0 or more than [`MAX_SIDE`](crate::MAX_SIDE), or more than [`MAX_PIXELS`](crate::MAX_PIXELS)
    /// px.
    pub fn new(width: u32, height: u32) -> Result<Self> {
        check_size(width, height)?;
        let pixmap = Pixmap::new(width, height).ok_or_else(|| {
            crate::RenderError::invalid("width x height", (width, height), "a picture's size")
        })?;
        Ok(SoftwareCanvas { pixmap, tinted: Vec::new() })
    }

    /// Width in px.
    pub fn width(&self) -> u32 {
        self.pixmap.width()
    }

    /// Height in px.
    pub fn height(&self) -> u32 {
        self.pixmap.height()
    }

    /// The colour of a pixel, `None` outside the canvas. Translucent colours carry the rounding of
    /// premultiplying.
    pub fn pixel(&self, x: u32, y: u32) -> Option<Color> {
        let c = self.pixmap.pixel(x, y)?.demultiply();
        Some(Color::rgba(c.red(), c.green(), c.blue(), c.alpha()))
    }

    /// All pixels as straight RGBA8: rows from the top, four bytes each, no padding.
    pub fn rgba8(&self) -> Vec<u8> {
        self.pixmap.clone().take_demultiplied()
    }

    /// All pixels as premultiplied RGBA8, without a copy.
    pub fn premultiplied_rgba8(&self) -> &[u8] {
        self.pixmap.data()
    }

    /// The picture as a texture.
    pub fn to_texture(&self) -> Result<Texture2D> {
        Texture2D::from_rgba8(self.width(), self.height(), self.rgba8())
    }

    /// Writes the picture as a PNG file; folders above it are created.
    ///
    /// # Errors
    /// The file or a folder cannot be written.
    pub fn save_png(&self, path: impl AsRef<Path>) -> Result<()> {
        png_file::write(path.as_ref(), self.width(), self.height(), &self.rgba8())
    }

    fn fill(&mut self, path: &tiny_skia::Path, shader: Shader<'_>) {
        fill(&mut self.pixmap, path, shader);
    }
}

impl Canvas for SoftwareCanvas {
    fn size(&self) -> [u32; 2] {
        [self.width(), self.height()]
    }

    fn clear(&mut self, color: Color) {
        self.pixmap.fill(skia_color(color));
    }

    fn fill_polygon(&mut self, points: &[Point], transform: &Transform, color: Color) {
        if points.len() >= 3
            && let Some(path) = path_of(points, true, transform)
        {
            self.fill(&path, Shader::SolidColor(skia_color(color)));
        }
    }

    fn fill_ellipse(&mut self, center: Point, radii: Point, transform: &Transform, color: Color) {
        let [[x, y], [rx, ry]] = [center, radii];
        let corners = [[x - rx, y - ry], [x + rx, y - ry], [x + rx, y + ry], [x - rx, y + ry]];
        if !(rx > 0.0 && ry > 0.0 && corners.iter().all(|&corner| in_reach(transform.apply(corner)))) {
            return;
        }
        let oval = Rect::from_ltrb(x - rx, y - ry, x + rx, y + ry).and_then(PathBuilder::from_oval);
        if let Some(path) = oval.and_then(|path| path.transform(skia_transform(transform))) {
            self.fill(&path, Shader::SolidColor(skia_color(color)));
        }
    }

    fn stroke_polyline(
        &mut self,
        points: &[Point],
        closed: bool,
        width: f32,
        transform: &Transform,
        color: Color,
    ) {
        if points.len() < 2 || !(width > 0.0 && width <= MAX_COORDINATE) {
            return;
        }
        if let Some(path) = path_of(points, closed, transform) {
            let paint = paint_with(Shader::SolidColor(skia_color(color)));
            let stroke = Stroke { width, line_join: LineJoin::Round, ..Stroke::default() };
            self.pixmap.stroke_path(&path, &paint, &stroke, tiny_skia::Transform::identity(), None);
        }
    }

    fn draw_texture(
        &mut self,
        texture: &Texture2D,
        transform: &Transform,
        tint: Color,
        clip: Option<&[Point]>,
    ) {
        let [width, height] = [texture.width() as f32, texture.height() as f32];
        let corners =
            [[0.0, 0.0], [width, 0.0], [width, height], [0.0, height]].map(|corner| transform.apply(corner));
        let is_in_reach = corners.iter().chain(clip.unwrap_or(&[])).all(|&corner| in_reach(corner));
        if tint.a == 0 || !is_in_reach {
            return;
        }
        let is_as_it_is = tint == Color::WHITE && clip.is_none();
        if let Some(corner) = whole_move(transform).filter(|_| is_as_it_is) {
            return draw_moved(&mut self.pixmap, texture, corner);
        }
        let path = match clip {
            Some(clip) => path_of(&clip_to_convex(clip, &corners), true, &Transform::IDENTITY),
            None => path_of(&corners, true, &Transform::IDENTITY),
        };
        let Some(path) = path else { return };
        if let (1, 1, Some(color)) = (texture.width(), texture.height(), texture.pixel(0, 0)) {
            // A texture of a single colour needs no sampling.
            return self.fill(&path, Shader::SolidColor(skia_color(times(color, tint))));
        }
        let pixels = if tint.with_alpha(255) == Color::WHITE {
            texture.premultiplied_rgba8()
        } else {
            tint_into(&mut self.tinted, texture.premultiplied_rgba8(), tint);
            &self.tinted
        };
        let Some(image) = PixmapRef::from_bytes(pixels, texture.width(), texture.height()) else { return };
        let opacity = f32::from(tint.a) / 255.0;
        // Pad mode repeats the colour of the border pixels beyond the edge, so smooth edges blend with no
        // colour from outside.
        let shader =
            Pattern::new(image, SpreadMode::Pad, FilterQuality::Bilinear, opacity, skia_transform(transform));
        fill(&mut self.pixmap, &path, shader);
    }
}

fn fill(pixmap: &mut Pixmap, path: &tiny_skia::Path, shader: Shader<'_>) {
    pixmap.fill_path(path, &paint_with(shader), FillRule::Winding, tiny_skia::Transform::identity(), None);
}

fn paint_with(shader: Shader<'_>) -> Paint<'_> {
    Paint { shader, anti_alias: true, ..Paint::default() }
}

/// The lines through the points, in canvas px; `None` if one lies out of reach.
fn path_of(points: &[Point], closed: bool, transform: &Transform) -> Option<tiny_skia::Path> {
    let mut path = PathBuilder::with_capacity(points.len() + 2, points.len() + 1);
    for (index, &point) in points.iter().enumerate() {
        let [x, y] = transform.apply(point);
        if !in_reach([x, y]) {
            return None;
        }
        if index == 0 { path.move_to(x, y) } else { path.line_to(x, y) }
    }
    if closed {
        path.close();
    }
    path.finish()
}

/// Whether the point is finite and within the range of coordinates of the canvas.
fn in_reach([x, y]: Point) -> bool {
    x.abs() <= MAX_COORDINATE && y.abs() <= MAX_COORDINATE
}

/// The product of two channels.
fn product(a: u8, b: u8) -> u8 {
    ((u32::from(a) * u32::from(b) + 127) / 255) as u8
}

/// A straight colour with a tint.
fn times(a: Color, b: Color) -> Color {
    Color::rgba(product(a.r, b.r), product(a.g, b.g), product(a.b, b.b), product(a.a, b.a))
}

/// Multiplies premultiplied pixels by the tint's red, green and blue. The tint's alpha is applied elsewhere,
/// as opacity.
fn tint_into(target: &mut Vec<u8>, pixels: &[u8], tint: Color) {
    target.clear();
    target.extend(
        pixels
            .chunks_exact(4)
            .flat_map(|p| [product(p[0], tint.r), product(p[1], tint.g), product(p[2], tint.b), p[3]]),
    );
}

fn skia_color(color: Color) -> tiny_skia::Color {
    tiny_skia::Color::from_rgba8(color.r, color.g, color.b, color.a)
}

fn skia_transform(t: &Transform) -> tiny_skia::Transform {
    tiny_skia::Transform::from_row(
        t.x_axis[0],
        t.x_axis[1],
        t.y_axis[0],
        t.y_axis[1],
        t.translation[0],
        t.translation[1],
    )
}
