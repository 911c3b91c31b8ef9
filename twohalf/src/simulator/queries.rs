//! Queries by a point of the screen and by a box of the world.

use farseer_core::GeomId;
use farseer_core::depth::{DepthAxis, DepthPath};

use super::draw_items::Drawable;
use crate::{TwoHalfGeom, TwoHalfPhysicsSimulator, Vector2, Vector3, VirtualGeom};

impl TwoHalfPhysicsSimulator {
    /// The first geom, in the order of the geom list, whose picture contains a point of the screen; see
    /// [`TwoHalfGeom::collides_with_point`](crate::TwoHalfGeom::collides_with_point).
    /// [`pick_front`](Self::pick_front) returns the visible one.
    #[doc(alias = "Collide")]
    pub fn collide(&self, point: Vector2) -> Option<GeomId> {
        self.geom_list().iter().copied().find(|&geom| self.shows(geom, point))
    }

    /// All geoms whose picture contains a point of the screen, in the order of the geom list.
    #[doc(alias = "CollideAll")]
    pub fn collide_all(&self, point: Vector2) -> Vec<GeomId> {
        self.geom_list().iter().copied().filter(|&geom| self.shows(geom, point)).collect()
    }

    fn shows(&self, geom: GeomId, point: Vector2) -> bool {
        self.geom(geom).is_some_and(|geom| geom.collides_with_point(point))
    }

    /// The visible body or platform at a point of the screen: the one that is [drawn last](Self::draw_order).
    pub fn pick_front(&self, point: Vector2) -> Option<Drawable> {
        self.pick_front_where(point, |_| true)
    }

    /// [`pick_front`](Self::pick_front) with a filter. It is called for items at the point, from the front to
    /// the back, until it returns true.
    pub fn pick_front_where(
        &self,
        point: Vector2,
        mut is_wanted: impl FnMut(Drawable) -> bool,
    ) -> Option<Drawable> {
        let shows = |drawable: &Drawable| match *drawable {
            Drawable::Body(body) => {
                let geoms = self.core.geoms_of(body);
                geoms.iter().any(|&geom| self.core.is_listed(geom) && self.shows(geom, point))
            }
            Drawable::Platform(platform) => self.platform(platform).is_some_and(|platform| {
                let corners = platform.corners().map(|corner| self.projection().to_screen(corner));
                hull_contains(&corners, point)
            }),
        };
        self.draw_order().into_iter().rev().find(|drawable| shows(drawable) && is_wanted(*drawable))
    }

    /// The geoms whose [AABBs](crate::TwoHalfGeom::virtual_geom) overlap or touch a box of the world, in the
    /// order of the geom list, without disposed ones. `low` is the corner of the least X, Y and Z in px,
    /// `high` that of the greatest. The result is empty if a number is not finite, or one of `low` exceeds
    /// that of `high`. [`platforms_in_box`](Self::platforms_in_box) returns the platforms.
    ///
    /// With the precise set its hash grid is searched, so that the time does not grow with the number of geoms.
    /// The filter is called for the found ones only.
    pub fn query_box(
        &self,
        low: Vector3,
        high: Vector3,
        mut is_wanted: impl FnMut(GeomId) -> bool,
    ) -> Vec<GeomId> {
        if !is_box(low, high) {
            return Vec::new();
        }
        let mut found = self.geoms_near(path_within([low.x, low.z], [high.x, high.z]), |geom| {
            self.overlaps_box(geom, low, high)
        });
        found.retain(|&geom| is_wanted(geom));
        found
    }

    /// Returns the geoms near a path for which `is_found` is true, in the order of the geom list.
    pub(super) fn geoms_near(&self, path: DepthPath, is_found: impl Fn(GeomId) -> bool) -> Vec<GeomId> {
        let mut found: Vec<(u32, GeomId)> = Vec::new();
        self.for_each_geom_along(&path, |list_key, geom| {
            if is_found(geom) {
                found.push((list_key, geom));
            }
            1.0
        });
        found.sort_unstable_by_key(|&(list_key, _)| list_key);
        found.dedup_by_key(|&mut (list_key, _)| list_key);
        found.into_iter().map(|(_, geom)| geom).collect()
    }

