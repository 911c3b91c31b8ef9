//! A backend of `plotters` that paints pixels with `tiny-skia`.

use super::png_file;
use plotters_backend::{
    BackendColor, BackendCoord, BackendStyle, BackendTextStyle, DrawingBackend, DrawingErrorKind,
    FontTransform,
    text_anchor::{HPos, VPos},
};
use std::cell::RefCell;
use std::convert::Infallible;
use std::io;
use std::path::Path;
use tiny_skia::{FillRule, LineCap, LineJoin, Paint, PathBuilder, Pixmap, Rect, Stroke, Transform};
use ttf_parser::{Face, OutlineBuilder};

/// Number of pixels of the file per px of the picture.
const SCALE: f32 = 2.0;
/// Ratio of the size of a font in `plotters` to that in SVG, for the same nominal size.
const FONT_SIZE: f32 = 1.24;
/// Width by which strokes of letters are thickened, as a fraction of the font's size. The font is thin.
const THICKENING: f32 = 0.035;

/// Picture of pixels that [`Sheet`] paints on.
pub struct Pixels {
    map: RefCell<Pixmap>,
    face: Face<'static>,
    size: (u32, u32),
}

type Outcome = Result<(), DrawingErrorKind<Infallible>>;

impl Pixels {
    /// Returns a white picture of a size in px, at least 1 each way.
    ///
    /// # Panics
    ///
    /// When width or height is 0 or too large.
    pub fn new(size: (u32, u32)) -> Self {
        let [width, height] = [size.0, size.1].map(|side| (side as f32 * SCALE) as u32);
        let map = Pixmap::new(width, height).expect("a picture has an area");
        let face = Face::parse(epaint_default_fonts::UBUNTU_LIGHT, 0).expect("the font is compiled in");
        Pixels { map: RefCell::new(map), face, size }
    }

    /// Returns the drawing area of the picture for `plotters`.
    pub fn sheet(&self) -> Sheet<'_> {
        Sheet(self)
    }

    /// Writes the picture to a PNG file.
    ///
    /// # Errors
    ///
    /// When the file cannot be written.
    pub fn save(&self, path: &Path) -> io::Result<()> {
        let map = self.map.borrow();
        png_file::write(path, (map.width(), map.height()), map.data())
    }

    fn fill(&self, path: Option<tiny_skia::Path>, color: BackendColor, transform: Transform) -> Outcome {
        if let Some(path) = path {
            let mut map = self.map.borrow_mut();
            map.fill_path(&path, &paint(color), FillRule::Winding, transform, None);
        }
        Ok(())
    }

    fn stroke(
        &self,
        path: Option<tiny_skia::Path>,
        color: BackendColor,
        stroke: &Stroke,
        transform: Transform,
    ) {
        if let Some(path) = path {
            self.map.borrow_mut().stroke_path(&path, &paint(color), stroke, transform, None);
        }
    }

    /// Returns the width of a text in a font of `size` px, px.
    fn width(&self, text: &str, size: f32) -> f32 {
        let advances = text.chars().map(|letter| self.glyph(letter).1);
        advances.sum::<f32>() * self.unit(size)
    }

    /// Returns the length of a font unit in a font of `size` px, px.
    fn unit(&self, size: f32) -> f32 {
        size / f32::from(self.face.units_per_em())
    }

    fn glyph(&self, letter: char) -> (ttf_parser::GlyphId, f32) {
        let glyph = self.face.glyph_index(letter).unwrap_or_default();
        (glyph, f32::from(self.face.glyph_hor_advance(glyph).unwrap_or_default()))
    }
}

/// Backend of `plotters` that paints on [`Pixels`].
pub struct Sheet<'a>(&'a Pixels);

