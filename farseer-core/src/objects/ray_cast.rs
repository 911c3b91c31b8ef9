//! Ray casts and box queries. Ours: the original has other queries.

use super::Objects;
use crate::geom::GeomId;
use crate::geom::entry::{GeomEntry, GeomPose, WorldOutline};
use crate::geom::outline::Outline;
use crate::math::Vector2;
use crate::shape::Aabb;
use crate::simulator::candidates::Segment;
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
        let ray = Ray::new(start, end)?;
        let entries = self.geoms.list().iter().filter_map(|&geom| self.first_entry(&ray, geom));
        let nearest =
            entries.reduce(|nearest, entry| if entry.fraction < nearest.fraction { entry } else { nearest });
        nearest.map(|entry| ray.hit(&entry))
    }

    /// Every geom that a ray from `start` to `end` enters, once each at its first entry, ordered by distance, and in
    /// list order at equal distances. See [`ray_cast`](Self::ray_cast).
    pub fn ray_cast_all(&self, start: Vector2, end: Vector2) -> Vec<RayCastHit> {
        let Some(ray) = Ray::new(start, end) else { return Vec::new() };
        let mut entries: Vec<RayEntry> =
            self.geoms.list().iter().filter_map(|&geom| self.first_entry(&ray, geom)).collect();
        // Fractions are 0 or more: such numbers are ordered as their bits are. The sum makes -0 and +0 equal.
        sort_by_number(&mut entries, |entry| (entry.fraction + 0.0).to_bits().into());
        entries.iter().map(|entry| ray.hit(entry)).collect()
    }

    /// The geoms whose [boxes](crate::GeomRef::aabb) overlap or touch a box, in list order, without disposed ones. None
    /// if a coordinate is not finite, or `min` is greater than `max`. For the costs see [`ray_cast`](Self::ray_cast).
    pub fn query_aabb(&self, aabb: &Aabb) -> Vec<GeomId> {
        if !is_query_box(aabb) {
            return Vec::new();
        }
        let overlaps = |&geom: &GeomId| !self.is_disposed(geom) && self.geom_overlaps(geom, aabb);
        self.geoms.list().iter().copied().filter(overlaps).collect()
    }

    /// Whether the box of a geom overlaps or touches a box.
    pub(crate) fn geom_overlaps(&self, geom: GeomId, aabb: &Aabb) -> bool {
        self.with_outline(geom, |_, outline| Aabb::intersect(&outline.aabb, aabb)).unwrap_or(false)
    }

    /// The first entry of a ray into the polygon of a geom.
    pub(crate) fn first_entry(&self, ray: &Ray, geom: GeomId) -> Option<RayEntry> {
        if self.geoms.is_disposed(geom) {
            return None;
        }
        let entry = self.with_outline(geom, |entry, outline| ray.first_entry(entry, outline)).flatten();
        entry.map(|(fraction, edge)| RayEntry { geom, fraction, edge })
    }

    /// Calls `read` with a geom and its outline at the present pose, or at the pose to come if its body was edited.
    fn with_outline<T>(
        &self,
        geom: GeomId,
        read: impl FnOnce(&GeomEntry, &WorldOutline<'_>) -> T,
    ) -> Option<T> {
        // The room for a small outline is cleared sooner.
        match self.geoms.get(geom)?.local_vertices.len() {
            0..=FEW_VERTICES => self.with_outline_in::<FEW_VERTICES, T>(geom, read),
            _ => self.with_outline_in::<MAX_STACK_VERTICES, T>(geom, read),
        }
    }

    /// [`with_outline`](Self::with_outline) with room for `N` corners.
    #[inline]
    fn with_outline_in<const N: usize, T>(
        &self,
        geom: GeomId,
        read: impl FnOnce(&GeomEntry, &WorldOutline<'_>) -> T,
    ) -> Option<T> {
        let entry = self.geoms.get(geom)?;
        let pending = self.bodies.get(entry.body).and_then(|body| body.pending_pose());
        let mut vertices = [Vector2::new(0.0, 0.0); N];
        let outline = pending.and_then(|(position, rotation)| {
            let pose = GeomPose::of_body(position, rotation, entry.offset, entry.rotation_offset);
            entry.outline_at(&pose, vertices.get_mut(..entry.local_vertices.len())?)
        });
        Some(match (outline, pending) {
            (Some(outline), _) => read(entry, &outline),
            // The pose is not possible, or the polygon has many corners.
            (None, Some(_)) => {
                self.with_current_transform(geom, |entry| read(entry, &entry.world_outline()))?
            }
            (None, None) => read(entry, &entry.world_outline()),
        })
    }

    /// Whether there are disposed geoms, which the next update removes.
    pub(crate) fn has_disposed_geoms(&self) -> bool {
        !self.geoms.disposed().is_empty()
    }
}

/// Number of corners of small polygons, a count: most boxes and outlines have less.
const FEW_VERTICES: usize = 8;
/// Largest number of corners of a polygon that a query brings to the world without an allocation, a count. A capsule with ends of
/// 16 edges has 34 corners; the value is chosen.
const MAX_STACK_VERTICES: usize = 64;

/// Whether a query box is finite, and no `min` is greater than `max`.
pub(crate) fn is_query_box(Aabb { min, max }: &Aabb) -> bool {
    let is_finite = |v: &Vector2| v.x.is_finite() && v.y.is_finite();
    is_finite(min) && is_finite(max) && min.x <= max.x && min.y <= max.y
}

/// Returns the path of a ray.
pub(crate) fn ray_segment(start: Vector2, end: Vector2) -> Segment {
    Segment { start, end, half_extents: Vector2::zeros() }
}

/// The first entry of a ray into a geom.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RayEntry {
    geom: GeomId,
    /// Fraction of the ray, 0..=1.
    pub(crate) fraction: f64,
    /// Vector along the edge that is entered, in length units; the outside is on the side of `(-y, x)`.
    edge: DoubleVector,
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

/// A ray from a point to another.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Ray {
    start: DoubleVector,
    direction: DoubleVector,
    aabb: Aabb,
}

