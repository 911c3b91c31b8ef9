//! Adapter: the geoms that a query of the game has to test, found with the hash grid.
//!
//! The grid holds the fat AABBs of the last step. Geoms that these AABBs do not cover, and geoms of bodies that were edited
//! since, are always candidates.

use crate::body::BodyId;
use crate::body::entry::BodyEntry;
use crate::geom::GeomId;
use crate::geom::entry::{GeomEntry, GeomPose};
use crate::math::Vector2;
use crate::objects::Objects;
use crate::precise::Precise;
use crate::precise::ids::{AlwaysTested, IdTable, geom_of, piece_at};
use crate::shape::Aabb;
use crate::simulator::candidates::{Candidate, Segment};
use farseer_precise::Solver;
use farseer_precise::broad_phase::hash_grid::GridSegment;
use farseer_precise::broad_phase::proxies::Proxy;
use farseer_precise::index::ProxyIndex;
use farseer_precise::parameters::broad_phase::{
    PIECE_MAX_SHORTFALL_RATIO, QUERY_MAX_COORDINATE, QUERY_ROUNDING_RATIO,
};

/// Grid, and what it does not know: parts of [`Precise`] for the queries of the game.
pub(crate) struct GridQuery<'a> {
    solver: &'a Solver,
    ids: &'a IdTable,
    always_tested: &'a [AlwaysTested],
    /// Bodies that were edited since the last import.
    edited: &'a [BodyId],
    is_stepping: bool,
    objects: &'a Objects,
}

impl GridQuery<'_> {
    /// Returns the first proxy of a geom; `None` without one.
    fn first_proxy(&self, geom: GeomId) -> Option<ProxyIndex> {
        piece_at(&self.solver.proxies, self.ids.first_proxy(geom)?, (geom, 0))
    }

    /// Calls `visit` with the geoms that may overlap an AABB, and perhaps others, in no particular order; a geom may come twice.
    /// Returns false without a call if the grid does not know all geoms, or the AABB is out of range. The caller then tests all
    /// geoms.
    pub(crate) fn for_each_near(&self, aabb: &Aabb, mut visit: impl FnMut(Candidate)) -> bool {
        let Aabb { min, max } = *aabb;
        let Some(tolerance) = tolerance_of([min.x, min.y, max.x, max.y]) else { return false };
        if self.solver.depth.is_some() {
            return false;
        }
        let inner = [min.x + tolerance, min.y + tolerance, max.x - tolerance, max.y - tolerance];
        // A fat AABB does not follow an edit before the next step.
        let has_edits = self.for_each_beside_grid(&mut visit);
        let bounds = [min.x - tolerance, min.y - tolerance, max.x + tolerance, max.y + tolerance];
        let solver = &self.solver;
        let (proxies, parameters) = (&solver.proxies, &solver.parameters);
        let query = [min.x, min.y, max.x, max.y];
        solver.grid.for_each_overlap(&bounds, |index| {
            let overlaps = match self.is_stepping {
                true => contains(&inner, proxies.fat_aabb_of(index)).then_some(true),
                false => proxies.outline_overlaps(index, &query, tolerance, &solver.bodies, parameters),
            };
            if overlaps == Some(false) {
                return;
            }
            let candidate = candidate_of(proxies.proxy(index));
            let is_inside =
                overlaps == Some(true) && !has_edits && !self.is_always_tested(candidate.list_key);
            visit(Candidate { is_inside, ..candidate });
        });
        true
    }

    /// Calls `visit` with the geoms that an AABB may touch on its way along a segment, and perhaps others. The order is nearly that
    /// along the segment, and a geom may come twice. `visit` returns the fraction of the segment beyond which geoms are of no
    /// interest, 0..=1. Returns false as [`for_each_near`](Self::for_each_near) does.
    pub(crate) fn for_each_along(&self, segment: &Segment, mut visit: impl FnMut(Candidate) -> f64) -> bool {
        let in_plane = self.solver.depth.is_none();
        let Some(segment) = grid_segment(segment).filter(|_| in_plane) else { return false };
        let mut max_fraction = 1.0;
        self.for_each_beside_grid(&mut |candidate| max_fraction = visit(candidate));
        let proxies = &self.solver.proxies;
        let (bodies, parameters) = (&self.solver.bodies, &self.solver.parameters);
        let [half_x, half_y] = segment.half_extents;
        let reach = (half_x * half_x + half_y * half_y).sqrt();
        let way = [segment.end[0] - segment.start[0], segment.end[1] - segment.start[1]];
        self.solver.grid.for_each_along(&GridSegment { max_fraction, ..segment }, |index| {
            let path = [segment.start, way.map(|part| part * max_fraction.max(0.0) as f32)];
            if self.is_stepping || proxies.may_meet_path(index, path, reach, bodies, parameters) {
                max_fraction = visit(candidate_of(proxies.proxy(index)));
            }
            max_fraction
        });
        true
    }

    /// Does the same with a depth axis for an upright box. The grid spans x and z, so all heights are visited. `edited` are
    /// bodies whose depth the game has changed since the last step. See [`for_each_along`](Self::for_each_along).
    #[cfg(feature = "space")]
    pub(crate) fn for_each_along_in_depth(
        &self,
        segment: &Segment,
        edited: &[BodyId],
        mut visit: impl FnMut(Candidate) -> f64,
    ) -> bool {
        let in_depth = self.solver.depth.is_some();
        let Some(segment) = grid_segment(segment).filter(|_| in_depth) else { return false };
        let mut max_fraction = 1.0;
        self.for_each_beside_grid(&mut |candidate| max_fraction = visit(candidate));
        let proxies = &self.solver.proxies;
        let geoms =
            edited.iter().filter_map(|&body| self.objects.bodies.get(body)).flat_map(|entry| &entry.geoms);
        for proxy in geoms.filter_map(|&geom| self.first_proxy(geom)) {
            max_fraction = visit(candidate_of(proxies.proxy(proxy)));
        }
        self.solver.grid.for_each_along(&GridSegment { max_fraction, ..segment }, |index| {
            let proxy = proxies.proxy(index);
            if !proxy.is_world {
                max_fraction = visit(candidate_of(proxy));
            }
            max_fraction
        });
        true
    }

    /// Calls `visit` with the geoms that fat AABBs do not cover, and with those of bodies that were edited since the last step.
    /// Returns whether there are edited bodies.
    fn for_each_beside_grid(&self, visit: &mut impl FnMut(Candidate)) -> bool {
        for &AlwaysTested { list_key, geom } in self.always_tested {
            visit(Candidate { list_key, geom, is_inside: false });
        }
        let edited = self.objects.touched_bodies.iter().chain(self.edited);
        let geoms = edited
            .filter_map(|&body| self.objects.bodies.get(body))
            .flat_map(|entry: &BodyEntry| &entry.geoms);
        for proxy in geoms.filter_map(|&geom| self.first_proxy(geom)) {
            visit(candidate_of(self.solver.proxies.proxy(proxy)));
        }
        !(self.objects.touched_bodies.is_empty() && self.edited.is_empty())
    }

    /// Returns whether the geom with this list key may reach beyond its fat AABB.
    fn is_always_tested(&self, list_key: u32) -> bool {
        self.always_tested.binary_search_by_key(&list_key, |tested| tested.list_key).is_ok()
    }
}

