//! The stage of a 2.5D scene: sky, horizon and a tiled floor whose lines show depth.

use crate::canvas::MAX_COORDINATE;
use crate::error::check_range;
use crate::{Canvas, Color, Point, Result, Texture2D, Transform};

/// Narrowest floor tile, px: below, lines would run together.
const MIN_SPACING: f32 = 4.0;

/// Slope of the flattest depth line that is drawn, px to the side per px of depth: an angle of about 3
/// degrees. Flatter ones look like the lines across.
const MAX_SLOPE: f32 = 20.0;

/// Greatest number of rows of the gradients, and of lines side by side: as many as a canvas has px.
const MAX_ROWS: f32 = crate::MAX_SIDE as f32;

/// Colours and sizes of a ground backdrop. The floor is the plane Y = 0 as the engine projects it. Depth Z
/// goes up the screen, one px per px, from the lower edge (Z = 0) to the horizon. It leans to the side by the
/// angle of the Z axis.
#[derive(Debug, Clone, PartialEq)]
pub struct GroundBackdrop {
    /// Z of the horizon in px, greater than 0: height of the floor on the screen.
    pub depth: f32,
    /// Direction of the Z axis on the screen in degrees, counterclockwise from the x axis, between 0 and 180;
    /// as the simulator's. 90 goes straight up, 45 up and to the right.
    pub angle: f32,
    /// Side of a floor tile in X and Z, px, 4 or more.
    pub spacing: f32,
    /// Sky at the upper edge.
    pub sky_top: Color,
    /// Sky at the horizon.
    pub sky_horizon: Color,
    /// Floor at the lower edge, nearest to the viewer.
    pub floor_near: Color,
    /// Floor at the horizon.
    pub floor_far: Color,
    /// Lines between the tiles; they grow fainter and thinner with depth.
    pub lines: Color,
}

impl GroundBackdrop {
    /// A bright floor under a blue sky, tiles of 50 px.
    pub fn new(depth: f32, angle: f32) -> Self {
        GroundBackdrop {
            depth,
            angle,
            spacing: 50.0,
            sky_top: Color::rgb(92, 148, 206),
            sky_horizon: Color::rgb(226, 238, 244),
            floor_near: Color::rgb(214, 184, 140),
            floor_far: Color::rgb(222, 216, 204),
            lines: Color::rgba(96, 66, 36, 150),
        }
    }

    /// A dark floor under an evening sky.
    pub fn dusk(depth: f32, angle: f32) -> Self {
        GroundBackdrop {
            sky_top: Color::rgb(58, 52, 110),
            sky_horizon: Color::rgb(250, 168, 110),
            floor_near: Color::rgb(70, 62, 70),
            floor_far: Color::rgb(122, 100, 104),
            ..GroundBackdrop::new(depth, angle)
        }
    }
}

/// Draws sky, floor and the floor's grid over the visible area of the canvas: through a [`View`](crate::View)
/// the floor scrolls. The height of the canvas counts as the simulator's.
///
/// Depth shows by tiles of alternating shade, lines across at equal steps of Z, and lines along Z at the Z
/// axis' angle. All of it is paler and thinner towards the horizon.
///
/// An animation draws it once and begins each frame with a clone of that canvas.
///
/// # Errors
/// `depth` or `spacing` out of range, `angle` not between 0 and 180, or one of them not finite. A failed call
/// draws nothing.
pub fn draw_ground_backdrop(canvas: &mut dyn Canvas, backdrop: &GroundBackdrop) -> Result<()> {
    let GroundBackdrop { depth, angle, spacing, .. } = *backdrop;
    check_range("depth", depth, f32::MIN_POSITIVE..=MAX_COORDINATE, "greater than 0, at most 1e6 px")?;
    check_range("angle", angle, f32::MIN_POSITIVE..=180.0_f32.next_down(), "between 0 and 180 degrees")?;
    check_range("spacing", spacing, MIN_SPACING..=MAX_COORDINATE, "4 to 1e6 px")?;
    let (sin, cos) = libm::sincos(f64::from(angle).to_radians());
    let height = canvas.size()[1] as f32;
    let [[left, top], [right, bottom]] = canvas.visible_area();
    let floor = Floor { slope: (cos / sin) as f32, left, right, height, backdrop };
    draw_gradients(canvas, backdrop, [left, right], [top, bottom]);
    floor.draw_tiles(canvas);
    floor.draw_lines(canvas);
    Ok(())
}

/// Draws a far layer of a scene behind it: a texture, repeated to the left and to the right over the visible
/// area, with its upper edge at `top` px.
///
/// Through a [`View`](crate::View) that scrolls, the layer moves `factor` times as fast as the scene: at 1
/// with it, at 0 not at all, as the sky; hills lie between. A number that is not finite, or more than 16,384
/// visible pieces, draw nothing.
///
/// On a [`SoftwareCanvas`](crate::SoftwareCanvas) a layer of the size at which it is shown, moved by whole
/// px, is copied, which takes an eighth of the time. To use this, paint it at its zoom, round the camera's
/// position times `factor`, and set `factor` to 1 here.
pub fn draw_parallax_layer(canvas: &mut dyn Canvas, texture: &Texture2D, top: f32, factor: f32) {
    let [[left, _], [right, _]] = canvas.visible_area();
    let width = texture.width() as f32;
    let shift = left * (1.0 - factor);
    let [first, last] = [((left - shift) / width).floor(), ((right - shift) / width).ceil()];
    if !top.is_finite() || !(0.0..=MAX_ROWS).contains(&(last - first)) {
        return;
    }
    for piece in 0..(last - first) as u32 {
        let corner = [shift + (first + piece as f32) * width, top];
        canvas.draw_texture(texture, &Transform::translation(corner), Color::WHITE, None);
    }
}

