//! Queries of a simulator: those of [`Objects`](crate::Objects), restricted to nearby geoms with the precise set.

use std::cell::Cell;

use super::PhysicsSimulator;
use super::candidates::{Candidate, First, fraction_key, in_order};
use crate::geom::GeomId;
use crate::math::Vector2;
use crate::objects::{Ray, RayCastHit, is_query_box, ray_segment};
use crate::shape::Aabb;

thread_local! {
    /// Workspace of [`PhysicsSimulator::query_aabb_into`], empty between queries: geoms after the keys by which they are sorted.
    static SCRATCH: Cell<Vec<(u32, GeomId)>> = const { Cell::new(Vec::new()) };
}

/// Geoms at a point, on a ray or in a box. The results are those of [`Objects`](crate::Objects) to the last bit. With
/// the precise set its hash grid is searched, so that the time does not grow with the number of geoms: a ray ends at its first
/// hit.
impl PhysicsSimulator {
    /// [`Objects::collide`](crate::Objects::collide)
    pub fn collide(&self, point: Vector2) -> Option<GeomId> {
        let mut first = First::new();
        self.for_each_near(&Aabb::new(point, point), |Candidate { list_key, geom, .. }| {
            if self.objects.geom_collides_with_point(geom, point) {
                first.offer(list_key, 0.0, geom);
            }
        });
        first.into_item()
    }

    /// [`Objects::collide_all`](crate::Objects::collide_all)
    pub fn collide_all(&self, point: Vector2) -> Vec<GeomId> {
        let mut found = Vec::new();
        self.for_each_near(&Aabb::new(point, point), |Candidate { list_key, geom, .. }| {
            if self.objects.geom_collides_with_point(geom, point) {
                found.push((0, list_key, geom));
            }
        });
        in_order(found)
    }

    /// [`Objects::ray_cast`](crate::Objects::ray_cast)
    pub fn ray_cast(&self, start: Vector2, end: Vector2) -> Option<RayCastHit> {
        let ray = Ray::new(start, end)?;
        let mut first = First::new();
        self.for_each_along(&ray_segment(start, end), |Candidate { list_key, geom, .. }| {
            if let Some(entry) = self.objects.first_entry(&ray, geom) {
                first.offer(list_key, entry.fraction, entry);
            }
            first.number()
        });
        first.into_item().map(|entry| ray.hit(&entry))
    }

    /// [`Objects::ray_cast_all`](crate::Objects::ray_cast_all)
    pub fn ray_cast_all(&self, start: Vector2, end: Vector2) -> Vec<RayCastHit> {
        let Some(ray) = Ray::new(start, end) else { return Vec::new() };
        let mut hits = Vec::new();
        self.for_each_along(&ray_segment(start, end), |Candidate { list_key, geom, .. }| {
            let entry = self.objects.first_entry(&ray, geom);
            hits.extend(entry.map(|entry| (fraction_key(entry.fraction), list_key, ray.hit(&entry))));
            1.0
        });
        in_order(hits)
    }

    /// [`Objects::query_aabb`](crate::Objects::query_aabb)
    pub fn query_aabb(&self, aabb: &Aabb) -> Vec<GeomId> {
        let mut found = Vec::new();
        self.query_aabb_into(aabb, &mut found);
        found
    }

    /// As [`query_aabb`](Self::query_aabb), but replaces the content of a list. A list that is used again spares each query an
    /// allocation.
    pub fn query_aabb_into(&self, aabb: &Aabb, found: &mut Vec<GeomId>) {
        found.clear();
        if !is_query_box(aabb) {
            return;
        }
        let has_disposed = self.objects.has_disposed_geoms();
        let mut keyed = SCRATCH.take();
        self.for_each_near(aabb, |Candidate { list_key, geom, is_inside }| {
            let overlaps = is_inside || self.objects.geom_overlaps(geom, aabb);
            if overlaps && !(has_disposed && self.objects.is_disposed(geom)) {
                keyed.push((list_key, geom));
            }
        });
        keyed.sort_unstable_by_key(|&(list_key, _)| list_key);
        keyed.dedup_by_key(|&mut (list_key, _)| list_key);
        found.extend(keyed.drain(..).map(|(_, geom)| geom));
        SCRATCH.set(keyed);
    }
}