impl Ray {
    /// `None` for a ray without a direction.
    pub(crate) fn new(start: Vector2, end: Vector2) -> Option<Self> {
        let is_finite = [start.x, start.y, end.x, end.y].iter().all(|value| value.is_finite());
        (is_finite && start != end).then(|| Ray {
            start: DoubleVector::of(start),
            direction: DoubleVector::of(end).minus(DoubleVector::of(start)),
            aabb: Aabb::from_vertices(&[start, end]),
        })
    }

    /// The hit at an entry of the ray.
    pub(crate) fn hit(&self, entry: &RayEntry) -> RayCastHit {
        let &RayEntry { geom, fraction, edge } = entry;
        let point = self.start.zip(self.direction, |start, way| start + way * fraction);
        let length = (edge.x * edge.x + edge.y * edge.y).sqrt();
        let normal = Vector2::new((-edge.y / length) as f32, (edge.x / length) as f32);
        let point = Vector2::new(point.x as f32, point.y as f32);
        RayCastHit { geom, point, normal, fraction: fraction as f32 }
    }

    /// The fraction at the nearest edge through which the ray enters, 0 or more, and that edge's direction. The outside
    /// is on the side of `(-y, x)`.
    fn first_entry(&self, geom: &GeomEntry, world: &WorldOutline<'_>) -> Option<(f64, DoubleVector)> {
        let outline = world.vertices;
        if !Aabb::intersect(&self.aabb, &world.aabb) || outline.is_empty() {
            return None;
        }
        // Positive on the side of the ray that is behind an edge which is entered; an end that lies on the ray belongs
        // to that side. So two edges that meet on the ray have no gap between them.
        let is_behind = |v: Vector2| self.direction.cross(DoubleVector::of(v).minus(self.start)) >= 0.0;
        let mut is_mirrored = None;
        let mut nearest: Option<(f64, DoubleVector)> = None;
        let edges = outline.len() - usize::from(geom.outline.is_open());
        let mut to = (outline[0], is_behind(outline[0]));
        for index in 1..=edges {
            let from = to;
            let next = outline[if index == outline.len() { 0 } else { index }];
            to = (next, is_behind(next));
            if from.1 == to.1 {
                continue;
            }
            let is_reversed = match geom.outline {
                // It is entered from both sides.
                Outline::TwoSidedChain { .. } => from.1,
                _ => *is_mirrored.get_or_insert_with(|| is_mirrored_outline(geom, world)),
            };
            let (from, to) = if is_reversed { (to, from) } else { (from, to) };
            if from.1 {
                continue;
            }
            let (from, to) = (DoubleVector::of(from.0), DoubleVector::of(to.0));
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
fn is_mirrored_outline(geom: &GeomEntry, world: &WorldOutline<'_>) -> bool {
    if geom.outline.is_chain() {
        let matrix = world.matrix;
        return f64::from(matrix.m11) * f64::from(matrix.m22) > f64::from(matrix.m12) * f64::from(matrix.m21);
    }
    let outline = world.vertices;
    let Some(&origin) = outline.first() else { return false };
    let from_origin = |v: Vector2| DoubleVector::of(v).minus(DoubleVector::of(origin));
    let doubled_area: f64 =
        outline.windows(2).map(|edge| from_origin(edge[0]).cross(from_origin(edge[1]))).sum();
    doubled_area > 0.0
}
