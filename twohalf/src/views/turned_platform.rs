//! A platform that is to rise along Z, or to turn about an upright axis.

use super::PlatformMut;
use crate::Result;
use crate::error::invalid;

impl PlatformMut<'_> {
    /// Makes the platform a slope along Z: its top and its underside rise towards the back by the tangent of the pitch, rad; its
    /// other sides stay upright, and it as deep as it is. A negative pitch falls towards the back. With a
    /// [tilt](Self::set_rotation) as well the slope leads aslant. Default 0.
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
    /// A pitch that is not between -1.4 and 1.4; one that is not 0 of a platform that is [turned](Self::set_yaw), or with another
    /// scheme than [`DepthScheme::Precise`](crate::DepthScheme::Precise).
    pub fn set_pitch(&mut self, pitch: f32) -> Result<()> {
        if pitch != 0.0 {
            self.check_precise("slopes along Z")?;
        }
        self.set(self.pitched(pitch, self.projection)?)
    }

    /// Turns the platform about the upright axis through its middle, rad, from X to Z: counterclockwise as seen from above. Nothing
    /// is carried along: see [`set_angular_velocity`](Self::set_angular_velocity). One that [swings](Self::set_swing) is put to
    /// that angle about its hinge. Default 0.
    ///
    /// # Errors
    /// What is not finite, or beyond the stops of one that swings; a platform that is a slope, or whose edges in depth do not run along Z; another scheme than
    /// [`DepthScheme::Precise`](crate::DepthScheme::Precise).
    pub fn set_yaw(&mut self, yaw: f32) -> Result<()> {
        self.check_precise("platforms that are turned about an upright axis")?;
        self.set(self.turned(yaw, self.projection)?)
    }

    /// Lets the platform turn about the upright axis through its middle, rad/s, until it is told otherwise; from X to Z:
    /// counterclockwise as seen from above. It carries what stands on it by friction, pushes what its sides meet, and is pushed by
    /// nothing. It may [move](Self::set_velocity) at the same time. One that [swings](Self::set_swing) does so about its hinge, from
    /// this velocity on.
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
    /// As [`set_yaw`](Self::set_yaw); a platform whose surface is a [belt](Self::set_surface_speed).
    pub fn set_angular_velocity(&mut self, angular_velocity: f32) -> Result<()> {
        if !angular_velocity.is_finite() {
            return Err(invalid("angular_velocity", angular_velocity, "finite"));
        }
        self.set_turning(angular_velocity, None)
    }

    /// Lets the next update turn the platform to an angle, which it then has to the last bit, with the angular velocity that does.
    /// In the update after that it stands still, unless it is told a new angle or given an angular velocity before. It turns as
    /// far as the angle is from the one that it has: that may be several times around.
    ///
    /// # Errors
    /// As [`set_angular_velocity`](Self::set_angular_velocity); a platform that [swings](Self::set_swing).
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
