//! Platforms that swing about an upright hinge.

use farseer_core::math::scalar::nearest_finite;
use farseer_core::{Error, FixtureMotion, FixtureSwing, Swings};
use serde::{Deserialize, Serialize};

use super::{Motion, Platform};
#[cfg(doc)]
use crate::PlatformMut;
use crate::error::invalid;
use crate::{Projection, Result, Vector3};

/// How a platform [swings](PlatformMut::set_swing) about an upright hinge, as what presses on it, a spring and a damper tell it to.
/// Angles are those of [`Platform::yaw`], rad; masses are those of bodies.
///
/// With moment of inertia I, stiffness k and damping c, left alone it swings by I θ″ + c θ′ + k (θ − θ₀) = 0: without a damper in
/// 2π √(I / k) s there and back; with c = 2 √(k I) it comes back as fast as it can without passing its rest angle.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Swing {
    /// X and Z of the hinge, px: anywhere, also beside the platform.
    pub hinge: [f32; 2],
    /// Moment of inertia about the hinge, mass · px²: that of an even slab of mass m, width w and depth d about the end of its width
    /// is m (w² / 3 + d² / 12).
    pub moment_of_inertia: f32,
    /// What the spring turns it back with, mass · px²/s² per rad; 0 is no spring.
    pub stiffness: f32,
    /// What the damper slows it with, mass · px²/s per rad; 0 is no damper.
    pub damping: f32,
    /// The angle to which the spring turns it, rad. It may be beyond the stops: then the platform is pressed against one.
    pub rest_angle: f32,
    /// The least angle that it can have, rad: a stop, at which it comes to rest without bouncing.
    pub least_angle: f32,
    /// The greatest, rad.
    pub greatest_angle: f32,
}

impl Swing {
    fn check(&self) -> Result<()> {
        let inertia = self.moment_of_inertia;
        if !(inertia.is_finite() && inertia > 0.0 && (1.0 / inertia).is_normal()) {
            return Err(invalid(
                "moment_of_inertia",
                inertia,
                "greater than 0, and finite as its reciprocal is",
            ));
        }
        for (argument, value) in [("stiffness", self.stiffness), ("damping", self.damping)] {
            if !(value >= 0.0 && (value / inertia).is_finite()) {
                return Err(invalid(argument, value, "0 or more, and finite, also by the moment of inertia"));
            }
        }
        if !self.hinge.iter().all(|number| number.is_finite()) {
            return Err(invalid("hinge", self.hinge, "finite"));
        }
        if !self.rest_angle.is_finite() {
            return Err(invalid("rest_angle", self.rest_angle, "finite"));
        }
        if !(self.least_angle.is_finite() && self.least_angle <= self.greatest_angle) {
            return Err(invalid(
                "least_angle",
                self.least_angle,
                "finite, and no more than the greatest angle",
            ));
        }
        if !self.greatest_angle.is_finite() {
            return Err(invalid("greatest_angle", self.greatest_angle, "finite"));
        }
        Ok(())
    }

    fn is_within(&self, yaw: f32) -> bool {
        (self.least_angle..=self.greatest_angle).contains(&yaw)
    }

    /// As the 2D engine below is told of it, of a platform whose middle is seen from the hinge like this while it is not turned.
    fn told(&self, out: [f32; 2]) -> Result<FixtureSwing> {
        let refused = Error::NotSupported {
            what: "platforms that swing, which are the feature `swing`",
            methods: "compiled",
        };
        Ok(FixtureSwing {
            hinge: self.hinge,
            out,
            inertia: self.moment_of_inertia,
            stiffness: self.stiffness,
            damping: self.damping,
            rest_angle: self.rest_angle,
            stops: [self.least_angle, self.greatest_angle],
            held: 0.0,
            is_edited: true,
            proof: Swings::new().ok_or(refused)?,
        })
    }

    fn from_told(told: &FixtureSwing) -> Self {
        Swing {
            hinge: told.hinge,
            moment_of_inertia: told.inertia,
            stiffness: told.stiffness,
            damping: told.damping,
            rest_angle: told.rest_angle,
            least_angle: told.stops[0],
            greatest_angle: told.stops[1],
        }
    }
}

