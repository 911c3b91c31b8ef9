//! What attracts.

use farseer_core::Error;
use serde::{Deserialize, Serialize};

use crate::{Result, Vector3};

/// A point that attracts all bodies that can be moved, whatever their mass, unless they ignore gravity.
///
/// At a distance of d px it accelerates by `strength * d / (d² + softness²)^1.5`: by `strength / d²` where the softness hardly
/// matters, and by less and less near its middle.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Well {
    /// Where it is: X, Y up and Z in px, finite.
    pub centre: Vector3,
    /// Acceleration times the square of the distance, px³/s², finite; one below 0 repels.
    pub strength: f32,
    /// How far from the middle it reaches, px, 0 or more. [`f32::MAX`] is everywhere.
    pub radius: f32,
    /// px, finite and greater than 0.
    pub softness: f32,
}

impl Well {
    /// A well that reaches everywhere, has a softness of 10 px, and a strength of 0 until it is given one.
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

    /// How it accelerates what is at a place, in px/s².
    pub fn acceleration_at(&self, place: Vector3) -> Vector3 {
        let way = (self.centre - place).map(f64::from);
        let (squared, softness) = (way.norm_squared(), f64::from(self.softness));
        if squared > f64::from(self.radius) * f64::from(self.radius) {
            return Vector3::zeros();
        }
        let softened = squared + softness * softness;
        let acceleration = way * (f64::from(self.strength) / (softened * softened.sqrt()));
        acceleration.map(|part| part as f32)
    }
}
