//! Axis-aligned bounding boxes (behaviour chapter 05, section 2).

use serde::{Deserialize, Serialize};
use wide::f32x4;

use super::Vertices;
use crate::math::lanes::select;
use crate::math::{Vector2, scalar, vector2};

/// Minimum distance from the sides at which a point counts as inside. Absolute, in length units: for coordinates above
/// about 256 it is lost in rounding.
const CONTAINS_MARGIN: f32 = 0.00001;

/// A box with sides along the axes, in length units, screen y down. `min` is not checked against `max`.
#[doc(alias = "AABB")]
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Aabb {
    /// The corner with the smallest coordinates.
    #[doc(alias = "Min")]
    pub min: Vector2,
    /// The corner with the greatest coordinates.
    #[doc(alias = "Max")]
    pub max: Vector2,
}

impl Aabb {
    /// A box with the given corners.
    pub fn new(min: Vector2, max: Vector2) -> Aabb {
        Aabb { min, max }
    }

    /// The smallest box around the vertices; the zero box without any. A NaN in the first vertex stays, one in a later
    /// vertex is skipped.
    #[inline]
    pub fn from_vertices(vertices: &[Vector2]) -> Aabb {
        let Some(&first) = vertices.first() else {
            return Aabb::default();
        };
        let corners = |a: Vector2, b: Vector2| f32x4::new([a.x, a.y, b.x, b.y]);
        let (mut low, mut high) = (corners(first, first), corners(first, first));
        let mut widen = |two: f32x4| {
            low = select(two.simd_lt(low), two, low);
            high = select(two.simd_gt(high), two, high);
        };
        let (pairs, rest) = vertices.as_chunks::<2>();
        for &[a, b] in pairs {
            widen(corners(a, b));
        }
        for &last in rest {
            widen(corners(last, last));
        }
        let ([ax, ay, bx, by], [cx, cy, dx, dy]) = (low.to_array(), high.to_array());
        let min = Vector2::new(if bx < ax { bx } else { ax }, if by < ay { by } else { ay });
        let max = Vector2::new(if dx > cx { dx } else { cx }, if dy > cy { dy } else { cy });
        if min.x == 0.0 || min.y == 0.0 || max.x == 0.0 || max.y == 0.0 {
            // Of -0 and +0 the first one is taken.
            return Self::widened_in_order(first, vertices.iter().copied());
        }
        Aabb { min, max }
    }

    /// As [`from_vertices`](Self::from_vertices), for points of an iterator.
    pub(crate) fn from_points(mut points: impl Iterator<Item = Vector2>) -> Aabb {
        points.next().map_or_else(Aabb::default, |first| Self::widened_in_order(first, points))
    }

    fn widened_in_order(first: Vector2, others: impl Iterator<Item = Vector2>) -> Aabb {
        let (mut min, mut max) = (first, first);
        for v in others {
            if v.x < min.x {
                min.x = v.x;
            }
            if v.x > max.x {
                max.x = v.x;
            }
            if v.y < min.y {
                min.y = v.y;
            }
            if v.y > max.y {
                max.y = v.y;
            }
        }
        Aabb { min, max }
    }

    /// Extent along x, in length units.
    #[doc(alias = "Width")]
    #[inline]
    pub fn width(&self) -> f32 {
        self.max.x - self.min.x
    }

    /// Extent along y, in length units.
    #[doc(alias = "Height")]
    #[inline]
    pub fn height(&self) -> f32 {
        self.max.y - self.min.y
    }

    /// The centre as half the sum of the corners; rounds differently from [`Aabb::get_center`].
    #[doc(alias = "Position")]
    pub fn position(&self) -> Vector2 {
        Vector2::new((self.min.x + self.max.x) / 2.0, (self.min.y + self.max.y) / 2.0)
    }

    /// Moves the box to the centre `position`.
    #[doc(alias = "Position")]
    pub fn set_position(&mut self, position: Vector2) {
        let half = Vector2::new(self.width() / 2.0, self.height() / 2.0);
        self.min = position - half;
        self.max = position + half;
    }

    /// The centre as the smallest corner plus half the extent; rounds differently from [`Aabb::position`].
    #[doc(alias = "GetCenter")]
    pub fn get_center(&self) -> Vector2 {
        Vector2::new(self.min.x + self.width() / 2.0, self.min.y + self.height() / 2.0)
    }

    /// The smaller extent, in length units.
    #[doc(alias = "GetShortestSide")]
    pub fn get_shortest_side(&self) -> f32 {
        scalar::min(self.width(), self.height())
    }

    /// The corners in engine winding, beginning with `min`.
    #[doc(alias = "GetVertices")]
    pub fn get_vertices(&self) -> Vertices {
        let (min, max) = (self.min, self.max);
        Vertices::from(vec![min, Vector2::new(min.x, max.y), max, Vector2::new(max.x, min.y)])
    }

    /// Distance of a point from the box, in length units, negative inside.
    #[doc(alias = "GetDistance")]
    pub fn get_distance(&self, point: Vector2) -> f32 {
        let dx = (point.x - (self.max.x + self.min.x) * 0.5).abs() - (self.max.x - self.min.x) * 0.5;
        let dy = (point.y - (self.max.y + self.min.y) * 0.5).abs() - (self.max.y - self.min.y) * 0.5;
        if dx > 0.0 && dy > 0.0 { vector2::length(Vector2::new(dx, dy)) } else { scalar::max(dx, dy) }
    }

    /// Whether a point lies inside, more than 0.00001 length units from every side.
    ///
    /// ```
    /// use farseer_core::math::Vector2;
    /// use farseer_core::shape::Aabb;
    /// let unit = Aabb::new(Vector2::new(0.0, 0.0), Vector2::new(1.0, 1.0));
    /// assert!(unit.contains(Vector2::new(0.5, 0.5)));
    /// assert!(!unit.contains(Vector2::new(0.0, 0.5)));
    /// ```
    #[doc(alias = "Contains")]
    #[inline]
    pub fn contains(&self, point: Vector2) -> bool {
        point.x > self.min.x + CONTAINS_MARGIN
            && point.x < self.max.x - CONTAINS_MARGIN
            && point.y > self.min.y + CONTAINS_MARGIN
            && point.y < self.max.y - CONTAINS_MARGIN
    }

    /// Whether two boxes overlap or touch. A NaN counts as overlap.
    #[doc(alias = "Intersect")]
    #[inline]
    pub fn intersect(a: &Aabb, b: &Aabb) -> bool {
        !(a.min.x > b.max.x || b.min.x > a.max.x || a.min.y > b.max.y || b.min.y > a.max.y)
    }

    /// The original's hash: the truncated sums of the corners' coordinates, added (wrapping).
    #[doc(alias = "GetHashCode")]
    pub fn hash_code(&self) -> i32 {
        vector2::hash_code(self.min).wrapping_add(vector2::hash_code(self.max))
    }
}
