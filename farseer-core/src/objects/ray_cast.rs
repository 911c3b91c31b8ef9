//! Ray casts and box queries. Ours: the original has other queries.

use super::Objects;
use crate::geom::GeomId;
use crate::geom::entry::GeomEntry;
use crate::math::Vector2;
use crate::shape::Aabb;
use crate::storage::order::sort_by_number;

/// The point at which a ray enters a geom.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RayCastHit {
    /// The geom.
    pub geom: GeomId,
    /// The point on the geom's outline, in the world.
    pub point: Vector2,
    /// Outward unit normal of the outline at the point: against the ray.
    pub normal: Vector2,
    /// Fraction of the distance from the start to the end of the ray, from 0 to 1.
    pub fraction: f32,
}

impl Objects {
    /// The first geom that a ray from `start` to `end` enters; of several at the same distance, the first in list
    /// order.
    ///
    /// No geom is filtered out: for rays that pass through some geoms take the first other one of
    /// [`ray_cast_all`](Self::ray_cast_all). Outlines are polygons, also those of circles and capsules; a chain is
    /// entered through its edges, from their free side. A geom that contains the start is hit only where the ray enters
    /// it again; a ray that only grazes an edge may hit or miss it. Disposed geoms are not hit, though they stay listed
    /// until the next update. A ray that ends where it starts, or is not finite, hits no geom.
    ///
    /// The box of every listed geom is tested: the time grows with their number. A simulator with the precise set uses
    /// its grid instead.
    pub fn ray_cast(&self, start: Vector2, end: Vector2) -> Option<RayCastHit> {
        self.ray_cast_among(self.geoms.list(), start, end)
    }

    pub(crate) fn ray_cast_among(
        &self,
        geoms: &[GeomId],
        start: Vector2,
        end: Vector2,
    ) -> Option<RayCastHit> {
        let ray = Ray::new(start, end)?;
        let hits = geoms.iter().filter_map(|&geom| self.first_hit(&ray, geom));
        let nearest = hits.reduce(|nearest, hit| if hit.0 < nearest.0 { hit } else { nearest });
        nearest.map(|(_, hit)| hit)
    }

    /// Every geom that a ray from `start` to `end` enters, once each at its first entry, ordered by distance, and in
    /// list order at equal distances. See [`ray_cast`](Self::ray_cast).
    pub fn ray_cast_all(&self, start: Vector2, end: Vector2) -> Vec<RayCastHit> {
        self.ray_cast_all_among(self.geoms.list(), start, end)
    }

    pub(crate) fn ray_cast_all_among(
        &self,
        geoms: &[GeomId],
        start: Vector2,
        end: Vector2,
    ) -> Vec<RayCastHit> {
        let Some(ray) = Ray::new(start, end) else { return Vec::new() };
        let mut hits: Vec<(f64, RayCastHit)> =
            geoms.iter().filter_map(|&geom| self.first_hit(&ray, geom)).collect();
        // Fractions are 0 or more: such numbers are ordered as their bits are. The sum makes -0 and +0 equal.
        sort_by_number(&mut hits, |(fraction, _)| (fraction + 0.0).to_bits().into());
        hits.into_iter().map(|(_, hit)| hit).collect()
    }

    /// The geoms whose [boxes](crate::GeomRef::aabb) overlap or touch a box, in list order, without disposed ones. None
    /// if a coordinate is not finite, or `min` is greater than `max`. For the costs see [`ray_cast`](Self::ray_cast).
    pub fn query_aabb(&self, aabb: &Aabb) -> Vec<GeomId> {
        self.query_aabb_among(self.geoms.list(), aabb)
    }

    pub(crate) fn query_aabb_among(&self, geoms: &[GeomId], aabb: &Aabb) -> Vec<GeomId> {
        let is_finite = |v: Vector2| v.x.is_finite() && v.y.is_finite();
        let is_box = aabb.min.x <= aabb.max.x && aabb.min.y <= aabb.max.y;
        if !is_finite(aabb.min) || !is_finite(aabb.max) || !is_box {
            return Vec::new();
        }
        let overlaps = |&geom: &GeomId| {
            !self.is_disposed(geom)
                && self
                    .with_current_transform(geom, |geom| Aabb::intersect(&geom.aabb, aabb))
                    .unwrap_or(false)
        };
        geoms.iter().copied().filter(overlaps).collect()
    }

    /// The first hit of a ray from `start` to `end` on the polygon of a geom, with the fraction in double precision.
    #[cfg(feature = "precise")]
    pub(crate) fn first_hit_of_ray(
        &self,
        start: Vector2,
        end: Vector2,
        geom: GeomId,
    ) -> Option<(f64, RayCastHit)> {
        self.first_hit(&Ray::new(start, end)?, geom)
    }

