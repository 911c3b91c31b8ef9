//! Boxes of the world.

use farseer_core::Error;
use serde::{Deserialize, Serialize};

use crate::{Result, Vector3};

/// A box of the world, px, Y up.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Region {
    low: Vector3,
    high: Vector3,
}

impl Region {
    /// The whole world.
    pub const EVERYWHERE: Region = Region {
        low: Vector3::new(f32::MIN, f32::MIN, f32::MIN),
        high: Vector3::new(f32::MAX, f32::MAX, f32::MAX),
    };

    /// A box from the least X, Y and Z to the greatest, px. [`f32::MIN`] and [`f32::MAX`] reach to the end of
    /// the world.
    ///
    /// # Errors
    /// Numbers that are not finite, or of which the first is not less than the second.
    pub fn new(low: [f32; 3], high: [f32; 3]) -> Result<Self> {
        Region { low: low.into(), high: high.into() }.check()
    }

    pub(super) fn check(self) -> Result<Self> {
        let Region { low, high } = self;
        let is_box =
            (0..3).all(|axis| low[axis].is_finite() && high[axis].is_finite() && low[axis] < high[axis]);
        match is_box {
            true => Ok(self),
            false => Err(Error::invalid("region", [low, high], "finite, the first corner below the second"))?,
        }
    }

    /// The corner of the least X, Y and Z, px.
    pub fn low(&self) -> Vector3 {
        self.low
    }

    /// The corner of the greatest X, Y and Z, px.
    pub fn high(&self) -> Vector3 {
        self.high
    }

    /// Returns whether a point is in the box, faces included.
    pub fn contains(&self, point: Vector3) -> bool {
        (0..3).all(|axis| (self.low[axis]..=self.high[axis]).contains(&point[axis]))
    }
}
