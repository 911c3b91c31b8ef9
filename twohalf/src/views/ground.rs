//! View of the ground of a body for editing.

use farseer_core::{BodyId, GeomId};

use super::access::AccessMut;
use crate::depth::{Ground, lowest};
use crate::error::stale;
use crate::projection::{plane_to_world, world_to_plane};
use crate::{Error, Result, TextureId};

/// The ground of a body for editing, from [`TwoHalfBody::ground_mut`](crate::TwoHalfBody::ground_mut). It
/// dereferences to [`Ground`].
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
    /// Sets the restitution coefficient, dimensionless. A value that is not finite is rejected and reported.
    pub fn set_restitution_coefficient(&mut self, value: f32) {
        self.set("restitution_coefficient", value, |ground| &mut ground.restitution_coefficient);
    }

    /// Sets the friction coefficient, dimensionless. A value that is not finite is rejected and reported.
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

    /// Sets the geom of the body that rests on the ground, and the picture of its shadow.
    ///
    /// The body's [`position3d`](crate::TwoHalfBody::position3d) stays: its old height becomes the height of
    /// the geom's lowest point, so the body's origin moves.
    ///
    /// [`clear_object_geom`](Self::clear_object_geom) undoes it.
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

    /// Removes object geom and shadow picture: the body falls through the ground, until an object geom is
    /// [set](Self::set_object_geom) again. A body that sleeps on the ground wakes.
    ///
    /// The body stays where it is. Its [`position3d`](crate::TwoHalfBody::position3d) is that of its origin
    /// from now on.
    ///
    /// ```
    /// use twohalf::{TwoHalfPhysicsSimulator, Vector2, farseer_core};
    /// use farseer_core::{BodyFactory, GeomPlacement, Vertices};
    /// let mut simulator = TwoHalfPhysicsSimulator::with_gravity(480, Vector2::new(0.0, 900.0))?;
    /// let thug = simulator.create_body(BodyFactory::create_rectangle_body(30.0, 60.0, 70.0)?);
    /// let geom = simulator.create_geom(thug, Vertices::create_rectangle(30.0, 60.0)?, GeomPlacement::default())?;
    /// simulator.add(thug)?;
    /// simulator.add(geom)?;
    /// simulator.body_mut(thug).unwrap().ground_mut().set_object_geom(geom, None)?;
    /// (0..60).for_each(|_| simulator.update(1.0 / 60.0));
    /// assert!(simulator.body(thug).unwrap().is_grounded());
    /// // Knocked out, it falls out of the picture.
    /// simulator.body_mut(thug).unwrap().ground_mut().clear_object_geom();
    /// (0..60).for_each(|_| simulator.update(1.0 / 60.0));
    /// assert!(simulator.body(thug).unwrap().position3d().y < -300.0);
    /// # Ok::<(), twohalf::Error>(())
    /// ```
    pub fn clear_object_geom(&mut self) {
        if let Some(state) = self.simulator.world_mut().depths.edit(self.body) {
            state.ground = state.ground.without_object();
            state.ground.shadow_image = None;
        }
    }

    fn lowest(&self) -> f64 {
        lowest(self.simulator.core(), &self.simulator.world().depths, self.body)
    }
}
