//! Solids that stand upright, such as cylinders and capsules.

use twohalf::{DepthProfile, TwoHalfGeom, TwoHalfPhysicsSimulator, Vector3};

use crate::corners::cross;
use crate::footprint::footprint_of;
use crate::surface::to_screen;
use crate::{Canvas, PlatformLook, Point, Transform};

const STILL: Transform = Transform::IDENTITY;
/// Number of corners of each round end of a capsule.
const END_CORNERS: u32 = 12;

/// Draws an upright geom; returns whether the geom is one.
pub(super) fn draw_upright(
    simulator: &TwoHalfPhysicsSimulator,
    canvas: &mut dyn Canvas,
    geom: &TwoHalfGeom<'_>,
    look: &PlatformLook,
) -> bool {
    let Some(footprint) = footprint_of(geom) else { return false };
    if let DepthProfile::Capsule { radius, .. } = geom.depth_profile() {
        draw_capsule(simulator, canvas, geom, radius, look);
        return true;
    }
    let shape = geom.virtual_geom();
    let at = |y: f32| -> Vec<Point> {
        footprint.iter().map(|&[x, z]| to_screen(simulator, Vector3::new(x, y, z))).collect()
    };
    let (bottom, top) = (at(shape.bottom), at(shape.top));
    let count = footprint.len();
    let corner = |at: usize| at % count;
    let is_seen = |from: usize| {
        let (from, to) = (corner(from), corner(from + 1));
        cross(top[from], top[to], bottom[to]) < 0.0
    };
    for from in (0..count).filter(|&from| is_seen(from)) {
        let to = corner(from + 1);
        // Sides that face to the left or right are darker.
        let ([ax, az], [bx, bz]) = (footprint[from], footprint[to]);
        let aside = (bz - az).abs() / ((bx - ax).powi(2) + (bz - az).powi(2)).sqrt().max(f32::MIN_POSITIVE);
        let color = look.front.lerp(look.sides, aside);
        // Round shapes are drawn up to the end of the next side, which is drawn over this one, so that no gap
        // is seen between them.
        let end = if shape.is_round && is_seen(from + 1) { from + 2 } else { from + 1 };
        let upper = (from..=end).map(|at| top[corner(at)]);
        let side: Vec<Point> = upper.chain((from..=end).rev().map(|at| bottom[corner(at)])).collect();
        canvas.fill_polygon(&side, &STILL, color);
    }
    for from in (0..count).filter(|&from| is_seen(from)) {
        let to = corner(from + 1);
        canvas.stroke_polyline(&[bottom[from], bottom[to]], false, look.edge_width, &STILL, look.edges);
        // The sides of a round shape end where the shape's silhouette is.
        let ends = [(from, is_seen(from + count - 1)), (to, is_seen(to))];
        for (at, goes_on) in ends {
            if !(shape.is_round && goes_on) {
                let line = [top[at], bottom[at]];
                canvas.stroke_polyline(&line, false, look.edge_width, &STILL, look.edges);
            }
        }
    }
    canvas.fill_polygon(&top, &STILL, look.top);
    canvas.stroke_polyline(&top, true, look.edge_width, &STILL, look.edges);
    true
}

/// Draws a capsule as a flat outline, as balls are drawn.
fn draw_capsule(
    simulator: &TwoHalfPhysicsSimulator,
    canvas: &mut dyn Canvas,
    geom: &TwoHalfGeom<'_>,
    radius: f32,
    look: &PlatformLook,
) {
    let shape = geom.virtual_geom();
    let (x, z) = (0.5 * (shape.left + shape.right), 0.5 * (shape.front + shape.back));
    let end = |y: f32, first: f64| {
        (0..=END_CORNERS).map(move |at| {
            let angle = first + std::f64::consts::PI * f64::from(at) / f64::from(END_CORNERS);
            let (sin, cos) = libm::sincos(angle);
            Vector3::new(x + radius * cos as f32, y + radius * sin as f32, z)
        })
    };
    let upper = end(shape.top - radius, 0.0);
    let outline = upper.chain(end(shape.bottom + radius, std::f64::consts::PI));
    let outline: Vec<Point> = outline.map(|point| to_screen(simulator, point)).collect();
    canvas.fill_polygon(&outline, &STILL, look.front);
    canvas.stroke_polyline(&outline, true, look.edge_width, &STILL, look.edges);
}
