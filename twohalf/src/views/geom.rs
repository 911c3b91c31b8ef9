//! Views of geoms.

use farseer_core::{GeomId, GeomRef, PhysicsSimulator};

use super::overlap::overlap;
use super::virtual_geom::VirtualGeom;
use crate::depth::{DepthProfile, World};
use crate::{Projection, Vector2, Vector3};

/// A geom for reading: shape, position and settings. It dereferences to [`GeomRef`], whose outlines and AABBs
/// are in the plane of the 2D engine (x = X, y = -Y).
#[derive(Debug, Clone, Copy)]
pub struct TwoHalfGeom<'a> {
    core: &'a PhysicsSimulator,
    world: &'a World,
    geom: GeomRef<'a>,
    id: GeomId,
}

impl<'a> std::ops::Deref for TwoHalfGeom<'a> {
    type Target = GeomRef<'a>;
    fn deref(&self) -> &GeomRef<'a> {
        &self.geom
    }
}

impl<'a> TwoHalfGeom<'a> {
    pub(crate) fn new(core: &'a PhysicsSimulator, world: &'a World, id: GeomId) -> Option<Self> {
        Some(TwoHalfGeom { core, world, geom: core.geom(id)?, id })
    }

    fn projection(&self) -> &Projection {
        &self.world.projection
    }

    fn z(&self) -> f32 {
        self.world.depths.z_of(self.geom.body())
    }

    /// Position of the geom's origin on the screen, px: that of its body plus the geom's offset.
    #[doc(alias = "Position")]
    pub fn position(&self) -> Vector2 {
        self.projection().plane_to_screen(self.geom.position(), self.z())
    }

    /// Position of the geom's origin in the world, px, Y up.
    pub fn position3d(&self) -> Vector3 {
        let plane = self.geom.position();
        Vector3::new(plane.x, -plane.y, self.z())
    }

    /// The outline on the screen, px, limited to finite numbers.
    pub fn screen_outline(&self) -> Vec<Vector2> {
        let z = self.z();
        let vertices = self.geom.world_vertices();
        vertices.iter().map(|&vertex| self.projection().plane_to_screen(vertex, z)).collect()
    }

    /// Depth profile of the geom.
    pub fn depth_profile(&self) -> DepthProfile {
        let profile = self.world.depths.profiles.get(self.id).copied();
        profile.unwrap_or_else(|| DepthProfile::default_of(self.geom))
    }

    /// Footprint of the geom, by which it collides along Z in the thesis (3.5).
    pub fn virtual_geom(&self) -> VirtualGeom {
        VirtualGeom::of(self.core, self.geom, self.depth_profile(), self.z())
    }

    /// Returns whether the geom's picture contains a point of the screen: its outline at its middle Z, or the disc of a ball.
    #[doc(alias = "Collide(Vector2)")]
    pub fn collides_with_point(&self, point: Vector2) -> bool {
        let plane = self.projection().screen_to_plane(point, self.z());
        match self.depth_profile() {
            DepthProfile::Round { radius } => {
                let from = plane - self.geom.position();
                from.x * from.x + from.y * from.y <= radius * radius
            }
            _ => {
                let nearest = crate::shapes::nearest(&self.geom.world_vertices(), plane);
                nearest.is_some_and(|nearest| nearest.distance <= 0.0)
            }
        }
    }

    /// Returns whether the geom overlaps another one in all three axes, regardless of collision categories; false for a stale
    /// id.
    #[doc(alias = "Collide(Geom)")]
    pub fn collides_with_geom(&self, other: GeomId) -> bool {
        overlap(self.core, &self.world.depths, self.id, other)
    }

    /// Always false: the ground is no geom here. See
    /// [`ContactTarget::is_ground`](crate::ContactTarget::is_ground) for contacts.
    #[doc(alias = "IsGround")]
    pub fn is_ground(&self) -> bool {
        false
    }
}