impl DrawingBackend for Sheet<'_> {
    type ErrorType = Infallible;

    fn get_size(&self) -> (u32, u32) {
        self.0.size
    }

    fn ensure_prepared(&mut self) -> Outcome {
        Ok(())
    }

    fn present(&mut self) -> Outcome {
        Ok(())
    }

    fn draw_pixel(&mut self, point: BackendCoord, color: BackendColor) -> Outcome {
        self.draw_rect(point, (point.0 + 1, point.1 + 1), &color, true)
    }

    fn draw_line<S: BackendStyle>(&mut self, from: BackendCoord, to: BackendCoord, style: &S) -> Outcome {
        self.draw_path([from, to], style)
    }

    fn draw_rect<S: BackendStyle>(
        &mut self,
        upper_left: BackendCoord,
        bottom_right: BackendCoord,
        style: &S,
        fill: bool,
    ) -> Outcome {
        let ((left, top), (right, bottom)) = (place(upper_left), place(bottom_right));
        let rect = Rect::from_ltrb(left.min(right), top.min(bottom), left.max(right), top.max(bottom));
        let Some(rect) = rect else { return Ok(()) };
        let path = Some(PathBuilder::from_rect(rect));
        self.draw(path, style, fill)
    }

    fn draw_path<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(
        &mut self,
        path: I,
        style: &S,
    ) -> Outcome {
        self.draw(polygon(path, false), style, false)
    }

    fn draw_circle<S: BackendStyle>(
        &mut self,
        center: BackendCoord,
        radius: u32,
        style: &S,
        fill: bool,
    ) -> Outcome {
        let (x, y) = place(center);
        self.draw(PathBuilder::from_circle(x, y, radius as f32), style, fill)
    }

    fn fill_polygon<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(
        &mut self,
        vert: I,
        style: &S,
    ) -> Outcome {
        self.draw(polygon(vert, true), style, true)
    }

    fn estimate_text_size<T: BackendTextStyle>(
        &self,
        text: &str,
        style: &T,
    ) -> Result<(u32, u32), DrawingErrorKind<Infallible>> {
        let size = style.size() as f32 / FONT_SIZE;
        Ok((self.0.width(text, size).ceil() as u32, size.ceil() as u32))
    }

    fn draw_text<T: BackendTextStyle>(&mut self, text: &str, style: &T, pos: BackendCoord) -> Outcome {
        let pixels = self.0;
        let size = style.size() as f32 / FONT_SIZE;
        let start = match style.anchor().h_pos {
            HPos::Left => 0.0,
            HPos::Center => -0.5,
            HPos::Right => -1.0,
        } * pixels.width(text, size);
        // Positions of the baseline are fractions of the font's size, as in the SVG backend. The letter `x` is half as high.
        let baseline = match style.anchor().v_pos {
            VPos::Top => 0.76,
            VPos::Center => 0.25,
            VPos::Bottom => -0.25,
        } * size;
        let angle = match style.transform() {
            FontTransform::None => 0.0,
            FontTransform::Rotate90 => 90.0,
            FontTransform::Rotate180 => 180.0,
            FontTransform::Rotate270 => 270.0,
        };
        let (x, y) = place(pos);
        let unit = pixels.unit(size);
        let transform = Transform::from_scale(unit, -unit)
            .post_translate(start, baseline)
            .post_rotate(angle)
            .post_translate(x, y)
            .post_scale(SCALE, SCALE);
        let mut outline = Outline { path: PathBuilder::new(), x: 0.0 };
        for letter in text.chars() {
            let (glyph, advance) = pixels.glyph(letter);
            // A blank has no outline.
            let _ = pixels.face.outline_glyph(glyph, &mut outline);
            outline.x += advance;
        }
        let path = outline.path.finish();
        let stroke = Stroke { width: THICKENING * size / unit, ..Stroke::default() };
        pixels.stroke(path.clone(), style.color(), &stroke, transform);
        pixels.fill(path, style.color(), transform)
    }
}

impl Sheet<'_> {
    fn draw<S: BackendStyle>(&self, path: Option<tiny_skia::Path>, style: &S, fill: bool) -> Outcome {
        let transform = Transform::from_scale(SCALE, SCALE);
        if fill {
            return self.0.fill(path, style.color(), transform);
        }
        let stroke = Stroke {
            width: style.stroke_width() as f32,
            line_cap: LineCap::Butt,
            line_join: LineJoin::Round,
            ..Stroke::default()
        };
        self.0.stroke(path, style.color(), &stroke, transform);
        Ok(())
    }
}

/// Outlines of letters as one path, in font units, y up.
struct Outline {
    path: PathBuilder,
    x: f32,
}

impl OutlineBuilder for Outline {
    fn move_to(&mut self, x: f32, y: f32) {
        self.path.move_to(self.x + x, y);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.path.line_to(self.x + x, y);
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        self.path.quad_to(self.x + x1, y1, self.x + x, y);
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        self.path.cubic_to(self.x + x1, y1, self.x + x2, y2, self.x + x, y);
    }

    fn close(&mut self) {
        self.path.close();
    }
}

fn place((x, y): BackendCoord) -> (f32, f32) {
    (x as f32, y as f32)
}

fn polygon(points: impl IntoIterator<Item = BackendCoord>, closed: bool) -> Option<tiny_skia::Path> {
    let mut path = PathBuilder::new();
    for (index, (x, y)) in points.into_iter().map(place).enumerate() {
        if index == 0 { path.move_to(x, y) } else { path.line_to(x, y) }
    }
    if closed {
        path.close();
    }
    path.finish()
}

fn paint(color: BackendColor) -> Paint<'static> {
    let (red, green, blue) = color.rgb;
    let mut paint = Paint { anti_alias: true, ..Paint::default() };
    paint.set_color_rgba8(red, green, blue, (color.alpha * 255.0).round() as u8);
    paint
}
