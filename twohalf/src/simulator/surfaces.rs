//! What is beneath a point of the world, and what of bodies can be stood on.

use farseer_core::math::vector2::transform;
use farseer_core::{BodyId, GeomId, SpaceFoot};

use crate::depth::upright;
use crate::projection::to_world;
use crate::shapes::Top;
use crate::{DepthProfile, Partner, TwoHalfPhysicsSimulator, Vector2, Vector3};

/// What an object would fall on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Surface {
    /// The ground, a platform, or a geom that can be stood on.
    pub partner: Partner,
    /// Its height Y straight below, px.
    pub height: f32,
    /// Its unit normal in the world, Y up.
    pub normal: Vector3,
}

/// In units of the allowed penetration: how deep something that rests lies in a surface at most. Usually it is one;
/// what is heavily loaded sinks deeper.
const SUNK: f32 = 4.0;

impl TwoHalfPhysicsSimulator {
    /// The highest surface that lies straight below a point of the world, or at its height: of the ground, of a platform, or
    /// of a body that can be stood on. What rests on a surface sinks into it by a fraction of a px, so surfaces up to four
    /// times the [allowed penetration](farseer_core::PhysicsSimulator::allowed_penetration) above the point count. `None` for
    /// a point below the ground.
    ///
    /// Prisms can be stood on where their outlines look up, and the tops of upright prisms and cylinders; balls and
    /// capsules cannot, nor sensors and what does not collide. Of several at one height the ground comes first, then
    /// platforms in the order in which they were made, from the last on, then geoms in that of their list.
    ///
    /// Looks at every platform and every listed geom: the time grows with their number.
    ///
    /// ```
    /// use twohalf::{Partner, Platform, TwoHalfPhysicsSimulator, Vector3};
    /// let mut simulator = TwoHalfPhysicsSimulator::new(480)?;
    /// let block = Platform::new(&mut simulator, 100.0, 20.0, 60.0, Vector3::new(0.0, 30.0, 0.0), None)?;
    /// let beneath = |x: f32| simulator.surface_beneath(Vector3::new(x, 200.0, 0.0)).unwrap();
    /// assert_eq!((beneath(40.0).partner, beneath(40.0).height), (Partner::Platform(block), 50.0));
    /// assert_eq!((beneath(60.0).partner, beneath(60.0).height), (Partner::Ground, 0.0));
    /// # Ok::<(), twohalf::Error>(())
    /// ```
    pub fn surface_beneath(&self, point: Vector3) -> Option<Surface> {
        self.surface_beneath_where(point, |_| true)
    }

    /// As [`surface_beneath`](Self::surface_beneath), but only of what a filter lets through, so that a body can leave itself
    /// out. It is asked about everything that is beneath the point.
    pub fn surface_beneath_where(
        &self,
        point: Vector3,
        mut is_wanted: impl FnMut(Partner) -> bool,
    ) -> Option<Surface> {
        let reach = point.y + SUNK * self.core.allowed_penetration();
        let mut highest: Option<Surface> = None;
        let mut find = |surface: Surface| {
            let is_there = surface.height <= reach && is_wanted(surface.partner);
            if is_there && highest.is_none_or(|other| surface.height >= other.height) {
                highest = Some(surface);
            }
        };
        // Most are apart in depth, which costs least to see.
        for &geom in self.geom_list().iter().rev() {
            if self.reaches_depth(geom, point.z) && self.can_hold(geom) {
                self.for_each_top(geom, [point.z; 2], |top| {
                    surface_of(&top, [point.x, point.z]).into_iter().for_each(&mut find);
                });
            }
        }
        for (id, platform) in self.world.platforms.iter() {
            if let Some((y, normal)) = platform.shape().height_at(point.x, point.z) {
                find(Surface { partner: Partner::Platform(id), height: -y, normal: to_world(normal) });
            }
        }
        find(Surface { partner: Partner::Ground, height: 0.0, normal: Vector3::new(0.0, 1.0, 0.0) });
        highest
    }

    /// The surface straight below the middle of a body's object geom, or of its origin without one; no geom of the body
    /// itself. `None` for a stale id, and below the ground.
    pub fn surface_beneath_body(&self, body: BodyId) -> Option<Surface> {
        let view = self.body(body)?;
        let middle = view.ground().object_geom().and_then(|geom| self.geom(geom));
        let middle = middle.map_or(view.origin3d(), |geom| geom.position3d());
        self.surface_beneath_where(middle, |partner| match partner {
            Partner::Geom(geom) => self.geom(geom).is_some_and(|geom| geom.body() != body),
            Partner::Platform(_) | Partner::Ground => true,
        })
    }

    fn reaches_depth(&self, geom: GeomId, at: f32) -> bool {
        let profile = self.world.depths.profiles.get(geom);
        profile.zip(self.core.body_of(geom)).is_some_and(|(profile, body)| {
            let (z, half) = (self.world.depths.z_of(body), profile.half_depth());
            z - half <= at && at <= z + half
        })
    }

    /// Whether others collide with a geom and are held by it.
    fn can_hold(&self, geom: GeomId) -> bool {
        self.core.geom(geom).is_some_and(|geom| {
            let takes_part = geom.collision_enabled() && geom.collision_response_enabled();
            takes_part
                && !geom.is_disposed()
                && self.core.body(geom.body()).is_some_and(|body| body.enabled())
        })
    }

    /// What of a geom can be stood on: of a prism, if it is within some depths, its edges that look up.
    pub(crate) fn for_each_top(&self, geom: GeomId, [near, far]: [f32; 2], mut find: impl FnMut(Top)) {
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
            // Edges go against the clock as seen with y down: what looks up goes to the left.
            let edge = [corner, corners[(at + 1) % corners.len()]].map(|corner| transform(corner, &matrix));
            if edge[1].x < edge[0].x {
                find(Top { geom, front, back, edge, upright: None });
            }
        }
    }

    /// A capsule has none: it is stood on no more than a ball.
    fn top_of_upright(&self, geom: GeomId) -> Option<Top> {
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
        Some(Top { geom, front, back, edge, upright: Some((shape, [middle.x, middle.z])) })
    }
}

/// A top as a surface beneath a place of X and Z, if it is there.
fn surface_of(top: &Top, [x, z]: [f32; 2]) -> Option<Surface> {
    let [a, b] = top.edge;
    if !(b.x <= x && x <= a.x && top.front <= z && z <= top.back) {
        return None;
    }
    let partner = Partner::Geom(top.geom);
    if let Some((shape, place)) = &top.upright {
        let way = [place[0] - x, place[1] - z];
        let (apart, _) = upright::with_foot(shape, |foot| SpaceFoot::Disc(0.0).gap(foot, way));
        let normal = Vector3::new(0.0, 1.0, 0.0);
        return (apart <= 0.0).then_some(Surface { partner, height: -a.y, normal });
    }
    let way = b - a;
    let height = -(a.y + way.y * ((x - a.x) / way.x));
    // In f64 the squared length of no edge of f32 numbers underflows.
    let [along_x, along_y] = [way.x, way.y].map(f64::from);
    let length = (along_x * along_x + along_y * along_y).sqrt();
    let normal = Vector3::new((-along_y / length) as f32, (-along_x / length) as f32, 0.0);
    (height.is_finite() && normal.y > 0.0).then_some(Surface { partner, height, normal })
}
