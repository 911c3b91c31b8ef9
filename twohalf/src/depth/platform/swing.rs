//! Hinged platforms: doors that swing about an upright hinge.

use farseer_core::Error;
use farseer_core::depth::{HingeFeature, WorldBoxHinge, WorldBoxMotion};
use farseer_core::math::scalar::nearest_finite;
use serde::{Deserialize, Serialize};

use super::{Platform, PlatformMotion};
#[cfg(doc)]
use crate::PlatformMut;
use crate::error::invalid;
use crate::{Projection, Result, Vector3};

/// Parameters of a platform that [swings](PlatformMut::set_swing) about an upright hinge with a spring and a
/// damper. Angles are those of [`Platform::yaw`] in radians; masses are those of bodies.
///
/// With moment of inertia I, stiffness k and damping c, its free motion is I θ″ + c θ′ + k (θ − θ₀) = 0.
/// Undamped, the period is 2π √(I / k) s; c = 2 √(k I) is critical damping.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Swing {
    /// X and Z of the hinge, px; it may lie outside of the platform.
    pub hinge: [f32; 2],
    /// Moment of inertia about the hinge, mass · px². A uniform slab of mass m, width w and depth d has m (w²
    /// / 3 + d² / 12) about the end of its width.
    pub moment_of_inertia: f32,
    /// Stiffness of the spring, mass · px²/s² per radian; 0 is no spring.
    pub stiffness: f32,
    /// Damping coefficient, mass · px²/s per radian; 0 is no damper.
    pub damping: f32,
    /// Rest angle of the spring, radians. It may lie beyond a stop, which the platform is then pressed
    /// against.
    pub rest_angle: f32,
    /// Lower stop, radians. The platform comes to rest at it without bouncing.
    pub least_angle: f32,
    /// Upper stop, radians.
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

    /// Returns the parameters as a hinge of the core. `out` is the centre of the platform relative to the hinge at yaw 0, along
    /// X and Z, px.
    fn core_swing(&self, out: [f32; 2]) -> Result<WorldBoxHinge> {
        let refused = Error::NotSupported {
            what: "platforms that swing, which are the feature `swing`",
            methods: "compiled",
        };
        Ok(WorldBoxHinge {
            pivot: self.hinge,
            box_offset: out,
            inertia: self.moment_of_inertia,
            stiffness: self.stiffness,
            damping: self.damping,
            rest_angle: self.rest_angle,
            stops: [self.least_angle, self.greatest_angle],
            constraint_torque: 0.0,
            is_edited: true,
            proof: HingeFeature::new().ok_or(refused)?,
        })
    }

    fn from_core(hinge: &WorldBoxHinge) -> Self {
        Swing {
            hinge: hinge.pivot,
            moment_of_inertia: hinge.inertia,
            stiffness: hinge.stiffness,
            damping: hinge.damping,
            rest_angle: hinge.rest_angle,
            least_angle: hinge.stops[0],
            greatest_angle: hinge.stops[1],
        }
    }
}

/// Returns whether the parameters are in range: false only for a damaged save.
pub(super) fn is_valid(hinge: &WorldBoxHinge) -> bool {
    let numbers = hinge.box_offset.into_iter().chain([hinge.constraint_torque]);
    Swing::from_core(hinge).check().is_ok() && numbers.into_iter().all(|number| number.is_finite())
}

impl Platform {
    /// Parameters of the platform's hinge; `None` without a hinge.
    pub fn swing(&self) -> Option<Swing> {
        self.core_hinge().map(Swing::from_core)
    }

    fn core_hinge(&self) -> Option<&WorldBoxHinge> {
        self.motion.as_ref()?.core_motion.hinge()
    }

    /// Velocity of the platform's centre in the world, px/s, Y up; `None` without a hinge.
    pub(super) fn swinging_velocity(&self) -> Option<Vector3> {
        let WorldBoxHinge { pivot: [x, z], .. } = self.core_hinge()?;
        let (turning, centre) = (self.angular_velocity(), self.shape.centre);
        // The difference of two finite numbers and its product with a third may overflow.
        let at = |out: f32| nearest_finite(turning * nearest_finite(out));
        Some(Vector3::new(-at(centre.z - z), 0.0, at(centre.x - x)))
    }

    /// The platform at rest on a hinge; with `None`, the platform without a hinge and at rest.
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
        let hinge = swing.core_swing([x * cos + z * sin, z * cos - x * sin])?;
        let core_motion = WorldBoxMotion { hinge: Some(hinge), ..WorldBoxMotion::default() };
        let motion = Some(PlatformMotion { centre, target: None, core_motion });
        Platform { motion, yaw: Some(yaw), ..self.clone() }.shaped(projection)
    }

    /// Returns an error if the hinge is so far away that coordinates are not finite.
    pub(super) fn check_hinge(&self) -> Result<()> {
        let Some(WorldBoxHinge { pivot: hinge, box_offset: out, .. }) = self.core_hinge() else {
            return Ok(());
        };
        let reach = out[0].abs() + out[1].abs() + self.width + self.depth;
        let span = |at: f32| (at + reach) - (at - reach);
        if self.yaw.is_none() || !hinge.iter().all(|&at| span(at).is_finite()) {
            return Err(invalid("hinge", *hinge, "near enough for finite corners"));
        }
        Ok(())
    }

    /// Sets the angle of a hinged platform, radians, between its stops.
    pub(super) fn set_hinge_angle(&mut self, yaw: f32) -> Result<()> {
        let (y, turn) = (self.shape.centre.y, farseer_core::math::scalar::sin_cos_of_any(yaw));
        let Some(motion) = &mut self.motion else { return Ok(()) };
        let Some(swing) = motion.core_motion.hinge_mut() else { return Ok(()) };
        if !Swing::from_core(swing).is_within(yaw) {
            return Err(invalid("yaw", yaw, "between the stops of a platform that swings"));
        }
        swing.is_edited = true;
        motion.centre = swing.box_centre([turn.1, turn.0], y);
        self.position3d = Vector3::new(motion.centre.x, self.position3d.y, motion.centre.z);
        Ok(())
    }

    /// Moves the hinge together with the platform. `centre` is the new centre of the platform in the frame of the narrow phase,
    /// px.
    pub(super) fn move_hinge(&mut self, centre: Vector3) {
        let displacement = centre - self.shape.centre;
        if let Some(swing) = self.motion.as_mut().and_then(|motion| motion.core_motion.hinge_mut()) {
            swing.pivot = [swing.pivot[0] + displacement.x, swing.pivot[1] + displacement.z];
            swing.is_edited = true;
        }
    }

    /// Stores the motion of a hinged platform that may have fallen asleep in the core.
    pub(in crate::depth) fn has_rested(&mut self, core_motion: WorldBoxMotion) {
        if let Some(motion) = &mut self.motion {
            motion.core_motion = core_motion;
        }
    }
}
