//! Platforms that rise along Z, and platforms that are turned about an upright axis, or turn about it.

use farseer_core::math::scalar;

use super::{Motion, Platform};
#[cfg(doc)]
use crate::PlatformMut;
use crate::error::invalid;
use crate::projection::to_world;
use crate::shapes::SlantedBox;
use crate::{Projection, Result, Vector3};

/// The steepest pitch, rad: about 80 degrees.
const STEEPEST: f32 = 1.4;

impl Platform {
    /// How much its top rises towards the back, rad: see [`set_pitch`](PlatformMut::set_pitch).
    pub fn pitch(&self) -> f32 {
        self.pitch
    }

    /// The angle by which it is turned about the upright axis through its middle, rad, from X to Z: counterclockwise as seen from
    /// above.
    pub fn yaw(&self) -> f32 {
        self.yaw.unwrap_or_default()
    }

    /// How fast it turns about that axis, rad/s. One that is [told an angle](PlatformMut::turn_to) has for an update the speed of its
    /// way there.
    pub fn angular_velocity(&self) -> f32 {
        self.motion.map_or(0.0, |motion| motion.told.turning)
    }

    /// Velocity in the world, px/s, Y up, with which it moves at a place, by its turning as well; without that of its surface.
    pub fn velocity_at(&self, place: Vector3) -> Vector3 {
        let (turning, out) = (self.angular_velocity(), place - self.shape.centre);
        self.velocity() + Vector3::new(-turning * out.z, 0.0, turning * out.x)
    }

    /// How fast it climbs along Z.
    pub(super) fn climb(&self) -> f32 {
        let (sin, cos) = scalar::sin_cos_of_any(self.pitch);
        if self.pitch == 0.0 { 0.0 } else { sin / cos }
    }

    /// Refuses what no platform can have.
    pub(super) fn check_turn(&self) -> Result<()> {
        if !(self.pitch.is_finite() && self.pitch.abs() <= STEEPEST) {
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
        let turns = |Motion { told, .. }: Motion| {
            told.turning != 0.0 || told.yaw_target.is_some() || told.swing().is_some()
        };
        let turns = self.motion.is_some_and(turns);
        if turns && self.surface_speed != [0.0; 2] {
            return Err(invalid("surface_speed", self.surface_speed, "0 of a platform that turns"));
        }
        Ok(())
    }

    /// Whether it is what only the precise set knows.
    pub(super) fn is_sloped_or_turned(&self) -> bool {
        self.pitch != 0.0 || self.yaw.is_some()
    }

    /// Velocity of its surface in the world, Y up, beside that of its own motion.
    pub(crate) fn belt(&self) -> Vector3 {
        to_world(self.surface_velocity().into())
    }

    pub(super) fn surface_velocity(&self) -> [f32; 3] {
        let ([along, across], SlantedBox { cos, sin, turn: [turned, aside], .. }) =
            (self.surface_speed, self.shape);
        if self.yaw.is_some() && self.surface_speed == [0.0; 2] {
            // Without the signs of zeros that turning leaves.
            [0.0; 3]
        } else if self.yaw.is_some() {
            [along * turned - across * aside, 0.0, along * aside + across * turned]
        } else {
            [along * cos, along * sin, across]
        }
    }

    /// Rising along Z.
    pub(crate) fn pitched(&self, pitch: f32, projection: &Projection) -> Result<Self> {
        Platform { pitch, ..self.clone() }.shaped(projection)
    }

    /// Turned about the upright axis.
    pub(crate) fn turned(&self, yaw: f32, projection: &Projection) -> Result<Self> {
        let turns = self.motion.is_some() && self.yaw.is_some();
        let mut platform = Platform { yaw: Some(yaw).filter(|&yaw| yaw != 0.0 || turns), ..self.clone() };
        if let Some(motion) = &mut platform.motion {
            motion.told.yaw_target = None;
        }
        if platform.swing().is_some() {
            platform.put_at(yaw)?;
        }
        platform.shaped(projection)
    }

    /// Turning about the upright axis, or to an angle; and whether it did not so far, and so becomes something else to the engine
    /// below.
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
        let still = || Motion { centre: self.shape.centre, ..Motion::default() };
        let mut motion = self.motion.unwrap_or_else(still);
        (motion.told.turning, motion.told.yaw_target) = (turning, yaw_target);
        let platform = Platform { motion: Some(motion), yaw: self.yaw.or(Some(0.0)), ..self.clone() };
        Ok((platform.shaped(projection)?, stood_still))
    }
}