    /// The first hit of a ray on a geom, with the fraction in double precision.
    fn first_hit(&self, ray: &Ray, id: GeomId) -> Option<(f64, RayCastHit)> {
        if self.is_disposed(id) {
            return None;
        }
        self.with_current_transform(id, |geom| {
            let (fraction, edge) = ray.first_entry(geom)?;
            let point = ray.start.zip(ray.direction, |start, way| start + way * fraction);
            let length = (edge.x * edge.x + edge.y * edge.y).sqrt();
            let normal = Vector2::new((-edge.y / length) as f32, (edge.x / length) as f32);
            let point = Vector2::new(point.x as f32, point.y as f32);
            Some((fraction, RayCastHit { geom: id, point, normal, fraction: fraction as f32 }))
        })
        .flatten()
    }
}

/// A vector in double precision: differences of floats, and products of two of them, are exact or nearly so.
#[derive(Debug, Clone, Copy)]
struct DoubleVector {
    x: f64,
    y: f64,
}

impl DoubleVector {
    fn of(v: Vector2) -> Self {
        DoubleVector { x: f64::from(v.x), y: f64::from(v.y) }
    }

    fn zip(self, other: DoubleVector, f: impl Fn(f64, f64) -> f64) -> Self {
        DoubleVector { x: f(self.x, other.x), y: f(self.y, other.y) }
    }

    fn minus(self, other: DoubleVector) -> Self {
        self.zip(other, |a, b| a - b)
    }

    fn cross(self, other: DoubleVector) -> f64 {
        self.x * other.y - self.y * other.x
    }
}

struct Ray {
    start: DoubleVector,
    direction: DoubleVector,
    aabb: Aabb,
}

impl Ray {
    /// `None` for a ray without a direction.
    fn new(start: Vector2, end: Vector2) -> Option<Self> {
        let is_finite = [start.x, start.y, end.x, end.y].iter().all(|value| value.is_finite());
        (is_finite && start != end).then(|| Ray {
            start: DoubleVector::of(start),
            direction: DoubleVector::of(end).minus(DoubleVector::of(start)),
            aabb: Aabb::from_vertices(&[start, end]),
        })
    }

    /// The fraction at the nearest edge through which the ray enters, 0 or more, and that edge's direction. The outside
    /// is on the side of `(-y, x)`.
    fn first_entry(&self, geom: &GeomEntry) -> Option<(f64, DoubleVector)> {
        if !Aabb::intersect(&self.aabb, &geom.aabb) {
            return None;
        }
        let outline = &geom.world_vertices;
        // Positive on the side of the ray that is behind an edge which is entered; an end that lies on the ray belongs
        // to that side. So two edges that meet on the ray have no gap between them.
        let side = |v: DoubleVector| self.direction.cross(v.minus(self.start));
        let is_mirrored = is_mirrored(geom);
        let mut nearest: Option<(f64, DoubleVector)> = None;
        let edges = outline.len() - usize::from(geom.outline.is_open());
        for (index, &from) in outline.iter().enumerate().take(edges) {
            let to = outline[outline.next_index(index)];
            let (mut from, mut to) = (DoubleVector::of(from), DoubleVector::of(to));
            if is_mirrored {
                std::mem::swap(&mut from, &mut to);
            }
            let is_entered = side(from) < 0.0 && side(to) >= 0.0;
            if !is_entered {
                continue;
            }
            let edge = to.minus(from);
            let fraction = from.minus(self.start).cross(edge) / self.direction.cross(edge);
            let is_on_the_way = (0.0..=1.0).contains(&fraction);
            if is_on_the_way && nearest.is_none_or(|(best, _)| fraction < best) {
                nearest = Some((fraction, edge));
            }
        }
        nearest
    }
}

/// Whether the outside of an outline is on the other side of its edges. It is if a matrix set by the user has mirrored
/// the outline. It also is for a chain, whose winding is opposite, unless a matrix has mirrored it.
fn is_mirrored(geom: &GeomEntry) -> bool {
    if geom.outline.is_chain() {
        let matrix = geom.pose.matrix;
        return f64::from(matrix.m11) * f64::from(matrix.m22) > f64::from(matrix.m12) * f64::from(matrix.m21);
    }
    let outline = &geom.world_vertices;
    let Some(&origin) = outline.first() else { return false };
    let from_origin = |v: Vector2| DoubleVector::of(v).minus(DoubleVector::of(origin));
    let doubled_area: f64 =
        outline.windows(2).map(|edge| from_origin(edge[0]).cross(from_origin(edge[1]))).sum();
    doubled_area > 0.0
}
