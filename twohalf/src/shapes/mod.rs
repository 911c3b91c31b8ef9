//! Narrow-phase geometry: pure functions of points and outlines.
//!
//! Everything is in the frame of the plane, x right and y **down**, with z into the picture where there is a
//! third axis. Lengths are in px. Outlines are closed lists of vertices. Degenerate ones (one or two
//! vertices, edges of length 0) are legal everywhere; without a result the answer is `None` or `false`.

mod ball;
mod convex;
mod entry_axis;
mod nearest;
mod overlap;
mod prism_box;
mod sat;
#[cfg(test)]
mod slanted_box;
mod sweep;
mod walkable_top;

pub(crate) use ball::{ball_ball, ball_prism, ball_prism_through_face, entry_face_of_prism};
pub(crate) use convex::ConvexPieces;
pub(crate) use entry_axis::{EntryAxis, MAX_ENTRY_AGE, RESTING_SLOP_FACTOR, is_depth_last};
pub(crate) use farseer_precise::slanted_box::{Face, SlantedBox};
pub(crate) use nearest::nearest;
pub(crate) use overlap::{outlines_overlap, overlap_points, span_of};
pub(crate) use prism_box::{BoxManifold, PersistedAxis, prism_box};
pub(crate) use sat::entry_of_pieces;
pub(crate) use sweep::{Hit, Sweep, entry_of_parts};
pub(crate) use walkable_top::WalkableTop;

use farseer_core::math::{Vector2, vector2};

/// Iterates over the edges of an outline from the first vertex on, each as its two end points.
fn edges(outline: &[Vector2]) -> impl Iterator<Item = (Vector2, Vector2)> + Clone {
    let next = |i: usize| if i + 1 == outline.len() { 0 } else { i + 1 };
    (0..outline.len()).map(move |i| (outline[i], outline[next(i)]))
}

/// Returns twice the shoelace area of an outline, px²: negative in the engine's winding, 0 for fewer than three vertices.
fn doubled_area(outline: &[Vector2]) -> f32 {
    // Relative to the first vertex, so that outlines far from the origin keep their digits.
    let Some(&first) = outline.first() else { return 0.0 };
    edges(outline).map(|(a, b)| vector2::cross(a - first, b - first)).sum()
}

/// Returns whether a point lies inside an outline, by the number of edges that a ray from it crosses. A point on the outline
/// may count as inside or outside.
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

/// Returns the cross product of `b - a` and `point - a` in double precision, px². Its sign tells on which side of the edge from
/// `a` to `b` the point lies.
fn cross64(a: Vector2, b: Vector2, point: Vector2) -> f64 {
    let wide = |v: Vector2| (f64::from(v.x), f64::from(v.y));
    let ((ax, ay), (bx, by), (px, py)) = (wide(a), wide(b), wide(point));
    (bx - ax) * (py - ay) - (by - ay) * (px - ax)
}

#[cfg(test)]
mod samples {
    //! Random numbers and outlines for the tests.

    use farseer_core::math::{Vector2, vector2};

    /// The linear congruential generator of Knuth's MMIX.
    pub(super) struct Random(pub(super) u64);

    impl Random {
        pub(super) fn number(&mut self, least: f32, greatest: f32) -> f32 {
            self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            let part = (self.0 >> 40) as f32 / (1_u64 << 24) as f32;
            least + (greatest - least) * part
        }

        pub(super) fn point(&mut self, range: f32) -> Vector2 {
            Vector2::new(self.number(-range, range), self.number(-range, range))
        }

        /// An outline with a vertex in each of `count` directions from `middle`, in the engine's winding, convex if
        /// `concavity`, 0 to 1, is 0.
        pub(super) fn star(
            &mut self,
            middle: Vector2,
            count: usize,
            size: f32,
            concavity: f32,
        ) -> Vec<Vector2> {
            let start = self.number(0.0, 1.0);
            let at = |turn: f32| {
                let angle = f64::from(turn) * std::f64::consts::TAU;
                Vector2::new(libm::cos(angle) as f32, -libm::sin(angle) as f32)
            };
            (0..count)
                .map(|i| {
                    let radius = size * (1.0 - concavity * self.number(0.0, 0.9));
                    middle + at((i as f32 + start) / count as f32) * radius
                })
                .collect()
        }
    }

    pub(super) fn points(list: &[(f32, f32)]) -> Vec<Vector2> {
        list.iter().map(|&(x, y)| Vector2::new(x, y)).collect()
    }

    /// A rectangle in the engine's winding, turned about its middle.
    pub(super) fn rectangle(middle: (f32, f32), width: f32, height: f32, angle: f64) -> Vec<Vector2> {
        let (sin, cos) = (libm::sin(angle) as f32, libm::cos(angle) as f32);
        let (x, y) = (width * 0.5, height * 0.5);
        [(-x, -y), (-x, y), (x, y), (x, -y)]
            .map(|(x, y)| Vector2::new(middle.0 + x * cos - y * sin, middle.1 + x * sin + y * cos))
            .to_vec()
    }

    /// Returns whether a point is inside an outline, by the angle that the outline turns around it.
    pub(super) fn winds_around(outline: &[Vector2], point: Vector2) -> bool {
        let angle = |from: Vector2, to: Vector2| {
            libm::atan2(f64::from(vector2::cross(from, to)), f64::from(vector2::dot(from, to)))
        };
        let turned: f64 = super::edges(outline).map(|(a, b)| angle(a - point, b - point)).sum();
        turned.abs() > std::f64::consts::PI
    }
}