/// Whether one is what could have been told: false only after loading garbage.
pub(super) fn is_valid(told: &FixtureSwing) -> bool {
    let numbers = told.out.into_iter().chain([told.held]);
    Swing::from_told(told).check().is_ok() && numbers.into_iter().all(|number| number.is_finite())
}

impl Platform {
    /// How it swings about a hinge, if it does.
    pub fn swing(&self) -> Option<Swing> {
        self.told_swing().map(Swing::from_told)
    }

    fn told_swing(&self) -> Option<&FixtureSwing> {
        self.motion.as_ref()?.told.swing()
    }

    /// Velocity of its middle in the world, if that goes round a hinge.
    pub(super) fn swinging_velocity(&self) -> Option<Vector3> {
        let FixtureSwing { hinge: [x, z], .. } = self.told_swing()?;
        let (turning, centre) = (self.angular_velocity(), self.shape.centre);
        // The distance of two finite numbers and its product with a third may be beyond all numbers.
        let at = |out: f32| nearest_finite(turning * nearest_finite(out));
        Some(Vector3::new(-at(centre.z - z), 0.0, at(centre.x - x)))
    }

    /// Swinging, at rest at the angle that it has; or not any more, and standing still.
    pub(crate) fn swinging(&self, swing: Option<&Swing>, projection: &Projection) -> Result<Self> {
        let yaw = self.yaw();
        let Some(swing) = swing else {
            let platform =
                Platform { motion: None, yaw: Some(yaw).filter(|&yaw| yaw != 0.0), ..self.clone() };
            return platform.shaped(projection);
        };
        swing.check()?;
        if swing.least_angle > yaw {
            return Err(invalid("least_angle", swing.least_angle, "no more than the yaw of the platform"));
        }
        if swing.greatest_angle < yaw {
            return Err(invalid(
                "greatest_angle",
                swing.greatest_angle,
                "no less than the yaw of the platform",
            ));
        }
        let ([cos, sin], centre) = (self.shape.turn, self.shape.centre);
        let (x, z) = (centre.x - swing.hinge[0], centre.z - swing.hinge[1]);
        let told = swing.told([x * cos + z * sin, z * cos - x * sin])?;
        let told = FixtureMotion { swing: Some(told), ..FixtureMotion::default() };
        let motion = Some(Motion { centre, target: None, told });
        Platform { motion, yaw: Some(yaw), ..self.clone() }.shaped(projection)
    }

    /// Refuses what cannot go round its hinge: nothing, if it has none.
    pub(super) fn check_hinge(&self) -> Result<()> {
        let Some(FixtureSwing { hinge, out, .. }) = self.told_swing() else { return Ok(()) };
        let reach = out[0].abs() + out[1].abs() + self.width + self.depth;
        let span = |at: f32| (at + reach) - (at - reach);
        if self.yaw.is_none() || !hinge.iter().all(|&at| span(at).is_finite()) {
            return Err(invalid("hinge", *hinge, "near enough for finite corners"));
        }
        Ok(())
    }

    /// One that swings is put to an angle.
    pub(super) fn put_at(&mut self, yaw: f32) -> Result<()> {
        let (y, turn) = (self.shape.centre.y, farseer_core::math::scalar::sin_cos_of_any(yaw));
        let Some(motion) = &mut self.motion else { return Ok(()) };
        let Some(swing) = motion.told.swing_mut() else { return Ok(()) };
        if !Swing::from_told(swing).is_within(yaw) {
            return Err(invalid("yaw", yaw, "between the stops of a platform that swings"));
        }
        swing.is_edited = true;
        motion.centre = swing.middle([turn.1, turn.0], y);
        self.position3d = Vector3::new(motion.centre.x, self.position3d.y, motion.centre.z);
        Ok(())
    }

    /// The hinge moves with the platform, whose middle is to be there.
    pub(super) fn take_hinge_along(&mut self, centre: Vector3) {
        let way = centre - self.shape.centre;
        if let Some(swing) = self.motion.as_mut().and_then(|motion| motion.told.swing_mut()) {
            swing.hinge = [swing.hinge[0] + way.x, swing.hinge[1] + way.z];
            swing.is_edited = true;
        }
    }

    /// One that swings may have fallen asleep.
    pub(in crate::depth) fn has_rested(&mut self, told: FixtureMotion) {
        if let Some(motion) = &mut self.motion {
            motion.told = told;
        }
    }
}
