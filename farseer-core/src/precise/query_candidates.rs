//! Adapter: the geoms that an AABB query of the game has to test, found with the hash grid.
//!
//! The grid holds the fat AABBs of the last step. Geoms that these AABBs do not cover, and geoms of bodies that were edited
//! since, are always candidates.

use crate::body::entry::BodyEntry;
use crate::geom::GeomId;
use crate::geom::entry::{GeomEntry, GeomPose};
use crate::math::Vector2;
use crate::objects::Objects;
use crate::precise::Precise;
use crate::precise::ids::{AlwaysTested, geom_of};
use crate::shape::Aabb;
use farseer_precise::index::ProxyIndex;
use farseer_precise::parameters::broad_phase::{
    PIECE_MAX_SHORTFALL_RATIO, QUERY_MAX_COORDINATE, QUERY_ROUNDING_RATIO,
};

impl Precise {
    /// Lists in `found` the geoms that may overlap an AABB, and perhaps others, in the order of the list of geoms, each after the
    /// key by which that is sorted. Returns false, with a `found` of no meaning, if the proxies are older than the list of geoms,
    /// there is a depth axis, or the AABB is out of range. The caller then tests all geoms.
    pub(crate) fn list_geoms_near(
        &self,
        aabb: &Aabb,
        objects: &Objects,
        found: &mut Vec<(u32, GeomId)>,
    ) -> bool {
        let solver = &self.solver;
        let coordinate_sum = coordinate_sum(aabb);
        // A comparison that is false for NaN, too.
        let is_in_range = coordinate_sum < QUERY_MAX_COORDINATE;
        let is_outdated =
            self.edits.needs_rebuild || self.edits.has_membership_changes || self.loaded.is_some();
        if is_outdated
            || solver.depth.is_some()
            || objects.has_new_structure
            || objects.has_new_members
            || !is_in_range
        {
            return false;
        }
        let bounds = widened(aabb, QUERY_ROUNDING_RATIO * coordinate_sum);
        let of_proxy = |proxy: ProxyIndex| {
            let proxy = solver.proxies.proxy(proxy);
            (proxy.list_key, geom_of(proxy))
        };
        found.clear();
        found.extend(self.always_tested.iter().map(|tested| (tested.list_key, tested.geom)));
        solver.grid.for_each_overlap(&bounds, |proxy| found.push(of_proxy(proxy)));
        let edited = objects.touched_bodies.iter().chain(&self.edits.bodies);
        for &geom in
            edited.filter_map(|&body| objects.bodies.get(body)).flat_map(|entry: &BodyEntry| &entry.geoms)
        {
            found.extend(self.proxy_of(geom, 0).map(of_proxy));
        }
        found.sort_unstable_by_key(|&(key, _)| key);
        found.dedup_by_key(|&mut (key, _)| key);
        true
    }

    /// Stores the geoms that every AABB query tests in `always_tested`.
    pub(in crate::precise) fn list_always_tested(&mut self, objects: &Objects) {
        let mut always_tested = std::mem::take(&mut self.always_tested);
        always_tested.clear();
        for at in 0..objects.geoms.list().len() {
            let Some((id, geom)) = objects.geoms.at(at) else { continue };
            if !self.proxy_covers_geom(id, geom) {
                always_tested.push(AlwaysTested { list_key: objects.geoms.list_key(id), geom: id });
            }
        }
        self.always_tested = always_tested;
    }

    /// Returns whether the fat AABB of a geom's proxy covers the geom's vertices and AABB in every pose of its body. False for
    /// geoms of more than one convex piece and for geoms whose AABB or matrix does not follow from vertices and pose.
    pub(in crate::precise) fn proxy_covers_geom(&self, id: GeomId, geom: &GeomEntry) -> bool {
        let has_own_pose = geom.box_radius.is_some() || geom.user_matrix.is_some() || geom.refresh_is_due;
        let Some(proxy) = self.proxy_of(id, 0).filter(|_| !has_own_pose && geom.pieces().len() == 1) else {
            return false;
        };
        let shape = self.solver.proxies.proxy(proxy).shape;
        let tolerance = PIECE_MAX_SHORTFALL_RATIO * self.solver.parameters.speculative_distance;
        let on_body = GeomPose::of_body(Vector2::zeros(), 0.0, geom.offset, geom.rotation_offset).matrix;
        let is_covered = |&corner: &Vector2| {
            let corner = on_body.apply(corner);
            let [x, y] = [0, 1].map(|axis| {
                shape.half_extents[axis] + shape.radius + tolerance
                    - (corner[axis] - shape.centre[axis]).abs()
            });
            x >= 0.0 && y >= 0.0
        };
        QUERY_ROUNDING_RATIO * shape.max_extent <= tolerance && geom.local_vertices.iter().all(is_covered)
    }
}

/// Sum of the magnitudes of the coordinates of an AABB, in length units; NaN if one is.
fn coordinate_sum(aabb: &Aabb) -> f32 {
    let Aabb { min, max } = *aabb;
    [min.x, min.y, max.x, max.y].iter().fold(0.0, |sum: f32, x| sum + x.abs())
}

/// Left, top, right and bottom of an AABB, widened by a margin in length units.
fn widened(aabb: &Aabb, margin: f32) -> [f32; 4] {
    let Aabb { min, max } = *aabb;
    [min.x - margin, min.y - margin, max.x + margin, max.y + margin]
}
