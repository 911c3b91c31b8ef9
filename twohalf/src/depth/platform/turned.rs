//! Platforms that rise along Z, and platforms with a yaw or an angular velocity about an upright axis.

use farseer_core::math::scalar;

use super::{Platform, PlatformMotion};
#[cfg(doc)]
use crate::PlatformMut;
use crate::error::invalid;
use crate::projection::to_world;
use crate::shapes::SlantedBox;
use crate::{Projection, Result, Vector3};

/// Greatest pitch, radians: about 80 degrees.
const MAX_PITCH: f32 = 1.4;

impl Platform {
    /// Slope of the platform's top along Z, radians, positive towards the back: see [`set_pitch`](PlatformMut::set_pitch).
    pub fn pitch(&self) -> f32 {
        self.pitch
    }

    /// Angle of the platform about the upright axis through its centre, radians, from X to Z: counterclockwise as seen from
    /// above.
    pub fn yaw(&self) -> f32 {
        self.yaw.unwrap_or_default()
    }

    /// Angular velocity of the platform about the upright axis through its centre, radians/s. With a [target
    /// angle](PlatformMut::turn_to) it has the angular velocity of that turn for one update.
    pub fn angular_velocity(&self) -> f32 {
        self.motion.map_or(0.0, |motion| motion.core_motion.yaw_rate)
    }

    /// Returns the velocity of the platform's material at a place of the world, px/s, Y up, with rotation and without surface
    /// velocity.
    pub fn velocity_at(&self, place: Vector3) -> Vector3 {
        let (turning, out) = (self.angular_velocity(), place - self.shape.centre);
        self.velocity() + Vector3::new(-turning * out.z, 0.0, turning * out.x)
    }

    /// Returns the height that the platform's top gains per px along Z, dimensionless.
    pub(super) fn climb(&self) -> f32 {
        let (sin, cos) = scalar::sin_cos_of_any(self.pitch);
        if self.pitch == 0.0 { 0.0 } else { sin / cos }
    }

    /// Returns an error for combinations of pitch, yaw and belt that are not supported.
    pub(super) fn check_turn(&self) -> Result<()> {
        if !(self.pitch.is_finite() && self.pitch.abs() <= MAX_PITCH) {
            return Err(invalid("pitch", self.pitch, "between -1.4 and 1.4"));
        }
        let Some(yaw) = self.yaw else { return Ok(()) };
        if !yaw.is_finite() {
            return Err(invalid("yaw", yaw, "finite"));
        }
        let is_level = self.rotation == 0.0 && self.pitch == 0.0 && self.shape.shear == 0.0;
        if !is_level {
            return Err(invalid("yaw", yaw, "0 of a platform that is a slope, or leans"));
        }
        let turns = |PlatformMotion { core_motion, .. }: PlatformMotion| {
            core_motion.yaw_rate != 0.0 || core_motion.yaw_target.is_some() || core_motion.hinge().is_some()
        };
        let turns = self.motion.is_some_and(turns);
        if turns && self.surface_speed != [0.0; 2] {
            return Err(invalid("surface_speed", self.surface_speed, "0 of a platform that turns"));
        }
        Ok(())
    }

    /// Returns whether the platform has a pitch or a yaw, which only the precise set supports.
    pub(super) fn is_sloped_or_turned(&self) -> bool {
        self.pitch != 0.0 || self.yaw.is_some()
    }

    /// Returns the velocity of the platform's surface (belt) in the world, px/s, Y up, relative to the motion of the platform.
    pub(crate) fn world_surface_velocity(&self) -> Vector3 {
        to_world(self.surface_velocity().into())
    }

    pub(super) fn surface_velocity(&self) -> [f32; 3] {
        let ([along, across], SlantedBox { cos, sin, turn: [turned, aside], .. }) =
            (self.surface_speed, self.shape);
        if self.yaw.is_some() && self.surface_speed == [0.0; 2] {
            // Zero without the signs that the rotation would give.
            [0.0; 3]
        } else if self.yaw.is_some() {
            [along * turned - across * aside, 0.0, along * aside + across * turned]
        } else {
            [along * cos, along * sin, across]
        }
    }

    /// Returns the platform with another pitch, radians.
    pub(crate) fn pitched(&self, pitch: f32, projection: &Projection) -> Result<Self> {
        Platform { pitch, ..self.clone() }.shaped(projection)
    }

    /// Returns the platform with another yaw, radians.
    pub(crate) fn turned(&self, yaw: f32, projection: &Projection) -> Result<Self> {
        let turns = self.motion.is_some() && self.yaw.is_some();
        let mut platform = Platform { yaw: Some(yaw).filter(|&yaw| yaw != 0.0 || turns), ..self.clone() };
        if let Some(motion) = &mut platform.motion {
            motion.core_motion.yaw_target = None;
        }
        if platform.swing().is_some() {
            platform.set_hinge_angle(yaw)?;
        }
        platform.shaped(projection)
    }

    /// Returns the platform with an angular velocity (radians/s) or a target angle (radians), and whether it did not turn
    /// before. In that case the core receives it as a moving box.
    pub(crate) fn turning(
        &self,
        turning: f32,
        yaw_target: Option<(f32, bool)>,
        projection: &Projection,
    ) -> Result<(Self, bool)> {
        let turns = turning != 0.0 || yaw_target.is_some();
        if let (Some((yaw, _)), Some(_)) = (yaw_target, self.swing()) {
            return Err(invalid("yaw", yaw, "told to a platform that does not swing"));
        }
        if turns && self.surface_speed != [0.0; 2] {
            return Err(invalid("angular_velocity", turning, "0 of a platform whose surface is a belt"));
        }
        let stood_still = self.motion.is_none() || self.yaw.is_none();
        let still = || PlatformMotion { centre: self.shape.centre, ..PlatformMotion::default() };
        let mut motion = self.motion.unwrap_or_else(still);
        (motion.core_motion.yaw_rate, motion.core_motion.yaw_target) = (turning, yaw_target);
        let platform = Platform { motion: Some(motion), yaw: self.yaw.or(Some(0.0)), ..self.clone() };
        Ok((platform.shaped(projection)?, stood_still))
    }
}