    /// Calls `visit` with the geoms that a box may touch on a path over X and Z, at any height, and perhaps others, nearly in the
    /// order along the path; a geom may come twice. The first argument of `visit` is a number by which geoms are
    /// sorted as in the geom list. It returns the fraction of the path beyond which geoms are of no interest.
    pub(super) fn for_each_geom_along(&self, path: &DepthPath, mut visit: impl FnMut(u32, GeomId) -> f64) {
        let depths = &self.world.depths;
        // Until the first update the core knows no depths.
        let is_done =
            depths.is_sent && DepthAxis::of(&self.core).for_each_geom_along(path, &depths.edited, &mut visit);
        if !is_done {
            for (list_key, &geom) in (0..).zip(self.geom_list()) {
                visit(list_key, geom);
            }
        }
    }

    /// Returns whether the AABB of a geom that is not disposed overlaps or touches the box from `low` to `high`, px.
    pub(super) fn overlaps_box(&self, geom: GeomId, low: Vector3, high: Vector3) -> bool {
        let is_near = |geom: TwoHalfGeom<'_>| overlaps_box(&geom.virtual_geom(), low, high);
        !self.core.is_disposed(geom) && self.geom(geom).is_some_and(is_near)
    }

    /// The geoms that [overlap](crate::TwoHalfGeom::collides_with_geom) another one in all three axes, for
    /// example a sensor, in the order of the geom list. Geoms of its own body, disposed ones and filtered
    /// ones are left out. Collision categories, groups and flags do not count. Empty for a stale id.
    ///
    /// Broad phase as in [`query_box`](Self::query_box), then narrow phase of the shapes whose AABBs overlap. The filter is
    /// called before the narrow phase.
    pub fn overlaps_of(&self, geom: GeomId, mut is_wanted: impl FnMut(GeomId) -> bool) -> Vec<GeomId> {
        let Some(view) = self.geom(geom).filter(|_| !self.core.is_disposed(geom)) else { return Vec::new() };
        let v = view.virtual_geom();
        let (low, high) = (Vector3::new(v.left, v.bottom, v.front), Vector3::new(v.right, v.top, v.back));
        let is_other = |other: GeomId| self.geom(other).is_some_and(|other| other.body() != view.body());
        let mut found = self.query_box(low, high, |other| is_other(other) && is_wanted(other));
        found.retain(|&other| view.collides_with_geom(other));
        found
    }

    /// Inverse projection of a point of the screen to the ground, px.
    pub fn screen_to_ground(&self, point: Vector2) -> Vector3 {
        self.projection().screen_to_ground(point)
    }
}

/// Returns whether a query box is finite, and no coordinate of `low` exceeds that of `high`.
pub(super) fn is_box(low: Vector3, high: Vector3) -> bool {
    (0..3).all(|axis| low[axis].is_finite() && high[axis].is_finite() && low[axis] <= high[axis])
}

/// Returns the path along the middle of a rectangle over X and Z, of a box as wide as the rectangle.
pub(super) fn path_within(low: [f32; 2], high: [f32; 2]) -> DepthPath {
    // Halves first: a sum may overflow.
    let middle = [0, 1].map(|axis| 0.5 * low[axis] + 0.5 * high[axis]);
    let half_extents = [0, 1].map(|axis| 0.5 * high[axis] - 0.5 * low[axis]);
    DepthPath { start: middle, end: middle, half_extents }
}

/// Returns whether the AABB of a geom overlaps or touches the box from `low` to `high`, px.
fn overlaps_box(geom: &VirtualGeom, low: Vector3, high: Vector3) -> bool {
    geom.left <= high.x
        && low.x <= geom.right
        && geom.bottom <= high.y
        && low.y <= geom.top
        && geom.front <= high.z
        && low.z <= geom.back
}

/// Returns whether the convex hull of `points` contains a point: no line through the point has all `points` on one side.
fn hull_contains(points: &[Vector2], point: Vector2) -> bool {
    let side = |a: Vector2, b: Vector2, p: Vector2| (b - a).perp(&(p - a));
    let is_hull_edge = |a: Vector2, b: Vector2| a != b && points.iter().all(|&p| side(a, b, p) >= 0.0);
    points.iter().all(|&a| points.iter().all(|&b| !is_hull_edge(a, b) || side(a, b, point) >= 0.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hull_holds_what_is_between_its_corners_and_nothing_else() {
        let corners = [[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0], [5.0, 5.0]].map(Vector2::from);
        assert!(hull_contains(&corners, Vector2::new(2.0, 9.0)));
        assert!(!hull_contains(&corners, Vector2::new(-1.0, 5.0)));
        assert!(!hull_contains(&corners, Vector2::new(5.0, 10.5)));
    }
}
