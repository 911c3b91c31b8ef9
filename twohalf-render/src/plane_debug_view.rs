//! The debug view of the 2D engine on a canvas.

use twohalf::farseer_core::{DebugShape, PhysicsSimulator, PhysicsSimulatorView};

use crate::text::draw_text;
use crate::{Canvas, Color, Point, Transform};

/// Px from letter to letter. The built-in letters are at most 7 px wide. With their usual 8 px the longest
/// line of the performance panel would overlap the next column.
const LETTER_ADVANCE: f32 = 7.0;
/// Px from the upper edge of a line, which is 15 px high, to its letters, which are 8 px high.
const LETTER_TOP: f32 = 4.0;

/// Draws the internal shapes of the 2D engine over a picture, one px per length unit; a [`View`](crate::View)
/// applies a camera, also to the performance panel.
///
/// [`DebugView`](crate::DebugView) is the view for objects with depth. A game as a PNG file, independent of
/// its renderer:
///
/// ```
/// use twohalf::farseer_core::{PhysicsSimulator, PhysicsSimulatorView};
/// use twohalf_render::{Canvas, Color, SoftwareCanvas, draw_debug_view};
/// # let simulator = PhysicsSimulator::default();
///
/// let mut canvas = SoftwareCanvas::new(1024, 768)?;
/// canvas.clear(Color::rgb(70, 130, 180));
/// let view = PhysicsSimulatorView { enable_edge_view: true, ..PhysicsSimulatorView::default() };
/// draw_debug_view(&view, &simulator, &mut canvas);
/// let picture = std::env::temp_dir().join("game.png");
/// canvas.save_png(&picture)?;
/// # std::fs::remove_file(picture)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[doc(alias = "PhysicsSimulatorView.Draw")]
pub fn draw_debug_view(view: &PhysicsSimulatorView, simulator: &PhysicsSimulator, canvas: &mut dyn Canvas) {
    view.draw(simulator, |shape| draw_shape(canvas, &shape));
}

fn draw_shape(canvas: &mut dyn Canvas, shape: &DebugShape) {
    match *shape {
        DebugShape::Line { start, end, thickness, color } => {
            line(canvas, &[start.into(), end.into()], false, thickness, color.into());
        }
        DebugShape::Circle { center, radius, color } => dot(canvas, center.into(), radius, color.into()),
        DebugShape::Rectangle { min, size, color } => {
            canvas.fill_rectangle(min.into(), size.into(), &Transform::IDENTITY, color.into());
        }
        DebugShape::Text { position, ref text, color } => {
            for (column, letter) in text.chars().enumerate() {
                let corner = [position.x + column as f32 * LETTER_ADVANCE, position.y + LETTER_TOP];
                draw_text(canvas, letter.encode_utf8(&mut [0; 4]), corner, 1, color.into());
            }
        }
    }
}

fn are_finite(points: &[Point]) -> bool {
    points.iter().flatten().all(|number| number.is_finite())
}

/// Draws lines from point to point, `thickness` px wide; none if a point is not finite.
pub(crate) fn line(canvas: &mut dyn Canvas, points: &[Point], is_closed: bool, thickness: f32, color: Color) {
    if !are_finite(points) {
        return;
    }
    canvas.stroke_polyline(points, is_closed, thickness, &Transform::IDENTITY, color);
}

/// Draws a filled circle; none if its centre is not finite.
pub(crate) fn dot(canvas: &mut dyn Canvas, center: Point, radius: f32, color: Color) {
    if !are_finite(&[center]) {
        return;
    }
    canvas.fill_ellipse(center, [radius; 2], &Transform::IDENTITY, color);
}
