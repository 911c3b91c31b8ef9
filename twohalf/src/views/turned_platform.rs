//! Editing of pitch, yaw and angular velocity of platforms.

use super::PlatformMut;
use crate::Result;
use crate::error::invalid;

impl PlatformMut<'_> {
    /// Sets the slope of the platform along Z, radians: its top and underside rise towards the back by the
    /// tangent of the pitch. Its other sides stay upright, and its depth stays. A negative pitch falls
    /// towards the back. A [tilt](Self::set_rotation) adds a slope along X. Default 0.
    ///
    /// ```
    /// use twohalf::{Platform, TwoHalfPhysicsSimulator, Vector2, Vector3};
    /// let mut simulator = TwoHalfPhysicsSimulator::with_gravity(480, Vector2::new(0.0, 900.0))?;
    /// let place = Vector3::new(0.0, 0.0, 100.0);
    /// let slope = Platform::new(&mut simulator, 200.0, 10.0, 80.0, place, None)?;
    /// simulator.platform_mut(slope).unwrap().set_pitch(0.5)?;
    /// let at_the_back = simulator.surface_beneath(Vector3::new(0.0, 90.0, 130.0)).unwrap();
    /// assert!((at_the_back.height - (10.0 + 30.0 * 0.5f32.tan())).abs() < 0.001);
    /// # Ok::<(), twohalf::Error>(())
    /// ```
    ///
    /// # Errors
    /// A pitch that is not between -1.4 and 1.4; a pitch other than 0 of a platform that is
    /// [turned](Self::set_yaw), or with another scheme than
    /// [`DepthScheme::Precise`](crate::DepthScheme::Precise).
    pub fn set_pitch(&mut self, pitch: f32) -> Result<()> {
        if pitch != 0.0 {
            self.check_precise("slopes along Z")?;
        }
        self.set(self.pitched(pitch, self.projection)?)
    }

    /// Sets the angle of the platform about the upright axis through its centre, radians, from X to Z:
    /// counterclockwise as seen from above. Objects are not carried along: see
    /// [`set_angular_velocity`](Self::set_angular_velocity). A [hinged](Self::set_swing) platform turns about
    /// its hinge. Default 0.
    ///
    /// # Errors
    /// An angle that is not finite, or beyond the stops of a hinge; a platform that is a slope or sheared;
    /// another scheme than [`DepthScheme::Precise`](crate::DepthScheme::Precise).
    pub fn set_yaw(&mut self, yaw: f32) -> Result<()> {
        self.check_precise("platforms that are turned about an upright axis")?;
        self.set(self.turned(yaw, self.projection)?)
    }

    /// Sets the angular velocity of the platform about the upright axis through its centre, radians/s, until
    /// it is set again; from X to Z: counterclockwise as seen from above. The platform has infinite mass: it
    /// carries objects by friction and pushes others with its sides. It may [move](Self::set_velocity) at the
    /// same time. For a [hinged](Self::set_swing) platform this is the initial angular velocity about the
    /// hinge.
    ///
    /// ```
    /// use twohalf::{Platform, TwoHalfPhysicsSimulator, Vector3};
    /// let mut simulator = TwoHalfPhysicsSimulator::new(480)?;
    /// let table = Platform::new(&mut simulator, 80.0, 10.0, 80.0, Vector3::new(0.0, 0.0, 100.0), None)?;
    /// simulator.platform_mut(table).unwrap().set_angular_velocity(0.5)?;
    /// (0..100).for_each(|_| simulator.update(0.01));
    /// assert!((simulator.platform(table).unwrap().yaw() - 0.5).abs() < 0.001);
    /// # Ok::<(), twohalf::Error>(())
    /// ```
    ///
    /// # Errors
    /// The errors of [`set_yaw`](Self::set_yaw); a platform with a [belt](Self::set_surface_speed) as surface.
    pub fn set_angular_velocity(&mut self, angular_velocity: f32) -> Result<()> {
        if !angular_velocity.is_finite() {
            return Err(invalid("angular_velocity", angular_velocity, "finite"));
        }
        self.set_turning(angular_velocity, None)
    }

    /// Sets a target angle, radians: the next update turns the platform to it, to the last bit, with the
    /// angular velocity of that turn. After that update it stops, unless it gets a new target or angular
    /// velocity before. It turns by the full difference of the angles, which may be several revolutions.
    ///
    /// # Errors
    /// The errors of [`set_angular_velocity`](Self::set_angular_velocity); a platform with a
    /// [hinge](Self::set_swing).
    pub fn turn_to(&mut self, yaw: f32) -> Result<()> {
        if !yaw.is_finite() {
            return Err(invalid("yaw", yaw, "finite"));
        }
        let turning = self.angular_velocity();
        self.set_turning(turning, Some((yaw, false)))
    }

    fn set_turning(&mut self, turning: f32, yaw_target: Option<(f32, bool)>) -> Result<()> {
        self.check_precise("platforms that turn about an upright axis")?;
        let (platform, stood_still) = self.turning(turning, yaw_target, self.projection)?;
        self.platforms.turn(self.index, platform, stood_still);
        Ok(())
    }
}
