//! Queries of a simulator: those of [`Objects`](crate::Objects), restricted to nearby geoms with the precise set.

use std::borrow::Cow;

use super::PhysicsSimulator;
use crate::geom::GeomId;
use crate::math::Vector2;
use crate::objects::RayCastHit;
use crate::shape::Aabb;

/// Geoms at a point, on a ray or in a box. The results are those of [`Objects`](crate::Objects) to the last bit. With
/// the precise set its hash grid is searched, so that the time does not grow with the number of geoms.
impl PhysicsSimulator {
    /// [`Objects::collide`](crate::Objects::collide)
    pub fn collide(&self, point: Vector2) -> Option<GeomId> {
        self.objects.collide_among(&self.geoms_near(&Aabb::new(point, point)), point)
    }

    /// [`Objects::collide_all`](crate::Objects::collide_all)
    pub fn collide_all(&self, point: Vector2) -> Vec<GeomId> {
        self.objects.collide_all_among(&self.geoms_near(&Aabb::new(point, point)), point)
    }

    /// [`Objects::ray_cast`](crate::Objects::ray_cast)
    pub fn ray_cast(&self, start: Vector2, end: Vector2) -> Option<RayCastHit> {
        self.objects.ray_cast_among(&self.geoms_near(&Aabb::from_vertices(&[start, end])), start, end)
    }

    /// [`Objects::ray_cast_all`](crate::Objects::ray_cast_all)
    pub fn ray_cast_all(&self, start: Vector2, end: Vector2) -> Vec<RayCastHit> {
        self.objects.ray_cast_all_among(&self.geoms_near(&Aabb::from_vertices(&[start, end])), start, end)
    }

    /// [`Objects::query_aabb`](crate::Objects::query_aabb)
    pub fn query_aabb(&self, aabb: &Aabb) -> Vec<GeomId> {
        self.objects.query_aabb_among(&self.geoms_near(aabb), aabb)
    }

    /// The geoms that may reach into a box, in list order: all geoms if there is no grid.
    pub(crate) fn geoms_near(&self, aabb: &Aabb) -> Cow<'_, [GeomId]> {
        let precise = self.pipeline.precise.as_ref();
        let near = precise.and_then(|precise| precise.geoms_near(aabb, &self.objects));
        near.map_or(Cow::Borrowed(self.objects.geom_list()), Cow::Owned)
    }
}
