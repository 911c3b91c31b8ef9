//! Farseer's queries: geoms at a point or along a segment (behaviour chapters 04, 05 and 09).

use super::Objects;
use crate::geom::GeomId;
use crate::geom::entry::GeomEntry;
use crate::math::Vector2;
use crate::narrow_phase;
use crate::shape::Aabb;
use crate::shape::ray_helper::{
    line_intersect, line_segment_aabb_intersect, line_segment_vertices_intersect,
};

/// A geom and the points at which a segment crosses its outline.
#[derive(Debug, Clone, PartialEq)]
pub struct GeomPointPair {
    /// The geom.
    pub geom: GeomId,
    /// The crossings, in the order of the geom's edges.
    pub points: Vec<Vector2>,
}

impl Objects {
    /// The first geom in list order that contains a point of the world. Geoms that do not collide count, too.
    ///
    /// The selected narrow phase decides. A chain has no inside, and contains no point. If a body was edited since the
    /// last update, its geoms are tested in their new pose.
    #[doc(alias = "Collide")]
    pub fn collide(&self, point: Vector2) -> Option<GeomId> {
        self.collide_among(self.geoms.list(), point)
    }

    pub(crate) fn collide_among(&self, geoms: &[GeomId], point: Vector2) -> Option<GeomId> {
        geoms.iter().copied().find(|&geom| self.geom_collides_with_point(geom, point))
    }

    /// All geoms that contain a point of the world, in list order.
    #[doc(alias = "CollideAll")]
    pub fn collide_all(&self, point: Vector2) -> Vec<GeomId> {
        self.collide_all_among(self.geoms.list(), point)
    }

    pub(crate) fn collide_all_among(&self, geoms: &[GeomId], point: Vector2) -> Vec<GeomId> {
        geoms.iter().copied().filter(|&geom| self.geom_collides_with_point(geom, point)).collect()
    }

    /// Whether a geom contains a point of the world; false for a stale id.
    #[doc(alias = "Geom.Collide")]
    #[doc(alias("INarrowPhaseCollider.Intersect"))]
    pub fn geom_collides_with_point(&self, geom: GeomId, point: Vector2) -> bool {
        self.with_current_transform(geom, |geom| {
            geom.aabb.contains(point)
                && narrow_phase::intersect(self.methods.narrow(), geom, geom.pose.inverse.apply(point))
        })
        .unwrap_or(false)
    }

    /// Whether a vertex of one geom lies in the other. Outlines that cross without such a vertex are not detected, nor
    /// are disposed geoms, nor geoms without a distance grid if the distance grid is selected; the original fails
    /// there.
    #[doc(alias = "Geom.Collide")]
    pub fn geom_collides_with_geom(&self, geom: GeomId, other: GeomId) -> bool {
        if self.is_disposed(geom) || self.is_disposed(other) {
            return false;
        }
        let is_ready = |geom: &GeomEntry| geom.grid.is_some() || !self.methods.narrow().uses_grids();
        let holds_vertex = |holder: &GeomEntry, owner: &GeomEntry| {
            owner.world_vertices.iter().any(|&vertex| {
                narrow_phase::intersect(self.methods.narrow(), holder, holder.pose.inverse.apply(vertex))
            })
        };
        self.with_current_transform(geom, |geom| {
            self.with_current_transform(other, |other| {
                is_ready(geom)
                    && is_ready(other)
                    && Aabb::intersect(&geom.aabb, &other.aabb)
                    && (holds_vertex(other, geom) || holds_vertex(geom, other))
            })
        })
        .flatten()
        .unwrap_or(false)
    }

    /// Every geom that a segment crosses, in list order, with the crossings. No geom is filtered out.
    ///
    /// With `detect_using_aabb` the geoms' boxes are tested instead of their outlines.
    #[doc(alias = "LineSegmentAllGeomsIntersect")]
    pub fn line_segment_all_geoms_intersect(
        &self,
        point1: Vector2,
        point2: Vector2,
        detect_using_aabb: bool,
    ) -> Vec<GeomPointPair> {
        let pairs = self.geoms.list().iter().map(|&geom| GeomPointPair {
            geom,
            points: self.line_segment_geom_intersect(point1, point2, geom, detect_using_aabb),
        });
        pairs.filter(|pair| !pair.points.is_empty()).collect()
    }

    /// Points at which a segment crosses the outline (or the box) of a geom, in the order of its edges; none for a
    /// stale id.
    #[doc(alias = "LineSegmentGeomIntersect")]
    pub fn line_segment_geom_intersect(
        &self,
        point1: Vector2,
        point2: Vector2,
        geom: GeomId,
        detect_using_aabb: bool,
    ) -> Vec<Vector2> {
        let mut points = Vec::new();
        self.with_current_transform(geom, |geom| {
            if detect_using_aabb {
                line_segment_aabb_intersect(point1, point2, &geom.aabb, &mut points);
            } else if geom.outline.is_open() {
                let crossing = |edge: &[Vector2]| line_intersect(edge[0], edge[1], point1, point2);
                points.extend(geom.world_vertices.windows(2).filter_map(crossing));
            } else {
                line_segment_vertices_intersect(point1, point2, &geom.world_vertices, &mut points);
            }
        });
        points
    }

    /// Calls `read` with a geom in its present pose, or in the pose to come if its body was edited.
    pub(super) fn with_current_transform<T>(
        &self,
        geom: GeomId,
        read: impl FnOnce(&GeomEntry) -> T,
    ) -> Option<T> {
        let view = self.geom(geom)?;
        match view.pending() {
            None => Some(read(view.entry)),
            Some(pose) => {
                let mut entry = view.entry.clone();
                entry.set_pose(pose);
                Some(read(&entry))
            }
        }
    }
}