impl Precise {
    /// Returns the grid for queries; `None` if the proxies are older than the list of geoms. The caller then tests all geoms.
    pub(crate) fn grid_query<'a>(&'a self, objects: &'a Objects) -> Option<GridQuery<'a>> {
        let Precise { solver, ids, always_tested, edits, is_stepping, .. } = self;
        let is_outdated = edits.needs_rebuild
            || edits.has_membership_changes
            || self.loaded.is_some()
            || objects.has_new_structure
            || objects.has_new_members;
        (!is_outdated).then_some(GridQuery {
            solver,
            ids,
            always_tested,
            edited: &edits.bodies,
            is_stepping: *is_stepping,
            objects,
        })
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
        let has_own_pose = geom.user_matrix.is_some() || geom.refresh_is_due;
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
        let covers_disc = |radius: f32| {
            let origin = on_body.apply(Vector2::zeros()) - Vector2::from(shape.centre);
            let [half_x, half_y] = shape.half_extents;
            origin.norm() + radius <= half_x.min(half_y) + shape.radius + tolerance
        };
        QUERY_ROUNDING_RATIO * shape.max_extent <= tolerance
            && geom.local_vertices.iter().all(is_covered)
            && geom.box_radius.is_none_or(|radius| self.solver.depth.is_some() && covers_disc(radius))
    }
}

/// Returns the geom of a proxy as a candidate.
fn candidate_of(proxy: &Proxy) -> Candidate {
    Candidate { list_key: proxy.list_key, geom: geom_of(proxy), is_inside: false }
}

/// Returns whether one AABB contains another; false for the AABB of a proxy that takes part in no query.
fn contains(outer: &[f32; 4], inner: &[f32; 4]) -> bool {
    outer[0] <= inner[0] && outer[1] <= inner[1] && inner[2] <= outer[2] && inner[3] <= outer[3]
}

/// Returns the path of a query in the grid, enlarged for the rounding of geoms; `None` if it is out of range.
fn grid_segment(&Segment { start, end, half_extents }: &Segment) -> Option<GridSegment> {
    let tolerance = tolerance_of([start.x, start.y, end.x, end.y])?
        + tolerance_of([half_extents.x, half_extents.y, 0.0, 0.0])?;
    Some(GridSegment {
        start: [start.x, start.y],
        end: [end.x, end.y],
        half_extents: [half_extents.x + tolerance, half_extents.y + tolerance],
        max_fraction: 1.0,
    })
}

/// Returns the distance by which a query with these coordinates is enlarged for the rounding of geoms, in length units; `None` if
/// the coordinates are out of range, or not finite.
fn tolerance_of(coordinates: [f32; 4]) -> Option<f32> {
    let sum = coordinates.iter().fold(0.0, |sum: f32, x| sum + x.abs());
    // The comparison is false for NaN, too.
    (sum < QUERY_MAX_COORDINATE).then_some(QUERY_ROUNDING_RATIO * sum)
}
