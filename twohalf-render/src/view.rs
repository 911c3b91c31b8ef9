//! A canvas seen through a camera, or through a window.

use crate::clip::clip_to_convex;
use crate::outline_of_line::outline_of_line;
use crate::{Canvas, Color, Point, Rectangle, Texture2D, Transform};

/// Number of corners of a polygon that replaces an ellipse that is clipped.
const ELLIPSE_CORNERS: u16 = 64;
/// Margin around the visible area of a view that is clipped at rows, px: greater than the width of lines.
const ASIDE: f32 = 64.0;

/// A canvas seen through a camera and a rectangle outside of which it is not drawn on. It is a canvas itself.
/// So sprites, debug views, backdrops, scenes and text can be scrolled, zoomed, rotated or shown in a part of
/// the screen.
///
/// Two players beside each other:
///
/// ```
/// # use twohalf_render::*;
/// # let simulator = twohalf::TwoHalfPhysicsSimulator::new(200)?;
/// let mut canvas = SoftwareCanvas::new(320, 200)?;
/// for (side, player) in [(0, [90.0, 60.0]), (160, [700.0, 60.0])] {
///     let half = Rectangle::new(side, 0, 160, 200);
///     let camera = Transform::camera(player, 1.5, 0.0, [side as f32 + 80.0, 100.0]);
///     let mut view = View::new(&mut canvas).camera(&camera).clip(half);
///     draw_ground_backdrop(&mut view, &GroundBackdrop::new(120.0, 60.0))?;
///     DebugView::default().draw(&simulator, &mut view);
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// Widths of lines are in px of the canvas, whatever the camera. With a rectangle, joints of lines across its border
/// are cut flat instead of round, and [`clear`](Canvas::clear) fills it, so that a translucent colour blends.
pub struct View<'a> {
    canvas: &'a mut dyn Canvas,
    camera: Transform,
    /// Corners of the rectangle, clockwise from the upper left one.
    clip: Option<[Point; 4]>,
}

impl<'a> View<'a> {
    /// The canvas as it is.
    pub fn new(canvas: &'a mut dyn Canvas) -> Self {
        View { canvas, camera: Transform::IDENTITY, clip: None }
    }

    /// The same with this camera, which takes drawn points to the canvas; see [`Transform::camera`].
    pub fn camera(self, camera: &Transform) -> Self {
        View { camera: *camera, ..self }
    }

    /// The same, clipped to this rectangle of the canvas.
    #[doc(alias = "ScissorRectangle")]
    pub fn clip(self, rectangle: Rectangle) -> Self {
        View { clip: Some(rectangle.corners()), ..self }
    }

    /// The same, clipped above and below two rows of the canvas, px.
    pub(crate) fn clip_rows(self, [from, to]: [f32; 2]) -> Self {
        let [low, high] = self.canvas.visible_area();
        let [left, right] = [low[0] - ASIDE, high[0] + ASIDE];
        let [top, bottom] = [from.max(low[1] - ASIDE), to.min(high[1] + ASIDE)];
        View { clip: Some([[left, top], [right, top], [right, bottom], [left, bottom]]), ..self }
    }

    /// Takes points that are on the canvas already, through the rectangle.
    fn fill_on_canvas(&mut self, points: &[Point], color: Color) {
        match self.clip {
            Some(clip) => {
                let inside = clip_to_convex(points, &clip);
                self.canvas.fill_polygon(&inside, &Transform::IDENTITY, color);
            }
            None => self.canvas.fill_polygon(points, &Transform::IDENTITY, color),
        }
    }

    /// Whether everything within `margin` px of these points of the canvas is drawn.
    fn holds(&self, points: &[Point], margin: f32) -> bool {
        let Some(clip) = self.clip else { return true };
        let [low, _, high, _] = clip;
        let is_inside = |axis: usize, at: f32| at - margin >= low[axis] && at + margin <= high[axis];
        points.iter().all(|point| is_inside(0, point[0]) && is_inside(1, point[1]))
    }

