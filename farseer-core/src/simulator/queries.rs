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
        let mut found = Vec::new();
        match precise.is_some_and(|precise| precise.list_geoms_near(aabb, &self.objects, &mut found)) {
            true => Cow::Owned(found.into_iter().map(|(_, geom)| geom).collect()),
            false => Cow::Borrowed(self.objects.geom_list()),
        }
    }

    /// Lists in `found` the geoms of [`geoms_near`](Self::geoms_near), each after a key of no meaning, without an allocation
    /// once it is long enough.
    #[cfg(feature = "precise")]
    pub(crate) fn list_geoms_near(&self, aabb: &Aabb, found: &mut Vec<(u32, GeomId)>) {
        let precise = self.pipeline.precise.as_ref();
        if !precise.is_some_and(|precise| precise.list_geoms_near(aabb, &self.objects, found)) {
            found.clear();
            found.extend(self.objects.geom_list().iter().map(|&geom| (0, geom)));
        }
    }
}
