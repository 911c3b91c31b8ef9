//! A canvas that a graphics card draws.

use std::collections::HashMap;

use lyon_tessellation::math::point;
use lyon_tessellation::path::Path;
use lyon_tessellation::{BuffersBuilder, FillOptions, FillRule, FillTessellator, FillVertex, VertexBuffers};
use macroquad::prelude as quad;
use twohalf_render::{Canvas, Color, MAX_COORDINATE, Point, Texture2D, Transform, clip_to_convex};

use super::atlas::{Atlas, Face};

/// Numbers of corners and indices of a batch: less than the limit of a draw call of macroquad.
const BATCH: [usize; 2] = [8000, 12_000];
/// Number of outlines whose triangles are cached; letters are always the same.
const REMEMBERED: usize = 4096;

/// Buffers that last from frame to frame.
pub(crate) struct Ink {
    atlas: Atlas,
    triangles: HashMap<Vec<[u32; 2]>, Vec<Point>>,
    tessellator: FillTessellator,
}

/// A corner of a triangle: where on the screen, and where in the picture, from 0 to 1.
type Corner = (Point, Point);

/// The screen, for a frame.
pub(crate) struct ScreenCanvas<'a> {
    ink: &'a mut Ink,
    size: Point,
    mesh: quad::Mesh,
}

impl<'a> ScreenCanvas<'a> {
    /// The screen, of this size in px.
    pub(crate) fn new(ink: &'a mut Ink, size: Point) -> Self {
        ink.atlas.begin_frame();
        if ink.triangles.len() > REMEMBERED {
            ink.triangles.clear();
        }
        let mesh = quad::Mesh { vertices: Vec::new(), indices: Vec::new(), texture: None };
        ScreenCanvas { ink, size, mesh }
    }

    /// Flushes the remaining triangles.
    pub(crate) fn end(mut self) {
        self.flush();
    }

    fn flush(&mut self) {
        if !self.mesh.indices.is_empty() {
            quad::draw_mesh(&self.mesh);
        }
        self.mesh.vertices.clear();
        self.mesh.indices.clear();
    }

    /// Reserves space in the buffers, and sets the texture of the next triangles.
    fn prepare(&mut self, corners: usize, indices: usize, face: &Face) {
        let is_full =
            self.mesh.vertices.len() + corners > BATCH[0] || self.mesh.indices.len() + indices > BATCH[1];
        if is_full || self.mesh.texture.as_ref() != Some(&face.page) {
            self.flush();
            self.mesh.texture = Some(face.page.clone());
        }
    }

    /// Adds a convex polygon.
    fn fan(&mut self, corners: &[Corner], color: Color, face: &Face) {
        if corners.len() < 3 || corners.len() > BATCH[0] / 2 {
            return;
        }
        self.prepare(corners.len(), 3 * corners.len(), face);
        let first = self.mesh.vertices.len() as u16;
        self.mesh.vertices.extend(corners.iter().map(|&corner| vertex(corner, face, color)));
        for index in 2..corners.len() as u16 {
            self.mesh.indices.extend([first, first + index - 1, first + index]);
        }
    }

    /// Adds triangles, three corners each.
    fn triangles(&mut self, corners: &[Corner], color: Color, face: &Face) {
        for some in corners.chunks(3 * 1000) {
            self.prepare(some.len(), some.len(), face);
            let first = self.mesh.vertices.len() as u16;
            self.mesh.vertices.extend(some.iter().map(|&corner| vertex(corner, face, color)));
            self.mesh.indices.extend((0..some.len() as u16).map(|index| first + index));
        }
    }

    fn face_of(&mut self, texture: &Texture2D) -> Option<Face> {
        let face = self.ink.atlas.face(texture);
        if face.is_some() {
            return face;
        }
        self.flush();
        self.ink.atlas.start_again();
        self.ink.atlas.face(texture)
    }

    fn line(&mut self, from: Point, to: Point, width: f32, color: Color, face: &Face) {
        let [dx, dy] = [to[0] - from[0], to[1] - from[1]];
        let length = dx.hypot(dy);
        if length > 0.0 {
            let [x, y] = [-dy / length, dx / length].map(|side| 0.5 * width * side);
            let [[a, b], [c, d]] = [from, to];
            let corners = [[a + x, b + y], [c + x, d + y], [c - x, d - y], [a - x, b - y]];
            self.fan(&corners.map(plain), color, face);
        }
    }
}