    /// The part of the canvas that is drawn on, as corners clockwise from the upper left one. The canvas may
    /// be a view itself.
    fn window(&self) -> [Point; 4] {
        let [low, high] = self.canvas.visible_area();
        let all = [low, [high[0], low[1]], high, [low[0], high[1]]];
        let within = |corner: Point| [0, 1].map(|axis| corner[axis].max(low[axis]).min(high[axis]));
        self.clip.map_or(all, |clip| clip.map(within))
    }
}

impl Canvas for View<'_> {
    fn size(&self) -> [u32; 2] {
        self.canvas.size()
    }

    fn visible_area(&self) -> [Point; 2] {
        let Some(back) = self.camera.inverse() else { return [[0.0; 2]; 2] };
        let corners = self.window().map(|corner| back.apply(corner));
        let bound = |axis: usize, pick: fn(f32, f32) -> f32| {
            corners.iter().map(|corner| corner[axis]).reduce(pick).unwrap_or(0.0)
        };
        [[bound(0, f32::min), bound(1, f32::min)], [bound(0, f32::max), bound(1, f32::max)]]
    }

    fn clear(&mut self, color: Color) {
        match self.clip {
            Some(clip) => self.canvas.fill_polygon(&clip, &Transform::IDENTITY, color),
            None => self.canvas.clear(color),
        }
    }

    fn fill_polygon(&mut self, points: &[Point], transform: &Transform, color: Color) {
        let transform = transform.then(&self.camera);
        if self.clip.is_none() {
            return self.canvas.fill_polygon(points, &transform, color);
        }
        let points: Vec<Point> = points.iter().map(|&point| transform.apply(point)).collect();
        if points.iter().flatten().all(|number| number.is_finite()) {
            self.fill_on_canvas(&points, color);
        }
    }

    fn fill_ellipse(&mut self, center: Point, radii: Point, transform: &Transform, color: Color) {
        let whole = transform.then(&self.camera);
        let [[x, y], [rx, ry]] = [center, radii];
        let corners = [[x - rx, y - ry], [x + rx, y - ry], [x + rx, y + ry], [x - rx, y + ry]];
        if self.holds(&corners.map(|corner| whole.apply(corner)), 0.0) {
            return self.canvas.fill_ellipse(center, radii, &whole, color);
        }
        if rx > 0.0 && ry > 0.0 {
            let corner = |index| {
                let turn = f64::from(index) / f64::from(ELLIPSE_CORNERS) * std::f64::consts::TAU;
                let (sin, cos) = libm::sincos(turn);
                [x + rx * cos as f32, y + ry * sin as f32]
            };
            let corners: Vec<Point> = (0..ELLIPSE_CORNERS).map(corner).collect();
            self.fill_polygon(&corners, transform, color);
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
        let transform = transform.then(&self.camera);
        if self.clip.is_none() {
            return self.canvas.stroke_polyline(points, closed, width, &transform, color);
        }
        let points: Vec<Point> = points.iter().map(|&point| transform.apply(point)).collect();
        // Joints are round: every point of a line is within half of its width of its centre line.
        if self.holds(&points, 0.5 * width) {
            self.canvas.stroke_polyline(&points, closed, width, &Transform::IDENTITY, color);
        } else if width > 0.0 && points.iter().flatten().all(|number| number.is_finite()) {
            self.fill_on_canvas(&outline_of_line(&points, closed, width), color);
        }
    }

    fn draw_texture(
        &mut self,
        texture: &Texture2D,
        transform: &Transform,
        tint: Color,
        clip: Option<&[Point]>,
    ) {
        let transform = transform.then(&self.camera);
        let on_canvas: Option<Vec<Point>> =
            clip.map(|clip| clip.iter().map(|&corner| self.camera.apply(corner)).collect());
        let inside = match (&on_canvas, self.clip) {
            (Some(clip), _) if !clip.iter().flatten().all(|number| number.is_finite()) => return,
            (Some(clip), Some(window)) => Some(clip_to_convex(clip, &window)),
            (None, Some(window)) => Some(window.to_vec()),
            (clip, None) => clip.clone(),
        };
        self.canvas.draw_texture(texture, &transform, tint, inside.as_deref());
    }
}

impl std::fmt::Debug for View<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "View({:?}, {:?})", self.camera, self.clip)
    }
}
