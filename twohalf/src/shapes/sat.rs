//! How deep two convex outlines overlap, and since when.
//!
//! Frame: the plane's. Separating axes (Gottschalk, Lin and Manocha, *OBBTree*, 1996; Ericson, *Real-Time Collision
//! Detection*, 5.5.8 for moving shapes): two convex outlines overlap if their projections on the normals of all
//! edges do; they have overlapped since the last of these axes was entered. Either winding will do.

use farseer_core::math::{Vector2, vector2};

use super::edges;

/// An overlap of two outlines.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Entry {
    /// For how long they have overlapped if they always moved as now, s; infinite if they do not approach.
    pub(crate) time: f32,
    /// The least way that separates them.
    pub(crate) penetration: f32,
    /// In which direction the second has to go that way: of length 1, from the first to the second.
    pub(crate) normal: Vector2,
}

/// The range of the points along an axis, `(least, greatest)`.
fn project(points: &[Vector2], axis: Vector2) -> (f32, f32) {
    points.iter().fold((f32::INFINITY, f32::NEG_INFINITY), |(least, greatest), point| {
        let along = vector2::dot(*point, axis);
        (least.min(along), greatest.max(along))
    })
}

/// The overlap of two convex outlines that move relative to each other; `None` if they do not overlap, or only touch.
pub(crate) fn entry(a: &[Vector2], b: &[Vector2], velocity_of_b: Vector2) -> Option<Entry> {
    let mut found: Option<Entry> = None;
    for (start, end) in edges(a).chain(edges(b)) {
        let edge = end - start;
        let length = vector2::length(edge);
        if length <= 0.0 {
            continue;
        }
        let axis = Vector2::new(-edge.y / length, edge.x / length);
        let (min_a, max_a) = project(a, axis);
        let (min_b, max_b) = project(b, axis);
        for (penetration, normal) in [(max_a - min_b, axis), (max_b - min_a, -axis)] {
            if !(penetration > 0.0 && penetration.is_finite()) {
                return None;
            }
            let closing = -vector2::dot(velocity_of_b, normal);
            let time = if closing > 0.0 { penetration / closing } else { f32::INFINITY };
            found = Some(match found {
                None => Entry { time, penetration, normal },
                Some(found) if penetration < found.penetration => {
                    Entry { time: found.time.min(time), penetration, normal }
                }
                Some(found) => Entry { time: found.time.min(time), ..found },
            });
        }
    }
    found
}

/// The overlap of two outlines of convex pieces: since when the first pair of pieces has overlapped, and the
/// penetration of the deepest pair. `b` gives the second outline's pieces anew for each piece of the first.
pub(crate) fn entry_of_pieces<'a, I, J>(a: I, b: impl Fn() -> J, velocity_of_b: Vector2) -> Option<Entry>
where
    I: Iterator<Item = &'a [Vector2]>,
    J: Iterator<Item = &'a [Vector2]>,
{
    let mut found: Option<Entry> = None;
    for piece_a in a {
        for piece_b in b() {
            let Some(pair) = entry(piece_a, piece_b, velocity_of_b) else { continue };
            let deepest = found.filter(|found| found.penetration >= pair.penetration).unwrap_or(pair);
            let time = found.map_or(pair.time, |found| found.time.max(pair.time));
            found = Some(Entry { time, ..deepest });
        }
    }
    found
}
