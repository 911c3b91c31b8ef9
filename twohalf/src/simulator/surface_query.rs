//! Queries of the surface beneath a point, and the walkable tops of geoms.

use farseer_core::math::vector2::transform;
use farseer_core::{BodyId, GeomId};
use farseer_precise::depth::shape_distance::DepthQueryFootprint;

use super::queries::path_within;
use crate::depth::upright;
use crate::projection::to_world;
use crate::shapes::WalkableTop;
use crate::{ContactTarget, DepthProfile, TwoHalfPhysicsSimulator, Vector2, Vector3};

/// A surface beneath a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Surface {
    /// The target: the ground, a platform, or a geom with a walkable top.
    pub partner: ContactTarget,
    /// Height Y straight below the point, px.
    pub height: f32,
    /// Unit normal in the world, Y up.
    pub normal: Vector3,
}

/// Greatest penetration of resting bodies in a surface, as a factor of the allowed penetration, dimensionless. Usual
/// penetrations are 1; heavily loaded bodies sink deeper.
const MAX_SINK_SLOPS: f32 = 4.0;

impl TwoHalfPhysicsSimulator {
    /// The highest surface straight below a point of the world, or at its height: ground, platform, or
    /// walkable body. Resting bodies penetrate a surface by a fraction of a px. Therefore surfaces up to four
    /// times the [allowed penetration](farseer_core::PhysicsSimulator::allowed_penetration) above the point
    /// count. `None` for a point below the ground.
    ///
    /// Walkable are the edges of prisms whose normals point up, and the tops of upright prisms and cylinders.
    /// Balls, capsules, sensors and geoms without collision are not. Of several at one height the ground
    /// comes first, then platforms from the last created on, then geoms in the order of their list.
    ///
    /// Tests every platform; the geoms at the place come from the hash grid of the precise set.
    ///
    /// ```
    /// use twohalf::{ContactTarget, Platform, TwoHalfPhysicsSimulator, Vector3};
    /// let mut simulator = TwoHalfPhysicsSimulator::new(480)?;
    /// let block = Platform::new(&mut simulator, 100.0, 20.0, 60.0, Vector3::new(0.0, 30.0, 0.0), None)?;
    /// let beneath = |x: f32| simulator.surface_beneath(Vector3::new(x, 200.0, 0.0)).unwrap();
    /// assert_eq!((beneath(40.0).partner, beneath(40.0).height), (ContactTarget::Platform(block), 50.0));
    /// assert_eq!((beneath(60.0).partner, beneath(60.0).height), (ContactTarget::Ground, 0.0));
    /// # Ok::<(), twohalf::Error>(())
    /// ```
    pub fn surface_beneath(&self, point: Vector3) -> Option<Surface> {
        self.surface_beneath_where(point, |_| true)
    }

    /// [`surface_beneath`](Self::surface_beneath) with a filter, so that a body can leave itself out. It is
    /// called for all surfaces beneath the point.
    pub fn surface_beneath_where(
        &self,
        point: Vector3,
        mut is_wanted: impl FnMut(ContactTarget) -> bool,
    ) -> Option<Surface> {
        let reach = point.y + MAX_SINK_SLOPS * self.core.allowed_penetration();
        let mut highest: Option<Surface> = None;
        let mut find = |surface: Surface| {
            let is_there = surface.height <= reach && is_wanted(surface.partner);
            if is_there && highest.is_none_or(|other| surface.height >= other.height) {
                highest = Some(surface);
            }
        };
        // Most geoms are separated in depth, which is the cheapest test.
        let place = [point.x, point.z];
        let is_there = |geom: GeomId| self.reaches_depth(geom, point.z) && self.can_support(geom);
        for geom in self.geoms_near(path_within(place, place), is_there).into_iter().rev() {
            self.for_each_top(geom, [point.z; 2], |top| {
                surface_of(&top, place).into_iter().for_each(&mut find);
            });
        }
        for (id, platform) in self.world.platforms.iter() {
            if let Some((y, normal)) = platform.shape().height_at(point.x, point.z) {
                find(Surface { partner: ContactTarget::Platform(id), height: -y, normal: to_world(normal) });
            }
        }
        find(Surface { partner: ContactTarget::Ground, height: 0.0, normal: Vector3::new(0.0, 1.0, 0.0) });
        highest
    }

