//! Whose time passes more slowly than that of the others.

use farseer_core::BodyId;
use serde::{Deserialize, Serialize};

/// Slower than this is still, so that no number of a slow body is out of range.
const SLOWEST: f32 = 0.01;

/// A body with a time of its own.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub(crate) struct Pace {
    pub(crate) body: BodyId,
    pub(crate) scale: f32,
    /// For so many updates still it stands still.
    pub(crate) stops: u32,
}

impl Pace {
    pub(crate) fn new(body: BodyId) -> Self {
        Pace { body, scale: 1.0, stops: 0 }
    }

    pub(crate) fn scale_now(&self) -> f32 {
        if self.stops > 0 { 0.0 } else { self.scale }
    }

    pub(crate) fn is_over(&self) -> bool {
        self.scale == 1.0 && self.stops == 0
    }

    /// What was loaded may hold anything.
    pub(crate) fn is_valid(&self) -> bool {
        Pace::is_scale(self.scale)
    }

    pub(crate) fn is_scale(scale: f32) -> bool {
        scale == 0.0 || (SLOWEST..=1.0).contains(&scale)
    }
}
