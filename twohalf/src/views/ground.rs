//! The ground of a body, to be changed.

use farseer_core::{BodyId, GeomId};

use super::access::AccessMut;
use crate::depth::{Ground, lowest};
use crate::error::stale;
use crate::projection::{plane_to_world, world_to_plane};
use crate::{Error, Result, TextureId};

/// A body's ground, to be changed: what [`TwoHalfBody::ground_mut`](crate::TwoHalfBody::ground_mut) gives.
/// Dereferences to [`Ground`].
#[derive(Debug)]
pub struct GroundMut<'a, S> {
    pub(crate) simulator: &'a mut S,
    pub(crate) body: BodyId,
}

impl<S: AccessMut> std::ops::Deref for GroundMut<'_, S> {
    type Target = Ground;
    fn deref(&self) -> &Ground {
        &self.simulator.world().depths.bodies[self.body].ground
    }
}

impl<S: AccessMut> GroundMut<'_, S> {
    /// Sets the bounciness. What is not finite is rejected and reported.
    pub fn set_restitution_coefficient(&mut self, value: f32) {
        self.set("restitution_coefficient", value, |ground| &mut ground.restitution_coefficient);
    }

    /// Sets the friction. What is not finite is rejected and reported.
    pub fn set_friction_coefficient(&mut self, value: f32) {
        self.set("friction_coefficient", value, |ground| &mut ground.friction_coefficient);
    }

    fn set(&mut self, argument: &'static str, value: f32, field: impl Fn(&mut Ground) -> &mut f32) {
        if !value.is_finite() {
            self.simulator.world_mut().reject(self.body, argument);
        } else if let Some(state) = self.simulator.world_mut().depths.edit(self.body) {
            *field(&mut state.ground) = value;
        }
    }

    /// Says which geom of the body rests on the ground, and which picture its shadow is.
    ///
    /// The body's [`position3d`](crate::TwoHalfBody::position3d) stays: what was its height is now the height
    /// of the geom's lowest point, so the body's origin moves.
    ///
    /// # Errors
    /// A stale geom, or one of another body.
    #[doc(alias = "setObjectGeom")]
    pub fn set_object_geom(&mut self, object_geom: GeomId, shadow_image: Option<TextureId>) -> Result<()> {
        let geom = self.simulator.core().geom(object_geom).ok_or(stale("object_geom"))?;
        if geom.body() != self.body {
            return Err(Error::GeomOfAnotherBody { argument: "object_geom" });
        }
        let before = self.lowest();
        if let Some(state) = self.simulator.world_mut().depths.edit(self.body) {
            state.ground.object_geom = Some(object_geom);
            state.ground.shadow_image = shadow_image;
        }
        let after = self.lowest();
        if let Some(body) = self.simulator.core_body_mut(self.body).filter(|_| before != after) {
            let position = plane_to_world(body.position(), before, 0.0);
            body.set_position(world_to_plane(position, after));
        }
        Ok(())
    }

    fn lowest(&self) -> f64 {
        lowest(self.simulator.core(), &self.simulator.world().depths, self.body)
    }
}
