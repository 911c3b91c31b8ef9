//! What lies at a point of the screen, and what is beneath a point of the world.

use farseer_core::{BodyId, GeomId};

use crate::draw_order::Drawable;
use crate::tell::to_world;
use crate::{Partner, TwoHalfPhysicsSimulator, Vector2, Vector3};

/// What an object would fall on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Surface {
    /// The ground or a platform.
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
    /// The first geom, in the order of the geom list, whose picture holds a point of the screen; see
    /// [`TwoHalfGeom::collides_with_point`](crate::TwoHalfGeom::collides_with_point).
    /// [`pick_front`](Self::pick_front) gives what a player sees there.
    #[doc(alias = "Collide")]
    pub fn collide(&self, point: Vector2) -> Option<GeomId> {
        self.geom_list().iter().copied().find(|&geom| self.shows(geom, point))
    }

    /// All geoms whose picture holds a point of the screen, in the order of the geom list.
    #[doc(alias = "CollideAll")]
    pub fn collide_all(&self, point: Vector2) -> Vec<GeomId> {
        self.geom_list().iter().copied().filter(|&geom| self.shows(geom, point)).collect()
    }

    fn shows(&self, geom: GeomId, point: Vector2) -> bool {
        self.geom(geom).is_some_and(|geom| geom.collides_with_point(point))
    }

    /// What a player sees at a point of the screen: of all bodies and platforms there, the one that is
    /// [drawn last](Self::draw_order).
    pub fn pick_front(&self, point: Vector2) -> Option<Drawable> {
        let shows = |drawable: &Drawable| match *drawable {
            Drawable::Body(body) => {
                let geoms = self.core.geoms_of(body);
                geoms.iter().any(|&geom| self.core.is_listed(geom) && self.shows(geom, point))
            }
            Drawable::Platform(platform) => self.platform(platform).is_some_and(|platform| {
                let corners = platform.corners().map(|corner| self.projection().to_screen(corner));
                hull_holds(&corners, point)
            }),
        };
        self.draw_order().into_iter().rev().find(shows)
    }

    /// The point of the ground that appears at a point of the screen.
    pub fn screen_to_ground(&self, point: Vector2) -> Vector3 {
        self.projection().screen_to_ground(point)
    }

    /// The highest surface, ground or platform, that lies straight below a point of the world, or at its height:
    /// what rests on a surface sinks into it by a fraction of a px, so surfaces up to four times the [allowed
    /// penetration](farseer_core::PhysicsSimulator::allowed_penetration) above the point count. `None` for a point
    /// below the ground.
    pub fn surface_beneath(&self, point: Vector3) -> Option<Surface> {
        let ground = Surface { partner: Partner::Ground, height: 0.0, normal: Vector3::new(0.0, 1.0, 0.0) };
        let platforms = self.world.platforms.iter().filter_map(|(id, platform)| {
            let (y, normal) = platform.shape().height_at(point.x, point.z)?;
            Some(Surface { partner: Partner::Platform(id), height: -y, normal: to_world(normal) })
        });
        let reach = point.y + SUNK * self.core.allowed_penetration();
        let below = platforms.chain([ground]).filter(|surface| surface.height <= reach);
        below.max_by(|a, b| a.height.total_cmp(&b.height))
    }

    /// The surface straight below the middle of a body's object geom, or of its origin without one. `None` for a
    /// stale id, and below the ground.
    pub fn surface_beneath_body(&self, body: BodyId) -> Option<Surface> {
        let view = self.body(body)?;
        let middle = view.ground().object_geom().and_then(|geom| self.geom(geom));
        self.surface_beneath(middle.map_or(view.origin3d(), |geom| geom.position3d()))
    }
}

/// Whether the convex hull of some points holds another: no line through it has all of them on one side.
fn hull_holds(points: &[Vector2], point: Vector2) -> bool {
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
        assert!(hull_holds(&corners, Vector2::new(2.0, 9.0)));
        assert!(!hull_holds(&corners, Vector2::new(-1.0, 5.0)));
        assert!(!hull_holds(&corners, Vector2::new(5.0, 10.5)));
    }
}
