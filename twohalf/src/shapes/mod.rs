//! Geometry of the contacts in space: pure functions of points and outlines.
//!
//! Everything is in the plane's frame, x right and y **down**, with z into the picture where there is a third axis;
//! lengths are in the user's unit. Outlines are lists of vertices whose last is joined to the first. Degenerate
//! ones (one or two vertices, edges of length 0) are legal everywhere: what has no answer is `None` or `false`.

mod ball;
mod convex;
mod nearest;
mod overlap;
mod prism_box;
mod sat;
mod slanted_box;

pub(crate) use ball::{
    BallTouch, Touch, ball_ball, ball_prism, ball_prism_through_face, entry_face_of_prism,
};
pub(crate) use convex::{ConvexPieces, is_convex};
pub(crate) use nearest::{Nearest, nearest};
pub(crate) use overlap::{outlines_overlap, overlap_points, span_of};
pub(crate) use prism_box::{BoxManifold, BoxPoint, KeptAxis, prism_box};
pub(crate) use sat::{Entry, entry, entry_of_pieces};
pub(crate) use slanted_box::{BoxTouch, Face, SlantedBox};

use farseer_core::math::{Vector2, vector2};

/// The edges of an outline, as their ends, from the first vertex on.
fn edges(outline: &[Vector2]) -> impl Iterator<Item = (Vector2, Vector2)> + Clone {
    let ends = outline.iter().cycle().skip(1);
    outline.iter().copied().zip(ends.copied())
}

/// Twice the shoelace area: negative in the engine's winding, 0 for fewer than three vertices.
fn doubled_area(outline: &[Vector2]) -> f32 {
    // Relative to the first vertex, so that outlines far from the origin keep their digits.
    let Some(&first) = outline.first() else { return 0.0 };
    edges(outline).map(|(a, b)| vector2::cross(a - first, b - first)).sum()
}

/// Whether a point lies inside an outline, by the number of edges that a ray from it crosses. A point on the
/// outline is on either side.
fn contains(outline: &[Vector2], point: Vector2) -> bool {
    let mut is_inside = false;
    for (a, b) in edges(outline) {
        if (a.y > point.y) != (b.y > point.y) {
            let side = cross64(a, b, point);
            is_inside ^= (side > 0.0) == (b.y > a.y);
        }
    }
    is_inside
}

/// Cross product of `b - a` and `point - a`, without the rounding of f32: which side of an edge a point lies on.
fn cross64(a: Vector2, b: Vector2, point: Vector2) -> f64 {
    let wide = |v: Vector2| (f64::from(v.x), f64::from(v.y));
    let ((ax, ay), (bx, by), (px, py)) = (wide(a), wide(b), wide(point));
    (bx - ax) * (py - ay) - (by - ay) * (px - ax)
}