/// Draws sky and floor in rows of one px.
fn draw_gradients(
    canvas: &mut dyn Canvas,
    backdrop: &GroundBackdrop,
    [left, right]: Point,
    [top, bottom]: Point,
) {
    let height = canvas.size()[1] as f32;
    let horizon = height - backdrop.depth;
    let [first, last] = [top.floor(), bottom.ceil()];
    // A camera may zoom out without limit; more rows than this are not distinguishable.
    let step = ((last - first) / MAX_ROWS).ceil().max(1.0);
    let is_plain = [top, bottom] == [0.0, height];
    // Rows that do not end at pixel borders overlap, so that no gap shows between them.
    let overlap = if is_plain { 0.0 } else { step };
    let rows = (0..).map(|row| first + row as f32 * step).take_while(|&row| row < last);
    for row in rows {
        let y = row + 0.5 * step;
        let color = if y < horizon {
            // Squared: most of the change lies near the horizon, as in air.
            let t = (y / horizon).max(0.0);
            backdrop.sky_top.lerp(backdrop.sky_horizon, t * t)
        } else {
            backdrop.floor_near.lerp(backdrop.floor_far, (height - y) / backdrop.depth)
        };
        let [corner, size] = [[left, row], [right - left, step + overlap]];
        canvas.fill_rectangle(corner, size, &Transform::IDENTITY, color);
    }
}

/// The floor's grid on the screen.
struct Floor<'a> {
    /// Px to the right per px of depth: the cotangent of the Z axis' angle.
    slope: f32,
    /// Least visible x, px.
    left: f32,
    /// Greatest visible x, px.
    right: f32,
    /// Height of the canvas, px.
    height: f32,
    backdrop: &'a GroundBackdrop,
}

impl Floor<'_> {
    /// Projection of a point of the floor, px.
    fn project(&self, x: f32, z: f32) -> Point {
        [x + z * self.slope, self.height - z]
    }

    /// Number, nearest and farthest Z of each visible row of tiles, from near to far, px.
    fn rows(&self) -> impl Iterator<Item = (i32, f32, f32)> {
        let GroundBackdrop { spacing, depth, .. } = *self.backdrop;
        let depth = depth.min(self.height);
        let rows = (depth / spacing).ceil() as i32;
        (0..rows).map(move |row| (row, row as f32 * spacing, ((row + 1) as f32 * spacing).min(depth)))
    }

    /// Numbers of the depth lines that cross the screen between two depths; one is at X = number * spacing.
    fn columns(&self, near: f32, far: f32) -> std::ops::Range<i32> {
        if self.slope.abs() > MAX_SLOPE {
            return 0..0;
        }
        let shifts = [near * self.slope, far * self.slope];
        let first = ((self.left - shifts[0].max(shifts[1])) / self.backdrop.spacing).floor();
        let last = ((self.right - shifts[0].min(shifts[1])) / self.backdrop.spacing).ceil();
        // Lines that are not distinguishable are left out.
        if last - first > MAX_ROWS { 0..0 } else { first as i32..(last as i32).saturating_add(1) }
    }

    /// Contrast that the air leaves at a depth, as a fraction: 1 near, a quarter at the horizon.
    fn contrast(&self, z: f32) -> f32 {
        1.0 - 0.75 * (z / self.backdrop.depth)
    }

    fn draw_tiles(&self, canvas: &mut dyn Canvas) {
        let spacing = self.backdrop.spacing;
        for (row, near, far) in self.rows() {
            let color = self.backdrop.lines.with_opacity(0.22 * self.contrast(near));
            for column in self.columns(near, far).filter(|column| (column + row) % 2 == 0) {
                let [left, right] = [column as f32 * spacing, (column + 1) as f32 * spacing];
                let tile = [
                    self.project(left, near),
                    self.project(right, near),
                    self.project(right, far),
                    self.project(left, far),
                ];
                canvas.fill_polygon(&tile, &Transform::IDENTITY, color);
            }
        }
    }

    fn draw_lines(&self, canvas: &mut dyn Canvas) {
        for (_, near, far) in self.rows() {
            let color = self.backdrop.lines.with_opacity(self.contrast(near));
            let width = 0.6 + 1.2 * self.contrast(near);
            let y = self.height - near;
            let across = [[self.left, y], [self.right, y]];
            canvas.stroke_polyline(&across, false, width, &Transform::IDENTITY, color);
            for column in self.columns(near, far) {
                let x = column as f32 * self.backdrop.spacing;
                let line = [self.project(x, near), self.project(x, far)];
                canvas.stroke_polyline(&line, false, width, &Transform::IDENTITY, color);
            }
        }
        let y = self.height - self.backdrop.depth;
        let horizon = self.backdrop.lines.with_opacity(0.5);
        canvas.stroke_polyline(&[[self.left, y], [self.right, y]], false, 1.5, &Transform::IDENTITY, horizon);
    }
}
