//! Keys of a curve (behaviour chapter 14, section 2).

use std::cmp::Ordering;

use serde::{Deserialize, Serialize};

use crate::Result;
use crate::math::finite::finite;

/// Continuation of a curve from a key to the next.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Hash, Serialize, Deserialize)]
pub enum CurveContinuity {
    /// The value blends into that of the next key.
    #[default]
    Smooth,
    /// The key's value is constant (for the exception see behaviour chapter 14, section 4.2).
    Step,
}

/// A point of a [`Curve`](crate::Curve), with the tangents of the curve there.
///
/// Keys are values here: the original's collections share them, so that a key edited in one of them changes in the
/// other. Position and value have the units for which the curve is made.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[doc(alias("CurveKey.Clone", "CurveKey.Equals"))]
pub struct CurveKey {
    position: f32,
    value: f32,
    tangent_in: f32,
    tangent_out: f32,
    continuity: CurveContinuity,
}

impl CurveKey {
    /// A smooth key with level tangents.
    ///
    /// # Errors
    /// A number that is not finite.
    #[doc(alias = "CurveKey(float, float)")]
    pub fn new(position: f32, value: f32) -> Result<Self> {
        Self::with_tangents(position, value, 0.0, 0.0)
    }

    /// A smooth key with tangents.
    ///
    /// # Errors
    /// A number that is not finite.
    #[doc(alias = "CurveKey(float, float, float, float)")]
    pub fn with_tangents(position: f32, value: f32, tangent_in: f32, tangent_out: f32) -> Result<Self> {
        Self::with_continuity(position, value, tangent_in, tangent_out, CurveContinuity::Smooth)
    }

    /// A key with all its properties.
    ///
    /// # Errors
    /// A number that is not finite.
    #[doc(alias = "CurveKey(float, float, float, float, CurveContinuity)")]
    pub fn with_continuity(
        position: f32,
        value: f32,
        tangent_in: f32,
        tangent_out: f32,
        continuity: CurveContinuity,
    ) -> Result<Self> {
        Ok(CurveKey {
            position: finite("position", position)?,
            value: finite("value", value)?,
            tangent_in: finite("tangent_in", tangent_in)?,
            tangent_out: finite("tangent_out", tangent_out)?,
            continuity,
        })
    }

    /// Position of the key on the curve's axis.
    #[doc(alias = "Position")]
    pub fn position(&self) -> f32 {
        self.position
    }

    /// The curve's value at the key.
    #[doc(alias = "Value")]
    pub fn value(&self) -> f32 {
        self.value
    }

    /// Sets the value.
    ///
    /// # Errors
    /// A value that is not finite.
    pub fn set_value(&mut self, value: f32) -> Result<()> {
        self.value = finite("value", value)?;
        Ok(())
    }

    /// Tangent with which the curve arrives: change of the value over the full distance from the key before. Default 0.
    #[doc(alias = "TangentIn")]
    pub fn tangent_in(&self) -> f32 {
        self.tangent_in
    }

    /// Sets the tangent with which the curve arrives.
    ///
    /// # Errors
    /// A value that is not finite.
    pub fn set_tangent_in(&mut self, tangent_in: f32) -> Result<()> {
        self.tangent_in = finite("tangent_in", tangent_in)?;
        Ok(())
    }

    /// Tangent with which the curve leaves: change of the value over the full distance to the next key. Default 0.
    #[doc(alias = "TangentOut")]
    pub fn tangent_out(&self) -> f32 {
        self.tangent_out
    }

    /// Sets the tangent with which the curve leaves.
    ///
    /// # Errors
    /// A value that is not finite.
    pub fn set_tangent_out(&mut self, tangent_out: f32) -> Result<()> {
        self.tangent_out = finite("tangent_out", tangent_out)?;
        Ok(())
    }

    /// Continuation of the curve to the next key. Default [`CurveContinuity::Smooth`].
    #[doc(alias = "Continuity")]
    pub fn continuity(&self) -> CurveContinuity {
        self.continuity
    }

    /// Sets the continuation of the curve to the next key.
    pub fn set_continuity(&mut self, continuity: CurveContinuity) {
        self.continuity = continuity;
    }

    /// Orders keys by position alone.
    #[doc(alias = "CompareTo")]
    pub fn compare_to(&self, other: &CurveKey) -> Ordering {
        // Positions are finite; -0 and +0 are equal.
        self.position.partial_cmp(&other.position).unwrap_or(Ordering::Equal)
    }

    pub(super) fn set_computed_tangents(&mut self, tangent_in: f32, tangent_out: f32) {
        (self.tangent_in, self.tangent_out) = (tangent_in, tangent_out);
    }
}
