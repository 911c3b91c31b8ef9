//! Wells: points that attract or repel.

use farseer_core::Error;
use serde::{Deserialize, Serialize};

use crate::{Result, Vector3};

/// A point that attracts all dynamic bodies independently of their mass, unless they ignore gravity.
///
/// At a distance of d px the acceleration is `strength * d / (d² + softness²)^1.5`. It approaches `strength /
/// d²` far away and 0 at the centre.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Well {
    /// Position of the well: X, Y up and Z in px, finite.
    pub centre: Vector3,
    /// Acceleration times the square of the distance, px³/s², finite; a negative one repels.
    pub strength: f32,
    /// Radius of action, px, 0 or more; [`f32::MAX`] is everywhere.
    pub radius: f32,
    /// Softening length, px, finite and greater than 0.
    pub softness: f32,
}

impl Well {
    /// A well with radius everywhere, a softness of 10 px, and a strength of 0.
    pub fn new(centre: [f32; 3]) -> Self {
        Well { centre: centre.into(), strength: 0.0, radius: f32::MAX, softness: 10.0 }
    }

    pub(super) fn check(&self) -> Result<()> {
        let is_finite =
            self.centre.iter().chain([&self.strength, &self.radius]).all(|number| number.is_finite());
        if !is_finite {
            Err(Error::invalid("well", *self, "finite"))?;
        }
        if self.radius < 0.0 {
            Err(Error::invalid("radius", self.radius, "0 or more"))?;
        }
        if !(self.softness.is_finite() && self.softness > 0.0) {
            Err(Error::invalid("softness", self.softness, "finite and greater than 0"))?;
        }
        Ok(())
    }

    /// Acceleration of a body at a place, px/s², Y up.
    pub fn acceleration_at(&self, place: Vector3) -> Vector3 {
        let offset = (self.centre - place).map(f64::from);
        let (squared, softness) = (offset.norm_squared(), f64::from(self.softness));
        if squared > f64::from(self.radius) * f64::from(self.radius) {
            return Vector3::zeros();
        }
        let softened = squared + softness * softness;
        let acceleration = offset * (f64::from(self.strength) / (softened * softened.sqrt()));
        acceleration.map(|part| part as f32)
    }
}
