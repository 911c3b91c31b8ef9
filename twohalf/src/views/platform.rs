//! A platform, to be changed.

use farseer_core::{CollisionCategory, CollisionFilter};

use crate::depth::{DepthScheme, Platform, Platforms};
use crate::error::{invalid, only_precise};
use crate::projection::to_world;
use crate::{Projection, Result, Vector3};

/// A platform to change: what [`TwoHalfPhysicsSimulator::platform_mut`](crate::TwoHalfPhysicsSimulator::platform_mut) gives. Dereferences to [`Platform`].
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
    /// Puts the platform elsewhere. Nothing is carried along: what it comes to overlap is pushed out. To move it with what
    /// stands on it: [`set_velocity`](Self::set_velocity), [`move_to`](Self::move_to). The hinge of one that swings goes along.
    ///
    /// # Errors
    /// As [`Platform::new`].
    pub fn set_position3d(&mut self, position3d: Vector3) -> Result<()> {
        self.set(self.at(position3d, self.projection)?)
    }

    /// Tilts the platform about its middle, rad, clockwise on the screen.
    ///
    /// # Errors
    /// What is not finite.
    pub fn set_rotation(&mut self, rotation: f32) -> Result<()> {
        self.set(self.tilted(rotation, self.projection)?)
    }

    pub(super) fn set(&mut self, platform: Platform) -> Result<()> {
        self.platforms.replace(self.index, platform);
        Ok(())
    }

    /// Lets the platform move, along X, **up** and along Z, px/s, until it is told otherwise. As a
    /// [kinematic](crate::TwoHalfBody::set_is_kinematic) body it has infinite mass: it pushes what it touches, wakes it, and carries
    /// it by friction, so that the platform and what stands on it need some. It passes through static things and other platforms.
    ///
    /// What stands on it goes down with it as fast as it falls. In a step that is half of what gravity adds to its velocity
    /// faster than before: a lift whose speed grows by more than that per step is left until what stood on it has caught up.
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
    /// What is not finite; a platform that [swings](Self::set_swing); another scheme than [`DepthScheme::Precise`].
    pub fn set_velocity(&mut self, velocity: Vector3) -> Result<()> {
        self.check_precise("moving platforms")?;
        if !velocity.iter().all(|number| number.is_finite()) {
            return Err(invalid("velocity", velocity, "finite"));
        }
        self.check_swings_not("velocity", velocity)?;
        self.platforms.set_motion(self.index, to_world(velocity), None);
        Ok(())
    }

    /// Lets the next update bring the platform to a [position](Platform::position3d), where it then is to the last bit, with the
    /// velocity that does. In the update after that it stands still, unless it is told a new place or given a velocity before.
    /// A place to which no finite velocity leads is forgotten. What goes farther than 128 px in an update pushes what it comes to
    /// overlap, and nothing on its way.
    ///
    /// # Errors
    /// As [`Platform::new`]; a platform that [swings](Self::set_swing); another scheme than [`DepthScheme::Precise`].
    pub fn move_to(&mut self, position3d: Vector3) -> Result<()> {
        self.check_precise("moving platforms")?;
        self.at(position3d, self.projection)?;
        self.check_swings_not("position3d", position3d)?;
        let before = self.told_velocity();
        self.platforms.set_motion(self.index, before, Some(position3d));
        Ok(())
    }

    /// Makes the surface a belt: `along` px/s along its level edges, to the right, and `depth` px/s along Z. What lies on it is
    /// carried by friction up to that speed; the sides carry as the top does. Default none.
    ///
    /// # Errors
    /// What is not finite; a platform that turns or swings; another scheme than [`DepthScheme::Precise`].
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

    /// Opens the platform from below and from its sides: what jumps or is thrown up passes through it, and lands on its top when
    /// it comes down. What stands on it when this is switched on stays there. To drop through it, a geom leaves out its
    /// categories ([`Geom::set_collides_with`](farseer_core::Geom::set_collides_with)) until it is below the top, and the platform those of the geom. Default false.
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

    /// Sets the friction. What is not finite is rejected and reported by the next update.
    pub fn set_friction_coefficient(&mut self, value: f32) {
        let platform = self.platforms.edit(self.index);
        platform.set_coefficient("friction_coefficient", value, |surface| &mut surface.friction);
    }

    /// Sets the bounciness. What is not finite is rejected and reported by the next update.
    pub fn set_restitution_coefficient(&mut self, value: f32) {
        let platform = self.platforms.edit(self.index);
        platform.set_coefficient("restitution_coefficient", value, |surface| &mut surface.restitution);
    }

    /// Sets the categories that it belongs to.
    pub fn set_collision_categories(&mut self, value: CollisionCategory) {
        self.filter().categories = value;
    }

    /// Sets the categories that it collides with.
    pub fn set_collides_with(&mut self, value: CollisionCategory) {
        self.filter().collides_with = value;
    }

    /// Sets the group.
    pub fn set_collision_group(&mut self, value: i32) {
        self.filter().group = value;
    }

    /// Lets it meet things or not.
    pub fn set_collision_enabled(&mut self, value: bool) {
        self.filter().is_enabled = value;
    }

    /// Lets it push what touches it or not.
    pub fn set_collision_response_enabled(&mut self, value: bool) {
        self.filter().responds = value;
    }

    fn filter(&mut self) -> &mut CollisionFilter {
        self.platforms.edit(self.index).filter_mut()
    }
}
