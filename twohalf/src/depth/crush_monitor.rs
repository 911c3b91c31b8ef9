//! Bodies whose crushing is reported as an event.

use farseer_core::BodyId;
use serde::{Deserialize, Serialize};

/// A body whose crushing is reported, with its tolerance and its last state.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub(crate) struct CrushMonitor {
    pub(crate) body: BodyId,
    /// Lack of room up to which the body is not crushed, px, finite and 0 or more.
    pub(crate) tolerance: f32,
    pub(crate) is_crushed: bool,
}

impl CrushMonitor {
    /// Returns whether the tolerance is in range: false only for a damaged save.
    pub(crate) fn is_valid(&self) -> bool {
        self.tolerance.is_finite() && self.tolerance >= 0.0
    }
}
