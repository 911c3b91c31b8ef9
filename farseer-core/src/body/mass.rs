//! Mass, moment of inertia, and whether the body is static.

use super::Body;
use crate::error::{Error, Result};
use crate::math::finite::finite;

impl Body {
    /// Mass, in the user's mass unit, never 0. Default 1.
    #[doc(alias = "Mass")]
    pub fn mass(&self) -> f32 {
        self.mass
    }

    /// Sets the mass. Negative masses are accepted, as in the original.
    ///
    /// # Errors
    /// Zero, a value that is not finite, and one so small that its reciprocal is not finite.
    pub fn set_mass(&mut self, value: f32) -> Result<()> {
        if value == 0.0 {
            return Err(Error::invalid("mass", value, "other than 0"));
        }
        finite("mass", value)?;
        if !(1.0 / value).is_finite() {
            return Err(Error::invalid("mass", value, "large enough for a finite reciprocal"));
        }
        self.mass = value;
        self.update_inverse_mass();
        Ok(())
    }

    /// Reciprocal of the mass, in 1/mass units; 0 for a static or kinematic body.
    #[doc(alias = "InverseMass")]
    #[inline]
    pub fn inverse_mass(&self) -> f32 {
        self.inverse_mass
    }

    /// Moment of inertia about the body's origin, in mass units · length units², greater than 0. Default 1.
    #[doc(alias = "MomentOfInertia")]
    pub fn moment_of_inertia(&self) -> f32 {
        self.moment_of_inertia
    }

    /// Sets the moment of inertia.
    ///
    /// # Errors
    /// Zero or less, a value that is not finite, and one so small that its reciprocal is not finite.
    pub fn set_moment_of_inertia(&mut self, value: f32) -> Result<()> {
        crate::math::finite::positive("moment_of_inertia", value)?;
        if !(1.0 / value).is_finite() {
            return Err(Error::invalid("moment_of_inertia", value, "large enough for a finite reciprocal"));
        }
        self.moment_of_inertia = value;
        self.update_inverse_mass();
        Ok(())
    }

    /// Reciprocal of the moment of inertia, in 1/(mass units · length units²); 0 for a static or kinematic body.
    #[doc(alias = "InverseMomentOfInertia")]
    #[inline]
    pub fn inverse_moment_of_inertia(&self) -> f32 {
        self.inverse_moment_of_inertia
    }

    /// Whether the body is static: it never moves. Default false.
    #[doc(alias = "IsStatic")]
    #[inline]
    pub fn is_static(&self) -> bool {
        self.is_static
    }

    /// Makes the body static, or dynamic if it was static. Velocities and accumulated forces stay: a force that was
    /// applied to a static body acts at once when the body becomes dynamic. With `true` a
    /// [kinematic](Self::is_kinematic) body becomes static; with `false` it stays kinematic.
    pub fn set_is_static(&mut self, value: bool) {
        if value {
            self.set_is_kinematic(false);
        }
        self.is_static = value;
        self.update_inverse_mass();
    }
}