impl Canvas for ScreenCanvas<'_> {
    fn size(&self) -> [u32; 2] {
        self.size.map(|side| side as u32)
    }

    fn clear(&mut self, color: Color) {
        self.mesh.vertices.clear();
        self.mesh.indices.clear();
        quad::clear_background(color_of(color));
    }

    fn fill_polygon(&mut self, points: &[Point], transform: &Transform, color: Color) {
        if points.len() < 3 || color.a == 0 || !points.iter().all(|&at| is_in_reach(transform.apply(at))) {
            return;
        }
        let white = self.ink.atlas.white();
        if is_convex(points) {
            let corners: Vec<Corner> = points.iter().map(|&at| plain(transform.apply(at))).collect();
            return self.fan(&corners, color, &white);
        }
        let corners: Vec<Corner> =
            self.ink.triangles_of(points).iter().map(|&at| plain(transform.apply(at))).collect();
        self.triangles(&corners, color, &white);
    }

    fn fill_ellipse(&mut self, center: Point, radii: Point, transform: &Transform, color: Color) {
        let [[x, y], [rx, ry]] = [center, radii];
        let is_near = [center, [x + rx, y + ry]].iter().all(|&at| is_in_reach(transform.apply(at)));
        if !(rx > 0.0 && ry > 0.0 && is_near) {
            return;
        }
        let [across, down] = [transform.direction([rx, 0.0]), transform.direction([0.0, ry])];
        let size = across[0].hypot(across[1]).max(down[0].hypot(down[1]));
        // Corners that are no more than a fifth of a px off the ellipse.
        let count = (2.5 * (10.0 * size).sqrt()).clamp(8.0, 96.0) as u16;
        let middle = transform.apply(center);
        let corner = |index: u16| {
            let (sin, cos) = (f32::from(index) / f32::from(count) * std::f32::consts::TAU).sin_cos();
            plain([middle[0] + cos * across[0] + sin * down[0], middle[1] + cos * across[1] + sin * down[1]])
        };
        let corners: Vec<Corner> = (0..count).map(corner).collect();
        let white = self.ink.atlas.white();
        self.fan(&corners, color, &white);
    }

    fn stroke_polyline(
        &mut self,
        points: &[Point],
        closed: bool,
        width: f32,
        transform: &Transform,
        color: Color,
    ) {
        let points: Vec<Point> = points.iter().map(|&at| transform.apply(at)).collect();
        if points.len() < 2
            || !(width > 0.0 && width <= MAX_COORDINATE)
            || !points.iter().all(|&at| is_in_reach(at))
        {
            return;
        }
        let white = self.ink.atlas.white();
        points.windows(2).for_each(|ends| self.line(ends[0], ends[1], width, color, &white));
        if closed {
            self.line(points[points.len() - 1], points[0], width, color, &white);
        }
        // Thin lines show no gaps where they bend.
        if width > 2.5 {
            let radii = [0.5 * width; 2];
            points.iter().for_each(|&at| self.fill_ellipse(at, radii, &Transform::IDENTITY, color));
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
        let on_texture = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let corners = on_texture.map(|[x, y]| transform.apply([x * width, y * height]));
        let is_in_reach = corners.iter().chain(clip.unwrap_or(&[])).all(|&at| is_in_reach(at));
        if tint.a == 0 || !is_in_reach {
            return;
        }
        let Some(face) = self.face_of(texture) else { return };
        let whole: [Corner; 4] = std::array::from_fn(|at| (corners[at], on_texture[at]));
        let Some(clip) = clip.filter(|clip| !holds_all(clip, &corners)) else {
            return self.fan(&whole, tint, &face);
        };
        let Some(back) = transform.inverse() else { return };
        let inside = clip_to_convex(clip, &corners);
        let placed = |at: Point| {
            let [x, y] = back.apply(at);
            (at, [x / width, y / height])
        };
        if inside.len() < 3 {
            return;
        }
        if is_convex(&inside) {
            let placed: Vec<Corner> = inside.into_iter().map(placed).collect();
            return self.fan(&placed, tint, &face);
        }
        let placed: Vec<Corner> = self.ink.triangles_of(&inside).iter().map(|&at| placed(at)).collect();
        self.triangles(&placed, tint, &face);
    }
}

impl Default for Ink {
    fn default() -> Self {
        Ink { atlas: Atlas::new(), triangles: HashMap::new(), tessellator: FillTessellator::new() }
    }
}

impl Ink {
    /// The triangles that a polygon is cut into, where non-zero winding counts.
    fn triangles_of(&mut self, points: &[Point]) -> &[Point] {
        let key: Vec<[u32; 2]> = points.iter().map(|at| at.map(f32::to_bits)).collect();
        let Ink { triangles, tessellator, .. } = self;
        triangles.entry(key).or_insert_with(|| cut(tessellator, points))
    }
}