    /// The surface straight below the centre of a body's object geom, or of its origin without one; geoms of
    /// the body itself are left out. `None` for a stale id, and below the ground.
    pub fn surface_beneath_body(&self, body: BodyId) -> Option<Surface> {
        let view = self.body(body)?;
        let middle = view.ground().object_geom().and_then(|geom| self.geom(geom));
        let middle = middle.map_or(view.origin3d(), |geom| geom.position3d());
        self.surface_beneath_where(middle, |partner| match partner {
            ContactTarget::Geom(geom) => self.geom(geom).is_some_and(|geom| geom.body() != body),
            ContactTarget::Platform(_) | ContactTarget::Ground => true,
        })
    }

    fn reaches_depth(&self, geom: GeomId, at: f32) -> bool {
        let profile = self.world.depths.profiles.get(geom);
        profile.zip(self.core.body_of(geom)).is_some_and(|(profile, body)| {
            let (z, half) = (self.world.depths.z_of(body), profile.half_depth());
            z - half <= at && at <= z + half
        })
    }

    /// Returns whether a geom collides and its contacts exert impulses.
    fn can_support(&self, geom: GeomId) -> bool {
        self.core.geom(geom).is_some_and(|geom| {
            let takes_part = geom.collision_enabled() && geom.collision_response_enabled();
            takes_part
                && !geom.is_disposed()
                && self.core.body(geom.body()).is_some_and(|body| body.enabled())
        })
    }

    /// Calls a function with the walkable tops of a geom, for a prism only within a depth range in px.
    pub(crate) fn for_each_top(
        &self,
        geom: GeomId,
        [near, far]: [f32; 2],
        mut find: impl FnMut(WalkableTop),
    ) {
        self.top_of_upright(geom).into_iter().for_each(&mut find);
        let (Some(view), Some(&profile)) = (self.core.geom(geom), self.world.depths.profiles.get(geom))
        else {
            return;
        };
        let DepthProfile::Prism { depth } = profile else { return };
        let (z, half) = (self.world.depths.z_of(view.body()), depth * 0.5);
        let (front, back) = (z - half, z + half);
        if !(near <= back && front <= far) {
            return;
        }
        let (matrix, corners) = (view.matrix(), view.local_vertices());
        for (at, &corner) in corners.iter().enumerate() {
            // Edges run counterclockwise as seen with y down: one whose normal points up runs to the left.
            let edge = [corner, corners[(at + 1) % corners.len()]].map(|corner| transform(corner, &matrix));
            if edge[1].x < edge[0].x {
                find(WalkableTop { geom, front, back, edge, upright: None });
            }
        }
    }

    /// Returns the walkable top of an upright geom; `None` for all other geoms and for capsules, which are not walkable, like
    /// balls.
    fn top_of_upright(&self, geom: GeomId) -> Option<WalkableTop> {
        let profile = *self.world.depths.profiles.get(geom)?;
        if matches!(profile, DepthProfile::Capsule { .. }) {
            return None;
        }
        let shape = profile.upright()?;
        let view = self.core.geom(geom)?;
        let z = self.world.depths.z_of(view.body());
        let middle = upright::middle(view, self.core.body(view.body())?, z);
        let whole = self.geom(geom)?.virtual_geom();
        let edge = [Vector2::new(whole.right, -whole.top), Vector2::new(whole.left, -whole.top)];
        let (front, back) = (whole.front, whole.back);
        Some(WalkableTop { geom, front, back, edge, upright: Some((shape, [middle.x, middle.z])) })
    }
}

/// Returns the surface of a walkable top beneath a place (X, Z in px); `None` if the top does not lie beneath the place.
fn surface_of(top: &WalkableTop, [x, z]: [f32; 2]) -> Option<Surface> {
    let [a, b] = top.edge;
    if !(b.x <= x && x <= a.x && top.front <= z && z <= top.back) {
        return None;
    }
    let partner = ContactTarget::Geom(top.geom);
    if let Some((shape, place)) = &top.upright {
        let offset = [place[0] - x, place[1] - z];
        let (apart, _) =
            upright::with_foot(shape, |foot| DepthQueryFootprint::Disc(0.0).distance_to(foot, offset));
        let normal = Vector3::new(0.0, 1.0, 0.0);
        return (apart <= 0.0).then_some(Surface { partner, height: -a.y, normal });
    }
    let offset = b - a;
    let height = -(a.y + offset.y * ((x - a.x) / offset.x));
    // In f64 the squared length of an edge of f32 numbers does not underflow.
    let [along_x, along_y] = [offset.x, offset.y].map(f64::from);
    let length = (along_x * along_x + along_y * along_y).sqrt();
    let normal = Vector3::new((-along_y / length) as f32, (-along_x / length) as f32, 0.0);
    (height.is_finite() && normal.y > 0.0).then_some(Surface { partner, height, normal })
}
