//! View of a platform for editing.

use farseer_core::{CollisionCategory, CollisionFilter};

use crate::depth::{DepthScheme, Platform, Platforms};
use crate::error::{invalid, only_precise};
use crate::projection::to_world;
use crate::{Projection, Result, Vector3};

/// A platform for editing, from
/// [`TwoHalfPhysicsSimulator::platform_mut`](crate::TwoHalfPhysicsSimulator::platform_mut). It dereferences
/// to [`Platform`].
#[derive(Debug)]
pub struct PlatformMut<'a> {
    pub(crate) platforms: &'a mut Platforms,
    pub(crate) projection: &'a Projection,
    pub(crate) scheme: DepthScheme,
    pub(crate) index: usize,
}

impl std::ops::Deref for PlatformMut<'_> {
    type Target = Platform;
    fn deref(&self) -> &Platform {
        self.platforms.at(self.index)
    }
}

impl PlatformMut<'_> {
    /// Moves the platform at once, px. It carries no objects and pushes out those that it then overlaps; use
    /// [`set_velocity`](Self::set_velocity) or [`move_to`](Self::move_to) for lifts. A hinge moves with the
    /// platform.
    ///
    /// # Errors
    /// The errors of [`Platform::new`].
    pub fn set_position3d(&mut self, position3d: Vector3) -> Result<()> {
        self.set(self.at(position3d, self.projection)?)
    }

    /// Tilts the platform about its centre, radians, clockwise on the screen.
    ///
    /// # Errors
    /// A rotation that is not finite.
    pub fn set_rotation(&mut self, rotation: f32) -> Result<()> {
        self.set(self.tilted(rotation, self.projection)?)
    }

    pub(super) fn set(&mut self, platform: Platform) -> Result<()> {
        self.platforms.replace(self.index, platform);
        Ok(())
    }

    /// Sets the velocity of the platform, px/s, along X, **up** and along Z, until it is set again. The
    /// platform acts as a [kinematic](crate::TwoHalfBody::set_is_kinematic) body of infinite mass. It pushes
    /// and wakes bodies and carries them by friction, if both have some. It passes through static bodies and
    /// other platforms.
    ///
    /// Objects follow a descending platform in free fall. Per step they lag by half of the velocity that
    /// gravity adds. They separate from a lift whose downward speed grows faster, until they have caught up.
    ///
    /// ```
    /// use twohalf::{Platform, TwoHalfPhysicsSimulator, Vector3};
    /// let mut simulator = TwoHalfPhysicsSimulator::new(480)?;
    /// let lift = Platform::new(&mut simulator, 80.0, 10.0, 40.0, Vector3::zeros(), None)?;
    /// simulator.platform_mut(lift).unwrap().set_velocity(Vector3::new(0.0, 60.0, 0.0))?;
    /// (0..100).for_each(|_| simulator.update(0.01));
    /// assert!((simulator.platform(lift).unwrap().position3d().y - 60.0).abs() < 0.001);
    /// # Ok::<(), twohalf::Error>(())
    /// ```
    ///
    /// # Errors
    /// A velocity that is not finite; a platform with a [hinge](Self::set_swing); another scheme than
    /// [`DepthScheme::Precise`].
    pub fn set_velocity(&mut self, velocity: Vector3) -> Result<()> {
        self.check_precise("moving platforms")?;
        if !velocity.iter().all(|number| number.is_finite()) {
            return Err(invalid("velocity", velocity, "finite"));
        }
        self.check_swings_not("velocity", velocity)?;
        self.platforms.set_motion(self.index, to_world(velocity), None);
        Ok(())
    }

    /// Sets a target: the next update moves the platform to a [position](Platform::position3d), to the last
    /// bit, with the velocity of that move. After that update it stops, unless it gets a new target or
    /// velocity before. A target that needs an infinite velocity is dropped. A move of more than 128 px per
    /// update pushes only the objects that the platform overlaps at its end.
    ///
    /// # Errors
    /// The errors of [`Platform::new`]; a platform with a [hinge](Self::set_swing); another scheme than
    /// [`DepthScheme::Precise`].
    pub fn move_to(&mut self, position3d: Vector3) -> Result<()> {
        self.check_precise("moving platforms")?;
        self.at(position3d, self.projection)?;
        self.check_swings_not("position3d", position3d)?;
        let before = self.prescribed_velocity();
        self.platforms.set_motion(self.index, before, Some(position3d));
        Ok(())
    }

    /// Makes the surface a belt that moves with `along` px/s along the level edges, to the right, and `depth`
    /// px/s along Z. Friction accelerates objects up to that speed, on the sides as well. Default none.
    ///
    /// # Errors
    /// A speed that is not finite; a platform that turns or swings; another scheme than
    /// [`DepthScheme::Precise`].
    pub fn set_surface_speed(&mut self, along: f32, depth: f32) -> Result<()> {
        self.check_precise("belts of platforms")?;
        for (argument, value) in [("along", along), ("depth", depth)] {
            if !value.is_finite() {
                return Err(invalid(argument, value, "finite"));
            }
        }
        *self.platforms.edit(self.index) = self.with_surface_speed([along, depth])?;
        Ok(())
    }

    /// Makes the platform one-way: objects pass through it from below and from the sides, and land on its
    /// top. An object that stands on it at the time of this call stays on top. To drop through it, a geom
    /// removes the platform's categories from its mask
    /// ([`Geom::set_collides_with`](farseer_core::Geom::set_collides_with)) until it is below the top, and
    /// the platform those of the geom. Default false.
    ///
    /// # Errors
    /// True with another scheme than [`DepthScheme::Precise`].
    pub fn set_one_way(&mut self, value: bool) -> Result<()> {
        if value {
            self.check_precise("one-way platforms")?;
        }
        if value != self.is_one_way() {
            self.platforms.edit(self.index).set_one_way(value);
        }
        Ok(())
    }

    pub(super) fn check_precise(&self, what: &'static str) -> Result<()> {
        if self.scheme == DepthScheme::Precise { Ok(()) } else { Err(only_precise(what)) }
    }

    /// Sets the friction coefficient, dimensionless. A value that is not finite is rejected and reported by
    /// the next update.
    pub fn set_friction_coefficient(&mut self, value: f32) {
        let platform = self.platforms.edit(self.index);
        platform.set_coefficient("friction_coefficient", value, |surface| &mut surface.friction);
    }

    /// Sets the restitution coefficient, dimensionless. A value that is not finite is rejected and reported
    /// by the next update.
    pub fn set_restitution_coefficient(&mut self, value: f32) {
        let platform = self.platforms.edit(self.index);
        platform.set_coefficient("restitution_coefficient", value, |surface| &mut surface.restitution);
    }

    /// Sets the collision categories that the platform belongs to.
    pub fn set_collision_categories(&mut self, value: CollisionCategory) {
        self.filter().categories = value;
    }

    /// Sets the collision categories that the platform collides with.
    pub fn set_collides_with(&mut self, value: CollisionCategory) {
        self.filter().collides_with = value;
    }

    /// Sets the collision group of the platform: it does not collide with geoms of the same group; 0 is no group.
    pub fn set_collision_group(&mut self, value: i32) {
        self.filter().group = value;
    }

    /// Sets whether the platform collides at all.
    pub fn set_collision_enabled(&mut self, value: bool) {
        self.filter().is_enabled = value;
    }

    /// Sets whether contacts of the platform exert impulses.
    pub fn set_collision_response_enabled(&mut self, value: bool) {
        self.filter().responds = value;
    }

    fn filter(&mut self) -> &mut CollisionFilter {
        self.platforms.edit(self.index).filter_mut()
    }
}
