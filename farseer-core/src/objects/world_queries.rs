//! What lies on a ray, in a box or on a geom: not in the original, which has others.

use super::Objects;
use crate::geom::GeomId;
use crate::geom::entry::GeomEntry;
use crate::math::Vector2;
use crate::shape::Aabb;
use crate::storage::order::sort_by_number;

/// Where a ray enters a geom.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RayCastHit {
    /// The geom.
    pub geom: GeomId,
    /// The point of its outline, in the world.
    pub point: Vector2,
    /// The outline's direction outward there, of length 1: against the ray.
    pub normal: Vector2,
    /// Part of the way from the start to the end of the ray, from 0 to 1.
    pub fraction: f32,
}

impl Objects {
    /// The first geom that a ray from `start` to `end` enters; of several at one place, the first in list order.
    ///
    /// Nothing is filtered out: for rays that pass through some geoms look for the first other one in
    /// [`ray_cast_all`](Self::ray_cast_all). Outlines are polygons, those of circles and capsules too; a chain is entered
    /// through its edges, from their free side. A geom that holds the start is
    /// hit only where the ray enters it again; one along whose edge the ray only grazes may be hit or not. Disposed geoms
    /// are not hit, though they stay listed until the next update. A ray that ends where it starts, or is not finite, hits
    /// nothing.
    ///
    /// Looks at the box of every listed geom: the time grows with their number. A simulator with the precise set asks its grid
    /// instead.
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
        let hits = geoms.iter().filter_map(|&geom| self.entry_of(&ray, geom));
        let nearest = hits.reduce(|nearest, hit| if hit.0 < nearest.0 { hit } else { nearest });
        nearest.map(|(_, hit)| hit)
    }

    /// Every geom that a ray from `start` to `end` enters, once each where it enters it first, from the nearest to the
    /// farthest and in list order at equal distances. See [`ray_cast`](Self::ray_cast).
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
            geoms.iter().filter_map(|&geom| self.entry_of(&ray, geom)).collect();
        // Fractions are 0 or more: such numbers have the order of their bits, with one zero of the two.
        sort_by_number(&mut hits, |(fraction, _)| (fraction + 0.0).to_bits().into());
        hits.into_iter().map(|(_, hit)| hit).collect()
    }

    /// The geoms whose [boxes](crate::GeomRef::aabb) overlap a box or touch it, in list order, but for disposed ones.
    /// None if its numbers are not finite, or `min` is greater than `max`. Looks at every listed geom, but as [`ray_cast`](Self::ray_cast).
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
                && self.with_settled(geom, |geom| Aabb::intersect(&geom.aabb, aabb)).unwrap_or(false)
        };
        geoms.iter().copied().filter(overlaps).collect()
    }

    /// Where a ray enters a geom first, with the fraction in full precision.
    fn entry_of(&self, ray: &Ray, id: GeomId) -> Option<(f64, RayCastHit)> {
        if self.is_disposed(id) {
            return None;
        }
        self.with_settled(id, |geom| {
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
struct Wide {
    x: f64,
    y: f64,
}

impl Wide {
    fn of(v: Vector2) -> Self {
        Wide { x: f64::from(v.x), y: f64::from(v.y) }
    }

    fn zip(self, other: Wide, f: impl Fn(f64, f64) -> f64) -> Self {
        Wide { x: f(self.x, other.x), y: f(self.y, other.y) }
    }

    fn minus(self, other: Wide) -> Self {
        self.zip(other, |a, b| a - b)
    }

    fn cross(self, other: Wide) -> f64 {
        self.x * other.y - self.y * other.x
    }
}

struct Ray {
    start: Wide,
    direction: Wide,
    aabb: Aabb,
}

impl Ray {
    /// `None` for a ray without a direction.
    fn new(start: Vector2, end: Vector2) -> Option<Self> {
        let is_finite = [start.x, start.y, end.x, end.y].iter().all(|value| value.is_finite());
        (is_finite && start != end).then(|| Ray {
            start: Wide::of(start),
            direction: Wide::of(end).minus(Wide::of(start)),
            aabb: Aabb::from_vertices(&[start, end]),
        })
    }

    /// The fraction of the way to the nearest edge through which the ray comes in, and that edge's direction, with the
    /// outside on the side of `(-y, x)`.
    fn first_entry(&self, geom: &GeomEntry) -> Option<(f64, Wide)> {
        if !Aabb::intersect(&self.aabb, &geom.aabb) {
            return None;
        }
        let outline = &geom.world_vertices;
        // Positive on the side of the ray that is behind an edge which is entered; an end that lies on the ray belongs
        // to that side. So two edges that meet on the ray have no gap between them.
        let side = |v: Wide| self.direction.cross(v.minus(self.start));
        let is_mirrored = is_mirrored(geom);
        let mut nearest: Option<(f64, Wide)> = None;
        let edges = outline.len() - usize::from(geom.outline.is_open());
        for (index, &from) in outline.iter().enumerate().take(edges) {
            let to = outline[outline.next_index(index)];
            let (mut from, mut to) = (Wide::of(from), Wide::of(to));
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

/// Whether the outside of an outline is on the other side of its edges: a matrix set by the user has turned its winding
/// round, or it is a chain, whose points go the other way unless one has.
fn is_mirrored(geom: &GeomEntry) -> bool {
    if geom.outline.is_chain() {
        let matrix = geom.pose.matrix;
        return f64::from(matrix.m11) * f64::from(matrix.m22) > f64::from(matrix.m12) * f64::from(matrix.m21);
    }
    let outline = &geom.world_vertices;
    let Some(&origin) = outline.first() else { return false };
    let from_origin = |v: Vector2| Wide::of(v).minus(Wide::of(origin));
    let doubled_area: f64 =
        outline.windows(2).map(|edge| from_origin(edge[0]).cross(from_origin(edge[1]))).sum();
    doubled_area > 0.0
}
