//! Geoms of a simulator and their depth profiles.

use farseer_core::math::scalar::nearest_finite;
use farseer_core::{BodyId, Geom, GeomId, Vertices};

use super::TwoHalfPhysicsSimulator;
use crate::depth::{DepthProfile, DepthScheme};
use crate::error::{only_precise, stale};
use crate::views::TwoHalfGeom;
use crate::{Error, Result};

/// Geoms.
impl TwoHalfPhysicsSimulator {
    /// A geom for reading; `None` for a stale id.
    pub fn geom(&self, geom: GeomId) -> Option<TwoHalfGeom<'_>> {
        TwoHalfGeom::new(&self.core, &self.world, geom)
    }

    /// The settings of a geom for editing; `None` for a stale id.
    pub fn geom_mut(&mut self, geom: GeomId) -> Option<&mut Geom> {
        self.core.geom_mut(geom)
    }

    /// Moves a geom to another body with the same offsets. If it was the object geom of its old body, that
    /// body has none afterwards.
    ///
    /// # Errors
    /// As [`PhysicsSimulator::set_body`](farseer_core::PhysicsSimulator::set_body).
    #[doc(alias = "SetBody")]
    pub fn set_body(&mut self, geom: GeomId, body: BodyId) -> Result<()> {
        let old = self.core.geom(geom).map(|geom| geom.body()).filter(|old| *old != body);
        self.core.set_body(geom, body)?;
        if let Some(state) = old.and_then(|old| self.world.depths.edit(old)) {
            state.ground.clear_removed_geom(geom);
        }
        self.world.depths.edit(body);
        Ok(())
    }

    /// Replaces the outline of a geom; see [`PhysicsSimulator::set_vertices`](farseer_core::PhysicsSimulator::set_vertices). Its depth profile stays.
    ///
    /// # Errors
    /// The errors of the core's function.
    #[doc(alias = "SetVertices")]
    pub fn set_vertices(&mut self, geom: GeomId, vertices: impl Into<Vertices>) -> Result<()> {
        self.core.set_vertices(geom, vertices)?;
        self.pipeline.forget_outline(geom);
        Ok(())
    }

    /// Makes a geom a sensor (static body, contacts without response) or an ordinary geom. Sensors have depth
    /// as well.
    ///
    /// # Errors
    /// A stale id.
    #[doc(alias = "IsSensor")]
    pub fn set_is_sensor(&mut self, geom: GeomId, is_sensor: bool) -> Result<()> {
        Ok(self.core.set_is_sensor(geom, is_sensor)?)
    }

    /// Excludes new pairs of the two geoms; see
    /// [`PhysicsSimulator::ignore_collision_with`](farseer_core::PhysicsSimulator::ignore_collision_with).
    ///
    /// # Errors
    /// A stale id.
    #[doc(alias = "IgnoreCollisionWith")]
    pub fn ignore_collision_with(&mut self, geom: GeomId, other: GeomId) -> Result<()> {
        Ok(self.core.ignore_collision_with(geom, other)?)
    }

    /// Undoes [`ignore_collision_with`](Self::ignore_collision_with) of the same geom.
    ///
    /// # Errors
    /// A stale id.
    #[doc(alias = "RestoreCollisionWith")]
    pub fn restore_collision_with(&mut self, geom: GeomId, other: GeomId) -> Result<()> {
        Ok(self.core.restore_collision_with(geom, other)?)
    }

    /// Depth profile of a geom; `None` for a stale id.
    pub fn depth_profile(&self, geom: GeomId) -> Option<DepthProfile> {
        self.core.geom(geom)?;
        self.world.depths.profiles.get(geom).copied()
    }

    /// Sets the depth profile of a geom. If it is its body's object geom, the body's origin stays, so its
    /// height may change. An upright profile replaces the outline by its silhouette from the front, a
    /// rectangle.
    ///
    /// # Errors
    /// A stale id. A depth that is not finite and 0 or more. A radius that is not finite and greater than 0,
    /// or so great that the ball does not end at finite X and Y. A height that is not finite and greater than
    /// 0, or less than twice the radius of a capsule. An upright profile with another scheme than
    /// [`DepthScheme::Precise`].
    pub fn set_depth_profile(&mut self, geom: GeomId, profile: DepthProfile) -> Result<()> {
        let body = self.core.geom(geom).ok_or(stale("geom"))?.body();
        let profile = profile.check()?;
        if let Some(front) = profile.front() {
            if self.world.scheme != DepthScheme::Precise {
                return Err(only_precise("upright footprints"));
            }
            self.set_vertices(geom, front)?;
        }
        match self.box_radius_of(profile) {
            Some(radius) => self.core.set_box_radius(geom, Some(radius)).map_err(Error::from)?,
            // A geom that cannot have the AABB of its outline keeps its present one.
            None => _ = self.core.set_box_radius(geom, None),
        }
        self.world.depths.profiles.insert(geom, profile);
        self.world.depths.edit(body);
        Ok(())
    }

    /// Radius of the AABB of a ball, px; `None` for the AABB of the outline. The thesis' scheme uses outlines
    /// for balls as well.
    fn box_radius_of(&self, profile: DepthProfile) -> Option<f32> {
        match (profile, self.world.scheme) {
            (DepthProfile::Round { radius }, DepthScheme::Faithful | DepthScheme::Precise) => Some(radius),
            _ => None,
        }
    }

    /// Gives a geom the AABB of its depth profile.
    pub(super) fn fit_box(&mut self, geom: GeomId) {
        let profile = self.world.depths.profiles.get(geom);
        let radius = profile.and_then(|profile| self.box_radius_of(*profile));
        // The radius was accepted when the profile was set. A geom that cannot have it keeps the AABB of its
        // outline.
        let _ = self.core.set_box_radius(geom, radius);
    }

    /// Least and greatest Z of a geom, px, limited to finite numbers; `None` for a stale id.
    pub fn depth_interval(&self, geom: GeomId) -> Option<(f32, f32)> {
        let z = self.world.depths.z_of(self.core.geom(geom)?.body());
        let half = self.world.depths.profiles.get(geom)?.half_depth();
        Some((nearest_finite(z - half), nearest_finite(z + half)))
    }
}
