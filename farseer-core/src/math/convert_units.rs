//! Conversion between display and simulation units (behaviour chapter 01, section 9).

use serde::{Deserialize, Serialize};

use super::Vector2;
use crate::error::{Error, Result};

/// A ratio of display units (px) to simulation units (m). The original keeps one for the whole process; here
/// it is a value. The engine itself never converts.
///
/// ```
/// use farseer_core::math::{ConvertUnits, Vector2};
/// let units = ConvertUnits::default();
/// assert_eq!(units.to_display_units(2.0_f32), 100.0);
/// assert_eq!(units.to_display_units(Vector2::new(1.0, 2.0)), Vector2::new(50.0, 100.0));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ConvertUnits {
    to_display: f32,
    to_sim: f32,
}

/// 50 display units per simulation unit.
impl Default for ConvertUnits {
    fn default() -> Self {
        ConvertUnits { to_display: 50.0, to_sim: 1.0 / 50.0 }
    }
}

impl ConvertUnits {
    /// A ratio in display units per simulation unit. 0 is accepted, as in the original, and makes simulation
    /// units infinite.
    ///
    /// # Errors
    /// When the ratio is not finite.
    pub fn new(display_units_per_sim_unit: f32) -> Result<Self> {
        if !display_units_per_sim_unit.is_finite() {
            return Err(Error::invalid("display_units_per_sim_unit", display_units_per_sim_unit, "finite"));
        }
        let to_sim = 1.0 / display_units_per_sim_unit;
        Ok(ConvertUnits { to_display: display_units_per_sim_unit, to_sim })
    }

    /// Sets the ratio; see [`ConvertUnits::new`].
    ///
    /// # Errors
    /// When the ratio is not finite.
    #[doc(alias = "SetDisplayUnitToSimUnitRatio")]
    pub fn set_display_unit_to_sim_unit_ratio(&mut self, display_units_per_sim_unit: f32) -> Result<()> {
        *self = ConvertUnits::new(display_units_per_sim_unit)?;
        Ok(())
    }

    /// Simulation to display units.
    #[doc(alias = "ToDisplayUnits")]
    pub fn to_display_units<T: Length>(&self, sim_units: T) -> T::Converted {
        sim_units.times(self.to_display)
    }

    /// Display to simulation units: times the reciprocal of the ratio, which may differ in the last bit from
    /// a division.
    #[doc(alias = "ToSimUnits")]
    pub fn to_sim_units<T: Length>(&self, display_units: T) -> T::Converted {
        display_units.times(self.to_sim)
    }
}

/// A length that [`ConvertUnits`] can convert: a number, which becomes `f32` first, a vector, or a pair of coordinates.
pub trait Length {
    /// `f32` for numbers, [`Vector2`] for vectors and pairs.
    type Converted;

    /// The length times a factor.
    fn times(self, factor: f32) -> Self::Converted;
}

impl Length for f32 {
    type Converted = f32;

    fn times(self, factor: f32) -> f32 {
        self * factor
    }
}

impl Length for f64 {
    type Converted = f32;

    fn times(self, factor: f32) -> f32 {
        self as f32 * factor
    }
}

impl Length for i32 {
    type Converted = f32;

    fn times(self, factor: f32) -> f32 {
        self as f32 * factor
    }
}

impl Length for Vector2 {
    type Converted = Vector2;

    fn times(self, factor: f32) -> Vector2 {
        self * factor
    }
}

impl<T: Length<Converted = f32>> Length for (T, T) {
    type Converted = Vector2;

    fn times(self, factor: f32) -> Vector2 {
        Vector2::new(self.0.times(factor), self.1.times(factor))
    }
}
