//! Time scales of single bodies.

use farseer_core::BodyId;
use serde::{Deserialize, Serialize};

/// Least time scale greater than 0, dimensionless, so that the scaled mass and velocity stay in range.
const MIN_TIME_SCALE: f32 = 0.01;

/// Time scale of a body, and for how long the body's time is stopped.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub(crate) struct TimeScale {
    pub(crate) body: BodyId,
    /// Ratio of the time of the body to the time of the simulator, 0 or 0.01..=1; dimensionless.
    pub(crate) scale: f32,
    /// Number of updates for which the time of the body remains stopped.
    pub(crate) stops: u32,
}

impl TimeScale {
    pub(crate) fn new(body: BodyId) -> Self {
        TimeScale { body, scale: 1.0, stops: 0 }
    }

    pub(crate) fn scale_now(&self) -> f32 {
        if self.stops > 0 { 0.0 } else { self.scale }
    }

    pub(crate) fn is_over(&self) -> bool {
        self.scale == 1.0 && self.stops == 0
    }

    /// Returns whether the scale is in range: false only for a damaged save.
    pub(crate) fn is_valid(&self) -> bool {
        TimeScale::is_scale(self.scale)
    }

    pub(crate) fn is_scale(scale: f32) -> bool {
        scale == 0.0 || (MIN_TIME_SCALE..=1.0).contains(&scale)
    }
}
