//! Editing of hinged platforms.

use super::PlatformMut;
use crate::depth::Swing;
use crate::error::invalid;
use crate::{Result, Vector3};

impl PlatformMut<'_> {
    /// Puts the platform on an upright hinge: a saloon door, a turnstile, a pinball flap. At a distance r
    /// from the hinge contacts see it as a mass of I / r², with [I its moment of
    /// inertia](Swing::moment_of_inertia). It rotates about the hinge only.
    /// [Characters](crate::TwoHalfPhysicsSimulator::walk) push it open. It passes through static bodies and
    /// other platforms; [stops](Swing::least_angle) keep it out of walls. At rest it sleeps until it is
    /// touched.
    ///
    /// It starts at rest at its present [yaw](crate::Platform::yaw).
    /// [`set_angular_velocity`](Self::set_angular_velocity) sets it in motion. A body between it and a wall
    /// gets the force of its spring only.
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
    /// A moment of inertia that is not finite and greater than 0. A stiffness or damping that is not 0 or
    /// more, or too great for the moment of inertia. A hinge that is not finite, or so far away that corners
    /// are not finite at every angle. Angles that are not finite. Stops that exclude the present yaw. A
    /// platform that is a slope, a belt or sheared. Another scheme than
    /// [`DepthScheme::Precise`](crate::DepthScheme::Precise).
    pub fn set_swing(&mut self, swing: Swing) -> Result<()> {
        self.check_precise("platforms that swing about a hinge")?;
        let platform = self.swinging(Some(&swing), self.projection)?;
        self.platforms.swing(self.index, platform);
        Ok(())
    }

    /// Removes the hinge: the platform stops where it is. No effect without a hinge.
    ///
    /// # Errors
    /// None for a platform that has a hinge.
    pub fn clear_swing(&mut self) -> Result<()> {
        if self.swing().is_some() {
            let platform = self.swinging(None, self.projection)?;
            self.platforms.swing(self.index, platform);
        }
        Ok(())
    }

    /// Returns an error for a velocity or target of a hinged platform.
    pub(super) fn check_swings_not(&self, argument: &'static str, value: Vector3) -> Result<()> {
        match self.swing() {
            None => Ok(()),
            Some(_) => Err(invalid(argument, value, "told to a platform that does not swing")),
        }
    }
}
