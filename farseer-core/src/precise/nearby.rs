//! Which geoms a query has to look at: those whose bounds it overlaps, by the grid of the pairs.

use super::Precise;
use crate::body::entry::BodyEntry;
use crate::geom::GeomId;
use crate::geom::entry::{GeomEntry, GeomPose};
use crate::math::Vector2;
use crate::objects::Objects;
use crate::precise::parameters::broad_phase::{PIECE_SHORTFALL, QUERY_RANGE, QUERY_ROUNDING};
use crate::shape::Aabb;

/// A geom that queries look at wherever it is, and its place in the list of geoms.
#[derive(Debug, Clone, Copy)]
pub(super) struct Loose {
    pub(super) place: u32,
    pub(super) geom: GeomId,
}

impl Precise {
    /// The geoms that may reach into a box, and others, in list order. Nothing if what is known is not what is there.
    pub(crate) fn geoms_near(&self, aabb: &Aabb, objects: &Objects) -> Option<Vec<GeomId>> {
        let Aabb { min, max } = *aabb;
        let far = [min.x, min.y, max.x, max.y].iter().fold(0.0, |far: f32, x| far + x.abs());
        // Also if it is not a number.
        let is_near = far < QUERY_RANGE;
        let is_behind = self.is_stale || self.has_new_members || self.loaded.is_some();
        if is_behind
            || self.space.is_some()
            || objects.has_new_structure
            || objects.has_new_members
            || !is_near
        {
            return None;
        }
        let slack = QUERY_ROUNDING * far;
        let bounds = [min.x - slack, min.y - slack, max.x + slack, max.y + slack];
        let mut places: Vec<u32> = self.loose.iter().map(|loose| loose.place).collect();
        self.grid.for_each_overlap(&bounds, |proxy| places.push(self.proxies.all[proxy as usize].place));
        let edited = objects.touched_bodies.iter().chain(&self.edited_bodies);
        for &geom in
            edited.filter_map(|&body| objects.bodies.get(body)).flat_map(|entry: &BodyEntry| &entry.geoms)
        {
            places.extend(self.proxy_of(geom, 0).map(|proxy| self.proxies.all[proxy as usize].place));
        }
        places.sort_unstable();
        places.dedup();
        let list = objects.geoms.list();
        // A damaged save may know of more than there is.
        places.into_iter().map(|place| list.get(place as usize).copied()).collect()
    }

    /// Notes which geoms queries must look at wherever they are: those that are not, or not exactly, where pairs have them.
    pub(super) fn list_loose(&mut self, objects: &Objects) {
        let mut loose = std::mem::take(&mut self.loose);
        loose.clear();
        for at in 0..objects.geoms.list().len() {
            let Some((id, geom)) = objects.geoms.at(at) else { continue };
            if !self.bounds_hold(id, geom) {
                loose.push(Loose { place: at as u32, geom: id });
            }
        }
        self.loose = loose;
    }

    /// Whether a geom's world vertices and box lie within the bounds of its proxy, wherever its body is.
    pub(super) fn bounds_hold(&self, id: GeomId, geom: &GeomEntry) -> bool {
        let is_elsewhere = geom.box_radius.is_some() || geom.user_matrix.is_some() || geom.refresh_is_due;
        let Some(proxy) = self.proxy_of(id, 0).filter(|_| !is_elsewhere && geom.pieces().len() == 1) else {
            return false;
        };
        let shape = self.proxies.all[proxy as usize].shape;
        let slack = PIECE_SHORTFALL * self.tuning.speculative;
        let on_body = GeomPose::of_body(Vector2::zeros(), 0.0, geom.offset, geom.rotation_offset).matrix;
        let is_covered = |&corner: &Vector2| {
            let corner = on_body.apply(corner);
            let [x, y] = [0, 1].map(|axis| {
                shape.half[axis] + shape.radius + slack - (corner[axis] - shape.centre[axis]).abs()
            });
            x >= 0.0 && y >= 0.0
        };
        QUERY_ROUNDING * shape.reach <= slack && geom.local_vertices.iter().all(is_covered)
    }
}
