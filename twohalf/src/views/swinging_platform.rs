//! A platform that is to swing about an upright hinge.

use super::PlatformMut;
use crate::depth::Swing;
use crate::error::invalid;
use crate::{Result, Vector3};

impl PlatformMut<'_> {
    /// Lets the platform swing about an upright hinge: a saloon door, a turnstile, a pinball's flap. It is pushed by what presses on it
    /// as a body is that weighs I / r² at a distance r from the hinge, with [I its moment of inertia](Swing::moment_of_inertia), and
    /// pushes back; nothing shifts or tips it. Figures that [walk](crate::TwoHalfPhysicsSimulator::walk) push it open. It passes
    /// through static things and other platforms: [stops](Swing::least_angle) keep it out of walls. At rest it sleeps, until
    /// something touches it.
    ///
    /// It begins at rest, at the angle that it [is turned by](crate::Platform::yaw). To push it otherwise:
    /// [`set_angular_velocity`](Self::set_angular_velocity). Whoever is between it and a wall when it swings back bears the push of
    /// its spring, and no more.
    ///
    /// ```
    /// use std::f32::consts::PI;
    /// use twohalf::{Platform, Swing, TwoHalfPhysicsSimulator, Vector3};
    /// let mut simulator = TwoHalfPhysicsSimulator::new(480)?;
    /// // A slab of 60 x 80 x 6 px and mass 3, whose hinge is its left end.
    /// let door = Platform::new(&mut simulator, 60.0, 80.0, 6.0, Vector3::new(130.0, 0.0, 100.0), None)?;
    /// let moment_of_inertia = 3.0 * (60.0 * 60.0 / 3.0 + 6.0 * 6.0 / 12.0);
    /// // There and back in a second.
    /// let stiffness = moment_of_inertia * (2.0 * PI) * (2.0 * PI);
    /// simulator.platform_mut(door).unwrap().set_swing(Swing {
    ///     hinge: [100.0, 100.0],
    ///     moment_of_inertia,
    ///     stiffness,
    ///     damping: 0.0,
    ///     rest_angle: 0.0,
    ///     least_angle: -1.5,
    ///     greatest_angle: 1.5,
    /// })?;
    /// simulator.platform_mut(door).unwrap().set_angular_velocity(2.0)?;
    /// (0..25).for_each(|_| simulator.update(0.01));
    /// // After a quarter of that it has come as far as it does.
    /// let yaw = simulator.platform(door).unwrap().yaw();
    /// assert!((yaw - 2.0 / (2.0 * PI)).abs() < 0.001);
    /// # Ok::<(), twohalf::Error>(())
    /// ```
    ///
    /// # Errors
    /// A moment of inertia that is not finite and greater than 0; a stiffness or damping that is not 0 or more, or too great for its
    /// moment of inertia; a hinge that is not finite, or so far away that not all corners are finite at every angle; angles that are
    /// not finite; stops between which the platform is not; a platform that is a slope, or a belt, or whose edges in depth do not run
    /// along Z; another scheme than [`DepthScheme::Precise`](crate::DepthScheme::Precise).
    pub fn set_swing(&mut self, swing: Swing) -> Result<()> {
        self.check_precise("platforms that swing about a hinge")?;
        let platform = self.swinging(Some(&swing), self.projection)?;
        self.platforms.swing(self.index, platform);
        Ok(())
    }

    /// Takes the platform off its hinge: it stands still where it is. Of one that does not swing this changes nothing.
    ///
    /// # Errors
    /// None that a platform can have which swings.
    pub fn clear_swing(&mut self) -> Result<()> {
        if self.swing().is_some() {
            let platform = self.swinging(None, self.projection)?;
            self.platforms.swing(self.index, platform);
        }
        Ok(())
    }

    /// Refuses to be moved by the game while it swings.
    pub(super) fn check_swings_not(&self, argument: &'static str, value: Vector3) -> Result<()> {
        match self.swing() {
            None => Ok(()),
            Some(_) => Err(invalid(argument, value, "told to a platform that does not swing")),
        }
    }
}