fn cut(tessellator: &mut FillTessellator, points: &[Point]) -> Vec<Point> {
    let mut path = Path::builder();
    path.begin(point(points[0][0], points[0][1]));
    for at in &points[1..] {
        path.line_to(point(at[0], at[1]));
    }
    path.end(true);
    let mut buffers: VertexBuffers<Point, u32> = VertexBuffers::new();
    let mut builder =
        BuffersBuilder::new(&mut buffers, |corner: FillVertex<'_>| corner.position().to_array());
    let options = FillOptions::default().with_fill_rule(FillRule::NonZero).with_tolerance(0.05);
    // Outlines that cannot be cut, since numbers are not finite or too far apart, are not drawn.
    if tessellator.tessellate_path(&path.build(), &options, &mut builder).is_err() {
        return Vec::new();
    }
    buffers.indices.iter().map(|&index| buffers.vertices[index as usize]).collect()
}

fn vertex((at, on): Corner, face: &Face, Color { r, g, b, a }: Color) -> quad::Vertex {
    let [x, y] = face.at(on);
    quad::Vertex::new(at[0], at[1], 0.0, x, y, quad::Color::from_rgba(r, g, b, a))
}

fn plain(at: Point) -> Corner {
    (at, [0.0; 2])
}

fn color_of(Color { r, g, b, a }: Color) -> quad::Color {
    quad::Color::from_rgba(r, g, b, a)
}

fn is_in_reach([x, y]: Point) -> bool {
    x.abs() <= MAX_COORDINATE && y.abs() <= MAX_COORDINATE
}

/// Whether a polygon is convex and goes round once: every bend has the same direction, and all of them make one turn.
fn is_convex(points: &[Point]) -> bool {
    let count = points.len();
    let edge = |index: usize| {
        let [from, to] = [points[index % count], points[(index + 1) % count]];
        [to[0] - from[0], to[1] - from[1]]
    };
    let (mut side, mut changes, mut goes_right) = (0.0_f32, 0, None);
    for index in 0..count {
        let [a, b] = [edge(index), edge(index + 1)];
        let bend = a[0] * b[1] - a[1] * b[0];
        if bend * side < 0.0 {
            return false;
        }
        side = if bend == 0.0 { side } else { bend };
        if a[0] != 0.0 {
            let right = a[0] > 0.0;
            changes += u32::from(goes_right.is_some_and(|before| before != right));
            goes_right = Some(right);
        }
    }
    // Once to the left and back; a polygon that goes round twice does so twice. The end joins the beginning.
    side != 0.0 && changes <= 2
}

/// Whether a rectangle that is not turned holds all points; false of other outlines.
fn holds_all(clip: &[Point], points: &[Point]) -> bool {
    let [a, b, c, d] = match clip {
        [a, b, c, d] => [*a, *b, *c, *d],
        _ => return false,
    };
    let is_upright = a[1] == b[1] && b[0] == c[0] && c[1] == d[1] && d[0] == a[0];
    let holds = |at: &Point| (a[0]..=c[0]).contains(&at[0]) && (a[1]..=c[1]).contains(&at[1]);
    is_upright && points.iter().all(holds)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_square_is_convex_and_an_arrow_and_a_bow_tie_and_a_double_turn_are_not() {
        let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        assert!(is_convex(&square));
        assert!(!is_convex(&[[0.0, 0.0], [2.0, 1.0], [0.0, 2.0], [1.0, 1.0]]));
        assert!(!is_convex(&[[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]]));
        assert!(!is_convex(&[square, square].concat()));
        assert!(!is_convex(&[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]]));
    }

    #[test]
    fn triangulation_keeps_the_area_and_holes_stay_filled() {
        let area = |points: &[Point]| {
            let triangles = cut(&mut FillTessellator::new(), points);
            let of = |t: &[Point]| {
                0.5 * ((t[1][0] - t[0][0]) * (t[2][1] - t[0][1]) - (t[1][1] - t[0][1]) * (t[2][0] - t[0][0]))
                    .abs()
            };
            triangles.chunks_exact(3).map(of).sum::<f32>()
        };
        let arrow = [[0.0, 0.0], [20.0, 10.0], [0.0, 20.0], [10.0, 10.0]];
        assert!((area(&arrow) - 100.0).abs() < 1e-3, "{}", area(&arrow));
        // Round twice: by winding that is not zero it is filled once.
        let square = [[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0]];
        assert!((area(&[square, square].concat()) - 100.0).abs() < 1e-3);
    }
}
